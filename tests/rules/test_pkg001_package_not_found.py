"""PKG001: a package that is not there."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.findings.finding import Finding
from preflight_analysis.findings.lack import Lack
from preflight_analysis.model.below_packages import asked_below
from preflight_analysis.model.installed import lack_of_package
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import analyse, apply, check, findings_of, read_fixture
from support.descriptions import said, xacro
from support.unbuilt_packages import manifest


def test_a_package_that_is_not_there_and_the_nearest_one() -> None:
    text = """
        <launch>
          <node pkg="rospy_tutorial" type="talker" name="n"/>
                     ^^^^^^^^^^^^^^ error[PKG001] did you mean 'rospy_tutorials'?
          <param name="a" value="$(find rospy_tutorial)/x"/>
                                 ^^^^^^^^^^^^^^^^^^^^^^ error[PKG001] package 'rospy_tutorial' not found among 2
        </launch>
        //- /rospy_tutorials/package.xml
        <package/>
    """
    node, find = check(text)
    assert not node.stops_launch
    assert find.stops_launch
    assert 'pkg="rospy_tutorials"' in apply(text, node.fixes[0].edits)["/main.launch"]
    assert "$(find rospy_tutorials)/x" in apply(text, find.fixes[0].edits)["/main.launch"]


def test_a_package_of_a_node_of_which_something_else_is_not_known() -> None:
    check("""
        <launch>
          <node pkg="rospy_tutorial" type="talker" name="n" args="$(env UNSET)">
                     ^^^^^^^^^^^^^^ error[PKG001] did you mean 'rospy_tutorials'?
                                                                  ^^^^^^^^^^^^ hint[LCH012] 'UNSET' is not set
            <rosparam file="$(find rospy_tutorial)/a.yaml"/>
                            ^^^^^^^^^^^^^^^^^^^^^^ error[PKG001] did you mean 'rospy_tutorials'?
          </node>
        </launch>
        //- /rospy_tutorials/package.xml
        <package/>
    """)


def test_a_name_from_before_a_rename(tmp_path: Path) -> None:
    (tmp_path / "ca_tools" / "config").mkdir(parents=True)
    (tmp_path / "ca_tools" / "config" / "joy_.yaml").write_text("axis: 1\n")
    (finding,) = check(f"""
        <launch>
          <arg name="pad" default=""/>
          <rosparam file="$(find create_tools)/config/joy_$(arg pad).yaml"/>
                          ^^^^^^^^^^^^^^^^^^^^ warning[PKG001] names it; did you mean 'ca_tools'?
        </launch>
        //- {tmp_path}/ca_tools/package.xml
        <package/>
    """)
    assert [(fix.title, fix.preferred) for fix in finding.fixes] == [("Replace 'create_tools' with 'ca_tools'", False)]


@pytest.mark.parametrize(
    "tag", ['node pkg="dmp" type="dmp_server" name="n"', 'rosparam file="$(find dmp)/config/a.yaml"']
)
def test_a_like_name_without_what_is_asked_of_it(tag: str) -> None:
    found = findings_of(f"""
        <launch><{tag}/></launch>
        //- /rob_dmp/package.xml
        <package/>
    """)
    assert [(f.severity, "did you mean" in f.message) for f in found if f.rule == "PKG001"] == [("info", False)]


def test_a_word_that_the_folder_of_the_project_has_is_no_likeness() -> None:
    (finding,) = check("""
        //- /rpg_svo/svo/launch/live.launch
        <launch>
          <include file="$(find rpg_calib)/launch/joy.launch"/>
                         ^^^^^^^^^^^^^^^^^ info[PKG001] no package.xml of the workspace names it
        </launch>
        //- /rpg_svo/svo/package.xml
        <package/>
        //- /rpg_svo/rpg_common/package.xml
        <package/>
    """)
    assert finding.fixes == ()


def test_drivers_of_two_makes_are_not_alike() -> None:
    (finding,) = check("""
        <launch>
          <include file="$(find acme2_camera)/launch/mini.launch"/>
                         ^^^^^^^^^^^^^^^^^^^^ info[PKG001] no package.xml of the workspace names it
        </launch>
        //- /orbbec_camera/package.xml
        <package/>
    """)
    assert finding.fixes == ()


def test_packages_of_one_robot_are_no_slips_of_each_other() -> None:
    check("""
        //- /rover_gazebo/launch/sim.launch
        <launch>
          <include file="$(find rover_descriptions)/launch/up.launch"/>
                         ^^^^^^^^^^^^^^^^^^^^^^^^^^ info[PKG001] no package.xml of the workspace names it
        </launch>
        //- /rover_gazebo/package.xml
        <package/>
        //- /rover_control/package.xml
        <package/>
    """)


@pytest.mark.parametrize(("file", "severity"), [("base.yaml", "warning"), ("other.yaml", "hint")])
def test_a_package_that_has_all_that_is_asked_of_the_one_that_is_not_there(
    tmp_path: Path, file: str, severity: str
) -> None:
    for name in ("robot", "beside"):
        (tmp_path / "src" / name / "config").mkdir(parents=True)
        (tmp_path / "src" / name / "package.xml").write_text(manifest(name, "catkin"))
    (tmp_path / "src" / "robot" / "config" / "base.yaml").write_text("rate: 1")
    launch = tmp_path / "src" / "robot" / "main.launch"
    launch.write_text(
        f'<launch><rosparam command="load" file="$(find vortex)/config/{file}"/>'
        '<node pkg="stranger" type="t" name="n"/></launch>'
    )
    workspace = Workspace(detect_environment(str(tmp_path), {}), Sources(), str(tmp_path))
    findings = [f for f in workspace.static(str(launch), {}).findings if "'vortex'" in f.message and f.rule == "PKG001"]
    assert [f.severity for f in findings] == [severity]
    meant = "package 'robot' has 'config/base.yaml'; did you mean 'robot'?"
    assert (meant in findings[0].message) == (severity == "warning")


def test_a_package_with_a_launch_file_that_hands_over_to_the_one_that_is_asked_for(tmp_path: Path) -> None:
    (tmp_path / "launch").mkdir()
    (tmp_path / "package.xml").write_text(manifest("robot", "catkin"))
    asks = (
        '<launch><include file="$(find vision)/launch/track.launch"/><node pkg="stranger" type="t" name="n"/></launch>'
    )
    for name in ("track", "main"):
        (tmp_path / "launch" / f"{name}.launch").write_text(asks)
    workspace = Workspace(detect_environment(str(tmp_path), {}), Sources(), str(tmp_path))
    findings = workspace.static(str(tmp_path / "launch" / "main.launch"), {}).findings
    assert not any("did you mean" in each.message for each in findings)


@pytest.mark.parametrize(("program", "severity"), [("base.py", "warning"), ("pid_control", "hint")])
def test_a_package_that_has_the_files_and_not_the_programs(tmp_path: Path, program: str, severity: str) -> None:
    for name in ("robot", "beside"):
        (tmp_path / "src" / name / "config").mkdir(parents=True)
        (tmp_path / "src" / name / "package.xml").write_text(manifest(name, "catkin"))
    (tmp_path / "src" / "robot" / "config" / "base.yaml").write_text("rate: 1")
    (tmp_path / "src" / "robot" / "base.py").write_text("#!/usr/bin/env python3\n")
    (tmp_path / "src" / "robot" / "base.py").chmod(0o755)
    launch = tmp_path / "src" / "robot" / "main.launch"
    launch.write_text(
        '<launch><rosparam command="load" file="$(find vortex)/config/base.yaml"/>'
        f'<node pkg="vortex" type="{program}" name="n"/><node pkg="stranger" type="t" name="m"/></launch>'
    )
    workspace = Workspace(detect_environment(str(tmp_path), {}), Sources(), str(tmp_path))
    findings = [f for f in workspace.static(str(launch), {}).findings if "'vortex'" in f.message and f.rule == "PKG001"]
    assert {f.severity for f in findings} == {severity}


@pytest.mark.parametrize(
    ("text", "paths"),
    [
        ('file="$(find old)/config/a.yaml $(find other)/b/c"', ["config/a.yaml"]),
        ('file="$(find-pkg-share old)/config/a.yaml"', ["config/a.yaml"]),
        ('file="$(find old)/config/$(arg pad).yaml"', ["config/xbox.yaml"]),
        ('file="$(find old)/config/$(arg other).yaml"', []),
        ('file="$(find old)/config/robots/a_$(arg other).yaml"', ["config/robots"]),
        ("share = join(get_package_share_directory('old'))\nx = join(share, 'config', 'a.yaml')", ["config/a.yaml"]),
        ("PathJoinSubstitution([FindPackageShare('old'), 'config', 'a.yaml'])", ["config/a.yaml"]),
        ("get_package_share_directory(\"old\") + '/config/a.yaml'", ["config/a.yaml"]),
        ("share = get_package_share_directory('other')\nx = join(share, 'config', 'a.yaml')", []),
        ("join(get_package_share_directory('old'), 'config')", []),
        ('[PathJoinSubstitution([FindPackageShare("old"), "launch"]), "/a.launch.py"]', ["launch/a.launch.py"]),
    ],
)
def test_what_a_launch_file_asks_for_below_a_package(tmp_path: Path, text: str, paths: list[str]) -> None:
    file = tmp_path / ("a.launch" if text.startswith("file=") else "a.launch.py")
    file.write_text(f"<launch><include {text}/></launch>" if text.startswith("file=") else text)
    assert [*dict.fromkeys(asked_below(Sources().db, str(file), "old", {"pad": "xbox", "other": None}))] == paths


def test_who_uses_several_packages_that_nobody_knows_has_them_elsewhere() -> None:
    findings = check("""
        <launch>
          <node pkg="hsrb_bringup" type="base" name="n"/>
                     ^^^^^^^^^^^^ hint[PKG001] package 'hsrb_bringup' is neither installed nor in the workspace; it is
          <node pkg="tmc_suction" type="base" name="m"/>
                     ^^^^^^^^^^^ hint[PKG001] package 'tmc_suction' is neither installed nor in the workspace; it is
        </launch>
        //- /hero_bringup/package.xml
        <package/>
    """)
    assert [finding.lack and finding.lack.name for finding in findings] == ["hsrb_bringup", "tmc_suction"]


def test_a_package_that_its_folder_names_otherwise() -> None:
    text = """
        <launch>
          <node pkg="robot-master" type="base" name="n"/>
                     ^^^^^^^^^^^^ error[PKG001] package 'robot-master' not found among 2 packages; the folder
        </launch>
        //- /ws/robot-master/package.xml
        <package><name>robot</name></package>
    """
    (finding,) = check(text)
    assert 'pkg="robot"' in apply(text, finding.fixes[0].edits)["/main.launch"]


@pytest.mark.silent
def test_a_package_in_a_tag_that_is_not_taken_is_not_looked_for() -> None:
    check("""
        <launch>
          <arg name="more" default="false"/>
          <node pkg="nowhere" type="t" name="n" if="$(arg more)"/>
          <node pkg="p" type="t" name="m"/>
        </launch>
    """)


@pytest.mark.silent
def test_a_package_whose_name_is_unknown_is_not_judged() -> None:
    findings = findings_of("""
        <launch>
          <arg name="pkg"/>
          <node pkg="$(arg pkg)" type="t" name="n"/>
        </launch>
    """)
    assert [finding.rule for finding in findings] == ["ARG003"]


def of_packages(
    launch: Path, *names: str, python: str | None = None, distro: str = "noetic", needs: str = "our_own_driver"
) -> list[Finding]:
    """What is said of nodes of these packages in a workspace that has package `demo` alone, which needs one."""
    nodes = "".join(f'<node pkg="{name}" type="x" name="n{at}"/>' for at, name in enumerate(names))
    launch.write_text(f"<launch>{nodes}</launch>")
    share = str(launch.parent)
    packages = {"demo": Package("demo", share, f"{share}/package.xml", frozenset({needs}))}
    environment = Environment(1, distro, {}, (share,), packages, {}, (), (), python)
    findings = Workspace(environment, Sources(), share).static(str(launch)).findings
    return [finding for finding in findings if finding.rule == "PKG001"]


@pytest.mark.parametrize("python", [None, "/usr/bin/python3"])
def test_a_released_package_that_is_not_installed_is_the_machine_s_lack(launch: Path, python: str | None) -> None:
    (finding,) = of_packages(launch, "move_base", python=python)
    assert (finding.severity, finding.confidence) == ("hint", "certain")
    assert finding.message == "package 'move_base' is not installed; install ros-noetic-move-base"
    assert finding.lack == Lack("package", "move_base", "apt install ros-noetic-move-base")


@pytest.mark.parametrize(
    ("generation", "distro", "debians", "name", "install"),
    [
        (1, None, False, "move_base", "ros-noetic-move-base"),
        (1, "noetic", True, "robot_state_publisher", "ros-robot-state-publisher"),
        (1, None, True, "rospy", "python3-rospy"),
        (1, "noetic", True, "topic_tools", "libtopic-tools-dev topic-tools"),
        (1, "noetic", True, "move_base", None),
        (1, "jazzy", True, "tf2_tools", "tf2-tools"),
        (2, "jazzy", True, "nav2_bringup", "ros-jazzy-nav2-bringup"),
        (2, "unheard_of", False, "nav2_bringup", "ros-unheard_of-nav2-bringup"),
        (2, None, False, "nav2_bringup", None),
    ],
)
def test_what_to_install_is_what_the_machine_calls_it(
    generation: int, distro: str | None, debians: bool, name: str, install: str | None
) -> None:
    """Where nothing is known of that, nothing is invented; the environment may be that of another generation."""
    context = analyse(read_fixture("<launch/>"))
    tree = replace(context.tree, generation=generation)
    of = 2 if distro == "jazzy" else generation
    environment = replace(context.environment, generation=of, distro=distro, debians=debians)
    lack = lack_of_package(replace(context, tree=tree, environment=environment), name)
    assert lack == Lack("package", name, install and f"apt install {install}")


def test_a_package_that_only_another_distribution_has_says_so(launch: Path) -> None:
    (finding,) = of_packages(launch, "kobuki_node")
    assert finding.severity == "hint"
    assert "is not installed; it is released for indigo and kinetic" in finding.message
    assert finding.lack == Lack("package", "kobuki_node")
    (of_more,) = of_packages(launch, "yocs_velocity_smoother")
    assert "it is released for indigo, kinetic and melodic" in of_more.message
    (of_its_own,) = of_packages(launch, "kobuki_node", distro="kinetic")
    assert of_its_own.message.endswith("ros-kinetic-kobuki-node")


def test_a_slip_in_a_released_name_is_an_error_with_a_fix(launch: Path) -> None:
    (finding,) = of_packages(launch, "robot_state_publishr")
    assert (finding.severity, finding.confidence, finding.lack) == ("error", "certain", None)
    assert "did you mean 'robot_state_publisher'?" in finding.message
    assert finding.fixes[0].edits[0].text == "robot_state_publisher"


def test_a_slip_in_the_name_of_a_dependency_that_is_not_here_is_an_error_with_a_fix(launch: Path) -> None:
    (finding,) = of_packages(launch, "topic_tols", needs="topic_tools")
    assert (finding.severity, finding.confidence, finding.lack) == ("error", "certain", None)
    assert "did you mean 'topic_tools'?" in finding.message
    assert finding.fixes[0].edits[0].text == "topic_tools"


def test_a_dependency_that_differs_in_a_short_word_is_another_one(launch: Path) -> None:
    (finding,) = of_packages(launch, "pol_msgs", needs="pcl_msgs")
    assert (finding.severity, finding.fixes) == ("info", ())


def test_a_short_word_is_near_to_too_much(launch: Path) -> None:
    (finding,) = of_packages(launch, "arm_description")
    assert (finding.severity, finding.fixes) == ("info", ())


def test_a_name_of_the_other_generation_is_none_of_this_one(launch: Path) -> None:
    (finding,) = of_packages(launch, "nav2_amcl", python="/usr/bin/python3")
    assert (finding.severity, finding.lack) == ("info", None)


@pytest.mark.parametrize("python", [None, "/usr/bin/python3"])
def test_a_name_that_nobody_knows(launch: Path, python: str | None) -> None:
    (finding,) = of_packages(launch, "fancy_unheard_of", python=python)
    assert (finding.severity, finding.confidence, finding.lack) == ("info", "likely", None)
    assert "it is not released for any distribution, and no package.xml of the workspace names it" in finding.message


@pytest.mark.parametrize("python", [None, "/usr/bin/python3"])
def test_a_name_that_only_a_manifest_knows_is_lacking(launch: Path, python: str | None) -> None:
    (finding,) = of_packages(launch, "our_own_driver", python=python)
    assert (finding.severity, finding.confidence) == ("hint", "likely")
    assert finding.message.endswith("neither installed nor in the workspace nor released for any distribution")
    assert finding.lack == Lack("package", "our_own_driver")


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


@pytest.mark.silent
def test_a_process_has_no_package() -> None:
    check("""
        //- /a.launch.xml
        <launch><executable cmd="echo hello"/></launch>
    """)


def test_a_package_that_has_the_file_alone(tmp_path: Path) -> None:
    for name in ("robot", "other"):
        (tmp_path / "src" / name / "config").mkdir(parents=True)
        (tmp_path / "src" / name / "package.xml").write_text(manifest(name, "catkin"))
    (tmp_path / "src" / "other" / "config" / "params.yaml").write_text("rate: 1")
    launch = tmp_path / "src" / "robot" / "main.launch"
    launch.write_text('<launch><rosparam command="load" file="$(find common)/config/params.yaml"/></launch>')
    workspace = Workspace(detect_environment(str(tmp_path), {}), Sources(), str(tmp_path))
    findings = workspace.static(str(launch), {}).findings
    assert [f.severity for f in findings if f.rule == "PKG001"] == ["info"]


@pytest.mark.parametrize(
    ("name", "severity"),
    [
        ("<your_package>", "error"),
        ("{{package}}", "error"),
        ("your_package", "warning"),
        ("my_package", "warning"),
        ("my_robot_pkg", "warning"),
        ("package_name", "warning"),
        ("TODO", "warning"),
        ("my_robot", "info"),
        ("packages", "info"),
    ],
)
def test_the_placeholder_of_an_example(tmp_path: Path, name: str, severity: str) -> None:
    launch = tmp_path / "a.launch.yaml"
    launch.write_text(f"launch:\n- node: {{pkg: '{name}', exec: driver}}\n")
    workspace = Workspace(detect_environment(str(tmp_path), {}), Sources(), str(tmp_path))
    (finding,) = (f for f in workspace.static(str(launch), {}).findings if f.rule == "PKG001")
    assert (finding.severity, "placeholder" in finding.message) == (severity, severity != "info")


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("armm", ["r.xacro:2 warning package 'armm' not found among 1 packages; did you mean 'arm'?"]),
        ("arm", []),
        ("realsense2_description", []),
        ("somebody_elses_description", []),
    ],
)
def test_of_a_description_for_itself(name: str, expected: list[str]) -> None:
    text = f'<xacro:include filename="$(find {name})/a.xacro"/>'
    assert said({"r.xacro": xacro(text), "a.xacro": xacro("", name="")}, "PKG001") == expected
