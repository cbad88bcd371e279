"""MVT004: a parameter of MoveIt that stands outside of the group in which MoveIt asks for it.

kinematics_plugin_loader.cpp and robot_model_loader.cpp of moveit/moveit2 8fcb5d23: kinematics solvers are below
`robot_description_kinematics`, limits below `robot_description_planning`.
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.evaluation.moveit import is_move_group, params_around
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.yaml_places import place_in_yaml
from preflight_analysis.rules.further_reading import MOVEIT_KINEMATICS
from preflight_analysis.rules.rule import Rule

_ASKED: tuple[tuple[tuple[str | None, ...], str], ...] = (
    ((None, "kinematics_solver"), "robot_description_kinematics"),
    (("joint_limits", None, None), "robot_description_planning"),
    (("cartesian_limits", None), "robot_description_planning"),
)
"""Parts of the name of a parameter, None for any, and the group that MoveIt asks for it in."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for node in filter(is_move_group, context.tree.nodes):
        params = {
            tuple(name.replace("/", ".").split(".")): each for name, each in params_around(context.tree, node).items()
        }
        for wanted, group in _ASKED:
            given = (parts for parts in params if _is(wanted, parts) and (group, *parts) not in params)
            parts = next(given, None)
            if parts is None:
                continue
            separator = "." if context.tree.ros.own_parameters else "/"
            name, asked = separator.join(parts), separator.join((group, *parts))
            yield rule.claim(
                f"parameter '{name}' has no effect: MoveIt reads '{asked}'",
                place_in_yaml(context, params[parts]),
                subject=Subject("parameter", name),
                candidates=(asked,),
            )


def _is(wanted: tuple[str | None, ...], parts: tuple[str, ...]) -> bool:
    return len(parts) == len(wanted) and all(each in (None, part) for each, part in zip(wanted, parts, strict=True))


RULE = Rule(
    id="MVT004",
    name="moveit-parameter-elsewhere",
    effect="misbehaves",
    kind="near",
    always=(Reason.LIBRARY,),
    what="Checks for a kinematics solver and for joint or Cartesian limits that are given to `move_group` outside of "
    "`robot_description_kinematics` and `robot_description_planning`.",
    why="MoveIt asks for them in these groups only: `No kinematics plugins defined. Fill and load kinematics.yaml!`. "
    "Goals for a pose cannot be planned, and the limits of the URDF count.",
    example="parameters=[robot_description, kinematics_yaml]",
    instead="parameters=[robot_description, {'robot_description_kinematics': kinematics_yaml}]",
    references=(MOVEIT_KINEMATICS,),
    check=_check,
    of_robot=True,
)
