"""What the substitutions of a value name: arguments (`$(arg x)`, `$(var x)`, names in `$(eval ...)`), packages,
environment variables."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Literal

from preflight_analysis.documents.span import Span
from preflight_analysis.launch.model import Substitution, Value
from preflight_analysis.launch.substitutions_ros2 import nested, span_of

Named = Literal["argument", "package", "variable", "identifier"]

NAMES: Mapping[str, Named] = {
    "arg": "argument",
    "var": "argument",
    "find": "package",
    "find-pkg-share": "package",
    "find-pkg-prefix": "package",
    "env": "variable",
    "optenv": "variable",
    "anon": "identifier",
}
"""What the first word of a substitution is the name of, in both generations."""
COMPONENT = "component"
"""Stands in the place of a substitution's command where a Python file names a component, as `package/class`."""

_EVAL_ARGUMENT = re.compile(
    r"""\b(?P<function>arg\s*\(\s*)(?P<quote>['"])(?P<quoted>[^'"]*)(?P=quote)"""
    r"""|'(?:\\.|[^'\\])*'|"(?:\\.|[^"\\])*\""""
    r"""|\.\s*[A-Za-z_]\w*"""
    r"""|(?P<name>[A-Za-z_]\w*)(?!\w|\s*\()"""
)
"""In this order: `arg('x')`, strings, attributes and methods, names that are not called."""
NOT_ARGUMENTS = frozenset(
    [
        "and",
        "or",
        "not",
        "in",
        "is",
        "if",
        "else",
        "for",
        "lambda",
        "True",
        "False",
        "None",
        "true",
        "false",
        "pi",
        "e",
        "tau",
        "inf",
        "nan",
    ]
)
"""Names that mean something else in `$(eval ...)`."""


def arg_references(value: Value) -> Iterator[tuple[str, Span]]:
    """Name and place of each use of an argument, in order.

    In the `$(eval ...)` of ROS 1 each bare name counts that is no keyword or constant: roslaunch looks arguments up by
    name there (http://wiki.ros.org/roslaunch/XML#substitution_args), and a name that is no argument is an error.
    """
    for part in nested(value.parts):
        if NAMES.get(part.command) == "argument":
            name, span = first_word(part)
            if name:
                yield name, span
        elif part.command == "eval" and not part.words:
            yield from _in_expression(part)


def first_word(part: Substitution) -> tuple[str, Span]:
    """The first argument of a substitution as written: the name that it speaks of."""
    if part.words:
        return "".join(piece.text for piece in part.words[0]), span_of(part.words[0], part.arguments_span)
    name = part.arguments.split(" ", 1)[0]
    return name, Span(part.arguments_span.start, part.arguments_span.start + len(name))


def _in_expression(part: Substitution) -> Iterator[tuple[str, Span]]:
    span = part.arguments_span
    # With entities in it (`&lt;`) places inside of the text are not those of the file: the whole expression stands in.
    exact = span.end - span.start == len(part.arguments)
    for found in _EVAL_ARGUMENT.finditer(part.arguments):
        group = "quoted" if found["quoted"] is not None else "name"
        name = found[group]
        if name and (group == "quoted" or name not in NOT_ARGUMENTS):
            place = Span(span.start + found.start(group), span.start + found.end(group)) if exact else span
            yield name, place
