"""PRM011: a parameter file that is given to a node and has nothing for it (ROS 2)."""

from pathlib import Path

import pytest
from preflight_analysis.findings.contexts import RootFindings, by_file
from preflight_analysis.rules.registry import run_rules
from support.check import analyse, check, findings_of, read_fixture
from support.packaging import CMAKE, said


def test_a_parameter_file_for_another_node() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="localizer" name="localizer">
            <param from="/amcl.yaml"/>
                         ^^^^^^^^^^ warning[PRM011] no section of this file applies to /localizer; it has sections for
          </node>
          <group>
            <push_ros_namespace namespace="robot"/>
            <node pkg="p" exec="camera" name="camera"><param from="/nodes.yaml"/></node>
                                                                   ^^^^^^^^^^^ warning[PRM011] no section of this file
            <node pkg="p" exec="arm" name="arm"><param from="/nodes.yaml"/></node>
            <node pkg="p" exec="lidar" name="lidar"><param from="/nodes.yaml"/></node>
          </group>
          <node pkg="p" exec="any" name="any"><param from="/any.yaml"/></node>
          <node pkg="p" exec="driver" name="driver"><param from="/shared.yaml"/></node>
          <node pkg="p" exec="free"><param from="/shared.yaml"/></node>
        </launch>
        //- /amcl.yaml
        amcl:
        ^^^^ warning[PRM011] section '/amcl' applies to no node that gets this file (only /localizer)
          ros__parameters: {max_particles: 800}
        //- /nodes.yaml
        /robot/arm:
          ros__parameters: {speed: 1}
        robot:
          camra:
          ^^^^^ warning[PRM011] section '/robot/camra' applies to no node that gets this file (only /robot/camera)
            ros__parameters: {rate: 1}
        //- /shared.yaml
        costmap:
          ros__parameters: {rate: 1}
        //- /any.yaml
        /**:
          ros__parameters: {rate: 1}
    """)


def test_a_key_without_the_namespace_of_its_node() -> None:
    """As real rclpy has it: `tests/evaluation/test_params_against_rclpy.py`."""
    findings = check("""
        //- /robot.launch.xml
        <launch>
          <group>
            <push_ros_namespace namespace="front"/>
            <node pkg="p" exec="camera" name="camera"><param from="/cameras.yaml"/></node>
            <node pkg="p" exec="lidar" name="lidar"><param from="/lidars.yaml"/></node>
                                                                 ^^^^^^^^^^^^ warning[PRM011] no section of this file
            <node pkg="p" exec="arm" name="arm"><param from="/all.yaml"/></node>
            <node pkg="p" exec="hand" name="hand"><param from="/all.yaml"/></node>
          </group>
          <node pkg="p" exec="camera" name="camera" namespace="rear"><param from="/cameras.yaml"/></node>
        </launch>
        //- /cameras.yaml
        /**:
          ros__parameters: {frame: map}
        camera:
        ^^^^^^ warning[PRM011] section '/camera' applies to no node that gets this file (only /front/camera and
          ros__parameters: {rate: 30}
        //- /lidars.yaml
        lidar:
        ^^^^^ warning[PRM011] section '/lidar' applies to no node that gets this file (only /front/lidar)
          ros__parameters: {rate: 10}
        //- /all.yaml
        /**:
          ros__parameters: {frame: map}
        arm:
          ros__parameters: {speed: 1}
        /front/arm:
          ros__parameters: {speed: 2}
        /*/hand:
          ros__parameters: {speed: 2}
        hand:
          ros__parameters: {speed: 1}
        gripper:
          ros__parameters: {speed: 1}
    """)
    assert [fix.title for finding in findings if "rear" in finding.message for fix in finding.fixes] == [
        "Replace the key with '/**/camera'"
    ]


@pytest.mark.silent
def test_files_with_a_section_for_their_node() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="arm" name="arm" namespace="robot"><param from="/arm.yaml"/></node>
          <node pkg="p" exec="any" name="any"><param from="/any.yaml"/></node>
        </launch>
        //- /arm.yaml
        robot:
          arm:
            ros__parameters: {speed: 1}
        //- /any.yaml
        /**:
          ros__parameters: {rate: 1}
    """)


