"""`<node_container>`, `<load_composable_node>` and the `<composable_node>`s in them."""

from __future__ import annotations

from preflight_analysis.evaluation.ros2.actions.node import CHILDREN, NAMED_NODE
from preflight_analysis.evaluation.ros2.entity import NAMESPACE, Part, action_tag, part_tag
from preflight_analysis.evaluation.ros2.nodes import evaluate_composable, evaluate_node, namespace_of
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.schema import Attribute


def evaluate(walk: Walk, performer: Performer, action: Action) -> None:
    """Start a container, then load the nodes in it."""
    nodes = walk.state.nodes
    before = len(nodes)
    evaluate_node(performer, action, kind="container", deferred=walk.deferred)
    if len(nodes) > before:
        evaluate_composable(performer, action.children, nodes[-1].name, walk.applies, deferred=walk.deferred)


def load(walk: Walk, performer: Performer, action: Action) -> None:
    """Load nodes into a container, which Python files may name by the action that starts it."""
    target = action.value("target")
    named = next((child for child in action.children if child.kind == "target"), None)
    if named is not None:
        ns, _ = namespace_of(performer, named)
        base = named.value("name")
        above = ns.text if ns is not None and ns.text != "/" else ""
        name = f"{above}/{performer.value(base).text if base is not None else ''}"
        evaluate_composable(performer, action.children, name, walk.applies, deferred=walk.deferred)
    elif target is not None:
        name = performer.value(target).text
        evaluate_composable(performer, action.children, name, walk.applies, deferred=walk.deferred, target=target.span)


ENTITIES = (
    LaunchAction(
        kind="node_container",
        tag=action_tag(
            "Starts a container and loads composable nodes into it.",
            *NAMED_NODE,
            children=(*CHILDREN, "composable_node"),
            named_by=("name", "exec"),
            starts=True,
        ),
        evaluate=evaluate,
        offered=120,
        starts_process=True,
        is_part=True,
    ),
    LaunchAction(
        kind="load_composable_node",
        tag=action_tag(
            "Loads composable nodes into a container that runs.",
            Attribute("target", "The full name of the container.", required=True),
            children=("composable_node",),
            named_by=("target",),
            starts=True,
        ),
        evaluate=load,
        offered=130,
        is_part=True,
    ),
    Part(kind="target", tag=None, of=("load_composable_node",)),
    Part(
        kind="composable_node",
        tag=action_tag(
            "A node to load into the container.",
            Attribute("pkg", "The package that has the plugin.", "package", required=True),
            Attribute("plugin", "The class of the node.", "component", required=True),
            Attribute("name", "The name of the node.", "node", required=True),
            NAMESPACE,
            children=("param", "remap", "extra_arg"),
            named_by=("name", "plugin"),
            starts=True,
        ),
        of=("node_container", "load_composable_node"),
    ),
    Part(
        kind="extra_arg",
        tag=part_tag(
            "An argument for the container about this node, such as `use_intra_process_comms`.",
            Attribute("name", "Its name.", required=True),
            Attribute("value", "Its value.", required=True),
            named_by=("name",),
            detail=("value",),
        ),
        of=("composable_node",),
    ),
    Part(kind="extra_dict", tag=None, of=("composable_node",)),
)
