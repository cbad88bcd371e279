"""MVT005: a node with a `MoveGroupInterface` gets no robot description (ROS 2).

It loads a robot model of its own: rdf_loader.cpp and synchronized_string_parameter.cpp of moveit/moveit2 365306eb take
the parameter of the node, else what the topic of that name has within ten seconds.
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.moveit import is_move_group, moveit_params
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.model import Graph
from preflight_analysis.model.channels import channels_of, doubts_of_ends
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import include_chain
from preflight_analysis.rules.further_reading import MOVEIT_CPP_INTERFACE
from preflight_analysis.rules.rule import Rule

_CLIENT_OF = "moveit_msgs/srv/QueryPlannerInterfaces"
"""Nobody else but `MoveGroupInterface` asks for it."""
_DESCRIPTIONS = ("robot_description", "robot_description_semantic")


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    clients = (end for channel in channels_of(context)["services"] for end in channel.consumers)
    for end in clients if graph is not None and context.tree.ros.own_parameters else ():
        node = end.node
        if end.endpoint.type != _CLIENT_OF or node.unknowns or node.lacks_params or graph is None:
            continue
        given = {param.name for param in node.params}
        missing = next(
            (name for name in _DESCRIPTIONS if name not in given and not _published(graph, node, name)), None
        )
        if missing is not None:
            yield rule.claim(
                say(
                    "{node} has a MoveGroupInterface and does not get '{missing}': neither the parameter is set nor "
                    "the topic published",
                    node=node.name,
                    missing=missing,
                ),
                node.location,
                subject=Subject("node", node.name),
                doubts=(
                    *doubts_of_ends(end),
                    *doubts(OTHER_LAUNCH=not any(map(is_move_group, graph.tree.nodes))),
                ),
                related=include_chain(node.origin),
            )


def _published(graph: Graph, node: LaunchNode, name: str) -> bool:
    """Whether the launch has somebody who publishes a description to a node, or a `move_group` that is told to."""
    remaps = names.resolve_remaps(tuple((each.source, each.target) for each in node.remaps), node.name)
    channel = graph.topics.get(names.resolve(name, node.name, remaps))
    if channel is not None and channel.providers:
        return True
    groups = (moveit_params(graph.tree, node) for node in graph.tree.nodes if is_move_group(node))
    return any((param := each.get(f"publish_{name}")) is not None and param.value is not False for each in groups)


RULE = Rule(
    id="MVT005",
    name="moveit-description-missing",
    effect="stops-node",
    kind="absent",
    always=(Reason.LIBRARY,),
    sometimes=(
        Reason.FROM_SOURCE,
        Reason.CATALOGUE,
        Reason.NOT_ANALYSED,
        Reason.DEPENDS,
        Reason.ASSUMED,
        Reason.OTHER_LAUNCH,
    ),
    what="Checks for a node with a `MoveGroupInterface` that gets no `robot_description` or no "
    "`robot_description_semantic`: neither as a parameter nor as a topic.",
    why="The node waits for ten seconds, then ends: `Unable to construct robot model. Please make sure all needed "
    "information is on the parameter server.`",
    example="Node(package='pick_demo', executable='pick_demo')",
    instead="Node(package='pick_demo', executable='pick_demo', parameters=[moveit_config.to_dict()])",
    references=(MOVEIT_CPP_INTERFACE,),
    generations=(2,),
    check=_check,
    needs_graph=True,
    every_root=True,
)