@pytest.mark.parametrize(("section", "wrong"), [("local_costmap", False), ("global_costmap", True)])
def test_a_section_for_a_costmap_that_the_process_is_known_to_make(section: str, *, wrong: bool) -> None:
    fixture = read_fixture(f"""
        //- /robot.launch.xml
        <launch>
          <node pkg="nav2_controller" exec="controller_server" name="controller_server"><param from="/p.yaml"/></node>
        </launch>
        //- /p.yaml
        {section}:
          {section}:
            ros__parameters: {{global_frame: odom}}
    """)
    assert ("PRM011" in {finding.rule for finding in run_rules(analyse(fixture))}) == wrong


def test_a_key_that_fits_a_node_of_another_launch_is_not_wrong() -> None:
    text = """
        //- /robot.launch.xml
        <launch><node pkg="p" exec="camera" name="{}"><param from="/camera.yaml"/></node></launch>
        //- /camera.yaml
        front:
          ros__parameters: {{rate: 1}}
    """
    reports = [
        RootFindings(f"/{name}.launch.xml", frozenset({"/camera.yaml"}), tuple(findings_of(text.format(name))))
        for name in ("front", "rear")
    ]
    assert [*by_file(reports, ())] == ["/robot.launch.xml"]
    assert sorted(by_file(reports[1:], ())) == ["/camera.yaml", "/robot.launch.xml"]


_SHARED = """
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="teleop_node" name="go2_teleop_node"><param from="/shared.yaml"/></node>
          <node pkg="p" exec="mux" name="mux"><param from="/shared.yaml"/></node>
        </launch>
        //- /shared.yaml
        mux:
          ros__parameters: {{rate: 1}}
        {}:
          ros__parameters: {{rate: 1}}
    """


def test_a_section_of_a_shared_file_that_is_called_as_the_executable_of_a_node_without_one() -> None:
    found = findings_of(_SHARED.format("teleop_node"))
    assert [f.message.partition(";")[0] for f in found] == [
        "no section of this file applies to /go2_teleop_node",
        "section '/teleop_node' applies to no node that gets this file (only /go2_teleop_node)",
    ]


@pytest.mark.silent
def test_a_section_of_a_shared_file_for_a_node_of_another_launch() -> None:
    assert findings_of(_SHARED.format("costmap")) == []


@pytest.mark.parametrize(("files", "said"), [(2, True), (1, False)])
def test_a_namespace_that_is_a_slip_of_one_in_several_files(tmp_path: Path, files: int, said: bool) -> None:
    package = tmp_path / "p"
    package.mkdir()
    for at in range(files):
        (package / f"{at}.yaml").write_text("second_robot:\n  nav:\n    ros__parameters: {a: 1}\n")
    (package / "main.launch.xml").touch()
    (package / "package.xml").write_text("<package><name>p</name></package>")
    (package / "ihm.yaml").write_text("seond_robot:\n")
    found = findings_of(f"""
        //- {package}/main.launch.xml
        <launch>
          <node pkg="p" exec="ihm" name="ihm" namespace="main_robot"><param from="{package}/ihm.yaml"/></node>
        </launch>
        //- {package}/package.xml
        <package><name>p</name></package>
        //- {package}/ihm.yaml
        main_robot:
          ihm:
            ros__parameters: {{a: 1}}
        seond_robot:
          ihm:
            ros__parameters: {{a: 1}}
    """)
    assert [f.message for f in found if f.rule == "PRM011"] == [
        "section '/seond_robot/ihm' applies to no node; did you mean '/second_robot/ihm'? 2 parameter files nearby "
        "have that namespace"
    ] * said


