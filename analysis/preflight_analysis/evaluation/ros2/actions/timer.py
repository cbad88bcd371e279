"""`<timer>` and `<ros_timer>`: `TimerAction` and `ROSTimer`."""

from __future__ import annotations

from preflight_analysis.evaluation.ros2.entity import action_tag, flag
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.schema import Attribute

_PERIOD = Attribute("period", "Seconds to wait.", "number", required=True, taken="performed")


def evaluate(walk: Walk, performer: Performer, action: Action) -> None:
    """What is inside comes after all that does not wait."""
    walk.events.later(performer.place, action.children)


ENTITIES = (
    LaunchAction(
        kind="timer",
        tag=action_tag(
            "Executes what is inside after some time.",
            _PERIOD,
            flag("cancel_on_shutdown", "Whether a shutdown ends the wait.", "true", taken="performed"),
            named_by=("period",),
        ),
        evaluate=evaluate,
        offered=160,
        holds_actions=True,
    ),
    LaunchAction(
        kind="ros_timer",
        tag=action_tag("Executes what is inside after some time of the ROS clock.", _PERIOD, named_by=("period",)),
        evaluate=evaluate,
        offered=170,
        holds_actions=True,
    ),
)
