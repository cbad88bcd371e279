"""LCH039: two items of a list between which the comma is missing."""

from __future__ import annotations

import ast
import io
import math
import tokenize
from collections.abc import Iterator
from itertools import chain

from preflight_analysis.documents.span import Span
from preflight_analysis.edits.python import PythonWriter
from preflight_analysis.evaluation.tree import Param
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.python_source import PythonSource, python_source
from preflight_analysis.model.context import Context
from preflight_analysis.model.parameters import groups_of_params
from preflight_analysis.model.problems import fix, include_chain, quoted, shortened
from preflight_analysis.rules.further_reading import FORMATS, ROSLAUNCH_ROSPARAM
from preflight_analysis.rules.rule import Rule

_PLAIN = 2
"""How many items of a list have to be what the text is made of."""
_BREAKS = "/_-.:,=@[](){}"
"""Where somebody breaks a long path, name or expression on purpose."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for path, launch_file in context.launch_files.items():
        for first, span, parts in _glued(launch_file) if launch_file.is_python else ():
            edits = PythonWriter(launch_file.document).insert_comma(first)
            yield rule.claim(
                f"missing comma: {quoted(parts)} are one string '{shortened(''.join(parts))}'",
                context.location(path, span),
                subject=Subject("text", "".join(parts)),
                fixes=fix("Insert ','", edits, preferred=True),
            )
    if not context.tree.ros.own_parameters:
        yield from _in_parameters(rule, context)


def _in_parameters(rule: Rule, context: Context) -> Iterator[Finding]:
    """Lists of numbers, or of `true` and `false`, with one text that is made of several such. ROS 2 refuses them."""
    for param, words in chain.from_iterable(context.each(_lists_with_text, groups_of_params(context))):
        yield rule.claim(
            f"{quoted(words)} are one text in '{param.name}': the comma between them is missing",
            param.place,
            subject=Subject("parameter", param.name),
            related=include_chain(param.origin),
        )


def _lists_with_text(params: tuple[Param, ...]) -> tuple[tuple[Param, list[str]], ...]:
    """Those with the values in their first text."""
    found: list[tuple[Param, list[str]]] = []
    for param in params:
        value = param.value
        texts = [item for item in value if isinstance(item, str)] if isinstance(value, list) else []
        if not isinstance(value, list) or not texts or len(value) - len(texts) < _PLAIN:
            continue
        is_alike = _is_boolean if any(isinstance(item, bool) for item in value) else _is_number
        if all(len(text.split()) > 1 and all(map(is_alike, text.split())) for text in texts):
            found.append((param, texts[0].split()))
    return tuple(found)


def _is_boolean(word: str) -> bool:
    return word.lower() in ("true", "false")


def _is_number(word: str) -> bool:
    try:
        return math.isfinite(float(word))
    except ValueError:
        return False


@derived
def _glued(launch_file: LaunchFile) -> tuple[tuple[int, Span, tuple[str, ...]], ...]:
    """Where the comma goes, all that is glued, and the strings of it."""
    source = python_source(launch_file.document)
    if source.module is None:
        return ()
    return tuple(
        found
        for node in source.nodes
        if isinstance(node, (ast.List, ast.Tuple, ast.Set)) and len(node.elts) > 1
        for found in _in_sequence(source, node.elts)
    )


def _in_sequence(source: PythonSource, elements: list[ast.expr]) -> Iterator[tuple[int, Span, tuple[str, ...]]]:
    words = [each.value for each in elements if isinstance(each, ast.Constant) and isinstance(each.value, str)]
    # Texts and long lines are broken on purpose; single words are not.
    if any(len(word.split()) != 1 for word in words):
        return
    for each in elements:
        if not isinstance(each, ast.Constant):
            continue
        span = source.whole_span(each)
        tokens = _strings(source.text[span.start : span.end])
        if len(tokens) < 2 or source.text[: span.start].rstrip().endswith("("):
            continue
        parts = tuple(part for _, part in tokens)
        if all(parts) and not any(part[-1] in _BREAKS for part in parts[:-1]) and parts[1][0] not in _BREAKS:
            yield span.start + tokens[0][0], span, parts


def _strings(text: str) -> list[tuple[int, str]]:
    """The literals that an expression is made of, each with the offset of its end; none where there is one alone, or
    one is not plain."""
    if text[:1] in ("'", '"') and text[-1] == text[0] and text.count(text[0]) == 2:
        return []  # one alone
    lines = text.splitlines(keepends=True)
    found: list[tuple[int, str]] = []
    try:
        for token in tokenize.generate_tokens(io.StringIO(f"({text})").readline):
            if token.type == tokenize.STRING:
                row, column = token.end
                # The bracket before is one character of the first line.
                end = sum(map(len, lines[: row - 1])) + column - (1 if row == 1 else 0)
                found.append((end, str(ast.literal_eval(token.string))))
    except (tokenize.TokenError, SyntaxError, ValueError):
        return []
    return found


RULE = Rule(
    id="LCH039",
    name="glued-strings",
    effect="misbehaves",
    kind="invalid",
    always=(Reason.FROM_SOURCE,),
    what="Checks for two strings in a list of a Python launch file without a comma between them. In ROS 1 it checks "
    "lists of parameter files, if one text consists of values like the others (`true false`).",
    why="The list contains neither of the two. An argument refuses a value that seems to be among its choices, or a "
    "node gets one word instead of two.",
    example='choices=["diff_drive" "mecanum", "tricycle"]',
    instead='choices=["diff_drive", "mecanum", "tricycle"]',
    references=(
        FORMATS,
        ROSLAUNCH_ROSPARAM,
    ),
    check=_check,
    in_branches=True,
)
