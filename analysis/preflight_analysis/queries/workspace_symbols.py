"""Nodes, launch files, executables and topics of the whole workspace by a part of their name."""

from __future__ import annotations

import heapq
import itertools
import os
import re
from collections.abc import Callable, Iterable, Iterator
from typing import Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation import names
from preflight_analysis.model.installation import build_files_of
from preflight_analysis.model.name_index import mentions_in
from preflight_analysis.queries.places import shown_path
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.workspace.index import WorkspaceIndex
from preflight_analysis.workspace.workspace import Analysis

LIMIT = 500
"""Nobody reads further, and an editor asks again with each letter."""


@dataclass(frozen=True, slots=True)
class WorkspaceSymbol:
    """Something with a name. `container` tells it from others of that name: a folder, an executable, a type, a
    package."""

    name: str
    kind: Literal["node", "launch", "topic", "executable"]
    container: str
    location: Location


def workspace_symbols(
    index: WorkspaceIndex,
    analyses: Iterable[Analysis],
    folder: str | None,
    query: str,
    made: Iterable[WorkspaceSymbol] = (),
) -> tuple[WorkspaceSymbol, ...]:
    """At most `LIMIT` symbols, those `made` by packages among them, that have the letters of `query` in that order,
    whatever their case, best first."""
    letters = query.lower().replace(" ", "")
    # Each letter at its first place after the one before: unlike `.*`, this never goes back.
    matches = re.compile("".join(f"[^{re.escape(c)}]*{re.escape(c)}" for c in letters), re.DOTALL).match

    def named(name: str) -> bool:
        return matches(name.lower()) is not None

    found = itertools.chain(_files(index, folder, named), _nodes(index, named), _topics(analyses, named))
    found = itertools.chain(found, (symbol for symbol in made if named(symbol.name)))
    return tuple(heapq.nsmallest(LIMIT, found, key=lambda symbol: _rank(symbol, letters)))


def executables(context: QueryContext) -> Iterator[WorkspaceSymbol]:
    """What the packages of the workspace make, as their build files say."""
    sources = context.workspace.sources
    for package in context.workspace.environment.own_packages:
        for path in build_files_of(sources, package):
            for entry, span, _ in mentions_in(sources.db, path):
                if entry.kind == "program" and entry.role == "declares":
                    yield WorkspaceSymbol(entry.text, "executable", package.name, context.location(path, span))


def _rank(symbol: WorkspaceSymbol, letters: str) -> tuple[object, ...]:
    """Whole names before beginnings of names before parts, short ones first."""
    name = symbol.name.lower()
    last = names.leaf(name)
    how = (last != letters, not last.startswith(letters), letters not in last, letters not in name)
    return (*how, len(name), name, symbol.kind, symbol.container, symbol.location.file, symbol.location.span)


def _files(index: WorkspaceIndex, folder: str | None, named: Callable[[str], bool]) -> Iterator[WorkspaceSymbol]:
    for path in index.files:
        name = os.path.basename(path)
        if named(name):
            where = os.path.dirname(shown_path(path, folder))
            yield WorkspaceSymbol(name, "launch", where, Location.of_file(path))


def _nodes(index: WorkspaceIndex, named: Callable[[str], bool]) -> Iterator[WorkspaceSymbol]:
    seen: set[tuple[str, Location]] = set()
    for _, node in index.nodes():
        if named(node.name) and (node.name, node.location) not in seen:
            seen.add((node.name, node.location))
            yield WorkspaceSymbol(node.name, "node", f"{node.package}/{node.executable}", node.location)


def _topics(analyses: Iterable[Analysis], named: Callable[[str], bool]) -> Iterator[WorkspaceSymbol]:
    seen: set[tuple[str, Location]] = set()
    for analysis in analyses:
        for channel in analysis.graph.topics.values() if analysis.graph else ():
            name = channel.name
            connection = next(
                (
                    connection
                    for connection in (*channel.providers, *channel.consumers)
                    if not connection.endpoint.builtin
                ),
                None,
            )
            if connection is not None and named(name) and (name, connection.node.location) not in seen:
                seen.add((name, connection.node.location))
                yield WorkspaceSymbol(name, "topic", ", ".join(channel.types), connection.node.location)
