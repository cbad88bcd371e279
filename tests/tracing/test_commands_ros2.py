"""Commands of ROS 2 launch files, as `xacro`, find the packages that `ament_index_python` finds outside."""

from __future__ import annotations

import threading
from pathlib import Path

import pytest
from preflight_analysis.catalogue.descriptions import folder_of
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.robot.parse import parse_description
from preflight_analysis.tracing.commands import CommandCache, CommandRunner
from preflight_analysis.workspace.workspace import Analysis
from support.python_launch_harness import MANIFEST, PythonHarness
from support.ros2_harness import ros2_prefix

pytestmark = pytest.mark.ros

DESCRIBE = """#!/usr/bin/env python3
import sys
from ament_index_python.packages import get_package_share_directory
package, file = open(sys.argv[1]).read().strip().split("/", 1)
print("<robot>" + open(get_package_share_directory(package) + "/" + file).read() + "</robot>")
"""
"""As `$(find)` of xacro: the file that is named in the file."""
XML = """
<launch>
  <node pkg="bot" exec="state_publisher" name="n">
    <param name="robot_description" value="$(command 'describe $(find-pkg-share bot)/urdf/robot.txt')" type="str"/>
  </node>
</launch>
"""
YAML = """
launch:
- node:
    pkg: bot
    exec: state_publisher
    name: n
    param:
    - {name: robot_description, value: "$(command 'describe $(find-pkg-share bot)/urdf/robot.txt')", type: str}
"""
PYTHON = """
from launch import LaunchDescription
from launch.substitutions import Command, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare

def generate_launch_description():
    model = PathJoinSubstitution([FindPackageShare("bot"), "urdf", "robot.txt"])
    description = ParameterValue(Command(["describe ", model]), value_type=str)
    return LaunchDescription([
        Node(package="bot", executable="state_publisher", name="n", parameters=[{"robot_description": description}])])
"""
OPAQUE = """
from launch import LaunchDescription
from launch.actions import OpaqueFunction
from launch.substitutions import Command
from launch_ros.actions import Node
from ament_index_python.packages import get_package_share_directory

def made(context):
    description = Command(["describe ", get_package_share_directory("bot"), "/urdf/robot.txt"]).perform(context)
    given = {"robot_description": description}
    return [Node(package="bot", executable="state_publisher", name="n", parameters=[given])]

def generate_launch_description():
    return LaunchDescription([OpaqueFunction(function=made)])
"""
FORMS = {"a.launch.xml": XML, "a.launch.yaml": YAML, "a.launch.py": PYTHON, "b.launch.py": OPAQUE}


@pytest.fixture
def variables(tmp_path: Path) -> dict[str, str]:
    """A PATH with `describe` and the interpreter of an rclpy."""
    program = tmp_path / "tools" / "describe"
    program.parent.mkdir()
    program.write_text(DESCRIBE)
    program.chmod(0o755)
    return {"PATH": f"{program.parent}:{ros2_prefix() / 'bin'}:/usr/bin:/bin"}


def described(analysis: Analysis) -> object:
    (node,) = analysis.tree.nodes
    return {param.name: param.value for param in node.params}


@pytest.mark.parametrize("name", FORMS)
def test_a_package_that_was_never_built_is_found(tmp_path: Path, variables: dict[str, str], name: str) -> None:
    harness = PythonHarness(tmp_path, "bot")
    harness.write("urdf/robot.txt", "bot/urdf/wheel.txt")
    harness.write("urdf/wheel.txt", "wheel")
    analysis = harness.launch(harness.write(f"launch/{name}", FORMS[name]), variables=variables)
    assert described(analysis) == {"robot_description": "<robot>wheel</robot>\n"}


@pytest.mark.parametrize("name", FORMS)
def test_a_package_of_the_prefixes_is_found(tmp_path: Path, variables: dict[str, str], name: str) -> None:
    harness = PythonHarness(tmp_path, "bot")
    prefix = tmp_path / "underlay"
    index, share = prefix / "share/ament_index/resource_index/packages", prefix / "share/arm"
    index.mkdir(parents=True)
    share.mkdir()
    (index / "arm").touch()
    (share / "package.xml").write_text(MANIFEST.format("arm"))
    (share / "arm.txt").write_text("arm")
    harness.write("urdf/robot.txt", "arm/arm.txt")
    path = harness.write(f"launch/{name}", FORMS[name])
    analysis = harness.launch(path, variables={**variables, "AMENT_PREFIX_PATH": str(prefix)})
    assert described(analysis) == {"robot_description": "<robot>arm</robot>\n"}


