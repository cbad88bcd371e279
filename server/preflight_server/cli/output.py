"""The only way to standard output and standard error: what is printed may come from files, nodes and networks that are
not trusted, and must not drive the terminal."""

from __future__ import annotations

import logging
import os
import re
import sys
from collections.abc import Mapping, Sequence
from typing import Any

from preflight_analysis.documents.json_text import dumps
from preflight_analysis.findings.failure import Failure
from preflight_analysis.findings.printable import printable
from preflight_analysis.findings.report import failure_lines

_ESCAPED = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]|#(?=#\\[)")
"""What is escaped in JSON: it would drive a terminal, or be a command of GitHub's runner."""
_COMMAND = re.compile(r"^(\s*:)(?=:)|(#)(?=#\[)", re.MULTILINE)
"""What GitHub's runner takes for a command, in whatever a step prints: `::error file=...` at the start of a line,
`##[error]` anywhere (https://github.com/actions/runner, ActionCommand.cs)."""
_PAINT = re.compile(r"(\x1b\[[0-9;]*[mJH]|\x1b\]8;;(?:file://[!-~]*)?\x1b\\)")
"""Colours, an empty screen, and links to files (OSC 8)."""


def _no_command(text: str) -> str:
    return _COMMAND.sub(lambda found: f"{found[0]} ", text)


def print_json(data: Mapping[str, Any] | list[dict[str, Any]], *, indent: int | None = 2) -> None:
    """A JSON document and a newline."""
    print_text(dumps_json(data, indent=indent))


def dumps_json(data: Mapping[str, Any] | list[dict[str, Any]], *, indent: int | None = 2) -> str:
    """A JSON document with sorted keys, and a newline. What would drive a terminal is escaped as JSON has it."""
    return _ESCAPED.sub(lambda found: f"\\u{ord(found[0]):04x}", dumps(data, indent=indent)) + "\n"


def print_text(text: str, *, painted: bool = False, commands: bool = False) -> None:
    """Text for reading, whatever the terminal's encoding can show of it. `painted`: what paints it is meant to be
    there; `commands`: so are commands of GitHub's runner."""
    parts = _PAINT.split(text) if painted else [text]
    text = "".join(part if index % 2 else printable(part, lines=True) for index, part in enumerate(parts))
    text = text if commands else _no_command(text)
    stream = sys.stdout
    try:
        stream.write(text)
    except UnicodeEncodeError:
        stream.write(text.encode(stream.encoding, "replace").decode(stream.encoding))


def print_patch(text: str) -> bool:
    """A patch as it is, so that it applies. False, and nothing is printed, if it has what would drive a terminal or
    GitHub's runner."""
    plain = text.replace("\r\n", "\n")
    if printable(plain, lines=True) != plain or _no_command(plain) != plain:
        return False
    sys.stdout.flush()
    sys.stdout.buffer.write(text.encode())
    return True


def colours() -> bool:
    """Whether standard output shows colours, and its reader wants them (https://no-color.org)."""
    return sys.stdout.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"


def links() -> str | None:
    """The name of this host, for links to its files, where standard output shows them (OSC 8); else None. A terminal
    that knows no links shows nothing of them, save those of Linux itself; `FORCE_HYPERLINK=0` switches them off."""
    shown = colours() and os.environ.get("TERM") != "linux" and os.environ.get("FORCE_HYPERLINK") != "0"
    return os.uname().nodename if shown else None


def say(text: str) -> None:
    """One line on standard error, whatever the text has of line breaks."""
    print(_no_command(printable(text)), file=sys.stderr)


def say_failures(failures: Sequence[Failure]) -> None:
    """The errors of ours that cost findings."""
    for line in failure_lines(failures, os.getcwd()):
        say(f"ros-preflight: {line}")


class LogFormatter(logging.Formatter):
    """What is logged, as lines on standard error."""

    def format(self, record: logging.LogRecord) -> str:
        """One record. The lines of a traceback are marked: none of them begins with what an exception says."""
        first, *more = printable(super().format(record), lines=True).splitlines() or [""]
        return _no_command("\n".join([first, *(f"| {line}" for line in more)]))
