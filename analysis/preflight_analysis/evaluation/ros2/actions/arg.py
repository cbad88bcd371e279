"""`<arg>`: `DeclareLaunchArgument`."""

from __future__ import annotations

from dataclasses import replace

from preflight_analysis.evaluation.problems import ArgumentNeeded, ArgumentNotAChoice
from preflight_analysis.evaluation.resolved import Resolved
from preflight_analysis.evaluation.ros2.entity import CONFIGURATION_NAME, Part, action_tag, part_tag
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk
from preflight_analysis.evaluation.tree import Arg, Use
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.python_actions import OF_CODE
from preflight_analysis.launch.schema import Attribute


def evaluate(walk: Walk, performer: Performer, action: Action) -> None:
    """A value that is given counts, the default otherwise."""
    name_value = action.value("name")
    if name_value is None:
        return
    name, place, state, context = name_value.text, performer.place, walk.state, walk.context
    default = action.value("default")
    given = context.get(name)
    origin = place.origin(action.head_span)
    location = place.location(name_value.span)
    if given is None:
        if default is not None:
            context.set(name, performer.value(default), place.origin(default.span))
        else:
            if not place.chain:
                state.problem(ArgumentNeeded(name), origin)
            context.set(name, Resolved(f"$(var {name})", False), origin)
    found = context.get(name)
    value = found.value if found is not None and found.value.known else None
    _check_choices(walk, performer, action, name, value)
    shown = value.text if value is not None else None
    description = action.value("description")
    doc = description.text if description is not None else None
    value_origin = found.origin if found is not None else None
    text = default.text if default is not None else None
    state.args.setdefault(name, Arg(name, shown, text, default is None, origin, location, value_origin, doc))
    state.uses.append(Use("declaration", location, name, shown, None, value_origin or ()))
    context.declare(name, location)


def _check_choices(walk: Walk, performer: Performer, action: Action, name: str, value: Resolved | None) -> None:
    written = [v for c in action.children if c.kind == "choice" and (v := c.value("value")) is not None]
    if any(part.command in OF_CODE for each in written for part in each.substitutions):
        return
    choices = [each.text for each in written]
    if not choices or value is None or value.text in choices:
        return
    found = walk.context.get(name)
    declared = performer.place.origin(action.head_span)
    origin = found.origin if found is not None and found.origin else declared
    walk.state.problem(ArgumentNotAChoice(name, value.text, tuple(choices), declared[-1]), origin)


ENTITIES = (
    LaunchAction(
        kind="arg",
        tag=action_tag(
            "Declares an argument of this file; inside of an `<include>`: passes one on.",
            replace(CONFIGURATION_NAME, doc="The name of the argument, for `$(var name)`.", taken="verbatim"),
            Attribute("default", "The value where none is given. Without it one has to be."),
            Attribute("value", "In an `<include>`: the value to pass."),
            Attribute("description", "What it is for, shown by `ros2 launch --show-args`.", "prose", taken="verbatim"),
            children=("choice",),
            named_by=("name",),
            detail=("value", "default"),
        ),
        evaluate=evaluate,
        offered=30,
        configures=True,
    ),
    Part(
        kind="choice",
        tag=part_tag(
            "A value that the argument may have.",
            Attribute("value", "The value.", required=True, taken="verbatim"),
            named_by=("value",),
        ),
        of=("arg",),
    ),
)
