"""What can be written in the annotation of a node: `<topics>`, `<services>`, `<actions>` and `<params>`.

In XML it is an element or a comment of the node, in YAML and Python a comment above it. The text around the cursor is
the same in all of them, and decides what kind of place it is.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.hash_comments import has_hash_comments
from preflight_analysis.documents.span import Span
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.markdown import code
from preflight_analysis.generation import ros
from preflight_analysis.graph.actions import actions_of
from preflight_analysis.graph.annotations import ATTRIBUTES, CLASSES, ITEMS
from preflight_analysis.graph.model import Graph
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.queries.completion_items import Completion, Item
from preflight_analysis.queries.param_texts import default_text
from preflight_analysis.queries.places import nodes_around
from preflight_analysis.tracing.agents.stand_ins.definitions import Definitions
from preflight_analysis.tracing.interface import DOES, Endpoint, Interface
from preflight_analysis.workspace.workspace import Analysis

KINDS: Mapping[str, str] = {"topics": "msg", "services": "srv", "actions": "action"}
"""The kind of the definitions that each group has the types of."""

_LOOKED_AT = 20_000
"""How far before the cursor, in characters, the group may begin."""
_GROUP = re.compile(rf"<(/?)({'|'.join(ITEMS)})\b")
_ENDS = re.compile(r"-->|</?(?:node|launch|node_container|composable_node)\b")
_ITEM = re.compile(rf"<({'|'.join(ITEMS.values())})\b([^<>]*)\Z")
_VALUE = re.compile(r"""(\w+)\s*=\s*(["'])([^"'<>\n]*)\Z""")
_ATTRIBUTE = re.compile(r"""(\w+)\s*=\s*(?:"([^"]*)"|'([^']*)')""")
_WORD = re.compile(r"\w*\Z")
_VALUE_END = re.compile(r"""[^"'<>\n]*""")
_WORD_END = re.compile(r"\w*")


@dataclass(frozen=True, slots=True)
class AnnotationPlace:
    """A cursor in a group (`topics`): in the value of an attribute, where an attribute or where an item begins. `word`
    is what a completion replaces; `given` are the attributes that the item has already."""

    kind: Literal["value", "attribute", "item"]
    group: str
    word: Span
    attribute: str = ""
    given: Mapping[str, str] | None = None


def annotation_place(launch_file: LaunchFile, offset: int) -> AnnotationPlace | None:
    """What kind of place in an annotation `offset` is; None outside of one."""
    text = launch_file.document.text
    before = text[max(0, offset - _LOOKED_AT) : offset]
    groups = list(_GROUP.finditer(before))
    if not groups or groups[-1][1]:
        return None
    opened = groups[-1]
    inside = before[opened.end() :]
    if _ENDS.search(inside) or (
        has_hash_comments(launch_file.path, launch_file.document.text) and not _is_comment(inside)
    ):
        return None
    group: str = opened[2]
    item = _ITEM.search(inside)
    if item is None:
        word = _WORD.search(inside)
        typed = word[0] if word is not None else ""
        if not inside.endswith(f"<{typed}"):
            return None
        return AnnotationPlace("item", group, _word(text, offset, typed, _WORD_END))
    value = _VALUE.search(item[2])
    if value is not None:
        given = {name: first or second for name, first, second in _ATTRIBUTE.findall(item[2][: value.start()])}
        rest = text[offset : text.find(">", offset) + 1]
        given.update({name: first or second for name, first, second in _ATTRIBUTE.findall(rest)})
        return AnnotationPlace("value", group, _word(text, offset, value[3], _VALUE_END), value[1], given)
    given = {name: first or second for name, first, second in _ATTRIBUTE.findall(item[2])}
    name = _typed_attribute(item[2])
    return (
        AnnotationPlace("attribute", group, _word(text, offset, name, _WORD_END), given=given)
        if name is not None
        else None
    )


def _is_comment(inside: str) -> bool:
    return all(line.lstrip().startswith("#") for line in inside.split("\n")[1:])


def _word(text: str, offset: int, typed: str, end: re.Pattern[str]) -> Span:
    found = end.match(text, offset)
    return Span(offset - len(typed), found.end() if found else offset)


def _typed_attribute(attributes: str) -> str | None:
    """What of an attribute's name is written; None in the middle of something else."""
    found = _WORD.search(attributes)
    typed = found[0] if found is not None else ""
    return typed if attributes[: len(attributes) - len(typed)][-1:].isspace() else None


def complete_annotation(
    analysis: Analysis, launch_file: LaunchFile, place: AnnotationPlace, trigger: str | None
) -> Completion | None:
    """What can be written there, best first. `analysis` has what is known without a run, too."""
    match place.kind:
        case "item" if trigger in (None, "<"):
            return Completion(place.word, tuple(_items(place.group)))
        case "attribute" if trigger in (None, " "):
            given = place.given or {}
            attributes = (each for each in ATTRIBUTES[ITEMS[place.group]] if each not in given)
            found = (Item("attribute", each, f'{each}=""', snippet=f'{each}="$1"') for each in attributes)
            return Completion(place.word, tuple(found))
        case "value" if trigger in (None, '"', "'", "/"):
            return Completion(place.word, tuple(_values(analysis, launch_file, place)))
    return None


def _items(group: str) -> Iterator[Item]:
    item = ITEMS[group]
    for word in CLASSES.get(group, ("",)):
        role = CLASSES[group][word] if word else None
        text = item + "".join(f' {each}=""' for each in ATTRIBUTES[item] if each != "default")
        if role is None:
            yield Item("element", item, f"{text}/>", "A parameter that the node reads.", snippet=f'{item} name="$1"/>')
            continue
        snippet = f'{item} name="$1" type="$2" class="{word}"/>'
        text = text.replace('class=""', f'class="{word}"')
        yield Item("element", f"{item} {word}", f"{text}/>", f"The node {DOES[role]} it.", snippet=snippet)


def _values(analysis: Analysis, launch_file: LaunchFile, place: AnnotationPlace) -> Iterator[Item]:
    nodes = _nodes(analysis, launch_file, place.word.start)
    if place.attribute == "class":
        for word, role in CLASSES.get(place.group, {}).items():
            yield Item("value", word, word, f"The node {DOES[role]} it.")
    elif place.attribute == "name":
        yield from _names(nodes, place.group)
    elif place.attribute == "type" and place.group in KINDS:
        yield from _types(analysis, launch_file, place, nodes)


def _nodes(analysis: Analysis, launch_file: LaunchFile, offset: int) -> list[tuple[LaunchNode, Interface]]:
    """The nodes of the tag that is annotated, as far as the analysis knows it."""
    tree, graph = analysis.tree, analysis.graph
    nodes = list(nodes_around(tree, launch_file.path, offset))
    if not nodes and has_hash_comments(launch_file.path, launch_file.document.text):
        below = [n for n in tree.nodes if n.location.file == launch_file.path and n.action.span.start >= offset]
        first = min((node.action.span.start for node in below), default=None)
        nodes = [node for node in below if node.action.span.start == first]
    if graph is None:
        return []
    known = {id(node.origin): interface for node, interface in zip(tree.nodes, graph.processes, strict=True)}
    return [(node, known[id(node.origin)]) for node in nodes if id(node.origin) in known]


def _names(nodes: list[tuple[LaunchNode, Interface]], group: str) -> Iterator[Item]:
    """What the node itself calls them, as its source says."""
    seen: set[str] = set()
    for node, interface in nodes:
        if group == "params":
            for use in interface.params:
                name = use.name
                if not use.builtin and name not in seen:
                    seen.add(name)
                    yield Item("parameter", name, name, detail=default_text(use).replace("`", ""))
            continue
        for endpoint in _endpoints(interface, group):
            if endpoint.name not in seen:
                seen.add(endpoint.name)
                detail = ", ".join(filter(None, (endpoint.type, DOES[endpoint.role])))
                yield Item("endpoint", endpoint.name, endpoint.name, detail=detail)
        for remap in node.remaps:
            if remap.source not in seen:
                seen.add(remap.source)
                yield Item("endpoint", remap.source, remap.source, detail="remapped")


def _endpoints(interface: Interface, group: str) -> Iterator[Endpoint]:
    roles = set(CLASSES[group].values())
    for endpoint in (*(action.endpoint for action in actions_of(interface.endpoints)), *interface.endpoints):
        if endpoint.role in roles and not endpoint.builtin:
            yield endpoint


def _types(
    analysis: Analysis, launch_file: LaunchFile, place: AnnotationPlace, nodes: list[tuple[LaunchNode, Interface]]
) -> Iterator[Item]:
    """First the types that the name has at the node or at its other ends, then all that are known."""
    kind, generation = KINDS[place.group], launch_file.generation
    shares = {package.name: package.share for package in analysis.environment.packages.values()}
    with_kind = ros(generation).kinds_in_types
    found: dict[str, Item] = {}
    for type_, why in _used(analysis.graph, place, nodes):
        found.setdefault(type_, Item("type", type_, type_, why, about=(kind, *_parts(type_))))
    for full in Definitions(generation, shares).all(kind):
        package, _, name = full.split("/", 2)
        type_ = full if with_kind else f"{package}/{name}"
        found.setdefault(type_, Item("type", type_, type_, about=(kind, package, name)))
    yield from found.values()


def _parts(type_: str) -> tuple[str, str]:
    """Package and name of `std_msgs/String` or `std_msgs/msg/String`."""
    return type_.partition("/")[0], type_.rpartition("/")[2]


def _used(
    graph: Graph | None, place: AnnotationPlace, nodes: list[tuple[LaunchNode, Interface]]
) -> Iterator[tuple[str, str]]:
    name = (place.given or {}).get("name")
    if graph is None or not name:
        return
    for node, interface in nodes:
        for endpoint in _endpoints(interface, place.group):
            if endpoint.name == name and endpoint.type:
                yield endpoint.type, ""
        remaps = names.resolve_remaps(tuple((r.source, r.target) for r in node.remaps), node.name)
        full = names.resolve(name, node.name, remaps)
        channel = getattr(graph, place.group).get(full)
        for connection in (*channel.providers, *channel.consumers) if channel is not None else ():
            if connection.endpoint.type and connection.node.origin is not node.origin:
                does = DOES[connection.endpoint.role]
                yield connection.endpoint.type, f"{code(connection.node.name)} {does} {code(full)} with this type."
