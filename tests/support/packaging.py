"""One package of ROS 2 with a launch file, and what a rule says of how it is built."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

from support.unbuilt_packages import manifest

SETUP = """from glob import glob
from setuptools import find_packages, setup

package_name = 'arm'
setup(
    name=package_name,
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        ('share/' + package_name + '/launch', glob('launch/*')),
    ],
    entry_points={
        'console_scripts': [
            'driver = arm.driver:main',
            'planner = arm.planner:main',
        ],
    },
)
"""
"""Of a package in which nothing is wrong."""
CFG = "[develop]\nscript_dir=$base/lib/arm\n[install]\ninstall_scripts=$base/lib/arm\n"
LAUNCH = "<launch/>"
PYTHON = {
    "package.xml": manifest("arm", "ament_python").replace("</name>", "</name><exec_depend>rclpy</exec_depend>"),
    "setup.py": SETUP,
    "setup.cfg": CFG,
    "resource/arm": "",
    "arm/__init__.py": "",
    "arm/driver.py": "import rclpy\n\n\ndef main():\n    rclpy.init()\n",
    "arm/planner.py": "def main():\n    pass\n",
    "launch/arm.launch.xml": LAUNCH,
}
LISTS = """cmake_minimum_required(VERSION 3.8)
project(arm)
find_package(ament_cmake REQUIRED)
add_executable(driver src/driver.cpp)
install(TARGETS driver DESTINATION lib/${PROJECT_NAME})
install(PROGRAMS scripts/report.py DESTINATION lib/${PROJECT_NAME})
install(DIRECTORY launch DESTINATION share/${PROJECT_NAME})
ament_package()
"""
SCRIPT = "#!/usr/bin/env python3\nif __name__ == '__main__':\n    print()\n"
CMAKE = {
    "package.xml": manifest("arm", "ament_cmake").replace(
        "</name>", "</name><buildtool_depend>ament_cmake</buildtool_depend>"
    ),
    "CMakeLists.txt": LISTS,
    "src/driver.cpp": "int main() {}\n",
    "scripts/report.py": SCRIPT,
    "launch/arm.launch.xml": LAUNCH,
}


def lay_out(folder: Path, files: Mapping[str, str | None]) -> Path:
    """The package in a workspace; a file that is None is not there. Its folder."""
    package = folder / "src" / "arm"
    for name, text in files.items():
        if text is not None:
            path = package / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
    return package


def findings(folder: Path, files: Mapping[str, str | None], rule: str) -> list[Finding]:
    """What the rule says of the package when its launch file is looked at."""
    package = lay_out(folder, files)
    environment = detect_environment(str(folder), {}, root=str(folder / "nothing"))
    analysis = Workspace(environment, Sources(), str(folder)).static(str(package / "launch/arm.launch.xml"))
    return [finding for finding in analysis.findings if finding.rule == rule]


def said(folder: Path, files: Mapping[str, str | None], rule: str) -> list[str]:
    """Likewise as texts: `file:line severity message`."""
    return [_text(folder, finding) for finding in findings(folder, files, rule)]


def of_packages(folder: Path, files: Mapping[str, str | None], rule: str) -> list[str]:
    """What the rule says of the package, as such texts, where no launch file leads to it."""
    package = lay_out(folder, files)
    environment = detect_environment(str(folder), {}, root=str(folder / "nothing"))
    workspace = Workspace(environment, Sources(), str(folder))
    found, _ = workspace.findings_of_packages([environment.packages[package.name]])
    return [_text(folder, finding) for finding in found if finding.rule == rule]


def _text(folder: Path, finding: Finding) -> str:
    path = Path(finding.location.file)
    line = path.read_text().count("\n", 0, finding.location.span.start) + 1
    return f"{path.relative_to(folder / 'src' / 'arm')}:{line} {finding.severity} {finding.message}"
