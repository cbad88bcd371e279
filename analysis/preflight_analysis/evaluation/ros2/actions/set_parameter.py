"""`<set_parameter>` and `<set_parameters_from_file>`: `SetParameter` and `SetParametersFromFile`."""

from __future__ import annotations

from preflight_analysis.evaluation.ros2.context import PushedParam
from preflight_analysis.evaluation.ros2.entity import action_tag
from preflight_analysis.evaluation.ros2.params import pushed_value
from preflight_analysis.evaluation.ros2.python_params import python_value
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.schema import Attribute


def evaluate(walk: Walk, performer: Performer, action: Action) -> None:
    """Nodes of the scope have it from now on; a Python file says its value in a `param`."""
    name, value = action.value("name"), action.value("value")
    given = next((child for child in action.children if child.kind == "param"), None)
    if name is not None and given is not None:
        known, plain = python_value(performer, given)
        if known:
            origin = performer.place.origin(action.head_span)
            walk.context.push_param(PushedParam(performer.value(name).text, plain, origin))
    elif name is not None and value is not None:
        found = pushed_value(performer, value)
        if found is not None:
            origin = performer.place.origin(action.head_span)
            walk.context.push_param(PushedParam(performer.value(name).text, found, origin))


def evaluate_file(walk: Walk, performer: Performer, action: Action) -> None:
    """Nodes of the scope read the file from now on."""
    file = action.value("filename")
    if file is not None:
        result = performer.value(file)
        if result.known:
            walk.context.push_param(PushedParam(None, result.text, performer.place.origin(file.span)))


ENTITIES = (
    LaunchAction(
        kind="set_parameter",
        tag=action_tag(
            "Sets a parameter of the nodes that come later in this group.",
            Attribute("name", "The name of the parameter.", "parameter", required=True),
            Attribute("value", "The value, in YAML.", required=True),
            named_by=("name",),
            detail=("value",),
        ),
        evaluate=evaluate,
        offered=90,
    ),
    LaunchAction(
        kind="set_parameters_from_file",
        tag=action_tag(
            "Gives a parameter file to the nodes that come later in this group.",
            Attribute("filename", "The YAML file.", "yaml-file", required=True),
            named_by=("filename",),
        ),
        evaluate=evaluate_file,
        offered=100,
    ),
)
