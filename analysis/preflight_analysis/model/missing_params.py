"""Parameters that nodes read without a default and that nobody sets, and which nodes ended because of them."""

from __future__ import annotations

import re
from collections.abc import Mapping
from itertools import chain

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation import names
from preflight_analysis.graph.model import Graph, ParamRead
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.model.parameters import namespaces_around
from preflight_analysis.model.well_known import describes_robot, is_for_tools
from preflight_analysis.tracing.interface import Interface, without_stamp

_COMPLAINT = re.compile(r"KeyError|param|not set|missing|required|mandatory|not (found|given|specified|defined)", re.I)


@dataclass(frozen=True, slots=True)
class Missing:
    """A parameter that a node lacks. `died` is the line in which the node, which ended, complains of it."""

    read: ParamRead
    died: str | None


@derived
def missing_params(context: Context) -> Mapping[int, tuple[Missing, ...]]:
    """By the id of the node what it reads without a default, or asks for, and nobody sets, each name once.

    A node that asks whether there is such a parameter, or reads it with a default too, may go on without it: of these
    it stands here as not mandatory.
    """
    graph = context.graph
    if graph is None or not any(graph.reads_of_nodes) or not context.tree.complete:
        return {}
    missing = _missing(context, graph)
    interfaces = {id(node): each for node, each in zip(graph.tree.nodes, graph.interfaces, strict=True)}
    return {node: tuple(Missing(r, _last_words(interfaces[node], r)) for r in reads) for node, reads in missing.items()}


def _missing(context: Context, graph: Graph) -> dict[int, list[ParamRead]]:
    params = graph.tree.params
    maybe_missing = chain.from_iterable(context.each(_mandatory_reads, graph.reads_of_nodes))
    unset = [read for read in maybe_missing if read.name not in params]
    if not unset:
        return {}
    leaves = {names.leaf(name) for name in params}
    unset = [read for read in unset if not describes_robot(read.name) or names.leaf(read.name) in leaves]
    known = {*namespaces_around(context)} | {command.param for command in graph.tree.commands}
    known |= {name for found in context.each(_found_elsewhere, graph.reads_of_nodes) for name in found}
    with_default = {key for keys in context.each(_defaulted, graph.reads_of_nodes) for key in keys}
    first: dict[tuple[int, str], ParamRead] = {}
    for read in unset:
        key = (id(read.node), read.name)
        if key not in with_default and read.name not in known and (read.use.access == "has" or key not in first):
            first[key] = read
    found: dict[int, list[ParamRead]] = {}
    for (node, _), read in first.items():
        found.setdefault(node, []).append(read)
    return found


def _mandatory_reads(reads: tuple[ParamRead, ...]) -> tuple[ParamRead, ...]:
    """Those of one node that it may lack the parameter for."""
    return tuple(filter(_is_mandatory, reads))


def _is_mandatory(read: ParamRead) -> bool:
    use = read.use
    if use.builtin or not (use.access == "has" or (use.access == "get" and use.mandatory)):
        return False
    return not is_for_tools(read.name) and f"_{use.name.strip('~')}:=" not in read.node.args


def _found_elsewhere(reads: tuple[ParamRead, ...]) -> tuple[str, ...]:
    """The names that the node makes or looks for in other namespaces too, or as a private one beside one that another
    launch may set."""
    of_others = {names.leaf(read.name) for read in reads if is_for_tools(read.name)}
    return tuple(
        read.name
        for read in reads
        if read.use.access in ("set", "search") or (read.use.name.startswith("~") and read.use.name[1:] in of_others)
    )


def _defaulted(reads: tuple[ParamRead, ...]) -> tuple[tuple[int, str], ...]:
    return tuple((id(read.node), read.name) for read in reads if read.use.has_default)


def _last_words(interface: Interface, read: ParamRead) -> str | None:
    """The line in which the node, which ended, complains of the parameter: rospy's KeyError, or its own words."""
    if interface.outcome.status not in ("crashed", "exited"):
        return None
    leaf = re.compile(rf"(?<!\w){re.escape(read.name.rpartition('/')[2])}(?!\w)")
    said = (interface.outcome.reason or "", *interface.outcome.stderr_tail)
    found = [without_stamp(line) for line in said if leaf.search(line) and _COMPLAINT.search(line)]
    return found[-1] if found else None
