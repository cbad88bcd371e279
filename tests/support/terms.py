"""The words that texts for users avoid, of `.ci/lint/terms.json`, which `make lint` reads as well."""

from __future__ import annotations

import json
import re
from functools import cache
from pathlib import Path

FILE = Path(__file__).resolve().parents[2] / ".ci/lint/terms.json"


@cache
def _terms() -> tuple[tuple[re.Pattern[str], str], ...]:
    terms = json.loads(FILE.read_text(encoding="utf-8"))
    phrases = [(re.compile(each["avoid"], re.IGNORECASE), each["write"]) for each in terms["phrases"]]
    return (*phrases, *((re.compile(each["avoid"]), each["write"]) for each in terms["spelling"]))


def avoided(text: str) -> list[str]:
    """What a text should say in other words: `'found': instead`."""
    return [f"'{found[0]}': {instead}" for pattern, instead in _terms() for found in pattern.finditer(text)]
