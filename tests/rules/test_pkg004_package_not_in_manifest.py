"""PKG004: a package that a launch file needs and the package.xml above it does not name."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.report import by_cause
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import apply, check
from support.packaging import CMAKE, LISTS, PYTHON, findings, of_packages, said
from support.unbuilt_packages import manifest

MANIFEST = """
        //- /robot/package.xml
        <package format="2">
          <name>robot</name>
          <depend>camera</depend>
          <!-- <exec_depend>old</exec_depend> -->
        </package>
        //- /camera/package.xml
        <package/>
        //- /rviz/package.xml
        <package/>
"""


def test_a_package_that_the_manifest_does_not_name() -> None:
    text = (
        """
        //- /robot/launch/robot.launch
        <launch>
          <node pkg="camera" type="driver" name="driver"/>
          <node pkg="robot" type="base" name="base"/>
          <node pkg="rviz" type="rviz" name="rviz" args="$(find rviz)"/>
                     ^^^^ hint[PKG004] package 'rviz' is not a dependency in package.xml of 'robot'
        </launch>"""
        + MANIFEST
    )
    (finding,) = check(text)
    changed = apply(text, finding.fixes[0].edits)["/robot/package.xml"]
    assert "  <depend>camera</depend>\n  <exec_depend>rviz</exec_depend>\n  <!--" in changed


@pytest.mark.parametrize(
    ("file", "head", "line"),
    [
        ("/robot/robot.launch", "<package>", "<run_depend>rviz</run_depend>"),
        ("/robot/robot.launch", '<package format="3">', "<exec_depend>rviz</exec_depend>"),
        ("/robot/test/all.launch", '<package format="2">', "<test_depend>rviz</test_depend>"),
    ],
)
def test_the_first_dependency_of_a_manifest(file: str, head: str, line: str) -> None:
    text = f"""
        //- {file}
        <launch><param name="a" value="$(find rviz)"/></launch>
                                              ^^^^ hint[PKG004]
        //- /robot/package.xml
        {head}
          <name>robot</name>
        </package>
        //- /rviz/package.xml
        <package/>
    """
    (finding,) = check(text)
    assert f"</name>\n  {line}\n</package>" in apply(text, finding.fixes[0].edits)["/robot/package.xml"]


@pytest.mark.silent
def test_a_file_outside_of_any_package_needs_no_manifest() -> None:
    check(
        """
        //- /launch/all.launch
        <launch><node pkg="rviz" type="rviz" name="rviz"/></launch>"""
        + MANIFEST
    )


def test_paths_packages_and_remaps_as_in_ros1() -> None:
    check("""
        //- /p/launch/robot.launch.yaml
        launch:
          - node:
              pkg: camera
                   ^^^^^^ hint[PKG004] package 'camera' is not a dependency in package.xml of 'p'
              exec: driver
              name: $(find-pkg-share lidar)
                    ^^^^^^^^^^^^^^^^^^^^^^^ error[LCH009]
                                     ^^^^^ hint[PKG004] package 'lidar' is not a dependency in package.xml of 'p'
              remap:
                - {from: scan, to: scan}
        //- /p/package.xml
        <package><name>p</name><exec_depend>q</exec_depend></package>
        //- /camera/package.xml
        <package><name>camera</name></package>
        //- /lidar/package.xml
        <package><name>lidar</name></package>
    """)


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
    analysis = Workspace(environment, Sources()).static(str(root))
    (found,) = (finding for finding in analysis.findings if finding.rule == "PKG004")
    assert "'camera'" in found.message
    assert text[found.location.span.start : found.location.span.end] == "camera"


IMPORTS = "import rclpy\nfrom std_msgs.msg import String\nimport numpy\nfrom arm.planner import main\n"


def test_what_modules_import(tmp_path: Path) -> None:
    files = {
        **PYTHON,
        "arm/driver.py": IMPORTS,
        "arm/planner.py": "def main():\n    import sensor_msgs\nimport std_msgs\n",
    }
    assert said(tmp_path, files, "PKG004") == [
        "arm/driver.py:2 info package 'std_msgs' is not a dependency in package.xml of 'arm'"
    ]


USES = '<launch><node pkg="rviz2" exec="rviz2"/><node pkg="{}" exec="relay"/></launch>'
OTHER = "<package><name>{}</name><depend>{}</depend></package>"


@pytest.mark.parametrize(
    ("used", "other", "expected"),
    [
        ("topic_tools", ("hand", "camera"), ["info rviz2", "info topic_tools"]),
        ("topic_tools", ("hand", "topic_tools"), ["info rviz2", "hint topic_tools"]),
        ("hand", ("hand", "rviz2"), ["hint rviz2", "hint hand"]),
    ],
)
def test_what_the_workspace_brings_all_the_same(
    tmp_path: Path, used: str, other: tuple[str, str], expected: list[str]
) -> None:
    (tmp_path / "src" / "hand").mkdir(parents=True)
    (tmp_path / "src" / "hand" / "package.xml").write_text(OTHER.format(*other))
    found = findings(tmp_path, {**PYTHON, "launch/arm.launch.xml": USES.format(used)}, "PKG004")
    assert [f"{each.severity} {each.subject.name}" for each in found] == expected


def test_what_one_manifest_lacks_is_reported_once(tmp_path: Path) -> None:
    files = {**PYTHON, "arm/driver.py": IMPORTS, "launch/arm.launch.xml": USES.format("topic_tools")}
    (report,) = by_cause(findings(tmp_path, files, "PKG004"))
    assert report.message == (
        "3 packages are not dependencies in package.xml of 'arm': 'std_msgs', 'rviz2', 'topic_tools'"
    )


@pytest.mark.silent
def test_imports_of_tests_and_launch_files(tmp_path: Path) -> None:
    files = {**PYTHON, "test/test_arm.py": IMPORTS, "launch/b.launch.py": "import launch_ros\n"}
    assert said(tmp_path, files, "PKG004") == []


def _finds(name: str) -> str:
    return LISTS.replace("(ament_cmake REQUIRED)", f"({name} REQUIRED)")


LEG = "<package><name>leg</name>{}<export><build_type>ament_cmake</build_type></export></package>"


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        (
            {"CMakeLists.txt": _finds("leg")},
            [
                "CMakeLists.txt:3 warning package 'leg' is not a dependency in package.xml of 'arm': the build may "
                "take 'arm' first, and CMake stops"
            ],
        ),
        (
            {"CMakeLists.txt": _finds("sensor_msgs")},
            ["CMakeLists.txt:3 info package 'sensor_msgs' is not a dependency in package.xml of 'arm'"],
        ),
        (
            {"src/driver.cpp": "#include <string>\n  #include <sensor_msgs/msg/imu.hpp>\nint main() {}\n"},
            ["src/driver.cpp:2 info package 'sensor_msgs' is not a dependency in package.xml of 'arm'"],
        ),
        (
            {"CMakeLists.txt": _finds("ament_cmake_python")},
            ["CMakeLists.txt:3 hint package 'ament_cmake_python' is not a dependency in package.xml of 'arm'"],
        ),
        (
            {"srv/Move.srv": "# std_msgs/Header x\ngeometry_msgs/Pose[<=3] goals # where\n---\nbool ok\n"},
            ["srv/Move.srv:2 info package 'geometry_msgs' is not a dependency in package.xml of 'arm'"],
        ),
    ],
)
def test_what_a_build_needs(tmp_path: Path, files: dict[str, str], expected: list[str]) -> None:
    (tmp_path / "src/leg").mkdir(parents=True)
    (tmp_path / "src/leg/package.xml").write_text(LEG.format(""))
    assert of_packages(tmp_path, {**CMAKE, **files}, "PKG004") == expected


def test_the_order_of_a_build_by_way_of_another_package(tmp_path: Path) -> None:
    for name, needs in (("leg", ""), ("hip", "<depend>leg</depend>")):
        (tmp_path / "src" / name).mkdir(parents=True)
        (tmp_path / "src" / name / "package.xml").write_text(LEG.format(needs).replace("leg</name>", f"{name}</name>"))
    text = CMAKE["package.xml"].replace("</name>", "</name><depend>hip</depend>")
    files = {**CMAKE, "package.xml": text, "CMakeLists.txt": _finds("leg")}
    assert of_packages(tmp_path, files, "PKG004") == [
        "CMakeLists.txt:3 hint package 'leg' is not a dependency in package.xml of 'arm'"
    ]


def test_the_components_of_catkin(tmp_path: Path) -> None:
    files = {
        "package.xml": manifest("arm", "catkin").replace("</name>", "</name>\n<depend>roscpp</depend>"),
        "CMakeLists.txt": "project(arm)\nfind_package(catkin REQUIRED COMPONENTS roscpp sensor_msgs)\ncatkin_package()",
    }
    assert of_packages(tmp_path, files, "PKG004") == [
        "CMakeLists.txt:2 info package 'sensor_msgs' is not a dependency in package.xml of 'arm'"
    ]


@pytest.mark.silent
@pytest.mark.parametrize(
    "files",
    [
        {"CMakeLists.txt": _finds("Boost")},
        {"CMakeLists.txt": _finds("nav_msgs").replace("nav_msgs REQUIRED", "nav_msgs QUIET")},
        {"CMakeLists.txt": "if(BUILD_TESTING)\nfind_package(ament_lint_auto REQUIRED)\nendif()\n" + LISTS},
        {"src/driver.cpp": "#include <octomap/octomap.h>\n// #include <nav_msgs/msg/path.hpp>\n"},
        {"src/driver.cpp": "/*\n#include <nav_msgs/msg/path.hpp>\n*/\n#ifdef ROS1\n#include <tf2/a.h>\n#endif\n"},
        {"src/driver.cpp": '#include "angles/angles.h"\n', "include/angles/angles.h": ""},
        {"test/test_arm.cpp": "#include <nav_msgs/msg/path.hpp>\n"},
        {"srv/Move.srv": "arm/Pose goal\nHeader header\n---\n"},
    ],
)
def test_what_is_no_package_of_ros(tmp_path: Path, files: dict[str, str]) -> None:
    assert said(tmp_path, {**CMAKE, **files}, "PKG004") == []
