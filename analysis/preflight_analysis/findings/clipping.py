"""How much is said: long names within a message are shortened, and the findings of a file are counted."""

from __future__ import annotations

import re
from collections.abc import Iterable

from preflight_analysis.findings.finding import SEVERITIES, Finding

SHORT = 300
"""Characters of a message that is never clipped."""
MAX_MESSAGE = 2000
MAX_FINDINGS = 2000
"""Of one file in one root: more than anybody reads."""

_LONG_WORD = re.compile(r"(\S{120})\S{40,}(\S{40})")


def clipped(message: str) -> str:
    """The message with the middle left out of words of more than 200 characters, and of at most `MAX_MESSAGE`."""
    if len(message) <= SHORT:
        return message
    ends = message[: 2 * MAX_MESSAGE] + message[max(2 * MAX_MESSAGE, len(message) - 2 * MAX_MESSAGE) :]
    short = _LONG_WORD.sub("\\1\u2026\\2", ends)
    if len(short) <= MAX_MESSAGE:
        return short
    return f"{short[: MAX_MESSAGE // 2]}\u2026{short[-MAX_MESSAGE // 2 :]}"


def most_severe(findings: Iterable[Finding]) -> tuple[list[Finding], list[Finding]]:
    """The `MAX_FINDINGS` most severe findings of a file, the first ones among those as severe, and the others."""
    found = list(findings)
    if len(found) > MAX_FINDINGS:
        found.sort(key=lambda f: (-SEVERITIES.index(f.severity), f.location.span, f.rule))
    return found[:MAX_FINDINGS], found[MAX_FINDINGS:]
