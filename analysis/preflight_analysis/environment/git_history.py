"""What files of a repository were called before, by the commits that renamed or removed them.

The configuration of the repository is not obeyed (`git.py`). It is asked once for each commit that is checked out, when
something is looked for that is not there, and has little time; without an answer nothing is known.
"""

from __future__ import annotations

import os
import re
import time
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.environment.git import GitError, folders_of, open_repository
from preflight_analysis.incremental.query import Input

_MOST_COMMITS = 500
_MOST_COMPARED = 300
"""Files of one commit that are looked through for renames."""
_SECONDS = 3.0
_MOST_RENAMES = 20
"""Of one file after each other."""
_HEAD = re.compile(r"ref: (refs/[\w./+@-]+)")
_COMMIT = re.compile(r"[0-9a-f]{40,64}")
_BEGIN = "\x01"
_DAY = 24 * 60 * 60


@dataclass(frozen=True, slots=True)
class Change:
    """What became of a file: where it is now, None where it was removed; the commit, and when that was made, in seconds
    since the epoch."""

    path: str | None
    commit: str
    when: int

    def told(self, now: str | None) -> str:
        """What became of it, for a message: `; renamed to 'now' in 3f2a91c (12 days ago)`; None where it is gone."""
        days = int(time.time() - self.when) // _DAY
        ago = "today" if days < 1 else f"{days} day{'s' if days > 1 else ''} ago"
        what = f"renamed to '{now}'" if now is not None else "removed"
        return f"; {what} in {self.commit} ({ago})"


class _Changes(NamedTuple):
    """Those of a repository by the full path that a file had, the last one first; and the paths by their last part."""

    by_path: Mapping[str, Change]
    by_name: Mapping[str, Sequence[str]]


def formerly(disk: Disk, path: str) -> Change | None:
    """What became of the file that was at `path`, as far as its repository tells."""
    top = _top_of(disk, os.path.dirname(path))
    changes = _changes_of(disk, top).by_path if top is not None else {}
    change = changes.get(path)
    for _ in range(_MOST_RENAMES):
        if change is None or change.path is None or disk.exists(change.path):
            return change
        later = changes.get(change.path)
        change = Change(later.path, change.commit, change.when) if later is not None else None
    return None


def formerly_named(disk: Disk, folder: str, name: str) -> Iterator[tuple[str, Change]]:
    """The paths of all files of that name that were in the repository around a folder, with what became of each."""
    top = _top_of(disk, folder)
    for path in _changes_of(disk, top).by_name.get(name, ()) if top is not None else ():
        change = formerly(disk, path) if not disk.exists(path) else None
        if change is not None:
            yield path, change


def _top_of(disk: Disk, folder: str) -> str | None:
    while not disk.exists(os.path.join(folder, ".git")):
        parent = os.path.dirname(folder)
        if parent == folder:
            return None
        folder = parent
    return folder


def _changes_of(disk: Disk, top: str) -> _Changes:
    commit = _checked_out(disk, top)
    return _changes(disk.db, top, commit) if commit is not None else _Changes({}, {})


def _checked_out(disk: Disk, top: str) -> str | None:
    """The commit that is checked out (gitrepository-layout(5))."""
    try:
        own, shared = folders_of(top)
    except GitError:
        return None
    head = _line(disk, os.path.join(own, "HEAD"))
    named = _HEAD.fullmatch(head)
    if named is not None:
        head = _line(disk, os.path.join(shared, named[1]))
        if not head:
            packed = disk.text(os.path.join(shared, "packed-refs"))
            lines = packed.text.splitlines() if isinstance(packed, Document) else []
            head = next((line.split()[0] for line in lines if line.endswith(f" {named[1]}")), "")
    return head if _COMMIT.fullmatch(head) else None


def _line(disk: Disk, path: str) -> str:
    document = disk.text(path)
    return document.text.strip() if isinstance(document, Document) else ""


def _read_changes(top: str, commit: str) -> _Changes:
    """Of several changes of one path the last one counts."""
    arguments = ("--no-show-signature", "--no-color", "--no-ext-diff", "--no-textconv", "--diff-filter=RD")
    limits = ("--find-renames", f"-l{_MOST_COMPARED}", "-n", str(_MOST_COMMITS))
    try:
        with open_repository(top) as repository:
            said = repository.ask(
                "log",
                "-z",
                *arguments,
                *limits,
                "--name-status",
                f"--format={_BEGIN}%h %ct",
                commit,
                "--",
                seconds=_SECONDS,
            )
    except GitError:
        return _Changes({}, {})
    found: dict[str, Change] = {}
    words = iter(os.fsdecode(said).replace("\0\n", "\0").split("\0"))
    short, when = "", 0
    for word in words:
        if word.startswith(_BEGIN):
            short, _, seconds = word[1:].partition(" ")
            when = int(seconds) if seconds.isdecimal() else 0
        elif word.startswith("R"):
            old, new = next(words, ""), next(words, "")
            found.setdefault(os.path.join(top, old), Change(os.path.join(top, new), short, when))
        elif word == "D":
            found.setdefault(os.path.join(top, next(words, "")), Change(None, short, when))
    by_name: dict[str, list[str]] = {}
    for path in found:
        by_name.setdefault(os.path.basename(path), []).append(path)
    return _Changes(found, by_name)


_changes = Input(_read_changes)
