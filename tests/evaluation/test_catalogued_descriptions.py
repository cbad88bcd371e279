"""Robot descriptions of packages that are not here: our own xacro has them from the catalogue."""

from __future__ import annotations

import json

import pytest
from preflight_analysis.catalogue.descriptions import DESCRIPTIONS, is_described
from preflight_analysis.environment.own_programs import OLD_XACRO
from support.check import analyse, read_fixture

_ROBOT = "<robot/>"
_ROS1 = '<launch>{}<param name="robot_description" command="{}"/></launch>'
_ROS2 = """//- /main.launch.xml
<launch><arg name="package" default="ur_description"/>
<arg name="model" default="$(find-pkg-share ur_description)/urdf/ur.urdf.xacro"/>
<node pkg="p" exec="n"><param name="robot_description" value="$(command '{}')"/></node></launch>"""


def _asked(launch: str, line: str) -> list[object]:
    """The descriptions of a launch in which that command line alone has a result."""
    tree = analyse(read_fixture(f"{launch}\n//- commands\n{json.dumps({line: {'output': _ROBOT}})}")).tree
    params = tree.nodes[0].params if tree.ros.own_parameters else tree.params.values()
    return [param.value for param in params]


@pytest.mark.parametrize(
    ("command", "line"),
    [
        ("xacro '$(find ur_description)/urdf/ur5.xacro' a:=b", "xacro '{}/ur_description/urdf/ur5.xacro' a:=b"),
        ("$(find xacro)/xacro $(find ur_description)/a.xacro", "xacro {}/ur_description/a.xacro"),
        ("$(find xacro)/xacro.py $(find ur_description)/a.xacro", f"{OLD_XACRO} {{}}/ur_description/a.xacro"),
    ],
)
def test_a_command_of_ros_1(command: str, line: str) -> None:
    assert _asked(_ROS1.format("", command), line.format(DESCRIPTIONS / "noetic")) == [_ROBOT]


@pytest.mark.parametrize(
    "command", ["cat $(find ur_description)/a.xacro", "xacro $(find no_such_description)/a.xacro", "xacro $(arg none)"]
)
def test_other_programs_and_packages_have_nothing(command: str) -> None:
    line = command.replace("$(find ur_description)", f"{DESCRIPTIONS}/noetic/ur_description")
    assert _asked(_ROS1.format("", command), line) == []


def test_what_is_installed_is_what_it_is() -> None:
    manifest = "//- /ws/ur_description/package.xml\n<package><name>ur_description</name></package>"
    launch = _ROS1.format("", "xacro $(find ur_description)/a.xacro")
    assert _asked(f"{launch}\n{manifest}", "xacro /ws/ur_description/a.xacro") == [_ROBOT]


@pytest.mark.parametrize(
    "path",
    [
        "$(find-pkg-share ur_description)/urdf/ur.urdf.xacro",
        "$(find-pkg-share $(var package))/urdf/ur.urdf.xacro",
        "$(var model)",
    ],
)
def test_a_command_of_ros_2(path: str) -> None:
    line = f"xacro {DESCRIPTIONS}/jazzy/ur_description/urdf/ur.urdf.xacro name:=ur"
    assert _asked(_ROS2.format(f"xacro {path} name:=ur"), line) == [_ROBOT]


def test_other_programs_of_ros_2_have_nothing() -> None:
    line = f"cat {DESCRIPTIONS}/jazzy/ur_description/a"
    assert _asked(_ROS2.format("cat $(find-pkg-share ur_description)/a"), line) == []


def test_which_paths_are_the_catalogues() -> None:
    assert is_described(f"{DESCRIPTIONS}/jazzy/ur_description/a")
    assert not is_described("/opt/ros/jazzy/share/ur_description/a")
