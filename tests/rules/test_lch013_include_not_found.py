"""LCH013: an include of a file that is not there."""

import os
from pathlib import Path
from textwrap import dedent

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.elsewhere import depends_on_build
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import check, findings_of
from support.python_launch_harness import PythonHarness


def test_an_included_file_that_is_not_there() -> None:
    check("""
        <launch>
          <include file="$(find p)/launch/base.launch"/>
                         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[LCH013] included file 'p/launch/base.launch' does not exist
        </launch>
    """)


def test_a_file_outside_of_any_package_that_is_not_there() -> None:
    assert [f.rule for f in findings_of('<launch><include file="/nowhere/at_all.launch"/></launch>')] == ["LCH013"]


def test_a_file_that_a_program_writes_which_gets_the_launch_file() -> None:
    text = """
        <launch>
          <arg name="parse" default="false"/>
          <include unless="$(arg parse)" file="$(find p)/main_spawner.launch"/>
                                               ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ {}[LCH013] included file
          <node if="$(arg parse)" pkg="p" type="parse.py" name="parse" args="$(find p)/{}"/>
        </launch>
    """
    check(f"//- /p/main.launch\n{dedent(text).format('info', 'main.launch')}")
    check(f"//- /p/main.launch\n{dedent(text).format('error', 'other.launch')}")


@pytest.mark.silent
def test_an_included_file_that_is_there_or_not_included() -> None:
    check("""
        <launch>
          <arg name="more" default="false"/>
          <include file="/inc.launch"/>
          <include file="/gone.launch" if="$(arg more)"/>
        </launch>
        //- /inc.launch
        <launch/>
    """)


def _of_arm(folder: Path, launch: str) -> list[Finding]:
    """The findings in a Python launch file of package `arm`, which has two others."""
    arm = PythonHarness(folder, "arm")
    files = "[('share/arm', ['launch/robot.launch.py']), ('share/arm/inner', ['launch/inner/deep.launch.xml'])]"
    arm.write("setup.py", f"from setuptools import setup\nsetup(name='arm', data_files={files})\n")
    arm.write("launch/leader.launch.py", "")
    arm.write("launch/inner/deep.launch.xml", "<launch/>")
    return [*arm.launch(arm.write("launch/robot.launch.py", launch)).findings]


def _launch_file(*actions: str) -> str:
    return f"""
from launch import LaunchDescription
from launch.actions import ExecuteProcess, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare

def generate_launch_description():
    return LaunchDescription([
        {", ".join(actions)}
    ])
"""


@pytest.mark.ros
def test_a_process_that_launches_a_file_that_is_not_there(tmp_path: Path) -> None:
    text = _launch_file("ExecuteProcess(cmd=['ros2', 'launch', '--debug', 'arm', 'leadr.launch.py', 'a:=b'])")
    (found,) = [each for each in _of_arm(tmp_path, text) if each.rule == "LCH013"]
    assert (found.rule, found.severity) == ("LCH013", "warning")
    assert found.message == (
        "launched file 'arm/launch/leadr.launch.py' does not exist; did you mean 'arm/launch/leader.launch.py'?"
    )
    (edit,) = found.fixes[0].edits
    span = edit.location.span
    assert (text[span.start : span.end], edit.text) == ("leadr.launch.py", "leader.launch.py")


@pytest.mark.ros
@pytest.mark.silent
def test_a_process_that_launches_a_file_by_its_name(tmp_path: Path) -> None:
    actions = (
        "ExecuteProcess(cmd=['ros2', 'launch', 'arm', 'leader.launch.py'])",
        "ExecuteProcess(cmd=['ros2', 'launch', 'arm', 'deep.launch.xml', 'rate:=10'])",
        "ExecuteProcess(cmd=['ros2', 'launch'])",
        "ExecuteProcess(cmd=['ros2', 'topic', 'list'])",
    )
    assert _of_arm(tmp_path, _launch_file(*actions)) == []


@pytest.mark.ros
def test_a_process_that_launches_a_file_of_a_package_that_is_not_there(tmp_path: Path) -> None:
    found = _of_arm(tmp_path, _launch_file("ExecuteProcess(cmd=['ros2 launch amr leader.launch.py'], shell=True)"))
    assert [each.rule for each in found] == ["PKG001"]


@pytest.mark.ros
@pytest.mark.silent
def test_a_file_that_is_installed_beside_its_folder(tmp_path: Path) -> None:
    file = "PathJoinSubstitution([FindPackageShare('arm'), 'inner', 'deep.launch.xml'])"
    assert _of_arm(tmp_path, _launch_file(f"IncludeLaunchDescription(PythonLaunchDescriptionSource({file}))")) == []


