"""CTL007: a hardware component that is to be activated and that the robot description does not have (ROS 2).

https://control.ros.org/jazzy/doc/ros2_control/controller_manager/doc/userdoc.html#hardware-spawner
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.evaluation.ros2.spawners import asked_of, is_hardware_spawner
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.controllers import managers_of, robot_of_manager
from preflight_analysis.model.nearest import nearest
from preflight_analysis.model.places import attribute_location
from preflight_analysis.model.problems import include_chain, quoted
from preflight_analysis.rules.further_reading import CONTROLLER_MANAGER
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for node in filter(is_hardware_spawner, context.tree.nodes):
        asked, managers = asked_of(node), managers_of(context.tree)
        if asked is None or asked.manager not in managers:
            continue
        robot = robot_of_manager(context, asked.manager, managers[asked.manager])
        components = [system.name for system in robot.systems] if robot is not None else []
        for component in asked.controllers if components else ():
            if component in components:
                continue
            near = nearest(component, components)
            hint = f"did you mean '{near}'?" if near is not None else f"the robot has {quoted(components)}"
            yield rule.claim(
                f"hardware component '{component}' does not exist; {hint}",
                attribute_location(context, node, "args"),
                subject=Subject("component", component),
                kind="absent" if near is None else "near",
                candidates=(near,),
                related=include_chain(node.origin),
            )


RULE = Rule(
    id="CTL007",
    name="unknown-hardware-component",
    effect="breaks",
    kind="near",
    always=(Reason.LIBRARY,),
    what="Checks for a name in the arguments of the `hardware_spawner` of ros2_control that no `<ros2_control>` "
    "element of the robot description has.",
    why="The spawner reports that the component does not exist and exits. The component is not activated.",
    example='<node pkg="controller_manager" exec="hardware_spawner" args="whels --activate"/>',
    instead='<node pkg="controller_manager" exec="hardware_spawner" args="wheels --activate"/>',
    references=(CONTROLLER_MANAGER,),
    generations=(2,),
    check=_check,
    of_robot=True,
    every_root=True,
)
