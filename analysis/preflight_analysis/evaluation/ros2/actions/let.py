"""`<let>`: `SetLaunchConfiguration`, and what takes it back."""

from __future__ import annotations

from preflight_analysis.evaluation.ros2.entity import CONFIGURATION_NAME, action_tag
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk
from preflight_analysis.evaluation.tree import Use
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.schema import Attribute


def evaluate(walk: Walk, performer: Performer, action: Action) -> None:
    """Set it until the scope ends."""
    name, value = action.value("name"), action.value("value")
    if name is not None and value is not None:
        result, set_name = performer.value(value), performer.value(name).text
        walk.context.set(set_name, result, performer.place.origin(action.head_span))
        location = performer.place.location(name.span)
        shown = result.text if result.known else None
        walk.state.uses.append(Use("declaration", location, set_name, shown))
        walk.context.declare(set_name, location)


def unset(walk: Walk, performer: Performer, action: Action) -> None:
    """Forget it."""
    name = action.value("name")
    if name is not None:
        walk.context.unset(performer.value(name).text)


ENTITIES = (
    LaunchAction(
        kind="let",
        tag=action_tag(
            "Sets a launch configuration.",
            CONFIGURATION_NAME,
            Attribute("value", "The value.", required=True),
            named_by=("name",),
            detail=("value",),
        ),
        evaluate=evaluate,
        offered=40,
        configures=True,
    ),
    LaunchAction(
        kind="unlet",
        tag=None,
        evaluate=unset,
    ),
)
