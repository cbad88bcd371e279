"""ARG001: $(arg) of an argument that is not declared."""

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support import package_elsewhere
from support.check import apply, check
from support.python_launch_harness import PythonHarness


def test_an_undeclared_argument_is_reported_in_its_own_file() -> None:
    text = """
        <launch>
          <include file="/inc.launch"/>
        </launch>
        //- /inc.launch
        <launch>
          <arg name="camera" default="front"/>
          <param name="a" value="$(arg camera)"/>
          <node pkg="p" type="t" name="$(arg camra)"/>
                                       ^^^^^^^^^^^^ error[ARG001] 'camra' is not declared; did you mean 'camera'
        </launch>
    """
    (finding,) = check(text)
    assert finding.stops_launch
    assert [related.message for related in finding.related] == ["included here"]
    assert '"$(arg camera)"' in apply(text, finding.fixes[0].edits)["/inc.launch"]


def test_an_argument_is_not_known_before_its_declaration() -> None:
    findings = check("""
        <launch>
          <param name="a" value="$(arg b)"/>
                                 ^^^^^^^^ error[ARG001] argument 'b' is not declared before this line
          <arg name="b" default="1"/>
          <group><arg name="c" value="1"/><param name="d" value="$(arg c)"/></group>
          <param name="e" value="$(arg c)"/>
                                 ^^^^^^^^ error[ARG001] argument 'c' is not declared in this scope: another <group> or
        </launch>
    """)
    assert [finding.related[0].message for finding in findings] == ["declared here"] * 2
    assert [finding.fixes for finding in findings] == [(), ()]


def test_an_argument_is_declared_by_a_fix() -> None:
    text = """
        <launch>
          <param name="a" value="$(arg rate)"/>
                                 ^^^^^^^^^^^ error[ARG001] argument 'rate' is not declared; only the command line can
        </launch>
    """
    (finding,) = check(text)
    changed = apply(text, finding.fixes[0].edits)["/main.launch"]
    assert changed.startswith('<launch>\n  <arg name="rate"/>\n  <param')


def test_what_is_made_to_be_included_may_use_what_is_configured_there() -> None:
    check("""
        //- /part.launch.xml
        <launch>
          <arg name="robot"/>
          ^^^^^^^^^^^^^^^^^^^ info[ARG003] argument 'robot' has no default
          <node pkg="p" exec="x" name="a" namespace="$(var site)"/>
                                                     ^^^^^^^^^^^ info[ARG001] argument 'site' is not declared; the
          <node pkg="p" exec="x" name="b" namespace="$(var robto)"/>
                                                     ^^^^^^^^^^^^ error[ARG001] did you mean 'robot'?
        </launch>
    """)


