"""What is ours alone and must not be shown to users: how a run is made, how a value is held, what we call a thing."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import preflight_analysis
import preflight_server
from preflight_analysis.findings.finding import Finding

_RECORD = re.compile(r"^@dataclass\b[^\n]*\nclass (\w+)|^class (\w+)\(NamedTuple\)", re.MULTILINE)
_PARTS = (
    r"[\ufdd0-\ufdef\ufffe\uffff]",  # around what stands for a text that is not known
    r"\\u[fF][dD][dDeE][0-9a-fA-F]",
    r"\$\((?:unknown|python|own)(?=[ )])[^)]*\)?",
    r"\bAnything\b|\bAnyModule\b|\bUnknownText\b",
    r"\b_*preflight_(?!(?:graph|demo|services|tutorials)\b)[a-z]\w*|/run/preflight\b[^\s:'\"]*|\bfake_launch\b|\bown/lib\b",
    r"<[^<>]* (?:object )?at 0x[0-9a-f]+>|\b(?:mappingproxy|frozenset|PosixPath)\(",
)


_UNSET = re.compile(r"(?<![\w.])None\.(?!None\b)[A-Za-z]\w*")
"""Of a variable that is not set: `None.yaml`. What another program says of a file may well have it."""


@cache
def _pattern() -> re.Pattern[str]:
    """What is found, with the names of our own records as `repr` shows them: `Span(start=`."""
    folders = [Path(each.__path__[0]) for each in (preflight_analysis, preflight_server)]
    texts = (file.read_text(encoding="utf-8") for folder in folders for file in folder.rglob("*.py"))
    records = {name for text in texts for found in _RECORD.findall(text) for name in found if name}
    return re.compile("|".join((*_PARTS, rf"\b(?:{'|'.join(sorted(records))})\([a-z_]\w*=")))


def internals(text: str, written: str = "") -> list[str]:
    """What a text shows of our internals; `written` is what the user wrote, and may read again."""
    return [found[0] for each in (_pattern(), _UNSET) for found in each.finditer(text) if found[0] not in written]


def shown_internals(texts: Iterable[str], written: str = "") -> list[str]:
    """The same of many texts, each with the text."""
    return [f"{found!a} in: {text}" for text in dict.fromkeys(texts) for found in internals(text, written)]


def texts_of(findings: Iterable[Finding]) -> Iterator[str]:
    """All that is read of findings."""
    for finding in findings:
        said = str(finding.text.own)
        yield from (said, _UNSET.sub("", finding.message[len(said) :]), finding.condition)
        yield from (each.message for each in finding.related)
        yield from (each.title for each in finding.fixes)
        yield from (each.text for fix in finding.fixes for each in fix.edits)
        if finding.lack is not None:
            yield from (finding.lack.name, finding.lack.remedy or "")
        if finding.alike is not None:
            yield from (str(finding.alike.what), finding.alike.name)


def strings_in(data: Any) -> Iterator[str]:
    """The texts in plain data, as of JSON, keys included."""
    if isinstance(data, str):
        yield data
    elif isinstance(data, dict):
        yield from data
        for each in data.values():
            yield from strings_in(each)
    elif isinstance(data, (list, tuple)):
        for each in data:
            yield from strings_in(each)
