"""YAML to nodes with places. In the middle of typing the lines that make no sense yet are left out, the rest counts."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Any, ClassVar

import yaml
from yaml.constructor import SafeConstructor

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document, SyntaxProblem
from preflight_analysis.documents.hash_comments import preflight_comments
from preflight_analysis.documents.lazy_pattern import lazy_pattern
from preflight_analysis.documents.reading import digest
from preflight_analysis.documents.span import LineIndex, Span

MAX_REPAIRS = 8
"""How many lines are left out before nothing is made of the text."""

_BOTH_AGREE = lazy_pattern(r"(?s)(?!.*(?:[?!]|[|>]#))[\n -~\xa0-\u2027\u202a-\ud7ff\ue000-\ufdff]*")
"""Texts that libyaml takes exactly where PyYAML does, and with the same marks: what they disagree on are tabs, `?` and
`!`, a comment right after `|` or `>`, byte order marks and unusual line breaks. Found by a comparison of two hundred
thousand damaged parameter files; `tests/documents/test_yaml.py` repeats some of it."""

LIBYAML: type[yaml.SafeLoader] | type[yaml.CSafeLoader] = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
"""PyYAML's binding of libyaml; where it was built without, its own."""
_DEPTH_OF_LIBYAML = 2_000
"""libyaml's composer recurses on the stack of the thread, of which a level takes less than 500 bytes."""
_DEPTH_ON_A_LINE = 200
_BRACKET = re.compile(r"[\[\]{}]")
_DEPTH_OF_PYYAML = 300
"""What is deeper is left to PyYAML, which may find it too deep; it ends somewhere below 500."""

CONSTRUCTION_ERRORS = (
    yaml.YAMLError, ValueError, TypeError, LookupError, AttributeError, OverflowError, RecursionError,
)  # fmt: skip
"""What PyYAML raises for a text that is no value of its tag (`!!bool x`, `2024-13-45`) or nested too deeply."""


def _integer(constructor: SafeConstructor, node: yaml.ScalarNode) -> int:
    value: int = constructor.construct_yaml_int(node)
    str(value)  # raises ValueError
    return value


class _PlainConstructor(SafeConstructor):
    """PyYAML's, which also makes integers that Python refuses to write: `0x` and thousands of digits."""

    yaml_constructors: ClassVar[dict[str | None, Any]] = {
        **SafeConstructor.yaml_constructors,
        "tag:yaml.org,2002:int": _integer,
    }


class PlainLoader(_PlainConstructor, yaml.SafeLoader):
    """PyYAML's with that constructor."""


def constructed(node: yaml.Node) -> Any:
    """The value of a node as plain data, by the rules of YAML 1.1. Raises one of `CONSTRUCTION_ERRORS`."""
    # A loader reads a text, too: to make one takes ten times as long, and there is a value for each parameter.
    return _PlainConstructor().construct_object(node, deep=True)


def compose(text: str, loader: type[yaml.SafeLoader] = yaml.SafeLoader) -> yaml.Node | None:
    """What `yaml.compose` with a SafeLoader gives. Raises one of `CONSTRUCTION_ERRORS`."""
    refuse_deep(text)
    return yaml.compose(text, Loader=loader)


def refuse_deep(text: str) -> None:
    """Raise what PyYAML's composer raises in the end, before its scanner has looked at each bracket once for each that
    is open on the same line."""
    if text.count("[") + text.count("{") < _DEPTH_ON_A_LINE:
        return
    for line in text.splitlines():
        if line.count("[") + line.count("{") < _DEPTH_ON_A_LINE:
            continue
        depth = 0
        for sign in _BRACKET.findall(line):
            depth += 1 if sign in "[{" else -1
            if depth > _DEPTH_ON_A_LINE:
                raise RecursionError("nested too deeply")


def load_plain(text: str, kind: type[PlainLoader] = PlainLoader) -> Any:
    """What `yaml.safe_load` gives. Raises one of `CONSTRUCTION_ERRORS`."""
    refuse_deep(text)
    loader = kind(text)
    try:
        return loader.get_single_data()
    finally:
        loader.dispose()


@dataclass(frozen=True, slots=True)
class YamlDocument:
    """A parsed text. `node` is PyYAML's, its marks counted in code points; None where there is nothing in the text.
    `document.problems` says what a YAML parser has against the text; the node is then that of the text without the
    lines concerned."""

    node: yaml.Node | None
    document: Document


