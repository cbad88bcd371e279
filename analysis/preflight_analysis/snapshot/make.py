"""Graph to snapshot."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from typing import Any

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.json_values import json_value
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree, Param
from preflight_analysis.graph.model import Connection, Graph, ParamRead
from preflight_analysis.snapshot.model import GROUPS, EndpointSnapshot, NodeSnapshot, Snapshot
from preflight_analysis.snapshot.portable import Portable
from preflight_analysis.tracing.interface import Interface, Outcome
from preflight_analysis.workspace.workspace import Analysis

MAX_TEXT = 200
"""Characters of a text that is kept as it is; a robot description has thousands of lines, and is kept by its digest."""
MAX_WRITTEN = 80
"""Characters of the text that an error is on."""


def snapshot_of(analysis: Analysis, graph: Graph) -> Snapshot:
    """What is to be kept of an analysed launch file and of `graph`, that of its nodes."""
    tree = graph.tree
    portable = Portable(analysis.environment, tree.generation)
    endpoints, reads = _by_node(graph)
    own, shared = _parameters(tree)
    found = [
        (node, _node(node, interface, endpoints[id(node)], reads[id(node)], own.get(node.name, ()), portable))
        for node, interface in zip(tree.nodes, graph.interfaces, strict=True)
    ]
    nodes: dict[str, NodeSnapshot] = {}
    for node, snapshot in sorted(found, key=lambda each: (each[0].name, each[0].package, each[0].executable)):
        nodes[_free(node.name, nodes)] = snapshot
    # No messages: they speak of what is installed on this machine.
    errors = {
        f"{f.rule} {_written(f.location, analysis)} ({portable.text(f.location.file)})"
        for f in analysis.findings
        if f.stops_launch
    }
    unknown = {f"{portable.text(each.what)} ({portable.text(each.location.file)})" for each in tree.unknowns}
    return Snapshot(
        portable.text(tree.file),
        tree.generation,
        {name: portable.text(value) for name, value in sorted(analysis.args)},
        nodes,
        {param.name: _value(param, portable) for param in sorted(shared)},
        tuple(sorted(errors)),
        tuple(sorted(unknown)),
    )


def _written(location: Location, analysis: Analysis) -> str:
    """What stands at a place, on one line."""
    document = analysis.documents.get(location.file)
    text = document.text[location.span.start : location.span.end] if document is not None else ""
    words = " ".join(text.split())
    return words if len(words) <= MAX_WRITTEN else f"{words[:MAX_WRITTEN]}…"


def _by_node(graph: Graph) -> tuple[dict[int, list[Connection]], dict[int, list[ParamRead]]]:
    endpoints: dict[int, list[Connection]] = {id(node): [] for node in graph.tree.nodes}
    for channels in (graph.topics, graph.services, graph.actions):
        for channel in channels.values():
            for connection in (*channel.providers, *channel.consumers):
                if not connection.endpoint.builtin and connection.action is None:
                    endpoints[id(connection.node)].append(connection)
    reads: dict[int, list[ParamRead]] = {id(node): [] for node in graph.tree.nodes}
    for read in graph.param_reads:
        if not read.use.builtin and read.use.access not in ("set", "delete"):
            reads[id(read.node)].append(read)
    return endpoints, reads


def _parameters(tree: LaunchTree) -> tuple[dict[str, list[Param]], list[Param]]:
    """The parameters below each node's name, and those below none."""
    own: dict[str, list[Param]] = {node.name: [] for node in tree.nodes}
    shared: list[Param] = []
    for param in tree.params.values():
        owner = param.name
        while owner and owner not in own:
            owner = owner.rpartition("/")[0]
        if owner and owner != param.name:
            own[owner].append(param._replace(name=param.name[len(owner) + 1 :]))
        else:
            shared.append(param)
    return own, shared


def _node(
    node: LaunchNode,
    interface: Interface,
    connections: Iterable[Connection],
    reads: Iterable[ParamRead],
    params: Iterable[Param],
    portable: Portable,
) -> NodeSnapshot:
    given: dict[str, Any] = {
        "kind": None if node.kind == "node" else node.kind,
        "container": node.container,
        "plugin": node.plugin,
        "args": portable.text(node.args) or None,
        "machine": node.machine,
        "respawn": node.respawn or None,
        "respawn_delay": json_value(node.respawn_delay) or None,
        "required": node.required or None,
        "deferred": node.deferred or None,
        "cwd": portable.text(node.cwd) if node.cwd else None,
        "launch_prefix": portable.text(node.launch_prefix) if node.launch_prefix else None,
        "clear_params": node.clear_params or None,
    }
    values = {param.name: _value(param, portable) for param in (*params, *node.params)}
    return NodeSnapshot(
        {
            "package": node.package,
            "executable": portable.text(node.executable),
            **{key: value for key, value in given.items() if value is not None},
        },
        portable.text(node.location.file),
        interface.source,
        _outcome(interface.outcome),
        {role: endpoints for role in GROUPS.values() if (endpoints := _endpoints(role, connections))},
        {name: values[name] for name in sorted(values)},
        _reads(reads, portable),
        {remap.source: remap.target for remap in sorted(node.remaps, key=lambda each: each.source)},
        {name: portable.text(value) for name, value in sorted(node.env)},
    )


def _outcome(outcome: Outcome) -> str:
    return (
        f"{outcome.status} {outcome.exit_code}" if outcome.status == "exited" and outcome.exit_code else outcome.status
    )


def _endpoints(role: str, connections: Iterable[Connection]) -> dict[str, EndpointSnapshot]:
    """The ends of one role by name. Two of one name and of different types count as one of both."""
    types: dict[str, set[str]] = {}
    qos: dict[str, Mapping[str, Any]] = {}
    for connection in connections:
        if connection.endpoint.role == role:
            of_name = types.setdefault(connection.name, set())
            if connection.endpoint.type is not None:
                of_name.add(connection.endpoint.type)
            qos.setdefault(connection.name, json_value(dict(connection.endpoint.qos)))
    return {
        name: EndpointSnapshot(
            " | ".join(sorted(types[name])) or None,
            {key: value for key, value in sorted(qos[name].items()) if value is not None},
        )
        for name in sorted(types)
    }


def _reads(reads: Iterable[ParamRead], portable: Portable) -> dict[str, dict[str, Any]]:
    found: dict[str, dict[str, Any]] = {}
    for read in reads:
        entry = found.setdefault(read.name, {})
        if read.use.has_default:
            entry.setdefault("default", _short(portable.value(json_value(read.use.default))))
        if read.use.mandatory:
            entry["required"] = True
    return {name: found[name] for name in sorted(found)}


def _value(param: Param, portable: Portable) -> Any:
    return _short(portable.value(json_value(param.value)))


def _short(value: Any) -> Any:
    if isinstance(value, str) and len(value) > MAX_TEXT:
        digest = hashlib.sha1(value.encode("utf-8", "surrogatepass"), usedforsecurity=False).hexdigest()
        return {"characters": len(value), "sha1": digest}
    if isinstance(value, list):
        return [_short(each) for each in value]
    if isinstance(value, dict):
        return {key: _short(each) for key, each in value.items()}
    return value


def _free(name: str, taken: Mapping[str, NodeSnapshot]) -> str:
    number, free = 1, name
    while free in taken:
        number += 1
        free = f"{name}#{number}"
    return free
