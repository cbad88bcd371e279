"""Texts of files, open editor buffers over the disk, each parsed once for each content."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import replace
from typing import TypeVar

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.hash_comments import HASH_SUFFIXES, preflight_comments
from preflight_analysis.documents.reading import SIZE_LIMIT, Text, Unreadable, digest, read_text
from preflight_analysis.documents.span import LineIndex
from preflight_analysis.evaluation.reading import read_launch
from preflight_analysis.incremental.database import Cancelled, Database, Input, query
from preflight_analysis.launch.model import LaunchFile

T = TypeVar("T")
_TRIES = 3
"""A file that is being written all the time is looked at so often, and then again when somebody asks."""
Signature = tuple[int, int, int, int]
"""What tells one state of a file on the disk from the next: time, size, inode and mode."""


def _signature(path: str) -> Signature | None:
    try:
        status = os.stat(path)
    except (OSError, ValueError):
        return None
    return status.st_mtime_ns, status.st_size, status.st_ino, status.st_mode


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


def _undecided() -> int:
    return 1


SIGNATURE = Input(_signature)
BUFFER = Input(_buffer)
"""What an editor has of a file; None where none has it open."""
LINES = Input(_lines)
"""By which locations stay right, and equal to what they were, where other lines of their file come or go."""
UNDECIDED = Input(_undecided)
"""The generation of ROS that a launch file is of which shows none."""


@query
def text_of(db: Database, path: str) -> Text | Unreadable:
    """What a file holds."""
    opened = BUFFER(db, path)
    if opened is None:
        SIGNATURE(db, path)
        found = read_text(path)
        return replace(found, lines=LINES(db, path).of(found.text)) if isinstance(found, Text) else found
    return opened


@query
def digest_of(db: Database, path: str) -> str:
    """Names the content of a file and its lines; "" where there is none."""
    text = text_of(db, path)
    if isinstance(text, Text):
        return text.version
    return "" if text.kind == "missing" else digest(repr(SIGNATURE(db, path)))


@query
def launch_file_of(db: Database, path: str, generation: int | None) -> LaunchFile | Unreadable:
    """The launch file at `path`, read as that generation of ROS reads it; None: as the file looks."""
    text = text_of(db, path)
    if isinstance(text, Unreadable):
        return text
    if generation is None:
        return read_launch(text, undecided=UNDECIDED(db))
    looks = launch_file_of(db, path, None)
    return (
        looks if not isinstance(looks, Unreadable) and looks.generation == generation else read_launch(text, generation)
    )


@query
def document_of(db: Database, path: str) -> Document | Unreadable:
    """Any text file, not parsed. As roslaunch reads it: in UTF-8, whatever an XML declaration or a mark say."""
    text = text_of(db, path)
    if isinstance(text, Text) and not text.plain:
        text = _plain(path, data_of(db, path))
    if isinstance(text, Unreadable):
        return text
    comments = preflight_comments(text.text, text.lines) if path.endswith(HASH_SUFFIXES) else ()
    return Document(path, text.text, text.digest, comments, (), text.lines)


def data_of(db: Database, path: str) -> bytes | Unreadable:
    """The bytes of a regular file of bounded size, as it is on the disk. Not remembered."""
    SIGNATURE(db, path)
    try:
        if not os.path.isfile(path):
            exists = os.path.exists(path)
            reason = "is not a regular file" if exists else "does not exist"
            return Unreadable(path, reason, "unreadable" if exists else "missing")
        with open(path, "rb") as file:
            content = file.read(SIZE_LIMIT + 1)
    except (OSError, ValueError) as error:
        return Unreadable(path, f"cannot be read: {error}", "unreadable")
    if len(content) > SIZE_LIMIT:
        return Unreadable(path, "is too large to be read here", "unreadable")
    return content


def _plain(path: str, content: bytes | Unreadable) -> Text | Unreadable:
    if isinstance(content, Unreadable):
        return content
    try:
        text = content.decode()
    except UnicodeDecodeError as error:
        return Unreadable(path, f"is not a text file in UTF-8 (byte {error.start})", "not-text")
    return Text.of(path, text)


class Sources:
    """Implements `evaluation.files.Files` with the texts of a database. Thread-safe; nothing raises.

    Whoever asks from within a query gets what was found on the disk when it was last looked at (`look`), all others
    what is there now.
    """

    def __init__(self) -> None:
        self.db = Database()

    @property
    def undecided(self) -> int:
        """The generation of ROS that a launch file is of which shows none: that of the environment."""
        return UNDECIDED(self.db)

    @undecided.setter
    def undecided(self, generation: int) -> None:
        with self.db.writing() as write:
            write.set(UNDECIDED, generation, durable=True)

    def open(self, path: str, text: str) -> None:
        """The editor's text counts from now on; call it again for each change."""
        path = os.path.normpath(path)
        lines = LINES(self.db, path)
        with self.db.writing() as write:
            write.set(BUFFER, _limited(path, text, lines), path)

    def close(self, path: str) -> None:
        """The disk counts again."""
        path = os.path.normpath(path)
        with self.db.writing() as write:
            write.reload(BUFFER, path)
        self.look([path])

    def look(self, paths: Iterable[str]) -> bool:
        """Notice what has changed on the disk of these files; whether anything has."""
        outdated = self.db.outdated(SIGNATURE, ((path,) for path in paths))
        if outdated:
            with self.db.writing() as write:
                for key in outdated:
                    write.reload(SIGNATURE, *key)
        return bool(outdated)

    def in_one_revision(self, work: Callable[[], T], files: Callable[[T], Iterable[str]], likely: Iterable[str]) -> T:
        """What `work` gives while no text changes, with the files that it read, `files(result)`, as they are on the
        disk now. It begins again where one changes meanwhile; `likely` are those that it probably reads."""
        self.look(likely)
        for _ in range(_TRIES):
            while True:
                with suppress(Cancelled), self.db.reading():
                    result = work()
                    break
            if not self.look(files(result)):
                break
        return result

    def digest(self, path: str) -> str:
        """Names the content as it is now, and its lines: while it is the same, locations in the file are right. ""
        where there is no such file."""
        return digest_of(self.db, self._looked_at(path))

    def launch_file(self, path: str, generation: int | None = None) -> LaunchFile | Unreadable:
        """The launch file at `path`, read as that generation of ROS reads it; None: as the file looks."""
        return launch_file_of(self.db, self._looked_at(path), generation)

    def text(self, path: str) -> Document | Unreadable:
        """Any text file, not parsed."""
        return document_of(self.db, self._looked_at(path))

    def data(self, path: str) -> bytes | Unreadable:
        """The bytes of a regular file of bounded size."""
        return data_of(self.db, self._looked_at(path))

    def _looked_at(self, path: str) -> str:
        path = os.path.normpath(path)
        if not self.db.is_reading:
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
