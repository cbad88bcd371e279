"""`ros-preflight mcp`: the verbs as tools of the Model Context Protocol."""

from __future__ import annotations

import argparse
import os
import shlex
import sys

from preflight_server.cli.errors import CLEAN, CannotDoError

DESCRIPTION = """Start a server of the Model Context Protocol on standard input and output. Its tools check, tree,
graph, why, where, frames, explain and diff answer questions about the launch files of one workspace, and change nothing
in it. Nothing is executed; with --run nodes and Python launch files run in the sandbox."""
REQUIREMENT = "mcp>=2.3,<3"
"""The SDK, as the extra `mcp` of pyproject.toml has it."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    parser.add_argument(
        "folder", metavar="FOLDER", nargs="?", default=".", help="the workspace (default: the current folder)"
    )
    parser.add_argument(
        "--run",
        action="store_true",
        dest="allow_runs",
        help="run nodes and Python launch files in the sandbox (default: execute nothing)",
    )
    parser.add_argument(
        "--timeout",
        type=float,
        default=300.0,
        metavar="S",
        help="give up on an answer after this many seconds (default: %(default)s)",
    )


def run(args: argparse.Namespace) -> int:
    """Serve until the client closes standard input."""
    folder = os.path.realpath(args.folder)
    if not os.path.isdir(folder):
        raise CannotDoError(f"{args.folder} is not a folder")
    try:
        from preflight_server.mcp.server import Workspace, serve  # noqa: PLC0415, the SDK is an extra
    except ImportError as error:
        install = f"{shlex.quote(sys.executable)} -m pip install {shlex.quote(REQUIREMENT)}"
        raise CannotDoError(f"the MCP SDK is missing ({error}); install it with: {install}") from None
    serve(Workspace(folder, args.allow_runs, args.timeout))
    return CLEAN
