"""The arguments that a value of a ROS 1 launch file uses: `$(arg x)`, and names in `$(eval ...)`."""

from __future__ import annotations

import re
from collections.abc import Iterator

from preflight_analysis.documents.span import Span
from preflight_analysis.launch.model import Substitution, Value

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

    In `$(eval ...)` each bare name counts that is no keyword or constant: roslaunch looks arguments up by name there
    (http://wiki.ros.org/roslaunch/XML#substitution_args), and a name that is no argument is an error.
    """
    for part in value.substitutions:
        if part.command == "arg":
            if part.arguments:
                yield part.arguments, part.arguments_span
        elif part.command == "eval":
            yield from _in_expression(part)


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
