"""The disk as it was when it was last looked at, with open editor buffers over it.

What is derived of files asks here, by the inputs and queries of `incremental/database.py`: so it is known what of the
disk it depends on, existence and listings included. `Disk` is the way in for all who are no query themselves.
"""

from __future__ import annotations

import os
import stat
import time
from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.hash_comments import has_hash_comments, preflight_comments
from preflight_analysis.documents.reading import (
    BEGINNING,
    SIZE_LIMIT,
    Text,
    Unreadable,
    digest,
    read_beginning,
    read_text,
)
from preflight_analysis.documents.secrets import Access, has_private_key
from preflight_analysis.documents.span import LineIndex
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import Input, query

Status = tuple[int, int, int, int, int]
"""What tells one state of a file from the next: time of the last change, size, inode, mode, and when it was looked at
where it had changed so shortly before that the next change may not show."""
_MODE = 3
_HIDDEN: Status = (0, 0, 0, 0, 0)
"""What lies in a folder that is shut to the user, if it is there: nobody can say that it is missing."""
_TICK = 50_000_000
"""Nanoseconds in which a file system may give two changes the same time."""


def _status(path: str) -> Status | None:
    try:
        found = os.stat(path)
    except PermissionError:
        return _HIDDEN
    except (OSError, ValueError):
        return None
    now = time.time_ns()
    seen = now if now - found.st_mtime_ns < _TICK else 0
    return found.st_mtime_ns, found.st_size, found.st_ino, found.st_mode, seen


def _seen(value: Status | str | None) -> object:
    """Without when it was looked at."""
    return value[: _MODE + 1] if isinstance(value, tuple) else value


def _real_path(path: str) -> str:
    try:
        return os.path.realpath(path)
    except (OSError, ValueError):
        return path


def _buffer(path: str) -> Text | Unreadable | None:
    return None


class _Lines:
    """The lines of the text of a file that was there last."""

    def __init__(self) -> None:
        self._lines: LineIndex | None = None

    def of(self, text: str) -> LineIndex:
        """The lines of the text that is there now."""
        self._lines = LineIndex(text) if self._lines is None else self._lines.edited(text)
        return self._lines


def _lines(path: str) -> _Lines:
    return _Lines()


def _access() -> Access:
    return Access()


STATUS = Input(_status)
"""Of the file or folder that a path leads to; None where it leads nowhere."""
REAL_PATH = Input(_real_path)
BUFFER = Input(_buffer)
"""What an editor has of a file; None where none has it open."""
LINES = Input(_lines)
"""By which locations stay right, and equal to what they were, where other lines of their file come or go."""
ACCESS = Input(_access)
"""What may be read for the workspace."""
_OF_DISK: tuple[Input[[str], Any], ...] = (STATUS, REAL_PATH)


@query
def mode_of(db: Database, path: str) -> int | None:
    """The mode of a file or folder, as `stat` gives it; None where there is none."""
    status = STATUS(db, path)
    return status[_MODE] if status is not None else None


@query
def names_in(db: Database, folder: str) -> tuple[str, ...]:
    """The names of what is in a folder, sorted; none where it cannot be read."""
    STATUS(db, folder)  # its time changes as something in it comes or goes
    try:
        return tuple(sorted(os.listdir(folder)))
    except (OSError, ValueError):
        return ()


@query
def refusal_of(db: Database, path: str) -> str | None:
    """Why a file that is there is not read, as `Access` has it. What the user has open is in reach."""
    if STATUS(db, path) is None:
        return None
    access = ACCESS(db)
    return access.refusal(path) or (access.out_of_reach(path) if BUFFER(db, path) is None else None)


