"""What is known of common packages: a file for each in `data/`, read when it is first asked for."""

from __future__ import annotations

import re
from functools import lru_cache
from pathlib import Path

from preflight_analysis.knowledge.model import Knowledge
from preflight_analysis.knowledge.read import read_knowledge

DATA = Path(__file__).with_name("data")
SUFFIX = ".yaml"
_NAME = re.compile(r"\w[\w-]*\Z")
_KEPT = 256


@lru_cache(maxsize=_KEPT)
def knowledge_of(package: str) -> Knowledge | None:
    """What is known of a package; None where nothing is."""
    if not _NAME.match(package):
        return None
    try:
        text = (DATA / f"{package}{SUFFIX}").read_text(encoding="utf-8")
    except OSError:
        return None
    return read_knowledge(text)
