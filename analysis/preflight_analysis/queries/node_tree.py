"""What a launch would start, as a tree to be shown beside the text: namespaces, nodes, includes, what is left out."""

from __future__ import annotations

from bisect import bisect_left
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field
from typing import Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location, Origin, Span
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tags import tags_of
from preflight_analysis.evaluation.tree import CommandValue, Include, LaunchNode, LaunchTree, NotTaken, Param
from preflight_analysis.findings.finding import SEVERITIES, Finding, Severity
from preflight_analysis.frames.forest import Branch, forest
from preflight_analysis.launch.model import NODE_KINDS, Action
from preflight_analysis.model.context import Context
from preflight_analysis.model.frames import frames_of, place_of_edge
from preflight_analysis.model.lifecycle import inactive
from preflight_analysis.queries.places import shown_path
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.workspace.workspace import Analysis

Kind = Literal["namespace", "node", "param", "remap", "section", "include", "not-taken", "frame"]

_LENGTH = 60
"""Characters of a value: the rest is seen on hover."""
_MOST_PARAMS = 200
"""How many parameters are listed of one node, and of the shared ones."""
_WRITTEN_NAME = ("name", "plugin", "type", "exec", "file", "ns", "cmd", "target")


@dataclass(frozen=True, slots=True)
class Item:
    """A line of the tree. `file` is the launch file that it comes from, by which it is coloured; `name` the full name
    of a node or namespace. `worst` and `findings` are of what is written in a node's tag; `note` is one sentence."""

    kind: Kind
    label: str
    detail: str = ""
    name: str = ""
    location: Location | None = None
    file: str | None = None
    note: str = ""
    worst: Severity | None = None
    findings: int = 0
    children: tuple[Item, ...] = ()


@dataclass(frozen=True, slots=True)
class NodeTree:
    """All of one launch. `files` are the launch files in order of first appearance, the root in front."""

    files: tuple[str, ...]
    nodes: int
    items: tuple[Item, ...]


@dataclass(slots=True)
class _Namespace:
    spaces: dict[str, _Namespace] = field(default_factory=dict)
    items: list[Item] = field(default_factory=list)


def node_tree(analysis: Analysis, findings: Mapping[str, Sequence[Finding]]) -> NodeTree:
    """The tree of a launch. `findings` are those of each file, as the user sees them."""
    tree = analysis.tree
    by_owner = _params(tree)
    marks = _Marks(findings)
    graph = analysis.graph
    interfaces: Sequence[Interface | None] = graph.processes if graph is not None else [None] * len(tree.nodes)
    top = _Namespace()
    for node, interface in zip(tree.nodes, interfaces, strict=True):
        space = top
        for part in node.name.split("/")[1:-1]:
            space = space.spaces.setdefault(part, _Namespace())
        params = node.params if tree.ros.own_parameters else by_owner.get(node.name, ())
        lost = inactive(analysis.context, node)
        note = _known(node, interface, analysis.why_not_run) if lost is None else f"the lifecycle node {lost.reason}"
        space.items.append(_node(node, params, marks, note))
    items = [*_namespace(top, "/"), *_includes(analysis)]
    if shared := by_owner.get("", ()):
        items.append(Item("section", "Shared parameters", str(len(shared)), children=_listed(shared, "")))
    tags = tags_of(tree.generation)
    not_started = [
        each
        for each in tree.not_taken
        if each.value is not None and (tag := tags.get(each.action.kind.lower())) is not None and tag.starts
    ]
    if not_started:
        left_out = tuple(_not_taken(analysis, each, each.value or "") for each in not_started)
        items.append(Item("section", "Not started", str(len(left_out)), children=left_out))
    items += _frames(analysis.context)
    return NodeTree(tree.files, len(tree.nodes), tuple(items))


