"""LCH029: a substitution that is none."""

from pathlib import Path

import pytest
from support.check import apply, check, findings_of


def test_what_looks_like_a_substitution_and_is_none() -> None:
    fixture = """
        <launch>
          <arg name="port" default="/dev/ttyUSB0"/>
          <node pkg="p" type="t" name="n">
            <param name="a" value="${arg port}"/>
                                   ^^^^^^^^^^^ warning[LCH029] '${arg port}' is not a substitution; roslaunch treats
            <param name="b" value="$arg(port)"/>
                                   ^^^^^^^^^^ warning[LCH029] '$arg(port)' is not a substitution; roslaunch treats it
            <param name="c" value="at $(arg port and more"/>
                                      ^^^^^^^^^^ warning[LCH029] '$(arg port' is not a substitution; roslaunch treats
            <param name="d" value="$(dirname"/>
                                   ^^^^^^^^^ warning[LCH029] '$(dirname' is not a substitution; roslaunch treats it as
            <param name="e" value="$(arg port)"/>
            <param name="f" value="(arg port)"/>
                                   ^^^^^^^^^^ warning[LCH029] '(arg port)' is not a substitution; roslaunch treats it
          </node>
        </launch>
    """
    meant = [edit.text for finding in check(fixture) for fix in finding.fixes for edit in fix.edits]
    assert meant == ["$(arg port)", "$(arg port)", "$(arg port)", "$(dirname)", "$(arg port)"]


@pytest.mark.silent
def test_dollars_of_others_are_no_substitutions() -> None:
    check("""
        <launch>
          <arg name="port" default="1" doc="that of the board (arg port)"/>
          <param name="a" value="costs 5$ (or less), ${HOME}, $(arg port), $argument(s), $(args"/>
          <node pkg="p" type="t" name="n" launch-prefix="bash -c 'sleep $0; $@'"/>
        </launch>
    """)


def test_substitutions_in_yaml_stay_text_unless_they_are_asked_for() -> None:
    fixture = """
        <launch>
          <arg name="port" default="/dev/ttyUSB0"/>
          <param name="copy" value="$(arg port)"/>
          <rosparam>{port: $(arg port), rate: 10}</rosparam>
                           ^^^^^^^^^^^ warning[LCH029] '$(arg port)' is treated as literal text; substitutions in YAML
          <node pkg="p" type="t" name="n"><rosparam file="$(find p)/n.yaml"/></node>
        </launch>
        //- /p/n.yaml
        meshes:
          - plain
          - $(find p)/arm.dae
            ^^^^^^^^^ warning[LCH029] '$(find p)' is treated as literal text; substitutions in YAML need <rosparam
    """
    findings = check(fixture)
    assert [apply(fixture, f.fixes[0].edits)["/main.launch"].count('subst_value="true"') for f in findings] == [1, 1]


def test_an_argument_that_the_launch_file_does_not_have_is_not_to_be_replaced() -> None:
    (finding,) = check("""
        <launch><rosparam command="load" file="$(find p)/planning.yaml"/></launch>
        //- /p/planning.yaml
        projection: joints($(arg prefix)joint_1)
                           ^^^^^^^^^^^^^ warning[LCH029] '$(arg prefix)' is treated as literal text; substitutions in
    """)
    assert finding.fixes == ()


def test_the_section_of_a_controller_that_is_not_started_here() -> None:
    check("""
        <launch>
          <arg name="arm_id" default="panda"/>
          <group ns="arms">
            <rosparam command="load" file="$(find p)/controllers.yaml"/>
            <node name="spawner" pkg="p" type="spawner" args="two_arms">
              <param name="arm" value="$(arg arm_id)"/>
            </node>
          </group>
        </launch>
        //- /p/controllers.yaml
        arms: {type: p/OneArm, joint: $(arg arm_id)_joint1}
                                      ^^^^^^^^^^^^^ info[LCH029] '$(arg arm_id)' is treated as literal text;
        two_arms: {type: p/TwoArms, left: {joint: $(arg arm_id)_joint1}}
                                                  ^^^^^^^^^^^^^ warning[LCH029] '$(arg arm_id)' is treated as literal
    """)


