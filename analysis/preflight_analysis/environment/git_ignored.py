"""Whether a repository leaves a file out on purpose, by its `.gitignore` files (gitignore(5)).

Git is not asked: the file need not be there, nor the repository be one. `**` counts at the beginning of a pattern only.
"""

from __future__ import annotations

import os
from fnmatch import fnmatchcase

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query

_NAME = ".gitignore"
_MOST_LINES = 2000


_ANYTHING = "\0"
"""A name that wildcards alone fit."""


def is_ignored(disk: Disk, path: str, *, as_folder: bool = False) -> bool:
    """Whether the nearest `.gitignore` that speaks of a path, or of a folder that it is in, excludes it; `as_folder`,
    whether all that it may hold is excluded: git has no empty folders."""
    path = os.path.join(path, _ANYTHING) if as_folder else path
    folder = os.path.dirname(path)
    while folder != os.path.dirname(folder):
        said = _said(_patterns(disk.db, os.path.join(folder, _NAME)), os.path.relpath(path, folder).split(os.sep))
        if said is not None:
            return said
        if disk.exists(os.path.join(folder, ".git")):
            return False
        folder = os.path.dirname(folder)
    return False


@query
def _patterns(db: Database, path: str) -> tuple[str, ...]:
    """The lines of the file that are patterns, the last one first."""
    text = Disk(db).text(path)
    if not isinstance(text, Document):
        return ()
    lines = [line.strip() for line in text.text.splitlines()[:_MOST_LINES]]
    return tuple(line for line in reversed(lines) if line and not line.startswith("#"))


def _said(patterns: tuple[str, ...], parts: list[str]) -> bool | None:
    for pattern in patterns:
        if _fits(pattern.removeprefix("!"), parts):
            return not pattern.startswith("!")
    return None


def _fits(pattern: str, parts: list[str]) -> bool:
    """Whether the pattern is for this path or for a folder above it; one with a slash starts at the top."""
    wanted = pattern.rstrip("/").removeprefix("**/")
    # A folder's name is no file's.
    names = parts[:-1] if pattern.endswith("/") else parts
    if "/" not in wanted:
        return any(fnmatchcase(name, wanted) for name in names)
    steps = wanted.lstrip("/").split("/")
    return len(steps) <= len(names) and all(map(fnmatchcase, names, steps))
