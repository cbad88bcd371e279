"""CTL003: two controllers that are activated claim one command interface, or one has a joint twice.

https://control.ros.org/jazzy/doc/ros2_control/controller_manager/doc/userdoc.html
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import compress

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.meanings import items_of
from preflight_analysis.evaluation.tree import Param
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.model.context import Context
from preflight_analysis.model.controllers import Claim, Controller, controllers_of, place_of
from preflight_analysis.model.parameters import by_namespace, groups_of_params
from preflight_analysis.rules.further_reading import CONTROLLER_MANAGER
from preflight_analysis.rules.rule import Rule

_SIDES = (("left_wheel", "right_wheel"), ("left_wheel_names", "right_wheel_names"))
"""Parameters of drive controllers that list joints, in ROS 1 and in ROS 2."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    if context.tree.ros.ament:
        yield from _of_several(rule, context)
        for each in controllers_of(context):
            yield from _of_both_sides(rule, context, each.name, {param.name: param for param in each.params})
        return
    groups = by_namespace(context)
    sides = context.each(_sides, groups_of_params(context))
    for controller, own in zip(compress(groups, sides), filter(None, sides), strict=True):
        yield from _of_both_sides(rule, context, controller, own)


def _sides(params: tuple[Param, ...]) -> Mapping[str, Param]:
    """Of the parameters of a controller of ROS 1 those that list the joints of a side."""
    return {leaf: param for param in params if (leaf := names.leaf(param.name)) in _SIDES[0]}


def _of_both_sides(rule: Rule, context: Context, controller: str, params: Mapping[str, Param]) -> Iterator[Finding]:
    """Joints of a drive controller that are on the left and on the right."""
    for left, right in _SIDES:
        if left not in params or right not in params:
            continue
        others = items_of(params[right].value)
        for joint in items_of(params[left].value):
            if joint in others:
                yield rule.claim(
                    f"joint '{joint}' is in '{left}' and in '{right}' of controller '{controller}'",
                    place_of(context, params[left], joint),
                    subject=Subject("joint", joint),
                    related=[Related(f"'{right}'", params[right].place)],
                )


def _of_several(rule: Rule, context: Context) -> Iterator[Finding]:
    owners: dict[tuple[str, str], Controller] = {}
    # One of the spawners may be left out by a condition that is not known.
    tree = context.tree
    undecided = any(each.decides for each in tree.unknowns) or not (tree.complete or tree.file.endswith(".py"))
    for each in controllers_of(context):
        spawner = each.spawner
        if spawner is None or not each.is_active:
            continue
        for claim, name in _commanded(each):
            owner = owners.setdefault((each.manager, name), each)
            if owner.name == each.name or owner.spawner is None:
                continue
            yield rule.claim(
                f"command interface '{name}' is claimed by '{owner.name}' and by '{each.name}': only one of them can "
                "be active",
                spawner.location,
                subject=Subject("interface", name),
                doubts=(*each.doubts, *doubts(PARTLY_READ=undecided)),
                related=(
                    Related(f"'{each.name}' has the joint here", claim.param.place),
                    Related(f"'{owner.name}' is spawned here", owner.spawner.location),
                ),
            )
            break


def _commanded(controller: Controller) -> Iterator[tuple[Claim, str]]:
    for claim in controller.claims:
        for interface in claim.interfaces if claim.commands else ():
            yield claim, f"{claim.joint}/{interface}"


RULE = Rule(
    id="CTL003",
    name="interface-claimed-twice",
    effect="breaks",
    kind="conflict",
    always=(Reason.LIBRARY,),
    sometimes=(Reason.FROM_SOURCE, Reason.OTHER_VERSION, Reason.PARTLY_READ),
    what="Checks for two controllers that spawners activate in one controller manager and that claim the same command "
    "interface. It also checks for a joint that a drive controller has on the left and on the right.",
    why="The controller manager activates the first controller and refuses the second one. Which one is first depends "
    "on the order in which the spawners reach it.",
    example='<node pkg="controller_manager" exec="spawner" args="position_controller"/>\n'
    '<node pkg="controller_manager" exec="spawner" args="trajectory_controller"/>',
    instead='<node pkg="controller_manager" exec="spawner" args="position_controller"/>\n'
    '<node pkg="controller_manager" exec="spawner" args="trajectory_controller --inactive"/>',
    references=(CONTROLLER_MANAGER,),
    settings=("knowledge",),
    generations=(1, 2),
    check=_check,
)
