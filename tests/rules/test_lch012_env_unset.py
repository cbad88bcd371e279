"""LCH012: $(env) of a variable that is not set."""

from pathlib import Path

import pytest
from preflight_analysis.environment.model import Environment
from preflight_analysis.findings.lack import Lack
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import check
from support.python_launch_harness import PythonHarness


def test_an_environment_variable_that_is_not_set() -> None:
    (finding,) = check("""
        <launch>
          <param name="a" value="$(env NOT_SET_ANYWHERE)"/>
                                 ^^^^^^^^^^^^^^^^^^^^^^^ hint[LCH012] 'NOT_SET_ANYWHERE' is not set
        </launch>
    """)
    assert finding.stops_launch
    assert finding.lack == Lack("variable", "NOT_SET_ANYWHERE")


def test_a_slip_of_the_name_of_one_that_is_set(launch: Path) -> None:
    launch.write_text('<launch><param name="a" value="$(env ROBOT_MDOEL)"/></launch>')
    environment = Environment(1, "noetic", {"ROBOT_MODEL": "waffle"}, (), {}, {}, (), (), None)
    (finding,) = Workspace(environment, Sources(), str(launch.parent)).static(str(launch)).findings
    assert (finding.severity, finding.lack) == ("warning", None)
    assert finding.message == "environment variable 'ROBOT_MDOEL' is not set; did you mean 'ROBOT_MODEL'?"
    assert [fix.title for fix in finding.fixes] == ["Replace 'ROBOT_MDOEL' with 'ROBOT_MODEL'"]


@pytest.mark.silent
def test_a_variable_that_need_not_be_set() -> None:
    check("""
        <launch>
          <arg name="more" default="false"/>
          <param name="a" value="$(optenv NOT_SET_ANYWHERE none)"/>
          <param name="b" value="$(env NOT_SET_ANYWHERE)" if="$(arg more)"/>
        </launch>
    """)


DISTRO = """import os
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    distro = {}
    return LaunchDescription([Node(package='p', executable='x', name='on_' + distro)])
"""


@pytest.mark.ros
@pytest.mark.parametrize(
    "read", ["os.environ['ROS_DISTRO']", "os.environ.get('ROS_DISTRO', '')", "os.getenv('ROS_DISTRO')"]
)
def test_a_distribution_that_is_assumed(tmp_path: Path, read: str) -> None:
    harness = PythonHarness(tmp_path)
    path = harness.write("launch/a.launch.py", DISTRO.format(read))
    analysis = harness.launch(path, variables={"ROS_DISTRO": "", "ROS_VERSION": ""})
    (finding,) = [each for each in analysis.findings if each.rule == "LCH012"]
    assert finding.message == "environment variable 'ROS_DISTRO' is not set; 'rolling' is assumed"
    assert (finding.severity, finding.stops_launch) == ("hint", False)
    assert finding.lack is not None
    assert finding.lack.name == "ROS_DISTRO"
    assert [node.name for node in analysis.tree.nodes] == ["/on_rolling"]


@pytest.mark.ros
@pytest.mark.silent
@pytest.mark.parametrize(("read", "distro"), [("os.environ['ROS_DISTRO']", "jazzy"), ("'nothing'", "")])
def test_a_distribution_that_is_known_or_not_asked_for(tmp_path: Path, read: str, distro: str) -> None:
    harness = PythonHarness(tmp_path)
    path = harness.write("launch/a.launch.py", DISTRO.format(read))
    analysis = harness.launch(path, variables={"ROS_DISTRO": distro, "ROS_VERSION": ""})
    assert "LCH012" not in [each.rule for each in analysis.findings]
