"""The small tags: remap, env, machine, and the attributes `ns` and `clear_params` that several tags share."""

from __future__ import annotations

from preflight_analysis.evaluation import names, values
from preflight_analysis.evaluation.problems import InvalidName
from preflight_analysis.evaluation.resolved import Resolved
from preflight_analysis.evaluation.ros1.attributes import Attributes, applies, integer, positive_number
from preflight_analysis.evaluation.ros1.scope import Scope
from preflight_analysis.evaluation.ros1.state import State
from preflight_analysis.evaluation.tree import Machine, Remap, Use
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.problems import UnknownElement
from preflight_analysis.launch.schema_ros1 import TAGS

_REFUSED_MACHINE = tuple(name for name in TAGS["machine"].refused if name != "env")


def evaluate_remap(state: State, scope: Scope, action: Action, *, inside_node: bool) -> Remap | None:
    """A `<remap>` (http://wiki.ros.org/roslaunch/XML/remap), None where it does not apply or is wrong."""
    if not applies(state, scope, action):
        return None
    attributes = Attributes(state, scope, action)
    found = attributes.require("from", "to")
    if found is None:
        return None
    places = [attribute.value.span for attribute in map(action.attribute, ("from", "to")) if attribute is not None]
    if not attributes.all_known:
        state.unknown("<remap>", "a name in it is not known", scope, action.kind_span)
        return None
    ends = [names.canonicalize(side.text) for side in found]
    for end, span in zip(ends, places, strict=True):
        if not end or not names.is_legal(end):
            reason = "a name is a letter, ~ or /, then letters, digits, _ and /" if end else "it is empty"
            state.problem(InvalidName(end, "remap", reason), scope.origin(span))
            return None
    source, target = (scope.location(span) for span in places)
    return Remap(ends[0], ends[1], scope.origin(action.head_span), source, target, inside_node)


def evaluate_env(state: State, scope: Scope, action: Action) -> None:
    """An `<env>`: for the nodes that come later in the scope."""
    if not applies(state, scope, action):
        return
    attributes = Attributes(state, scope, action)
    found = attributes.require("name", "value")
    if found is None:
        return
    if not found[0].text:
        attributes.bad_value("name", "", "not empty")
        return
    if not attributes.all_known:
        state.unknown(f"environment variable {found[0].text}", "its value is not known", scope, action.kind_span)
    scope.env.append((found[0].text, found[1].text))


def evaluate_machine(state: State, scope: Scope, action: Action) -> str | None:
    """A `<machine>` (http://wiki.ros.org/roslaunch/XML/machine); its name where it is the default for what follows."""
    if not applies(state, scope, action):
        return None
    # A scope of its own: anonymous names made in it are not seen by what follows.
    attributes = Attributes(state, scope.child(), action)
    # Before ROS Fuerte these had a meaning; empty ones are let pass.
    old = [attribute for name in _REFUSED_MACHINE if (attribute := action.attribute(name)) and attributes.text(name)]
    if old:
        attributes.refuse(old[0])
        return None
    found = attributes.require("name", "address")
    if found is None:
        return None
    if not found[0].known:
        state.unknown("<machine>", "its name is not known", scope, action.kind_span)
    for name in ("env-loader", "ssh-port", "user", "password", "default", "timeout"):
        attributes.get(name)
    ssh_port = attributes.convert("ssh-port", 22, lambda text: integer(text or "22"))
    default = (attributes.text("default") or "false").lower()
    if not attributes.chosen("default", default):
        return None
    for child in action.children:
        if child.kind == "env":
            state.problem(UnknownElement(child.kind, action.kind, ()), scope.origin(child.kind_span))
            return None
    timeout = attributes.convert("timeout", None, positive_number)
    machine = Machine(
        found[0].text,
        found[1].text,
        attributes.text("env-loader"),
        attributes.text("user") or None,
        timeout,
        scope.origin(action.head_span),
        ssh_port,
        attributes.text("password"),
        default != "never",
    )
    state.depends_on_outside = True
    if machine.name and machine.name not in state.machines:
        state.machines[machine.name] = machine
    elif not machine.name or state.machines[machine.name].settings != machine.settings:
        reason = "it is declared twice, with different attributes" if machine.name else "that is the local machine's"
        state.problem(InvalidName(machine.name, "machine", reason), scope.origin(action.kind_span))
        return None
    return machine.name if default == "true" else None


def namespace_of(state: State, scope: Scope, action: Action, attributes: Attributes) -> Resolved | None:
    """The attribute `ns`, its text empty where there is none; None where it is not a namespace, which is noted."""
    ns = attributes.get("ns")
    if ns is None:
        return Resolved("")
    if ns.known and (not ns.text or names.is_private(ns.text)):
        attributes.bad_value("ns", ns.text, "a namespace" if ns.text else "not empty")
        return None
    return ns


def clear_params(attributes: Attributes, inside: Scope, ns: str, *, node: str | None = None) -> None:
    """The attribute `clear_params`: parameters below the namespace are deleted before the launch."""
    if not attributes.text("clear_params") or not attributes.convert("clear_params", False, values.to_flag):
        return
    if not (ns if node is None else node):
        attributes.missing("ns" if node is None else "name")
        return
    cleared = inside.ns if node is None else names.as_namespace(names.join(inside.ns, node))
    state, scope, action = attributes.state, attributes.scope, attributes.action
    state.clear_params.append(cleared)
    attribute = action.attribute("clear_params")
    if attribute is not None and attributes.all_known:
        place, origin = scope.location(attribute.span), scope.origin(action.head_span)
        state.uses.append(Use("clear_params", place, attribute.value.text, cleared, origin=origin))
