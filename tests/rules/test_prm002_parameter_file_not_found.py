"""PRM002: a parameter file that is not there."""

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.findings.lack import Lack
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import check, findings_of


def test_a_parameter_file_that_is_not_there(tmp_path: Path) -> None:
    (tmp_path / "teleop.yaml").write_text("a: 1\n")
    (finding,) = findings_of(f'<launch><rosparam command="load" file="{tmp_path}/telop.yaml"/></launch>')
    assert (finding.rule, finding.severity, finding.stops_launch) == ("PRM002", "error", True)
    assert finding.message.endswith(f"telop.yaml' does not exist; did you mean '{tmp_path}/teleop.yaml'?")
    assert [edit.text for edit in finding.fixes[0].edits] == ["teleop.yaml"]


@pytest.mark.parametrize(
    ("file", "others", "fixed"),
    [
        ("config/$(arg a).yaml", ["old/given.yaml"], ["/old/"]),
        ("config/$(arg a).yaml", ["old/given.yaml", "config/other.yaml"], []),  # right for a:=other
        ("config/$(arg a).yaml", ["old/given.yaml", "config/other.txt"], ["/old/"]),
        ("config/v_$(arg a).yaml", ["old/v_given.yaml", "config/v_other.yaml"], []),
        ("$(arg a)/arm.yaml", ["given/arms.yaml"], ["arms.yaml"]),
        ("$(arg a)/arm.yaml", ["given/arms.yaml", "other/arm.yaml"], []),
        ("$(arg config)/arm.yaml", ["config/arms.yaml", "other/arm.yaml"], []),
        ("config/arm.yaml", ["config/arms.yaml", "other/leg.yaml"], ["arms.yaml"]),
    ],
)
def test_a_path_that_another_launch_makes_of_other_arguments(
    tmp_path: Path, file: str, others: list[str], fixed: list[str]
) -> None:
    """What is corrected for one value of an argument does not break those of others."""
    for each in others:
        (tmp_path / each).parent.mkdir(exist_ok=True)
        (tmp_path / each).write_text("a: 1")
    (finding,) = check(f"""
        <launch>
          <arg name="a" default="given"/>
          <arg name="config" default="config"/>
          <param name="both" value="$(arg a) $(arg config)"/>
          <rosparam file="$(find robot)/{file}"/>
                          {"^" * len(f"$(find robot)/{file}")} error[PRM002] did you mean
        </launch>
        //- {tmp_path}/package.xml
        <package><name>robot</name></package>
    """)
    assert [edit.text for fix in finding.fixes for edit in fix.edits] == fixed


