"""`ros-preflight lsp`: the language server."""

from __future__ import annotations

import argparse

DESCRIPTION = """Start the language server on standard input and output. It executes nothing until the editor reports
the workspace as trusted (initialisation option workspaceTrusted, or the notification rosPreflight/workspaceTrust)."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    parser.add_argument(
        "--stdio", action="store_true", help="accepted for editors that pass it; the server has no other transport"
    )


def run(args: argparse.Namespace) -> int:
    """Serve until the editor leaves."""
    from preflight_server.lsp.app import serve  # noqa: PLC0415, the other verbs start faster without it

    return serve()