def test_an_argument_that_a_file_which_cannot_be_read_may_set() -> None:
    """Real launch files rely on that: Autoware's take half of their arguments from included ones."""
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="camera" default="front"/>
          <group>
            <include file="/gone.launch.xml"/>
                           ^^^^^^^^^^^^^^^^ error[LCH013]
            <log message="$(var lidar)"/>
                          ^^^^^^^^^^^^ hint[ARG001] argument 'lidar' is not declared, unless the unresolved include
            <log message="$(var camra)"/>
                          ^^^^^^^^^^^^ warning[ARG001] argument 'camra' is not declared, unless the unresolved include
          </group>
          <log message="$(var lidar)"/>
                        ^^^^^^^^^^^^ error[ARG001] argument 'lidar' is not declared
        </launch>
    """)


@pytest.mark.silent
def test_an_argument_that_is_declared_before_or_passed() -> None:
    check("""
        <launch>
          <arg name="camera" default="front"/>
          <node pkg="p" type="t" name="$(arg camera)"/>
          <include file="/inc.launch"><arg name="camera" value="$(arg camera)"/></include>
        </launch>
        //- /inc.launch
        <launch><arg name="camera"/><node pkg="p" type="t" name="$(arg camera)_driver"/></launch>
    """)


@pytest.mark.parametrize(
    ("including", "severity"),
    [
        (
            '<launch><arg name="map"/><group if="$(var with_part)">'
            '<include file="$(find-pkg-share p)/launch/part.launch.xml"/></group></launch>',
            "info",
        ),
        ('<launch><include file="$(find-pkg-share p)/launch/part.launch.xml"/></launch>', "error"),
        ('<launch><arg name="map"/></launch>', "error"),
    ],
)
def test_an_argument_that_the_files_which_include_this_one_have(tmp_path: Path, including: str, severity: str) -> None:
    """A condition may leave the include out, so that nothing that was evaluated reaches the file."""
    (tmp_path / "package.xml").write_text("<package><name>p</name></package>")
    (tmp_path / "whole.launch.xml").write_text(including)
    path = tmp_path / "part.launch.xml"
    path.write_text('<launch><log message="$(var map)"/></launch>')
    workspace = Workspace(detect_environment(None, {"ROS_VERSION": "2"}, (str(tmp_path),)), Sources())
    (finding,) = [each for each in workspace.static(str(path)).findings if each.rule == "ARG001"]
    assert finding.severity == severity


@pytest.mark.parametrize(("included", "fixes"), [("part", 0), ("another_part", 1)])
def test_a_file_that_others_include_does_not_declare_what_they_would_have_to_pass(
    tmp_path: Path, included: str, fixes: int
) -> None:
    """In ROS 2 the others, in any package, may have configured it without passing it."""
    for package in ("p", "q"):
        (tmp_path / package).mkdir()
        (tmp_path / package / "package.xml").write_text(f"<package><name>{package}</name></package>")
    including = f'<launch><arg name="map"/><include file="$(find-pkg-share p)/{included}.launch.xml"/></launch>'
    (tmp_path / "q" / "whole.launch.xml").write_text(including)
    path = tmp_path / "p" / "part.launch.xml"
    path.write_text('<launch><log message="$(var map)"/></launch>')
    workspace = Workspace(detect_environment(None, {"ROS_VERSION": "2"}, (str(tmp_path),)), Sources())
    (finding,) = [each for each in workspace.static(str(path)).findings if each.rule == "ARG001"]
    assert len(finding.fixes) == fixes


def test_the_command_line_gives_what_is_not_declared_where_it_reaches() -> None:
    """As real roslaunch has it: see `arg_given.txt` and `include_pass_all.txt` of `fixtures/ros1/meaning`."""
    check("""
        <launch>
          <arg name="map_file" default="1"/>
          <param name="b" value="$(arg file)"/>
                                 ^^^^^^^^^^^ error[ARG001] argument 'file' is not declared; only the command line can
          <param name="c" value="$(arg mapfile)"/>
                                 ^^^^^^^^^^^^^^ error[ARG001] 'mapfile' is not declared; did you mean 'map_file'?
          <include file="/part.launch" pass_all_args="true"/>
          <include file="/other.launch"/>
        </launch>
        //- /part.launch
        <launch><param name="d" value="$(arg size)"/></launch>
                                       ^^^^^^^^^^^ error[ARG001] argument 'size' is not declared; only the command
        //- /other.launch
        <launch><param name="e" value="$(arg size)"/></launch>
                                       ^^^^^^^^^^^ error[ARG001] argument 'size' is not declared
    """)


@pytest.mark.parametrize(
    ("place", "severity"), [("README.md", "info"), ("../README", "info"), ("play.sh", "info"), ("play.cpp", "error")]
)
def test_a_text_says_how_to_give_what_is_not_declared(tmp_path: Path, place: str, severity: str) -> None:
    package = tmp_path / "robot"
    package.mkdir()
    (package / "package.xml").write_text("<package><name>robot</name></package>")
    (package / "play.launch").write_text('<launch><param name="a" value="$(arg bagfile)"/></launch>')
    (package / place).write_text("roslaunch robot play.launch bagfile:=/a.bag")
    workspace = Workspace(detect_environment(str(tmp_path), {}, root=str(tmp_path / "nowhere")), Sources())
    (finding,) = workspace.static(str(package / "play.launch")).findings
    assert (finding.rule, finding.severity) == ("ARG001", severity)


def test_the_command_line_chooses_what_is_declared() -> None:
    mode = """
        <launch>
          <arg name="first" default="false"/>
          <arg name="model" value="1" if="$(arg first)"/>
          <param name="a" value="$(arg model)"/>
                                 ^^^^^^^^^^^^ {}[ARG001] argument 'model' is not declared in this scope
        </launch>
    """
    check(mode.format("info"))
    # Who has chosen a kind of which nothing is known is not asked to choose.
    check(
        """
        <launch>
          <arg name="hand" default="true"/>
          <arg name="kind" default="e"/>
          <arg name="mass" value="1" if="$(eval hand and kind == 'e')"/>
          <param name="version" value="2" if="$(eval kind == 'c')"/>
          <param name="a" value="$(arg mass)"/>
                                 ^^^^^^^^^^^ error[ARG001] argument 'mass' is not declared in this scope: another
        </launch>
        """,
        branches=True,
    )
    # Who includes it chooses, and nobody has.
    check(
        """
        <launch><include file="/mode.launch"/></launch>
        //- /mode.launch
    """
        + mode.format("error")
    )


FORGOTTEN = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    declared = DeclareLaunchArgument("port", default_value="1")
    node = Node(package="p", executable="e", arguments=[LaunchConfiguration("port")])
    return LaunchDescription([{}])
"""


@pytest.mark.ros
@pytest.mark.parametrize(("actions", "said"), [("node", True), ("node, declared", True), ("declared, node", False)])
def test_a_declaration_that_does_not_reach_the_launch_description(tmp_path: Path, actions: str, said: bool) -> None:
    harness = PythonHarness(tmp_path)
    path = harness.write("launch/a.launch.py", FORGOTTEN.format(actions))
    messages = [each.message for each in harness.launch(path).findings if each.rule == "ARG001"]
    assert messages == said * [
        "argument 'port' is not declared here: its DeclareLaunchArgument is not in the LaunchDescription, or comes "
        "after this action"
    ]


_INCLUDER = """
def generate_launch_description():
    given = {{{}}}
    file = [get_package_share_directory('not_here'), '/part.launch.xml']
    return LaunchDescription([IncludeLaunchDescription(file, launch_arguments=given.items())])
"""


@pytest.mark.parametrize("given", ["'map': 'a', 'params': 'b'", "'params': 'b', 'map': 'a'", "'params': {'b': 1}['b']"])
def test_what_a_launch_file_in_python_passes_has_not_to_be_declared(tmp_path: Path, given: str) -> None:
    text = "<launch><let name='a' value='$(var params)'/></launch>"
    files = {"launch/includer.launch.py": _INCLUDER.format(given)}
    analysis = package_elsewhere.analysed(tmp_path, text, "launch/part.launch.xml", "jazzy", **files)
    (found,) = [each for each in analysis.findings if each.rule == "ARG001"]
    assert (found.severity, found.message.partition("; ")[2]) == ("info", "the including launch file has to set it")