def test_parameter_files_that_are_not_there() -> None:
    """launch goes on without that of a node."""
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a"><param from="/no.yaml"/></node>
                                                       ^^^^^^^^ warning[PRM002] '/no.yaml' does not exist
          <node_container pkg="p" exec="component_container" name="box" namespace="">
            <composable_node pkg="p" plugin="p::A" name="b"><param from="/no.yaml"/></composable_node>
                                                                         ^^^^^^^^ error[PRM002] '/no.yaml'
          </node_container>
        </launch>
    """)


def test_a_file_that_another_package_of_the_same_name_has(tmp_path: Path) -> None:
    """Which of the two is found depends on the package path."""
    for folder in ("new", "old"):
        (tmp_path / folder).mkdir()
    (tmp_path / "old" / "board.yaml").write_text("a: 1")
    new, old = (Package("p", str(tmp_path / each), str(tmp_path / each / "package.xml")) for each in ("new", "old"))
    launch = tmp_path / "main.launch"
    launch.write_text('<launch><rosparam file="$(find p)/board.yaml"/><rosparam file="$(find p)/no.yaml"/></launch>')
    environment = Environment(1, "noetic", {}, (), {"p": new}, {"p": (old,)}, (), (), None)
    findings = Workspace(environment, Sources(), str(tmp_path)).static(str(launch)).findings
    said = {finding.severity: finding.message for finding in findings if finding.rule == "PRM002"}
    assert said["warning"].endswith(f"another package of that name has it in '{old.share}'")
    assert "no.yaml" in said["error"]


def test_an_empty_path(tmp_path: Path) -> None:
    launch = tmp_path / "main.launch"
    launch.write_text('<launch><arg name="f" default=""/><rosparam command="load" file="$(arg f)"/></launch>')
    environment = Environment(1, "noetic", {}, (str(tmp_path),), {}, {}, (), (), None, str(tmp_path))
    findings = Workspace(environment, Sources(), str(tmp_path)).static(str(launch)).findings
    assert [(each.rule, each.severity, each.message) for each in findings] == [
        ("PRM002", "error", "parameter file '' does not exist"),
    ]


def test_a_relative_path_beside_the_launch_file(tmp_path: Path) -> None:
    """It is there for those who start the launch in that folder."""
    share = tmp_path / "p"
    share.mkdir()
    (share / "arm.urdf").write_text("<robot/>")
    launch = share / "main.launch"
    launch.write_text('<launch><param name="a" textfile="arm.urdf"/><param name="b" textfile="leg.urdf"/></launch>')
    environment = Environment(1, "noetic", {}, (str(tmp_path),), {}, {}, (), (), None, str(tmp_path))
    findings = Workspace(environment, Sources(), str(tmp_path)).static(str(launch)).findings
    said = {finding.severity: finding.message for finding in findings if finding.rule == "PRM002"}
    assert said["info"].endswith("the path depends on the folder where the launch is started")
    assert "leg.urdf" in said["error"]


def test_a_name_that_says_that_it_has_to_be_given() -> None:
    check("""
        <launch>
          <arg name="robot" default="$(optenv ROBOT !!NO_ROBOT_SET!!)"/>
          <rosparam file="$(find p)/$(arg robot)/arm.yaml"/>
                          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[PRM002] parameter file 'p/!!NO_ROBOT_SET!!/arm.yaml'
          <rosparam file="$(find p)/PASS THE CONFIG FILE.yaml"/>
                          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[PRM002] a part of the path has to be set
          <rosparam file="$(find p)/TODO: find_arm.yaml"/>
                          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[PRM002] a part of the path has to be set
          <rosparam file="$(find p)/note_settings/arm.yaml"/>
                          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[PRM002]
          <rosparam>robot: !!NO_ROBOT_SET!!</rosparam>
                           ^ info[PRM004]
        </launch>
    """)


def test_a_file_that_the_robot_may_have_is_a_lack_of_this_machine() -> None:
    path = "/etc/opt/robot/calibration.yaml"
    (finding,) = check(f"""
        <launch>
          <rosparam file="{path}"/>
                          {"^" * len(path)} hint[PRM002] does not exist
        </launch>
    """)
    assert finding.lack == Lack("file", path)


@pytest.mark.silent
def test_parameter_files_that_are_there() -> None:
    check("""
        <launch>
          <arg name="more" default="false"/>
          <rosparam file="/a.yaml"/>
          <param name="text" textfile="/a.yaml"/>
          <rosparam file="/gone.yaml" if="$(arg more)"/>
        </launch>
        //- /a.yaml
        a: 1
    """)


def test_a_file_of_another_machine_or_of_the_folder_where_the_launch_is_started() -> None:
    check("""
        <launch>
          <rosparam file="/sim_ws/src/racing/params.yaml"/>
                          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[PRM002] this machine has no '/sim_ws'
          <rosparam file="$(optenv PWD /p)/params.yaml"/>
                          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[PRM002] parameter file 'p/params.yaml' does not exist; the
        </launch>
    """)


def test_a_path_out_of_the_share_folder_of_a_package_that_is_not_built(tmp_path: Path) -> None:
    """From `install/p/share/p` it leads into the workspace, from the source elsewhere."""
    launch = """
        <launch><node pkg="p" exec="x"><param from="$(find-pkg-share p)/{}/config/robot.yaml"/></node></launch>
    """
    for path, severity in (("../../../../src/robot", "hint"), ("launch/..", "warning")):
        package = tmp_path / "src" / "p"
        (package / "launch").mkdir(parents=True, exist_ok=True)
        (package / "package.xml").write_text(
            "<package><name>p</name><export><build_type>ament_cmake</build_type></export></package>"
        )
        file = package / "launch" / "a.launch.xml"
        file.write_text(launch.format(path))
        environment = detect_environment(str(tmp_path), {"ROS_VERSION": "2"}, root=str(tmp_path / "nowhere"))
        findings = Workspace(environment, Sources()).static(str(file)).findings
        assert [f.severity for f in findings if f.rule == "PRM002"] == [severity]


@pytest.mark.parametrize(("home", "severity"), [("/home/no_such_user", "info"), ("/usr", "warning")])
def test_a_file_in_the_home_folder_of_another_user(tmp_path: Path, home: str, severity: str) -> None:
    folder = tmp_path / "src" / "robot"
    (folder / "config").mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>robot</name></package>")
    (folder / "config" / "a.yaml").touch()
    launch = folder / "a.launch.xml"
    path = f"{home}/src/robot/config/a.yaml"
    launch.write_text(f'<launch><node pkg="robot" exec="a" name="a"><param from="{path}"/></node></launch>')
    workspace = Workspace(detect_environment(str(tmp_path), {"ROS_VERSION": "2"}), Sources(), str(tmp_path))
    (finding,) = (each for each in workspace.static(str(launch)).findings if each.rule == "PRM002")
    assert finding.severity == severity
    assert "did you mean 'robot/config/a.yaml'?" in finding.message
