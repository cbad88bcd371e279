"""LCH034: components for a container that the launch does not start (ROS 2)."""

import re
from collections.abc import Iterator

from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.rules.nearest import did_you_mean, likeness
from preflight_analysis.rules.problems import include_chain, rename
from preflight_analysis.rules.rule import Context, Rule
from preflight_analysis.rules.syntax import Tags


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    tree = context.tree
    loaded: dict[tuple[str, Location], LaunchNode] = {}
    tags = Tags(context.launch_files)
    nodes = {node.name: node for node in tree.nodes if node.kind != "composable"}
    for node in tree.nodes:
        if node.kind != "composable" or not node.container or node.unknowns or _full(node.container) in nodes:
            continue
        loaded.setdefault((node.container, _target(context, tags, node, node.container)), node)
    containers = {name: node for name, node in nodes.items() if node.kind == "container" or _may_load(node)}
    filled = {_full(node.container) for node in tree.nodes if node.container}
    for (container, location), node in loaded.items():
        full = _full(container)
        leaf = names.leaf(full)
        near = [name for name in containers if names.leaf(name) == leaf]
        if not near:
            near = [name for name in containers if (found := likeness(full, name)) is not None and found[0] == "typo"]
        if not near and len(containers) == 1:
            near = [name for name in containers if name not in filled]
        near = near[:1] if len(near) == 1 else []
        # What an argument says may be the container of another launch, which includes this file.
        written = context.text(location)
        given = "$(" in written or container not in written
        message = f"no node '{full}' is started by this launch, into which components are to be loaded"
        if near and names.leaf(near[0]) == leaf and not container.startswith("/"):
            message += "; a target without a leading slash is below '/', whatever namespace surrounds it"
        related = tuple(Related("the container that there is", containers[name].location) for name in near)
        fixes = rename(context, location, container, near[0]) if near else ()
        yield rule.finding(
            message + did_you_mean(near[0] if near else None),
            location,
            severity="warning" if near and tree.complete and not given else "hint",
            confidence="likely" if near else "possible",
            related=(*related, *include_chain(node.origin)),
            fixes=fixes,
        )


def _target(context: Context, tags: Tags, node: LaunchNode, container: str) -> Location:
    """Where the container is named. A program names it once, if at all as a whole, or builds the name somewhere."""
    tag = tags.at(node.location)
    target = tag.above[0].value("target") if tag is not None and tag.above else None
    if target is not None:
        return context.location(node.location.file, target.span)
    document = context.documents.get(node.location.file)
    text = document.text if document is not None else ""
    quoted = [match.span(2) for match in re.finditer(rf"(['\"])({re.escape(container)})\1", text)]
    return context.location(node.location.file, Span(*quoted[0])) if len(quoted) == 1 else node.location


def _full(container: str) -> str:
    """launch asks a client of its own node for `<target>/_container/load_node`, which lives in `/`."""
    return container if container.startswith("/") else f"/{container}"


def _may_load(node: LaunchNode) -> bool:
    return node.executable.startswith("component_container")


RULE = Rule(
    id="LCH034",
    name="container-not-found",
    severity="warning",
    what="Reports a `<load_composable_node>` (`LoadComposableNodes`) whose target is no node of the launch. Where "
    "there is a container of that name in another namespace, of nearly that name, or a single one that nothing "
    "is loaded into, it is a warning; otherwise it is but a hint, as the container may be started elsewhere (ROS 2).",
    why="launch waits for the service of the container, without end, and the components are never loaded.",
    example='<push_ros_namespace namespace="robot"/>\n'
    '<node_container pkg="rclcpp_components" exec="component_container" name="vision" namespace=""/>\n'
    '<load_composable_node target="vision">...</load_composable_node>',
    instead='<load_composable_node target="/robot/vision">...</load_composable_node>',
    generations=(2,),
    check=_check,
    every_root=True,
    in_branches=True,
)
