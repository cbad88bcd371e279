"""PKG: packages and executables."""

from pathlib import Path

import pytest
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import apply, check, findings_of


def test_a_package_that_is_not_there_and_the_nearest_one() -> None:
    text = """
        <launch>
          <node pkg="rospy_tutorial" type="talker" name="n"/>
                     ^^^^^^^^^^^^^^ error[PKG001] did you mean 'rospy_tutorials'?
          <param name="a" value="$(find rospy_tutorial)/x"/>
                                 ^^^^^^^^^^^^^^^^^^^^^^ error[PKG001] is not among the 2 packages
        </launch>
        //- /rospy_tutorials/package.xml
        <package/>
    """
    node, find = check(text)
    assert not node.stops_launch
    assert find.stops_launch
    assert 'pkg="rospy_tutorials"' in apply(text, node.fixes[0].edits)["/main.launch"]
    assert "$(find rospy_tutorials)/x" in apply(text, find.fixes[0].edits)["/main.launch"]


def test_a_package_that_its_folder_names_otherwise() -> None:
    text = """
        <launch>
          <node pkg="robot-master" type="base" name="n"/>
                     ^^^^^^^^^^^^ error[PKG001] the folder /ws/robot-master holds package 'robot'
        </launch>
        //- /ws/robot-master/package.xml
        <package><name>robot</name></package>
    """
    (finding,) = check(text)
    assert 'pkg="robot"' in apply(text, finding.fixes[0].edits)["/main.launch"]


def test_a_package_in_a_tag_that_is_not_taken_is_not_looked_for() -> None:
    check("""
        <launch>
          <arg name="more" default="false"/>
          <node pkg="nowhere" type="t" name="n" if="$(arg more)"/>
          <node pkg="p" type="t" name="m"/>
        </launch>
    """)


def test_a_package_whose_name_is_unknown_is_not_judged() -> None:
    findings = findings_of("""
        <launch>
          <arg name="pkg"/>
          <node pkg="$(arg pkg)" type="t" name="n"/>
        </launch>
    """)
    assert [finding.rule for finding in findings] == ["ARG003"]


@pytest.fixture
def launch(tmp_path: Path) -> Path:
    nodes = tmp_path / "demo" / "nodes"
    nodes.mkdir(parents=True)
    (tmp_path / "demo" / "package.xml").write_text("<package><name>demo</name></package>")
    for name in ("talker.py", "listener"):
        (nodes / name).write_text("#!/bin/sh\n")
        (nodes / name).chmod(0o755)
    (nodes / "plain.py").write_text("#!/bin/sh\n")
    (nodes / "plain.py").chmod(0o644)
    return tmp_path / "demo" / "demo.launch"


def judge(launch: Path, executable: str) -> list[Finding]:
    launch.write_text(f'<launch><node pkg="demo" type="{executable}" name="n"/></launch>')
    share = str(launch.parent)
    packages = {"demo": Package("demo", share, f"{share}/package.xml")}
    environment = Environment(1, "noetic", {}, (str(launch.parent.parent),), packages, {}, (), (), None)
    return list(Workspace(environment, Sources(), share).static(str(launch)).findings)


@pytest.mark.parametrize(
    ("written", "meant"), [("talkr.py", "talker.py"), ("talker", "talker.py"), ("Listener", "listener")]
)
def test_an_executable_that_is_not_there_and_the_nearest_one(launch: Path, written: str, meant: str) -> None:
    (finding,) = judge(launch, written)
    assert (finding.rule, finding.severity, finding.stops_launch) == ("PKG002", "error", False)
    assert f"has no executable '{written}'" in finding.message
    assert finding.message.endswith(f"did you mean '{meant}'?")
    assert [edit.text for edit in finding.fixes[0].edits] == [meant]


def test_an_executable_without_a_near_name(launch: Path) -> None:
    (finding,) = judge(launch, "completely_different")
    assert "did you mean" not in finding.message
    assert finding.fixes == ()


def test_a_file_without_the_permission_to_be_executed(launch: Path) -> None:
    (finding,) = judge(launch, "plain.py")
    assert "is not executable; chmod +x" in finding.message


def test_an_executable_that_is_there(launch: Path) -> None:
    assert judge(launch, "listener") == []


def test_an_executable_that_is_still_to_be_built(launch: Path) -> None:
    cmake = launch.parent / "CMakeLists.txt"
    cmake.write_text("add_executable(${PROJECT_NAME}_node src/node.cpp)\n# add_executable(gone src/gone.cpp)\n")
    (finding,) = judge(launch, "demo_node")
    assert (finding.rule, finding.severity) == ("PKG002", "info")
    assert "is not built yet" in finding.message
    (finding,) = judge(launch, "gone")
    assert finding.severity == "error"
    below = launch.parent / "src" / "gone"
    below.mkdir(parents=True)
    (below / "CMakeLists.txt").write_text("add_executable(gone gone.cpp)\n")
    (finding,) = judge(launch, "gone")
    assert finding.severity == "info"


