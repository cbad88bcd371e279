"""The files below a folder, such as that of a package."""

from __future__ import annotations

import os

from preflight_analysis.documents.disk import Disk
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query

_MOST_ENTRIES = 5000
"""A package has fewer; a path into a home directory must not lead to reading all of it."""


def files_in(disk: Disk, folder: str, *, deep: bool) -> tuple[str, ...]:
    """Paths of files in `folder`, those of its sub-folders too if `deep`; folders that cannot be read have none."""
    return _files_in(disk.db, folder, deep)


@query
def _files_in(db: Database, folder: str, deep: bool) -> tuple[str, ...]:
    disk, found, pending = Disk(db), list[str](), [folder]
    while pending and len(found) < _MOST_ENTRIES:
        place = pending.pop()
        names = disk.names(place)
        inner = [name for name in names if disk.is_folder(os.path.join(place, name))]
        found += (os.path.join(place, name) for name in sorted(set(names).difference(inner)))
        if deep:
            below = (os.path.join(place, name) for name in reversed(inner) if not name.startswith("."))
            pending += (path for path in below if not disk.is_link(path))
    return tuple(found[:_MOST_ENTRIES])


def module_file(folder: str, module: str, disk: Disk) -> str | None:
    """The source of a module of the package in a folder; None if it is not there."""
    relative = module.replace(".", os.sep)
    for root in ("", "src"):
        for candidate in (f"{relative}.py", os.path.join(relative, "__init__.py")):
            path = os.path.join(folder, root, candidate)
            if disk.is_file(path):
                return path
    return None
