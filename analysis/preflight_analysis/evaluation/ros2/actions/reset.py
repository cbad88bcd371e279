"""`<reset>`: `ResetLaunchConfigurations`; and `<keep>`, what is set all the same."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.documents.span import Origin
from preflight_analysis.evaluation.resolved import Resolved
from preflight_analysis.evaluation.ros2.entity import CONFIGURATION_NAME, Part, action_tag, part_tag
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.schema import Attribute


def evaluate(walk: Walk, performer: Performer, action: Action) -> None:
    """Only what is kept is configured afterwards."""
    all_kept = list(kept(performer, action))
    walk.context.reset_configurations()
    for name, result, origin in all_kept:
        walk.context.set(name, result, origin)


def kept(performer: Performer, action: Action) -> Iterator[tuple[str, Resolved, Origin]]:
    """What the `<keep>`s of an action set, each evaluated when it is asked for."""
    for child in action.children:
        name, value = child.value("name"), child.value("value")
        if child.kind == "keep" and name is not None and value is not None:
            yield performer.value(name).text, performer.value(value), performer.place.origin(child.head_span)


ENTITIES = (
    LaunchAction(
        kind="reset",
        tag=action_tag("Forgets all launch configurations but those to keep.", children=("keep",)),
        evaluate=evaluate,
        offered=230,
    ),
    Part(
        kind="keep",
        tag=part_tag(
            "A launch configuration that is set in the group, also where it forwards nothing.",
            CONFIGURATION_NAME,
            Attribute("value", "The value.", required=True),
            named_by=("name",),
            detail=("value",),
        ),
        of=("group", "reset"),
    ),
)
