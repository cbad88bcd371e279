"""`RegisterEventHandler` and `UnregisterEventHandler`, which only Python files have."""

from __future__ import annotations

from preflight_analysis.evaluation.ros2.entity import Part
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk
from preflight_analysis.launch.model import Action


def register(walk: Walk, performer: Performer, action: Action) -> None:
    """What it has inside comes when the event does."""
    if any(child.kind == "function" for child in action.children):
        at = performer.place.location(action.head_span)
        walk.state.note_unknown("an event handler", "what its function does depends on the event", at)
        walk.any_change(performer.place)
    walk.events.register(performer.place, action)


def unregister(walk: Walk, performer: Performer, action: Action) -> None:
    """It does not come then."""
    walk.events.unregister(performer.place, action)


ENTITIES = (
    LaunchAction(
        kind="event_handler",
        tag=None,
        evaluate=register,
    ),
    LaunchAction(
        kind="unregister_event_handler",
        tag=None,
        evaluate=unregister,
    ),
    Part(kind="function", tag=None, of=("event_handler",)),
)
