"""`<set_env>`, `<unset_env>`, `<append_env>` and `<reset_env>`: `SetEnvironmentVariable` and the like."""

from __future__ import annotations

import os

from preflight_analysis.evaluation.ros2.entity import VARIABLE, action_tag, flag
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk, is_set
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.schema import Attribute


def set_env(walk: Walk, performer: Performer, action: Action) -> None:
    """Set it until the scope ends."""
    name, value = action.value("name"), action.value("value")
    if name is not None and value is not None:
        result = performer.value(value)
        if result.known:
            walk.context.set_variable(performer.value(name).text, result.text)


def unset_env(walk: Walk, performer: Performer, action: Action) -> None:
    """Remove it until the scope ends."""
    name = action.value("name")
    if name is not None:
        walk.context.unset_variable(performer.value(name).text)


def append_env(walk: Walk, performer: Performer, action: Action) -> None:
    """Add to it; one that is not there is set."""
    name, value = action.value("name"), action.value("value")
    if name is None or value is None:
        return
    key, result = performer.value(name).text, performer.value(value)
    separator = action.value("separator")
    between = performer.value(separator).text if separator is not None else os.pathsep
    old = walk.context.variable(key)
    parts = (result.text,) if old is None else (old, result.text)
    if is_set(action, "prepend", default=False):
        parts = parts[::-1]
    walk.context.set_variable(key, between.join(parts))


def reset_env(walk: Walk, performer: Performer, action: Action) -> None:
    """The variables are the first ones again."""
    walk.context.reset_environment()


ENTITIES = (
    LaunchAction(
        kind="set_env",
        tag=action_tag(
            "Sets an environment variable for what comes later in this group.",
            VARIABLE,
            Attribute("value", "Its value.", required=True),
            named_by=("name",),
            detail=("value",),
        ),
        evaluate=set_env,
        offered=200,
    ),
    LaunchAction(
        kind="unset_env",
        tag=action_tag(
            "Removes an environment variable for what comes later in this group.", VARIABLE, named_by=("name",)
        ),
        evaluate=unset_env,
        offered=210,
    ),
    LaunchAction(
        kind="append_env",
        tag=action_tag(
            "Adds to an environment variable for what comes later in this group.",
            VARIABLE,
            Attribute("value", "What to add.", required=True),
            flag("prepend", "Whether to add it in front.", taken="performed"),
            Attribute("separator", "What to put between.", default=":"),
            named_by=("name",),
            detail=("value",),
        ),
        evaluate=append_env,
        offered=220,
    ),
    LaunchAction(
        kind="reset_env",
        tag=action_tag("Takes back all changes of the environment."),
        evaluate=reset_env,
        offered=225,
    ),
)
