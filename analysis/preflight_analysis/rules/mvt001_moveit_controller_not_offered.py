"""MVT001: MoveIt sends trajectories to a controller that the launch loads under another name.

https://github.com/moveit/moveit/issues/2433
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.evaluation import names
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.model.context import Context
from preflight_analysis.model.moveit import Known, Loaded, unserved
from preflight_analysis.model.problems import rename
from preflight_analysis.model.yaml_places import place_in_yaml
from preflight_analysis.rules.further_reading import MOVEIT_CONTROLLERS
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for each in unserved(context):
        if each.meant is None:
            yield from _other_action(rule, context, each.known)
            continue
        known, other = each.known, each.meant
        place = place_in_yaml(context, known.controller.param, known.controller.name)
        old, new = known.controller.name, _as_moveit_names(known, other)
        yield rule.claim(
            f"MoveIt controller '{old}' has no action server '{known.action}'; did you mean '{new}', which "
            f"{each.reason}?",
            place,
            subject=Subject("controller", old),
            candidates=(new,),
            related=(
                Related(f"'{names.leaf(other.name)}' is loaded here", other.spawner.location),
                Related(f"{known.node.name} starts here", known.node.location),
            ),
            fixes=rename(context, place, old, new) if not context.tree.ros.ament else (),
        )


def _as_moveit_names(known: Known, other: Loaded) -> str:
    """The name of a controller as the list of MoveIt has it."""
    space = names.parent(known.node.name)
    return other.name.removeprefix(space) if other.name.startswith(space) else other.name


def _other_action(rule: Rule, context: Context, known: Known) -> Iterator[Finding]:
    name, loaded = known.controller.name, known.loaded
    if loaded is None or loaded.action is None:
        return
    yield rule.claim(
        f"MoveIt controller '{name}' asks for action '{known.controller.action_ns}'; '{name}' ({loaded.type}) serves "
        f"'{names.leaf(loaded.action)}'",
        place_in_yaml(context, known.controller.param, name),
        subject=Subject("controller", name),
        kind="conflict",
        related=(Related(f"'{name}' is loaded here", loaded.spawner.location),),
    )


RULE = Rule(
    id="MVT001",
    name="moveit-controller-not-offered",
    effect="breaks",
    kind="near",
    always=(Reason.LIBRARY,),
    what="Checks for a controller of MoveIt whose action no node of the launch serves. The launch loads the "
    "controller that was meant, or one that serves another action.",
    why="MoveIt waits for the action server, gives up and does not execute any trajectory: `Action client not "
    "connected`.",
    example="moveit_simple_controller_manager:\n  controller_names: [arm_controler]",
    instead="moveit_simple_controller_manager:\n  controller_names: [arm_controller]",
    references=(MOVEIT_CONTROLLERS,),
    settings=("knowledge",),
    check=_check,
    needs_graph=True,
    every_root=True,
)
