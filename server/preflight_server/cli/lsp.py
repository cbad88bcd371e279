"""`ros-preflight lsp`: the language server."""

from __future__ import annotations

import argparse

DESCRIPTION = """The language server. Nothing is executed unless the editor says that the workspace is trusted
(initialisation option workspaceTrusted, or the notification rosPreflight/workspaceTrust)."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    parser.add_argument("--stdio", action="store_true", help="accepted for editors that say so; it is the only way")


def run(args: argparse.Namespace) -> int:
    """Serve until the editor leaves."""
    from preflight_server.lsp.app import serve  # noqa: PLC0415, the other verbs start faster without it

    return serve()
