"""Where nodes are named outside of their own tags: `/talker/status` in a remap, `/talker/rate` in a parameter."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.python_text import is_python
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.ros2.param_files import read_param_file
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree, Param
from preflight_analysis.evaluation.value_places import value_place
from preflight_analysis.evaluation.yaml_params import YamlError, load_yaml
from preflight_analysis.graph.annotations import annotated_names
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.launch.model import Action
from preflight_analysis.model.meant import meant_in
from preflight_analysis.model.section_reader import taken_by
from preflight_analysis.queries.places import action_at
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.queries.symbol_at import settings_of

_WORD = re.compile(r"\S+")
_LISTED = re.compile(r"""['"]?\s*:\s*[\[(]?\s*(?:['"][^'"\n]*['"]\s*,\s*)*['"]/?""")
"""What stands between a key and a text of its value in Python."""


@dataclass(frozen=True, slots=True)
class NodeMention:
    """A name that lies below that of `node`, its full name. `span`, in the file of `value`, is the last part of the
    node's name, without its namespace; None where it is not written there as it is: a substitution gives it, or a
    namespace around it."""

    node: str
    value: Location
    span: Span | None


def tags_of(context: QueryContext, tags: Iterable[Location]) -> Iterator[Location]:
    """The names as written in these start tags of nodes."""
    for tag in tags:
        facts = context.facts(tag.file)
        for mention in facts.mentions if facts else ():
            if mention.entry.kind == "node" and mention.action == tag.span:
                yield context.location(tag.file, mention.span)


def mentions_of(context: QueryContext, trees: Iterable[LaunchTree], wanted: frozenset[str]) -> Iterator[NodeMention]:
    """Where names below those of the `wanted` nodes (full names) are written."""
    for tree in trees:
        for full, param in settings_of(tree):
            for node in _above(full, wanted):
                if param.owner is None or names.is_global(context.text(param.place)):
                    yield _of_param(context, param, full, node)
        for place, full in remap_names(tree):
            for node in _above(full, wanted):
                yield NodeMention(node, place, _moved(_part(context.text(place), full, node), place.span.start))
        yield from _in_values(context, tree, wanted)
        for owner in tree.nodes:
            yield from _in_annotation(context, owner, wanted)
            yield from _in_arguments(context, owner, wanted)
            if owner.name in wanted:
                yield from _in_parameter_files(context, owner)
            if owner.container and owner.container_location is not None:
                full, place = f"/{owner.container.lstrip('/')}", owner.container_location
                if full in wanted:
                    yield NodeMention(full, place, _moved(_part(context.text(place), full, full), place.span.start))


def remap_names(tree: LaunchTree) -> Iterator[tuple[Location, str]]:
    """Both ends of each remap and what they stand for, once for each node that it reaches; private names left out."""
    for node in tree.nodes:
        for remap in node.remaps:
            for name, place in ((remap.source, remap.source_location), (remap.target, remap.target_location)):
                if not names.is_private(name):
                    yield place, names.resolve(name, node.name)


def _above(full: str, wanted: frozenset[str]) -> Iterator[str]:
    """The nodes among `wanted` whose name `full` is, or lies below."""
    at = full
    while at:
        if at in wanted:
            yield at
        at = at.rpartition("/")[0]


def _part(written: str, full: str, node: str) -> Span | None:
    """Where the last part of `node`'s name is in `written`, a name that stands for `full`."""
    if names.is_private(written) or "$" in written or "&" in written:
        return None
    if not full.endswith(written if names.is_global(written) else f"/{written}"):
        return None
    start = node.rfind("/") + 1 - (len(full) - len(written))
    return Span(start, start + len(node) - node.rfind("/") - 1) if start >= 0 else None


def _moved(span: Span | None, by: int) -> Span | None:
    return Span(span.start + by, span.end + by) if span is not None else None


def _of_param(context: QueryContext, param: Param, full: str, node: str) -> NodeMention:
    place = param.place
    launch_file = context.launch_file(place.file) if place.file == param.origin[-1].file else None
    action = action_at(launch_file, place.span.start) if launch_file else None
    if action is not None and action.kind == "rosparam" and place.span.start < action.body.span.start:
        action, place = None, param.origin[-1]
    if action is not None and action.kind == "param":
        return NodeMention(node, place, _moved(_part(context.text(place), full, node), place.span.start))
    return _of_key(context, param, full, node, place, action)


