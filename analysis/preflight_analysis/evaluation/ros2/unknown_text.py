"""Texts that are not known, in what a run of a Python launch file is given and answers: those of
`tracing/agents/anything.py`, which stay so in every text that the file makes of them."""

from __future__ import annotations

import re

BEGIN, END = "\ufdd0", "\ufdd1"
_DIGITS = "".join(map(chr, range(0xFDD2, 0xFDE2)))
"""What the name is written with: whatever a program cuts out of a mark is known to be a part of one."""
_ENCODED, _DECODED = str.maketrans("0123456789abcdef", _DIGITS), str.maketrans(_DIGITS, "0123456789abcdef")
_MARKS = re.compile("[\ufdd0-\ufdef]+")
_MARK = re.compile(f"{BEGIN}((?:[{_DIGITS}]{{2}})+){END}")
_LOST = "..."
"""What stands for a mark of which only some is left."""


def unknown_text(name: str) -> str:
    """What stands for a text that is not known, by a name for it."""
    return f"{BEGIN}{name.encode('utf-8', 'surrogatepass').hex().translate(_ENCODED)}{END}"


def is_unknown(value: object) -> bool:
    """Whether it is a text of which some is not known."""
    return isinstance(value, str) and not value.isascii() and _MARKS.search(value) is not None


def readable(text: str) -> str:
    """For people: with the names in place of what is not known."""
    return text if text.isascii() else _MARKS.sub(lambda found: f"<{_names(found[0])}>", text)


def _names(marks: str) -> str:
    names = (bytes.fromhex(each.translate(_DECODED)).decode("utf-8", "replace") for each in _MARK.findall(marks))
    return " ".join(names) or _LOST
