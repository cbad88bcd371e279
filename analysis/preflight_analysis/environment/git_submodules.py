"""Submodules of a repository that are not checked out, by its `.gitmodules` file (gitmodules(5)).

Git is not asked, as for what it ignores (`git_ignored.py`).
"""

from __future__ import annotations

import os
import re

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query

_NAME = ".gitmodules"
_PATH = re.compile(r'[ \t]*path[ \t]*=[ \t]*"?([^"\s]+)"?[ \t]*')
_MOST_LINES = 2000


@dataclass(frozen=True, slots=True)
class Submodule:
    """One whose folder is empty or not there."""

    folder: str
    path: str
    """As its repository names it, from its own top folder."""


def left_submodule(disk: Disk, path: str) -> Submodule | None:
    """The submodule that a path is in, or is the folder of."""
    return next((each for each in _left(disk, path) if f"{path}/".startswith(f"{each.folder}/")), None)


def left_submodules_below(disk: Disk, folder: str) -> tuple[Submodule, ...]:
    """Those in a folder."""
    return tuple(each for each in _left(disk, folder) if each.folder.startswith(f"{folder.rstrip('/')}/"))


def _left(disk: Disk, path: str) -> tuple[Submodule, ...]:
    """Those of all repositories around a path."""
    found: list[Submodule] = []
    folder = os.path.dirname(path.rstrip("/"))
    while folder != os.path.dirname(folder):
        listed = ((each, os.path.normpath(f"{folder}/{each}")) for each in _paths(disk.db, f"{folder}/{_NAME}"))
        found += [Submodule(each, named) for named, each in listed if not disk.names(each)]
        folder = os.path.dirname(folder)
    return tuple(found)


@query
def _paths(db: Database, path: str) -> tuple[str, ...]:
    """The folders of the submodules that a file lists, from its own folder."""
    text = Disk(db).text(path)
    if not isinstance(text, Document):
        return ()
    found = map(_PATH.fullmatch, text.text.splitlines()[:_MOST_LINES])
    return tuple(each[1] for each in found if each is not None)
