"""What a Python launch file makes in one branch of a condition that is not known
(`evaluation/ros2/python_branches.py`)."""

from __future__ import annotations

from dataclasses import replace

from preflight_analysis.evaluation.ros2.place import Place
from preflight_analysis.evaluation.ros2.python_branches import BRANCH
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk
from preflight_analysis.launch.model import Action


def evaluate(walk: Walk, performer: Performer, action: Action) -> None:
    """It is done as if it were certain; that it depends on the condition is noted with its places."""
    place = performer.place
    if walk.too_deep(place, action):
        return
    taken = action.value("taken")
    if taken is None:
        walk.inside(_in_branch(place, action), action.children)
        return
    # What is made by a function that makes others as well stands at one place with these.
    spans = dict.fromkeys(below.span for below in action.walk() if action.attribute("shared") is None)
    walk.state.note_branch(taken.text, place.location(action.head_span), tuple(map(place.location, spans)))
    walk.inside(place, action.children)
    if walk.may_configure(action):
        walk.context.cannot_follow(place.location(action.head_span))


def _in_branch(place: Place, action: Action) -> Place:
    """Where code of the file's own is called that only this branch makes: in a reading that takes it, if one does."""
    asked = action.value("asked")
    if place.run is None or asked is None:
        return replace(place, run=None)
    return replace(place, run=replace(place.run, otherwise=(*place.run.otherwise, asked.text), read_partly=True))


ENTITIES = (LaunchAction(kind=BRANCH, tag=None, evaluate=evaluate, holds_actions=True),)
