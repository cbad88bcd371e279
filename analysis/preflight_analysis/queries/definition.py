"""Where the thing at an offset is defined, or where its other end is."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode, Remap
from preflight_analysis.findings.finding import Finding
from preflight_analysis.queries import shared_arguments
from preflight_analysis.queries.frames import frame_at, published_at
from preflight_analysis.queries.handed_over import is_handed_over, targets_in
from preflight_analysis.queries.param_files import from_param_file, is_param_file
from preflight_analysis.queries.places import action_at, passed_at, remaps_of, uses_at
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.queries.references import component_at, connections, executable_at, made_at
from preflight_analysis.queries.symbol_at import NamedSymbol, remaps_at, symbol_at
from preflight_analysis.workspace.workspace import Analysis


@dataclass(frozen=True, slots=True)
class Target:
    """A place to go to, and what at the cursor leads there."""

    location: Location
    source: Location


def definition(context: QueryContext, offset: int, findings: Iterable[Finding]) -> tuple[Target, ...]:
    """Where to go from `offset`: the file of an include, the manifest of a `$(find)`, the declaration of an argument
    (from the declaration: to the place that gave it its value), the script of a node or what builds it, the source
    that reads a parameter; from a remap to the other ends, in the nodes' sources where they are known, and from the
    name that it replaces to the node's own; from a finding to its related places."""
    context, _ = context.taking(offset)
    analysis, file = context.analyses[0], context.path
    if (passed := passed_at(analysis.launch_files.get(file), offset)) is not None:
        source = context.location(file, passed.span)
        return tuple(Target(each.location, source) for each in definition(context, passed.written, findings))
    if is_handed_over(context.analyses, file):
        found = targets_in(context.analyses, file, offset)
        return _targets(found[1], context.location(file, found[0])) if found is not None else ()
    if (frame := frame_at(context.analyses, file, offset)) is not None:
        return _targets(published_at(context, frame), context.location(file, frame.span))
    if is_param_file(analysis, file):
        return tuple(Target(place, context.location(file, span)) for place, span in from_param_file(context, offset))
    if targets := _targets_of_param(context, offset):
        return targets
    uses = uses_at(analysis.tree, file, offset)
    for use in uses:
        if use.kind == "executable" or use.location != uses[0].location:
            break
        target = use.target
        if target is None or _same_place(target, use.location):
            target = next((step for step in reversed(use.origin) if not _same_place(step, use.location)), None)
        if target is not None:
            return (Target(target, use.location),)
    symbol = symbol_at(context, offset)
    if symbol is not None and (targets := _of_symbol(context, symbol)):
        return targets
    launch_file = analysis.launch_files.get(file)
    action = action_at(launch_file, offset) if launch_file else None
    if action is not None and action.kind in ("remap", "set_remap"):
        value = next((a.value.span for a in action.attributes if a.value.span.contains(offset)), action.head_span)
        reached = remaps_of(analysis.tree, file, action)
        if targets := _targets(_other_endpoints(context, analysis, reached), context.location(file, value)):
            return targets
    if symbol is not None and symbol.kind == "topic":  # a remap in Python, which has no tag
        source = context.location(file, symbol.span)
        if targets := _targets(_other_endpoints(context, analysis, remaps_at(analysis.tree, source)), source):
            return targets
    for finding in findings:
        if finding.location.file == file and finding.location.span.contains(offset) and finding.related:
            return tuple(Target(related.location, finding.location) for related in finding.related)
    return ()


def _targets_of_param(context: QueryContext, offset: int) -> tuple[Target, ...]:
    """From the name of a ROS 2 node's parameter to where its source declares it."""
    found: dict[Target, None] = {}
    for analysis in context.analyses:
        graph = analysis.graph
        for node, interface in zip(graph.tree.nodes, graph.interfaces, strict=True) if graph is not None else ():
            for param in node.params:
                place = param.name_location
                if place is None or place.file != context.path or not place.span.contains(offset):
                    continue
                uses = (use for use in interface.params if use.name.removeprefix("~") == param.name)
                found.update({Target(made, place): None for use in uses if (made := made_at(context, use)) is not None})
    return tuple(found)


