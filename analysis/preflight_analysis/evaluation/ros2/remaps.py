"""Remaps of ROS 2 as rcl reads them: which of a process's nodes they are for, and what they move.

https://design.ros2.org/articles/static_remapping.html: `node:from` is for the nodes of that name alone.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

from preflight_analysis.evaluation import names

_FOR_ONE = re.compile(r"([A-Za-z_]\w*):(?!//)(.+)\Z")
_PART = re.compile(r"[\w/~:*\\{}]*\Z", re.ASCII)
_OF_NODES = ("__node", "__name", "__ns")
_QOS = "qos_overrides."


def renames_nodes(source: str) -> bool:
    """Whether a remap from this is for the name or the namespace of a node."""
    return _split(source)[1] in _OF_NODES


def source_for(source: str, node: str) -> str | None:
    """The name that a remap from this moves of the node of this full name; None where it is for others."""
    only, plain = _split(source)
    return plain if only in (None, node.rpartition("/")[2]) else None


def is_rule_part(text: str) -> bool:
    """Whether one side of a remap has only characters that rcl's parser knows (`rcl/src/rcl/lexer.c`). For others it
    refuses the whole rule, and with it the node."""
    return _PART.match(text) is not None


def overrides_qos(param: str) -> bool:
    """Whether a parameter is for the QoS of a topic."""
    return param.startswith(_QOS)


def before_remaps(params: Mapping[str, Any], remaps: Iterable[tuple[str, str]], node: str) -> dict[str, Any]:
    """The parameters of a node for a run without its remaps: what overrides the QoS of a topic has the name that the
    topic has after remapping (`qos_overrides./num.publisher.reliability`)."""
    if not any(map(overrides_qos, params)):
        return dict(params)
    targets: dict[str, str] = {}
    for source, target in remaps:
        plain = source_for(source, node)
        if plain is not None and not renames_nodes(source):
            targets.setdefault(names.resolve(plain, node), names.resolve(target, node))
    found: dict[str, Any] = {}
    for name, value in params.items():
        topic, dot, policy = name.removeprefix(_QOS).partition(".")
        if not (overrides_qos(name) and dot):
            found[name] = value
            continue
        sources = [source for source, target in targets.items() if target == topic]
        for before in [*sources, *([topic] if topic not in targets else [])]:
            found[f"{_QOS}{before}.{policy}"] = value
    return found


def _split(source: str) -> tuple[str | None, str]:
    found = _FOR_ONE.match(source)
    return (found[1], found[2]) if found is not None else (None, source)
