"""What a launch file sees of packages with one name: its generation's, and of those the one that is meant."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.tracing.commands import CommandRunner
from preflight_analysis.workspace.commands import CommandResults
from preflight_analysis.workspace.indexing import build_index
from preflight_analysis.workspace.not_run import not_run
from preflight_analysis.workspace.resolve_commands import Resolving, resolve_commands
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.package_folders import file, script

MANIFEST = "<package><name>{}</name><export><build_type>{}</build_type></export></package>"
LAUNCH = """<launch>
  <include file="$(find-pkg-share common)/launch/part.launch.xml"/>
  <node pkg="robot" exec="driver.py"/>
</launch>
"""
NODE = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>

int main(int argc, char** argv) {{
  rclcpp::init(argc, argv);
  auto node = rclcpp::Node::make_shared("n");
  auto publisher = node->create_publisher<std_msgs::msg::String>("{}", 1);
  rclcpp::spin(node);
}}
"""


def made(folder: Path, build_type: str = "ament_cmake") -> Path:
    """A package with that name and a program."""
    file(folder / "package.xml", text=MANIFEST.format(folder.name, build_type))
    file(folder / "CMakeLists.txt", text="install(PROGRAMS driver.py DESTINATION lib/${PROJECT_NAME})\n")
    script(folder / "driver.py")
    return folder


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    """Two workspaces with packages of the same names."""
    (tmp_path / ".git").mkdir()
    for name in ("one", "two"):
        robot = made(tmp_path / name / "src" / "robot")
        common = made(tmp_path / name / "src" / "common")
        file(robot / "launch" / "a.launch.xml", text=LAUNCH)
        file(common / "launch" / "part.launch.xml", text="<launch/>")
    return tmp_path


def test_the_package_that_holds_the_launch_file_is_meant_then_the_nearest_workspace(repository: Path) -> None:
    workspace = Workspace(detect_environment(str(repository), {}, root=str(repository)), Sources())
    for name in ("one", "two"):
        source = repository / name / "src"
        analysis = workspace.static(str(source / "robot/launch/a.launch.xml"))
        assert [include.path for include in analysis.tree.includes] == [str(source / "common/launch/part.launch.xml")]
        assert [node.resolved.path for node in analysis.tree.nodes] == [str(source / "robot/driver.py")]
    index = build_index(workspace, str(repository))
    assert index is not None
    assert sorted(Path(root.path).name for root in index.entries) == ["a.launch.xml", "a.launch.xml"]


def test_a_node_does_what_the_source_of_the_package_says_that_is_meant(repository: Path) -> None:
    workspace = Workspace(detect_environment(str(repository), {}, root=str(repository)), Sources())
    for name in ("one", "two"):
        robot = repository / name / "src/robot"
        file(robot / "CMakeLists.txt", text="add_executable(driver driver.cpp)\n")
        file(robot / "driver.cpp", text=NODE.format(name))
        launch = file(robot / "launch/c.launch.xml", text='<launch><node pkg="robot" exec="driver"/></launch>')
        static = workspace.static(str(launch))
        (node,) = static.tree.nodes
        graph = workspace.with_interfaces(static, [not_run(node, "no trust")], "no trust").graph
        assert graph is not None
        own = [end.name for end in graph.interfaces[0].endpoints if not end.builtin]
        assert own == [name]


def test_elsewhere_the_order_of_the_path_decides(repository: Path) -> None:
    launch = file(repository / "other" / "a.launch.xml", text=LAUNCH)
    path = [str(repository / name) for name in ("two", "one")]
    workspace = Workspace(detect_environment(None, {"ROS_VERSION": "2"}, path), Sources())
    (node,) = workspace.static(str(launch)).tree.nodes
    assert node.resolved.path == str(repository / "two/src/robot/driver.py")


def test_a_launch_file_of_ros_2_does_not_run_what_ros_1_has_installed(tmp_path: Path) -> None:
    for name in ("rospy", "topic_tools"):
        file(tmp_path / "usr/share" / name / "package.xml", text=MANIFEST.format(name, "catkin"))
    file(tmp_path / "usr/lib/python3/dist-packages/rospy/__init__.py")
    relay = script(tmp_path / "usr/lib/topic_tools/relay")
    made(tmp_path / "ws/src/old", "catkin")
    made(tmp_path / "ws/src/new")
    ros1 = file(
        tmp_path / "ws/src/old/a.launch", text='<launch><node pkg="topic_tools" type="relay" name="n"/></launch>'
    )
    ros2 = file(tmp_path / "ws/src/new/a.launch.xml", text='<launch><node pkg="topic_tools" exec="relay"/></launch>')
    workspace = Workspace(detect_environment(str(tmp_path / "ws"), {}, root=str(tmp_path)), Sources())
    (node,) = workspace.static(str(ros1)).tree.nodes
    assert node.resolved.path == str(relay)
    analysis = workspace.static(str(ros2))
    assert [node.resolved.path for node in analysis.tree.nodes] == [None]
    assert sorted(finding.rule for finding in analysis.findings) == ["PKG001", "PKG004"]


@pytest.mark.ros
def test_the_run_of_a_python_launch_file_gets_the_package_that_holds_it(repository: Path) -> None:
    text = """
import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    share = get_package_share_directory("common")
    return LaunchDescription([Node(package="robot", executable="driver.py", name=share.split(os.sep)[-3])])
"""
    environment = detect_environment(str(repository), {"PATH": "/usr/bin:/bin"}, root=str(repository))
    results = CommandResults(lambda: None)
    workspace = Workspace(environment, Sources(), commands=results)
    runner = CommandRunner(environment, str(repository), None)
    for name in ("one", "two"):
        launch = file(repository / name / "src/robot/launch/b.launch.py", text=text)
        analysis = resolve_commands(workspace, str(launch), {}, Resolving(results, runner))
        assert [node.name for node in analysis.tree.nodes] == [f"/{name}"]
