"""An annotation against the runs of the nodes that its tag makes, and the edits that bring it up to date.

The annotation may say more than a run shows on purpose: what the node does later. It may say less, too, of what nobody
cares about. So only another type is a contradiction.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.edits import layout
from preflight_analysis.edits.edit import Edit
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.graph.actions import actions_of
from preflight_analysis.graph.annotations import (
    AnnotatedGroup,
    AnnotatedItem,
    annotated_groups,
    read_annotation,
    worth_writing,
    written,
)
from preflight_analysis.tracing.interface import Endpoint, Interface, ParamUse

_Key = tuple[str, str]
"""Role, or `param`, and full name before remapping."""


@dataclass(frozen=True, slots=True)
class Outdated:
    """What differs. `conflicts` has the type that the run showed; `unmade` stands in the annotation alone, `missing`
    was seen in every run alone."""

    groups: tuple[AnnotatedGroup, ...]
    conflicts: tuple[tuple[AnnotatedItem, str], ...]
    unmade: tuple[AnnotatedItem, ...]
    missing: tuple[Endpoint | ParamUse, ...]


def compare(seen: Sequence[tuple[LaunchNode, Interface]]) -> Outdated | None:
    """`seen` are the nodes that one tag makes, with what their runs showed. None where there is no annotation, no run
    to compare it with, or no difference."""
    if any(interface.outcome.status == "not-run" for _, interface in seen):
        return None
    annotation, problems = read_annotation(seen[0][0].action)
    if annotation is None or not (groups := annotated_groups(seen[0][0].action)):
        return None
    items = [item for group in groups for item in group.items]
    conflicts = tuple((item, type_) for item in items if (type_ := _other_type(item, seen)) is not None)
    unmade: tuple[AnnotatedItem, ...] = ()
    missing: tuple[Endpoint | ParamUse, ...] = ()
    # What is malformed may be meant for what seems to be missing.
    if not problems and all(interface.source == "trace" and interface.complete for _, interface in seen):
        reported = [_reported(interface.endpoints, interface.params, node) for node, interface in seen]
        unmade = tuple(
            item
            for item in items
            if not any(_key(item.what, node) in t for (node, _), t in zip(seen, reported, strict=True))
        )
        missing = tuple(_missing(groups, seen))
    if not (conflicts or unmade or missing):
        return None
    return Outdated(groups, conflicts, unmade, missing)


def _key(what: Endpoint | ParamUse, node: LaunchNode) -> _Key:
    return what.role if isinstance(what, Endpoint) else "param", names.resolve(what.name, node.name)


def _reported(endpoints: Iterable[Endpoint], params: Iterable[ParamUse], node: LaunchNode) -> set[_Key]:
    """All that is said by these, an action both as such and by its topics."""
    endpoints = tuple(endpoints)
    actions = actions_of(endpoints)
    endpoints = (*endpoints, *(a.endpoint for a in actions), *(p for a in actions for p in a.parts))
    return {_key(end, node) for end in endpoints} | {_key(use, node) for use in params}


def _other_type(item: AnnotatedItem, seen: Sequence[tuple[LaunchNode, Interface]]) -> str | None:
    """The type that all runs which showed the endpoint gave it, if it is another one than the annotation's."""
    what = item.what
    if not isinstance(what, Endpoint) or what.type in (None, "*"):
        return None
    found: set[str] = set()
    for node, interface in seen:
        endpoints = (*interface.endpoints, *(action.endpoint for action in actions_of(interface.endpoints)))
        types = {e.type for e in endpoints if _key(e, node) == _key(what, node) and not e.evidence.assumed}
        found |= {type_ for type_ in types if type_ is not None}
    plain = {type_.removesuffix("Action") for type_ in found} if what.role.startswith("action") else found
    known = str(what.type).removesuffix("Action") if what.role.startswith("action") else what.type
    return found.pop() if len(found) == 1 and "*" not in found and known not in plain else None


def _missing(
    groups: Sequence[AnnotatedGroup], seen: Sequence[tuple[LaunchNode, Interface]]
) -> Iterator[Endpoint | ParamUse]:
    said = [item.what for group in groups for item in group.items]
    endpoints = [what for what in said if isinstance(what, Endpoint)]
    params = [what for what in said if isinstance(what, ParamUse)]
    with_params = any(group.name == "params" for group in groups)
    reported = _reported(endpoints, params, seen[0][0])
    others = [{written(what) for what in worth_writing(interface)} for _, interface in seen[1:]]
    node, interface = seen[0]
    by_topics = {
        (a.endpoint.role, a.endpoint.name)
        for a in actions_of(interface.endpoints)
        if all(_key(part, node) in reported for part in a.parts)
    }
    given: set[_Key] = set()
    for what in worth_writing(interface):
        if isinstance(what, ParamUse) and not with_params:
            continue
        key = _key(what, node)
        if isinstance(what, Endpoint) and (what.role, what.name) in by_topics:
            continue
        if key not in reported and key not in given and all(written(what) in other for other in others):
            given.add(key)
            yield what


def bring_up_to_date(outdated: Outdated, document: Document) -> tuple[Edit, ...]:
    """The edits that correct the types and add what is missing. What only the annotation has stays: it may come later.
    So do order, layout and comments."""
    edits = [Edit(document.location(item.values["type"]), type_) for item, type_ in outdated.conflicts]
    more: dict[str, list[str]] = {}
    for what in outdated.missing:
        name, text = written(what)
        more.setdefault(name, []).append(text)
    new: list[str] = []
    for name, items in more.items():
        group = next((g for g in reversed(outdated.groups) if g.name == name), None)
        if group is not None:
            edits.append(_extended(group, sorted(items), document))
        else:
            new += [f"<{name}>", *(f"\t{item}" for item in sorted(items)), f"</{name}>"]
    if new:
        edits.append(_new_groups(outdated.groups[-1], new, document))
    return tuple(edits)


def remove_item(item: AnnotatedItem, document: Document) -> Edit:
    """The edit that removes an item from its annotation."""
    return layout.removal(document, item.span)


def _extended(group: AnnotatedGroup, items: Sequence[str], document: Document) -> Edit:
    """More items behind those of a group."""
    newline = layout.newline(document.text)
    if group.elements:
        at = group.elements[-1].end
        indent = layout.blanks_before(document, group.elements[-1].start)
        before = newline + indent if indent is not None else ""
        return Edit(document.location(Span(at, at)), "".join(before + item for item in items))
    indent = layout.blanks_before(document, group.head.start)
    if indent is None:
        body = "".join(items)
    else:
        deeper = layout.deeper(indent)
        body = "".join(newline + deeper + item for item in items) + newline + indent
    start, end = group.head
    if document.text[start:end].endswith("/>"):
        opened = document.text[start : end - 2].rstrip() + ">"
        return Edit(document.location(Span(start, end)), f"{opened}{body}</{group.name}>")
    # What stands between the tags are blanks or a comment, which stays.
    between = document.text[end : group.span.end].rpartition("</")[0]
    stop = end if between.strip() else end + len(between)
    return Edit(document.location(Span(end, stop)), body)


def _new_groups(last: AnnotatedGroup, lines: Sequence[str], document: Document) -> Edit:
    """More groups behind the last one; a tab in `lines` stands for one step of indentation."""
    at = last.span.end
    indent = layout.blanks_before(document, last.head.start)
    if indent is None:
        text = "".join(line.strip("\t") for line in lines)
    else:
        unit = layout.deeper(indent).removeprefix(indent)
        text = "".join(layout.newline(document.text) + indent + line.replace("\t", unit) for line in lines)
    return Edit(document.location(Span(at, at)), text)
