"""CTL003: two controllers that are activated claim one command interface.

https://control.ros.org/jazzy/doc/ros2_control/controller_manager/doc/userdoc.html
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.rules.controllers import Claim, Controller, controllers_of
from preflight_analysis.rules.further_reading import CONTROLLER_MANAGER
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    owners: dict[tuple[str, str], Controller] = {}
    # One of the spawners may be left out by a condition that is not known.
    tree = context.tree
    undecided = any(each.decides for each in tree.unknowns) or not (tree.complete or tree.file.endswith(".py"))
    for each in context.once(controllers_of):
        spawner = each.spawner
        if spawner is None or not each.is_active:
            continue
        for claim, name in _commanded(each):
            owner = owners.setdefault((each.manager, name), each)
            if owner.name == each.name or owner.spawner is None:
                continue
            yield rule.finding(
                f"command interface '{name}' is claimed by '{owner.name}' and by '{each.name}': only one of them can "
                "be active",
                spawner.location,
                severity="info" if undecided else each.severity,
                confidence=each.confidence,
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
    severity="warning",
    what="Checks for two controllers that spawners of the launch activate in one controller manager and that claim the "
    "same command interface of a joint. A controller that is spawned with `--inactive` claims nothing, and there is no "
    "finding where the launch also starts an unspawner. If a condition of the launch is not known, it is information.",
    why="The controller manager activates the first controller and refuses the second one. Which one is first depends "
    "on the order in which the spawners reach it.",
    example='<node pkg="controller_manager" exec="spawner" args="position_controller"/>\n'
    '<node pkg="controller_manager" exec="spawner" args="trajectory_controller"/>',
    instead='<node pkg="controller_manager" exec="spawner" args="position_controller"/>\n'
    '<node pkg="controller_manager" exec="spawner" args="trajectory_controller --inactive"/>',
    references=(CONTROLLER_MANAGER,),
    settings=("knowledge",),
    generations=(2,),
    check=_check,
)
