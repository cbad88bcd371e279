"""What is offered as a fix has strong evidence, and nothing is missed that a node which ended may have made."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.files import nearest_file
from preflight_analysis.model.nearest import is_slip
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import check, findings_of


@pytest.mark.parametrize(("name", "other"), [("camrea", "camera"), ("helo", "hello"), ("robot_drivr", "robot_driver")])
def test_slips(name: str, other: str) -> None:
    assert is_slip(name, other)


@pytest.mark.parametrize(
    ("name", "other"), [("mpo_700", "mmo_900"), ("hello2", "hello"), ("nope", "nav2"), ("cola", "code")]
)
def test_no_slips(name: str, other: str) -> None:
    assert not is_slip(name, other)


def launched(folder: Path, text: str, *, python: str | None = "/usr/bin/python3") -> tuple[Finding, ...]:
    (folder / "package.xml").write_text("<package><name>p</name></package>")
    launch = folder / "a.launch"
    launch.write_text(text)
    packages = {"p": Package("p", str(folder), str(folder / "package.xml"))}
    environment = Environment(1, "noetic", {}, (str(folder),), packages, {}, (), ("/usr",), python)
    return Workspace(environment, Sources(), str(folder)).static(str(launch)).findings


def test_a_file_of_another_name_is_not_offered(tmp_path: Path) -> None:
    (tmp_path / "nav2.launch.xml").write_text("<launch/>")
    (found,) = launched(tmp_path, '<launch><include file="$(find p)/nope.launch.xml"/></launch>')
    assert (found.rule, found.fixes) == ("LCH013", ())
    assert "did you mean" not in found.message


def test_a_file_of_nearly_that_name_is_offered(tmp_path: Path) -> None:
    (tmp_path / "camera.launch.xml").write_text("<launch/>")
    (found,) = launched(tmp_path, '<launch><include file="$(find p)/camrea.launch.xml"/></launch>')
    assert [fix.title for fix in found.fixes] == ["Replace 'camrea.launch.xml' with 'camera.launch.xml'"]


def test_of_files_of_that_name_the_one_in_the_folders_that_were_written_is_meant(tmp_path: Path) -> None:
    for place in ("mpo_700/costmaps", "mmo_700/move_base/costmaps"):
        (tmp_path / place).mkdir(parents=True)
        (tmp_path / place / "local.yaml").write_text("a: 1\n")
    found = nearest_file(Disk(), f"{tmp_path}/mmo_700/costmaps/local.yaml", _environment(tmp_path))
    assert found == f"{tmp_path}/mmo_700/move_base/costmaps/local.yaml"


def test_of_files_of_that_name_that_are_as_near_none_is_meant(tmp_path: Path) -> None:
    for place in ("left", "right"):
        (tmp_path / place).mkdir()
        (tmp_path / place / "local.yaml").write_text("a: 1\n")
    assert nearest_file(Disk(), f"{tmp_path}/middle/local.yaml", _environment(tmp_path)) is None


def _environment(folder: Path) -> Environment:
    packages = {"p": Package("p", str(folder), str(folder / "package.xml"))}
    return Environment(1, "noetic", {}, (str(folder),), packages, {}, (), ("/usr",), "/usr/bin/python3")


def test_a_header_is_no_executable(tmp_path: Path) -> None:
    header = tmp_path / "cola_converter.h"
    header.write_text("")
    header.chmod(0o755)
    (found,) = launched(tmp_path, '<launch><node pkg="p" type="cola_converte" name="n"/></launch>')
    assert (found.rule, found.fixes) == ("PKG002", ())
    assert "did you mean" not in found.message


@pytest.mark.parametrize("package", ["q2", "qq", "elsewhere"])
def test_a_near_name_does_not_make_a_package_of_ros_wrong(tmp_path: Path, package: str) -> None:
    text = f'<launch><node pkg="{package}" type="t" name="n"/></launch>'
    found = [each for each in launched(tmp_path, text, python=None) if each.rule == "PKG001"]
    assert [(each.severity, each.fixes) for each in found] == [("info", ())]


POSE = """
    <launch>
      <node pkg="p" type="t" name="planner"/>
      <node pkg="p" type="t" name="tracker"/>
    </launch>
    //- interfaces
    {"/planner": {"subscribers": {"/goal_pose": "geometry_msgs/PoseStamped"}},
     "/tracker": {"publishers": {"/robot1/pose": "geometry_msgs/PoseStamped"}}}
"""


def test_like_words_of_another_thing_are_no_fix() -> None:
    assert [each.fixes for each in findings_of(POSE) if each.fixes] == []


BLIND = """
    <launch>
      <node pkg="p" type="t" name="states"/>
      <node pkg="p" type="t" name="joints"/>
    {carets} warning[TRC001] exit code 1
    </launch>
    //- interfaces
    {{"/states": {{"subscribers": {{"joint_states": "sensor_msgs/JointState"}},
                   "publishers": {{"out": "std_msgs/Int8"}},
                   "clients": {{"reset": "std_srvs/Empty"}}}},
      "/joints": {{"status": "crashed", "exit_code": 1,
                   "publishers": {{"left/joint_states": "sensor_msgs/JointState"}}}}}}
"""


def test_what_a_node_that_crashed_would_have_made_is_not_missing() -> None:
    check(BLIND.format(carets="  " + "^" * 38))


def test_a_slip_is_one_even_beside_a_node_that_crashed() -> None:
    found = findings_of("""
        <launch>
          <node pkg="p" type="t" name="a"/>
          <node pkg="p" type="t" name="b"/>
          <node pkg="p" type="t" name="c"/>
        </launch>
        //- interfaces
        {"/a": {"subscribers": {"chater": "std_msgs/String"}}, "/b": {"publishers": {"chatter": "std_msgs/String"}},
         "/c": {"status": "crashed", "exit_code": 1}}
    """)
    (near,) = (each for each in found if each.rule == "TOP001")
    assert near.fixes


def test_names_that_are_not_resolved_are_not_missing() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="a"/>
        </launch>
        //- interfaces
        {"/a": {"subscribers": {"/$(arg quad_name)/control_command": "std_msgs/String"},
                "publishers": {"/$(arg quad_name)/out": "std_msgs/String"}}}
    """)
