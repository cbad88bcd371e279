"""Renaming parameters and topics through launch files, parameter files, remaps and configurations of RViz.

The sources of nodes are left alone: what a node itself calls by the old name stands in the way of a rename.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.graph.model import Connection
from preflight_analysis.queries.node_names import value_at
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.queries.references import connections, displayed_at, made_at
from preflight_analysis.queries.rename_edit import RenameEdit, RenameRefusedError
from preflight_analysis.queries.symbol_at import NamedSymbol, own_parameter, remaps_at, settings_of
from preflight_analysis.workspace.workspace import Analysis

_LEAF = re.compile(r"[^~/.:\s]+\Z")
_PARAMETER = re.compile(r"[A-Za-z][\w-]*\Z", re.ASCII)


@dataclass(frozen=True, slots=True)
class ParameterRename:
    """A parameter with all places that set it. `leaf` is the last part of its name, which a rename changes: `places`
    are where that is written, each with the launch files of roots that it counts in as well and that were not
    analysed; `names` are the full names that they set in all `trees`."""

    leaf: str
    span: Span
    places: Mapping[Location, tuple[str, ...]]
    names: frozenset[str]
    trees: tuple[LaunchTree, ...]


def parameter_rename(context: QueryContext, symbol: NamedSymbol) -> ParameterRename:
    """What a rename of the parameter at the cursor changes. Raises `RenameRefusedError`."""
    at = _leaf(context, context.location(context.path, symbol.span))
    leaf = context.text(at)
    full, places = set(symbol.names), dict[Location, dict[str, None]]()
    while True:
        trees = context.trees_around({place.file for place in places})
        before = len(full), len(places), len(trees)
        for tree in trees:
            for name, param in settings_of(tree):
                if name in full or param.place in places:
                    full.add(name)
                    places.setdefault(param.place, {})[tree.file] = None
        if before == (len(full), len(places), len(context.trees_around({place.file for place in places}))):
            break
    analysed = {tree.file for tree in context.trees}
    written = {}
    for place, files in places.items():
        part = _leaf(context, place)
        if context.text(part) != leaf:
            raise RenameRefusedError(
                f"The parameter is set at {shown(context, place)} under a name that does not end in '{leaf}'"
            )
        written[part] = tuple(file for file in files if file not in analysed)
    if not written:
        raise RenameRefusedError(f"No launch file or parameter file sets '{leaf}'")
    return ParameterRename(leaf, at.span, written, frozenset(full), trees)


def parameter_edits(context: QueryContext, found: ParameterRename, new: str) -> tuple[RenameEdit, ...]:
    """The edits that give the parameter another last part. Raises `RenameRefusedError`."""
    if not _PARAMETER.match(new):
        raise RenameRefusedError(f"'{new}' is not a parameter name: a letter, then letters, digits and underscores")
    renamed = {name: name[: len(name) - len(found.leaf)] + new for name in found.names}
    for tree in found.trees:
        for name, param in settings_of(tree):
            if name in renamed.values():
                raise RenameRefusedError(f"'{new}' is already set at {shown(context, param.place)}")
    for analysis in context.analyses:
        _refuse_if_read(context, analysis, found, renamed)
    return tuple(
        RenameEdit(
            place,
            new,
            f"Parameter '{found.leaf}' in {context.shown(place.file)}",
            f"Also set for nodes of {', '.join(map(context.shown, others))}" if others else "",
            bool(others),
        )
        for place, others in found.places.items()
    )


def _refuse_if_read(
    context: QueryContext, analysis: Analysis, found: ParameterRename, renamed: Mapping[str, str]
) -> None:
    """A node that asks for the old name, and not for the new one, would no longer get the value."""
    own = analysis.tree.ros.own_parameters
    reads: dict[str, list[Location | None]] = {}
    by_node: dict[str, set[str]] = {}
    for read in analysis.graph.param_reads if analysis.graph is not None else ():
        name = own_parameter(read.node, read.use.name) if own else read.name
        by_node.setdefault(read.node.name, set()).add(name)
        if name in found.names and read.use.access != "set":
            reads.setdefault(f"{read.node.name}\0{name}", []).append(made_at(context, read.use))
    for key, places in reads.items():
        node, _, name = key.partition("\0")
        if renamed[name] not in by_node[node]:
            place = next((each for each in places if each is not None), None)
            where = f" at {shown(context, place)}" if place is not None else ""
            raise RenameRefusedError(f"{node} reads '{found.leaf}'{where}: rename it in the source first")


def _leaf(context: QueryContext, place: Location) -> Location:
    """The last part of the name that is written at a place."""
    text = context.text(place)
    found = _LEAF.search(text.rstrip("'\""))
    if found is None or "$" in text:
        raise RenameRefusedError(f"The name at {shown(context, place)} comes from a substitution")
    start = place.span.start
    return context.location(place.file, Span(start + found.start(), start + found.end()))


def topic_edits(context: QueryContext, symbol: NamedSymbol, new: str | None) -> tuple[RenameEdit, ...]:
    """The edits of all remaps that give nodes the topic, service or action at the cursor, which `new` is written in
    place of; for None only whether that is possible. Raises `RenameRefusedError`."""
    at = context.location(context.path, symbol.span)
    renamed: dict[str, str] = {}
    trees = context.all_trees
    for tree in trees:
        for node, remap in remaps_at(tree, at):
            if remap.target_location != at:
                raise RenameRefusedError(
                    f"'{context.text(at)}' is the name that {node.name} itself uses: rename it in the source"
                )
            old = names.resolve(remap.target, node.name)
            renamed[old] = names.resolve(new, node.name) if new is not None else old
    if not renamed:
        raise RenameRefusedError(f"'{context.text(at)}' is a name of the node itself: rename it in the source")
    if new is not None and (not new or not names.is_legal(new) or new.startswith("~")):
        raise RenameRefusedError(f"'{new}' is not a topic name: a letter, then letters, digits, underscores, slashes")
    named = dict[Location, list[tuple[str, str]]]()
    for analysis in context.analyses:
        for place, pair in _named_by_values(context, analysis, renamed, checks_new=new is not None):
            named.setdefault(place, []).append(pair)
    while True:
        reached = {**_reached(trees, renamed), **named}
        wider = context.trees_around({place.file for place in reached})
        if len(wider) == len(trees):
            break
        trees = wider
    edits = dict(_targets(context, reached, renamed, context.text(at), new))
    return tuple(
        RenameEdit(
            place,
            text,
            f"{'Topic' if place in named else 'Remap to'} '{context.text(place)}' in {context.shown(place.file)}",
        )
        for place, text in edits.items()
    )


def _named_by_values(
    context: QueryContext, analysis: Analysis, renamed: Mapping[str, str], *, checks_new: bool
) -> Iterator[tuple[Location, tuple[str, str]]]:
    """The values of parameters and of RViz that give nodes one of the names, each with a node and its name there. A
    name that a node has from elsewhere stands in the way."""
    if analysis.graph is None:
        raise RenameRefusedError("The nodes of this launch are not analysed yet")
    for connection, _ in connections(analysis.graph, frozenset(renamed)):
        if connection.remap is None and not connection.endpoint.builtin:
            values = _values_of(context, analysis.tree, connection)
            if not values:
                place = made_at(context, connection.endpoint) or connection.node.location
                raise RenameRefusedError(
                    f"{connection.node.name} uses '{connection.name}' without a remap, at {shown(context, place)}"
                )
            yield from ((value, (connection.node.name, connection.name)) for value in values)
    for old, new in renamed.items() if checks_new else ():
        if old != new and (met := next(connections(analysis.graph, frozenset({new})), None)) is not None:
            raise RenameRefusedError(f"'{new}' exists already: {met[0].node.name} uses it")


def _values_of(context: QueryContext, tree: LaunchTree, connection: Connection) -> tuple[Location, ...]:
    """The values that name an endpoint, if they do so for that node alone and no other launch reads them."""
    named_by, name = connection.endpoint.named_by, connection.endpoint.name
    known = {analysis.launch for analysis in context.analyses}
    if named_by is None or not known.issuperset(context.current.roots_touching(named_by.place.file)):
        return ()
    if named_by.display:
        return tuple(displayed_at(context, named_by.place.file, name))
    owners = {node.name for node in tree.nodes if any(param.place == named_by.place for param in node.params)}
    private = f"{connection.node.name}/"
    shared = [name for name, param in tree.params.items() if param.place == named_by.place]
    if owners - {connection.node.name} or not all(name.startswith(private) for name in shared):
        return ()
    place = value_at(context, named_by.place, name)
    return (place,) if place is not None else ()


def _reached(trees: Iterable[LaunchTree], renamed: Mapping[str, str]) -> Mapping[Location, list[tuple[str, str]]]:
    """The targets of remaps that come to one of the names, with each node that they reach and the name that it gets."""
    reached: dict[Location, list[tuple[str, str]]] = {}
    for tree in trees:
        for node in tree.nodes:
            for remap in node.remaps:
                pair = node.name, names.resolve(remap.target, node.name)
                reached.setdefault(remap.target_location, []).append(pair)
    return {place: pairs for place, pairs in reached.items() if any(full in renamed for _, full in pairs)}


def _targets(
    context: QueryContext,
    reached: Mapping[Location, list[tuple[str, str]]],
    renamed: Mapping[str, str],
    written: str,
    new: str | None,
) -> Iterator[tuple[Location, str]]:
    """What is to be written at each of these targets."""
    for place, pairs in reached.items():
        text = context.text(place)
        if "$" in text or any(names.resolve(text, node) != full for node, full in pairs):
            raise RenameRefusedError(f"The name at {shown(context, place)} comes from a substitution")
        if any(full not in renamed for _, full in pairs):
            raise RenameRefusedError(f"The remap at {shown(context, place)} makes other names, too")
        if new is None:
            continue
        choices = [new] if text == written else []
        choices += dict.fromkeys(_below(renamed[full], node) for node, full in pairs) if text[:1] != "/" else ()
        choices += dict.fromkeys(renamed[full] for _, full in pairs)
        fits = (each for each in choices if all(names.resolve(each, node) == renamed[full] for node, full in pairs))
        chosen = next(fits, None)
        if chosen is None:
            raise RenameRefusedError(f"No name at {shown(context, place)} means the same for all nodes of that remap")
        yield place, chosen


def _below(full: str, node: str) -> str:
    """A full name as a node can write it: without its own namespace where that is in front."""
    return full.removeprefix(names.parent(node))


def shown(context: QueryContext, place: Location) -> str:
    """A place for a message."""
    document = context.document(place.file)
    line = document.lines.position(place.span.start)[0] + 1 if document else 1
    return f"{context.shown(place.file)}:{line}"
