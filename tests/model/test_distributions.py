"""What is not so in the distribution that a workspace is for, and another one is used."""

from __future__ import annotations

from dataclasses import replace

import pytest
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.registry import run_rules
from support.check import analyse, read_fixture
from support.robot_launch import of_urdf, robot

DIVISION = """
    <launch>
      <arg name="width" value="$(eval 16 * 150 / 2)"/>
      <node pkg="p" type="n" name="n"><param name="width" type="int" value="$(arg width)"/></node>
    </launch>
"""
COSTMAP = """
    <launch>
      <node pkg="move_base" type="move_base" name="m"><param name="global_costmap/global_frame" value="/map"/></node>
    </launch>
    //- /move_base/package.xml
    <package><name>move_base</name></package>
"""
OTHER_COSTMAP = """
    <launch>
      <node pkg="own" type="explore" name="explore">
        <rosparam ns="local_costmap">{global_frame: /odom, robot_base_frame: base_link}</rosparam>
      </node>
    </launch>
    //- /own/package.xml
    <package><name>own</name></package>
"""
CLOCK = """
    //- /a.launch.xml
    <launch>
      <node pkg="p" exec="d" name="d"><param from="/d.yaml"/></node>
    </launch>
    //- /d.yaml
    d:
      ros__parameters:
        use_sim_time: yes please
    //- interfaces
    {"/d": {}}
"""
RETIRED = """
    <launch>
      <param name="use_gui" value="true"/>
      <node pkg="joint_state_publisher" type="joint_state_publisher" name="joints"/>
    </launch>
    //- /joint_state_publisher/package.xml
    <package/>
"""
KEYWORD = """
    //- /a.launch.py
    from launch import LaunchDescription
    from launch_ros.actions import Node
    def generate_launch_description():
        return LaunchDescription([Node(package="p", node_executable="a")])
"""
DESCRIPTION = of_urdf(
    '<link name="base"/><gazebo><plugin name="c" filename="libgazebo_ros2_control.so"/></gazebo>\n<!-- a: b -->\n',
    robot("<!-- a: b -->"),
    """
    //- /main.launch.xml
    <launch>
      <node pkg="p" exec="rsp" name="rsp">
        <param name="robot_description" value="$(command 'xacro arm')" type="str"/>
      </node>
    </launch>
    """,
)
CASES = {
    "FRM004": (COSTMAP, "noetic", "kinetic"),
    "FRM004 elsewhere": (OTHER_COSTMAP, "noetic", "hydro"),
    "PRM014": (CLOCK, "jazzy", "foxy"),
    "LCH008": (DIVISION, "noetic", "kinetic"),
    "LCH027": (RETIRED, "noetic", "indigo"),
    "LCH032": (KEYWORD, "humble", "foxy"),
    "CTL009": (DESCRIPTION, "humble", "foxy"),
}


def _found(rule: str, fixture: str, used: str | None, meant: tuple[str, ...]) -> list[Finding]:
    context = analyse(read_fixture(fixture))
    environment = replace(context.environment, distro=used, meant_for=meant)
    return [each for each in run_rules(replace(context, environment=environment)) if each.rule == rule]


@pytest.mark.parametrize("case", CASES)
def test_the_workspace_is_for_another_one(case: str) -> None:
    fixture, used, meant = CASES[case]
    rule = case.split()[0]
    plain = _found(rule, fixture, used, ())
    assert len(plain) == 1
    assert plain[0].severity in ("warning", "error")
    for others in ((meant,), (meant, used)):
        (found,) = _found(rule, fixture, used, others)
        reasons = [each.reason.name for each in found.doubts]
        assert ("MEANT_FOR_OTHER" in reasons) == (used not in others)
        assert (found.severity, found.confidence) == (
            ("info", "possible") if used not in others else (plain[0].severity, plain[0].confidence)
        )


def test_where_nothing_is_installed_and_it_says_several() -> None:
    (found,) = _found("LCH032", KEYWORD, None, ("eloquent", "foxy"))
    (doubt,) = found.doubts
    assert doubt.remedy.startswith("check it with ROS Eloquent and Foxy, or ")