def _of_key(
    context: QueryContext, param: Param, full: str, node: str, place: Location, body: Action | None
) -> NodeMention:
    """The key of a YAML text that names the node, or the `ns` of the `<rosparam>` that loads it."""
    document = context.document(place.file)
    text, start = (body.body.text, body.body.span.start) if body else (document.text if document else "", 0)
    try:
        keys = load_yaml(text).keys
    except YamlError:
        keys = {}
    span = Span(place.span.start - start, place.span.end - start)
    path = next((path for path, key in keys.items() if key == span), ())
    base = full.removesuffix("/" + "/".join(path)) if path else full
    for depth in range(1, len(path) + 1):
        above = f"{base}/{'/'.join(path[:depth])}"
        if above == node and (key := keys.get(path[:depth])) is not None:
            written = context.location(place.file, Span(start + key.start, start + key.end))
            return NodeMention(node, written, _moved(_part(context.text(written), above, node), written.span.start))
    return _of_namespace(context, param, base, node) or NodeMention(node, place, None)


def _of_namespace(context: QueryContext, param: Param, base: str, node: str) -> NodeMention | None:
    """The `ns` or `param` attribute of the `<rosparam>` that sets a parameter."""
    for tag in reversed(param.origin):
        launch_file = context.launch_file(tag.file) if tag.file in context.current.files else None
        action = action_at(launch_file, tag.span.start) if launch_file else None
        if action is None or action.kind != "rosparam":
            continue
        ns, leaf = action.value("ns"), action.value("param")
        value = ns or leaf
        if value is None:
            return None
        below = f"/{leaf.text}" if ns is not None and leaf is not None else ""
        span = _part(value.text, base.removesuffix(below), node) if value.is_literal else None
        return NodeMention(node, context.location(tag.file, value.span), _moved(span, value.span.start))
    return None


def _in_annotation(context: QueryContext, owner: LaunchNode, wanted: frozenset[str]) -> Iterator[NodeMention]:
    for _, name, span in annotated_names(owner.action):
        if not names.is_private(name):
            full = names.resolve(name, owner.name)
            for node in _above(full, wanted):
                found = _part(name, full, node)
                yield NodeMention(node, context.location(owner.location.file, span), _moved(found, span.start))


def _in_parameter_files(context: QueryContext, owner: LaunchNode) -> Iterator[NodeMention]:
    """The keys in ROS 2's parameter files that end in the node's name."""
    name = names.leaf(owner.name)
    for path, source in {source.made_from or source.path: source for source in owner.param_sources}.items():
        document = context.document(path) if path is not None else None
        if document is None:
            continue
        for section in taken_by(owner, source, read_param_file(document)):
            if names.leaf(section.pattern) != name:
                continue
            key = section.spans[-1]
            written = document.text[key.start : key.end]
            exact = written == name or written.endswith(f"/{name}")
            last = Span(key.end - len(name), key.end) if exact else None
            yield NodeMention(owner.name, document.location(key), last)


def _in_values(context: QueryContext, tree: LaunchTree, wanted: frozenset[str]) -> Iterator[NodeMention]:
    """The parameters whose values name nodes: `node_names` of a lifecycle manager."""
    every = context.analyses[0].context.known if context.analyses else None
    for owner, values in meant_in(tree, every, Kept()) if every is not None else ():
        for meant in values:
            value, param = meant.value, meant.param
            if meant.meaning.kind != "node" or param is None or not isinstance(value, str) or not names.is_legal(value):
                continue
            full = names.resolve(value, owner.name)
            if full in wanted:
                place = value_at(context, param.place, value)
                found = _part(value, full, full) if place is not None else None
                at = place or param.place
                yield NodeMention(full, at, _moved(found, at.span.start))


def value_at(context: QueryContext, key: Location, value: str) -> Location | None:
    """Where the value of a parameter, of which the name is at `key`, has a text, if it is certain that this is it."""
    document = context.document(key.file)
    place = value_place(key, value, document)
    if place is None or document is None or context.text(place) != value:
        return None
    launch_file = context.launch_file(place.file) if place.file in context.current.files else None
    action = action_at(launch_file, key.span.start) if launch_file is not None else None
    if is_python(document.path, document.text):
        return place if _LISTED.fullmatch(document.text, key.span.end, place.span.start) else None
    return place if launch_file is None or (action and action.head_span.contains(place.span.start)) else None


def _in_arguments(context: QueryContext, owner: LaunchNode, wanted: frozenset[str]) -> Iterator[NodeMention]:
    """The manager that a nodelet is loaded into."""
    value = owner.action.value("args")
    words = owner.args.split()
    if value is None or owner.package != "nodelet" or len(words) < 3 or words[0] != "load":
        return
    full = names.resolve(words[2], owner.name)
    if full not in wanted:
        return
    place = context.location(owner.location.file, value.span)
    written = list(_WORD.finditer(value.text))
    plain = value.is_literal and value.span.end - value.span.start == len(value.text) and len(written) > 2
    found = _part(words[2], full, full) if plain else None
    yield NodeMention(full, place, _moved(found, value.span.start + written[2].start()) if plain else None)
