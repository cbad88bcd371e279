"""`--paths`: whether the paths of a JSON document are absolute, or relative to the workspace or the current folder."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterable, Mapping
from typing import Any

ABSOLUTE, RELATIVE, CWD = "absolute", "relative", "cwd"
_OF_PATHS = frozenset(
    {"file", "path", "includes", "roots", "param_files", "not_evaluated", "package_path", "devel_spaces"}
)
"""The keys whose values are paths, in the documents of all verbs."""
_OF_USERS = frozenset({"params", "args", "env", "default"})
"""The keys below which the names are the user's own."""


def add_paths(parser: argparse.ArgumentParser) -> None:
    """The option."""
    parser.add_argument(
        "--paths",
        choices=(ABSOLUTE, RELATIVE, CWD),
        default=ABSOLUTE,
        help="with --format json: print paths absolute, or relative to the workspace or the current folder (default: "
        "%(default)s)",
    )


def with_paths(data: Mapping[str, Any], args: argparse.Namespace, workspaces: Iterable[str]) -> Mapping[str, Any]:
    """The document as `--paths` wants it. What lies outside of the folders `workspaces` stays absolute."""
    if args.paths == ABSOLUTE:
        return data
    if args.paths == CWD:
        workspaces = [os.getcwd()]
    # The innermost first: one workspace may lie in another.
    homes = sorted({os.path.join(home, "") for home in workspaces}, key=len, reverse=True)
    found: Mapping[str, Any] = _relative(data, homes, False)
    return found


def by_name(paths: Mapping[str, str], args: argparse.Namespace, workspaces: Iterable[str]) -> Mapping[str, Any]:
    """Paths by name, such as the packages of `doctor`, as `--paths` wants them."""
    return dict(zip(paths, with_paths({"path": [*paths.values()]}, args, workspaces)["path"], strict=True))


def _relative(value: Any, homes: list[str], is_path: bool) -> Any:
    if isinstance(value, str):
        home = next((home for home in homes if value.startswith(home)), None) if is_path else None
        return value if home is None else value[len(home) :]
    if isinstance(value, list):
        return [_relative(each, homes, is_path) for each in value]
    if isinstance(value, Mapping):
        return {
            key: each if key in _OF_USERS and isinstance(each, Mapping) else _relative(each, homes, key in _OF_PATHS)
            for key, each in value.items()
        }
    return value
