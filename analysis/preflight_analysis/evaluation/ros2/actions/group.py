"""`<group>`: `GroupAction`."""

from __future__ import annotations

from preflight_analysis.evaluation.ros2.actions.reset import evaluate as reset
from preflight_analysis.evaluation.ros2.actions.reset import kept
from preflight_analysis.evaluation.ros2.entity import action_tag, flag
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk, is_set
from preflight_analysis.launch.model import Action


def evaluate(walk: Walk, performer: Performer, action: Action) -> None:
    """A group is scoped and forwarding unless it says otherwise."""
    scoped, forwarding = is_set(action, "scoped", default=True), is_set(action, "forwarding", default=True)
    context = walk.context
    if walk.too_deep(performer.place, action):
        return
    if scoped:
        context.push_configurations()
        context.push_environment()
    if scoped and not forwarding:
        context.reset_environment()
        reset(walk, performer, action)
    else:
        # One after the other: the value of one may name those before it.
        for name, result, origin in kept(performer, action):
            context.set(name, result, origin)
    walk.inside(performer.place, action.children)
    if scoped:
        context.pop_environment()
        context.pop_configurations()


ENTITIES = (
    LaunchAction(
        kind="group",
        tag=action_tag(
            "Actions whose launch configurations, namespace, remaps and environment end with the group.",
            flag("scoped", "Whether what is set inside ends with the group.", "true"),
            flag("forwarding", "Whether what was set before is known inside.", "true"),
            children=("keep",),
            starts=True,
        ),
        evaluate=evaluate,
        offered=50,
        holds_actions=True,
        configures=True,
    ),
)
