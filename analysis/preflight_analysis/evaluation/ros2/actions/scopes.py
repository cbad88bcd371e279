"""The scopes that Python launch files can begin and end by themselves: `PushEnvironment` and the like."""

from __future__ import annotations

from collections.abc import Callable

from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk
from preflight_analysis.launch.model import Action


def push_configurations(walk: Walk, performer: Performer, action: Action) -> None:
    """Begin a scope of configurations."""
    walk.context.push_configurations()


def pop_configurations(walk: Walk, performer: Performer, action: Action) -> None:
    """End it."""
    _pop(walk, performer, action, walk.context.pop_configurations, "launch_configurations")


def push_environment(walk: Walk, performer: Performer, action: Action) -> None:
    """Begin a scope of variables."""
    walk.context.push_environment()


def pop_environment(walk: Walk, performer: Performer, action: Action) -> None:
    """End it."""
    _pop(walk, performer, action, walk.context.pop_environment, "environment")


def _pop(walk: Walk, performer: Performer, action: Action, end: Callable[[], None], name: str) -> None:
    """End a scope; launch stops where none was begun."""
    try:
        end()
    except IndexError:
        walk.raised(performer, action, "RuntimeError", f"{name} stack unexpectedly empty")


ENTITIES = (
    LaunchAction(
        kind="push_configurations",
        tag=None,
        evaluate=push_configurations,
    ),
    LaunchAction(
        kind="pop_configurations",
        tag=None,
        evaluate=pop_configurations,
    ),
    LaunchAction(
        kind="push_env",
        tag=None,
        evaluate=push_environment,
    ),
    LaunchAction(
        kind="pop_env",
        tag=None,
        evaluate=pop_environment,
    ),
)