def test_a_file_of_another_machine_or_of_the_folder_where_the_launch_is_started() -> None:
    check("""
        <launch>
          <include file="/sim_ws/src/racing/track.launch"/>
                         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[LCH013] this machine has no '/sim_ws'
          <include file="$(optenv PWD /p)/track.launch"/>
                         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[LCH013] included file 'p/track.launch' does not exist; the
        </launch>
    """)


@pytest.mark.parametrize(
    ("file", "severity"),
    [
        ("config/$(arg robot)/drive.launch", "info"),
        ("config/$(arg robot).launch", "info"),
        ("config/drive_$(arg robot).launch", "info"),
        ("config/$(arg robot)_arm.launch", "info"),
        ("config/$(arg robot)/steer.launch", "error"),
        ("config/arm.launch", "error"),
    ],
)
def test_an_argument_that_is_empty_has_to_be_given(tmp_path: Path, file: str, severity: str) -> None:
    (tmp_path / "package.xml").write_text("<package><name>p</name></package>")
    for name in ("rover/drive.launch", "drive_rover.launch", "rover_of_the_arm_arm.launch"):
        (tmp_path / "config" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "config" / name).write_text("<launch/>")
    path = tmp_path / "main.launch"
    path.write_text(f'<launch><arg name="robot" default=""/><include file="$(find p)/{file}"/></launch>')
    workspace = Workspace(detect_environment(None, {"ROS_VERSION": "1"}, (str(tmp_path),)), Sources())
    (finding,) = [each for each in workspace.static(str(path)).findings if each.rule == "LCH013"]
    assert (finding.severity, "set argument 'robot'" in finding.message) == (severity, severity == "info")


def test_a_variable_that_is_not_set_has_to_be(tmp_path: Path) -> None:
    (tmp_path / "package.xml").write_text("<package><name>p</name></package>")
    (tmp_path / "pads").mkdir()
    (tmp_path / "pads" / "xbox.launch").write_text("<launch/>")
    path = tmp_path / "main.launch"
    path.write_text('<launch><include file="$(find p)/pads/$(optenv GAMEPAD).launch"/></launch>')
    workspace = Workspace(detect_environment(None, {"ROS_VERSION": "1"}, (str(tmp_path),)), Sources())
    (finding,) = [each for each in workspace.static(str(path)).findings if each.rule == "LCH013"]
    assert (finding.severity, "set variable 'GAMEPAD'" in finding.message) == ("info", True)


@pytest.mark.ros
def test_a_file_of_the_home_folder_of_whoever_launches(tmp_path: Path) -> None:
    """Where the workspace lies on the robot nobody knows here."""
    arm = PythonHarness(tmp_path, "arm")
    arm.write("launch/other.launch.py", "")
    include = "IncludeLaunchDescription(PythonLaunchDescriptionSource({}))"
    text = "import os\n" + _launch_file(
        include.format("os.path.expanduser('~/no_ws/src/arm/launch/other.launch.py')"),
        include.format("[FindPackageShare('arm'), '/launch/gone.launch.py']"),
    )
    home = {"HOME": os.path.expanduser("~")}
    analysis = arm.launch(arm.write("launch/robot.launch.py", text), variables=home)
    assert sorted(f.severity for f in analysis.findings if f.rule == "LCH013") == ["error", "info"]


@pytest.mark.parametrize(
    ("path", "severity"),
    [
        ("os.path.join(share, '..', '..', '..', '..', 'src', 'p', 'b.launch.py')", "info"),
        ("share.split('/install/')[0] + '/src/p/b.launch.py'", "info"),
        ("re.match('(.*)/install/.*', share)[1] + '/src/p/b.launch.py'", "info"),
        ("re.sub(r'install/.*', '', share) + '/src/p/b.launch.py'", "info"),
        ("os.path.join(share, 'launch', 'b.launch.py')", "error"),
        ("'/home/me/ws/install/p/share/p/b.launch.py'", "error"),
        ("f'{share}/install.yaml'", "error"),
    ],
)
def test_a_path_that_depends_on_where_packages_are_installed(tmp_path: Path, path: str, severity: str) -> None:
    """It is read as it stands: the package lies in its source, as nothing is built."""
    share = tmp_path / "one" / "two" / "src" / "p"
    (share / "launch").mkdir(parents=True)
    manifest = "<package><name>p</name><export><build_type>ament_cmake</build_type></export></package>"
    (share / "package.xml").write_text(manifest)
    launch = share / "launch" / "a.launch.py"
    launch.write_text(f"share = get_package_share_directory('p')\nmade = {path}\n")
    environment = detect_environment(str(share), {"ROS_VERSION": "2"}, [str(share.parent)], [])
    context = Workspace(environment, Sources(), str(tmp_path)).static(str(launch)).context
    missing = f"{tmp_path}/src/p/b.launch.py" if "'..'" in path else f"{share}/src/p/b.launch.py"
    assert depends_on_build(context, missing, str(launch)) == (severity == "info")
