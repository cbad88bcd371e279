"""Packages of ROS 2 that were never built, and what the rules say of their launch file."""

from __future__ import annotations

from pathlib import Path

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
    """A package.xml."""
    uses = "<exec_depend>arm</exec_depend>" if name == "robot" else ""
    return f"<package><name>{name}</name>{uses}<export><build_type>{build_type}</build_type></export></package>"


def create_unbuilt_packages(folder: Path) -> Path:
    """The packages `robot`, with setup.py, and `arm`, with CMakeLists.txt, in `src`; the workspace."""
    files = {
        "robot/package.xml": manifest("robot", "ament_python"),
        "robot/setup.py": SETUP,
        "robot/setup.cfg": "[install]\ninstall_scripts=$base/lib/robot\n",
        "robot/resource/robot": "",
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
        path = folder / "src" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder


def findings(workspace: Path, *, renamed: bool = True) -> list[Finding]:
    """Those of the rules about packages, in the launch file of `robot`. `renamed`: its second file is installed."""
    environment = detect_environment(str(workspace), {}, root=str(workspace / "nothing"))
    root = workspace / "src/robot/launch/robot.launch.xml"
    analysis = Workspace(environment, Sources()).static(str(root))
    driver = analysis.tree.nodes[0]
    params = {param.name: param.value for param in driver.params}
    assert params == ({"rate": 10, "name": "front"} if renamed else {"rate": 10})
    assert driver.resolved.entry_point == "robot.driver:main"
    return [f for f in analysis.findings if f.rule.startswith("PKG")]
