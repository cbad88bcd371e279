"""What the files around a launch call topics and services: launch files by their remaps, and sources of nodes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from itertools import compress
from typing import TypeVar

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation import names
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.graph.model import Connection
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.alike import Names
from preflight_analysis.model.context import Context
from preflight_analysis.model.dangling import dangling_consumers, dangling_providers
from preflight_analysis.model.entry import GRAPH_NAME, Entry
from preflight_analysis.model.name_index import around
from preflight_analysis.model.names_in_sources import meant_in_sources, of_specific_type
from preflight_analysis.model.nearest import is_slip_of_words, likeness
from preflight_analysis.model.siblings import slips_beside, without_slash

V = TypeVar("V")

_ENOUGH = 2
"""Files that have to agree on a name."""


@dataclass(frozen=True, slots=True)
class Elsewhere:
    """How the files around write a name that this launch has otherwise, and how many of them do."""

    name: str
    files: int
    in_source: bool = False
    """Whether it is the sources of nodes that have the name, and not launch files."""
    beside: str | None = None
    """The name that the same node has in this launch and that says so, where no other file does."""


def in_use_around(context: Context, connections: Sequence[Connection]) -> list[bool]:
    """Whether several launch files around write the name of each end, or a simulator makes it in some launch: it is no
    slip, whoever is to be at its other end."""
    if not connections:
        return []
    known = around(context, "value")
    made = (*around(context, "bridged"), *around(context, "simulated", "robots"))
    simulated = {each.text.strip("/") for each in made}
    return [
        known.get(Entry("value", connection.name), 0) >= _ENOUGH or connection.name.strip("/") in simulated
        for connection in connections
    ]


def named_in_files(context: Context, connection: Connection) -> bool:
    """Whether a parameter file around names a topic so, or several launch files remap to it: it is that of a node that
    another launch starts, such as a multiplexer."""
    if _Targets(around(context, "remap")).has(connection.name, connection.node.name):
        return True
    leaf = names.leaf(connection.name)
    return any(names.leaf(each.text) == leaf for each in around(context, "value", "yaml"))


@derived
def used_elsewhere(context: Context) -> Mapping[int, Elsewhere]:
    """For ends of topics and services without another one, by id, the name that their remaps were most likely to give:
    theirs is a slip of it, several launch files around have it, and no other one has theirs. Likewise, of consumers
    without a remap, what the sources of the workspace offer."""
    consumers = (*dangling_consumers(context, "topics"), *dangling_consumers(context, "services"))
    partial = {path for path, launch_file in context.launch_files.items() if launch_file.partial}
    specific = filter(None, context.each(of_specific_type, consumers))
    read = (each for each in specific if each.node.location.file not in partial)  # where each remap is known
    slips = [(each, meant) for each in read if (meant := meant_in_sources(context, each)) is not None]
    in_use = in_use_around(context, [each for each, _ in slips])
    by_source = {
        id(each): Elsewhere(*meant, in_source=True)
        for (each, meant), is_used in zip(slips, in_use, strict=True)
        if not is_used
    }
    publishers = dangling_providers(context, "topics")
    lone = [each for each in (*consumers, *publishers) if each.remap is not None]
    found = context.each(_used, lone, _Targets(around(context, "remap"))) if lone else ()
    by_launches = {id(end): elsewhere for end, elsewhere in _of_some(lone, found)}
    return {**by_launches, **by_source, **_beside(context, lone, publishers)}


def _of_some(ends: Sequence[Connection], found: Sequence[V | None]) -> Iterator[tuple[Connection, V]]:
    """The few of many ends of which something was found, each with that."""
    return zip(compress(ends, found), filter(None, found), strict=True)


def _beside(
    context: Context, lone: Sequence[Connection], publishers: tuple[Connection, ...]
) -> Mapping[int, Elsewhere]:
    """Likewise by what the same node is given beside."""
    topics = tuple(context.graph.topics.values()) if context.graph is not None else ()
    beside = context.one(slips_beside, "", publishers, topics) if publishers else {}
    slips = {found: Elsewhere(name, 0, beside=name) for found, name in beside.items()}
    slashes = _of_some(lone, context.each(without_slash, lone))
    lacking = {id(each): Elsewhere(name, 0, beside=other) for each, (name, other) in slashes}
    return {**slips, **lacking}


@dataclass(frozen=True)
class _Targets:
    """The targets of remaps as written, with how many files have each."""

    counts: Mapping[Entry, int]

    @cached_property
    def _several(self) -> Mapping[str, Names[tuple[str, int]]]:
        """Those of several files with that, by what a node puts before each (`_beginnings`), and by the rest."""
        found: dict[str, list[tuple[str, tuple[str, int]]]] = {"global": [], "private": [], "relative": []}
        for (_, written, role, *_), count in self.counts.items():
            kind = "global" if names.is_global(written) else "private" if names.is_private(written) else "relative"
            if count >= _ENOUGH and role == "to" and GRAPH_NAME.fullmatch(written):
                found[kind].append((names.canonicalize(f"/{written.removeprefix('~')}"), (written, count)))
        return {kind: Names(written) for kind, written in found.items()}

    def has(self, name: str, node: str) -> bool:
        """Whether several files have a target by which a node would come to this full name."""
        return any(any(self._several[kind].named(rest)) for kind, rest in _beginnings(name, node))

    def alike(self, name: str, node: str) -> Iterator[tuple[int, str]]:
        """The targets of several files of which the full name is a slip, and how many files have each."""
        for kind, rest in _beginnings(name, node):
            for other, (written, count) in self._several[kind].typos(rest):
                alike = likeness(rest, other)
                if alike is not None and alike[0] == "typo" and is_slip_of_words(rest, other):
                    yield count, written


def _beginnings(name: str, node: str) -> Iterator[tuple[str, str]]:
    """What is left of a full name of a node by what it may have put before that: nothing before a global name, itself
    before a private one, and its namespace before one that is `relative`."""
    for kind, before in (("global", ""), ("relative", names.parent(node).rstrip("/")), ("private", node)):
        if name.startswith(f"{before}/"):
            yield kind, name[len(before) :]


def _used(connection: Connection, known: _Targets) -> Elsewhere | None:
    node = connection.node.name
    if known.has(connection.name, node):
        return None
    found = [(-count, written) for count, written in known.alike(connection.name, node)]
    if not found:
        return None
    count, written = min(found)
    return Elsewhere(written, -count)


BY_FILES = (Reason.OUTSIDE, Reason.FROM_SOURCE)
"""Doubts of what `elsewhere_finding` says."""
