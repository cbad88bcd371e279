"""Rules about packages of ROS 2 that were never built: what their build files say that will be installed."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

SETUP = """import os
from glob import glob
from setuptools import find_packages, setup

package_name = 'robot'

setup(
    name=package_name,
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        (os.path.join('share', package_name, 'launch'), glob('launch/*.launch.*')),
        ('share/robot/params', ['config/renamed.yaml']),
    ],
    entry_points={'console_scripts': ['driver = robot.driver:main']},
)
"""
LAUNCH = """<launch>
  <node pkg="robot" exec="driver" name="driver">
    <param from="$(find-pkg-share robot)/config/driver.yaml"/>
    <param from="$(find-pkg-share robot)/params/renamed.yaml"/>
  </node>
  <node pkg="robot" exec="drivr" name="other"/>
  <node pkg="arm" exec="arm_node" name="arm">
    <param from="$(find-pkg-share arm)/config/arm.yaml"/>
    <param from="$(find-pkg-share arm)/cfg/arm.yaml"/>
  </node>
  <node pkg="arm" exec="helper.py" name="helper"/>
</launch>
"""
CMAKE = """cmake_minimum_required(VERSION 3.8)
project(arm)
find_package(ament_cmake REQUIRED)
add_executable(${PROJECT_NAME}_node src/arm.cpp)
install(TARGETS ${PROJECT_NAME}_node DESTINATION lib/${PROJECT_NAME})
install(PROGRAMS scripts/helper.py DESTINATION lib/${PROJECT_NAME})
install(DIRECTORY config DESTINATION share/${PROJECT_NAME})
ament_package()
"""


def manifest(name: str, build_type: str) -> str:
    uses = "<exec_depend>arm</exec_depend>" if name == "robot" else ""
    return f"<package><name>{name}</name>{uses}<export><build_type>{build_type}</build_type></export></package>"


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    files = {
        "robot/package.xml": manifest("robot", "ament_python"),
        "robot/setup.py": SETUP,
        "robot/robot/__init__.py": "",
        "robot/robot/driver.py": "def main():\n    pass\n",
        "robot/config/driver.yaml": "/driver:\n  ros__parameters:\n    rate: 10\n",
        "robot/config/renamed.yaml": "driver:\n  ros__parameters:\n    name: front\n",
        "robot/launch/robot.launch.xml": LAUNCH,
        "arm/package.xml": manifest("arm", "ament_cmake"),
        "arm/CMakeLists.txt": CMAKE,
        "arm/src/arm.cpp": "int main() {}\n",
        "arm/scripts/helper.py": "",
        "arm/config/arm.yaml": "arm:\n  ros__parameters: {a: 1}\n",
        "arm/cfg/arm.yaml": "arm:\n  ros__parameters: {b: 1}\n",
    }
    for name, text in files.items():
        path = tmp_path / "src" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return tmp_path


def findings(workspace: Path, *, renamed: bool = True) -> list[Finding]:
    environment = detect_environment(str(workspace), {}, root=str(workspace / "nothing"))
    root = workspace / "src/robot/launch/robot.launch.xml"
    analysis = Workspace(environment, Sources()).static(str(root))
    driver = analysis.tree.nodes[0]
    params = {param.name: param.value for param in driver.params}
    assert params == ({"rate": 10, "name": "front"} if renamed else {"rate": 10})
    assert driver.resolved.entry_point == "robot.driver:main"
    return [f for f in analysis.findings if f.rule.startswith("PKG")]


def test_what_is_not_installed_and_what_is_not_there(workspace: Path) -> None:
    found = {(f.rule, f.severity): f for f in findings(workspace) if f.rule == "PKG002"}
    assert set(found) == {("PKG002", "error"), ("PKG002", "info")}
    assert "no executable 'drivr'" in found["PKG002", "error"].message
    assert "did you mean 'driver'?" in found["PKG002", "error"].message
    assert "'arm_node' is not built yet" in found["PKG002", "info"].message
    missing = [f.message for f in findings(workspace) if f.rule == "PKG005"]
    assert missing == [
        "'config/driver.yaml' is in the source of package 'robot', but its setup.py does not install it",
        "'cfg/arm.yaml' is in the source of package 'arm', but its CMakeLists.txt does not install it",
    ]


def test_the_fixes_install_it(workspace: Path) -> None:
    for finding in findings(workspace):
        if finding.rule == "PKG005":
            (edit,) = finding.fixes[0].edits
            path = Path(edit.location.file)
            text, span = path.read_text(), edit.location.span
            path.write_text(text[: span.start] + edit.text + text[span.end :])
    setup = (workspace / "src/robot/setup.py").read_text()
    assert "        ('share/robot/config', ['config/driver.yaml']),\n    ]," in setup
    compile(setup, "setup.py", "exec")
    assert [f.rule for f in findings(workspace)].count("PKG005") == 0


def test_nothing_is_said_where_the_build_files_do_more_than_is_understood(workspace: Path) -> None:
    setup = workspace / "src/robot/setup.py"
    setup.write_text(SETUP.replace("    data_files=[", "    data_files=more_of_it() + ["))
    (workspace / "src/arm/CMakeLists.txt").unlink()
    found = [f.rule for f in findings(workspace, renamed=False)]
    assert found == ["PKG002"], "an executable that no entry point makes"


SHARE = "share/${PROJECT_NAME}"


@pytest.mark.parametrize(
    ("rules", "said"),
    [
        (f"install(DIRECTORY launch config DESTINATION {SHARE})", []),
        ("ament_auto_package(INSTALL_TO_SHARE launch config)", []),
        (
            f"install(DIRECTORY launch/ config DESTINATION {SHARE})",
            [
                "'launch/arm.launch.xml' is in the source of package 'arm', but its CMakeLists.txt installs it as "
                "'arm.launch.xml'"
            ],
        ),
        (
            f"install(DIRECTORY launch DESTINATION share)\ninstall(DIRECTORY config/ DESTINATION {SHARE}/config)",
            [
                "'launch/bringup.launch.xml' is not installed by the CMakeLists.txt of package 'arm': "
                "`ros2 launch arm bringup.launch.xml` does not find it",
                "'launch/arm.launch.xml' is in the source of package 'arm', but its CMakeLists.txt does not install it",
            ],
        ),
        (
            f"install(DIRECTORY launch DESTINATION {SHARE})",
            ["'config/arm.yaml' is in the source of package 'arm', but its CMakeLists.txt does not install it"],
        ),
        (f"install(DIRECTORY launch DESTINATION {SHARE})\ngenerate_dcf(config)", []),
    ],
)
def test_where_it_is_installed(tmp_path: Path, rules: str, said: list[str]) -> None:
    folder = tmp_path / "src" / "arm"
    files = {
        "package.xml": manifest("arm", "ament_cmake"),
        "CMakeLists.txt": f"project(arm)\n{rules}\nament_package()\n",
        "config/arm.yaml": "arm:\n  ros__parameters: {a: 1}\n",
        "launch/arm.launch.xml": "<launch/>",
        "launch/bringup.launch.xml": """<launch>
          <include file="$(find-pkg-share arm)/launch/arm.launch.xml"/>
          <node pkg="arm" exec="arm" name="arm"><param from="$(find-pkg-share arm)/config/arm.yaml"/></node>
        </launch>""",
    }
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    workspace = Workspace(detect_environment(str(tmp_path), {}), Sources(), str(tmp_path))
    findings = workspace.static(str(folder / "launch/bringup.launch.xml"), {}).findings
    found = [finding for finding in findings if finding.rule == "PKG005"]
    assert [finding.message for finding in found] == said
    for edit in (fix.edits[0] for finding in found for fix in finding.fixes):
        installed = f"install(DIRECTORY {'config' if 'config' in said[0] else 'launch'} DESTINATION {SHARE})\n\n"
        assert edit.text == installed


COMPONENTS = """cmake_minimum_required(VERSION 3.8)
project(vision)
add_library(detector SHARED src/detector.cpp)
rclcpp_components_register_nodes(detector "vision::Detector" "vision::Tracker")
ament_package()
"""
LOADS = """<launch>
  <node_container pkg="vision" exec="component_container" name="box" namespace="">
    <composable_node pkg="vision" plugin="vision::Detector" name="a"/>
    <composable_node pkg="vision" plugin="Tracker" name="b"/>
    <composable_node pkg="vision" plugin="vision::Segmentation" name="c"/>
  </node_container>
