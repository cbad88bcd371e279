"""Launch files that the editors are shown besides the demo's, in the workspace of a harness."""

from __future__ import annotations

from pathlib import Path

from support.editor_harness import Harness

ROBOT = """<launch>
  <arg name="sim" default="false"/>
  <arg name="rate" default="5"/>
  <param name="robot_name" value="r2"/>
  <group ns="base">
    <node pkg="preflight_demo" type="talker.py" name="odometry">
      <param name="rate" value="$(arg rate)"/>
    </node>
  </group>
  <include file="$(dirname)/arm.launch" ns="left">
    <arg name="rate" value="$(arg rate)"/>
  </include>
  <include file="$(dirname)/arm.launch" ns="right">
    <arg name="rate" value="20"/>
  </include>
  <group if="$(arg sim)">
    <node pkg="preflight_demo" type="talker.py" name="simulator"/>
  </group>
  <include file="$(dirname)/gripper.launch" if="$(eval rate > 10)"/>
</launch>
"""
ARM = """<launch>
  <arg name="rate" default="1"/>
  <node pkg="preflight_demo" type="talker.py" name="driver">
    <param name="rate" value="$(arg rate)"/>
  </node>
  <node pkg="preflight_demo" type="listener.py" name="monitor">
    <remap from="chatter" to="chater"/>
  </node>
</launch>
"""
GRIPPER = """<launch>
  <node pkg="preflight_demo" type="talker.py" name="gripper"/>
</launch>
"""

MANIFEST = """<package format="3"><name>chapter</name><version>0.0.0</version><description>d</description>
<maintainer email="a@b.c">m</maintainer><license>MIT</license>
<exec_depend>rclpy</exec_depend><export><build_type>ament_python</build_type></export></package>
"""
ROS2_XML = """<launch>
  <arg name="speed" default="0.5"/>
  <let name="twice" value="$(var sped)"/>
</launch>
"""
ROS2_YAML = """launch:
  - arg:
      name: speed
      default: "0.5"
  - let:
      name: twice
      value: $(var sped)
"""
ROS2_PYTHON = """from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, LogInfo
from launch.substitutions import LaunchConfiguration


def generate_launch_description():
    return LaunchDescription(
        [
            DeclareLaunchArgument("speed", default_value="0.5"),
            LogInfo(msg=LaunchConfiguration("sped")),
        ]
    )
"""


def create_robot(harness: Harness) -> Path:
    """A robot with two arms, a launch file each; returns the folder."""
    folder = harness.launch_file.parent
    for name, text in (("robot", ROBOT), ("arm", ARM), ("gripper", GRIPPER)):
        (folder / f"{name}.launch").write_text(text)
    return folder


def create_formats(harness: Harness) -> Path:
    """A package of ROS 2 with a launch file of each format; returns the folder."""
    folder = harness.workspace / "chapter"
    folder.mkdir()
    (folder / "package.xml").write_text(MANIFEST)
    for name, text in (("first.launch.xml", ROS2_XML), ("second.launch.yaml", ROS2_YAML)):
        (folder / name).write_text(text)
    (folder / "third.launch.py").write_text(ROS2_PYTHON)
    return folder


DESCRIPTION = """<robot name="arm">
  <link name="base_link"/>
  <link name="tool"/>
  <joint name="tool_joint" type="fixed"><parent link="base_link"/><child link="tool"/></joint>
</robot>
"""


def create_description(harness: Harness) -> Path:
    """The robot description of a launch file of the demo's package."""
    reading = '<launch><param name="robot_description" textfile="$(find preflight_demo)/urdf/arm.urdf"/></launch>'
    harness.write("arm.launch", reading)
    path = harness.launch_file.parents[1] / "urdf/arm.urdf"
    path.parent.mkdir()
    path.write_text(DESCRIPTION)
    return path
