"""`<node>` and `<test>` (http://wiki.ros.org/roslaunch/XML/node)."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation import names, values
from preflight_analysis.evaluation.ros1.attributes import Attributes, applies, integer, plain_number, positive_number
from preflight_analysis.evaluation.ros1.params import evaluate_param, evaluate_rosparam, set_param
from preflight_analysis.evaluation.ros1.scope import Scope
from preflight_analysis.evaluation.ros1.state import State
from preflight_analysis.evaluation.ros1.tags import clear_params, evaluate_env, evaluate_remap, namespace_of
from preflight_analysis.evaluation.tree import Executable, LaunchNode, Unknown, Use
from preflight_analysis.launch.model import Action


def evaluate_node(state: State, scope: Scope, action: Action, default_machine: str | None) -> None:
    """Add the node of a `<node>` or `<test>` tag, and its parameters."""
    if not applies(state, scope, action):
        return
    is_test = action.kind == "test"
    attributes = Attributes(state, scope, action)
    if is_test and not _test_attributes(attributes):
        return
    required = attributes.require("pkg", "type", *(("test-name",) if is_test else ("name",)))
    if required is None:
        return
    package, executable, name = (found.text for found in required)
    if is_test:
        name = attributes.text("name") or name
    if "/" in name:
        state.problem(
            "invalid-name",
            scope.origin(_span(action, "name")),
            what="node",
            name=name,
            reason="a node's name cannot contain a namespace, use the attribute ns",
        )
        return
    if not names.is_legal(name) and attributes.all_known:
        reason = "a name is a letter, then letters, digits and underscores"
        origin = scope.origin(_span(action, "name"))
        state.problem("invalid-name", origin, fatal=False, what="node", name=name, reason=reason)
    for attribute, text in (("pkg", package), ("type", executable)):
        if not text.strip():
            attributes.bad_value(attribute, text, "not empty")
            return
    ns = namespace_of(state, scope, action, attributes)
    if ns is None:
        return
    inside = scope.child(ns.text)
    clear_params(state, scope, action, attributes, inside, ns.text, node=name)
    options = _options(attributes)
    if options is None:
        return
    full = names.canonicalize(re.sub("//+", "/", names.join(inside.ns, name)))
    unknown_before = len(state.unknowns)
    private, remaps, env = _children(state, scope, inside, action, full)
    for param in (*scope.private_params, *private.private_params):
        below = param.name[1:] if names.is_private(param.name) else param.name
        set_param(state, replace(param, name=names.canonicalize(private.ns + below), owner=full))
    unknowns = state.unknowns[unknown_before:]
    if not attributes.all_known:
        unknown = Unknown(f"node {full}", "an attribute of it is not known", Location(scope.file, action.kind_span))
        unknowns.append(unknown)
        state.unknowns.append(unknown)
    origin = scope.origin(action.head_span)
    if not is_test and not _claim_name(state, full, origin[-1], scope, action):
        return
    resolved = state.executables.find(package, executable) if attributes.all_known else Executable(None)
    if resolved.path is not None:
        target = Location(resolved.path, Span(0, 0))
        place = Location(scope.file, _span(action, "type"))
        state.uses.append(Use("executable", place, executable, resolved.path, target))
    state.nodes.append(
        LaunchNode(
            name=full,
            namespace=re.sub("//+", "/", inside.ns),
            package=package,
            executable=executable,
            kind=action.kind,
            args=attributes.text("args") or "",
            remaps=tuple(remaps.remaps()),
            env=tuple(env.env),
            origin=origin,
            action=action,
            resolved=resolved,
            machine=attributes.text("machine") or default_machine,
            respawn=options.respawn,
            respawn_delay=options.respawn_delay,
            required=options.required,
            output=options.output,
            cwd=options.cwd,
            launch_prefix=attributes.text("launch-prefix") or None,
            clear_params=options.clear,
            unknowns=tuple(unknowns),
        )
    )


@dataclass(frozen=True, slots=True)
class _Options:
    required: bool
    respawn: bool
    respawn_delay: float
    output: str
    cwd: str | None
    clear: bool


def _options(attributes: Attributes) -> _Options | None:
    state, scope, action = attributes.state, attributes.scope, attributes.action
    required = attributes.convert("required", False, values.to_flag)
    respawn = attributes.convert("respawn", False, values.to_flag)
    delay = attributes.convert("respawn_delay", 0.0, plain_number)
    if respawn and required:
        state.problem(
            "attributes-exclude", scope.origin(action.kind_span), tag=action.kind, names=["respawn", "required"]
        )
        return None
    output = attributes.get("output")
    if output is not None and output.known and output.text not in ("log", "screen"):
        attributes.bad_value("output", output.text, "log or screen", ("log", "screen"))
        return None
    cwd = attributes.get("cwd")
    folder = "ROS_HOME" if cwd is not None and cwd.text == "ros_home" else cwd.text if cwd is not None else None
    if cwd is not None and cwd.known and folder not in ("ROS_HOME", "node"):
        attributes.bad_value("cwd", cwd.text, "ROS_HOME or node", ("ROS_HOME", "node"))
        return None
    clear = attributes.convert("clear_params", False, values.to_flag)
    return _Options(required, respawn, delay, output.text if output else "log", folder, clear)


def _test_attributes(attributes: Attributes) -> bool:
    if attributes.refused():
        return False
    attributes.convert("time-limit", None, lambda text: positive_number(text) if text else None)
    attributes.convert("retry", None, lambda text: integer(text) if text else None)
    return True


def _children(state: State, scope: Scope, inside: Scope, action: Action, full: str) -> tuple[Scope, Scope, Scope]:
    """Parameters are evaluated below the node's own name, remaps and environment beside it."""
    private = inside.child(full)
    private.private_params = []
    remaps, env = scope.child(), scope.child()
    for child in action.children:
        kind = child.kind.lower()
        if kind == "remap":
            remap = evaluate_remap(state, scope, child, inside_node=True)
            if remap is not None:
                remaps.add_remap(remap)
        elif kind == "param":
            evaluate_param(state, private, child, node=full)
        elif kind == "rosparam":
            evaluate_rosparam(state, private, child, node=full)
        elif kind == "env":
            evaluate_env(state, env, child)
    return private, remaps, env


def _claim_name(state: State, full: str, location: Location, scope: Scope, action: Action) -> bool:
    if full not in state.node_names:
        state.node_names[full] = location
        return True
    origin = scope.origin(_span(action, "name"))
    state.problem("duplicate-node", origin, name=full, first=state.node_names[full])
    return False


def _span(action: Action, attribute: str) -> Span:
    found = action.attribute(attribute)
    return found.value.span if found else action.kind_span
