"""PRM012: values of a parameter file that stand below no `ros__parameters` (ROS 2)."""

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import check
from support.python_launch_harness import MANIFEST, PythonHarness


def test_values_above_the_mark() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a"><param from="/a.yaml"/></node>
        </launch>
        //- /a.yaml
        a:
          rate: 30
          ^^^^ error[PRM012] parameter 'rate' is not below 'ros__parameters'; rcl refuses the whole file
          name: front
    """)


@pytest.mark.silent
def test_a_component_takes_a_file_without_the_mark() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node_container pkg="p" exec="x" name="c" namespace="">
            <composable_node pkg="p" plugin="p::A" name="a"><param from="/a.yaml"/></composable_node>
          </node_container>
        </launch>
        //- /a.yaml
        rate: 30
        //- interfaces
        {"/a": {"params": {"~rate": 1}}}
    """)


@pytest.mark.silent
def test_a_component_takes_the_sections_of_a_file() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node_container pkg="p" exec="x" name="c" namespace="">
            <composable_node pkg="p" plugin="p::A" name="a"><param from="/a.yaml"/></composable_node>
          </node_container>
        </launch>
        //- /a.yaml
        x-common: {rate: 30}
        a: {ros__parameters: {rate: 1}}
        //- interfaces
        {"/a": {"params": {"~rate": 1}}}
    """)


def _of_files(folder: Path, **files: str) -> list[Finding]:
    harness = PythonHarness(folder)
    for name, text in files.items():
        harness.write(f"{name}/camera.yaml", text)
    path = str(harness.write("launch/a.launch.xml", '<launch><node pkg="p" exec="x" name="camera"/></launch>'))
    harness.write("package.xml", MANIFEST.format("p"))
    workspace = Workspace(detect_environment(None, {"ROS_VERSION": "2"}, (str(folder / "src"),)), Sources())
    return [each for each, _ in workspace.branches(workspace.static(path)).findings if each.rule == "PRM012"]


BAD = "camera:\n  ros__parameters: {rate: 30}\nother:\n  rate: 30\n"


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


@pytest.mark.parametrize(
    ("program", "silent"),
    [
        ("yaml.safe_load(open(SHARE + '/config/camera.yaml'))", True),
        ("YAML = SHARE + '/config/camera.yaml'", False),
        ("yaml.safe_load(open(SHARE + '/config/lidar.yaml'))", False),
    ],
)
def test_a_file_that_a_program_reads_itself(tmp_path: Path, program: str, silent: bool) -> None:
    PythonHarness(tmp_path).write("p/run.py", program)
    assert (not _of_files(tmp_path, config=BAD)) == silent
