"""What operators and methods of C++'s own types make of values that are known."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from preflight_analysis.source.cpp_values import Constant, CppType, Stream
from preflight_analysis.source.python_values import UNKNOWN, is_plain

MAX_TEXT = 4_096
MAX_ITEMS = 64
_LARGEST = 2**63
_WHOLE = frozenset({"int", "long", "short", "size_t", "int32_t", "int64_t", "uint32_t", "uint64_t", "unsigned int"})
_STRING = frozenset({"c_str", "data", "str", "string"})


def truth(value: Any) -> bool | None:
    """Whether a condition holds; None if that is not known."""
    return bool(value) if value is None or isinstance(value, (bool, int, float)) else None


def converted(value: Any, type_: CppType | None) -> Any:
    """A number as a variable of that type holds it."""
    if type_ is None or not isinstance(value, (int, float)):
        return value
    name = type_.name.removeprefix("std::")
    if isinstance(value, bool) or name == "bool":
        return value != 0 if name == "bool" else int(value) if name in _WHOLE else value
    if name in ("double", "float"):
        return float(value)
    return int(value) if isinstance(value, float) and name in _WHOLE and abs(value) < _LARGEST else value


def initialized(value: Any, type_: CppType | None) -> Any:
    """What an argument of that type is, if `value` is given for it: `{}` is an empty text, or zero, or false."""
    if value != [] or type_ is None:
        return converted(value, type_)
    name = type_.name.removeprefix("std::")
    if name in ("string", "bool"):
        return "" if name == "string" else False
    return converted(0, type_) if name in _WHOLE or name in ("double", "float") else value


def binary(operator: str, left: Any, right: Any) -> Any:
    """`left operator right`; `&&` and `||` are not among them."""
    if operator == "<<" and isinstance(left, Stream):
        if len(left.parts) < MAX_ITEMS:
            left.parts.append(right if is_plain(right) else UNKNOWN)
        return left
    if isinstance(left, Constant) and isinstance(right, Constant) and operator in ("==", "!="):
        return (left == right) is (operator == "==")
    if isinstance(left, (list, dict)) or not (is_plain(left) and is_plain(right)):
        return UNKNOWN
    try:
        match operator:
            case "+":
                known = isinstance(left, (str, int, float)) and isinstance(right, (str, int, float))
                return _short(left + right) if known else UNKNOWN
            case "-":
                return _short(left - right)
            case "*" if not isinstance(left, str) and not isinstance(right, str):
                return _short(left * right)
            case "/" if isinstance(left, int) and isinstance(right, int):
                return int(left / right)
            case "/":
                return _short(left / right)
            case "%" if isinstance(left, int) and isinstance(right, int):
                return left % right
            case "==":
                return left == right
            case "!=":
                return left != right
            case "<":
                return left < right
            case "<=":
                return left <= right
            case ">":
                return left > right
            case ">=":
                return left >= right
    except (TypeError, ValueError, ArithmeticError):
        return UNKNOWN
    return UNKNOWN


def unary(operator: str, value: Any) -> Any:
    """`operator value`."""
    if operator == "!":
        known = truth(value)
        return UNKNOWN if known is None else not known
    if operator == "-" and isinstance(value, (int, float)):
        return -value
    return value if operator == "+" else UNKNOWN


def number(text: str) -> Any:
    """What a number in the text is."""
    plain = text.replace("'", "").rstrip("uUlLfF") if not text.lower().startswith("0x") else text.rstrip("uUlL")
    try:
        return int(plain, 0) if not any(c in plain for c in ".eE") or plain.lower().startswith("0x") else float(plain)
    except ValueError:
        return UNKNOWN


def item(owner: Any, key: Any) -> Any:
    """`owner[key]`."""
    if isinstance(owner, (list, dict, str)) and isinstance(key, (str, int)):
        try:
            return owner[key]  # type: ignore[index]
        except (LookupError, TypeError):
            return UNKNOWN
    return UNKNOWN


def text_method(text: str, name: str, args: Sequence[Any]) -> Any:
    """`text.name(args)` of a `std::string`."""
    if name in _STRING:
        return text
    known = all(isinstance(arg, (str, int)) for arg in args)
    match name, args:
        case "empty", []:
            return not text
        case (("size" | "length"), []):
            return len(text)
        case "append", [str(more)]:
            return _short(text + more)
        case "substr", [int(start)] if 0 <= start <= len(text):
            return text[start:]
        case "substr", [int(start), int(count)] if 0 <= start <= len(text) and count >= 0:
            return text[start : start + count]
        case "compare", [str(other)]:
            return (text > other) - (text < other)
        case "find", [str(other)] if known:
            found = text.find(other)
            return found if found >= 0 else UNKNOWN
        case (("at" | "front" | "back"), _):
            place = {"front": 0, "back": -1}.get(name, args[0] if args else UNKNOWN)
            return item(text, place)
    return UNKNOWN


def items_method(items: list[Any] | dict[Any, Any], name: str, args: Sequence[Any]) -> Any:
    """`items.name(args)` of a container, without those that change it."""
    match name, args:
        case "empty", []:
            return not items or UNKNOWN  # whatever may have been taken from it
        case (("size" | "length"), []):
            return len(items)
        case (("at" | "operator[]"), [key]):
            return item(items, key)
        case "front", []:
            return item(items, 0)
        case "back", []:
            return item(items, -1)
        case "count", [key] if isinstance(items, dict) and isinstance(key, (str, int)):
            return int(key in items)
    return UNKNOWN


def text_of_stream(stream: Stream) -> Any:
    """What was written to a stream; UNKNOWN if a part of it is not known."""
    parts = [
        str(part) if isinstance(part, (str, int)) and not isinstance(part, bool) else None for part in stream.parts
    ]
    return _short("".join(part for part in parts if part is not None)) if None not in parts else UNKNOWN


def next_word(stream: Stream) -> Any:
    """What `>>` takes out of a stream: None where nothing is left, UNKNOWN if a part of it is not known."""
    text = text_of_stream(stream)
    if text is UNKNOWN:
        return UNKNOWN
    word, *rest = text.split(None, 1) or (None,)
    stream.parts[:] = rest
    return word


def _short(value: Any) -> Any:
    if isinstance(value, str):
        return value if len(value) <= MAX_TEXT else UNKNOWN
    return value if abs(value) < _LARGEST else UNKNOWN
