"""`<for>` and `<for_each>` of a launch newer than 3.7. The `ForLoop` and `ForEach` of Python files call a function."""

from __future__ import annotations

from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS
from preflight_analysis.evaluation.ros2.entity import action_tag
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.types import loaded
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.problems import BadValue
from preflight_analysis.launch.schema import Attribute

MAX_ROUNDS = 1_000


def evaluate(walk: Walk, performer: Performer, action: Action) -> None:
    """What is inside, once for each round."""
    context = walk.context
    for variables in _rounds(performer, action):
        if walk.too_deep(performer.place, action):
            return
        before, context.round = context.round, {**context.round, **variables}
        walk.inside(performer.place, action.children)
        context.round = before


def _rounds(performer: Performer, action: Action) -> list[dict[str, str]]:
    """What `$(index)` and `$(for-var)` stand for in each round, none where that is not known or wrong, which is
    noted."""
    value = action.value("len" if action.kind == "for" else "values")
    if value is None:
        return []
    result = performer.value(value)
    if not result.known:
        performer.context.cannot_follow(performer.place.origin(value.span)[-1])
        return []
    found = _indices(action, result.text) if action.kind == "for" else _sets(result.text)
    if found is None:
        attribute = "len" if action.kind == "for" else "values"
        expected = "an integer" if action.kind == "for" else "YAML maps with semicolons between"
        bad = BadValue(action.kind, attribute, result.text, expected)
        performer.state.problem(bad, performer.place.origin(value.span))
        return []
    return found[:MAX_ROUNDS]


def _indices(action: Action, text: str) -> list[dict[str, str]] | None:
    name = action.value("name")
    try:
        count = min(int(text), MAX_ROUNDS)
    except ValueError:
        return None
    return [{name.text if name is not None else "": str(index)} for index in range(count)]


def _sets(text: str) -> list[dict[str, str]] | None:
    found: list[dict[str, str]] = []
    for each in filter(None, text.strip().split(";")):
        try:
            values = loaded(each.strip())
        except CONSTRUCTION_ERRORS:
            return None
        if isinstance(values, dict):
            found.append({str(name): str(value) for name, value in values.items()})
        elif values is not None:
            return None
    return found


ENTITIES = (
    LaunchAction(
        kind="for",
        tag=action_tag(
            "Executes what is inside a number of times; `$(index NAME)` is the round. Of a launch newer than 3.7.",
            Attribute("len", "How many times.", "integer", required=True),
            Attribute("name", "What the round is called.", required=True),
            named_by=("name",),
        ),
        evaluate=evaluate,
        offered=180,
        holds_actions=True,
        configures=True,
    ),
    LaunchAction(
        kind="for_each",
        tag=action_tag(
            "Executes what is inside once for each set of values, which `$(for-var NAME)` reads. Of a launch newer "
            "than 3.7.",
            Attribute("values", "Maps in YAML with semicolons between: `{name: a};{name: b}`.", required=True),
            named_by=("values",),
        ),
        evaluate=evaluate,
        offered=190,
        holds_actions=True,
        configures=True,
    ),
)