def _same_place(one: Location, other: Location) -> bool:
    return one.file == other.file and (one.span.contains(other.span.start) or other.span.contains(one.span.start))


def _targets(places: Iterable[Location], source: Location) -> tuple[Target, ...]:
    return tuple(Target(place, source) for place in dict.fromkeys(places) if place != source)


def _of_symbol(context: QueryContext, symbol: NamedSymbol) -> tuple[Target, ...]:
    source = context.location(context.path, symbol.span)
    match symbol.kind:
        case "arg":
            declared = (shared_arguments.declared_at(context, symbol.files, name) for name in symbol.names)
            return _targets((place for places in declared for place in places), source)
        case "file" if all(path != context.path for path in symbol.files):
            return _targets((Location.of_file(path) for path in symbol.files), source)
        case "package":
            packages = map(context.workspace.environment.packages.get, symbol.names)
            return _targets((Location.of_file(p.manifest) for p in packages if p is not None), source)
        case "executable":
            return _targets(_executables(context, symbol), source)
        case "component":
            return _targets((place for name in symbol.names for place in component_at(context, name)), source)
        case "param":
            return _targets(_readers(context, symbol), source)
        case "topic":
            return _targets(_own_endpoints(context, symbol), source)
        case "machine":
            machines = (tree.machines.get(name) for tree in context.trees for name in symbol.names)
            return _targets((m.origin[-1] for m in machines if m is not None), source)
        case _:
            return ()


def _executables(context: QueryContext, symbol: NamedSymbol) -> Iterator[Location]:
    """The programs, and for what is compiled the target in the package's `CMakeLists.txt`."""
    for name in symbol.names:
        yield from executable_at(context, name)
        package, _, executable = name.partition("/")
        if (target := _build_target(context, package, executable)) is not None:
            yield target


def _build_target(context: QueryContext, package: str, executable: str) -> Location | None:
    found = context.workspace.environment.packages.get(package)
    path = os.path.join(found.share, "CMakeLists.txt") if found else ""
    document = context.document(path) if found else None
    for call in re.finditer(r"^\s*add_executable\s*\(\s*([^\s()]+)", document.text if document else "", re.MULTILINE):
        if call[1].replace("${PROJECT_NAME}", package) == executable:
            return context.location(path, Span(*call.span(1)))
    return None


def _readers(context: QueryContext, symbol: NamedSymbol) -> Iterator[Location]:
    for analysis in context.analyses:
        for read in analysis.graph.param_reads if analysis.graph else ():
            if read.name in symbol.names and (place := made_at(context, read.use)) is not None:
                yield place


def _own_endpoints(context: QueryContext, symbol: NamedSymbol) -> Iterator[Location]:
    """From the name that a remap replaces, to where the nodes themselves give it."""
    source = context.location(context.path, symbol.span)
    for analysis in context.analyses:
        for connection, _ in connections(analysis.graph, symbol.names) if analysis.graph else ():
            if connection.remap is not None and connection.remap.source_location == source:
                place = made_at(context, connection.endpoint)
                if place is not None:
                    yield place


def _other_endpoints(
    context: QueryContext, analysis: Analysis, remapped: Iterable[tuple[LaunchNode, Remap]]
) -> Iterator[Location]:
    """The nodes that meet the remapped ones under the new name, in their sources where that is known."""
    mine = tuple(remapped)
    own = {id(node) for node, _ in mine}
    met = frozenset(names.resolve(remap.target, node.name) for node, remap in mine)
    for connection, _ in connections(analysis.graph, met) if analysis.graph else ():
        if id(connection.node) not in own:
            yield made_at(context, connection.endpoint) or connection.node.location