def _namespace(space: _Namespace, name: str) -> Iterator[Item]:
    yield from space.items
    for part, inside in space.spaces.items():
        label = part
        while not inside.items and len(inside.spaces) == 1:  # nothing is in it but another one
            ((part, inside),) = inside.spaces.items()  # noqa: PLW2901
            label += f"/{part}"
        full = f"{name}{label}/"
        yield Item("namespace", f"{label}/", name=full, children=tuple(_namespace(inside, full)))


class _Marks:
    """The findings within a tag, looked up by their place."""

    def __init__(self, findings: Mapping[str, Sequence[Finding]]) -> None:
        self._found = {path: sorted(found, key=_start) for path, found in findings.items()}
        self._starts = {path: [_start(f) for f in found] for path, found in self._found.items()}

    def within(self, path: str, span: Span) -> tuple[Severity | None, int]:
        """The worst severity and how many there are, hints left out."""
        starts = self._starts.get(path, [])
        first, last = bisect_left(starts, span.start), bisect_left(starts, span.end)
        severities = [f.severity for f in self._found[path][first:last]] if first < last else []
        reported = [severity for severity in severities if severity != "hint"]
        return max(reported, key=SEVERITIES.index, default=None), len(reported)


def _start(finding: Finding) -> int:
    return finding.location.span.start


def _node(node: LaunchNode, params: Sequence[Param], marks: _Marks, note: str) -> Item:
    detail = f"{node.package}/{node.executable}" if node.package else node.executable
    if node.plugin:
        detail = node.plugin
    if node.container:
        detail += f" in {node.container}"
    if node.deferred:
        detail += ", started later"
    remaps = [
        Item("remap", f"{remap.source} → {remap.target}", location=remap.origin[-1], file=remap.origin[-1].file)
        for remap in node.remaps
    ]
    worst, count = marks.within(node.location.file, node.action.span)
    return Item(
        "node",
        names.leaf(node.name),
        detail,
        node.name,
        node.location,
        node.location.file,
        note,
        worst,
        count,
        (*_listed(params, node.name), *remaps),
    )


def _known(node: LaunchNode, interface: Interface | None, why_not_run: str | None) -> str:
    """How much is known of what it does, where that is less than all."""
    if node.unknowns:
        return f"{node.unknowns[0].what} is unresolved: {node.unknowns[0].reason}"
    if interface is None:
        return why_not_run or "not run yet"
    outcome = interface.outcome
    return "" if outcome.status == "spinning" or interface.declared else (outcome.reason or why_not_run or "")


def _params(tree: LaunchTree) -> dict[str, list[Param]]:
    """The parameters of ROS 1 by the node below whose name they are, "" for those that are nobody's."""
    names = {node.name for node in tree.nodes}
    found: dict[str, list[Param]] = {}
    for param in tree.params.values():
        owner = param.name.rpartition("/")[0]
        while owner and owner not in names:
            owner = owner.rpartition("/")[0]
        found.setdefault(owner, []).append(param)
    return found


def _listed(params: Sequence[Param], owner: str) -> tuple[Item, ...]:
    items = [
        Item(
            "param",
            param.name.removeprefix(f"{owner}/") if owner else param.name,
            _value(param),
            location=param.origin[-1] if param.origin else None,
            file=param.origin[-1].file if param.origin else None,
        )
        for param in params[:_MOST_PARAMS]
    ]
    if len(params) > _MOST_PARAMS:
        items.append(Item("param", f"… and {len(params) - _MOST_PARAMS} more"))
    return tuple(items)


def _value(param: Param) -> str:
    value = param.value
    if isinstance(value, CommandValue):
        return f"output of {value.command}"[:_LENGTH]
    if isinstance(value, bytes):
        return f"{len(value)} bytes"
    text = " ".join(str(value)[: 2 * _LENGTH].split()) if value is not None else "unresolved"
    return f"{text[:_LENGTH]}…" if len(text) > _LENGTH else text


# Includes


