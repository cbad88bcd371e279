"""How messages of findings are worded: the name that matters is early, sentences are short, words are plain."""

from __future__ import annotations

import re
from collections.abc import Iterator

from preflight_analysis.findings.finding import Finding

from support.terms import avoided

CUT = 80
"""The columns of a message that an editor's list of problems shows."""
MOST_WORDS = 30
_PARSER = frozenset(
    {"LCH001", "LCH002", "LCH011", "LCH018", "LCH020", "LCH031", "LCH032", "PRM004", "PRM008", "PRM016"}
)
"""Rules whose messages begin with what a parser, an interpreter or a command says."""
_PROGRAM = frozenset({"TRC001", "TRC002", "TRC003", "TRC004", "TRC005"})
"""Rules whose messages end with what a node or the sandbox says."""
_NAME = re.compile(r"'[^']+'?|<[^>]+>?|`[^`]+`?|(?<![\w./])[~/][A-Za-z]\w*|\$\([^)]*\)?")
"""A name in quotes, an element, a command, a node, a substitution."""
_QUOTED = re.compile(r"'[^']*'|`[^`]*`|\([^()]*\)|<[^<>]*>")
_SENTENCE = re.compile(r"[.;:?!](?:\s|\Z)")


def wording(finding: Finding) -> Iterator[str]:
    """What is wrong with the words of a finding: its message, its fixes and its related places."""
    foreign = finding.rule in _PARSER or finding.rule in _PROGRAM
    if finding.rule not in (*_PARSER, "TRC004") and _NAME.search(finding.message[:CUT]) is None:
        yield f"no name in the first {CUT} characters: {finding.message}"
    texts = [*(() if foreign else (finding.message,)), *(each.title for each in finding.fixes)]
    for text in (*texts, *(each.message for each in finding.related if not foreign)):
        plain = _QUOTED.sub("'x'", text)
        yield from (f"{each}, in: {text}" for each in avoided(plain))
        for sentence in _SENTENCE.split(plain):
            if len(sentence.split()) > MOST_WORDS:
                yield f"a sentence of more than {MOST_WORDS} words: {text}"
