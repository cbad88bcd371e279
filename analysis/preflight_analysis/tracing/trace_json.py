"""The JSON of `ros-preflight trace`: interfaces as the nodes gave them, before namespaces and remaps."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from preflight_analysis.evaluation.json_values import json_value
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.tracing.interface import Endpoint, Interface, ParamUse

SCHEMA = "ros-preflight/trace/1"


def trace_json(nodes: Iterable[tuple[LaunchNode, Interface]]) -> dict[str, Any]:
    """One entry a node. Lines of sources are counted from 1, `seconds` is the wall time of the run."""
    return {"schema": SCHEMA, "nodes": [_node(node, interface) for node, interface in nodes]}


def _node(node: LaunchNode, interface: Interface) -> dict[str, Any]:
    outcome = interface.outcome
    return {
        "name": node.name,
        "package": node.package,
        "executable": node.executable,
        "path": node.resolved.path,
        "interface_source": interface.source,
        "cached": interface.cached,
        "outcome": {
            "status": outcome.status,
            "exit_code": outcome.exit_code,
            "signal": outcome.signal,
            "reason": outcome.reason,
            "seconds": outcome.seconds,
            "answers": list(outcome.answers),
            "stderr_tail": list(outcome.stderr_tail),
        },
        "endpoints": [_endpoint(endpoint) for endpoint in interface.endpoints],
        "params": [_param(use) for use in interface.params],
        **({"unnamed": [_unnamed(endpoint) for endpoint in interface.unnamed]} if interface.unnamed else {}),
        "notes": list(interface.notes),
        **({"looks": True} if interface.looks else {}),
        **({"stand_ins": list(interface.stand_ins)} if interface.stand_ins else {}),
    }


def _endpoint(endpoint: Endpoint) -> dict[str, Any]:
    return {
        "role": endpoint.role,
        "name": endpoint.name,
        "type": endpoint.type,
        "md5": endpoint.md5,
        "qos": json_value(endpoint.qos),
        "builtin": endpoint.builtin,
        "speculative": "made-up answer" in endpoint.evidence.doubts,
        "on_demand": "on demand" in endpoint.evidence.doubts,
        **({"node": endpoint.node} if endpoint.node is not None else {}),
        **_made_at(endpoint),
    }


def _unnamed(endpoint: Endpoint) -> dict[str, Any]:
    """One whose name is random: the name is that of one run."""
    return {"role": endpoint.role, "type": endpoint.type, "seen": endpoint.name, **_made_at(endpoint)}


def _param(use: ParamUse) -> dict[str, Any]:
    data = {"name": use.name, "access": use.access, "mandatory": use.mandatory, "builtin": use.builtin}
    if use.has_default:
        data["default"] = json_value(use.default)
    if use.type is not None:
        data["type"] = use.type
    if use.dynamic:
        data["dynamic"] = True
    if use.read_only:
        data["read_only"] = True
    if use.range is not None:
        data["range"] = [use.range.low, use.range.high, use.range.step]
    if use.node is not None:
        data["node"] = use.node
    return {**data, **_made_at(use)}


def _made_at(what: Endpoint | ParamUse) -> dict[str, Any]:
    return {"source": {"file": what.source_file, "line": what.source_line} if what.source_file else None}
