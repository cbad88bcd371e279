"""LCH034: components or nodelets for a container that the launch does not start."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.graph.build import effective_remaps
from preflight_analysis.model.context import Context
from preflight_analysis.model.names_elsewhere import container_of_package
from preflight_analysis.model.nearest import did_you_mean, has_all_words, likeness, share_words
from preflight_analysis.model.places import attribute_location, quoted_once
from preflight_analysis.model.problems import include_chain, rename
from preflight_analysis.model.syntax import Tags
from preflight_analysis.rules.further_reading import COMPOSITION, NODELET
from preflight_analysis.rules.rule import Rule
from preflight_analysis.tracing.request import split_args


@dataclass(frozen=True, slots=True)
class _Load:
    """A component or nodelet that is to be loaded: where its container is named, how, and what that is in full."""

    node: LaunchNode
    location: Location
    written: str
    full: str


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    tree = context.tree
    loading = [*filter(None, context.each(_if_loading, tree.nodes))]
    if not loading:
        return
    nodes = {node.name: node for node in tree.nodes if node.kind != "composable"}
    loads = [*_components(context, loading), *_nodelets(context, loading)]
    lost: dict[tuple[str, Location], _Load] = {}
    for load in loads:
        if load.node.unknowns:
            continue
        if load.full not in nodes:
            lost.setdefault((load.full, load.location), load)
        elif nodes[load.full] is not load.node and _is_loaded(nodes[load.full]):
            yield _into_a_nodelet(rule, context, load, nodes[load.full])
    containers = {name: node for name, node in nodes.items() if node.kind == "container" or _may_load(node)}
    filled = {load.full for load in loads}
    loaded, container = ("components", "container") if tree.ros.ament else ("nodelets", "manager")
    for (full, location), load in lost.items():
        leaf = names.leaf(full)
        near = [name for name in containers if names.leaf(name) == leaf]
        if not near:
            near = [name for name in containers if (found := likeness(full, name)) is not None and found[0] == "typo"]
        if not near:
            beside = [name for name in containers if names.parent(name) == names.parent(full)]
            near = [name for name in beside if share_words(leaf, names.leaf(name)) and has_all_words(full, name)]
        if not near and len(containers) == 1:
            near = [name for name in containers if name not in filled]
        near = near[:1] if len(near) == 1 else []
        # What an argument says may be the container of another launch, which includes this file.
        text = context.text(location)
        given = "$(" in text or load.written not in text
        message = f"container '{full}' is not started by this launch; it is the target of {loaded}"
        if near and names.leaf(near[0]) == leaf and tree.ros.ament and not load.written.startswith("/"):
            message += "; a target without a leading slash is resolved in '/'"
        elsewhere = container_of_package(context, full) if not near else None
        if elsewhere is not None:
            message += f"; other launch files of the package load into '{elsewhere}'"
        related = tuple(Related(f"the {container} of this launch", containers[name].location) for name in near)
        fixes = rename(context, location, load.written, near[0]) if near else ()
        if elsewhere is not None:
            fixes = rename(context, location, names.leaf(load.written), elsewhere)
        yield rule.claim(
            message + did_you_mean(near[0] if near else None),
            location,
            subject=Subject("container", full),
            kind="near" if near or elsewhere else "absent",
            doubts=doubts(
                OUTSIDE=elsewhere is not None,
                OTHER_LAUNCH=elsewhere is None and not (near and tree.complete and not given),
            ),
            candidates=near or (elsewhere,),
            related=(*related, *include_chain(load.node.origin)),
            fixes=fixes,
        )


def _into_a_nodelet(rule: Rule, context: Context, load: _Load, taken: LaunchNode) -> Finding:
    manager = _words(taken)[2]
    return rule.claim(
        f"'{load.full}' is a nodelet, not a manager, and loads nothing{did_you_mean(manager)}",
        load.location,
        subject=Subject("container", load.full),
        kind="near",
        candidates=(manager,),
        related=(Related("the nodelet of that name", taken.location), *include_chain(load.node.origin)),
        fixes=rename(context, load.location, load.written, manager),
    )


def _if_loading(node: LaunchNode) -> LaunchNode | None:
    """The node, if it may be one that something else loads, or that has something loaded."""
    return node if (node.kind == "composable" and node.container) or is_nodelet(node) else None


def _components(context: Context, loading: Iterable[LaunchNode]) -> Iterator[_Load]:
    tags = Tags(context.launch_files)
    for node in loading:
        if node.kind == "composable" and node.container:
            yield _Load(node, _target(context, tags, node, node.container), node.container, _full(node.container))


def _nodelets(context: Context, loading: Iterable[LaunchNode]) -> Iterator[_Load]:
    """`nodelet load TYPE MANAGER`: its process asks for the service `MANAGER/load_nodelet`."""
    for node in loading:
        words = _words(node)
        if _is_loaded(node):
            remaps = {source: target for source, (_, target) in effective_remaps(node, 1).items()}
            service = names.resolve(f"{words[2]}/load_nodelet", node.name)
            full = remaps.get(service, service).removesuffix("/load_nodelet")
            yield _Load(node, _word(context, attribute_location(context, node, "args"), words[2]), words[2], full)


def is_nodelet(node: LaunchNode) -> bool:
    """Whether it is the program that loads nodelets or manages them (ROS 1)."""
    return node.package == "nodelet" and node.executable == "nodelet"


def _words(node: LaunchNode) -> list[str]:
    """The arguments of a node without its options."""
    return [word for word in split_args(node.args) if not word.startswith("-")]


def _is_loaded(node: LaunchNode) -> bool:
    """Whether it is a nodelet in the process of a manager (ROS 1)."""
    return is_nodelet(node) and len(words := _words(node)) > 2 and words[0] == "load"


def _word(context: Context, place: Location, word: str) -> Location:
    """The word within the place, where it stands there once."""
    text = context.text(place)
    if text.count(word) != 1:
        return place
    start = place.span.start + text.index(word)
    return context.location(place.file, Span(start, start + len(word)))


def _target(context: Context, tags: Tags, node: LaunchNode, container: str) -> Location:
    """Where the container is named. A program names it once, if at all as a whole, or builds the name somewhere."""
    tag = tags.at(node.location)
    target = tag.above[0].value("target") if tag is not None and tag.above else None
    if target is not None:
        return context.location(node.location.file, target.span)
    return quoted_once(context, node.location.file, container) or node.location


def _full(container: str) -> str:
    """launch asks a client of its own node for `<target>/_container/load_node`, which lives in `/`."""
    return container if container.startswith("/") else f"/{container}"


def _may_load(node: LaunchNode) -> bool:
    manages = is_nodelet(node) and split_args(node.args)[:1] == ("manager",)
    return manages or node.executable.startswith("component_container")


RULE = Rule(
    id="LCH034",
    name="container-not-found",
    effect="breaks",
    kind="absent",
    always=(Reason.UNSEEN,),
    sometimes=(Reason.OUTSIDE, Reason.OTHER_LAUNCH),
    what="Checks for a `<load_composable_node>` (`LoadComposableNodes`) whose target is not a node of the launch "
    "(ROS 2). In ROS 1 it checks for a nodelet whose manager is not a nodelet manager.",
    why="The loader waits for the service of the container without end, and loads nothing.",
    example='<push_ros_namespace namespace="robot"/>\n'
    '<node_container pkg="rclcpp_components" exec="component_container" name="vision" namespace=""/>\n'
    '<load_composable_node target="vision">...</load_composable_node>',
    instead='<load_composable_node target="/robot/vision">...</load_composable_node>',
    references=(
        COMPOSITION,
        NODELET,
    ),
    settings=("nodes",),
    check=_check,
    every_root=True,
    in_branches=True,
)
