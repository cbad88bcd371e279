"""Options that verbs share."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterable, Sequence

from preflight_analysis.documents.secrets import ALLOWED
from preflight_analysis.environment.detect import detect
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.arguments import arguments_of
from preflight_analysis.findings.finding import SEVERITIES, Finding
from preflight_analysis.generation import ROS1
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.rules.registry import families, is_selector
from preflight_analysis.tracing.cache_folder import VARIABLE
from preflight_analysis.tracing.schedule import most_at_once
from preflight_analysis.workspace.sources import Sources

from preflight_server.cli.completion import argument_names
from preflight_server.cli.errors import CannotDoError, require
from preflight_server.cli.paths import add_paths

NEVER = "never"
_ASSIGNMENT = ":="


def add_format(parser: argparse.ArgumentParser, formats: Sequence[str] = ("text", "json")) -> None:
    """`--format`; the first one is the default. With JSON also `--paths`."""
    parser.add_argument(
        "--format", choices=formats, default=formats[0], help="the output format (default: %(default)s)"
    )
    if "json" in formats:
        add_paths(parser)


def add_common(parser: argparse.ArgumentParser, formats: Sequence[str] = ("text", "json")) -> None:
    """The options of every verb that looks at a workspace and fails on findings."""
    add_running(parser, formats)
    parser.add_argument(
        "--fail-on",
        choices=(*reversed(SEVERITIES), NEVER),
        default="error",
        help="exit with 1 on a finding of this severity or worse (default: error)",
    )


def add_running(parser: argparse.ArgumentParser, formats: Sequence[str]) -> None:
    """`--format`, and how nodes are found and run."""
    add_format(parser, formats)
    parser.add_argument("--no-run", action="store_true", help="execute nothing")
    parser.add_argument(
        "--jobs",
        type=_positive,
        default=most_at_once(),
        metavar="N",
        help="run at most N nodes at a time (default: two more than there are cores)",
    )
    parser.add_argument(
        "--package-path",
        metavar="A:B",
        help="search packages in these folders only, in this order",
    )
    parser.add_argument(
        "--allow-secret",
        action="append",
        default=[],
        metavar="PATH|NAME",
        help=f"read this file, folder or environment variable though it is a secret (also: {ALLOWED})",
    )
    parser.add_argument(
        "--workspace-only",
        action="store_true",
        help="read no files outside of the workspace and the package paths",
    )
    parser.add_argument(
        "--cache-dir",
        metavar="DIR",
        help=f"keep the results of runs in this folder (default: {VARIABLE}, else the user's cache folder)",
    )


def selectors(text: str) -> list[str]:
    """`LCH,TOP001`: rules and families. Raises `ArgumentTypeError` for what is neither."""
    names = [name for part in text.split(",") if (name := part.strip())]
    for name in names:
        if not is_selector(name):
            raise argparse.ArgumentTypeError(
                f"'{name}' is neither a rule nor one of the families {', '.join(families())}"
            )
    return names


def _positive(text: str) -> int:
    number = int(text)
    if number < 1:
        raise ValueError(text)
    return number


def add_file(parser: argparse.ArgumentParser, *, optional: bool = False) -> None:
    """The launch file and its arguments."""
    parser.add_argument("file", metavar="FILE", nargs="?" if optional else None, help="a launch file")
    values = parser.add_argument(
        "launch_args", metavar="name:=value", nargs="*", default=[], help="arguments of the launch file"
    )
    values.completer = argument_names  # type: ignore[attr-defined]  # argcomplete's


def launch_file(args: argparse.Namespace) -> str:
    """The absolute path of FILE. Raises `CannotDoError` if nothing is there."""
    path = require(args.file)
    if os.path.isdir(path):
        raise CannotDoError(f"{args.file} is a folder; name a launch file")
    return path


def launch_args(given: list[str], path: str) -> dict[str, str]:
    """`name:=value` words as roslaunch or `ros2 launch` takes them, whichever the file at `path` is for. Raises
    `CannotDoError` for a word that is nothing of the kind."""
    for each in given:
        if not is_assignment(each):
            raise CannotDoError(f"{each!r} is not of the form name:=value")
    found = Sources().launch_file(path) if given else None
    return arguments_of(found.generation if isinstance(found, LaunchFile) else ROS1.number, given)


def is_assignment(word: str) -> bool:
    """Whether a word is `name:=value`."""
    return _ASSIGNMENT in word and not word.startswith(_ASSIGNMENT)


def package_path(args: argparse.Namespace) -> tuple[str, ...] | None:
    """`--package-path` as absolute folders; None where it was not given."""
    if args.package_path is None:
        return None
    return tuple(os.path.abspath(folder) for folder in args.package_path.split(os.pathsep) if folder)


def environment(args: argparse.Namespace, place: str | None) -> Environment:
    """The environment for a workspace folder, or for the workspace of a file, as the options have it."""
    return detect(place, package_path=package_path(args), outside=not args.workspace_only)


def failing(findings: Iterable[Finding], fail_on: str) -> tuple[Finding, ...]:
    """Those of the findings that are at or above `--fail-on`."""
    if fail_on == NEVER:
        return ()
    order: dict[str, int] = {severity: rank for rank, severity in enumerate(SEVERITIES)}
    return tuple(finding for finding in findings if order[finding.severity] >= order[fail_on])
