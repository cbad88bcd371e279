"""What a condition asks of arguments and of variables of the environment, as its text tells."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from itertools import islice, product
from typing import NamedTuple

from preflight_analysis.launch.model import Literal, Substitution, Value
from preflight_analysis.launch.references import NOT_ARGUMENTS, arg_references, first_word
from preflight_analysis.launch.substitutions_ros2 import nested

VARIABLE = "$"
"""What the name of a variable of the environment begins with, where it stands beside arguments."""
MOST = 4
"""Assignments that are looked at of one condition: those that it names first are mostly right."""
_LONGEST = 500
"""Characters of an expression that is read: parentheses and words nest, and Python's stack has an end."""
_SAME_TEXT = frozenset({"lower", "upper", "strip", "casefold"})
"""Methods that a comparison is not about."""
COMPARISONS = {"config-equals": True, "config-not-equals": False}
"""Conditions of Python launch files on one configuration, with whether it has to be equal."""
REFERENCES = frozenset({"arg", "var", "env", "optenv"})
"""Substitutions that stand for one argument or variable."""
_MARK = "argument_{}_of_the_condition"


class Wanted(NamedTuple):
    """An argument or variable of a condition, with the text that it has to have, or must not have."""

    name: str
    text: str
    equal: bool = True


def parsed_expression(part: Substitution) -> tuple[ast.expr, dict[str, str] | None] | None:
    """An expression, with the names that its marks stand for."""
    text, names = _with_marks(part)
    if text is None or len(text) > _LONGEST:
        return None
    try:
        return ast.parse(text.strip(), mode="eval").body, names
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def _with_marks(part: Substitution) -> tuple[str | None, dict[str, str] | None]:
    """An expression with a mark for each argument, and the names that the marks stand for; in ROS 1, where arguments
    are known by their names, no marks. None for what has other values in it."""
    if not part.words:
        return part.text[len("$(eval ") : -1], None
    text, names = "", dict[str, str]()
    for piece in part.words[0]:
        if isinstance(piece, Literal):
            text += piece.text
        elif piece.command in ("var", "env") and (name := name_in(piece)) is not None:
            mark = _MARK.format(len(names))
            names[mark] = name
            text += mark
        else:
            return None, None
    return text, names


def solved(node: ast.expr, wanted: bool, names: Mapping[str, str] | None) -> Iterator[tuple[Wanted, ...]]:
    """What variables have to be, all of a tuple together, for an expression to be true or false."""
    match node:
        case ast.UnaryOp(op=ast.Not(), operand=inner):
            yield from solved(inner, not wanted, names)
        case ast.BoolOp(op=op, values=values):
            if isinstance(op, ast.And) == wanted:
                for several in product(*(list(islice(solved(v, wanted, names), MOST)) or [()] for v in values)):
                    yield tuple(each for one in several for each in one)
            else:
                for value in values:
                    yield from solved(value, wanted, names)
        case ast.Compare(left=left, ops=[ast.Eq() | ast.NotEq() as op], comparators=[right]):
            equal = wanted == isinstance(op, ast.Eq)
            for one, other in ((left, right), (right, left)):
                name, text = _variable(one, names), _constant(other, names)
                if name is not None and text is not None:
                    yield (Wanted(name, text, equal),)
        case ast.Compare(
            left=left, ops=[ast.In() | ast.NotIn() as op], comparators=[ast.List() | ast.Tuple() as items]
        ):
            name = _variable(left, names)
            if name is not None and wanted == isinstance(op, ast.In):
                texts = (_constant(each, names) for each in items.elts)
                yield from ((Wanted(name, text),) for text in texts if text is not None)
        case _:
            if (name := _variable(node, names)) is not None:
                yield (Wanted(name, "true" if wanted else "false"),)


def _variable(node: ast.expr, names: Mapping[str, str] | None) -> str | None:
    match node:
        case ast.Call(func=ast.Attribute(value=inner, attr=method), args=[]) if method in _SAME_TEXT:
            return _variable(inner, names)
        case ast.Call(func=ast.Name(id="str" | "bool"), args=[inner]):
            return _variable(inner, names)
        case ast.Call(func=ast.Name(id="arg"), args=[ast.Constant(value=str(name))]) if names is None:
            return name
        case ast.Call(func=ast.Name(id="env" | "optenv"), args=[ast.Constant(value=str(name)), *_]) if names is None:
            return VARIABLE + name if name.isidentifier() else None
        case ast.Name(id=name):
            return names.get(name) if names is not None else name if name not in NOT_ARGUMENTS else None
        case ast.Constant(value=str(text)) if names is not None:
            return names.get(text)
    return None


def _constant(node: ast.expr, names: Mapping[str, str] | None) -> str | None:
    match node:
        case ast.Constant(value=str(text)):
            return None if names is not None and any(mark in text for mark in names) else text
        case ast.Constant(value=bool(value)):
            return str(value).lower()
        case ast.Constant(value=int(number) | float(number)):
            return str(number)
        case ast.Name(id="true" | "false" as word):
            return word
    return None


def name_in(part: Literal | Substitution) -> str | None:
    """The argument that a substitution stands for, or the variable."""
    if isinstance(part, Literal) or part.command not in REFERENCES:
        return None
    if any(not isinstance(piece, Literal) for word in part.words[:1] for piece in word):
        return None
    name = first_word(part)[0]
    if part.command in ("arg", "var"):
        return name
    return VARIABLE + name if name.isidentifier() else None


def default_of(part: Substitution) -> str | None:
    """What a substitution gives where the variable is not set."""
    if part.words:
        return "".join(piece.text for piece in part.words[1]) if len(part.words) > 1 else None
    return part.arguments.partition(" ")[2] or None


def comparisons(part: Substitution) -> Iterator[tuple[str, str]]:
    """The arguments and variables that a condition compares, with the texts that it compares them with."""
    if part.command in ("equals", "not-equals", *COMPARISONS) and len(part.words) == 2:
        for one, other in (part.words, part.words[::-1]):
            name = name_in(one[0]) if len(one) == 1 else None
            if part.command in COMPARISONS and one is part.words[0]:
                name = "".join(piece.text for piece in one)
            if name is not None and all(isinstance(piece, Literal) for piece in other):
                yield name, "".join(piece.text for piece in other)
    elif part.command == "eval" and (expression := parsed_expression(part)) is not None:
        node, names = expression
        for each in ast.walk(node):
            for wishes in solved(each, True, names) if isinstance(each, ast.Compare) else ():
                yield from ((wish.name, wish.text) for wish in wishes)


def named_arguments(value: Value) -> frozenset[str]:
    """The arguments that a value names."""
    compared = (part for part in nested(value.parts) if part.command in COMPARISONS)
    return frozenset((*(first_word(part)[0] for part in compared), *(name for name, _ in arg_references(value))))
