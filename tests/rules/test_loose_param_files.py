"""Parameter files of a package that no node of any launch gets (ROS 2)."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.python_launch_harness import MANIFEST, PythonHarness

UNMARKED = "camera:\n  ros__parameters: {rate: 30}\nother:\n  rate: 30\n"
MIXED = "camera:\n  ros__parameters:\n    gains: [1, 2.5]\n"
EACH = pytest.mark.parametrize(("rule", "bad"), [("PRM012", UNMARKED), ("PRM016", MIXED)])


def of_files(folder: Path, rule: str, **files: str) -> list[Finding]:
    """The findings of a rule in files `camera.yaml` of a package, by their folders."""
    harness = PythonHarness(folder)
    for name, text in files.items():
        harness.write(f"{name}/camera.yaml", text)
    path = str(harness.write("launch/a.launch.xml", '<launch><node pkg="p" exec="x" name="camera"/></launch>'))
    harness.write("package.xml", MANIFEST.format("p"))
    workspace = Workspace(detect_environment(None, {"ROS_VERSION": "2"}, (str(folder / "src"),)), Sources())
    return [each for each, _ in workspace.branches(workspace.static(path)).findings if each.rule == rule]


@EACH
def test_a_file_that_no_node_gets(tmp_path: Path, rule: str, bad: str) -> None:
    (finding,) = of_files(tmp_path, rule, config=bad, test=bad, docs=bad)
    assert (finding.severity, finding.confidence) == ("warning", "likely")
    assert finding.location.file == str(tmp_path / "src/p/config/camera.yaml")


@pytest.mark.silent
@EACH
def test_a_file_of_something_else(tmp_path: Path, rule: str, bad: str) -> None:
    fine = "camera: {ros__parameters: {rate: 1}}\n"
    assert not of_files(tmp_path, rule, config="rate: 30\ngains: [1, 2.5]\n", params=fine)
    assert not of_files(tmp_path / "more", rule, config=bad + "    path: $(find-pkg-share p)\n")


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
    assert (not of_files(tmp_path, "PRM012", config=UNMARKED)) == silent
