"""Files to text: regular files of bounded size, decoded as their first bytes say, and a reason where that fails."""

from __future__ import annotations

import codecs
import hashlib
import os
import re
import stat
from dataclasses import field
from typing import Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import LineIndex, version

SIZE_LIMIT = 4 * 1024 * 1024
"""In bytes. The largest launch file of some 3,400 public ones is 200 times smaller."""
BEGINNING = 4096
"""Bytes by which the kind of a document is known."""

_DECLARED_ENCODING = re.compile(rb"""<\?xml\b[^>]{0,200}?\bencoding[ \t\r\n]*=[ \t\r\n]*["']([A-Za-z0-9._:-]+)["']""")
_KNOWN_ENCODINGS = re.compile(
    r"ascii|utf-8(?:-sig)?|iso8859-\d+|cp\d+|koi8-[rtu]|mac-[a-z0-9]+|hp-roman8|kz1048|ptcp154|tis-620|palmos"
    r"|gb\w+|big5\w*|euc-\w+|shift-jis\w*|johab|iso2022-\w+"
)
"""Names of the codecs that a declaration may choose: one byte for a character, which is what expat takes of Python, and
the usual ones of East Asia. The others are no encodings of files, and some (`punycode`) take a time that grows with the
square of the length."""
_BYTE_ORDER_MARKS = (
    (codecs.BOM_UTF8, "utf-8"),
    (codecs.BOM_UTF32_LE, "utf-32-le"),  # before UTF-16, whose mark it starts with
    (codecs.BOM_UTF32_BE, "utf-32-be"),
    (codecs.BOM_UTF16_LE, "utf-16-le"),
    (codecs.BOM_UTF16_BE, "utf-16-be"),
)


@dataclass(frozen=True, slots=True)
class Text:
    """What a file holds, line ends as they are. `digest` names the text (not the bytes, nor the path)."""

    path: str
    text: str
    digest: str
    lines: LineIndex = field(repr=False)
    """Those of all that is read from it."""
    plain: bool = True
    """Whether it is UTF-8 without a mark and says nothing else: what a program that knows nothing of XML reads."""
    encoding: str | None = "utf-8"
    """Of the file; None where an editor has decoded it."""

    @classmethod
    def of(cls, path: str, text: str) -> Text:
        """A text by itself."""
        return cls(path, text, digest(text), LineIndex(text))

    @property
    def version(self) -> str:
        """Names text and lines: while it is the same, locations in the file are right."""
        return version(self.digest, self.lines)


@dataclass(frozen=True, slots=True)
class Unreadable:
    """Why there is no text. `reason` goes on from the file's name: "x.launch " + "is a folder".

    `kind`: nothing is there; it cannot be read; it can, and is not text that we analyse; or it is not read, as it is
    a secret or out of reach (`secrets.py`).
    """

    path: str
    reason: str
    kind: Literal["missing", "unreadable", "not-text", "withheld"]


def digest(content: str | bytes) -> str:
    """The name of a content: equal digests mean equal contents. 40 hexadecimal digits."""
    data = content.encode("utf-8", "surrogatepass") if isinstance(content, str) else content
    return hashlib.blake2b(data, digest_size=20).hexdigest()


def read_text(path: str) -> Text | Unreadable:
    """Read a file whole. Never raises, and never waits for a FIFO, a device or a terminal.

    The encoding is that of the byte order mark, else the one that an XML declaration names, else UTF-8.
    """
    data = _read(path, SIZE_LIMIT + 1)
    if isinstance(data, Unreadable):
        return data
    if len(data) > SIZE_LIMIT:
        return _too_large(path, len(data))
    return _decode(path, data)


def read_beginning(path: str) -> str:
    """The first `BEGINNING` bytes of a file as text, whatever in them is none left out; "" where it cannot be read."""
    data = _read(path, BEGINNING)
    if isinstance(data, Unreadable):
        return ""
    encoding, data, _ = _marked(data)
    return data.decode(encoding, "ignore")


def _read(path: str, most: int) -> bytes | Unreadable:
    try:
        # Before the open: opening some devices has an effect.
        if refused := _refuse(path, os.stat(path)):
            return refused
        descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC | os.O_NOCTTY)
        with open(descriptor, "rb") as file:
            # Again, of what was really opened: the file may have been replaced in between.
            return _refuse(path, os.fstat(descriptor)) or file.read(most)
    except (FileNotFoundError, NotADirectoryError):
        return Unreadable(path, "does not exist", "missing")
    except PermissionError:
        return Unreadable(path, "cannot be read: no permission to read it", "unreadable")
    except OSError as error:
        return Unreadable(path, f"cannot be read: {(error.strerror or str(error)).lower()}", "unreadable")
    except ValueError:  # a NUL or a lone surrogate in the path
        return Unreadable(path, "does not exist: no file can have this name", "missing")


def _refuse(path: str, status: os.stat_result) -> Unreadable | None:
    if stat.S_ISDIR(status.st_mode):
        return Unreadable(path, "is a folder", "unreadable")
    if not stat.S_ISREG(status.st_mode):
        return Unreadable(path, "is not a regular file", "unreadable")
    if status.st_size > SIZE_LIMIT:
        return _too_large(path, status.st_size)
    return None


def _too_large(path: str, size: int) -> Unreadable:
    limit = SIZE_LIMIT // (1024 * 1024)
    return Unreadable(path, f"is {size / 1e6:.1f} MB; files above {limit} MiB are not analysed", "not-text")


def _marked(data: bytes) -> tuple[str, bytes, bool]:
    """The encoding that the first bytes show, what follows these, and whether they show one."""
    for mark, name in _BYTE_ORDER_MARKS:
        if data.startswith(mark):
            return name, data[len(mark) :], True
    if data.startswith((b"<\0", b"\0<")):  # UTF-16 without a mark: XML parsers know it by its first letter
        return "utf-16-le" if data[0] else "utf-16-be", data, True
    return "utf-8", data, False


def _decode(path: str, data: bytes) -> Text | Unreadable:
    declared = False
    encoding, data, marked = _marked(data)
    found = _DECLARED_ENCODING.match(data) if not marked else None
    if found is not None and not found[1].lower().startswith((b"utf-16", b"utf-32")):
        encoding, declared = found[1].decode("ascii"), True
    if encoding.lower().replace("_", "-") in {"utf-8", "utf8"} and b"\0" in data:
        return Unreadable(path, "is not a text file", "not-text")
    try:
        if declared and not _KNOWN_ENCODINGS.fullmatch(codecs.lookup(encoding).name.lower().replace("_", "-")):
            raise LookupError(encoding)
        text = data.decode(encoding)
    except LookupError:
        return Unreadable(path, f"declares the encoding {encoding!r}, which is not known", "not-text")
    except UnicodeDecodeError as error:
        if declared:
            return Unreadable(path, f"declares the encoding {encoding!r} and is not written in it", "not-text")
        line = data.count(b"\n", 0, error.start) + 1
        what = f"byte 0x{data[error.start]:02x} in line {line}"
        return Unreadable(path, f"is not a text file in {encoding.upper()} ({what})", "not-text")
    if "\0" in text:
        return Unreadable(path, "is not a text file", "not-text")
    return Text(path, text, digest(text), LineIndex(text), not marked and not declared, encoding)
