"""Texts of files, open editor buffers over the disk, each parsed once for each content."""

from __future__ import annotations

import os
import threading
from dataclasses import dataclass, field

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.hash_comments import HASH_SUFFIXES, preflight_comments
from preflight_analysis.documents.reading import SIZE_LIMIT, Text, Unreadable, digest, read_text
from preflight_analysis.documents.span import LineIndex
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.read import read_launch


@dataclass(slots=True)
class _Entry:
    """What is known of one path. `signature` says of which state of the file; open buffers have none."""

    signature: object
    text: Text | Unreadable
    parsed: dict[str, Document | LaunchFile] = field(default_factory=dict)
    parsing: threading.Lock = field(default_factory=threading.Lock)
    """Held while a launch file is parsed: who else needs it had better wait than do the same work at the same time."""


class Sources:
    """Implements `evaluation.files.Files`. Thread-safe; nothing raises."""

    def __init__(self) -> None:
        self._lock = threading.RLock()
        self._open: dict[str, _Entry] = {}
        self._disk: dict[str, _Entry] = {}
        self.undecided = 1
        """The generation of ROS that a launch file is of which shows none: that of the environment."""

    def open(self, path: str, text: str) -> None:
        """The editor's text counts from now on; call it again for each change."""
        entry = _Entry(None, _limited(path, text))
        with self._lock:
            self._open[os.path.normpath(path)] = entry

    def close(self, path: str) -> None:
        """The disk counts again."""
        with self._lock:
            self._open.pop(os.path.normpath(path), None)

    def digest(self, path: str) -> str:
        """Names the content as it is now; "" where there is no such file."""
        entry = self._entry(path)
        if isinstance(entry.text, Text):
            return entry.text.digest
        return "" if entry.text.kind == "missing" else digest(repr(entry.signature))

    def launch_file(self, path: str, generation: int | None = None) -> LaunchFile | Unreadable:
        """The launch file at `path`, read as that generation of ROS reads it; None: as the file looks."""
        entry = self._entry(path)
        if isinstance(entry.text, Unreadable):
            return entry.text
        with entry.parsing:
            as_it_looks = f"launch, else {self.undecided}"
            found = entry.parsed.get(as_it_looks)
            if not isinstance(found, LaunchFile):
                found = entry.parsed[as_it_looks] = read_launch(entry.text, undecided=self.undecided)
            if generation not in (None, found.generation):
                found = entry.parsed.get(f"launch {generation}")
                if not isinstance(found, LaunchFile):
                    found = entry.parsed[f"launch {generation}"] = read_launch(entry.text, generation)
        return found

    def text(self, path: str) -> Document | Unreadable:
        """Any text file, not parsed. As roslaunch reads it: in UTF-8, whatever an XML declaration or a mark say."""
        entry = self._entry(path)
        if isinstance(entry.text, Unreadable):
            return entry.text
        found = entry.parsed.get("text")
        if not isinstance(found, Document):
            text = entry.text if entry.text.plain else self._plain(path)
            if isinstance(text, Unreadable):
                return text
            lines = LineIndex(text.text)
            comments = preflight_comments(text.text, lines) if path.endswith(HASH_SUFFIXES) else ()
            found = Document(path, text.text, text.digest, comments, (), lines)
            entry.parsed["text"] = found
        return found

    def _plain(self, path: str) -> Text | Unreadable:
        content = self.data(path)
        if isinstance(content, Unreadable):
            return content
        try:
            text = content.decode()
        except UnicodeDecodeError as error:
            return Unreadable(path, f"is not a text file in UTF-8 (byte {error.start})", "not-text")
        return Text(path, text, digest(text))

    def data(self, path: str) -> bytes | Unreadable:
        """The bytes of a regular file of bounded size."""
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

    def _entry(self, path: str) -> _Entry:
        path = os.path.normpath(path)
        with self._lock:
            opened = self._open.get(path)
            if opened is not None:
                return opened
            signature = _signature(path)
            entry = self._disk.get(path)
            if entry is None or entry.signature != signature:
                entry = self._disk[path] = _Entry(signature, read_text(path))
            return entry


def _limited(path: str, text: str) -> Text | Unreadable:
    # A code point takes at least one byte, so a text within the limit may still be a file beyond it: no harm.
    if len(text) > SIZE_LIMIT:
        limit = SIZE_LIMIT // (1024 * 1024)
        reason = f"is {len(text) / 1e6:.1f} MB; files above {limit} MiB are not analysed"
        return Unreadable(path, reason, "not-text")
    if "\0" in text:
        return Unreadable(path, "is not a text file", "not-text")
    return Text(path, text, digest(text), encoding=None)


def _signature(path: str) -> object:
    try:
        status = os.stat(path)
    except (OSError, ValueError):
        return None
    return status.st_mtime_ns, status.st_size, status.st_ino, status.st_mode