def test_of_packages_of_one_name_xacro_finds_that_of_its_own_workspace(tmp_path: Path) -> None:
    include = '<robot xmlns:xacro="http://x"><xacro:include filename="$(find arm)/urdf/part.xacro"/></robot>'
    for name in ("one", "two"):
        package = tmp_path / name / "src" / "arm"
        (package / "urdf").mkdir(parents=True)
        (package / "package.xml").write_text(MANIFEST.format("arm"))
        (package / "urdf" / "robot.xacro").write_text(include)
        (package / "urdf" / "part.xacro").write_text(f'<robot><link name="{name}"/></robot>')
    environment = detect_environment(str(tmp_path), {"ROS_VERSION": "2"}, (str(tmp_path),), root=str(tmp_path))
    runner = CommandRunner(environment, str(tmp_path), None)
    for name in ("one", "two"):
        found = runner.run(f"xacro {tmp_path}/{name}/src/arm/urdf/robot.xacro", threading.Event())
        assert f'<link name="{name}"/>' in found.output


def test_without_a_package_that_it_includes_a_description_is_known_in_part(tmp_path: Path) -> None:
    package = tmp_path / "src" / "arm"
    (package / "urdf").mkdir(parents=True)
    (package / "package.xml").write_text(MANIFEST.format("arm"))
    include = '<xacro:include filename="$(find camera_parts)/urdf/camera.xacro"/><link name="base"/>'
    (package / "urdf" / "robot.xacro").write_text(f'<robot xmlns:xacro="http://x">{include}</robot>')
    environment = detect_environment(str(tmp_path), {"ROS_VERSION": "2"}, (str(tmp_path),), root=str(tmp_path))
    runner = CommandRunner(environment, str(tmp_path), CommandCache(tmp_path / "cache"))
    line = f"xacro {package}/urdf/robot.xacro"
    found = runner.run(line, threading.Event())
    assert (found.status, found.reason) == ("not-run", "package 'camera_parts' is not installed here")
    assert '<link name="base"/>' in found.output
    assert runner.lookup(line) == found


def test_the_catalogue_has_the_structure_of_a_common_package(tmp_path: Path) -> None:
    package = tmp_path / "src" / "arm"
    (package / "urdf").mkdir(parents=True)
    (package / "package.xml").write_text(MANIFEST.format("arm"))
    include = '<xacro:include filename="$(find velodyne_description)/urdf/VLP-16.urdf.xacro"/><link name="base"/>'
    call = '<xacro:VLP-16 parent="base" name="lidar"><origin xyz="0 0 0"/></xacro:VLP-16>'
    (package / "urdf" / "robot.xacro").write_text(f'<robot xmlns:xacro="http://x">{include}{call}</robot>')
    environment = detect_environment(str(tmp_path), {"ROS_VERSION": "2"}, (str(tmp_path),), root=str(tmp_path))
    runner = CommandRunner(environment, str(tmp_path), None)
    found = runner.run(f"xacro {package}/urdf/robot.xacro", threading.Event())
    assert found.reason == (
        "package 'velodyne_description' is not installed here; the catalogue has velodyne_description of jazzy"
    )
    assert parse_description(found.output).links == ("base", "lidar_base_link", "lidar")


@pytest.mark.parametrize(("name", "known"), [("ur", True), ("newer", False)])
def test_a_description_of_a_package_that_is_not_here(tmp_path: Path, name: str, known: bool) -> None:
    environment = detect_environment(str(tmp_path), {"ROS_VERSION": "2"}, (str(tmp_path),), root=str(tmp_path))
    runner = CommandRunner(environment, str(tmp_path), None)
    path = f"{folder_of('ur_description', 'jazzy')}/urdf/{name}.urdf.xacro"
    found = runner.run(f"xacro {path} name:=ur ur_type:=ur5e tf_prefix:=one_", threading.Event())
    description = parse_description(found.output)
    assert (found.status, description.is_whole, "one_tool0" in description.links) == ("not-run", known, known)
    assert description.lacks == (() if known else ("ur_description",))
