"""BTR005: a port of a behaviour tree node with a value that it cannot have, or that it lacks (ROS 2).

`createNodeFromXML` in src/xml_parsing.cpp of BehaviorTree/BehaviorTree.CPP: `can not be converted`,
`was initially created with type`; `setOutput` in tree_node.h; what the nodes throw whose `getInput` finds nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from preflight_analysis.documents.document import Attribute
from preflight_analysis.documents.span import Span
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.behavior_trees import Loaded, is_version_4, trees_of
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import rename
from preflight_analysis.model.tree_nodes_in_sources import own_nodes
from preflight_analysis.rules.further_reading import BEHAVIOR_TREES
from preflight_analysis.rules.rule import Rule
from preflight_analysis.trees.known_nodes import BUILT_IN, NAV_NODES
from preflight_analysis.trees.port_types import NEEDED, Kind, is_object, is_output, is_text_of, kind_of, kind_of_cpp
from preflight_analysis.trees.ports import is_port
from preflight_analysis.trees.read import Used, entry_of

_UNUSED = ("", "{}")
"""What an output has that nobody wants."""


class _Port(NamedTuple):
    kind: Kind | None
    is_output: bool


class _Wrong(NamedTuple):
    message: str
    span: Span
    fix: tuple[str, str] | None = None


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    seen = set[tuple[str, int]]()
    for loaded in trees_of(context):
        types = dict[tuple[str, int, str], tuple[Kind, str]]()
        for part, used in loaded.nodes:
            for wrong in (*_values(context, loaded, used), *_types(context, loaded, part.path, used, types)):
                if (part.path, wrong.span.start) in seen:
                    continue
                seen.add((part.path, wrong.span.start))
                place = context.location(part.path, wrong.span)
                yield rule.claim(
                    wrong.message,
                    place,
                    subject=Subject("tree-node", used.name),
                    candidates=wrong.fix[1:] if wrong.fix is not None else (),
                    related=loaded.related,
                    fixes=rename(context, place, *wrong.fix) if wrong.fix is not None else (),
                )


def _values(context: Context, loaded: Loaded, used: Used) -> Iterator[_Wrong]:
    for attribute in used.attributes:
        port = _port(context, loaded, used, attribute.name)
        wrong = _wrong(used, attribute, port, is_version_4=is_version_4(context, loaded)) if port is not None else None
        if wrong is not None:
            yield wrong
    for name in NEEDED.get(used.name, ()) if _port(context, loaded, used, "") is not None else ():
        given = used.get(name)
        if given is None or not given.value.text.strip():
            at = used.span if given is None else given.name_span
            yield _Wrong(
                f"'{used.name}' needs the port '{name}', which is {'not set' if given is None else 'empty'}", at
            )


def _port(context: Context, loaded: Loaded, used: Used, name: str) -> _Port | None:
    """What is known of the port; None where nothing is known of the node."""
    own = own_nodes(context.disk.db, context.environment)
    node = own.nodes.get(used.name)
    if node is not None:
        port = node.ports.get(name) if node.ports is not None else None
        return _Port(kind_of_cpp(port.type), port.is_output) if port is not None else None
    if own.has(used.name) or not (used.name in BUILT_IN or (loaded.is_navigator and used.name in NAV_NODES)):
        return None
    return _Port(kind_of(name), is_output(used.name, name)) if is_port(name) or not name else None


def _wrong(used: Used, attribute: Attribute, port: _Port, *, is_version_4: bool) -> _Wrong | None:
    name, value, span = attribute.name, attribute.value.text, attribute.value.span
    if entry_of(attribute) is not None or value == "=":
        return None
    entry = (value, f"{{{value}}}") if value.isidentifier() else None
    hint = f"; did you mean '{entry[1]}'?" if entry is not None else ""
    if port.is_output:
        message = f"'{value}' is not a blackboard entry: '{used.name}' cannot write its output '{name}'{hint}"
        return _Wrong(message, span, entry) if value not in _UNUSED else None
    if port.kind is None or is_text_of(port.kind, value):
        return None
    if is_object(port.kind):
        return _Wrong(
            f"'{value}' is not a blackboard entry: '{name}' of '{used.name}' takes {port.kind}{hint}", span, entry
        )
    # Version 3 keeps what the node has where a text is not converted.
    if not value:
        return (
            _Wrong(f"'{name}' of '{used.name}' is empty; it takes {port.kind}", attribute.name_span)
            if is_version_4
            else None
        )
    return _Wrong(f"'{value}' is not {port.kind}, which '{name}' of '{used.name}' takes", span)


def _types(
    context: Context, loaded: Loaded, path: str, used: Used, types: dict[tuple[str, int, str], tuple[Kind, str]]
) -> Iterator[_Wrong]:
    """Entries of the blackboard that two ports of a tree have as different things. `types` has what each is, and by
    which port."""
    for attribute in used.attributes:
        entry, port = entry_of(attribute), _port(context, loaded, used, attribute.name)
        if entry is None or port is None or port.kind is None or not is_object(port.kind):
            continue
        kind, by = types.setdefault((path, used.tree, entry), (port.kind, f"'{attribute.name}' of '{used.name}'"))
        if kind != port.kind:
            yield _Wrong(
                f"'{{{entry}}}' is {kind} for {by}, but '{attribute.name}' of '{used.name}' takes {port.kind}",
                attribute.value.span,
            )


RULE = Rule(
    id="BTR005",
    name="behavior-tree-port-value",
    effect="breaks",
    kind="invalid",
    always=(Reason.LIBRARY,),
    what="Checks for a port of a behavior tree node with a value of another type, or an entry of the blackboard that "
    "is something else. Required ports must be set.",
    why="The tree cannot be created, the node fails, or it works with a value that nobody has set.",
    example='<ComputePathToPose goal="{goal}" path="path"/>\n<FollowPath path="{path}"/>',
    instead='<ComputePathToPose goal="{goal}" path="{path}"/>\n<FollowPath path="{path}"/>',
    references=(BEHAVIOR_TREES,),
    generations=(2,),
    check=_check,
)
