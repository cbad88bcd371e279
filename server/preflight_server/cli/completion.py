"""`ros-preflight completion`: what a shell needs to complete the command."""

from __future__ import annotations

import argparse
import os

from preflight_server.cli.errors import CLEAN
from preflight_server.cli.output import print_text

DESCRIPTION = """Print the script that completes verbs, options, files, rules and arguments in a shell. For bash, add
eval "$(ros-preflight completion bash)" to ~/.bashrc. For zsh, add the same with zsh to ~/.zshrc, after compinit. For
fish, run ros-preflight completion fish > ~/.config/fish/completions/ros-preflight.fish"""
SHELLS = ("bash", "zsh", "fish")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    parser.add_argument("shell", metavar="SHELL", choices=SHELLS, help=f"one of {', '.join(SHELLS)}")


def run(args: argparse.Namespace) -> int:
    """Print the code."""
    from argcomplete.shell_integration import shellcode  # noqa: PLC0415, seldom needed

    print_text(shellcode(["ros-preflight"], shell=args.shell) + "\n")
    return CLEAN


def complete(parser: argparse.ArgumentParser) -> None:
    """Answer the shell that asks (`_ARGCOMPLETE` is set), and end the process."""
    import argcomplete  # noqa: PLC0415, likewise

    argcomplete.autocomplete(parser)


def argument_names(prefix: str, parsed_args: argparse.Namespace, **_: object) -> list[str]:
    """The arguments that the launch file FILE declares, for words `name:=`. Nothing is run for them."""
    if not parsed_args.file or not os.path.isfile(parsed_args.file):
        return []
    from preflight_analysis.environment.detect import detect  # noqa: PLC0415, likewise
    from preflight_analysis.workspace.sources import Sources  # noqa: PLC0415, likewise
    from preflight_analysis.workspace.workspace import Workspace  # noqa: PLC0415, likewise

    path = os.path.abspath(parsed_args.file)
    tree = Workspace(detect(path), Sources()).evaluated(path, {}).tree
    return [f"{name}:=" for name in tree.args if name.startswith(prefix)]
