"""Where else the thing under the cursor is named."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass

from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.graph.model import Connection, Graph
from preflight_analysis.queries import shared_arguments
from preflight_analysis.queries.node_names import mentions_of, tags_of
from preflight_analysis.queries.scene import Scene
from preflight_analysis.queries.subject import Kind, Subject, annotated, own_parameter, settings_of, subject_at
from preflight_analysis.tracing.interface import Endpoint, ParamUse
from preflight_analysis.workspace import facts


@dataclass(frozen=True, slots=True)
class Reference:
    """A place that names the thing; `declares` where it comes from there."""

    location: Location
    declares: bool


def references(scene: Scene, offset: int) -> tuple[Reference, ...]:
    """All places in the workspace, and in the sources of its nodes as far as they are known, that name what is at
    `offset`: those of the file itself first, then by path."""
    subject = subject_at(scene, offset)
    if subject is None:
        return ()
    found: dict[Location, bool] = {}
    for reference in _FINDERS[subject.kind](scene, subject):
        found[reference.location] = found.get(reference.location, False) or reference.declares
    places = sorted(found, key=lambda place: (place.file != scene.path, place.file, place.span))
    return tuple(Reference(place, found[place]) for place in places)


def _arguments(scene: Scene, subject: Subject) -> Iterator[Reference]:
    for name in subject.names:
        files = shared_arguments.sharing(scene.current, subject.files, name)
        yield from _all(shared_arguments.declared_at(scene, files, name), declare=True)
        yield from _all(shared_arguments.used_at(scene, files, name))
        yield from _all(shared_arguments.given_at(scene, files, name))


def _files(scene: Scene, subject: Subject) -> Iterator[Reference]:
    """Who includes the file."""
    for path in subject.files:
        launch_file = scene.launch_file(path)
        head = launch_file.root.head_span if launch_file and launch_file.root else Span(0, 0)
        yield Reference(scene.location(path, head), True)
        yield from _all(inclusion.place for inclusion in scene.current.includers(path))


def _packages(scene: Scene, subject: Subject) -> Iterator[Reference]:
    packages = scene.workspace.environment.packages
    for name in subject.names:
        if (package := packages.get(name)) is not None:
            yield Reference(Location.of_file(package.manifest), True)
        yield from _mentioned(scene, "package", name)


def _executables(scene: Scene, subject: Subject) -> Iterator[Reference]:
    for name in subject.names:
        for tree in scene.trees:
            paths = (n.resolved.path for n in tree.nodes if f"{n.package}/{n.executable}" == name)
            yield from _all((Location.of_file(p) for p in paths if p is not None and scene.document(p)), declare=True)
        yield from _mentioned(scene, "executable", name)


def _components(scene: Scene, subject: Subject) -> Iterator[Reference]:
    for name in subject.names:
        yield from _all(component_at(scene, name), declare=True)
        yield from _mentioned(scene, "component", name)


def component_at(scene: Scene, name: str) -> Iterator[Location]:
    """Where the class of a component, `package/class`, is defined."""
    package, _, cls = name.partition("/")
    found = scene.workspace.component(package, cls)
    if found is not None:
        yield scene.line(found.file, found.line)


def _nodes(scene: Scene, subject: Subject) -> Iterator[Reference]:
    tags = [n.location for _, n in scene.current.nodes() if n.name in subject.names]
    yield from _all(tags_of(scene, dict.fromkeys((*tags, *_own_tags(scene, subject)))), declare=True)
    for mention in mentions_of(scene, scene.trees, subject.names):
        if mention.span is not None:
            yield Reference(scene.location(mention.value.file, mention.span), False)


def _own_tags(scene: Scene, subject: Subject) -> Iterator[Location]:
    for tree in scene.trees:
        yield from (node.location for node in tree.nodes if node.name in subject.names)


def _parameters(scene: Scene, subject: Subject) -> Iterator[Reference]:
    for analysis in scene.analyses:
        for name, param in settings_of(analysis.tree):
            if name in subject.names:
                yield Reference(param.name_location or param.origin[-1], True)
        for read in analysis.graph.param_reads if analysis.graph else ():
            name = own_parameter(read.node, read.use.name) if analysis.tree.generation == 2 else read.name
            if name in subject.names and (place := made_at(scene, read.use)) is not None:
                yield Reference(place, False)
        yield from _annotations(scene, subject, analysis.tree.nodes, parameters=True)


def _topics(scene: Scene, subject: Subject) -> Iterator[Reference]:
    for analysis in scene.analyses:
        for node in analysis.tree.nodes:
            for remap in node.remaps:
                if names.resolve(remap.target, node.name) in subject.names:
                    yield from _all((remap.source_location, remap.target_location))
                elif names.resolve(remap.source, node.name) in subject.names:
                    yield Reference(remap.source_location, False)
        yield from _annotations(scene, subject, analysis.tree.nodes, parameters=False)
        for connection, declares in connections(analysis.graph, subject.names) if analysis.graph else ():
            if (place := made_at(scene, connection.endpoint)) is not None:
                yield Reference(place, declares)


def _annotations(
    scene: Scene, subject: Subject, nodes: Iterable[LaunchNode], *, parameters: bool
) -> Iterator[Reference]:
    for node in nodes:
        for kind, span, full in annotated(node):
            if full in subject.names and (kind == "param") == parameters:
                yield Reference(scene.location(node.location.file, span), False)


def _variables(scene: Scene, subject: Subject) -> Iterator[Reference]:
    for name in subject.names:
        yield from _mentioned(scene, "env", name)


def _machines(scene: Scene, subject: Subject) -> Iterator[Reference]:
    for name in subject.names:
        declared = {tree.machines[name].origin[-1] for tree in scene.trees if name in tree.machines}
        for path, mention in scene.current.mentions("machine", name):
            yield Reference(scene.location(path, mention.span), scene.location(path, mention.action) in declared)


_FINDERS: Mapping[Kind, Callable[[Scene, Subject], Iterator[Reference]]] = {
    "arg": _arguments,
    "file": _files,
    "package": _packages,
    "executable": _executables,
    "component": _components,
    "node": _nodes,
    "param": _parameters,
    "topic": _topics,
    "env": _variables,
    "machine": _machines,
}


def connections(graph: Graph, wanted: frozenset[str]) -> Iterator[tuple[Connection, bool]]:
    """The ends of topics, services and actions of these names, and whether each is on the offering side."""
    for channels in (graph.topics, graph.services, graph.actions):
        for name in wanted:
            if (channel := channels.get(name)) is not None:
                yield from ((end, True) for end in channel.offers)
                yield from ((end, False) for end in channel.wants)


def made_at(scene: Scene, what: Endpoint | ParamUse) -> Location | None:
    """The line of the node's source that makes an endpoint or reads a parameter; None where it is not known."""
    if what.source_file is None or what.source_line is None or what.builtin:
        return None
    return scene.line(what.source_file, what.source_line)


def _mentioned(scene: Scene, kind: facts.Kind, name: str) -> Iterator[Reference]:
    for path, mention in scene.current.mentions(kind, name):
        yield Reference(scene.location(path, mention.span), False)


def _all(places: Iterable[Location], *, declare: bool = False) -> Iterator[Reference]:
    return (Reference(place, declare) for place in places)
