"""Snapshots as files: YAML that reads well in a review, a block a node, the same on each machine."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from typing import Any

import yaml

from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, PlainLoader, load_plain
from preflight_analysis.evaluation.json_values import json_value
from preflight_analysis.snapshot.model import GROUPS, SCHEMA, EndpointSnapshot, NodeSnapshot, Snapshot

_INTRODUCTION = """\
# The expected nodes and connections of a launch configuration.
# Written by `ros-preflight snapshot`, compared by `ros-preflight diff`.
"""
_BREAKS = frozenset("\x85\u2028\u2029\ufeff")
_NODE_KEYS = {"interface", "outcome", "from", "parameters", "reads", "remaps", "env", *GROUPS}


class NotASnapshotError(Exception):
    """The text is no snapshot; says why in a sentence without a subject."""


class _Loader(PlainLoader):
    """Without aliases, which `_Dumper` does not write: what they stand for may hold itself, or unfold without end."""

    def compose_node(self, parent: yaml.Node | None, index: Any) -> yaml.Node | None:
        if self.check_event(yaml.AliasEvent):
            line = self.peek_event().start_mark.line + 1  # type: ignore[no-untyped-call]
            raise NotASnapshotError(f"has an alias (line {line}); write what it stands for")
        return super().compose_node(parent, index)


class _Line(dict[str, Any]):
    """A mapping that is written on one line."""


class _List(list[Any]):
    """A list that is."""


class _Dumper(yaml.SafeDumper):
    def ignore_aliases(self, data: Any) -> bool:
        return True

    def increase_indent(self, flow: bool = False, indentless: bool = False) -> None:
        super().increase_indent(flow, False)


def _text(dumper: yaml.SafeDumper, data: str) -> yaml.ScalarNode:
    """Quoted where PyYAML would write a line break of Unicode's as it is and read a blank."""
    style = '"' if _BREAKS.intersection(data) else None
    return dumper.represent_scalar("tag:yaml.org,2002:str", data, style=style)


_Dumper.add_representer(str, _text)
_Dumper.add_representer(
    _Line, lambda dumper, data: dumper.represent_mapping("tag:yaml.org,2002:map", data, flow_style=True)
)
_Dumper.add_representer(
    _List, lambda dumper, data: dumper.represent_sequence("tag:yaml.org,2002:seq", data, flow_style=True)
)


def to_json(snapshot: Snapshot) -> dict[str, Any]:
    """The snapshot as plain data, of which the file is made (schema `ros-preflight/snapshot/1`)."""
    return {
        "schema": SCHEMA,
        "launch": snapshot.launch,
        "generation": snapshot.generation,
        **_given(args=dict(snapshot.args), errors=list(snapshot.errors), unknown=list(snapshot.unknown)),
        **_given(parameters=dict(snapshot.parameters)),
        "nodes": {name: node_json(node) for name, node in snapshot.nodes.items()},
    }


def to_yaml(snapshot: Snapshot) -> str:
    """The text of the file."""
    data = to_json(snapshot)
    nodes = data.pop("nodes")
    data.update({"parameters": _short(data["parameters"])} if "parameters" in data else {})
    blocks = [_INTRODUCTION + _dump(data)]
    blocks += ["nodes:\n" if nodes else "nodes: {}\n"]
    for name, node in nodes.items():
        lines = {key: _short(value) if isinstance(value, dict) else value for key, value in node.items()}
        blocks.append(textwrap.indent(_dump({name: lines}), "  "))
    return "\n".join(blocks).replace("nodes:\n\n", "nodes:\n", 1)


def from_yaml(text: str) -> Snapshot:
    """The snapshot of a file's text; JSON is read too. Raises `NotASnapshotError`."""
    try:
        data = json_value(load_plain(text, _Loader))
    except CONSTRUCTION_ERRORS as error:
        mark = getattr(error, "problem_mark", None)
        where = f" (line {mark.line + 1})" if mark is not None else ""
        raise NotASnapshotError(f"is no YAML{where}") from None
    if not isinstance(data, Mapping) or "schema" not in data:
        raise NotASnapshotError("has no schema line")
    if data["schema"] != SCHEMA:
        raise NotASnapshotError(f"has the schema {data['schema']}; this release reads {SCHEMA}")
    nodes = _mapping(data, "nodes", "")
    return Snapshot(
        str(data.get("launch", "")),
        data["generation"] if data.get("generation") in (1, 2) else 1,
        {str(name): str(value) for name, value in _mapping(data, "args", "").items()},
        {str(name): _node(_mapping(nodes, name, "nodes "), str(name)) for name in nodes},
        {str(name): value for name, value in _mapping(data, "parameters", "").items()},
        _texts(data, "errors"),
        _texts(data, "unknown"),
    )


