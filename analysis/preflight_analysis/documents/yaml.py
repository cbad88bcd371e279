"""YAML to nodes with places. In the middle of typing the lines that make no sense yet are left out, the rest counts."""

from __future__ import annotations

from dataclasses import dataclass

import yaml

from preflight_analysis.documents.document import Document, SyntaxProblem
from preflight_analysis.documents.hash_comments import preflight_comments
from preflight_analysis.documents.reading import digest
from preflight_analysis.documents.span import LineIndex, Span

MAX_REPAIRS = 8
"""How many lines are left out before nothing is made of the text."""


@dataclass(frozen=True, slots=True)
class YamlDocument:
    """A parsed text. `node` is PyYAML's, its marks counted in code points; None where there is nothing in the text.
    `document.problems` says what a YAML parser has against the text; the node is then that of the text without the
    lines concerned."""

    node: yaml.Node | None
    document: Document


def parse_yaml(path: str, text: str) -> YamlDocument:
    """Parse the text of a YAML file, whatever it looks like. Never raises; no tag makes anything but plain data."""
    lines = LineIndex(text)
    problems: list[SyntaxProblem] = []
    node: yaml.Node | None = None
    attempt = text
    for _ in range(MAX_REPAIRS):
        try:
            node = yaml.compose(attempt, Loader=yaml.SafeLoader)
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
        else:
            break
    comments = preflight_comments(text, lines)
    return YamlDocument(node, Document(path, text, digest(text), comments, tuple(problems), lines))


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