def test_a_section_that_is_called_as_the_executable_or_by_the_code_of_a_node_that_was_renamed() -> None:
    """The sections for the costmap, which is within the process, do not make it right."""
    found = findings_of("""
        //- /robot.launch.xml
        <launch>
          <node pkg="nav2_controller" exec="controller_server" name="nav2_controller"><param from="/p.yaml"/></node>
          <node pkg="nav2_planner" exec="planner_server" name="planner_server"><param from="/p.yaml"/></node>
          <node_container pkg="rclcpp_components" exec="component_container" name="box" namespace="">
            <composable_node pkg="nav2_smoother" plugin="nav2_smoother::SmootherServer" name="path_filter">
              <param from="/p.yaml"/>
            </composable_node>
          </node_container>
        </launch>
        //- /p.yaml
        controller_server:
          ros__parameters: {controller_frequency: 20.0}
        local_costmap:
          local_costmap:
            ros__parameters: {global_frame: odom}
        smoother_server:
          ros__parameters: {smoother_plugins: [a]}
        planner_server:
          ros__parameters: {expected_planner_frequency: 20.0}
        bt_navigator:
          ros__parameters: {bt_loop_duration: 10}
    """)
    assert [(f.message, f.severity) for f in found if f.rule == "PRM011" and f.location.file == "/p.yaml"] == [
        (
            "section '/controller_server' applies to no node that gets this file; did you mean '/nav2_controller'?",
            "warning",
        ),
        ("section '/smoother_server' applies to no node that gets this file (only /path_filter)", "warning"),
    ]


_IN_NAMESPACE = """
        //- /robot.launch.xml
        <launch>
          <node pkg="nav2_controller" exec="controller_server" namespace="r1"><param from="/p.yaml"/></node>
          <node pkg="p" exec="pilot" namespace="r1"><param from="/p.yaml"/></node>
        </launch>
        //- /p.yaml
        {}
    """


def test_no_name_of_its_own_takes_a_node_out_of_the_namespace_of_its_launch_file() -> None:
    """`__ns` is for all nodes of a process, whatever its code calls them."""
    text = _IN_NAMESPACE.format(
        "controller_server: {ros__parameters: {a: 1}}\n        pilot: {ros__parameters: {b: 1}}"
    )
    assert {f.message for f in findings_of(text) if (f.rule, f.severity) == ("PRM011", "warning")} >= {
        "section '/controller_server' applies to no node that gets this file (only /r1/controller_server)",
        "section '/pilot' applies to no node that gets this file (only /r1/pilot)",
    }


@pytest.mark.silent
@pytest.mark.parametrize(
    "sections",
    [
        "/r1/any: {ros__parameters: {a: 1}}\n        pilot: {ros__parameters: {a: 1}}",
        "/*/pilot: {ros__parameters: {a: 1}}\n        /**/controller_server: {ros__parameters: {a: 1}}",
        "/**: {ros__parameters: {a: 1}}",
    ],
)
def test_the_code_of_a_node_may_give_it_a_name_in_the_namespace(sections: str) -> None:
    assert [f for f in findings_of(_IN_NAMESPACE.format(sections)) if f.rule == "PRM011"] == []


_ANOTHER = """
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="metronome" name="metronome"><param from="/sim.yaml"/></node>
          <node pkg="p" exec="sensors" name="sensors"{args}>{given}</node>
        </launch>
        //- /sim.yaml
        metronome: {{ros__parameters: {{rate: 2.0}}}}
        sensors: {{ros__parameters: {{noise: 0.5}}}}
        //- /extra.yaml
        metronome: {{ros__parameters: {{bars: 8}}}}
        //- /own.yaml
        sensors: {{ros__parameters: {{{own}: 0.1}}}}
    """


@pytest.mark.parametrize(
    ("given", "severity"),
    [
        ('<param from="/extra.yaml"/>', "warning"),
        ("", "warning"),
        ('<param name="use_sim_time" value="true"/>', "info"),
        ('<param name="port" value="a"/>', "info"),
    ],
)
def test_a_section_for_a_node_that_gets_another_file(given: str, severity: str) -> None:
    found = findings_of(_ANOTHER.format(given=given, args="", own="noise"))
    assert [(f.message, f.severity) for f in found if f.location.file == "/sim.yaml"] == [
        ("section '/sensors' applies to no node: /sensors does not get this file", severity)
    ]


@pytest.mark.silent
@pytest.mark.parametrize(
    ("given", "args"),
    [
        ('<param from="/own.yaml"/>', ""),
        ('<param name="noise" value="0.1"/>', ""),
        ("", ' args="--config /sim.yaml"'),
        ('<param from="/sim.yaml"/>', ""),
    ],
)
def test_a_node_that_gets_what_a_section_for_it_sets_in_another_way(given: str, args: str) -> None:
    found = findings_of(_ANOTHER.format(given=given, args=args, own="noise"))
    assert [f for f in found if f.location.file == "/sim.yaml"] == []


