"""Interfaces to NoDL documents (version 2). What a document cannot say stands in it as a comment.

Schema: https://github.com/ros-tooling/nodl/blob/main/nodl_schema/nodl_schema/schemas/nodl.schema.yaml
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

import yaml

from preflight_analysis.evaluation.json_values import json_value
from preflight_analysis.generation import ros
from preflight_analysis.graph.actions import actions_of
from preflight_analysis.graph.model import Graph
from preflight_analysis.interfaces.nodl_groups import GROUPS
from preflight_analysis.tracing.interface import Endpoint, Interface, ParamUse, Role

_NAME = re.compile(r"[A-Za-z]\Z|[/~A-Za-z][A-Za-z0-9_/]*[A-Za-z0-9_]\Z")
_TYPE = re.compile(r"[a-zA-Z][a-zA-Z0-9_]*(/(msg|srv|action))?/[A-Z][a-zA-Z0-9]*\Z")
_TYPES = {bool: "bool", int: "int", float: "double", str: "string"}


def nodl_files(graph: Graph) -> dict[str, str]:
    """A document for each executable of the graph of which anything is known, by `package/name.nodl.yaml`. Nodes of one
    executable make one document of all that they do."""
    known: dict[tuple[str, str], list[Interface]] = {}
    for node, interface in zip(graph.tree.nodes, graph.interfaces, strict=True):
        if interface.known and node.package:
            name = node.plugin.rpartition("::")[2] if node.plugin else node.executable.removesuffix(".py")
            known.setdefault((node.package, name), []).append(interface)
    return {
        f"{package}/{name.replace('/', '_')}.nodl.yaml": nodl(interfaces, graph.tree.generation)
        for (package, name), interfaces in sorted(known.items())
        if "/" not in package and package not in ("..", ".")
    }


def nodl(interfaces: Sequence[Interface], generation: int) -> str:
    """The document of a node that does all of that."""
    endpoints: dict[tuple[Role, str], Endpoint] = {}
    params: dict[str, ParamUse] = {}
    for interface in interfaces:
        actions = actions_of(interface.endpoints)
        parts = {id(topic) for action in actions for topic in action.parts}
        of_actions = {(action.endpoint.role, action.endpoint.name) for action in actions}
        plain = [e for e in interface.endpoints if id(e) not in parts and (e.role, e.name) not in of_actions]
        for endpoint in (*plain, *(action.endpoint for action in actions)):
            if not endpoint.builtin:
                endpoints.setdefault((endpoint.role, endpoint.name), endpoint)
        for use in interface.params:
            if not use.builtin and use.access in ("get", "has"):
                known = params.get(use.name)
                params[use.name] = use if known is None or not known.has_default else known
    data: dict[str, Any] = {"nodl_version": 2}
    left_out: list[str] = []
    for name, use in sorted(params.items()):
        type_ = _param_type(use.default) if use.has_default else None
        if not name.startswith("~") or type_ is None:
            left_out.append(f"parameter {name}: {'type not known' if name.startswith('~') else 'not its own'}")
            continue
        about = {"type": type_, "default_value": json_value(use.default)}
        data.setdefault("parameters", {})[name[1:].lstrip("/")] = about
    for (role, name), endpoint in sorted(endpoints.items()):
        entry = _endpoint(endpoint, generation)
        if isinstance(entry, str):
            left_out.append(f"{role.replace('_', ' ')} {name}: {entry}")
        else:
            data.setdefault(GROUPS[role], []).append(entry)
    sources = ", ".join(sorted({interface.source for interface in interfaces}))
    lines = ["---", f"# Written by `ros-preflight snapshot --format nodl`; known by: {sources}."]
    lines += [f"# Left out: {' '.join(each.split())}" for each in left_out]
    body: str = yaml.safe_dump(data, sort_keys=False, allow_unicode=True, width=float("inf"))
    return "\n".join(lines) + "\n" + body


def _endpoint(endpoint: Endpoint, generation: int) -> dict[str, Any] | str:
    """The entry of an endpoint, or why there can be none."""
    name = f"~/{endpoint.name[1:].lstrip('/')}" if endpoint.name.startswith("~") else endpoint.name
    type_ = endpoint.type or ""
    if ros(generation).native_actions and endpoint.role.startswith("action"):
        type_ = type_.removesuffix("Action")
    if not _TYPE.match(type_):
        return "type not known"
    if not _NAME.match(name):
        return "no name of ROS 2"
    entry: dict[str, Any] = {"name": name, "type": type_}
    if endpoint.role in ("publisher", "subscriber"):
        entry["qos"] = _qos_2(endpoint.qos) if ros(generation).has_qos else _qos_1(endpoint.qos)
    return entry


def _qos_1(qos: Mapping[str, Any]) -> dict[str, Any]:
    """Topics of ROS 1 are reliable, and a latched one is what ROS 2 calls transient local."""
    latched = {"durability": "TRANSIENT_LOCAL"} if qos.get("latch") else {}
    return {**_history(qos.get("queue_size")), "reliability": "RELIABLE", **latched}


def _qos_2(qos: Mapping[str, Any]) -> dict[str, Any]:
    reliability, durability = qos.get("reliability"), qos.get("durability")
    return {
        **_history(qos.get("depth")),
        "reliability": str(reliability).upper() if reliability else "SYSTEM_DEFAULT",
        **({"durability": str(durability).upper()} if durability else {}),
    }


def _history(depth: Any) -> dict[str, Any]:
    known = isinstance(depth, int) and not isinstance(depth, bool) and depth > 0
    return {"history": "KEEP_LAST", "depth": depth} if known else {"history": "SYSTEM_DEFAULT"}


def _param_type(value: Any) -> str | None:
    """The type of a default, None where it has none that NoDL knows."""
    if isinstance(value, (list, tuple)):
        kinds = {_TYPES.get(type(each)) for each in value}
        kinds = {"double"} if kinds == {"int", "double"} else kinds
        kind = kinds.pop() if len(kinds) == 1 else None
        return f"{kind}_array" if kind else None
    return _TYPES.get(type(value))
