"""What XML is written with, as regular expressions. None backtracks more than linearly."""

from __future__ import annotations

import re

from preflight_analysis.documents.lazy_pattern import lazy_pattern

# The names of XML 1.0, fifth edition; those of the fourth, which expat knows, are among them. It is said which
# characters are none: Python goes through all of a set to compile it, and most characters are letters.
_NOT_IN_NAME = (
    "\0-,/;-@\\[-\\^`{-\xb6\xb8-\xbf\xd7\xf7\u037e\u2000-\u200b\u200e-\u203e\u2041-\u206f\u2190-\u2bff\u2ff0-\u3000"
    "\ud800-\uf8ff\ufdd0-\ufdef\ufffe\uffff\U000f0000-\U0010ffff"
)
NO_NAME_STARTS = f"{_NOT_IN_NAME}\\-.0-9\xb7\u0300-\u036f\u203f\u2040"
"""The characters that no XML name starts with, as they stand in brackets."""
NAME_START = f"[^{NO_NAME_STARTS}]"
NAME = f"{NAME_START}[^{_NOT_IN_NAME}]*"
"""Pattern of an XML name."""

BLANK = " \t\r\n"
S = "[ \t\r\n]"
"""Pattern of one blank."""
SPACE = re.compile(f"{S}*")
ONE_NAME = lazy_pattern(NAME)
NAME_EQUALS = lazy_pattern(f"{NAME}{S}*=")
END_TAG = lazy_pattern(f"</({NAME}){S}*>")
TEXT_SPECIAL = lazy_pattern(f"&(?:#[0-9]+;|#x[0-9A-Fa-f]+;|{NAME};)?|\r\n?")
VALUE_SPECIAL = lazy_pattern(f"&(?:#[0-9]+;|#x[0-9A-Fa-f]+;|{NAME};)?|\r\n?|[\n\t]")


def skip(pattern: re.Pattern[str], text: str, at: int) -> int:
    """Where the pattern ends that starts at `at`; `at` where it does not."""
    found = pattern.match(text, at)
    return found.end() if found else at
