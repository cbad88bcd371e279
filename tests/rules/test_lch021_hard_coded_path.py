"""LCH021: a path that exists on one machine."""

from pathlib import Path

import pytest
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import check


def test_a_path_of_one_machine() -> None:
    check("""
        <launch>
          <param name="model" value="/home/bob/ws/src/vision/net.pt"/>
                                     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[LCH021] in the home folder of one user
          <param name="mac" value="file:///Users/bob/net.pt"/>
                                          ^^^^^^^^^^^^^^^^^ info[LCH021] in the home folder of one user
          <param name="tilde" value="~bob/net.pt"/>
                                     ^^^^^^^^^^^ info[LCH021] in the home folder of one user
          <node pkg="p" type="t" name="n" args="-d /opt/ros/melodic/share/a.rviz"/>
                                                   ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[LCH021] one distribution
        </launch>
    """)


@pytest.mark.silent
def test_what_merely_looks_like_a_path_is_none_of_one_machine() -> None:
    check("""
        <launch>
          <machine name="robot" address="robot" env-loader="/opt/ros/noetic/env.sh"/>
          <remap from="/home/robot/scan" to="/root/scan"/>
          <group ns="/home/robot/arm"/>
          <param name="topic" value="/p/scan"/>
          <param name="private" value="~foo/bar"/>
          <param name="device" value="/dev/ttyUSB0"/>
          <param name="folder" value="/tmp/maps/office.yaml"/>
          <param name="relative" value="$(optenv HOME /home/robot/x)/home/bob/net.pt"/>
        </launch>
    """)


def test_a_path_of_one_machine_as_a_path_of_its_package(tmp_path: Path) -> None:
    share = tmp_path / "src" / "vision"
    (share / "models").mkdir(parents=True)
    (share / "models" / "net.pt").touch()
    (share / "package.xml").write_text("<package><name>vision</name></package>")
    launch = share / "vision.launch"
    launch.write_text(
        f'<launch><param name="a" value="{share}/models/net.pt"/>'
        '<param name="b" value="/home/bob/catkin_ws/src/vision/models/net.pt"/></launch>'
    )
    environment = Environment(
        1, "noetic", {}, (), {"vision": Package("vision", str(share), "")}, {}, (), (), None, str(tmp_path)
    )
    findings = Workspace(environment, Sources(), str(tmp_path)).static(str(launch)).findings
    # The first one leads somewhere, the second one does not.
    assert [(f.rule, f.severity, f.confidence) for f in findings] == [
        ("LCH021", "info", "certain"),
        ("LCH021", "warning", "certain"),
    ]
    assert [f.fixes[0].edits[0].text for f in findings] == ["$(find vision)/models/net.pt"] * 2


def test_a_path_of_one_user() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a" args="--map /home/bob/maps/lab.yaml">
                                                      ^^^^^^^^^^^^^^^^^^^^^^^ info[LCH021] in the home folder of one
            <remap from="scan" to="scan"/>
            ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[LCH024] remap of 'scan' to itself has no effect
            <remap from="image" to="/home/bob/image"/>
          </node>
        </launch>
    """)
