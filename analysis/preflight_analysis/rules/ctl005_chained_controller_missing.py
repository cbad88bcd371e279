"""CTL005: a controller claims an interface of another controller that its manager does not have.

https://control.ros.org/jazzy/doc/ros2_control/controller_manager/doc/controller_chaining.html
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.controllers import controllers_of, place_of, robot_of
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.problems import quoted, rename
from preflight_analysis.rules.further_reading import CONTROLLER_MANAGER
from preflight_analysis.rules.rule import Rule

_SAID = "chained controller '{controller}' does not exist: '{name}' claims '{joint}'"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    found = controllers_of(context)
    for each in found:
        others = {other.name for other in found if other.manager == each.manager}
        robot = robot_of(context, each)
        if each.spawner is None or robot is None:
            continue
        systems = robot.systems
        parts = {part.name for system in systems for part in (*system.joints, *system.sensors, *system.gpios)}
        for claim in each.claims:
            controller, slash, _ = claim.joint.partition("/")
            if not slash or not claim.commands or controller in others or claim.joint in parts or controller in parts:
                continue
            near = nearest(controller, others)
            place = place_of(context, claim.param, claim.joint)
            said = say(_SAID, controller=controller, name=each.name, joint=claim.joint)
            yield rule.claim(
                said.followed_by("{near}", near=did_you_mean(near))
                if near is not None
                else said.followed_by("; {node} has {others}", node=each.manager, others=quoted(sorted(others))),
                place,
                subject=Subject("controller", controller),
                kind="absent" if near is None else "near",
                doubts=(*each.doubts, *doubts(PARTLY_READ=near is None and not context.tree.complete)),
                candidates=(near,),
                fixes=rename(context, place, controller, near) if near is not None else (),
            )


RULE = Rule(
    id="CTL005",
    name="chained-controller-missing",
    effect="breaks",
    kind="near",
    always=(Reason.LIBRARY,),
    sometimes=(Reason.FROM_SOURCE, Reason.OTHER_VERSION, Reason.PARTLY_READ),
    what="Checks for a joint of a controller that is named as an interface of another one, with a slash. The "
    "controller manager has no controller of that name.",
    why="The interface is never there, so the controller manager refuses to activate the controller.",
    example="base_controller:\n  ros__parameters:\n    left_wheel_names: [left_pd/left_wheel_joint]",
    instead="base_controller:\n  ros__parameters:\n    left_wheel_names: [left_pid/left_wheel_joint]",
    references=(CONTROLLER_MANAGER,),
    settings=("knowledge",),
    generations=(2,),
    check=_check,
    of_robot=True,
    every_root=True,
)