def _includes(analysis: Analysis) -> Iterator[Item]:
    tree, folder = analysis.tree, analysis.environment.workspace
    started: dict[Origin, list[int]] = {}
    for index, node in enumerate(tree.nodes):
        for length in range(1, len(node.origin)):
            started.setdefault(node.origin[:length], []).append(index)
    shared: Counter[Origin] = Counter()
    for param in tree.params.values():
        for length in range(1, len(param.origin)):
            shared[param.origin[:length]] += param.owner is None
    # Each include comes before what is included in it: of those at one place each has what follows it.
    top: list[int] = []
    below: dict[int, list[int]] = {}
    around: list[int] = []
    ends: dict[int, int] = {}
    latest: dict[Origin, int] = {}
    before = tree.nodes_before or (0,) * len(tree.includes)
    for at, include in enumerate(tree.includes):
        if include.origin in latest:
            ends[latest[include.origin]] = before[at]
        latest[include.origin] = at
        while around and not _is_within(include, tree.includes[around[-1]]):
            around.pop()
        (below.setdefault(around[-1], []) if around else top).append(at)
        around.append(at)

    def item(at: int) -> Item:
        include = tree.includes[at]
        found = started.get(include.origin, [])
        last = bisect_left(found, ends[at]) if at in ends else len(found)
        count = last - bisect_left(found, before[at])
        given = " ".join(f"{name}:={value}" for name, value in include.args.items() if value is not None)
        adds = f"{count} node{'' if count == 1 else 's'}"
        if params := shared[include.origin]:
            adds += f", {params} shared parameter{'' if params == 1 else 's'}"
        label = shown_path(include.path, folder) if include.path is not None else "unresolved include"
        inside = tuple(map(item, below.get(at, ())))
        place = include.origin[-1]
        return Item("include", label, f"{adds}  {given}".rstrip(), location=place, file=include.path, children=inside)

    if tree.includes:
        yield Item("section", "Includes", str(len(tree.includes)), children=tuple(map(item, top)))


def _is_within(include: Include, outer: Include) -> bool:
    return len(include.origin) > len(outer.origin) and include.origin[: len(outer.origin)] == outer.origin


# Frames


def _frames(context: Context) -> Iterator[Item]:
    frames = frames_of(context)
    for space in frames.spaces:
        label = f"Frames of {space}/tf" if space else "Frames"
        note = "; ".join(("may be incomplete", *frames.gaps)) if frames.gaps else ""
        trees = tuple(_frame(context, each) for each in forest(frames, space))
        yield Item("section", label, str(len(frames.names(space))), note=note, children=trees)


def _frame(context: Context, branch: Branch) -> Item:
    place = place_of_edge(context, branch.edges[0]) if branch.edges else None
    return Item(
        "frame",
        branch.frame,
        ", ".join(edge.by for edge in branch.edges),
        location=place,
        file=place.file if place is not None else None,
        note=next((edge.doubt for edge in branch.edges if edge.doubt), ""),
        children=tuple(_frame(context, each) for each in branch.children),
    )


# What a condition leaves out


def _not_taken(analysis: Analysis, left_out: NotTaken, value: str) -> Item:
    written = left_out.shown
    said = f" is {value.strip()}" if written != value.strip() else ""
    note = f"left out: {left_out.condition} {written}{said}"
    return _written(analysis, left_out.action, left_out.origin[-1].file, note)


def _written(analysis: Analysis, action: Action, file: str, note: str) -> Item:
    """A tag that was not evaluated, in its own words, with what is in it."""
    named = next((a for name in _WRITTEN_NAME if (a := action.attribute(name)) and a.value.text.strip()), None)
    label = " ".join(named.value.text.split()) if named is not None else action.kind
    tags = tags_of(analysis.tree.generation)
    inside = (child for child in action.children if (tag := tags.get(child.kind)) is not None and tag.starts)
    children: Iterable[Item] = (_written(analysis, child, file, "") for child in inside)
    detail = note.removeprefix("left out: ")
    return Item(
        "not-taken",
        label if action.kind in NODE_KINDS or named is None else f"{action.kind} {label}",
        detail,
        location=analysis.context.location(file, action.head_span),
        file=file,
        note=note,
        children=tuple(children),
    )
