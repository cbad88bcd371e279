"""Controllers of ros_control in Gazebo."""

from __future__ import annotations

from pathlib import Path

import pytest
from support import package_elsewhere

ROBOT = (
    "<robot name='r'><gazebo><plugin name='c' filename='libgazebo_ros_control.so'>"
    "<robotNamespace>{}</robotNamespace></plugin></gazebo></robot>"
)
LAUNCH = """<launch>
  <node pkg="gazebo_ros" type="gzserver" name="gazebo"/>
  <param name="robot_description" value="{robot}"/>
  <rosparam>
    arm:
      states: {{type: joint_state_controller/JointStateController}}
      joints: {{type: position_controllers/JointTrajectoryController}}
      wheels: {{type: diff_drive_controller/DiffDriveController}}
      own: {{type: somebody/Controller}}
  </rosparam>
  <node pkg="controller_manager" type="{type}" name="spawner" args="{args}"/>
</launch>"""
ARM = {"/arm/joint_states", "/arm/joints/command", "/arm/joints/state", "/arm/joints/follow_joint_trajectory"}


def names_of(folder: Path, args: str, robot: str = ROBOT.format("/arm"), type_: str = "spawner") -> set[str]:
    """What Gazebo has below `/arm`."""
    text = LAUNCH.format(robot=robot.replace("<", "&lt;"), args=args, type=type_)
    graph = package_elsewhere.analysed(folder, text, distro="noetic").graph
    assert graph is not None
    ends = [end for end in graph.interfaces[0].endpoints if end.name.startswith("/arm")]
    assert all(end.evidence.assumed for end in ends)
    return {end.name for end in ends}


@pytest.mark.parametrize(
    ("type_", "args"),
    [
        ("spawner", "--namespace=/arm states joints own"),
        ("spawner", "states --namespace arm joints --shutdown-timeout=0.1"),
        ("spawner", "arm/states arm/joints"),
        ("controller_manager", "spawn arm/states arm/joints"),
    ],
)
def test_those_that_a_spawner_loads(tmp_path: Path, type_: str, args: str) -> None:
    space = "/" if "arm/" in args else "/arm"
    found = names_of(tmp_path, args, ROBOT.format(space), type_)
    assert {name for name in found if "controller_manager" not in name} - {"/arm/joints/query_state"} == ARM
    assert ("/arm/controller_manager/load_controller" in found) is (space == "/arm")


@pytest.mark.parametrize(
    ("args", "robot"),
    [
        ("--namespace=/arm states joints", ROBOT.format("/other")),
        ("--namespace=/arm states joints", "<robot name='r'/>"),
        ("states joints", ROBOT.format("/arm")),
        ("$(env NOT_SET)", ROBOT.format("/arm")),
    ],
)
def test_those_that_nothing_loads(tmp_path: Path, args: str, robot: str) -> None:
    assert not names_of(tmp_path, args, robot)