def test_what_an_executable_that_is_not_built_is_made_of(launch: Path) -> None:
    (launch.parent / "CMakeLists.txt").write_text(
        """
        project(demo)
        set(NAME driver)
        add_executable(${NAME}_target src/driver.cpp)
        set_target_properties(${NAME}_target PROPERTIES OUTPUT_NAME ${NAME})
        catkin_install_python(PROGRAMS plain.py)
        install(PROGRAMS tools/calibrate.py RENAME calibrate DESTINATION bin)
        """
    )
    for name, meant in (
        ("driver", "'driver' is not built yet: CMakeLists.txt of package 'demo' makes it of src/driver.cpp"),
        ("plain.py", "'plain.py' is not built yet: CMakeLists.txt of package 'demo' makes it of plain.py"),
        ("calibrate", "'calibrate' is not installed yet: CMakeLists.txt of package 'demo' installs tools/calibrate.py"),
    ):
        (finding,) = judge(launch, name)
        assert (finding.severity, finding.stops_launch) == ("info", False)
        assert meant in finding.message
    (finding,) = judge(launch, "drivr")
    assert finding.severity == "error"
    assert finding.message.endswith("did you mean 'driver'?")


def test_without_ros_a_package_that_is_not_there_is_no_error(launch: Path) -> None:
    launch.write_text('<launch><node pkg="tf2_ros" type="x" name="n"/><node pkg="demmo" type="x" name="m"/></launch>')
    share = str(launch.parent)
    packages = {"demo": Package("demo", share, f"{share}/package.xml")}
    for python, severities in ((None, ["info", "error"]), ("/usr/bin/python3", ["error", "error"])):
        environment = Environment(1, "noetic", {}, (share,), packages, {}, (), (), python)
        findings = Workspace(environment, Sources(), share).static(str(launch)).findings
        assert [f.severity for f in findings] == severities


def test_two_different_executables_of_one_name(launch: Path) -> None:
    old = launch.parent / "nodes" / "old"
    old.mkdir()
    (old / "listener").write_text("#!/bin/sh\n# another one\n")
    (old / "listener").chmod(0o755)
    (finding,) = judge(launch, "listener")
    assert (finding.rule, finding.severity) == ("PKG003", "warning")
    assert (
        "has 2 different executables 'listener'; 'nodes/listener' is run here, 'nodes/old/listener'" in finding.message
    )


def test_a_link_to_an_executable_or_a_copy_of_it_is_no_second_one(launch: Path) -> None:
    for name in ("links", "copies"):
        (launch.parent / name).mkdir()
    (launch.parent / "links" / "listener").symlink_to(launch.parent / "nodes" / "listener")
    (launch.parent / "copies" / "listener").write_text("#!/bin/sh\n")
    (launch.parent / "copies" / "listener").chmod(0o755)
    assert judge(launch, "listener") == []


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
                     ^^^^ hint[PKG004] 'rviz' is not among the dependencies that the package.xml of 'robot' names
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


def test_a_file_outside_of_any_package_needs_no_manifest() -> None:
    check(
        """
        //- /launch/all.launch
        <launch><node pkg="rviz" type="rviz" name="rviz"/></launch>"""
        + MANIFEST
    )


def test_an_executable_of_another_package_of_the_launch(launch: Path) -> None:
    other = launch.parent.parent / "other" / "nodes"
    other.mkdir(parents=True)
    (other / "filter").write_text("#!/bin/sh\n")
    (other / "filter").chmod(0o755)
    launch.write_text('<launch><node pkg="demo" type="filter" name="n"/></launch>')
    for dependencies, hint in ((frozenset({"other"}), "; package 'other' has it"), (frozenset[str](), "spaces")):
        packages = {
            "demo": Package("demo", str(launch.parent), "", dependencies),
            "other": Package("other", str(other.parent), ""),
        }
        environment = Environment(1, "noetic", {}, (str(launch.parent.parent),), packages, {}, (), (), None)
        (finding,) = Workspace(environment, Sources(), str(launch.parent)).static(str(launch)).findings
        assert (finding.rule, finding.severity) == ("PKG002", "error")
        assert finding.message.endswith(hint)
        assert [edit.text for fix in finding.fixes for edit in fix.edits] == sorted(dependencies)
