"""`ros2 preflight ...`: the same command as a part of ROS 2's own, where ros2cli is installed beside this package."""

from __future__ import annotations

import argparse

NAME = "preflight"


class PreflightCommand:
    """Check launch configurations before a robot moves."""  # `ros2 --help` shows this line

    # What ros2cli asks of an extension of its group `ros2cli.command`; it is found by its entry point and needs no base
    # class: https://github.com/ros2/ros2cli/blob/rolling/ros2cli/ros2cli/command/__init__.py
    NAME = NAME
    EXTENSION_POINT_VERSION = "0.1"
    _program = "ros2 preflight"

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """All that follows is for our own parser, which says what it does not understand."""
        from preflight_server.cli.main import VERBS, version  # noqa: PLC0415, `ros2 --help` loads all extensions

        width = max(map(len, VERBS))
        parser.description = f"{parser.description or self.__doc__}\n\n" + "\n".join(
            f"{verb:<{width}}  {text}" for verb, text in VERBS.items()
        )
        self._program = cli_name
        parser.epilog = f"`{cli_name} VERB --help` has the options of a verb."
        parser.add_argument("--version", action="version", version=version())
        words = parser.add_argument("words", metavar="VERB ...", nargs=argparse.REMAINDER, help="as ros-preflight's")
        words.completer = _verbs  # type: ignore[attr-defined]  # argcomplete's

    def main(self, *, parser: argparse.ArgumentParser, args: argparse.Namespace) -> int:
        """Run the command; the return value is the exit code."""
        from preflight_server.cli.main import main  # noqa: PLC0415, likewise

        return main(args.words or ["--help"], program=self._program)


def _verbs(prefix: str, parsed_args: argparse.Namespace, **_: object) -> list[str]:
    """Of the words after `preflight` the first is a verb; what follows are mostly files, which the shell completes."""
    from preflight_server.cli.main import VERBS  # noqa: PLC0415, likewise

    return [] if parsed_args.words else [verb for verb in VERBS if verb.startswith(prefix)]