def test_substitutions_in_a_parameter_file_of_ros2() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a"><param from="/p/a.yaml"/></node>
          <node pkg="p" exec="b" name="b"><param from="/p/a.yaml" allow_substs="true"/></node>
        </launch>
        //- /p/a.yaml
        /a:
          ros__parameters:
            mesh: $(find-pkg-share p)/arm.dae
                  ^^^^^^^^^^^^^^^^^^^ warning[LCH029] '$(find-pkg-share p)' is treated as literal text; substitutions
    """)


@pytest.mark.silent
def test_a_value_that_the_launch_file_sets_again() -> None:
    found = findings_of("""
        <launch>
          <node pkg="p" type="t" name="n">
            <rosparam>{file: $(find elsewhere)/a.yaml}</rosparam>
            <param name="file" value="$(find elsewhere)/a.yaml"/>
          </node>
        </launch>
    """)
    assert "LCH029" not in {finding.rule for finding in found}


@pytest.mark.parametrize(
    ("source", "severity"), [(r"re.compile('\$\(find (.*)\)')", "info"), ("# $(find p)", "warning")]
)
def test_a_node_that_looks_for_substitutions_itself(tmp_path: Path, source: str, severity: str) -> None:
    (tmp_path / "node.py").write_text(source)
    (tmp_path / "main.launch").touch()
    found = findings_of(f"""
        //- {tmp_path}/main.launch
        <launch><node pkg="q" type="t" name="n"><rosparam>{{file: $(find q)/a.yaml}}</rosparam></node></launch>
        //- {tmp_path}/package.xml
        <package><name>q</name></package>
    """)
    assert [each.severity for each in found if each.rule == "LCH029"] == [severity]


@pytest.mark.silent
def test_a_namespace_that_is_not_known_is_nothing_in_the_yaml() -> None:
    found = findings_of("""
        <launch>
          <arg name="veh" default="$(env NOBODY_SETS_THIS)"/>
          <group ns="$(arg veh)"><node pkg="p" type="t" name="n"><rosparam file="$(find p)/n.yaml"/></node></group>
        </launch>
        //- /p/n.yaml
        rate: 10
    """)
    assert "LCH029" not in {finding.rule for finding in found}


@pytest.mark.silent
def test_substitutions_in_yaml_that_are_made_or_are_not_the_launchers() -> None:
    check("""
        <launch>
          <arg name="port" default="/dev/ttyUSB0"/>
          <rosparam subst_value="true">{port: $(arg port)}</rosparam>
          <rosparam subst_value="false">{written: $(arg port)}</rosparam>
          <rosparam>{command: "$(hostname) costs 5$ (or less)", args: "$(args)"}</rosparam>
          <param name="text" textfile="/p/help.txt"/>
          <param name="model" command="xacro r.xacro"/>
        </launch>
        //- /p/help.txt
        Write $(arg port)
        //- commands
        {"xacro r.xacro": {"output": "<robot name='$(arg port)'/>"}}
    """)


@pytest.mark.silent
def test_a_comment_in_a_robot_description() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a"><param from="/p/a.yaml"/></node>
        </launch>
        //- /p/a.yaml
        /a:
          ros__parameters:
            robot: "<robot><!-- <mesh file='$(find-pkg-share p)/arm.dae'/> --></robot>"
    """)


@pytest.mark.parametrize(("value", "severity"), [("rqt --file $(find p)/a", "info"), ("$(find p)/a", "warning")])
def test_a_command_line_that_no_node_of_the_launch_gets(value: str, severity: str) -> None:
    found = findings_of(f"""
        <launch><rosparam file="$(find p)/stack.yaml"/></launch>
        //- /p/stack.yaml
        stack: {{rqt_args: "{value}"}}
    """)
    assert [f.severity for f in found if f.rule == "LCH029"] == [severity]
