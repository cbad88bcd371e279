"""What can be written in a robot description or a behavior tree: names of links, joints and groups that the robot has,
nodes of trees with their ports."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.documents.document import Document, Element
from preflight_analysis.documents.span import Span
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.queries.completion_items import Completion, Item
from preflight_analysis.queries.cursor import Place, place_at
from preflight_analysis.queries.robot_names import names_for
from preflight_analysis.queries.tree_nodes import TreeSource, ports_at, tree_source
from preflight_analysis.trees.known_nodes import BUILT_IN, NAV_NODES
from preflight_analysis.trees.ports import ports_of
from preflight_analysis.workspace.workspace import Analysis

_TREE = "BehaviorTree"


def complete_handed_over(analysis: Analysis, document: Document, offset: int, trigger: str | None) -> Completion | None:
    """What can be written at `offset`; None where nothing is known. `trigger` as in `completion.complete`."""
    place = place_at(parse_xml(document.path, document.text, lines=document.lines), offset)
    if place is None:
        return None
    if place.kind == "value":
        return _name(analysis, document, place) if trigger in (None, '"', "'") else None
    source = tree_source([analysis], document.path)
    if source is None or not any(parent.tag == _TREE for parent in place.parents):
        return None
    if place.kind == "attribute" and trigger in (None, " ") and place.element is not None:
        return Completion(place.word, tuple(_ports(source, document, place.element, place.word)))
    if place.kind == "element" and trigger in (None, "<"):
        return Completion(place.word, tuple(_nodes(source)))
    return None


def _name(analysis: Analysis, document: Document, place: Place) -> Completion | None:
    if place.element is None or place.attribute is None or "$" in place.attribute.value.text:
        return None
    around = [parent.tag for parent in place.parents]
    names = names_for(analysis, document.path, place.element.tag, place.attribute.name, around)
    return Completion(place.word, tuple(Item("value", each, each) for each in names)) if names else None


def _nodes(source: TreeSource) -> Iterator[Item]:
    """The nodes that the file may have: those of the workspace, then those of Nav2 and BehaviorTree.CPP in the
    distribution, or in any where that is not known."""
    distro, seen = source.analysis.environment.distro, set[str]()
    found = [(name, "this workspace") for name in source.own.nodes]
    found += ((name, "this file") for name in source.loaded.models)
    if source.loaded.is_navigator:
        found += ((n, "Nav2") for n, node in NAV_NODES.items() if distro is None or distro in node.libraries)
    found += ((n, "BehaviorTree.CPP") for n in BUILT_IN if distro is None or ports_of(n, distro) is not None)
    for name, where in sorted(found):
        if name not in seen:
            seen.add(name)
            yield Item("element", name, name, detail=where)


def _ports(source: TreeSource, document: Document, element: Element, word: Span) -> Iterator[Item]:
    present = {each.name for each in element.attributes if each.name_span != word}
    has_value = document.text.startswith("=", word.end)
    for port in sorted((ports_at(source, element.tag) or frozenset()) - present):
        text = port if has_value else f'{port}=""'
        yield Item("attribute", port, text, snippet=None if has_value else f'{port}="$1"')