def is_snapshot(text: str) -> bool:
    """Whether a text says of itself that it is a snapshot, of whichever version."""
    start = "\n".join(line for line in text.splitlines()[:100] if not line.lstrip().startswith("#"))
    return "ros-preflight/snapshot/" in start and "<launch" not in start


def node_json(node: NodeSnapshot) -> dict[str, Any]:
    """One node as plain data."""
    return {
        **node.facts,
        **_given(**{"from": node.origin}),
        "interface": node.interface,
        **({"outcome": node.outcome} if node.outcome != "not-run" else {}),
        **{
            group: {name: {"type": endpoint.type, **endpoint.qos} for name, endpoint in node.endpoints[role].items()}
            for group, role in GROUPS.items()
            if node.endpoints.get(role)
        },
        **_given(
            parameters=dict(node.parameters),
            reads={name: dict(read) for name, read in node.reads.items()},
            remaps=dict(node.remaps),
            env=dict(node.env),
        ),
    }


def _short(values: Mapping[str, Any]) -> dict[str, Any]:
    """The same, each value on a line."""
    return {
        name: _Line(value) if isinstance(value, dict) else _List(value) if isinstance(value, list) else value
        for name, value in values.items()
    }


def _given(**values: Any) -> dict[str, Any]:
    return {key: value for key, value in values.items() if value}


def _dump(data: Mapping[str, Any]) -> str:
    text: str = yaml.dump(
        data, Dumper=_Dumper, sort_keys=False, allow_unicode=True, default_flow_style=False, width=float("inf")
    )
    return text


def _node(data: Mapping[str, Any], name: str) -> NodeSnapshot:
    endpoints: dict[str, dict[str, EndpointSnapshot]] = {}
    for group, role in GROUPS.items():
        found = _mapping(data, group, f"{name} ")
        if found:
            endpoints[role] = {str(of): _endpoint(said, f"{name} {group} {of}") for of, said in found.items()}
    reads = _mapping(data, "reads", f"{name} ")
    return NodeSnapshot(
        {str(key): value for key, value in data.items() if key not in _NODE_KEYS},
        data.get("from"),
        str(data.get("interface", "none")),
        str(data.get("outcome", "not-run")),
        endpoints,
        {str(key): value for key, value in _mapping(data, "parameters", f"{name} ").items()},
        {str(key): _mapping(reads, key, f"{name} reads ") for key in reads},
        {str(key): str(value) for key, value in _mapping(data, "remaps", f"{name} ").items()},
        {str(key): str(value) for key, value in _mapping(data, "env", f"{name} ").items()},
    )


def _endpoint(said: Any, where: str) -> EndpointSnapshot:
    """A type, or a mapping with the type and the QoS."""
    if said is None or isinstance(said, str):
        return EndpointSnapshot(said)
    if not isinstance(said, Mapping):
        raise NotASnapshotError(f"has no type at {where}")
    type_ = said.get("type")
    return EndpointSnapshot(None if type_ is None else str(type_), {str(k): v for k, v in said.items() if k != "type"})


def _mapping(data: Mapping[Any, Any], key: Any, where: str) -> Mapping[Any, Any]:
    found = data.get(key)
    if found is None:
        return {}
    if not isinstance(found, Mapping):
        raise NotASnapshotError(f"has no names with values at {where}{key}")
    return found


def _texts(data: Mapping[str, Any], key: str) -> tuple[str, ...]:
    found = data.get(key) or ()
    if not isinstance(found, (list, tuple)):
        raise NotASnapshotError(f"has no list at {key}")
    return tuple(map(str, found))
