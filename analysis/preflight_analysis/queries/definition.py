"""Where the thing at an offset is defined, or where its other end is."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation import names
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.model import Graph
from preflight_analysis.launch.model import Action
from preflight_analysis.queries.places import action_at, nodes_of, remaps_of, use_at
from preflight_analysis.workspace.workspace import Analysis


@dataclass(frozen=True, slots=True)
class Target:
    """A place to go to, and what at the cursor leads there."""

    location: Location
    source: Location


def definition(analysis: Analysis, file: str, offset: int, findings: Iterable[Finding]) -> tuple[Target, ...]:
    """Where to go from `offset`: the file of an include, the manifest of a `$(find)`, the declaration of an argument
    (from the declaration: to the place that gave it its value), the script of a node; from a remap to the nodes at
    the other end; from a finding to its related places."""
    use = use_at(analysis.tree, file, offset)
    if use is not None:
        target = use.target
        if target is None or _same_place(target, use.location):
            target = next((step for step in reversed(use.origin) if not _same_place(step, use.location)), None)
        if target is not None:
            return (Target(target, use.location),)
    launch_file = analysis.launch_files.get(file)
    action = action_at(launch_file, offset) if launch_file else None
    if action is not None and (targets := _of_action(analysis, file, action, offset)):
        return targets
    for finding in findings:
        if finding.location.file == file and finding.location.span.contains(offset) and finding.related:
            return tuple(Target(related.location, finding.location) for related in finding.related)
    return ()


def _same_place(one: Location, other: Location) -> bool:
    return one.file == other.file and (one.span.contains(other.span.start) or other.span.contains(one.span.start))


def _of_action(analysis: Analysis, file: str, action: Action, offset: int) -> tuple[Target, ...]:
    if action.kind == "remap" and analysis.graph is not None:
        value = next((a.value.span for a in action.attributes if a.value.span.contains(offset)), action.head_span)
        return _other_ends(analysis, analysis.graph, file, action, Location(file, value))
    executable = action.value("type")
    if action.kind in ("node", "test") and executable is not None and executable.span.contains(offset):
        paths = {n.resolved.path for _, n in nodes_of(analysis, file, action) if n.resolved.path is not None}
        source = Location(file, executable.span)
        return tuple(Target(Location(path, Span(0, 0)), source) for path in sorted(paths))
    return ()


def _other_ends(analysis: Analysis, graph: Graph, file: str, action: Action, source: Location) -> tuple[Target, ...]:
    """The nodes that meet the remapped ones under the new name."""
    mine = tuple(remaps_of(analysis.tree, file, action))
    own = {id(node) for node, _ in mine}
    found: dict[Location, Target] = {}
    for name in {names.resolve(remap.target, node.name) for node, remap in mine}:
        for channels in (graph.topics, graph.services, graph.actions):
            channel = channels.get(name)
            for connection in (*channel.offers, *channel.wants) if channel else ():
                if id(connection.node) not in own:
                    found[connection.node.location] = Target(connection.node.location, source)
    return tuple(found.values())
