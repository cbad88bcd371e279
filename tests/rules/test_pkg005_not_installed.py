"""PKG005: a file of the source that the package does not install."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.packaging import CMAKE, LISTS, lay_out, said
from support.unbuilt_packages import SETUP, findings, manifest


def test_what_is_not_installed_and_what_is_not_there(workspace: Path) -> None:
    found = {(f.rule, f.severity): f for f in findings(workspace) if f.rule == "PKG002"}
    assert set(found) == {("PKG002", "error"), ("PKG002", "hint")}
    assert "executable 'drivr' not found" in found["PKG002", "error"].message
    assert "did you mean 'driver'?" in found["PKG002", "error"].message
    assert "'arm_node' is not built yet" in found["PKG002", "hint"].message
    missing = [f.message for f in findings(workspace) if f.rule == "PKG005"]
    assert missing == [
        "file 'config/driver.yaml' is not installed in the share folder: setup.py of 'robot' does not list it",
        "file 'cfg/arm.yaml' is not installed in the share folder: CMakeLists.txt of 'arm' does not list it",
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


@pytest.mark.silent
def test_nothing_is_said_where_the_build_files_do_more_than_is_understood(workspace: Path) -> None:
    setup = workspace / "src/robot/setup.py"
    text = SETUP.replace("    data_files=[", "    data_files=more_of_it() + [")
    setup.write_text(f"from more import more_of_it\n{text}")
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
                "file 'launch/arm.launch.xml' is not installed in the share folder: CMakeLists.txt of 'arm' "
                "installs it as 'arm.launch.xml'"
            ],
        ),
        (
            f"install(DIRECTORY launch DESTINATION share)\ninstall(DIRECTORY config/ DESTINATION {SHARE}/config)",
            [
                "launch file 'launch/bringup.launch.xml' is not installed by CMakeLists.txt of 'arm': "
                "`ros2 launch arm bringup.launch.xml` does not find it",
                "file 'launch/arm.launch.xml' is not installed in the share folder: CMakeLists.txt of 'arm' "
                "does not list it",
            ],
        ),
        (
            f"install(DIRECTORY launch DESTINATION {SHARE})",
            ["file 'config/arm.yaml' is not installed in the share folder: CMakeLists.txt of 'arm' does not list it"],
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


@pytest.mark.silent
def test_a_package_within_another_one(tmp_path: Path) -> None:
    files = {
        "package.xml": manifest("robot", "ament_cmake"),
        "CMakeLists.txt": "project(robot)\nament_package()\n",
        "src/arm/package.xml": manifest("arm", "ament_cmake"),
        "src/arm/launch/inner.launch.xml": "<launch/>",
        "src/arm/launch/arm.launch.xml": """<launch>
          <include file="$(find-pkg-share robot)/src/arm/launch/inner.launch.xml"/>
        </launch>""",
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    workspace = Workspace(detect_environment(str(tmp_path), {}), Sources(), str(tmp_path))
    findings = workspace.static(str(tmp_path / "src/arm/launch/arm.launch.xml"), {}).findings
    assert not [finding for finding in findings if finding.rule == "PKG005"]


def test_a_copy_of_a_launch_file_that_was_put_aside(workspace: Path) -> None:
    launch = workspace / "src/robot/launch/robot.launch_original.xml"
    launch.write_text("<launch/>")
    environment = detect_environment(str(workspace), {}, root=str(workspace / "nothing"))
    found = Workspace(environment, Sources()).static(str(launch)).findings
    assert [(f.rule, f.severity) for f in found if f.rule == "PKG005"] == [("PKG005", "info")]


RVIZ = """<launch>
  <node pkg="rviz2" exec="rviz2" args="-d $(find-pkg-share arm)/rviz/arm.rviz"/>
  <node pkg="arm" exec="driver"><param name="map" value="$(find-pkg-share arm)/maps/hall.yaml"/></node>
</launch>
"""
URDF = """<robot name="arm"><link name="base"><visual><geometry>
  <mesh filename="package://arm/meshes/base.stl"/>
  <mesh filename="package://arm/meshes/${side}.stl"/>
</geometry></visual></link></robot>
"""
OPENED = {
    "rviz/arm.rviz": "",
    "maps/hall.yaml": "",
    "meshes/base.stl": "",
    "urdf/arm.urdf": URDF,
    "launch/arm.launch.xml": RVIZ,
}


def test_what_nodes_and_descriptions_open(tmp_path: Path) -> None:
    lacks = "is not installed in the share folder: CMakeLists.txt of 'arm' does not list it"
    assert said(tmp_path, {**CMAKE, **OPENED}, "PKG005") == [
        f"launch/arm.launch.xml:2 warning file 'rviz/arm.rviz' {lacks}",
        f"launch/arm.launch.xml:3 warning file 'maps/hall.yaml' {lacks}",
        f"urdf/arm.urdf:2 warning file 'meshes/base.stl' {lacks}",
    ]


@pytest.mark.silent
@pytest.mark.parametrize(
    "lists",
    [
        LISTS.replace("DIRECTORY launch", "DIRECTORY launch maps meshes rviz"),
        LISTS.replace("DIRECTORY launch", "DIRECTORY launch maps rviz").replace(
            "ament_p", "install(FILES meshes/base.stl DESTINATION share/arm/meshes)\nament_p"
        ),
        LISTS.replace("ament_p", "install_the_rest()\nament_p"),
    ],
)
def test_what_is_opened_and_installed(tmp_path: Path, lists: str) -> None:
    assert said(tmp_path, {**CMAKE, **OPENED, "CMakeLists.txt": lists}, "PKG005") == []


CATKIN = {
    "package.xml": CMAKE["package.xml"].replace("ament_cmake", "catkin"),
    "CMakeLists.txt": """project(arm)
find_package(catkin REQUIRED)
catkin_package()
install(DIRECTORY launch DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
catkin_install_python(PROGRAMS scripts/report.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
""",
    "config/a.yaml": "a: 1\n",
    "config/b.yaml": "b: 1\n",
    "scripts/report.py": "#!/usr/bin/env python3\n",
    "scripts/drive.py": "#!/usr/bin/env python3\n",
    "launch/arm.launch.xml": """<launch>
  <rosparam command="load" file="$(find arm)/config/a.yaml"/>
  <rosparam command="load" file="$(find arm)/config/b.yaml"/>
  <node pkg="arm" type="drive.py" name="drive"/>
</launch>
""",
}
ONLY = "it is found in the devel space only"


def test_of_catkin(tmp_path: Path) -> None:
    (lay_out(tmp_path, CATKIN) / "scripts/drive.py").chmod(0o755)
    assert said(tmp_path, CATKIN, "PKG005") == [
        "launch/arm.launch.xml:2 info file 'config/a.yaml' is not installed: CMakeLists.txt of 'arm' installs other "
        f"files, not this one; {ONLY}",
        "launch/arm.launch.xml:4 info script 'scripts/drive.py' is not installed: CMakeLists.txt of 'arm' installs "
        f"other scripts, not this one; {ONLY}",
    ]


@pytest.mark.silent
@pytest.mark.parametrize(
    "lists",
    [
        CATKIN["CMakeLists.txt"].replace("launch", "launch config").replace("report.py", "report.py scripts/drive.py"),
        "project(arm)\nfind_package(catkin REQUIRED)\ncatkin_package()\n",
        CATKIN["CMakeLists.txt"] + "install_all_of_it()\n",
    ],
)
def test_nothing_of_catkin(tmp_path: Path, lists: str) -> None:
    assert said(tmp_path, {**CATKIN, "CMakeLists.txt": lists}, "PKG005") == []
