"""Parameter YAML as ROS 1 reads it: YAML 1.1, with rosparam's angles (`rad(pi/2)`, `deg(90)`, `!degrees 90`).

http://wiki.ros.org/rosparam#YAML_Format. Nothing is executed: angle expressions are arithmetic only.
"""

from __future__ import annotations

import math
import re
from functools import lru_cache
from typing import Any

import yaml

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Span
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, LIBYAML, PlainLoader, compose_fast
from preflight_analysis.evaluation.expression import EvaluationError, evaluate_arithmetic

MAX_VALUES = 200_000
"""How many values one text may unfold to; aliases of aliases would otherwise fill the memory."""


class YamlError(ValueError):
    """Not YAML, or not what a parameter file may hold. `offset` is where, in code points."""

    def __init__(self, message: str, offset: int | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.offset = offset


@dataclass(frozen=True, slots=True, eq=False)
class YamlValue:
    """A value and, for each path of keys, where its last key is written (`("a", "b")` for `a: {b: 1}`)."""

    value: Any
    keys: dict[tuple[str, ...], Span]
    twice: tuple[tuple[str, Span, Span], ...] = ()
    """Keys that stand twice in one dictionary, with another value the second time: where the first is and the next."""


class _Loader(PlainLoader):
    """YAML 1.1 with ROS's additions; its own class, so that nobody else's loader changes."""


class _LibyamlLoader(LIBYAML):  # type: ignore[misc,valid-type]
    """The same additions to what makes the nodes; values are made by `_Loader`."""


def _inner(loader: yaml.SafeLoader, node: yaml.Node, name: str) -> str:
    text = str(loader.construct_scalar(node)).strip()  # type: ignore[arg-type]
    return text[len(name) + 1 : -1] if text.startswith(name + "(") else text


def _radians(loader: yaml.SafeLoader, node: yaml.Node) -> float:
    text = _inner(loader, node, "rad")
    try:
        return float(evaluate_arithmetic(text))
    except (EvaluationError, TypeError, ValueError, OverflowError) as error:
        raise YamlError(f"{text!r} is not an angle in radians: {error}", node.start_mark.index) from error


def _degrees(loader: yaml.SafeLoader, node: yaml.Node) -> float:
    text = _inner(loader, node, "deg")
    try:
        return float(text) * math.pi / 180.0
    except ValueError as error:
        raise YamlError(f"{text!r} is not an angle in degrees", node.start_mark.index) from error


_Loader.add_constructor("!radians", _radians)
_Loader.add_constructor("!degrees", _degrees)
for _each in (_Loader, _LibyamlLoader):
    _each.add_implicit_resolver("!radians", re.compile(r"^rad\([^\)]*\)$"), ["r"])
    _each.add_implicit_resolver("!degrees", re.compile(r"^deg\([^\)]*\)$"), ["d"])


def load_yaml(text: str) -> YamlValue:
    """The first and only document of `text`; `None` for an empty one. Raises `YamlError`.

    The result is remembered and shared: nobody may change it.
    """
    loaded = _long(text) if len(text) > _MANY_CHARACTERS else _short(text)
    if isinstance(loaded, tuple):
        raise YamlError(*loaded)
    return loaded


def _load(text: str) -> YamlValue | tuple[str, int | None]:
    """The value, or what a `YamlError` is made of. A remembered exception would hold the frames of all who called."""
    try:
        return _parse(text)
    except YamlError as error:
        return error.message, error.offset


_MANY_CHARACTERS = 20_000
_short = lru_cache(maxsize=1024)(_load)
_long = lru_cache(maxsize=64)(_load)
"""Each edit of a long file makes another text: a thousand of them would fill the memory."""


def _parse(text: str) -> YamlValue:
    try:
        node = compose_fast(text, _Loader, _LibyamlLoader)
        keys: dict[tuple[str, ...], Span] = {}
        twice: list[tuple[str, Span, Span]] = []
        _collect_keys(node, (), keys, [0], twice)
        value = _Loader("").construct_document(node) if node is not None else None
    except YamlError:
        raise
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        raise YamlError(error.problem or error.context or "malformed", mark.index if mark else None) from error
    except yaml.reader.ReaderError as error:
        raise YamlError(f"the character {error.character!r} is not allowed", error.position) from error
    except CONSTRUCTION_ERRORS as error:
        raise YamlError(str(error) or type(error).__name__) from error
    return YamlValue(value, keys, tuple(twice))


def _collect_keys(
    node: yaml.Node | None,
    path: tuple[str, ...],
    keys: dict[tuple[str, ...], Span],
    seen: list[int],
    twice: list[tuple[str, Span, Span]],
) -> None:
    seen[0] += 1
    if seen[0] > MAX_VALUES:
        raise YamlError(f"it unfolds to more than {MAX_VALUES} values")
    if isinstance(node, yaml.MappingNode):
        here: dict[str, tuple[Span, yaml.Node]] = {}
        for key, value in node.value:
            if isinstance(key, yaml.ScalarNode):
                below = (*path, key.value)
                if key.tag != "tag:yaml.org,2002:merge":
                    span = keys[below] = Span(key.start_mark.index, key.end_mark.index)
                    first = here.get(key.value)
                    if first is not None and not _same_scalar(first[1], value):
                        twice.append((key.value, first[0], span))
                    here[key.value] = (span, value)
                _collect_keys(value, below, keys, seen, twice)
    elif isinstance(node, yaml.SequenceNode):
        for item in node.value:
            _collect_keys(item, path, keys, seen, twice)


def _same_scalar(one: yaml.Node, other: yaml.Node) -> bool:
    return isinstance(one, yaml.ScalarNode) and isinstance(other, yaml.ScalarNode) and one.value == other.value
