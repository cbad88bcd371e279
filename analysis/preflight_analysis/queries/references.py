"""Where else the thing under the cursor is named."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import chain

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.graph.model import ChannelKind, Connection, Graph
from preflight_analysis.model.entry import Kind as EntryKind
from preflight_analysis.model.name_index import RVIZ, mentions_in, named_in_packages
from preflight_analysis.queries import shared_arguments
from preflight_analysis.queries.frames import frame_at, named_at, published_at
from preflight_analysis.queries.handed_over import is_handed_over, references_in
from preflight_analysis.queries.node_names import mentions_of, tags_of
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.queries.symbol_at import Kind, NamedSymbol, annotated, own_parameter, settings_of, symbol_at
from preflight_analysis.tracing.interface import Endpoint, ParamUse


@dataclass(frozen=True, slots=True)
class Reference:
    """A place that names the thing; `declares` where it comes from there."""

    location: Location
    declares: bool


def references(context: QueryContext, offset: int) -> tuple[Reference, ...]:
    """All places in the workspace, and in the sources of its nodes as far as they are known, that name what is at
    `offset`, a frame within one launch: those of the file itself first, then by path."""
    found: dict[Location, bool] = {}
    if is_handed_over(context.analyses, context.path):
        found = references_in(context.analyses, context.path, offset)
    elif (frame := frame_at(context.analyses, context.path, offset)) is not None:
        found = {**dict.fromkeys(named_at(frame), False), **dict.fromkeys(published_at(context, frame), True)}
    elif (symbol := symbol_at(context, offset)) is not None:
        for reference in _FINDERS[symbol.kind](context, symbol):
            found[reference.location] = found.get(reference.location, False) or reference.declares
    places = sorted(found, key=lambda place: (place.file != context.path, place.file, place.span))
    return tuple(Reference(place, found[place]) for place in places)


def _arguments(context: QueryContext, symbol: NamedSymbol) -> Iterator[Reference]:
    for name in symbol.names:
        files = shared_arguments.SharedArgument(context, context.trees, symbol.files, name).files
        yield from _all(shared_arguments.declared_at(context, files, name), declare=True)
        yield from _all(shared_arguments.used_at(context, files, name, context.trees))
        yield from _all(shared_arguments.given_at(context, files, name))


def _files(context: QueryContext, symbol: NamedSymbol) -> Iterator[Reference]:
    """Who includes the file."""
    for path in symbol.files:
        launch_file = context.launch_file(path)
        head = launch_file.root.head_span if launch_file and launch_file.root else Span(0, 0)
        yield Reference(context.location(path, head), True)
        yield from _all(inclusion.place for inclusion in context.current.includers(path))


def _packages(context: QueryContext, symbol: NamedSymbol) -> Iterator[Reference]:
    packages = context.workspace.environment.packages
    for name in symbol.names:
        if (package := packages.get(name)) is not None:
            yield Reference(Location.of_file(package.manifest), True)
        yield from _mentioned(context, "package", name)
        yield from _in_packages(context, "package", name)


def _executables(context: QueryContext, symbol: NamedSymbol) -> Iterator[Reference]:
    for name in symbol.names:
        yield from _all(executable_at(context, name), declare=True)
        yield from _mentioned(context, "program", *_parts(name))
        yield from _in_packages(context, "program", *_parts(name))


def executable_at(context: QueryContext, name: str) -> Iterator[Location]:
    """Where the program of `package/executable` begins: a script; the function of a console script; for what is
    compiled its source."""
    package, _, executable = name.partition("/")
    nodes = [n for t in context.trees for n in t.nodes if (n.package, n.executable) == (package, executable)]
    paths = sorted({n.resolved.path for n in nodes if n.resolved.path is not None})
    made = context.workspace.executables.made_of(package, executable)
    if made is not None:  # what stands in a devel space only leads there
        paths = [made.source]
    entries = {n.resolved.path: n.resolved.entry_point for n in nodes if n.resolved.entry_point is not None}
    for path in paths:
        function = entries.get(path, "").partition(":")[2]
        made_there = context.workspace.entry_point(path, function) if function else None
        if made_there is not None:
            yield context.line(made_there.file, made_there.line)
        elif context.document(path) is not None:
            yield Location.of_file(path)


def _components(context: QueryContext, symbol: NamedSymbol) -> Iterator[Reference]:
    for name in symbol.names:
        yield from _all(component_at(context, name), declare=True)
        yield from _mentioned(context, "component", *_parts(name))
        yield from _in_packages(context, "component", *_parts(name))


def component_at(context: QueryContext, name: str) -> Iterator[Location]:
    """Where the class of a component, `package/class`, is defined."""
    package, _, cls = name.partition("/")
    found = context.workspace.component(package, cls)
    if found is not None:
        yield context.line(found.file, found.line)


def _nodes(context: QueryContext, symbol: NamedSymbol) -> Iterator[Reference]:
    tags = [n.location for _, n in context.current.nodes() if n.name in symbol.names]
    yield from _all(tags_of(context, dict.fromkeys((*tags, *_own_tags(context, symbol)))), declare=True)
    for mention in mentions_of(context, context.trees, symbol.names):
        if mention.span is not None:
            yield Reference(context.location(mention.value.file, mention.span), False)


def _own_tags(context: QueryContext, symbol: NamedSymbol) -> Iterator[Location]:
    for tree in context.trees:
        yield from (node.location for node in tree.nodes if node.name in symbol.names)


def _parameters(context: QueryContext, symbol: NamedSymbol) -> Iterator[Reference]:
    for analysis in context.analyses:
        for name, param in settings_of(analysis.tree):
            if name in symbol.names:
                yield Reference(param.place, True)
        for read in analysis.graph.param_reads if analysis.graph else ():
            name = own_parameter(read.node, read.use.name) if analysis.tree.ros.own_parameters else read.name
            if name in symbol.names and (place := made_at(context, read.use)) is not None:
                yield Reference(place, False)
        yield from _annotations(context, symbol, analysis.tree.nodes, parameters=True)


def _topics(context: QueryContext, symbol: NamedSymbol) -> Iterator[Reference]:
    for analysis in context.analyses:
        for node in analysis.tree.nodes:
            for remap in node.remaps:
                if names.resolve(remap.target, node.name) in symbol.names:
                    yield from _all((remap.source_location, remap.target_location))
                elif names.resolve(remap.source, node.name) in symbol.names:
                    yield Reference(remap.source_location, False)
        yield from _annotations(context, symbol, analysis.tree.nodes, parameters=False)
        for connection, declares in connections(analysis.graph, symbol.names) if analysis.graph else ():
            if (place := made_at(context, connection.endpoint)) is not None:
                yield Reference(place, declares)
            if (named_by := connection.endpoint.named_by) is not None:
                shown = tuple(displayed_at(context, named_by.place.file, connection.endpoint.name))
                yield from _all(shown or (named_by.place,), declare=declares)


def displayed_at(context: QueryContext, config: str, topic: str) -> Iterator[Location]:
    """Where a configuration of RViz names a topic."""
    for entry, span, _ in mentions_in(context.workspace.sources.db, config) if config.endswith(RVIZ) else ():
        if entry.kind == "topic" and entry.text == topic:
            yield context.location(config, span)


def _annotations(
    context: QueryContext, symbol: NamedSymbol, nodes: Iterable[LaunchNode], *, parameters: bool
) -> Iterator[Reference]:
    for node in nodes:
        for kind, span, full in annotated(node):
            if full in symbol.names and (kind == "param") == parameters:
                yield Reference(context.location(node.location.file, span), False)


def _variables(context: QueryContext, symbol: NamedSymbol) -> Iterator[Reference]:
    for name in symbol.names:
        yield from _mentioned(context, "variable", name)


def _machines(context: QueryContext, symbol: NamedSymbol) -> Iterator[Reference]:
    for name in symbol.names:
        declared = {tree.machines[name].origin[-1] for tree in context.trees if name in tree.machines}
        for path, mention in context.current.mentions("machine", name):
            yield Reference(context.location(path, mention.span), context.location(path, mention.action) in declared)


_FINDERS: Mapping[Kind, Callable[[QueryContext, NamedSymbol], Iterator[Reference]]] = {
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
    """The endpoints of topics, services and actions of these names, and whether each is a provider."""
    kinds: tuple[ChannelKind, ...] = ("topics", "services", "actions")
    for kind in kinds:
        for channel in chain.from_iterable(graph.named(kind, name) for name in wanted):
            yield from ((connection, True) for connection in channel.providers)
            yield from ((connection, False) for connection in channel.consumers)


def made_at(context: QueryContext, what: Endpoint | ParamUse) -> Location | None:
    """The line of the node's source that makes an endpoint or reads a parameter; None where it is not known."""
    if what.source_file is None or what.source_line is None or what.builtin:
        return None
    return context.line(what.source_file, what.source_line)


def _parts(name: str) -> tuple[str, str]:
    package, _, rest = name.partition("/")
    return rest, package


def _mentioned(context: QueryContext, kind: EntryKind, name: str, of: str = "") -> Iterator[Reference]:
    for path, mention in context.current.mentions(kind, name, of):
        yield Reference(context.location(path, mention.span), False)


def _in_packages(context: QueryContext, kind: EntryKind, name: str, of: str = "") -> Iterator[Reference]:
    """In what builds and describes the packages of the workspace, or the package `of` alone, and in their programs."""
    environment, db = context.workspace.environment, context.workspace.sources.db
    folders = [environment.packages[of].share] if of in environment.packages else [] if of else None
    for path, mention in named_in_packages(db, environment, kind, name, folders):
        declares = mention.entry.role == "declares" and kind != "component"
        yield Reference(context.location(path, mention.span), declares)


def _all(places: Iterable[Location], *, declare: bool = False) -> Iterator[Reference]:
    return (Reference(place, declare) for place in places)
