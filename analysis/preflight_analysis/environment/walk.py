"""Folders in the order in which `os.walk` visits them, which decides between packages and files of the same name."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterator

MAX_FOLDERS = 100_000
"""Then a walk ends. A link to `/` inside a package would otherwise take it through the whole machine."""


def walk(top: str, skip: Collection[str] = ()) -> Iterator[tuple[str, list[str], list[str]]]:
    """`(folder, names of folders, names of files)`, a folder before those in it, links followed.

    The list of folders may be cleared or shortened to keep the walk out of them. Hidden folders are left out, so are
    those of the names `skip` right below `top`, those that cannot be read, and those already visited (links may
    form a cycle; `os.walk` would go round until the path is too long).
    """
    visited: set[tuple[int, int]] = set()
    pending = [os.path.abspath(top)]
    skipped = frozenset(skip)
    while pending and len(visited) < MAX_FOLDERS:
        folder = pending.pop()
        folders: list[str] = []
        files: list[str] = []
        try:
            status = os.stat(folder)
            if (status.st_dev, status.st_ino) in visited:
                continue
            visited.add((status.st_dev, status.st_ino))
            with os.scandir(folder) as entries:
                for entry in entries:
                    if not _is_folder(entry):
                        files.append(entry.name)
                    elif not entry.name.startswith(".") and entry.name not in skipped:
                        folders.append(entry.name)
        except OSError:
            continue
        skipped = frozenset()
        yield folder, folders, files
        pending.extend(os.path.join(folder, name) for name in reversed(folders))


def _is_folder(entry: os.DirEntry[str]) -> bool:
    try:
        return entry.is_dir()
    except OSError:
        return False
