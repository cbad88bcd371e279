"""What goes to standard output."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from typing import Any

from preflight_analysis.evaluation.tree_json import dumps


def print_json(data: Mapping[str, Any], *, indent: int | None = 2) -> None:
    """A JSON document and a newline."""
    print_text(dumps_json(data, indent=indent))


def dumps_json(data: Mapping[str, Any], *, indent: int | None = 2) -> str:
    """A JSON document with sorted keys, and a newline."""
    return dumps(data, indent=indent) + "\n"


def print_text(text: str) -> None:
    """Text as it is, whatever the terminal's encoding can show of it."""
    stream = sys.stdout
    try:
        stream.write(text)
    except UnicodeEncodeError:
        stream.write(text.encode(stream.encoding, "replace").decode(stream.encoding))


def colours() -> bool:
    """Whether standard output shows colours, and its reader wants them (https://no-color.org)."""
    return sys.stdout.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"


def say(text: str) -> None:
    """A line on standard error."""
    print(text, file=sys.stderr)