def parse_yaml(path: str, text: str, lines: LineIndex | None = None) -> YamlDocument:
    """Parse the text of a YAML file, whatever it looks like. Never raises; no tag makes anything but plain data.

    `lines` are those of the text, where somebody has them.
    """
    lines = lines or LineIndex(text)
    problems: list[SyntaxProblem] = []
    node: yaml.Node | None = None
    attempt = text
    for _ in range(MAX_REPAIRS):
        try:
            node = composed(attempt)
        except yaml.YAMLError as error:
            problem, at = _problem(error, attempt)
            if not problems:
                problems.append(problem)
            shorter = _without_line(attempt, lines, at)
            if shorter == attempt:
                break
            attempt = shorter
        except RecursionError:
            problems = [SyntaxProblem("nested too deeply", Span(0, min(1, len(text))))]
            break
        except (ValueError, OverflowError) as error:  # an escape that is no character, without a place
            problems = problems or [SyntaxProblem(str(error), Span(0, min(1, len(text))))]
            break
        else:
            break
    comments = preflight_comments(text, lines)
    return YamlDocument(node, Document(path, text, digest(text), comments, tuple(problems), lines))


def compose_fast(
    text: str,
    loader: type[yaml.SafeLoader] = yaml.SafeLoader,
    libyaml: type[yaml.SafeLoader] | type[yaml.CSafeLoader] = LIBYAML,
) -> yaml.Node | None:
    """What `yaml.compose` with `loader` gives or raises, but for what is nested too deeply, as launch has it; by
    `libyaml`, which resolves tags alike and is eight times faster, where the two are known to agree."""
    depth = text.count("[") + text.count("{") + max(map(len, text.splitlines()), default=0)  # each level takes a sign
    if depth < _DEPTH_OF_LIBYAML and _BOTH_AGREE.fullmatch(text):
        try:
            node = yaml.compose(text, Loader=libyaml)
        except yaml.YAMLError:
            node = None  # PyYAML says it in its own words, and takes a few texts that libyaml does not
        if node is not None and (depth < _DEPTH_OF_PYYAML or _depth(node) < _DEPTH_OF_PYYAML):
            return node
    return compose(text, loader)


@lru_cache(maxsize=8)
def composed(text: str) -> yaml.Node | None:
    """What `compose_fast` gives. A text that is being edited is asked for by its reader and by the writer of its fixes;
    nobody changes the nodes."""
    return compose_fast(text)


def _depth(root: yaml.Node) -> int:
    """How many nodes hold each other; those of aliases count where they are written."""
    seen: set[int] = set()
    depth, level = 0, {id(root): root}
    while level:
        depth += 1
        seen.update(level)
        level = {id(node): node for parent in level.values() for node in _children(parent) if id(node) not in seen}
    return depth


def _children(node: yaml.Node) -> list[yaml.Node]:
    if isinstance(node, yaml.SequenceNode):
        return list(node.value)
    if isinstance(node, yaml.MappingNode):
        return [part for pair in node.value for part in pair]
    return []


def span_of(node: yaml.Node) -> Span:
    """Where a node is written."""
    return Span(node.start_mark.index, node.end_mark.index)


def _problem(error: yaml.YAMLError, text: str) -> tuple[SyntaxProblem, int]:
    mark = getattr(error, "problem_mark", None)
    begun = getattr(error, "context_mark", None)
    if begun is not None and (mark is None or not text[mark.index :].strip()):
        mark = begun  # what was never ended is wrong where it begins
    position = getattr(error, "position", None)
    at = mark.index if mark is not None else position if isinstance(position, int) else 0
    words = [str(word) for word in (getattr(error, "context", None), getattr(error, "problem", None)) if word]
    message = ", ".join(words) or str(getattr(error, "reason", error))
    at = min(at, len(text))
    return SyntaxProblem(message, Span(at, min(at + 1, len(text)))), at


def _without_line(text: str, lines: LineIndex, at: int) -> str:
    """Blanks in place of the line at `at`, or of the last one before it that has anything."""
    line, _ = lines.position(min(at, max(len(text) - 1, 0)))
    while line >= 0:
        start, end = lines.line_span(line)
        content = text[start:end]
        if content.strip():
            kept = content[len(content.rstrip("\r\n")) :]
            return text[:start] + " " * (len(content) - len(kept)) + kept + text[end:]
        line -= 1
    return text
