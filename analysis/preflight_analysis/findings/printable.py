"""The one function that makes text from files, nodes and networks harmless where it is shown: in a terminal, a log, an
editor, a report.

Control characters drive terminals, characters of direction (UAX #9) show another text than there is
(https://trojansource.codes), others cannot be seen or said in UTF-8.
"""

from __future__ import annotations

import re

_PICTURES = 0x2400
"""U+2400 and the 32 after it show the control characters of ASCII."""
_UNSEEN = (
    "\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u180e\u200b\u200e\u200f\u2028-\u202e\u2060-\u2064\u2066-\u206f"
    "\ud800-\udfff\ufdd0-\ufdef\ufeff\ufff9-\ufffb\ufffe\uffff\U000e0000-\U000e007f"
)
_IN_LINES = re.compile(f"[{_UNSEEN}]")
_IN_ONE_LINE = re.compile(f"[{_UNSEEN}\t\n]")


def printable(text: str, *, lines: bool = False) -> str:
    """The text with characters that can be seen in the place of those that cannot: ESC as ␛, the others as U+FFFD. Line
    breaks and tabs stay only where it is of several `lines`."""
    if text.isprintable() and text.isascii():
        return text
    return (_IN_LINES if lines else _IN_ONE_LINE).sub(_picture, text)


def _picture(found: re.Match[str]) -> str:
    code = ord(found[0])
    if code < 0x20:
        return chr(_PICTURES + code)
    return "\N{SYMBOL FOR DELETE}" if code == 0x7F else "\N{REPLACEMENT CHARACTER}"
