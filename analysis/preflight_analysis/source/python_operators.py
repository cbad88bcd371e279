"""What operators, built-in functions and methods of Python's own types make of values that are known."""

from __future__ import annotations

import ast
import re
from collections.abc import Sequence
from typing import Any

from preflight_analysis.source.python_values import UNKNOWN, is_plain

MAX_ITEMS = 64
_MAX_TEXT = 4_096
BUILTINS = frozenset(
    "str int float bool len range enumerate zip list tuple dict super sorted exit quit".split()  # noqa: SIM905
)
_BIG_NUMBER = re.compile(r"\d{3}|\*")
_TEXT_METHODS = frozenset(
    "format strip lstrip rstrip lower upper title capitalize replace split rsplit join startswith endswith".split()  # noqa: SIM905
)


def builtin(name: str, args: Sequence[Any]) -> Any:
    """`name(*args)` of a built-in function."""
    if name == "dict" and not args:
        return {}
    if name in ("list", "tuple", "sorted") and not args:
        return []
    if not args or not is_plain(list(args)):
        return UNKNOWN
    first = args[0]
    try:
        match name:
            case "str" if isinstance(first, (str, int, float)):
                return str(first)
            case "int" | "float" if isinstance(first, (str, int, float)) and len(str(first)) < 30:
                return int(first) if name == "int" else float(first)
            case "bool":
                return bool(first)
            case "len":
                return len(first)
            case "range" if all(isinstance(a, int) for a in args):
                return list(range(*args)) if len(range(*args)) <= MAX_ITEMS else UNKNOWN
            case "enumerate":
                return list(enumerate(first))
            case "zip":
                return list(zip(*args, strict=False))
            case "list" | "tuple":
                return list(first)
            case "sorted":
                return sorted(first)
    except (TypeError, ValueError, OverflowError):
        return UNKNOWN
    return UNKNOWN


def text_method(text: str, method: str, args: Sequence[Any]) -> Any:
    """`text.method(*args)`; nothing that makes a long text."""
    known = is_plain(list(args)) and sum(len(str(a)) for a in args) + len(text) <= _MAX_TEXT
    if method not in _TEXT_METHODS or not known or (method == "format" and _BIG_NUMBER.search(text)):
        return UNKNOWN
    if method == "replace" and len(text) * max(len(str(a)) for a in (*args, "")) > _MAX_TEXT:
        return UNKNOWN
    if method == "format" and ("." in text or "[" in text):
        return UNKNOWN  # attributes of the arguments
    try:
        return shortened(getattr(text, method)(*args))
    except (TypeError, ValueError, LookupError, AttributeError):
        return UNKNOWN


def binary(operator: ast.operator, left: Any, right: Any) -> Any:
    """`left operator right`."""
    number = isinstance(left, (int, float)) and isinstance(right, (int, float))
    if not is_plain(left) or not is_plain(right):
        return UNKNOWN
    try:
        match operator:
            case ast.Add() if isinstance(left, (str, list, tuple)) and type(left) is type(right):
                both: Any = left + right if len(left) + len(right) <= _MAX_TEXT else UNKNOWN  # type: ignore[operator]
                return both
            case ast.Mod() if isinstance(left, str):
                return shortened(left % right) if not _BIG_NUMBER.search(left) else UNKNOWN
            case ast.Add() if number:
                return _small(left + right)
            case ast.Sub() if number:
                return _small(left - right)
            case ast.Mult() if number:
                return _small(left * right)
            case ast.Div() if number:
                return _small(left / right)
            case ast.FloorDiv() if number:
                return _small(left // right)
            case ast.Mod() if number:
                return left % right
    except (TypeError, ValueError, ArithmeticError, LookupError):
        return UNKNOWN
    return UNKNOWN


def shortened(value: Any) -> Any:
    """The value, unless it is a text that is too long to go on with."""
    return UNKNOWN if isinstance(value, str) and len(value) > _MAX_TEXT else value


def _small(number: float) -> Any:
    return number if abs(number) < 2**64 else UNKNOWN


def unary(operator: ast.unaryop, value: Any) -> Any:
    """`operator value`."""
    if isinstance(operator, ast.Not):
        truth = truth_of(value)
        return UNKNOWN if truth is None else not truth
    if isinstance(operator, ast.USub) and isinstance(value, (int, float)):
        return -value
    return UNKNOWN


def formatted(value: Any) -> Any:
    """The text of a value in an f-string."""
    return str(value) if isinstance(value, (str, int, float)) else UNKNOWN


def joined(*parts: Any) -> Any:
    """The text of an f-string of which these are the parts."""
    texts = [part for part in parts if isinstance(part, str)]
    return "".join(texts) if len(texts) == len(parts) and sum(map(len, texts)) <= _MAX_TEXT else UNKNOWN


def item_at(owner: Any, key: Any) -> Any:
    """`owner[key]`."""
    if isinstance(owner, (dict, list, tuple, str)) and isinstance(key, (str, int)):
        try:
            return owner[key]  # type: ignore[index]
        except (LookupError, TypeError):
            return UNKNOWN
    return UNKNOWN


def items_of(value: Any) -> list[Any] | None:
    """What a loop over the value would get, None if that is not known."""
    if isinstance(value, (list, tuple, dict)):
        return list(value)[:MAX_ITEMS]
    return None


def truth_of(value: Any) -> bool | None:
    """Whether a condition holds; None if that is not known."""
    if isinstance(value, (list, tuple, dict)):
        return bool(value) or None  # what a branch that is not taken adds to it is not known
    return bool(value) if is_plain(value) else None
