"""CTL001: a controller asks for a joint that the robot does not have.

https://control.ros.org/jazzy/doc/ros2_controllers/doc/controllers_index.html
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.robot.model import Description
from preflight_analysis.rules.controllers import Controller, controllers_of, place_of, robot_of
from preflight_analysis.rules.further_reading import ROS2_CONTROLLERS
from preflight_analysis.rules.nearest import did_you_mean, is_slip, nearest
from preflight_analysis.rules.problems import rename
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for each in context.once(controllers_of):
        robot = robot_of(context, each) if each.spawner is not None else None
        if robot is not None and robot.joints:
            yield from _of_controller(rule, context, each, robot)


def _of_controller(rule: Rule, context: Context, controller: Controller, robot: Description) -> Iterator[Finding]:
    parts = {part.name for system in robot.systems for part in (*system.joints, *system.sensors, *system.gpios)}
    joints = {joint.name for joint in robot.joints}
    reported: set[str] = set()
    # A controller of which the robot has no joint at all is for another variant of it.
    is_of_robot = any(claim.joint in joints | parts for claim in controller.claims)
    for claim in controller.claims:
        if claim.joint in joints | parts | reported or "/" in claim.joint:
            continue
        reported.add(claim.joint)
        place, near = place_of(context, claim.param, claim.joint), nearest(claim.joint, joints)
        spawner = controller.spawner
        yield rule.finding(
            f"joint '{claim.joint}' does not exist: '{controller.name}' ({controller.type}) uses it"
            f"{did_you_mean(near)}",
            place,
            severity=controller.severity
            if is_of_robot or (near is not None and is_slip(claim.joint, near))
            else "info",
            confidence=controller.confidence,
            related=[Related(f"'{controller.name}' is spawned here", spawner.location)] if spawner is not None else (),
            fixes=rename(context, place, claim.joint, near) if near is not None else (),
        )


RULE = Rule(
    id="CTL001",
    name="unknown-joint",
    severity="error",
    what="Checks for a joint in the parameters of a controller that the robot description of the launch does not have. "
    "The controller is one of ros2_controllers, and the launch spawns it. A name that contains a slash is an interface "
    "of another controller and is not checked here. If the robot has none of the joints of the controller and none "
    "of a similar name, it is another variant of the robot, and the finding is information.",
    why="The controller cannot be configured or activated, because no hardware has interfaces of that joint. The robot "
    "does not move.",
    example="base_controller:\n  ros__parameters:\n    left_wheel_names: [left_whel_joint]",
    instead="base_controller:\n  ros__parameters:\n    left_wheel_names: [left_wheel_joint]",
    references=(ROS2_CONTROLLERS,),
    settings=("knowledge",),
    generations=(2,),
    check=_check,
    every_root=True,
)
