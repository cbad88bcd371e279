"""`<shutdown>`: `Shutdown`; `EmitEvent`, of which it is one; and `LifecycleTransition`, which emits several."""

from __future__ import annotations

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.ros2.entity import Part, action_tag
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk, only_read
from preflight_analysis.evaluation.tree import StateChange
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.schema import Attribute

_TRANSITIONS = {"1": "configure", "2": "cleanup", "3": "activate", "4": "deactivate"}
"""By the number of each in `lifecycle_msgs/msg/Transition`; the others end the node."""
_CHANGES = "ChangeState"


def emit(walk: Walk, performer: Performer, action: Action) -> None:
    """Note the transition that a lifecycle node is asked for."""
    event = action.value("event")
    if event is None:
        walk.any_change(performer.place)  # a file that was not run has it in its text alone
    elif event.text == _CHANGES:
        _ask(performer, action)


def change(walk: Walk, performer: Performer, action: Action) -> None:
    """Note each transition that each lifecycle node is asked for."""
    for child in action.children:
        _ask(performer, child)
    if not action.children:
        walk.any_change(performer.place)


def _ask(performer: Performer, action: Action) -> None:
    number, name, place = action.value("node"), action.value("name"), performer.place
    full = performer.value(name) if name is not None else None
    node = names.canonicalize(f"/{full.text}") if full is not None and full.known else None
    asked = action.value("transition")
    transition = performer.value(asked) if asked is not None else None
    key = (place.file, place.chain, number.text) if number is not None else None
    known = _TRANSITIONS.get(transition.text, "") if transition is not None and transition.known else None
    performer.state.state_changes.append(StateChange(known, node, key))


ENTITIES = (
    LaunchAction(
        kind="shutdown",
        tag=action_tag("Ends the launch.", Attribute("reason", "Why, for the log.", "prose"), named_by=("reason",)),
        evaluate=only_read,
        offered=290,
    ),
    # Handlers wait for it; what they start is deferred.
    LaunchAction(kind="emit_event", tag=None, evaluate=emit),
    LaunchAction(
        kind="lifecycle_transition",
        tag=None,
        evaluate=change,
    ),
    Part(kind="asked", tag=None, of=("lifecycle_transition",)),
)
