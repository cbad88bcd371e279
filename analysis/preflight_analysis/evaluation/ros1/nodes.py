"""`<node>` and `<test>` (http://wiki.ros.org/roslaunch/XML/node)."""

from __future__ import annotations

import re

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.environment.model import Executable
from preflight_analysis.evaluation import names, values
from preflight_analysis.evaluation.problems import DuplicateNode, InvalidName
from preflight_analysis.evaluation.resolved import Resolved
from preflight_analysis.evaluation.ros1.attributes import Attributes, applies, integer, plain_number, positive_number
from preflight_analysis.evaluation.ros1.params import evaluate_param, evaluate_rosparam
from preflight_analysis.evaluation.ros1.scope import Scope
from preflight_analysis.evaluation.ros1.state import State
from preflight_analysis.evaluation.ros1.tags import clear_params, evaluate_env, evaluate_remap, namespace_of
from preflight_analysis.evaluation.tree import LaunchNode, Tag, Unknown, Use
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.problems import ConflictingAttributes
from preflight_analysis.launch.schema_ros1 import TAGS


def evaluate_node(state: State, scope: Scope, action: Action, default_machine: str | None) -> None:
    """Add the node of a `<node>` or `<test>` tag, and its parameters."""
    if not applies(state, scope, action):
        return
    is_test = action.kind == "test"
    attributes = Attributes(state, scope, action)
    name = _test_name(attributes) if is_test else attributes.get("name")
    if name is None:
        if not is_test:
            attributes.require("name", "pkg", "type")
        return
    ns = namespace_of(state, scope, action, attributes)
    if ns is None:
        return
    inside = scope.child(ns.text)
    clear_params(attributes, inside, ns.text, node=name.text)
    if names.is_private(name.text):
        _invalid_name(attributes, name.text, "a node's name cannot be private")
        return
    required = attributes.require("pkg", "type")
    if required is None:
        return
    package, executable = (each.text for each in required)
    options = _options(attributes)
    full = names.canonicalize(re.sub("//+", "/", names.join(inside.ns, name.text)))
    unknown_before = len(state.unknowns)
    private, remaps, env = _children(state, scope, inside, action, full)
    for param in (*scope.private_params, *private.private_params):
        below = param.name[1:] if names.is_private(param.name) else param.name
        state.set_param(param._replace(name=names.canonicalize(private.ns + below), owner=full))
    if not _valid(attributes, name, options):
        return
    unknowns = state.unknowns[unknown_before:]
    if not attributes.all_known:
        at = scope.location(action.kind_span)
        unknowns += (Unknown(name, "it is not known", at) for name in attributes.unknown)
        state.unknowns.append(Unknown(f"node {full}", "an attribute of it is not known", at))
    origin = scope.origin(action.head_span)
    if not is_test and name.text and not _claim_name(state, full, origin[-1], scope, action):
        return
    is_wanted = all(each.known for each in required) and not state.outline
    resolved = state.executables.find(package, executable) if is_wanted else Executable(None)
    if resolved.path is not None:
        target = Location.of_file(resolved.path)
        place = scope.location(_span(action, "type"))
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
            tag=Tag(action, origin[-1], scope.lines.text[slice(*action.span)]),
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


def _options(attributes: Attributes) -> _Options:
    for name in ("machine", "args", "output", "respawn", "respawn_delay", "cwd", "launch-prefix", "required"):
        attributes.get(name)
    required = attributes.convert("required", False, values.to_flag)
    respawn = attributes.convert("respawn", False, values.to_flag)
    delay = attributes.convert("respawn_delay", 0.0, plain_number)
    cwd = attributes.text("cwd")
    clear = bool(attributes.text("clear_params")) and attributes.convert("clear_params", False, values.to_flag)
    folder = "ROS_HOME" if cwd == "ros_home" else cwd
    return _Options(required, respawn, delay, attributes.text("output") or "log", folder, clear)


def _valid(attributes: Attributes, name: Resolved, options: _Options) -> bool:
    """What roslaunch checks last, when the children are done."""
    if options.respawn and options.required:
        origin = attributes.scope.origin(attributes.action.kind_span)
        kind = ConflictingAttributes(attributes.action.kind, ("respawn", "required"))
        attributes.state.problem(kind, origin)
        return False
    if name.known and "/" in name.text:
        _invalid_name(attributes, name.text, "a node's name cannot contain a namespace, use the attribute ns")
        return False
    if name.known and not names.is_legal(name.text):
        reason = "a name is a letter, then letters, digits and underscores"
        _invalid_name(attributes, name.text, reason, fatal=False)
    for attribute in ("pkg", "type"):
        found = attributes.get(attribute)
        if found is not None and not found.text.strip():
            attributes.bad_value(attribute, found.text, "not empty")
            return False
    output = attributes.get("output")
    if output is not None and output.known and not attributes.chosen("output", output.text):
        return False
    cwd = attributes.get("cwd")
    return cwd is None or not cwd.known or attributes.chosen("cwd", options.cwd or "")


def _invalid_name(attributes: Attributes, name: str, reason: str, *, fatal: bool = True) -> None:
    origin = attributes.scope.origin(_span(attributes.action, "name"))
    attributes.state.problem(InvalidName(name, "node", reason), origin, fatal=fatal)


def _test_name(attributes: Attributes) -> Resolved | None:
    """The name of a test, after what only tests have."""
    name = attributes.get("name")
    refused = [attributes.action.attribute(refused) for refused in TAGS["test"].refused]
    for attribute in filter(None, refused):
        attributes.refuse(attribute)
        return None
    test_name = attributes.get("test-name")
    if test_name is None:
        attributes.require("test-name", "pkg", "type")
        return None
    attributes.get("time-limit")
    attributes.get("retry")
    attributes.convert("time-limit", None, lambda text: positive_number(text) if text else None)
    attributes.convert("retry", None, lambda text: integer(text) if text else None)
    return name if name is not None and name.text else test_name


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
    state.problem(DuplicateNode(full, state.node_names[full]), origin)
    return False


def _span(action: Action, attribute: str) -> Span:
    found = action.attribute(attribute)
    return found.value.span if found else action.kind_span
