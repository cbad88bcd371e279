"""What conditions leave out is looked at, with the arguments under which it bites."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.branches import MAX_WHAT_IFS
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import check, findings_of


def test_what_an_argument_leaves_out_is_looked_at() -> None:
    (group, param) = check(
        """
        <launch>
          <arg name="sim" default="false"/>
          <group if="$(arg sim)">
            <include file="$(find p)/none.launch"/>
                           ^^^^^^^^^^^^^^^^^^^^^ error[LCH013] 'p/none.launch' does not exist (if sim:=true)
          </group>
          <param name="a" value="$(arg nme)" if="$(arg sim)"/>
                                 ^^^^^^^^^^ error[ARG001] argument 'nme' is not declared; only the command line
        </launch>
        """,
        branches=True,
    )
    assert [group.condition, param.condition] == ["sim:=true"] * 2
    assert not group.stops_launch
    assert group.confidence == "certain"


@pytest.mark.parametrize(
    ("argument", "condition", "asked"),
    [
        ('default="true"', 'unless="$(arg a)"', "a:=false"),
        ('default="1"', 'unless="$(arg a)"', "a:=0"),
        ('default="False"', 'if="$(arg a)"', "a:=True"),
        ('default="no"', "if=\"$(eval a == 'yes')\"", "a:=yes"),
        ('default="no"', "unless=\"$(eval arg('a') != 'yes')\"", "a:=yes"),
        ('default="no"', "if=\"$(eval a.lower() in ['yes', 'y'])\"", "a:=yes"),
        ('default="false"', 'if="$(eval a and 1)"', "a:=true"),
        ('default="3"', 'if="$(eval 4 == a)"', "a:=4"),
        ('default="no"', "if=\"$(eval a != 'no')\"", "a:=yes"),
        ('default="no"', "if=\"$(eval not a == 'no')\"", "a:=yes"),
        ("", 'if="$(optenv A false)"', "A=true"),
        ("", 'unless="$(optenv A 1)"', "A=0"),
        ("", 'if="$(env A_VARIABLE)"', "A_VARIABLE=true"),
        ("", "if=\"$(eval optenv('A', 'x') == 'y')\"", "A=y"),
        ('value="$(optenv A false)"', 'if="$(arg a)"', "A=true"),
        ("", 'if="$(arg a)"', "a:=true"),
        ("", 'unless="$(arg a)"', "a:=false"),
    ],
)
def test_a_condition_is_read_backwards(argument: str, condition: str, asked: str) -> None:
    other = "<group if=\"$(eval a in ['no', 'yes'])\"/>" if 'default="no"' in argument else ""
    text = f'<launch><arg name="a" {argument}/>{other}<include file="/none.launch" {condition}/></launch>'
    assert asked in [found.condition for found in _ros1(text)]


@pytest.mark.parametrize(
    "expression",
    [
        "not " * 3_000 + "a",
        "(" * 90 + "a" + ")" * 90,
        " and ".join(f"a in ['{n}', '{n}x', '{n}y', '{n}z']" for n in range(14)),
        "a = 1",
        "env('') == 'b'",
        "optenv('a=b', '') == 'c'",
        "\0",
    ],
)
def test_any_expression_comes_to_an_end(expression: str) -> None:
    text = f'<launch><arg name="a" default="b"/><include file="/n.launch" if="$(eval {expression})"/></launch>'
    assert all(not re.match(r"\w*:?=", found.condition) for found in _ros1(text))


def test_over_an_include_and_a_default() -> None:
    check(
        """
        <launch>
          <arg name="robot" default="pr2"/>
          <arg name="sim" default="false"/>
          <include file="/b.launch">
            <arg name="kind" value="$(arg robot)"/>
            <arg name="real" value="$(eval not sim)"/>
          </include>
        </launch>
        //- /b.launch
        <launch>
          <arg name="kind"/>
          <arg name="real" default="true"/>
          <arg name="fake" default="$(eval not real)"/>
          <group if="$(eval kind == 'hsr')">
            <include file="/hsr.launch"/>
                           ^^^^^^^^^^^ error[LCH013] '/hsr.launch' does not exist (if robot:=hsr)
          </group>
          <include if="$(arg fake)" file="/fake.launch"/>
                                          ^^^^^^^^^^^^ error[LCH013] '/fake.launch' does not exist (if sim:=true)
        </launch>
        """,
        branches=True,
    )


def test_a_tag_in_a_tag_that_is_left_out() -> None:
    check(
        """
        <launch>
          <arg name="sim" default="false"/>
          <arg name="world" default="empty"/>
          <group if="$(arg sim)">
            <group if="$(eval world == 'office')">
              <include file="/office.launch"/>
                             ^^^^^^^^^^^^^^ error[LCH013] does not exist (if sim:=true world:=office)
            </group>
          </group>
        </launch>
        """,
        branches=True,
    )


def test_what_a_branch_implies_counts() -> None:
    check(
        """
        <launch>
          <arg name="sim" default="false"/>
          <arg if="$(arg sim)" name="base" value="gazebo"/>
          <arg unless="$(arg sim)" name="base" value="real"/>
          <include file="/$(arg base).launch"/>
                         ^^^^^^^^^^^^^^^^^^^ error[LCH013] '/gazebo.launch' does not exist (if sim:=true)
          <group if="$(arg sim)"><include file="/only_$(arg base).launch"/></group>
        </launch>
        //- /real.launch
        <launch/>
        //- /only_gazebo.launch
        <launch/>
        """,
        branches=True,
    )


def test_what_a_branch_implies_below_a_condition_of_another_argument_is_in_doubt() -> None:
    (found,) = check(
        """
        <launch>
          <arg name="version" default="one"/>
          <arg name="can" default="true"/>
          <group if="$(eval version == 'two')"><include file="/effector.launch"/></group>
          <group if="$(arg can)">
            <include file="/can.launch"><arg name="version" value="$(arg version)"/></include>
          </group>
        </launch>
        //- /effector.launch
        <launch/>
        //- /can.launch
        <launch>
          <arg name="version"/>
          <rosparam file="$(find p)/$(arg version)/can.yaml" command="load"/>
                          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[PRM002] 'p/two/can.yaml' does not exist (if version:
        </launch>
        //- /p/one/can.yaml
        {}
        """,
        branches=True,
    )
    assert found.confidence == "possible"


def test_a_condition_that_cannot_be_read_backwards_is_assumed_and_in_doubt() -> None:
    findings = check(
        """
        <launch>
          <group if="$(eval len(optenv('A')) == 1)">
            <include file="/none.launch"/>
                           ^^^^^^^^^^^^ warning[LCH013] does not exist (if $(eval len(optenv('A')) == 1) is true)
            <group if="$(eval len(optenv('B')) == 1)">
              <include file="/arm.launch"/>
                             ^^^^^^^^^^^ warning[LCH013] does not exist (if $(eval len(optenv('B')) == 1) is true)
            </group>
          </group>
        </launch>
        """,
        branches=True,
    )
    assert {found.confidence for found in findings} == {"possible"}


def test_a_variable_of_the_environment_is_set_in_all_of_the_launch() -> None:
    check(
        """
        <launch>
          <arg name="real" default="$(optenv ROBOT_REAL false)"/>
          <group if="$(optenv ROBOT_REAL false)">
            <include file="/$(arg real).launch"/>
                           ^^^^^^^^^^^^^^^^^^^ error[LCH013] '/true.launch' does not exist (if ROBOT_REAL=true)
          </group>
          <group if="$(optenv ROBOT false)"><include file="/there.launch"/></group>
        </launch>
        //- /there.launch
        <launch/>
        """,
        branches=True,
    )


def test_another_text_than_the_one_that_is_ruled_out_has_to_be_named_somewhere() -> None:
    check(
        """
        <launch>
          <arg name="robot" default="pr2"/>
          <arg name="kind" default="pr2"/>
          <include if="$(eval robot != 'pr2')" file="/robot_$(arg robot).launch"/>
          <include if="$(eval kind != 'pr2')" file="/kind_$(arg kind).launch"/>
                                                    ^^^^^^^^^^^^^^^^^^^^^^^^ error[LCH013] does not exist (if kind:=hsr)
          <param name="a" value="b" unless="$(eval kind == 'hsr')"/>
        </launch>
        """,
        branches=True,
    )


def test_a_choice_is_another_text_in_ros_2(tmp_path: Path) -> None:
    path = tmp_path / "a.launch.xml"
    path.write_text(
        """<launch>
          <arg name="mode" default="map"><choice value="map"/><choice value="slam"/></arg>
          <include if="$(not-equals $(var mode) map)" file="/none.launch.xml"/>
          <include if="$(eval '\\'$(env A_VARIABLE x)\\' == \\'y\\'')" file="/y.launch.xml"/>
          <include if="$(env B_VARIABLE False)" file="/b.launch.xml"/>
        </launch>"""
    )
    found = {finding.message.split("'")[1]: finding.condition for finding, _ in _found(_workspace(2), path)}
    assert found == {
        "/none.launch.xml": "mode:=slam",
        "/y.launch.xml": "A_VARIABLE=y",
        "/b.launch.xml": "B_VARIABLE=True",
    }


def test_tags_of_opposite_conditions_are_never_taken_together() -> None:
    check(
        """
        <launch>
          <group if="$(env PREFLIGHT_NOT_SET)">
                     ^^^^^^^^^^^^^^^^^^^^^^^^ hint[LCH012] is not set
            <machine name="robot" address="10.0.0.1" user="robot"/>
          </group>
          <group unless="$(env PREFLIGHT_NOT_SET)">
                         ^^^^^^^^^^^^^^^^^^^^^^^^ hint[LCH012] is not set
            <machine name="robot" address="10.0.0.1"/>
          </group>
          <group if="$(eval len(optenv('ROBOT_REAL')) == 1)"><include file="/machines.launch"/></group>
        </launch>
        //- /machines.launch
        <launch>
          <group if="$(env PREFLIGHT_NOT_SET)"><machine name="arm" address="10.0.0.2"/></group>
          <group unless="$(env PREFLIGHT_NOT_SET)"><machine name="arm" address="10.0.0.3"/></group>
        </launch>
        """,
        branches=True,
    )


def test_declarations_of_which_one_is_taken_are_no_two() -> None:
    check(
        """
        <launch>
          <arg name="name" default=""/>
          <arg name="ns" value="$(arg name)" if="$(eval name == '' and len(name) == 0)"/>
          <arg name="ns" value="/$(arg name)" if="$(eval name != '' and len(name) == 1)"/>
          <param name="a" value="$(arg ns)"/>
        </launch>
        """,
        branches=True,
    )


def test_what_may_be_another_value_where_a_tag_is_taken_is_left_alone() -> None:
    check(
        """
        <launch>
          <arg name="robot" default="pr2"/>
          <arg name="path" default="false"/>
          <arg name="load" default="false"/>
          <include if="$(eval len(optenv('ARM')) == 1)" file="/$(arg robot)_arm.launch"/>
          <include if="$(arg load)" file="$(arg path)"/>
          <include unless="$(eval robot == 'pr2')" file="/other_than_$(arg robot).launch"/>
          <include if="$(eval robot == '')" file="/robot$(arg robot).launch"/>
        </launch>
        """,
        branches=True,
    )


def test_what_is_commented_out_by_a_plain_word_is_left_alone() -> None:
    found = _ros1('<launch><include if="false" file="/none.launch"/><include unless="1" file="/n.launch"/></launch>')
    assert {finding.rule for finding in found} == {"LCH025"}


def test_what_is_said_without_a_condition_is_said_once() -> None:
    (finding,) = check(
        """
        <launch>
          <arg name="sim" default="false"/>
          <param name="sim" value="1" if="$(arg sim)"/>
          <include file="/none.launch"/>
                         ^^^^^^^^^^^^ error[LCH013] '/none.launch' does not exist
        </launch>
        """,
        branches=True,
    )
    assert finding.condition == ""


def test_a_tag_that_is_taken_in_another_context_is_not_tried() -> None:
    check(
        """
        <launch>
          <arg name="sim" default="false"/>
          <include file="/b.launch"><arg name="on" value="true"/></include>
          <include file="/b.launch"><arg name="on" value="$(arg sim)"/></include>
        </launch>
        //- /b.launch
        <launch><arg name="on"/><include if="$(arg on)" file="/c.launch"/></launch>
        //- /c.launch
        <launch/>
        """,
        branches=True,
    )


def test_a_suppressed_finding_of_a_branch_makes_its_comment_useful() -> None:
    check(
        """
        <launch>
          <arg name="sim" default="false"/>
          <!-- preflight: ignore[LCH013] not here -->
          <include if="$(arg sim)" file="/none.launch"/>
        </launch>
        """,
        branches=True,
    )


def test_there_is_an_end(tmp_path: Path) -> None:
    args = "".join(f'<arg name="a{n}" default="false"/>' for n in range(MAX_WHAT_IFS + 3))
    tags = "".join(f'<include if="$(arg a{n})" file="/none{n}.launch"/>' for n in range(MAX_WHAT_IFS + 3))
    path = tmp_path / "a.launch"
    path.write_text(f"<launch>{args}{tags}</launch>")
    workspace = _workspace(1)
    found = workspace.branches(workspace.static(str(path)))
    assert (len(found.findings), found.untried) == (MAX_WHAT_IFS, 3)


ROS2 = {
    "launch.xml": """<launch>
  <arg name="sim" default="false"/>
  <arg name="mode" default="slam"/>
  <include file="/sim.launch.py" if="$(var sim)"/>
  <include file="/nav.launch.py" if="$(equals $(var mode) nav)"/>
  <include file="/both.launch.py" if="$(and $(var sim) $(not $(equals $(var mode) slam)))"/>
  <include file="/eval.launch.py" if="$(eval '\\'$(var mode)\\' == \\'map\\'')"/>
</launch>""",
    "launch.yaml": """launch:
- arg: {name: sim, default: 'false'}
- arg: {name: mode, default: slam}
- include: {file: /sim.launch.py, if: $(var sim)}
- include: {file: /nav.launch.py, if: $(equals nav $(var mode))}
- include: {file: /eval.launch.py, unless: $(not-equals $(var mode) map)}
""",
}


@pytest.mark.parametrize("suffix", ROS2)
def test_in_ros_2(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"a.{suffix}"
    path.write_text(ROS2[suffix])
    workspace = _workspace(2)
    found = {finding.message.split("'")[1]: finding.condition for finding, _ in _found(workspace, path)}
    assert found.pop("/both.launch.py", "mode:=nav sim:=true") == "mode:=nav sim:=true"
    assert found == {"/sim.launch.py": "sim:=true", "/nav.launch.py": "mode:=nav", "/eval.launch.py": "mode:=map"}


def test_an_argument_of_an_included_file_is_set_from_outside_in_ros_2(tmp_path: Path) -> None:
    (tmp_path / "a.launch.xml").write_text(f'<launch><include file="{tmp_path}/b.launch.xml"/></launch>')
    (tmp_path / "b.launch.xml").write_text(
        '<launch><arg name="gui" default="false"/><include if="$(var gui)" file="/none.launch.xml"/></launch>'
    )
    ((finding, text),) = _found(_workspace(2), tmp_path / "a.launch.xml")
    assert (finding.condition, text) == ("gui:=true", "/none.launch.xml")


def test_a_truth_value_is_written_as_expressions_of_python_need_it(tmp_path: Path) -> None:
    (tmp_path / "a.launch.xml").write_text(f'<launch><include file="{tmp_path}/b.launch.xml"/></launch>')
    (tmp_path / "b.launch.xml").write_text(
        """<launch>
          <arg name="slam" default="False"/>
          <include if="$(var slam)" file="/none.launch.xml"/>
          <include if="$(eval 'not $(var slam)')" file="$(dirname)/c.launch.xml"/>
        </launch>"""
    )
    (tmp_path / "c.launch.xml").write_text("<launch/>")
    ((finding, _),) = _found(_workspace(2), tmp_path / "a.launch.xml")
    assert (finding.rule, finding.condition) == ("LCH013", "slam:=True")


def _ros1(text: str) -> list[Finding]:
    return findings_of(text, branches=True)


def _workspace(generation: int) -> Workspace:
    return Workspace(detect_environment(None, {"ROS_VERSION": str(generation)}, ()), Sources())


def _found(workspace: Workspace, path: Path) -> tuple[tuple[Finding, str], ...]:
    return workspace.branches(workspace.static(str(path))).findings


def test_a_parameter_that_the_node_of_a_branch_does_not_read() -> None:
    """What no similar name stands for is a hint where the launch sets it, and nothing where it may."""
    (finding,) = check(
        """
        <launch>
          <arg name="sim" default="false"/>
          <node pkg="p" type="t" name="base"><param name="rate" value="5"/></node>
          <group if="$(arg sim)">
            <node pkg="p" type="t" name="camera">
              <param name="widht" value="640"/>
                           ^^^^^ warning[PRM001] '/camera/widht' is not read by /camera; did you mean '/camera/width'
              <param name="other" value="640"/>
              <param name="height" value="480"/>
              <!-- <params><param name="~width" default="1"/><param name="~height" default="1"/></params> -->
            </node>
          </group>
        </launch>
        //- interfaces
        {"/base": {"params": {"~rate": 10}}}
        """,
        branches=True,
    )
    assert finding.condition == "sim:=true"


def test_a_parameter_that_the_launch_itself_sets_is_not_of_the_branch() -> None:
    """More is known of it, from runs."""
    found = findings_of(
        """
        <launch>
          <arg name="sim" default="false"/>
          <param name="/camera/widht" value="640"/>
          <node pkg="p" type="t" name="camera" if="$(arg sim)">
            <param name="height" value="480"/>
            <!-- <params><param name="~width" default="1"/><param name="~height" default="1"/></params> -->
          </node>
        </launch>
        """,
        branches=True,
    )
    assert [each.condition for each in found if each.rule == "PRM001"] == []


def test_a_parameter_that_the_node_of_a_branch_does_not_declare(tmp_path: Path) -> None:
    """By the source of a node, in a workspace: nothing was run."""
    (tmp_path / "package.xml").write_text(
        "<package><name>p</name><export><build_type>ament_cmake</build_type></export></package>"
    )
    (tmp_path / "CMakeLists.txt").write_text("install(PROGRAMS t.py DESTINATION lib/${PROJECT_NAME})\n")
    (tmp_path / "t.py").write_text(
        "#!/usr/bin/env python3\nimport rclpy\nfrom rclpy.node import Node\n"
        "class Camera(Node):\n"
        "    def __init__(self):\n        super().__init__('camera')\n        self.declare_parameter('width', 640)\n"
        "def main():\n    rclpy.init()\n    rclpy.spin(Camera())\n"
        "if __name__ == '__main__':\n    main()\n"
    )
    launch = tmp_path / "a.launch.xml"
    launch.write_text(
        '<launch><arg name="sim" default="false"/><node pkg="p" exec="t.py" name="camera" if="$(var sim)">'
        '<param name="widht" value="320"/><param name="other" value="1"/></node></launch>'
    )
    workspace = Workspace(detect_environment(tmp_path, {}, [str(tmp_path)], []), Sources())
    branches = workspace.branches(workspace.evaluated(str(launch)))
    said = [(each.rule, each.severity, each.condition) for each, _ in branches.findings if each.rule == "PRM013"]
    assert said == [("PRM013", "warning", "sim:=true")] * 2
    assert "did you mean 'width'?" in branches.findings[0][0].message


def test_an_argument_that_has_to_be_given_is_tried_with_each_choice(tmp_path: Path) -> None:
    (tmp_path / "package.xml").write_text("<package><name>p</name></package>")
    (tmp_path / "a1.launch.xml").write_text("<launch/>")
    path = tmp_path / "all.launch.xml"
    path.write_text(
        '<launch><arg name="model"><choice value="a1"/><choice value="b2"/></arg>'
        '<include file="$(dirname)/$(var model).launch.xml"/></launch>'
    )
    workspace = Workspace(detect_environment(None, {"ROS_VERSION": "2"}, (str(tmp_path),)), Sources())
    analysis = workspace.static(str(path))
    found = [finding for finding, _ in workspace.branches(analysis).findings]
    assert [(f.rule, f.condition) for f in found] == [("LCH013", "model:=b2")]


def test_a_condition_of_a_python_launch_file_that_was_not_run_is_shown_as_written() -> None:
    check(
        """
        //- /a.launch.py
        from launch import LaunchDescription
        from launch.actions import DeclareLaunchArgument
        from launch.conditions import IfCondition
        from launch.substitutions import LaunchConfiguration
        from launch_ros.actions import Node

        def generate_launch_description():
            use_sim = LaunchConfiguration("use_sim")
            return LaunchDescription([
                DeclareLaunchArgument("use_sim", default_value="false"),
                Node(package="pp", executable="n", condition=IfCondition(use_sim)),
                              ^^ hint[PKG001] (if use_sim is true)
            ])
        """,
        branches=True,
    )
