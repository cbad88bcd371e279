"""The JSON of `ros-preflight tree`: a contract that other programs read (schema `ros-preflight/tree/1`)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.json_values import json_value
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree, Param, ParamValue, Remap
from preflight_analysis.findings.finding import Finding

SCHEMA = "ros-preflight/tree/1"


def tree_json(tree: LaunchTree, documents: Mapping[str, Document], findings: Iterable[Finding]) -> dict[str, Any]:
    """The contract's object. `errors` are the findings that would stop the launcher, what it meets first in front; the
    other ones are of `check`.

    `deferred` (ROS 2) are the nodes that are not started at once. Lines and columns are counted from 1, columns in
    code points. A float that JSON has no number for is a string.
    """
    deferred = [_node(node, tree, documents) for node in tree.nodes if node.deferred]
    errors = sorted((f for f in findings if f.stops_launch), key=lambda finding: finding.launch_order)
    return {
        "schema": SCHEMA,
        **({"deferred": deferred} if tree.ros.deferred_actions else {}),
        "file": tree.file,
        "generation": tree.generation,
        "args": {
            name: {"value": arg.value, "default": arg.default, "required": arg.required}
            for name, arg in tree.args.items()
        },
        "nodes": [_node(node, tree, documents) for node in tree.nodes if not node.deferred],
        "params": {name: json_value(param.value) for name, param in tree.params.items()},
        "clear_params": list(tree.clear_params),
        "includes": [include.path for include in tree.includes if include.path is not None],
        "machines": {
            name: {
                "address": machine.address,
                "env_loader": machine.env_loader,
                "user": machine.user,
                "timeout": json_value(machine.timeout),
            }
            for name, machine in tree.machines.items()
        },
        "unknown": [{"what": unknown.what, "reason": unknown.reason} for unknown in tree.unknowns],
        "errors": [{"rule": f.rule, "message": f.message, **place_json(f.location, documents)} for f in errors],
    }


def place_json(location: Location, documents: Mapping[str, Document]) -> dict[str, Any]:
    """`file`, `line` and `column`; the start of a file that is not an analysed document."""
    document = documents.get(location.file)
    line, column = document.lines.position(location.span.start) if document else (0, 0)
    return {"file": location.file, "line": line + 1, "column": column + 1}


def _node(node: LaunchNode, tree: LaunchTree, documents: Mapping[str, Document]) -> dict[str, Any]:
    private = node.name + "/"
    params = {
        **{name: param for name, param in tree.params.items() if name.startswith(private)},
        **{private + param.name: param for param in node.params},
    }
    launch_files = set(tree.files)
    set_in = (p.name_location.file for p in params.values() if p.name_location is not None)
    param_files = [
        *(s.path for s in node.param_sources if s.path),
        *(file for file in set_in if file not in launch_files),
    ]
    return {
        "name": node.name if node.named else None,
        "namespace": node.namespace,
        "package": node.package,
        "executable": node.executable,
        "kind": node.kind,
        "container": node.container,
        "plugin": node.plugin,
        "args": node.args,
        "remaps": [_remap(node, remap) for remap in node.remaps],
        "env": [list(pair) for pair in node.env],
        "params": {name.removeprefix(private): json_value(_as_launched(param)) for name, param in params.items()},
        "param_files": list(dict.fromkeys(param_files)),
        "machine": node.machine,
        "respawn": node.respawn,
        "respawn_delay": json_value(node.respawn_delay),
        "required": node.required,
        "output": node.output,
        "cwd": node.cwd,
        "launch_prefix": node.launch_prefix,
        "clear_params": node.clear_params,
        "origin": [place_json(step, documents) for step in node.origin],
    }


def _as_launched(param: Param) -> ParamValue:
    return param.value if param.by_launch is None else param.by_launch


def _remap(node: LaunchNode, remap: Remap) -> list[str] | str:
    """As the launcher hands it over: to a container in the form of a rule."""
    return f"{remap.source}:={remap.target}" if node.kind == "composable" else [remap.source, remap.target]