@query
def text_of(db: Database, path: str) -> Text | Unreadable:
    """What a file holds. That of a secret is not read, whoever asks, nor taken from an editor."""
    refusal = refusal_of(db, path)
    if refusal is not None:
        return Unreadable(path, refusal, "withheld")
    found = BUFFER(db, path)
    if found is None:
        STATUS(db, path)
        found = read_text(path)
        if isinstance(found, Text):
            found = replace(found, lines=LINES(db, path).of(found.text))
    if isinstance(found, Text) and has_private_key(path, found.text):
        refusal = ACCESS(db).refusal_of_content(path)
    return found if refusal is None else Unreadable(path, refusal, "withheld")


@query
def beginning_of(db: Database, path: str) -> str:
    """The first kilobytes of a file, as text; "" where it cannot be read, or is a secret."""
    if refusal_of(db, path) is not None:
        return ""
    opened = BUFFER(db, path)
    if opened is None:
        STATUS(db, path)
        return read_beginning(path)
    return opened.text[:BEGINNING] if isinstance(opened, Text) else ""


@query
def digest_of(db: Database, path: str) -> str:
    """Names the content of a file and its lines; "" where there is none."""
    text = text_of(db, path)
    if isinstance(text, Text):
        return text.version
    return "" if text.kind == "missing" else digest(repr(_seen(STATUS(db, path))))


@query
def document_of(db: Database, path: str) -> Document | Unreadable:
    """Any text file, not parsed. As roslaunch reads it: in UTF-8, whatever an XML declaration or a mark say."""
    text = text_of(db, path)
    if isinstance(text, Text) and not text.plain:
        text = _plain(path, data_of(db, path))
    if isinstance(text, Unreadable):
        return text
    comments = preflight_comments(text.text, text.lines) if has_hash_comments(path, text.text) else ()
    return Document(path, text.text, text.digest, comments, (), text.lines)


def data_of(db: Database, path: str) -> bytes | Unreadable:
    """The bytes of a regular file of bounded size, as it is on the disk. Not remembered."""
    mode = mode_of(db, path)
    if mode is None or not stat.S_ISREG(mode):
        reason, kind = ("does not exist", "missing") if mode is None else ("is not a regular file", "unreadable")
        return Unreadable(path, reason, "missing" if kind == "missing" else "unreadable")
    refusal = refusal_of(db, path)
    if refusal is not None:
        return Unreadable(path, refusal, "withheld")
    STATUS(db, path)
    try:
        with open(path, "rb") as file:
            content = file.read(SIZE_LIMIT + 1)
    except (OSError, ValueError) as error:
        return Unreadable(path, f"cannot be read: {error}", "unreadable")
    if len(content) > SIZE_LIMIT:
        return Unreadable(path, "is too large to be read here", "unreadable")
    refusal = ACCESS(db).refusal_of_content(path) if has_private_key(path, content) else None
    return content if refusal is None else Unreadable(path, refusal, "withheld")


def _plain(path: str, content: bytes | Unreadable) -> Text | Unreadable:
    if isinstance(content, Unreadable):
        return content
    try:
        text = content.decode()
    except UnicodeDecodeError as error:
        return Unreadable(path, f"is not a text file in UTF-8 (byte {error.start})", "not-text")
    return Text.of(path, text)


