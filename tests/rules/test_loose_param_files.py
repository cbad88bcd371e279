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


@pytest.mark.parametrize("mark", ["ros_parameters", "ros__parameter", "ros__paramters", "ros_params"])
def test_a_slip_of_the_mark(tmp_path: Path, mark: str) -> None:
    (finding,) = of_files(tmp_path, "PRM012", config=f"camera:\n  {mark}:\n    rate: 30\n")
    assert [fix.title for fix in finding.fixes] == [f"Replace '{mark}' with 'ros__parameters'"]


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


DRIVER = """
    import rclpy
    from rclpy.node import Node

    class Driver(Node):
        def __init__(self):
            super().__init__("driver")
            self.declare_parameter("wheel_radius", 0.1)
            self.declare_parameter("frame_id", "base_link")
            self.declare_parameter("gains.kp", 1.0)

    def main():
        rclpy.init()
        rclpy.spin(Driver())
"""
SETUP = """
    from setuptools import setup
    setup(name="p", packages=["p"], entry_points={"console_scripts": ["driver = p.driver:main"]})
"""
OTHER = '<launch><node pkg="p" exec="driver" name="left_wheel"/></launch>'


def of_nodes(folder: Path, config: str, launch: str = "<launch/>", depends: str = "") -> list[str]:
    """What is said of a parameter file that no launch gives to a node."""
    harness = PythonHarness(folder)
    harness.write("p/__init__.py", "")
    harness.write("p/driver.py", DRIVER)
    harness.write("setup.py", SETUP)
    harness.write("launch/a.launch.xml", launch)
    path = str(harness.write("config/wheels.yaml", config))
    depend = f"<exec_depend>{depends}</exec_depend>" if depends else ""
    harness.write("package.xml", MANIFEST.format("p").replace("<export>", f"{depend}<export>"))
    environment = detect_environment(None, {"ROS_VERSION": "2", "ROS_DISTRO": "jazzy"}, (str(folder / "src"),))
    workspace = Workspace(environment, Sources())
    of_file, _ = workspace.findings_of_file(path, "parameter file")
    analysis = workspace.static(str(harness.package / "launch/a.launch.xml"))
    of_launch = [each for each, _ in workspace.branches(analysis).findings if each.location.file == path]
    assert [each.message for each in of_launch] == [each.message for each in of_file]
    assert not [one for each in of_file for one in each.related if one.location.file not in {path}]
    return [f"{each.severity} {each.rule} {each.message}" for each in of_file]


@pytest.mark.parametrize(
    ("param", "said"),
    [
        ("wheel_radius: 1", "warning PRM014 type mismatch of parameter 'wheel_radius': got an integer"),
        ("wheel_radius: 0,1", "warning PRM014 type mismatch of parameter 'wheel_radius': got a string"),
        ("wheel_radus: 0.1", "warning PRM013 parameter 'wheel_radus' is not declared by /driver"),
        ("kp: 0.1", "warning PRM013 parameter 'kp' is not declared by /driver; its value is ignored; did you mean "
         "'gains.kp'?"),
    ],
)  # fmt: skip
@pytest.mark.parametrize(("section", "launch"), [("driver", "<launch/>"), ("left_wheel", OTHER)])
def test_what_the_node_of_a_section_would_make_of_it(
    tmp_path: Path, param: str, said: str, section: str, launch: str
) -> None:
    """The node is that which a launch file starts under the name, or the executable that is called so."""
    (found,) = of_nodes(tmp_path, f"{section}:\n  ros__parameters:\n    {param}\n    frame_id: odom\n", launch)
    assert found.startswith(said.replace("/driver", f"/{section}"))


def test_nodes_of_packages_that_it_depends_on(tmp_path: Path) -> None:
    config = "amcl:\n  ros__parameters:\n    alpha1: 1\n    max_beam: 60\n"
    found = of_nodes(tmp_path, config, depends="nav2_amcl")
    assert {each.partition(";")[0] for each in found} == {
        "warning PRM014 type mismatch of parameter 'alpha1': got an integer, /amcl declares a double",
        "warning PRM013 parameter 'max_beam' is not declared by /amcl",
    }


def test_controllers(tmp_path: Path) -> None:
    config = (
        "controller_manager:\n  ros__parameters:\n    base: {type: mecanum_drive_controller/MecanumDriveController}\n"
        "base:\n  ros__parameters:\n    kinematics.wheel_radius: 0.05\n"
    )
    (found,) = of_nodes(tmp_path, config)
    assert found.startswith("warning PRM013 parameter 'kinematics.wheel_radius' is not declared by /base")


@pytest.mark.silent
@pytest.mark.parametrize(
    ("section", "param"),
    [
        ("driver", "wheel_radius: <WHEEL_RADIUS>"),  # ReplaceString writes it
        ("driver", "wheel_radius: 0.2"),
        ("driver", "of_another: 0.2"),
        ("somebody", "wheel_radius: 1"),
        ("/**", "wheel_radius: 1"),
    ],
)
def test_parameters_of_which_nothing_is_wrong_for_sure(tmp_path: Path, section: str, param: str) -> None:
    assert not of_nodes(tmp_path, f"{section}:\n  ros__parameters:\n    {param}\n")


@pytest.mark.silent
def test_a_name_that_several_programs_have(tmp_path: Path) -> None:
    launch = OTHER.replace("</launch>", '<node pkg="other" exec="x" name="left_wheel"/></launch>')
    assert not of_nodes(tmp_path, "left_wheel:\n  ros__parameters:\n    wheel_radius: 1\n", launch)
