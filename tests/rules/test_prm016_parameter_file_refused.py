"""PRM016: a parameter file that is YAML and that rcl refuses (ROS 2)."""

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import check
from support.python_launch_harness import MANIFEST, PythonHarness


def test_what_a_parameter_file_cannot_have() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a"><param from="/a.yaml"/></node>
          <node_container pkg="p" exec="c" name="c" namespace="">
            <composable_node pkg="p" plugin="p::D" name="d" namespace="/b"><param from="/d.yaml"/></composable_node>
          </node_container>
        </launch>
        //- /d.yaml
        /b:
          /d:
            ros__parameters: {x: 1}
        //- /a.yaml
        a:
          ros__parameters:
            gains: [1, 2.5]
                   ^^^^^^^^ error[PRM016] a list with doubles and integers in it: 'gains'; rcl refuses the whole file,
            grid: [[1, 2], [3, 4]]
                  ^^^^^^^^^^^^^^^^ error[PRM016] a list of lists: 'grid'
            tilde: ~
            fine: [1.0, 2.5]
        /b:
        ^^ error[PRM016] a node's name with two slashes: '/b//c'
          /c:
            ros__parameters: {x: 1}
    """)


def test_one_bad_value_stops_each_node_that_gets_the_file() -> None:
    """As real rclpy has it: `tests/evaluation/test_types_against_rclpy.py`."""
    findings = check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a"><param from="/a.yaml"/></node>
          <node pkg="p" exec="b" name="b"><param from="/a.yaml"/></node>
          <node pkg="p" exec="c" name="c"><param name="axes" value="[x, y, z]"/></node>
                                                       ^^^^ error[PRM016] parameter 'axes' arrives as a list with
          <node pkg="p" exec="d" name="d"><param name="axes" value="[a, b]"/></node>
        </launch>
        //- /a.yaml
        a:
          ros__parameters:
            axes: [x, y, z]
                  ^^^^^^^^^ error[PRM016] a list with bools and texts in it: 'axes'; rcl refuses the whole file, and
            quoted: [x, "y", z]
        b:
          ros__parameters: {rate: 1}
    """)
    (of_file,) = (finding for finding in findings if finding.location.file == "/a.yaml")
    assert [each.message for each in of_file.related] == ["/a gets the file here", "/b gets the file here"]


def test_a_parameter_file_whose_substitutions_launch_makes() -> None:
    """What they come to is not in the text: `[$(var a), 2.5]` is a list of doubles, and a key may become any name."""
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="gain" default="1.5"/>
          <arg name="name" default="arm"/>
          <node pkg="p" exec="arm" name="$(var name)">
            <param from="/named.yaml" allow_substs="true"/>
            <param from="/gains.yaml" allow_substs="true"/>
          </node>
        </launch>
        //- /named.yaml
        $(var name):
          ros__parameters:
            gains: [$(var gain), 2.5]
        //- /gains.yaml
        arm:
          ros__parameters:
            offsets: [1, 2.5]
                     ^^^^^^^^ error[PRM016] a list with doubles and integers in it: 'offsets'
    """)


def test_a_substitution_in_a_parameter_file_that_nobody_makes() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="arm" name="arm"><param from="/gains.yaml"/></node>
        </launch>
        //- /gains.yaml
        arm:
          ros__parameters:
            gains: [$(var gain), 2.5]
                   ^^^^^^^^^^^^^^^^^^ error[PRM016] a list with doubles and texts in it: 'gains'
                    ^^^^^^^^^^^ warning[LCH029] '$(var gain)' is treated as literal text; substitutions in YAML need
    """)


@pytest.mark.silent
def test_values_that_a_parameter_file_can_have() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a"><param from="/a.yaml"/></node>
        </launch>
        //- /a.yaml
        /ns/b:
          ros__parameters: {x: 1}
        a:
          ros__parameters:
            gains: [1.0, 2.5]
            names: [x, "z"]
            tilde: ~
            nested: {rate: 1}
    """)


def _of_files(folder: Path, **files: str) -> list[Finding]:
    harness = PythonHarness(folder)
    for name, text in files.items():
        harness.write(f"{name}/camera.yaml", text)
    path = str(harness.write("launch/a.launch.xml", '<launch><node pkg="p" exec="x" name="camera"/></launch>'))
    harness.write("package.xml", MANIFEST.format("p"))
    workspace = Workspace(detect_environment(None, {"ROS_VERSION": "2"}, (str(folder / "src"),)), Sources())
    return [each for each, _ in workspace.branches(workspace.static(path)).findings if each.rule == "PRM016"]


BAD = "camera:\n  ros__parameters:\n    gains: [1, 2.5]\n"


def test_a_file_that_no_node_gets(tmp_path: Path) -> None:
    (finding,) = _of_files(tmp_path, config=BAD, test=BAD, docs=BAD)
    assert (finding.severity, finding.confidence) == ("warning", "likely")
    assert finding.location.file == str(tmp_path / "src/p/config/camera.yaml")


@pytest.mark.silent
def test_a_file_of_something_else(tmp_path: Path) -> None:
    assert not _of_files(
        tmp_path, config="rate: 30\ngains: [1, 2.5]\n", params="camera: {ros__parameters: {rate: 1}}\n"
    )
    assert not _of_files(tmp_path / "more", config=BAD + "    path: $(find-pkg-share p)\n")
