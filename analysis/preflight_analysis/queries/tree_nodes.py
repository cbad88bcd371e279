"""The nodes, trees and files that a behavior tree names: what is known of them, and where they are defined."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.findings.markdown import code, escaped
from preflight_analysis.model.behavior_trees import Loaded, Part, path_of, trees_of
from preflight_analysis.model.tree_nodes_in_sources import OwnNodes, own_nodes
from preflight_analysis.queries.hover_text import Hover
from preflight_analysis.queries.places import link, shown_path
from preflight_analysis.trees.known_nodes import BUILT_IN, NAV_DISTRIBUTIONS, NAV_NODES, loads_by_default
from preflight_analysis.trees.ports import ports_of
from preflight_analysis.trees.read import Used
from preflight_analysis.workspace.workspace import Analysis


@dataclass(frozen=True, slots=True)
class TreeSource:
    """A file of a behavior tree that a node loads, in one root."""

    analysis: Analysis
    loaded: Loaded
    part: Part

    @property
    def own(self) -> OwnNodes:
        """The nodes that the sources of the workspace register."""
        context = self.analysis.context
        return own_nodes(context.disk.db, context.environment)


def tree_source(analyses: Sequence[Analysis], file: str) -> TreeSource | None:
    """The file in the first root that loads it; None where none does."""
    for analysis in analyses:
        for loaded in trees_of(analysis.context):
            for part in loaded.parts:
                if part.path == file:
                    return TreeSource(analysis, loaded, part)
    return None


def tree_hover(analyses: Sequence[Analysis], file: str, offset: int) -> Hover | None:
    """The hover of the node or tree at `offset`; None where there is none."""
    source = tree_source(analyses, file)
    if source is None:
        return None
    if (node := _at(source.part.file.nodes, offset)) is not None:
        return Hover("\n\n".join(_node(source, node.name)), node.span)
    if (tree := _at(source.part.file.subtrees, offset)) is not None:
        where = [part.path for part in source.loaded.parts if tree.name in part.file.trees]
        folder = source.analysis.environment.workspace
        said = f"in {link(where[0], None)}" if where else "which no file of this tree has"
        return Hover(f"tree {code(tree.name)}, {said}", tree.span) if folder or where else None
    return None


def _at(used: Sequence[Used], offset: int) -> Used | None:
    return next((each for each in used if each.span.contains(offset)), None)


def _node(source: TreeSource, name: str) -> Iterator[str]:
    own = source.own.nodes.get(name)
    if own is not None:
        shown = shown_path(own.path, source.analysis.environment.workspace)
        yield f"behavior tree node {code(name)} of this workspace"
        yield f"Registered in {code(shown)}"
    elif (nav := NAV_NODES.get(name)) is not None and source.loaded.is_navigator:
        yield f"behavior tree node {code(name)} of Nav2"
        yield _library(source, nav.libraries.get(source.analysis.environment.distro or ""), nav.libraries)
    elif name in BUILT_IN:
        yield f"behavior tree node {code(name)} of BehaviorTree.CPP"
    elif name in source.loaded.models:
        yield f"behavior tree node {code(name)}, which this file describes"
    else:
        yield f"behavior tree node {code(name)}"
        yield "Its library is not known."
    ports = ports_at(source, name)
    if ports is not None:
        yield f"Ports: {', '.join(map(code, sorted(ports)))}" if ports else "It has no ports."


def _library(source: TreeSource, library: str | None, libraries: object) -> str:
    distro = source.analysis.environment.distro or ""
    if library is None:
        known = sorted(libraries) if isinstance(libraries, dict) else []
        return f"Nav2 has it in {', '.join(map(escaped, known))}." if known else "Its library is not known."
    listed = source.loaded.libraries
    if loads_by_default(distro, library):
        return f"Library {code(library)}, loaded by default"
    if listed is None:
        return f"Library {code(library)}"
    return f"Library {code(library)}, {'listed' if library in listed else 'not listed'} in `plugin_lib_names`"


def ports_at(source: TreeSource, name: str) -> frozenset[str] | None:
    """The ports of a node that the file may have; None where they are not known."""
    own = source.own
    if name in own.nodes:
        ports = own.nodes[name].ports
        return frozenset(ports) if ports is not None else None
    if own.has(name) or not (source.loaded.is_navigator or name in BUILT_IN):
        return None
    distro = source.analysis.environment.distro
    return ports_of(name, distro if distro in NAV_DISTRIBUTIONS else None)


def tree_targets(analyses: Sequence[Analysis], file: str, offset: int) -> tuple[Span, tuple[Location, ...]] | None:
    """What is at `offset`, and where it is defined: the source that registers a node, a tree, an included file."""
    source = tree_source(analyses, file)
    if source is None:
        return None
    for span, path in tree_files(source):
        if span.contains(offset):
            return span, (Location.of_file(path),)
    if (tree := _at(source.part.file.subtrees, offset)) is not None:
        return tree.span, tuple(_defined(source.loaded, tree.name))
    node = _at(source.part.file.nodes, offset)
    own = source.own.nodes.get(node.name) if node is not None else None
    if node is None or own is None:
        return None
    document = source.analysis.context.disk.text(own.path)
    at = document.text.find(f'"{node.name}"') if isinstance(document, Document) else -1
    if not isinstance(document, Document) or at < 0:
        return node.span, (Location.of_file(own.path),)
    return node.span, (document.location(Span(at + 1, at + 1 + len(node.name))),)


def _defined(loaded: Loaded, tree: str) -> Iterator[Location]:
    for part in loaded.parts:
        if tree not in part.file.trees:
            continue
        parsed = parse_xml(part.path, part.document.text, lines=part.document.lines)
        for element in parsed.root.elements if parsed.root is not None else ():
            name = element.get("ID") if element.tag == "BehaviorTree" else None
            if name is not None and name.value.text == tree:
                yield part.document.location(name.value.span)


def tree_files(source: TreeSource) -> Iterator[tuple[Span, str]]:
    """The files that a file includes and that are there."""
    context = source.analysis.context
    for included in source.part.file.includes:
        path = path_of(context, included, source.part.path)
        if path is not None and context.disk.exists(path):
            yield included.span, path
