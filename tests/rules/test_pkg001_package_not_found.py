"""PKG001: a package that is not there."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.findings.lack import Lack
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import apply, check, findings_of
from support.unbuilt_packages import manifest


def test_a_package_that_is_not_there_and_the_nearest_one() -> None:
    text = """
        <launch>
          <node pkg="rospy_tutorial" type="talker" name="n"/>
                     ^^^^^^^^^^^^^^ error[PKG001] did you mean 'rospy_tutorials'?
          <param name="a" value="$(find rospy_tutorial)/x"/>
                                 ^^^^^^^^^^^^^^^^^^^^^^ error[PKG001] is not among the 2 packages
        </launch>
        //- /rospy_tutorials/package.xml
        <package/>
    """
    node, find = check(text)
    assert not node.stops_launch
    assert find.stops_launch
    assert 'pkg="rospy_tutorials"' in apply(text, node.fixes[0].edits)["/main.launch"]
    assert "$(find rospy_tutorials)/x" in apply(text, find.fixes[0].edits)["/main.launch"]


def test_a_package_that_its_folder_names_otherwise() -> None:
    text = """
        <launch>
          <node pkg="robot-master" type="base" name="n"/>
                     ^^^^^^^^^^^^ error[PKG001] the folder /ws/robot-master holds package 'robot'
        </launch>
        //- /ws/robot-master/package.xml
        <package><name>robot</name></package>
    """
    (finding,) = check(text)
    assert 'pkg="robot"' in apply(text, finding.fixes[0].edits)["/main.launch"]


@pytest.mark.silent
def test_a_package_in_a_tag_that_is_not_taken_is_not_looked_for() -> None:
    check("""
        <launch>
          <arg name="more" default="false"/>
          <node pkg="nowhere" type="t" name="n" if="$(arg more)"/>
          <node pkg="p" type="t" name="m"/>
        </launch>
    """)


@pytest.mark.silent
def test_a_package_whose_name_is_unknown_is_not_judged() -> None:
    findings = findings_of("""
        <launch>
          <arg name="pkg"/>
          <node pkg="$(arg pkg)" type="t" name="n"/>
        </launch>
    """)
    assert [finding.rule for finding in findings] == ["ARG003"]


def test_a_package_without_a_near_one_is_a_lack_of_the_machine(launch: Path) -> None:
    launch.write_text('<launch><node pkg="tf2_ros" type="x" name="n"/><node pkg="demmo" type="x" name="m"/></launch>')
    share = str(launch.parent)
    packages = {"demo": Package("demo", share, f"{share}/package.xml")}
    for python in (None, "/usr/bin/python3"):
        environment = Environment(1, "noetic", {}, (share,), packages, {}, (), (), python)
        findings = Workspace(environment, Sources(), share).static(str(launch)).findings
        assert [f.severity for f in findings] == ["hint", "error"]
        assert [f.lack for f in findings] == [Lack("package", "tf2_ros"), None]


def test_processes_and_components_are_of_no_missing_package(tmp_path: Path) -> None:
    folder = tmp_path / "src" / "vision"
    (folder / "launch").mkdir(parents=True)
    (folder / "package.xml").write_text(manifest("vision", "ament_cmake"))
    launch = folder / "launch" / "box.launch.xml"
    launch.write_text(
        '<launch><executable cmd="ls -l"/><load_composable_node target="/box">'
        '<composable_node pkg="vision" plugin="A" name="a"/><composable_node pkg="nowhere_known" plugin="B" name="b"/>'
        "</load_composable_node></launch>"
    )
    workspace = Workspace(detect_environment(str(tmp_path), {}), Sources(), str(tmp_path))
    findings = [f for f in workspace.static(str(launch), {}).findings if f.rule == "PKG001"]
    assert [(f.severity, f.message.partition(" is ")[0]) for f in findings] == [("hint", "package 'nowhere_known'")]


@pytest.mark.silent
def test_a_process_has_no_package() -> None:
    check("""
        //- /a.launch.xml
        <launch><executable cmd="echo hello"/></launch>
    """)