_SHARED_ARGUMENT = """
        //- /robot.launch.xml
        <launch>
          {let}
          {first}
          {second}
        </launch>
        //- /base.launch.xml
        <launch>
          <arg name="params"/>
          <node pkg="p" exec="base" name="base"><param from="$(var params)"/></node>
        </launch>
        //- /nav.launch.xml
        <launch>
          <arg name="params" default="/nav.yaml"/>
          <node pkg="p" exec="pilot" name="pilot"><param from="$(var params)"/></node>
        </launch>
        //- /base.yaml
        base: {{ros__parameters: {{port: 1}}}}
        //- /nav.yaml
        pilot: {{ros__parameters: {{rate: 1}}}}
    """
_BASE = '<include file="/base.launch.xml"><arg name="params" value="/base.yaml"/></include>'
_NAV = '<include file="/nav.launch.xml"/>'
_LET = '<let name="x" value="1"/>'


_SHARE = "$(find-pkg-share arm)"
_PASSED = f'><arg name="params" value="{_SHARE}/config/robot.yaml"/>'
_OWN_DEFAULT = {
    **CMAKE,
    "launch/arm.launch.xml": f"""<launch>
  <arg name="params" default="{_SHARE}/config/robot.yaml"/>
  <node pkg="p" exec="base" name="base"><param from="$(var params)"/></node>
  <include file="{_SHARE}/launch/nav.launch.xml"/>
</launch>""",
    "launch/nav.launch.xml": f"""<launch>
  <arg name="params" default="{_SHARE}/config/nav.yaml"/>
  <node pkg="p" exec="pilot" name="pilot"><param from="$(var params)"/></node>
</launch>""",
    "config/robot.yaml": "base: {ros__parameters: {port: 1}}\n",
    "config/nav.yaml": "pilot: {ros__parameters: {rate: 1}}\n",
}


def test_a_file_that_the_including_file_declares(tmp_path: Path) -> None:
    """https://github.com/junyu-code/ros2-slam-nav-stack"""
    assert said(tmp_path, _OWN_DEFAULT, "PRM011") == [
        "launch/nav.launch.xml:3 warning no section of this file applies to /pilot; it has sections for '/base'; the "
        "file is from 'params', which an including file declares, too: the default 'nav.yaml' here has no effect; pass "
        "that one in the include"
    ]


@pytest.mark.silent
@pytest.mark.parametrize(
    ("file", "old", "new"),
    [
        ("config/nav.yaml", "pilot", "rover"),
        ("launch/arm.launch.xml", "/>\n</launch>", f"{_PASSED}</include>\n</launch>"),
    ],
)
def test_a_file_of_the_including_file_that_is_meant(tmp_path: Path, file: str, old: str, new: str) -> None:
    changed = {**_OWN_DEFAULT, file: _OWN_DEFAULT[file].replace(old, new)}
    assert changed != _OWN_DEFAULT
    assert said(tmp_path, changed, "PRM011") == []


def test_a_file_that_another_include_was_passed() -> None:
    found = findings_of(_SHARED_ARGUMENT.format(let=_LET, first=_BASE, second=_NAV))
    assert [(f.message, f.severity, f.location.file) for f in found if f.rule == "PRM011"] == [
        (
            "no section of this file applies to /pilot; it has sections for '/base'; the file is from 'params', which "
            "another include was passed and which stays set; put that one into a group",
            "warning",
            "/nav.launch.xml",
        )
    ]


@pytest.mark.silent
@pytest.mark.parametrize(
    ("let", "first", "second"),
    [
        (_LET, f"<group>{_BASE}</group>", _NAV),
        (_LET, _NAV, _BASE),
        (_LET, _BASE, _NAV.replace("/>", '><arg name="params" value="/nav.yaml"/></include>')),
        (_LET, _BASE, _NAV.replace("/>", '><arg name="params" value="/base.yaml"/></include>')),
        ('<let name="params" value="/base.yaml"/>', '<include file="/base.launch.xml"/>', _NAV),
    ],
)
def test_a_file_that_an_include_is_meant_to_get(let: str, first: str, second: str) -> None:
    found = findings_of(_SHARED_ARGUMENT.format(let=let, first=first, second=second))
    assert [f for f in found if "stays set" in f.message] == []
