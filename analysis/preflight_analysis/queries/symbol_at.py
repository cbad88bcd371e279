"""What the name under the cursor means: the same thing may be named in many files."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree, Param, Remap
from preflight_analysis.graph.annotations import annotated_names
from preflight_analysis.model.entry import Kind as EntryKind
from preflight_analysis.model.entry import Mention
from preflight_analysis.queries.places import action_at, passed_at
from preflight_analysis.queries.query_context import QueryContext

Kind = Literal["arg", "file", "package", "executable", "component", "node", "param", "topic", "env", "machine"]

_OTHERS: Mapping[EntryKind, Kind] = {
    "component": "component", "machine": "machine", "package": "package", "program": "executable", "variable": "env",
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class NamedSymbol:
    """What is spoken of at `span` of the context's file.

    `names` are full names for `node`, `param` and `topic` (which stands for services and actions too): several where
    the file is included more than once. `files` are those whose argument it is, or the files themselves.
    """

    kind: Kind
    names: frozenset[str]
    span: Span
    files: tuple[str, ...] = ()


def symbol_at(context: QueryContext, offset: int) -> NamedSymbol | None:
    """What is named at `offset`; None where nothing is. Goes by syntax first, so that it works under a condition that
    is false and in a file that no launcher would take. What a run of a Python launch file told, and a parameter file,
    go by what came of them."""
    if (passed := passed_at(context.launch_file(context.path), offset)) is not None:
        found = symbol_at(context, passed.written)
        return replace(found, span=passed.span) if found is not None else None
    facts = context.facts(context.path)
    here = [m for m in facts.mentions if m.span.contains(offset)] if facts is not None else []
    if here:
        return _of_mention(context, min(here, key=lambda m: m.span.end - m.span.start))
    made = _of_key(context, offset) or _of_remap(context, offset)
    return made or _of_annotation(context, offset) or _of_launch_tag(context, offset)


def _of_mention(context: QueryContext, mention: Mention) -> NamedSymbol:
    place, tag = context.location(context.path, mention.span), context.location(context.path, mention.action)
    kind, name, role, of, _ = mention.entry
    literally = frozenset({f"{of}/{name}" if kind in ("program", "component") else name})
    match kind:
        case "argument":
            files = context.targets(tag) if role == "passes" else (context.path,)
            return NamedSymbol("arg", literally, mention.span, files)
        case "include":
            return NamedSymbol("file", literally, mention.span, context.targets(tag))
        case "node":
            return NamedSymbol(
                "node", frozenset(n.name for t in context.trees for n in t.nodes if n.location == tag), place.span
            )
        case "parameter":
            full = frozenset(n for t in context.trees for n, p in settings_of(t) if p.name_location == place)
            return NamedSymbol("param", full or _global(of + name), place.span)
        case "remap":
            full = frozenset(
                names.resolve(remap.target, node.name)
                for tree in context.trees
                for node, remap in remaps_at(tree, place)
            )
            return NamedSymbol("topic", full or _global(name), place.span)
    return NamedSymbol(_OTHERS[kind], literally, mention.span)


def _global(name: str) -> frozenset[str]:
    """A name that means the same everywhere, for tags that are not evaluated."""
    return frozenset({names.canonicalize(name)}) if names.is_global(name) and "$" not in name else frozenset()


def _of_key(context: QueryContext, offset: int) -> NamedSymbol | None:
    """A key in YAML, or in the dictionary of a Python launch file."""
    found: dict[Span, set[str]] = {}
    for tree in context.trees:
        for name, param in settings_of(tree):
            place = param.name_location
            if place is not None and place.file == context.path and place.span.contains(offset):
                found.setdefault(place.span, set()).add(name)
    span = min(found, key=lambda each: each.end - each.start, default=None)
    return NamedSymbol("param", frozenset(found[span]), span) if span is not None else None


def _of_remap(context: QueryContext, offset: int) -> NamedSymbol | None:
    """One of the names of a remap in a Python launch file."""
    for tree in context.trees:
        for node in tree.nodes:
            for remap in node.remaps:
                for place in (remap.source_location, remap.target_location):
                    if place.file == context.path and place.span.contains(offset):
                        made = remaps_at(tree, place)
                        full = frozenset(names.resolve(each.target, owner.name) for owner, each in made)
                        return NamedSymbol("topic", full, place.span)
    return None


def _of_annotation(context: QueryContext, offset: int) -> NamedSymbol | None:
    launch_file = context.launch_file(context.path)
    action = action_at(launch_file, offset) if launch_file else None
    for tree in context.trees:
        for node in tree.nodes:
            if action is None or node.location.file != context.path or not node.action.span.contains(offset):
                continue
            for kind, span, full in annotated(node):
                if span.contains(offset):
                    return NamedSymbol("param" if kind == "param" else "topic", frozenset({full}), span)
    return None


def _of_launch_tag(context: QueryContext, offset: int) -> NamedSymbol | None:
    launch_file = context.launch_file(context.path)
    root = launch_file.root if launch_file else None
    if root is None or not root.head_span.contains(offset):
        return None
    return NamedSymbol("file", frozenset({context.path}), root.head_span, (context.path,))


def settings_of(tree: LaunchTree) -> Iterator[tuple[str, Param]]:
    """Each setting of a parameter with its full name, also those that a later one replaces."""
    settings = [*tree.params.items()]
    settings += ((own_parameter(node, param.name), param) for node in tree.nodes for param in node.params)
    for name, param in settings:
        for earlier in param.overrides:
            yield name, earlier
        yield name, param


def own_parameter(node: LaunchNode, name: str) -> str:
    """The full name of a parameter of a node of ROS 2, which nobody else has."""
    return f"{node.name}:{name.removeprefix('~')}"


def remaps_at(tree: LaunchTree, place: Location) -> Iterator[tuple[LaunchNode, Remap]]:
    """The remaps that one of the two names at this place makes, with the nodes that they reach."""
    for node in tree.nodes:
        for remap in node.remaps:
            if place in (remap.source_location, remap.target_location):
                yield node, remap


def annotated(node: LaunchNode) -> Iterator[tuple[str, Span, str]]:
    """What the annotation of a node names: the tag of the item, the place in the node's file, the final name."""
    remaps = names.resolve_remaps(tuple((r.source, r.target) for r in node.remaps), node.name)
    for kind, name, span in annotated_names(node.action):
        yield kind, span, names.resolve(name, node.name, remaps)
