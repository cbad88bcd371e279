"""PRM001: a parameter is set and nobody reads it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from rapidfuzz.distance import OSA

from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.findings.finding import Confidence, Finding, Related
from preflight_analysis.graph.model import Graph, ParamRead
from preflight_analysis.rules.nearest import likeness, nearest
from preflight_analysis.rules.parameters import by_namespace, grouped, name_place, renamed
from preflight_analysis.rules.places import node_location, related_param_read
from preflight_analysis.rules.problems import include_chain
from preflight_analysis.rules.rule import Context, Rule
from preflight_analysis.rules.well_known import is_for_tools
from preflight_analysis.tracing.interface import Interface


@dataclass(frozen=True, slots=True)
class _Reads:
    """What all nodes read. `unset` are the names that some node reads and nothing sets, with who reads them."""

    names: frozenset[str]
    prefixes: frozenset[str]
    """Every name above one that is read: reading `/a/b` reads part of the value of `/a`."""
    searched: frozenset[str]
    unset: dict[str, ParamRead]
    opaque: frozenset[str]
    """Full names of the nodes of which it is not known what they read."""

    def covers(self, name: str) -> bool:
        """Whether somebody asks for the parameter, or for something below it."""
        return name in self.names or name in self.prefixes or name.rpartition("/")[2] in self.searched

    def covers_all(self, namespaces: Iterable[str]) -> bool:
        """Whether somebody asks for one of these namespaces as a whole, and so for all in it."""
        return "/" in self.names or not self.names.isdisjoint(namespaces)


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    if graph is None or not any(_tells_params(interface) for interface in graph.interfaces):
        return
    groups = context.once(by_namespace)
    reads = _collect(graph, groups)
    nodes = {node.name: node for node in graph.tree.nodes}
    orphans: list[Param] = []
    for namespace, params in groups.items():
        around = list(_namespaces(f"{namespace}/"))
        holder = next((nodes[name] for name in around if name in nodes), None)
        if (holder is not None and holder.name in reads.opaque) or reads.covers_all(around):
            continue
        unread = [p for p in params if not reads.covers(p.name) and not is_for_tools(p.name)]
        if holder is None:
            orphans += unread
        else:
            yield from (_private(rule, context, reads, param, holder) for param in unread)
    if any(use.use.access in ("search", "list") for use in graph.param_reads):
        return
    for param, read in _misplaced(orphans, reads):
        message = (
            f"no node reads parameter '{param.name}'; {read.node.name} reads '{read.name}', which is not set"
            f"{_default(read)}"
        )
        sure: Confidence = "likely" if graph.complete else "possible"
        yield rule.finding(
            message,
            name_place(param),
            confidence=sure,
            related=_related(param, read),
            fixes=renamed(context, param, read.name),
        )


def _collect(graph: Graph, namespaces: Iterable[str]) -> _Reads:
    names: set[str] = set()
    searched: set[str] = set()
    unset: dict[str, ParamRead] = {}
    opaque = {n.name for n, i in zip(graph.tree.nodes, graph.interfaces, strict=True) if not _tells_params(i)}
    filled = _above(f"{namespace}/" for namespace in namespaces)
    for read in graph.param_reads:
        if read.use.access == "list":
            opaque.add(read.node.name)
        elif read.use.access == "search":
            searched.add(read.use.name.strip("~/").partition("/")[0])
        elif read.use.access in ("get", "has"):
            names.add(read.name.rstrip("/") or "/")
            if not read.use.builtin and read.name not in graph.tree.params and read.name not in filled:
                unset.setdefault(read.name, read)
        else:
            names.add(read.name)
    return _Reads(frozenset(names), _above(names), frozenset(searched), unset, frozenset(opaque))


def _tells_params(interface: Interface) -> bool:
    """Whether all is known that the node reads. An annotation without a single parameter does not speak of them."""
    return interface.complete and (interface.source not in ("annotation", "settings") or bool(interface.params))


def _namespaces(name: str) -> Iterator[str]:
    """The namespaces that hold a name, the innermost first: `/a/b` and `/a` of `/a/b/c`."""
    while name := name.rpartition("/")[0]:
        yield name


def _above(names: Iterable[str]) -> frozenset[str]:
    """The namespaces that hold any of the names."""
    found: set[str] = set()
    for name in names:
        for namespace in _namespaces(name):
            if namespace in found:
                break  # and so are those above it
            found.add(namespace)
    return frozenset(found)


def _private(rule: Rule, context: Context, reads: _Reads, param: Param, holder: LaunchNode) -> Finding:
    mine = [r for r in reads.unset.values() if r.node is holder and r.name.startswith(holder.name + "/")]
    read = _nearest_read(param, holder, mine)
    if read is None:
        return rule.finding(
            f"{holder.name} does not read parameter '{param.name}' before its event loop, nor does any other node",
            name_place(param),
            severity="hint",
            confidence="possible",
            related=(Related(f"{holder.name} is started here", node_location(holder)), *include_chain(param.origin)),
        )
    message = (
        f"{holder.name} does not read parameter '{param.name}'; did you mean '{read.name}', which it reads and which "
        f"is not set{_default(read)}?"
    )
    return rule.finding(
        message,
        name_place(param),
        confidence="likely",
        related=_related(param, read),
        fixes=renamed(context, param, read.name),
    )


def _nearest_read(param: Param, holder: LaunchNode, reads: Iterable[ParamRead]) -> ParamRead | None:
    """The read that the parameter was most likely meant for: a typo apart, or of the same words and a fitting type."""
    relative = param.name[len(holder.name) + 1 :]
    ranked: list[tuple[int, int, str, ParamRead]] = []
    for read in reads:
        other = read.name[len(holder.name) + 1 :]
        alike = likeness(relative, other)
        if alike is None and nearest(relative, [other]) is not None and relative.count("/") == other.count("/"):
            alike = ("typo", int(OSA.distance(relative, other)))
        if alike is None or (alike[0] == "words" and not _fits(param.value, read)):
            continue
        ranked.append((0 if alike[0] == "typo" else 1, alike[1], read.name, read))
    return min(ranked, key=lambda entry: entry[:3])[3] if ranked else None


def _misplaced(params: Iterable[Param], reads: _Reads) -> Iterator[tuple[Param, ParamRead]]:
    """Parameters that nobody reads, each with a read of the same leaf name in another namespace that nothing sets.

    A leaf name alone (`rate`, `frame_id`) is no evidence: either two or more of a namespace's names agree, or the
    namespaces' own names are alike, or it is a typo of a name in the same namespace.
    """
    by_namespace: dict[str, dict[str, ParamRead]] = {}
    for name, read in reads.unset.items():
        if read.node.name not in reads.opaque:
            namespace, _, leaf = name.rpartition("/")
            by_namespace.setdefault(namespace, {})[leaf] = read
    for namespace, group in grouped(params).items():
        leaves = {param.name.rpartition("/")[2]: param for param in group}
        for leaf, param in leaves.items():
            near = nearest(leaf, by_namespace.get(namespace, ()))
            if near is not None and likeness(leaf, near) is not None:
                yield param, by_namespace[namespace][near]
        best: tuple[int, str] | None = None
        for other, there in by_namespace.items():
            if other == namespace:
                continue
            common = leaves.keys() & there.keys()
            if len(common) >= 2 or (common and _alike_namespaces(namespace, other)):
                rank = (-len(common), other)
                best = rank if best is None or rank < best else best
        if best is not None:
            there = by_namespace[best[1]]
            yield from ((param, there[leaf]) for leaf, param in leaves.items() if leaf in there)


def _alike_namespaces(namespace: str, other: str) -> bool:
    return bool(namespace.strip("/")) and bool(other.strip("/")) and likeness(namespace, other) is not None


def _fits(value: object, read: ParamRead) -> bool:
    """Whether a parameter's value is of the kind that the read expects, as far as its default tells."""
    default = read.use.default
    if not read.use.has_default or default is None:
        return True
    if isinstance(value, bool) or isinstance(default, bool):
        return isinstance(value, bool) and isinstance(default, bool)
    if isinstance(value, (int, float)) and isinstance(default, (int, float)):
        return True
    return type(value) is type(default)


def _default(read: ParamRead) -> str:
    return f" (default {read.use.default!r})" if read.use.has_default else ""


def _related(param: Param, read: ParamRead) -> tuple[Related, ...]:
    return (
        related_param_read(read),
        *include_chain(param.origin),
    )


RULE = Rule(
    id="PRM001",
    name="parameter-never-read",
    severity="warning",
    what="Reports a parameter that no node reads. Where a node reads one of a like name that nothing sets, or the "
    "same names below another namespace, it is a warning that names both; otherwise a hint, and only for parameters of "
    "a node that is known to its event loop. Reading a namespace as a whole reads all parameters in it.",
    why="The node goes on with its default, and nothing says that the value of the launch file is not used.",
    example='<!-- the node reads ~publish_objects -->\n<param name="publish_obejcts" value="false"/>',
    instead='<param name="publish_objects" value="false"/>',
    check=_check,
    needs_graph=True,
    every_root=True,
)