</launch>
"""


def test_a_component_that_is_not_registered(tmp_path: Path) -> None:
    folder = tmp_path / "src" / "vision"
    (folder / "launch").mkdir(parents=True)
    (folder / "package.xml").write_text(manifest("vision", "ament_cmake"))
    (folder / "CMakeLists.txt").write_text(COMPONENTS)
    launch = folder / "launch" / "box.launch.xml"
    launch.write_text(LOADS)
    workspace = Workspace(detect_environment(str(tmp_path), {}), Sources(), str(tmp_path))
    findings = [f for f in workspace.static(str(launch), {}).findings if f.rule == "PKG006"]
    assert [(f.severity, f.message) for f in findings] == [
        (
            "error",
            "package 'vision' registers no component 'Tracker'; it registers 2; did you mean 'vision::Tracker'?",
        ),
        ("warning", "package 'vision' registers no component 'vision::Segmentation'; it registers 2"),
    ]


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
    assert [(f.severity, f.message.partition(" is ")[0]) for f in findings] == [("info", "package 'nowhere_known'")]


def test_launch_files_of_installed_packages_are_not_judged_by_their_manifests(workspace: Path) -> None:
    prefix = workspace / "install" / "nav"
    for name in ("nav", "map_server"):
        (prefix / "share/ament_index/resource_index/packages").mkdir(parents=True, exist_ok=True)
        (prefix / "share/ament_index/resource_index/packages" / name).touch()
        (prefix / "share" / name).mkdir()
    included = prefix / "share/nav/nav.launch.xml"
    included.write_text('<launch><node pkg="map_server" exec="map_server" name="map"/></launch>')
    root = workspace / "src/robot/launch/all.launch.xml"
    root.write_text('<launch><include file="$(find-pkg-share nav)/nav.launch.xml"/></launch>')
    environment = detect_environment(str(workspace), {}, root=str(workspace / "nothing"))
    analysis = Workspace(environment, Sources()).static(str(root))
    assert str(included) in analysis.tree.files
    places = [f.location.file for f in analysis.findings if f.rule == "PKG004"]
    assert places == [str(root)], "robot's own package.xml does not name nav"


def test_a_package_that_a_python_launch_file_finds_by_a_function(workspace: Path) -> None:
    (workspace / "src/camera/launch").mkdir(parents=True)
    (workspace / "src/camera/package.xml").write_text("<package><name>camera</name></package>")
    root = workspace / "src/robot/launch/all.launch.py"
    text = """
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.substitutions import PathJoinSubstitution

def generate_launch_description():
    path = PathJoinSubstitution([get_package_share_directory("camera"), "launch", "camera.launch.py"])
    own = PathJoinSubstitution([get_package_share_directory("robot"), get_package_share_directory("arm")])
    return LaunchDescription([IncludeLaunchDescription(path), IncludeLaunchDescription(own)])
"""
    root.write_text(text)
    environment = detect_environment(str(workspace), {}, root=str(workspace / "nothing"))
    findings = Workspace(environment, Sources()).static(str(root)).findings
    (found,) = (finding for finding in findings if finding.rule == "PKG004")
    assert "'camera'" in found.message
    assert text[found.location.span.start : found.location.span.end] == "camera"
