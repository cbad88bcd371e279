"""Values of parameters as rcl reads them, which has a YAML of its own (`rcl_yaml_param_parser/src/parse.c`).

It differs from PyYAML, by which launch reads what stands in launch files: `y` is a bool, `1e3` a double, `12:30:00`,
`1_000` and `null` are texts. As launch writes what it read into a file for rcl, without quotes where PyYAML needs none,
a text of the launch file may arrive as something else.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from typing import Any

import yaml
from yaml.resolver import Resolver

_TRUE = frozenset(("Y", "y", "yes", "Yes", "YES", "true", "True", "TRUE", "on", "On", "ON"))
_FALSE = frozenset(("N", "n", "no", "No", "NO", "false", "False", "FALSE", "off", "Off", "OFF"))
_INTEGER = re.compile(r"[-+]?(0[xX][0-9a-fA-F]+|0[0-7]*|[1-9][0-9]*)", re.ASCII)
_DOUBLE = re.compile(
    r"[-+]?([0-9]+\.?[0-9]*([eE][-+]?[0-9]+)?|\.[0-9]+([eE][-+]?[0-9]+)?|\.?(inf|nan)|infinity"
    r"|0x[0-9a-f]+(\.[0-9a-f]*)?(p[-+]?[0-9]+)?)",
    re.ASCII | re.IGNORECASE,
)
_MOST = 2**63
_STRING_TAG = "tag:yaml.org,2002:str"
_RESOLVER: Any = Resolver()
_MAX_TEXT = 400


def scalar(node: yaml.ScalarNode) -> bool | int | float | str:
    """What rcl makes of a single value."""
    text = str(node.value)
    if node.style in ("'", '"'):
        return text
    read = plain_scalar(text)
    return text if not isinstance(read, str) and _is_marked(node) else read


def plain_scalar(text: str) -> bool | int | float | str:
    """What rcl makes of a text without quotes."""
    if text in _TRUE or text in _FALSE:
        return text in _TRUE
    if len(text) > _MAX_TEXT:
        return text
    if _INTEGER.fullmatch(text):
        sign = -1 if text.startswith("-") else 1
        digits = text.lstrip("+-").lower()
        number = sign * int(digits, 16 if digits.startswith("0x") else 8 if digits.startswith("0") else 10)
        return number if -_MOST <= number < _MOST else _double(text, lambda: float(number))
    if _DOUBLE.fullmatch(text):
        plain = re.sub(r"\.(?=inf|nan)", "", text.lower())
        value = _double(text, lambda: float.fromhex(plain) if "0x" in plain else float(plain))
        return text if value in (float("inf"), float("-inf")) and "inf" not in plain else value
    return text


def _double(text: str, convert: Callable[[], float]) -> float | str:
    """A number that is too large for a double stays a text."""
    try:
        return convert()
    except OverflowError:
        return text


def _is_marked(node: yaml.ScalarNode) -> bool:
    """Whether a tag says that it is a text; PyYAML gives the same tag to what it takes for one by itself."""
    return node.tag == _STRING_TAG and _RESOLVER.resolve(yaml.ScalarNode, node.value, (True, False)) != _STRING_TAG


def value(node: yaml.Node) -> Any:
    """What rcl makes of the value of a parameter. What is in it that a parameter cannot have is None."""
    if isinstance(node, yaml.SequenceNode):
        return [scalar(each) if isinstance(each, yaml.ScalarNode) else None for each in node.value]
    return scalar(node) if isinstance(node, yaml.ScalarNode) and refused(node) is None else None


def refused(node: yaml.Node) -> str | None:
    """Why rcl refuses the whole file for the value of a parameter."""
    if isinstance(node, yaml.ScalarNode):
        return "a parameter without a value" if node.value == "" and not node.style else None
    if not isinstance(node, yaml.SequenceNode):
        return None
    mixed = refused_items([scalar(each) for each in node.value if isinstance(each, yaml.ScalarNode)])
    if mixed is not None:
        return mixed
    if any(isinstance(each, yaml.MappingNode) for each in node.value):
        # rcl takes the values of all of them for items of the list.
        return "a list with dictionaries in it" if refused_items(map(scalar, _values_in(node))) is not None else None
    if len(node.value) > 1 and any(isinstance(each, yaml.SequenceNode) for each in node.value):
        return "a list of lists"
    return None


def _values_in(node: yaml.Node) -> Iterator[yaml.ScalarNode]:
    waiting = [node]
    while waiting:
        each = waiting.pop()
        if isinstance(each, yaml.ScalarNode):
            yield each
        else:
            waiting += each.value if isinstance(each, yaml.SequenceNode) else [value for _, value in each.value]


def refused_items(items: Iterable[bool | int | float | str]) -> str | None:
    """Why rcl refuses a list of these."""
    named = sorted({_NAMES[kind] for kind in map(type, items) if kind in _NAMES})
    return f"a list with {', '.join(named[:-1])} and {named[-1]} in it" if len(named) > 1 else None


_NAMES = {bool: "bools", int: "integers", float: "doubles", str: "texts"}


def as_passed(given: Any) -> Any:
    """What arrives at a node of a value that stands in a launch file."""
    if isinstance(given, (list, tuple)):
        return [as_passed(each) for each in given]
    if isinstance(given, int) and not -_MOST <= given < _MOST:
        return plain_scalar(str(given))
    if not isinstance(given, str):
        return given
    read = plain_scalar(given)
    if isinstance(read, str) or yaml.safe_dump(given).startswith(("'", '"')):
        return given
    return read
