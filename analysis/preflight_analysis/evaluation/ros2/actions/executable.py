"""`<executable>`: `ExecuteProcess`; and what nodes and other processes have inside."""

from __future__ import annotations

from preflight_analysis.evaluation.ros2.entity import VARIABLE, Part, action_tag, part_tag
from preflight_analysis.evaluation.ros2.nodes import evaluate_executable
from preflight_analysis.evaluation.ros2.processes import PROCESS
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.schema import Attribute

_NODES = ("node", "lifecycle_node", "node_container")


def evaluate(walk: Walk, performer: Performer, action: Action) -> None:
    """Start a process."""
    evaluate_executable(performer, action, deferred=walk.deferred)


ENTITIES = (
    LaunchAction(
        kind="executable",
        tag=action_tag(
            "Starts a process that is no node.",
            Attribute("cmd", "The command line.", required=True, taken="command-line"),
            Attribute("name", "What the process is called in the logs."),
            *PROCESS,
            children=("env",),
            named_by=("name", "cmd"),
            starts=True,
        ),
        evaluate=evaluate,
        offered=150,
        starts_process=True,
        is_part=True,
    ),
    Part(
        kind="env",
        tag=part_tag(
            "Sets an environment variable for this process.",
            VARIABLE,
            Attribute("value", "Its value.", required=True),
            named_by=("name",),
            detail=("value",),
        ),
        of=(*_NODES, "executable"),
    ),
    Part(kind="argument", tag=None, of=(*_NODES, "executable")),
    Part(kind="ros_argument", tag=None, of=_NODES),
    Part(kind="on_exit", tag=None, of=(*_NODES, "executable")),
)
