"""LCH027: what its authors, roslaunch or a newer distribution of ROS have given up."""

from pathlib import Path

import pytest
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import apply, check


def test_an_included_file_that_its_author_calls_deprecated() -> None:
    check("""
        <launch>
          <include file="/old.launch"/>
                         ^^^^^^^^^^^ warning[LCH027] '/old.launch' is deprecated: use new.launch
          <include file="/new.launch"/>
        </launch>
        //- /old.launch
        <launch deprecated="use new.launch"><include file="/new.launch"/></launch>
        //- /new.launch
        <launch deprecated=""/>
    """)


def test_what_newer_releases_have_given_up() -> None:
    text = """
        <launch>
          <master auto="start"/>
          ^^^^^^^^^^^^^^^^^^^^^^ info[LCH027] <master> is removed since ROS Fuerte; roslaunch ignores it
          <node pkg="tf" type="static_transform_publisher" name="a" args="0 0 0 0 0 0 base laser 100"/>
                               ^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[LCH027] 'static_transform_publisher' of tf is
          <node pkg="tf2_ros" type="static_transform_publisher" name="b" args="0 0 0 0 0 0 base camera"/>
          <param name="use_gui" value="true"/>
                       ^^^^^^^ warning[LCH027] parameter 'use_gui' of joint_state_publisher is removed since ROS
          <node pkg="joint_state_publisher" type="joint_state_publisher" name="joints"/>
        </launch>
        //- /tf/package.xml
        <package/>
        //- /tf2_ros/package.xml
        <package/>
        //- /joint_state_publisher/package.xml
        <package/>
    """
    findings = {finding.message.split()[0]: finding for finding in check(text)}
    assert "<master" not in apply(text, findings["<master>"].fixes[0].edits)["/main.launch"]
    changed = apply(text, findings["'static_transform_publisher'"].fixes[0].edits)["/main.launch"]
    assert 'pkg="tf2_ros" type="static_transform_publisher" name="a" args="0 0 0 0 0 0 base laser"/>' in changed


def test_what_is_gone_is_named_with_what_replaces_it() -> None:
    text = """
        <launch>
          <node pkg="gazebo" type="gazebo" name="gazebo"/>
                     ^^^^^^ error[LCH027] package 'gazebo' is removed since ROS Hydro; use 'gazebo_ros'
          <param name="r" command="xacro --inorder robot.xacro"/>
                                        ^^^^^^^^^^ hint[LCH027] '--inorder' has no effect: xacro processes in order
        </launch>
    """
    gazebo, in_order = [finding for finding in check(text) if finding.rule == "LCH027"]
    assert 'pkg="gazebo_ros"' in apply(text, gazebo.fixes[0].edits)["/main.launch"]
    assert 'command="xacro robot.xacro"' in apply(text, in_order.fixes[0].edits)["/main.launch"]


def test_a_program_that_is_gone_is_named_with_what_replaces_it() -> None:
    text = """
        <launch>
          <param name="a" command="$(find xacro)/xacro.py '/robot.xacro'"/>
                                   ^^^^^^^^^^^^^ hint[PKG001] package 'xacro' is not installed
                                                 ^^^^^^^^ error[LCH027] 'xacro.py' is removed since ROS Noetic
          <param name="b" command="rosrun xacro xacro.py /robot.xacro"/>
                                                ^^^^^^^^ error[LCH027] 'xacro.py' is removed since ROS Noetic
          <param name="c" command="$(find xacro)/xacro /robot.xacro"/>
                                   ^^^^^^^^^^^^^ hint[PKG001] package 'xacro' is not installed
        </launch>
        //- /robot.xacro
        <robot name="r"/>
    """
    first = next(finding for finding in check(text) if finding.rule == "LCH027")
    assert "$(find xacro)/xacro '/robot" in apply(text, first.fixes[0].edits)["/main.launch"]


def test_a_program_that_is_gone_is_told_once_where_its_package_is_here() -> None:
    check("""
        <launch>
          <param name="a" command="$(find xacro)/xacro.py robot.xacro"/>
                                   ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[PRM008] program 'xacro/xacro.py' does not
        </launch>
        //- /xacro/package.xml
        <package/>
    """)


def test_what_is_gone_is_told_once(tmp_path: Path) -> None:
    launch = tmp_path / "a.launch"
    launch.write_text('<launch><node pkg="robot_state_publisher" type="state_publisher" name="a"/></launch>')
    packages = {"robot_state_publisher": Package("robot_state_publisher", str(tmp_path), str(tmp_path / "package.xml"))}
    environment = Environment(1, "noetic", {}, (str(tmp_path),), packages, {}, (), ("/usr",), "/usr/bin/python3")
    found = Workspace(environment, Sources(), str(tmp_path)).static(str(launch)).findings
    assert [(each.rule, each.severity) for each in found] == [("LCH027", "error")]


@pytest.mark.silent
def test_an_executable_that_is_still_there_is_not_gone() -> None:
    check("""
        <launch>
          <node pkg="robot_state_publisher" type="state_publisher" name="a"/>
          <param name="~use_gui" value="true"/>
          <node pkg="p" type="joint_state_publisher" name="joints"/>
        </launch>
        //- /robot_state_publisher/package.xml
        <package/>
    """)
