"""Cutting a value into literals and substitutions, as roslaunch's own small state machine does.

http://wiki.ros.org/roslaunch/XML#substitution_args. There is no escape; `$(` that is never closed is literal text;
`$(eval ...)` counts only when it is the whole value.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from preflight_analysis.documents.document import SpannedText
from preflight_analysis.documents.span import Span
from preflight_analysis.launch.model import Literal, Substitution, Value

SUBSTITUTIONS: Mapping[str, tuple[str, str]] = {
    "arg": ("NAME", "The value of an argument of this file."),
    "find": ("PACKAGE", "The folder of a package; with a path after it, that file in the package."),
    "env": ("NAME", "An environment variable, which must be set."),
    "optenv": ("NAME DEFAULT", "An environment variable, or the default where it is not set."),
    "anon": ("ID", "A name that is made unique; the same for the same id in this file."),
    "dirname": ("", "The folder of this launch file."),
    "eval": (
        "EXPRESSION",
        "A Python expression that knows the arguments by name. It must be the whole value.",
    ),
}
"""What each command takes, and what it stands for."""

COMMANDS_ROS1 = tuple(SUBSTITUTIONS)


class SubstitutionSyntaxError(ValueError):
    """roslaunch would refuse the text."""


def find_substitutions(text: str) -> Iterator[tuple[int, int]]:
    """Start and end of each `$(...)` in `text`. Raises `SubstitutionSyntaxError` where roslaunch would."""
    out, dollar, opened, inside = range(4)
    state, start = out, 0
    for at, character in enumerate(text):
        if character == "$":
            if state in (opened, inside):
                raise SubstitutionSyntaxError("a dollar sign cannot stand inside of $(...): substitutions do not nest")
            if state == out:
                state, start = dollar, at
            else:
                start = at
        elif character == "(":
            if state == dollar:
                state = opened
            elif state != out:
                raise SubstitutionSyntaxError("a left parenthesis cannot stand inside of $(...)")
        elif character == ")":
            if state == inside:
                yield start, at + 1
            state = out
        elif state == dollar:
            state = out
        elif state == opened:
            state = inside


def is_eval(text: str) -> bool:
    """Whether the whole value is one `$(eval ...)`."""
    return text.startswith("$(eval ") and text.endswith(")")


def parse_value(source: SpannedText) -> Value:
    """The value of an attribute or text, cut into pieces; `problem` says why where that failed."""
    text = source.text
    if "$" not in text:
        return Value(text, source.span, (Literal(text, source.span),) if text else ())
    if is_eval(text):
        return Value(text, source.span, (_substitution(source, 0, len(text)),))
    parts: list[Literal | Substitution] = []
    at, problem = 0, None
    try:
        for start, end in find_substitutions(text):
            if start > at:
                parts.append(Literal(text[at:start], source.slice_span(at, start)))
            parts.append(_substitution(source, start, end))
            at = end
    except SubstitutionSyntaxError as error:
        problem = str(error)
    if at < len(text):
        parts.append(Literal(text[at:], source.slice_span(at, len(text))))
    return Value(text, source.span, tuple(parts), problem)


def _substitution(source: SpannedText, start: int, end: int) -> Substitution:
    inner = source.text[start + 2 : end - 1]
    lead = len(inner) - len(inner.lstrip(" "))
    command = inner[lead:].split(" ", 1)[0]
    after = start + 2 + lead + len(command)
    arguments = source.text[after : end - 1]
    begin = after + len(arguments) - len(arguments.lstrip(" "))
    arguments = arguments.strip(" ")
    return Substitution(
        command,
        source.slice_span(start + 2 + lead, after),
        arguments,
        source.slice_span(begin, begin + len(arguments)) if arguments else Span(*(source.to_document(after),) * 2),
        source.text[start:end],
        source.slice_span(start, end),
    )
