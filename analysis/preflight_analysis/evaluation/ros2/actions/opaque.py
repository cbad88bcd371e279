"""Actions that have to be executed for what they do: `OpaqueFunction`, `ForLoop`, classes of a file's own."""

from __future__ import annotations

from preflight_analysis.evaluation.resolved import Resolved
from preflight_analysis.evaluation.ros2.python_runs import OwnCode, called
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.unknown_text import is_unknown, readable
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk, only_read
from preflight_analysis.launch.model import Action


def evaluate(walk: Walk, performer: Performer, action: Action) -> None:
    """What a function of the file's, or an action of its own, does with what is configured now."""
    number, name = action.value("id"), action.value("class")
    if number is None or name is None or walk.too_deep(performer.place, action):
        return
    place, context = performer.place, walk.context
    answer = called(walk.state, context, place, OwnCode(number.text, name.text, "execute", action.head_span))
    origin = place.origin(action.head_span)
    if answer is None:
        walk.any_change(performer.place)
        context.cannot_follow(origin[-1])
        return
    for key, text in (answer.changed or {}).items():
        if key not in ("ros_namespace", "global_params", "ros_remaps"):
            context.set(key, Resolved(readable(text), not is_unknown(text)), origin)
    for key in answer.removed:
        context.unset(key)
    for key, text in (answer.variables or {}).items():
        context.set_variable(key, text)
    walk.inside(answer.place, answer.actions)


def evaluate_coroutine(walk: Walk, performer: Performer, action: Action) -> None:
    """Nobody awaits it here."""
    at = performer.place.location(action.head_span)
    walk.state.note_unknown("OpaqueCoroutine", "what it does is known only when it is launched", at)
    walk.any_change(performer.place)


def evaluate_stand_in(walk: Walk, performer: Performer, action: Action) -> None:
    """An action made by a module that is not installed: anything may be in it."""
    only_read(walk, performer, action)
    walk.context.cannot_follow(performer.place.location(action.head_span))


ENTITIES = (
    LaunchAction(
        kind="opaque",
        tag=None,
        evaluate=evaluate,
        configures=True,
    ),
    LaunchAction(
        kind="opaque_coroutine",
        tag=None,
        evaluate=evaluate_coroutine,
    ),
    LaunchAction(kind="unknown", tag=None, evaluate=only_read),
    LaunchAction(kind="stand_in", tag=None, evaluate=evaluate_stand_in),
    # `launch_testing` starts no node.
    LaunchAction(kind="test", tag=None, evaluate=None),
)
