"""Standard input as pygls reads it: headers that are right, and bodies of bounded length.

pygls takes any length for true, also one that no memory has, and reads a line of headers however long it is.
"""

from __future__ import annotations

import logging
import re
from collections.abc import Callable
from typing import BinaryIO

MOST_BYTES = 64 << 20
"""Of one message. Files of launch configurations are refused from a few megabytes on."""
_MOST_HEADERS = 64
_LONGEST_HEADER = 8192
_LENGTH = re.compile(rb"content-length[ \t]*:[ \t]*(\d{1,19})[ \t]*\r?\n", re.IGNORECASE)
_log = logging.getLogger(__name__)


class BadFrameError(Exception):
    """Why no further message can be read."""


class Frames:
    """A reader of messages with headers as LSP's base protocol has them. `refused` is called, in the thread that reads,
    with what is wrong with the headers of a message; the messages after it are read."""

    def __init__(self, stdin: BinaryIO, refused: Callable[[str], None]) -> None:
        self._stdin = stdin
        self._refused = refused
        self._canonical: list[bytes] = []

    def readline(self) -> bytes:
        """The next line of headers, nothing at the end. Raises `BadFrameError`."""
        if not self._canonical:
            length = self._next_length()
            if length is None:
                return b""
            self._canonical = [b"\r\n", b"Content-Length: %d\r\n" % length]
        return self._canonical.pop()

    def read(self, size: int) -> bytes:
        """The body."""
        return self._stdin.read(size)

    def _next_length(self) -> int | None:
        """That of the next body of which the headers say it; None at the end."""
        length: int | None = None
        skipped = False
        for _ in range(_MOST_HEADERS):
            line = self._stdin.readline(_LONGEST_HEADER + 1)
            if not line:
                return None
            if len(line) > _LONGEST_HEADER:
                raise BadFrameError(f"a line of headers has more than {_LONGEST_HEADER} bytes")
            # Behind a body that nobody knew the length of, the next headers begin within its last line.
            found = _LENGTH.search(line)
            if found is not None:
                length = int(found[1])
                if length > MOST_BYTES:
                    raise BadFrameError(f"a message of {length} bytes: there may be {MOST_BYTES}")
            elif line.strip():
                if line.lower().startswith(b"content-length") and not skipped:
                    self._refused("the Content-Length is not a number")
                    skipped = True
            elif length:
                return length
            elif length == 0:
                self._refused("the message is empty")
                length = None
            elif not skipped:
                self._refused("a message without Content-Length")
                skipped = True
        raise BadFrameError(f"more than {_MOST_HEADERS} lines without a message")
