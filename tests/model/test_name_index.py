"""The index of names: what it has of each kind of file, and where."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.model.name_index import entries_in, mentions_in
from preflight_analysis.workspace.sources import Sources

LAUNCH = """<launch>
  <arg name="rate" default="1"/>
  <node pkg="arm" type="driver" name="left">
    <remap from="scan" to="/front/scan"/>
    <param name="~limits/speed" value="$(arg rate)"/>
  </node>
  <include file="$(find arm)/launch/a.launch"><arg name="rate" value="$(env RATE)"/></include>
</launch>
"""
RVIZ = """Visualization Manager:
  Displays:
    - Class: rviz_default_plugins/LaserScan
      Topic:
        Value: /scan
    - Class: rviz/Map
      Topic: "/map"
  Global Options:
    Fixed Frame: odom
"""
LISTS = """find_package(catkin REQUIRED COMPONENTS roscpp tf2_ros)
find_package(rclcpp REQUIRED)
find_package(Boost REQUIRED COMPONENTS thread)
if(BUILD)
  add_executable(driver src/a.cpp)  # add_executable(old a.cpp)
endif()
add_executable(${NAME} src/b.cpp)
ament_target_dependencies(driver PUBLIC rclcpp "nav_msgs")
rclcpp_components_register_node(lib PLUGIN "arm::Driver" EXECUTABLE driver_node)
"""
SETUP = """entry_points={'console_scripts': ['driver = arm.driver:main', f'{x} = a:b']}"""
CFG = "[options]\na = b:c\n[options.entry_points]\nconsole_scripts =\n    driver = arm.driver:main\n"
MANIFEST = "<package><name>arm</name><!-- <depend>old</depend> --><exec_depend>rclcpp</exec_depend></package>"
SOURCE = """#include "a.hpp"
auto p = node->create_publisher<sensor_msgs::msg::LaserScan>("scan", 1);
auto s = ament_index_cpp::get_package_share_directory("arm");
node->declare_parameter("limits.speed", 1.0);
"""
YAML = "left:\n  joints: [left_wheel_joint, 'right_wheel_joint']\n  scan_topic: \"/scan\"\n"
ROBOT = '<robot>é<joint name="left_wheel_joint"/><plugin><topicName>scan</topicName></plugin></robot>'
PYTHON = """from launch import LaunchDescription
def generate_launch_description():
    return LaunchDescription([Node(package="arm", executable="driver", remappings=[("scan", "/front/scan")])])
"""


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        (
            "a.launch",
            LAUNCH,
            {
                "argument rate declares", "argument rate uses", "argument rate passes", "passed rate a.launch",
                "package arm", "program driver arm", "node left", "remap scan from", "remap /front/scan to",
                "value /front/scan", "parameter speed set ~limits/", "variable RATE", "file a.launch",
                "include $(find arm)/launch/a.launch",
            },
        ),
        (
            "b.launch.xml",
            '<launch><executable cmd="$(exec-in-pkg driver arm)"/></launch>',
            {"program driver arm", "package arm"},
        ),
        ("a.rviz", RVIZ, {"topic /scan use", "topic /map use", "frame odom use"}),
        (
            "CMakeLists.txt",
            LISTS,
            {
                "package catkin uses", "package roscpp uses", "package tf2_ros uses", "package rclcpp uses",
                "package Boost uses", "package nav_msgs uses", "program driver declares",
                "program driver_node declares", "component arm::Driver declares",
            },
        ),
        ("setup.cfg", CFG, {"program driver declares"}),
        ("package.xml", MANIFEST, {"package arm declares", "package rclcpp uses"}),
        ("b.yaml", YAML, {"section left", "joint left_wheel_joint", "joint right_wheel_joint", "value /scan"}),
        ("r.urdf", ROBOT, {"joint left_wheel_joint", "simulated scan"}),
    ],
)  # fmt: skip
def test_of_a_file(tmp_path: Path, name: str, text: str, expected: set[str]) -> None:
    assert {" ".join(filter(None, entry)) for entry in written(tmp_path, name, text)} == expected


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("setup.py", SETUP, {"program driver declares"}),
        ("a.cpp", SOURCE, {"topic scan offer LaserScan", "package arm", "parameter speed asked limits"}),
        ("a.launch.py", PYTHON, {"package arm", "program driver", "argument scan", "remap /front/scan to"}),
    ],
)
def test_of_a_program(tmp_path: Path, name: str, text: str, expected: set[str]) -> None:
    found = {" ".join(filter(None, entry)) for entry in written(tmp_path, name, text) if entry.kind != "name"}
    assert found == expected


def written(tmp_path: Path, name: str, text: str) -> frozenset[tuple[str, ...]]:
    """The entries of a file; each is where its mention says."""
    path, sources = tmp_path / name, Sources()
    path.write_text(text)
    mentions = mentions_in(sources.db, str(path))
    assert frozenset(each.entry for each in mentions) == entries_in(sources.db, str(path))
    for entry, (start, end), tag in mentions:
        assert text[start:end].lstrip("/~").endswith(entry.text.lstrip("/~")), (entry, text[start:end])
        assert tag.start <= start
    return entries_in(sources.db, str(path))


def test_places_move_with_an_edit_and_entries_stay(tmp_path: Path) -> None:
    path, sources = str(tmp_path / "a.launch"), Sources()
    sources.open(path, LAUNCH)
    before, known = mentions_in(sources.db, path), entries_in(sources.db, path)
    sources.open(path, LAUNCH.replace("<launch>", "<launch>\n\n"))
    assert entries_in(sources.db, path) is known
    assert [(m.entry, m.span.start) for m in mentions_in(sources.db, path)] == [
        (m.entry, m.span.start + 2) for m in before
    ]
