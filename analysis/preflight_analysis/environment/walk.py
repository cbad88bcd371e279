"""Folders in the order in which `os.walk` visits them, which decides between packages and files of the same name."""

from __future__ import annotations

import logging
import os
from collections.abc import Collection, Iterator

MAX_FOLDERS = 100_000
"""Then a walk ends."""
MAX_LINKED_FOLDERS = 3_000
"""How many folders of one walk may lie behind links that lead out of it. Repositories are linked into a workspace, and
have fewer above their packages; a link to `/usr` must not take the walk through the whole machine."""
NOT_ON_DISK = frozenset({"/proc", "/sys", "/dev", "/run"})
"""What the kernel makes up holds no packages, and may change while it is listed."""

_log = logging.getLogger(__name__)


def walk(top: str, skip: Collection[str] = ()) -> Iterator[tuple[str, list[str], list[str]]]:
    """`(folder, names of folders, names of files)`, a folder before those in it, links followed.

    The list of folders may be cleared or shortened to keep the walk out of them. Hidden folders are left out, so are
    those of the names `skip` right below `top`, those that cannot be read, and those already visited (links may
    form a cycle; `os.walk` would go round until the path is too long). A link to a folder around `top` is not followed,
    nor are links out of `top` once they led to `MAX_LINKED_FOLDERS`; a walk of `/` ends after as many. The log says so.
    """
    top = os.path.abspath(top)
    real_top = os.path.realpath(top)
    visited: set[tuple[int, int]] = set()
    pending = [(top, real_top == "/")]
    skipped = frozenset(skip)
    linked = 0
    while pending:
        folder, is_outside = pending.pop()
        if len(visited) >= MAX_FOLDERS:
            _log.warning("%s has more than %d folders; the others are not looked at", top, MAX_FOLDERS)
            return
        folders: list[str] = []
        links: dict[str, bool] = {}
        files: list[str] = []
        try:
            status = os.stat(folder)
            if (status.st_dev, status.st_ino) in visited:
                continue
            if is_outside and linked >= MAX_LINKED_FOLDERS:
                if linked == MAX_LINKED_FOLDERS:
                    what = "%s: links lead to more than %d folders outside; %s and others are not looked at"
                    _log.warning(what, top, MAX_LINKED_FOLDERS, folder)
                    linked += 1
                continue
            visited.add((status.st_dev, status.st_ino))
            linked += is_outside
            with os.scandir(folder) as entries:
                for entry in entries:
                    if not is_folder(entry):
                        files.append(entry.name)
                    elif not entry.name.startswith(".") and entry.name not in skipped:
                        if entry.is_symlink():
                            target = os.path.realpath(entry.path)
                            if _holds(target, real_top) or target in NOT_ON_DISK:
                                continue
                            links[entry.name] = is_outside or not _holds(real_top, target)
                        folders.append(entry.name)
        except OSError:
            continue
        skipped = frozenset()
        yield folder, folders, files
        above = os.path.join(folder, "")
        for name in reversed(folders):
            path = above + name
            if path not in NOT_ON_DISK:
                pending.append((path, links.get(name, is_outside)))


def _holds(folder: str, path: str) -> bool:
    return path == folder or path.startswith(folder.rstrip("/") + "/")


def is_folder(entry: os.DirEntry[str]) -> bool:
    """Whether an entry is a folder or leads to one. A link that leads to itself is none, where `is_dir` raises."""
    try:
        return entry.is_dir()
    except OSError:
        return False
