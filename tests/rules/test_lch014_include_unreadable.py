"""LCH014: an include of a file that cannot be read as a launch file."""

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import check, findings_of


def test_an_included_folder() -> None:
    assert [f.rule for f in findings_of('<launch><include file="/"/></launch>')] == ["LCH014"]


def _included_from_ros_1(folder: Path, build: str) -> list[Finding]:
    """What is said of a launch file of ROS 1 that includes one of ROS 2, in a package that is built so."""
    build_type = f"<export><build_type>{build}</build_type></export>"
    (folder / "package.xml").write_text(f"<package><name>robot</name>{build_type}</package>")
    (folder / "base.launch").write_text(
        '<launch><arg name="a"/><group><push-ros-namespace namespace="$(var a)"/></group></launch>'
    )
    path = folder / "robot.launch"
    inside = '<arg name="a" value="$(arg a)"/>'
    path.write_text(f"""<launch><arg name="a" default="x"/>
        <include file="$(find robot)/base.launch">{inside}</include></launch>""")
    environment = detect_environment(str(folder), {"ROS_VERSION": "1"}, root=str(folder))
    return list(Workspace(environment, Sources()).static(str(path)).findings)


def test_one_of_ros_2_is_not_read_as_one_of_ros_1(tmp_path: Path) -> None:
    (found,) = _included_from_ros_1(tmp_path, "ament_cmake")
    assert (found.rule, found.severity) == ("LCH014", "info")
    assert found.message.endswith("/base.launch' is a launch file of ROS 2 (launch file of ROS 1 in a ROS 2 package)")


def test_in_a_package_of_ros_1_the_tags_of_ros_2_are_the_mistake(tmp_path: Path) -> None:
    rules = [each.rule for each in _included_from_ros_1(tmp_path, "catkin")]
    assert "LCH014" not in rules
    assert "LCH004" in rules


@pytest.mark.silent
def test_an_included_file_that_can_be_read() -> None:
    check("""
        <launch><include file="/inc.launch"/></launch>
        //- /inc.launch
        <launch/>
    """)
