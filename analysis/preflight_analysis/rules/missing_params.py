"""Parameters that nodes read without a default and that nobody sets, and which nodes ended because of them."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from preflight_analysis.graph.model import Graph, ParamRead
from preflight_analysis.rules.parameters import by_namespace
from preflight_analysis.rules.rule import Context
from preflight_analysis.rules.well_known import is_for_tools
from preflight_analysis.tracing.interface import Interface, without_stamp

_COMPLAINT = re.compile(r"KeyError|param|not set|missing|required|mandatory|not (found|given|specified|defined)", re.I)


@dataclass(frozen=True, slots=True)
class Missing:
    """A parameter that a node lacks. `died` is the line in which the node, which ended, complains of it."""

    read: ParamRead
    died: str | None


def missing_params(context: Context) -> Mapping[int, tuple[Missing, ...]]:
    """By the id of the node what it reads without a default, or asks for, and nobody sets, each name once.

    A node that asks whether there is such a parameter, or reads it with a default too, may go on without it: of these
    it stands here as not mandatory. Ask through `context.once`.
    """
    graph = context.graph
    if graph is None or not graph.param_reads or not context.tree.complete:
        return {}
    missing = _missing(context, graph)
    interfaces = {id(node): each for node, each in zip(graph.tree.nodes, graph.interfaces, strict=True)}
    return {node: tuple(Missing(r, _last_words(interfaces[node], r)) for r in reads) for node, reads in missing.items()}


def _missing(context: Context, graph: Graph) -> dict[int, list[ParamRead]]:
    namespaces: set[str] = set()
    for namespace in context.once(by_namespace):
        above = namespace
        while above and above not in namespaces:
            namespaces.add(above)
            above = above.rpartition("/")[0]
    known = graph.tree.params.keys() | namespaces | {command.param for command in graph.tree.commands}
    known |= {r.name for r in graph.param_reads if r.use.access in ("set", "search")}
    with_default = {(id(r.node), r.name) for r in graph.param_reads if r.use.has_default}
    first: dict[tuple[int, str], ParamRead] = {}
    for read in graph.param_reads:
        key = (id(read.node), read.name)
        asks = read.use.access == "has"
        if read.use.builtin or key in with_default or not (asks or (read.use.access == "get" and read.use.mandatory)):
            continue
        if read.name in known or is_for_tools(read.name) or f"_{read.use.name.strip('~')}:=" in read.node.args:
            continue
        if asks or key not in first:
            first[key] = read
    found: dict[int, list[ParamRead]] = {}
    for (node, _), read in first.items():
        found.setdefault(node, []).append(read)
    return found


def _last_words(interface: Interface, read: ParamRead) -> str | None:
    """The line in which the node, which ended, complains of the parameter: rospy's KeyError, or its own words."""
    if interface.outcome.status not in ("crashed", "exited"):
        return None
    leaf = re.compile(rf"(?<!\w){re.escape(read.name.rpartition('/')[2])}(?!\w)")
    said = (interface.outcome.reason or "", *interface.outcome.stderr_tail)
    found = [without_stamp(line) for line in said if leaf.search(line) and _COMPLAINT.search(line)]
    return found[-1] if found else None
