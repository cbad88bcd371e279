"""The JSON of `ros-preflight graph`: a contract that other programs read (schema `ros-preflight/graph/1`)."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from preflight_analysis.evaluation.json_values import json_value
from preflight_analysis.graph.model import Channel, Connection, Graph, ParamRead
from preflight_analysis.graph.tf_frames import frames_of
from preflight_analysis.tracing.interface import Endpoint, Frame, Interface

SCHEMA = "ros-preflight/graph/1"

_KEYS = {
    "publisher": "publishers",
    "subscriber": "subscribers",
    "service": "services",
    "client": "clients",
    "action_server": "action_servers",
    "action_client": "action_clients",
}


def graph_json(graph: Graph) -> dict[str, Any]:
    """The contract's object. Names are final ones, after namespaces and remaps."""
    connections: dict[int, list[Connection]] = {id(node): [] for node in graph.tree.nodes}
    for channels in (graph.topics, graph.services, graph.actions):
        for channel in channels.values():
            for connection in (*channel.providers, *channel.consumers):
                connections[id(connection.node)].append(connection)
    reads: dict[int, list[ParamRead]] = {id(node): [] for node in graph.tree.nodes}
    for read in graph.param_reads:
        reads[id(read.node)].append(read)
    return {
        "schema": SCHEMA,
        "nodes": [
            {
                "name": node.name,
                "package": node.package,
                "executable": node.executable,
                **interface_json(interface, connections[id(node)], reads[id(node)]),
                **_frames(frames_of(node, interface)),
            }
            for node, interface in zip(graph.tree.nodes, graph.interfaces, strict=True)
        ],
        "topics": {name: _channel(c, "publishers", "subscribers") for name, c in graph.topics.items()},
        "services": {name: _channel(c, "servers", "clients") for name, c in graph.services.items()},
        "actions": {name: _channel(c, "servers", "clients") for name, c in graph.actions.items()},
    }


def interface_json(
    interface: Interface, connections: Iterable[Connection], reads: Iterable[ParamRead]
) -> dict[str, Any]:
    """One node: how it is known, how its run ended, and its ends under their final names. Those whose names are random
    in each run are `unnamed`."""
    lists: dict[str, list[dict[str, Any]]] = {key: [] for key in _KEYS.values()}
    for connection in connections:
        endpoint = connection.endpoint
        end: dict[str, Any] = {"name": connection.name, "type": endpoint.type, "qos": json_value(endpoint.qos)}
        end.update(_flags(endpoint))
        if connection.action is not None:
            end["action"] = connection.action
        lists[_KEYS[endpoint.role]].append(end)
    return {
        "interface_source": interface.source,
        "outcome": interface.outcome.status,
        **{key: sorted(found, key=lambda end: (end["name"], str(end["type"]))) for key, found in lists.items()},
        "params_read": _params_read(reads),
        **({"unnamed": [{"role": e.role, "type": e.type} for e in interface.unnamed]} if interface.unnamed else {}),
    }


def _flags(endpoint: Endpoint) -> dict[str, bool]:
    known = endpoint.evidence
    flags = {
        "builtin": endpoint.builtin,
        "speculative": "made-up answer" in known.doubts,
        "on_demand": "on demand" in known.doubts,
        "inferred": known.inferred,
        "similar": known.source == "similar",
    }
    return {flag: True for flag, holds in flags.items() if holds}


def _frames(frames: Iterable[Frame]) -> dict[str, Any]:
    """The transforms that the node broadcasts, where any are known."""
    found = [{"parent": frame.parent, "child": frame.child, "static": frame.static} for frame in frames]
    return {"frames": found} if found else {}


def _params_read(reads: Iterable[ParamRead]) -> list[dict[str, Any]]:
    """Each parameter that the node asks for once, with the default it gives, if any."""
    found: dict[str, dict[str, Any]] = {}
    for read in reads:
        if read.use.access in ("set", "delete"):
            continue
        entry = found.setdefault(read.name, {"name": read.name, "mandatory": False})
        entry["mandatory"] |= read.use.mandatory
        if read.use.has_default:
            entry["default"] = json_value(read.use.default)
        if read.use.builtin:
            entry["builtin"] = True
    return [found[name] for name in sorted(found)]


def _channel(channel: Channel, provider: str, consumer: str) -> dict[str, Any]:
    data: dict[str, Any] = {
        "types": list(channel.types),
        provider: sorted({c.node.name for c in channel.providers}),
        consumer: sorted({c.node.name for c in channel.consumers}),
    }
    if channel.domain:
        data |= {"name": channel.name, "domain": channel.domain}
    if all(c.endpoint.builtin for c in (*channel.providers, *channel.consumers)):
        data["builtin"] = True
    return data