class Disk:
    """Thread-safe; nothing raises. Paths are absolute.

    Whoever asks from within a query gets what was found when it was last looked (`look`), all others what is there now.
    """

    def __init__(self, db: Database | None = None) -> None:
        self.db = db or Database()

    @property
    def access(self) -> Access:
        """What may be read."""
        return ACCESS(self.db)

    @access.setter
    def access(self, access: Access) -> None:
        if self.access != access:
            with self.db.writing() as write:
                write.set(ACCESS, access, durable=True)

    def open(self, path: str, text: str) -> None:
        """The editor's text counts from now on; call it again for each change."""
        self.take({path: text})

    def close(self, path: str) -> None:
        """The disk counts again."""
        self.take({path: None})

    def take(self, texts: Mapping[str, str | None]) -> None:
        """The same for several files in one write; None where the disk counts again. Waits until readers have left."""
        buffers = {os.path.normpath(path): text for path, text in texts.items()}
        lines = {path: LINES(self.db, path) for path, text in buffers.items() if text is not None}
        with self.db.writing() as write:
            for path, text in buffers.items():
                if text is None:
                    write.reload(BUFFER, path)
                else:
                    write.set(BUFFER, _limited(path, text, lines[path]), path)
        self.look(path for path, text in buffers.items() if text is None)

    def look(self, paths: Iterable[str] | None = None) -> bool:
        """Notice what has changed of these paths, None: of all that was ever asked for; whether anything has."""
        keys = None if paths is None else [(path,) for path in paths]
        outdated = [(kind, key) for kind in _OF_DISK for key in self.db.outdated(kind, keys)]
        changed = False
        if outdated:
            with self.db.writing() as write:
                for kind, key in outdated:
                    before = write.get(kind, *key)
                    write.reload(kind, *key)
                    changed |= _seen(before) != _seen(write.get(kind, *key))
        return changed

    def exists(self, path: str) -> bool:
        """Whether there is anything, or may be, as a folder on the way is shut to the user."""
        return mode_of(self.db, self._looked_at(path)) is not None

    def is_file(self, path: str) -> bool:
        """Whether it is a regular file."""
        mode = mode_of(self.db, self._looked_at(path))
        return mode is not None and stat.S_ISREG(mode)

    def is_folder(self, path: str) -> bool:
        """Whether it is a folder."""
        mode = mode_of(self.db, self._looked_at(path))
        return mode is not None and stat.S_ISDIR(mode)

    def is_program(self, path: str) -> bool:
        """Whether it is a regular file that somebody may execute."""
        mode = mode_of(self.db, self._looked_at(path))
        return mode is not None and stat.S_ISREG(mode) and mode & 0o111 != 0

    def is_link(self, path: str) -> bool:
        """Whether the last part of the path is a link."""
        folder, name = os.path.split(path)
        return self.real_path(path) != os.path.join(self.real_path(folder), name)

    def mode(self, path: str) -> int | None:
        """As `stat` gives it; None where there is nothing."""
        return mode_of(self.db, self._looked_at(path))

    def names(self, folder: str) -> tuple[str, ...]:
        """The names of what is in a folder, sorted; none where it cannot be read."""
        return names_in(self.db, self._looked_at(folder))

    def real_path(self, path: str) -> str:
        """The path without links."""
        return REAL_PATH(self.db, self._looked_at(path))

    def digest(self, path: str) -> str:
        """Names the content as it is now, and its lines: while it is the same, locations in the file are right. ""
        where there is no such file."""
        return digest_of(self.db, self._looked_at(os.path.normpath(path)))

    def text(self, path: str) -> Document | Unreadable:
        """Any text file, not parsed."""
        return document_of(self.db, self._looked_at(os.path.normpath(path)))

    def content(self, path: str) -> str | None:
        """The text of a file; None where there is none that can be read."""
        found = self.text(path)
        return found.text if isinstance(found, Document) else None

    def data(self, path: str) -> bytes | Unreadable:
        """The bytes of a regular file of bounded size."""
        return data_of(self.db, self._looked_at(os.path.normpath(path)))

    def _looked_at(self, path: str) -> str:
        if not self.db.is_reading and any(self.db.is_outdated(kind, path) for kind in _OF_DISK):
            self.look([path])
        return path


def _limited(path: str, text: str, lines: _Lines) -> Text | Unreadable:
    # A code point takes at least one byte, so a text within the limit may still be a file beyond it: no harm.
    if len(text) > SIZE_LIMIT:
        limit = SIZE_LIMIT // (1024 * 1024)
        reason = f"is {len(text) / 1e6:.1f} MB; files above {limit} MiB are not analysed"
        return Unreadable(path, reason, "not-text")
    if "\0" in text:
        return Unreadable(path, "is not a text file", "not-text")
    return Text(path, text, digest(text), lines.of(text), encoding=None)
