"""`<set_remap>`: `SetRemap`."""

from __future__ import annotations

from preflight_analysis.evaluation.ros2.context import PushedRemap
from preflight_analysis.evaluation.ros2.entity import action_tag
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.schema import Attribute


def evaluate(walk: Walk, performer: Performer, action: Action) -> None:
    """Nodes of the scope have it from now on."""
    source, target = action.value("from"), action.value("to")
    if source is None or target is None:
        return
    origin = performer.place.origin(action.head_span)
    walk.context.push_remap(PushedRemap(performer.value(source), performer.value(target), origin))


ENTITIES = (
    LaunchAction(
        kind="set_remap",
        tag=action_tag(
            "Gives a name to the nodes that come later in this group.",
            Attribute("from", "The name that the nodes use.", "remap-from", required=True),
            Attribute("to", "The name that they get instead.", "remap-to", required=True),
            named_by=("from",),
            detail=("to",),
        ),
        evaluate=evaluate,
        offered=80,
    ),
)
