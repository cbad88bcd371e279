"""`<set_use_sim_time>`: `SetUseSimTime`."""

from __future__ import annotations

from preflight_analysis.evaluation.ros2.entity import action_tag
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk, only_read
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.problems import BadValue
from preflight_analysis.launch.schema import Attribute


def evaluate(walk: Walk, performer: Performer, action: Action) -> None:
    """The frontends hand the text over where the action wants a bool: it fails when it is executed."""
    only_read(walk, performer, action)
    value = action.value("value")
    if value is not None and not performer.place.is_python:
        expected = 'what launch can use: it takes no text; write <set_parameter name="use_sim_time" value="..."/>'
        bad = BadValue(action.kind, "value", value.text, expected)
        walk.state.problem(bad, performer.place.origin(value.span))


ENTITIES = (
    LaunchAction(
        kind="set_use_sim_time",
        tag=action_tag(
            "Has the launch itself use simulated time; it sets no parameter of a node.",
            Attribute("value", "true or false.", "condition", ("true", "false"), required=True),
            named_by=("value",),
        ),
        evaluate=evaluate,
        offered=110,
    ),
)
