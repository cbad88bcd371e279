"""What XML is written with, as regular expressions. None backtracks more than linearly."""

from __future__ import annotations

import re

from preflight_analysis.documents.lazy_pattern import lazy_pattern

# The names of XML 1.0, fifth edition; those of the fourth, which expat knows, are among them.
NAME_START = (
    ":A-Z_a-z\xc0-\xd6\xd8-\xf6\xf8-\u02ff\u0370-\u037d\u037f-\u1fff\u200c-\u200d\u2070-\u218f\u2c00-\u2fef"
    "\u3001-\ud7ff\uf900-\ufdcf\ufdf0-\ufffd\U00010000-\U000effff"
)
NAME = f"[{NAME_START}][{NAME_START}\\-.0-9\xb7\u0300-\u036f\u203f-\u2040]*"
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
