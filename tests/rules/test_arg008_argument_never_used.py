"""ARG008: an argument that its file declares and does not use."""

from pathlib import Path

import pytest
from support.check import apply, check


def test_an_argument_that_its_file_never_uses() -> None:
    text = """
        <launch>
          <arg name="rate" default="10"/>
                     ^^^^ hint[ARG008] unused argument 'rate': no tag of this file uses it
          <!-- <param name="rate" value="$(arg rate)"/> -->
          <arg name="used" default="1"/>
          <arg name="quoted" default="2"/>
          <group if="$(eval used == 1 or arg('quoted') == 2)">
            <arg name="inner" value="1"/>
                       ^^^^^ hint[ARG008] unused argument 'inner': no tag of this file uses it
          </group>
        </launch>
    """
    rate, _ = check(text)
    assert apply(text, rate.fixes[0].edits)["/main.launch"].startswith("<launch>\n  <!--")


@pytest.mark.silent
def test_an_argument_that_only_what_is_not_taken_uses_is_used() -> None:
    check("""
        <launch>
          <arg name="rate" default="10"/>
          <arg name="fast" default="false"/>
          <group if="$(arg fast)"><param name="rate" value="$(arg rate)"/></group>
        </launch>
    """)


@pytest.mark.silent
def test_an_argument_that_reaches_an_include_with_all_others_is_used() -> None:
    check("""
        <launch>
          <arg name="rate" default="10"/>
          <include file="/inc.launch" pass_all_args="true"/>
        </launch>
        //- /inc.launch
        <launch><param name="rate" value="$(arg rate)"/></launch>
    """)


def test_an_argument_that_only_a_parameter_file_uses_is_used() -> None:
    check("""
        <launch>
          <arg name="rate" default="10"/>
          <arg name="inline" default="10"/>
          <rosparam command="load" file="/rates.yaml" subst_value="true"/>
          <rosparam subst_value="true">b: $(arg inline)</rosparam>
        </launch>
        //- /rates.yaml
        a: $(arg rate)
    """)
    check("""
        <launch>
          <arg name="rate" default="10"/>
                     ^^^^ hint[ARG008] unused argument 'rate': no tag of this file uses it
          <rosparam command="load" file="/rates.yaml"/>
        </launch>
        //- /rates.yaml
        a: rate
    """)


@pytest.mark.silent
def test_an_argument_may_be_used_by_a_parameter_file_that_is_not_known() -> None:
    check("""
        <launch>
          <arg name="rate" default="10"/>
          <arg name="fast" default="false"/>
          <group if="$(arg fast)"><rosparam command="load" file="/rates.yaml" subst_value="true"/></group>
        </launch>
    """)


def test_an_include_that_passes_what_is_never_used() -> None:
    check("""
        <launch>
          <include file="/inc.launch"><arg name="rate" value="1"/></include>
                                                 ^^^^ warning[ARG008] argument 'rate' has no effect: '/inc.launch'
          <include file="/inc.launch"><arg name="rate" value="1"/></include>
                                                 ^^^^ warning[ARG008] argument 'rate' has no effect
        </launch>
        //- /inc.launch
        <launch>
          <arg name="rate"/>
          <arg name="other" default="1"/>
                     ^^^^^ hint[ARG008] unused argument 'other': no tag of this file uses it
        </launch>
    """)


def test_what_several_files_are_passed_may_be_what_they_agreed_on() -> None:
    check("""
        <launch>
          <arg name="robot" default="red"/>
          <include if="$(eval robot == 'red')" file="/red.launch"><arg name="rate" value="1"/></include>
                                                                             ^^^^ info[ARG008] argument 'rate' has no
          <include unless="$(eval robot == 'red')" file="/green.launch"><arg name="rate" value="1"/></include>
        </launch>
        //- /red.launch
        <launch><arg name="rate"/></launch>
        //- /green.launch
        <launch><arg name="rate"/><param name="rate" value="$(arg rate)"/></launch>
    """)


@pytest.mark.silent
def test_files_of_which_one_is_chosen_have_to_declare_what_the_others_use() -> None:
    check("""
        <launch>
          <arg name="robot" default="inc"/>
          <include file="/$(arg robot).launch"><arg name="rate" value="1"/></include>
        </launch>
        //- /inc.launch
        <launch><arg name="rate"/></launch>
    """)


def test_a_value_of_the_file_s_own_is_not_passed_on() -> None:
    """As turtlebot's `3dsensor/asus_xtion_pro.launch.xml` has it: passed on, it starts nodes twice."""
    (found,) = check("""
        <launch>
          <arg name="depth" value="depth_registered"/>
                     ^^^^^ warning[ARG008] argument 'depth' has no effect: the include does not pass it to '/inc.launch'
          <include file="/inc.launch"/>
        </launch>
        //- /inc.launch
        <launch>
          <arg name="depth" default="depth"/>
          <node pkg="p" type="t" name="$(arg depth)"/>
          <node pkg="p" type="t" name="depth_registered"/>
        </launch>
    """)
    assert [fix.title for fix in found.fixes] == ["Remove the declaration of 'depth'"]


def test_an_argument_that_is_not_passed_on() -> None:
    text = """
        <launch>
          <arg name="teleop" default="true"/>
                     ^^^^^^ warning[ARG008] argument 'teleop' has no effect: the include does not pass it to
          <arg name="fixed" default="1"/>
                     ^^^^^ hint[ARG008] unused argument 'fixed': no tag of this file uses it
          <include file="/inc.launch"/>
        </launch>
        //- /inc.launch
        <launch>
          <arg name="teleop" default="true"/>
          <arg name="fixed" value="2"/>
          <node if="$(arg teleop)" pkg="p" type="x$(arg fixed)" name="x"/>
        </launch>
    """
    found = next(each for each in check(text) if "teleop" in each.message)
    passed = apply(text, found.fixes[0].edits)["/main.launch"]
    assert '<arg name="teleop" value="$(arg teleop)"/>' in passed


def test_an_argument_that_no_file_of_the_launch_uses() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="rate" default="10"/>
          <arg name="speed" default="1.0"/>
                     ^^^^^ hint[ARG008] unused argument 'speed': nothing in this launch uses it
          <arg name="in_file" default="1.0"/>
          <node pkg="p" exec="x" name="x"><param name="rate" value="$(var rate)"/></node>
          <node pkg="p" exec="y" name="y"><param from="/p.yaml" allow_substs="true"/></node>
        </launch>
        //- /p.yaml
        y:
          ros__parameters: {rate: $(var in_file)}
    """)
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="rate" default="10"/>
          <node pkg="p" exec="y" name="y"/>
          <include file="/inner.launch.xml"/>
        </launch>
        //- /inner.launch.xml
        <launch><node pkg="p" exec="x" name="x"><param name="rate" value="$(var rate)"/></node></launch>
    """)
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="a_b" default="10"/>
          <arg name="which" default="a_b"/>
          <log message="$(var $(var which))"/>
        </launch>
    """)


def test_arguments_that_launch_itself_reads_are_used() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="launch-prefix" default=""/>
          <arg name="emulate_tty" default="true"/>
          <arg name="rate" default="5"/>
                     ^^^^ hint[ARG008] unused argument 'rate': nothing in this launch uses it
          <node pkg="p" exec="e" name="n"/>
        </launch>
    """)


def test_an_argument_that_is_passed_to_a_file_which_never_uses_it_in_ros_2() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="speed" default="1.0"/>
          <arg name="rate" default="10"/>
          <include file="/inner.launch.xml">
            <arg name="rate" value="$(var rate)"/>
            <arg name="speed" value="$(var speed)"/>
                       ^^^^^ warning[ARG008] argument 'speed' has no effect: '/inner.launch.xml' declares it but never
          </include>
        </launch>
        //- /inner.launch.xml
        <launch>
          <arg name="rate"/>
          <arg name="speed"/>
          <node pkg="p" exec="x" name="x"><param name="rate" value="$(var rate)"/></node>
        </launch>
    """)


@pytest.mark.silent
def test_an_argument_that_is_passed_and_may_be_used_further_on_in_ros_2() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <include file="/inner.launch.xml">
            <arg name="speed" value="1"/>
            <arg name="rate" value="2"/>
            <arg name="name" value="x"/>
          </include>
          <include file="/other.launch.xml"/>
          <node pkg="p" exec="x" name="x"/>
        </launch>
        //- /inner.launch.xml
        <launch>
          <arg name="speed"/>
          <arg name="rate"/>
          <arg name="name"/>
          <let name="which" value="$(var name)"/>
          <!-- rate: for those that include this file -->
        </launch>
        //- /other.launch.xml
        <launch><log message="$(var speed)"/></launch>
    """)


@pytest.mark.parametrize(
    ("include", "said"),
    [
        (
            '"$(find p)/sensors.launch"> <arg name="camera" value="1"/> </include>',
            "warning[ARG008] argument 'camera' is never used in this file",
        ),
        (
            '"$(find p)/sensors.launch"> <arg name="other" value="1"/> </include>',
            "hint[ARG008] unused argument 'camera'",
        ),
        (
            '"$(arg p)/sensors.launch"> <arg name="camera" value="1"/> </include>',
            "hint[ARG008] unused argument 'camera'",
        ),
        (
            '"$(find p)/more_sensors.launch"> <arg name="camera" value="1"/> </include>',
            "hint[ARG008] unused argument 'camera'",
        ),
    ],
)
def test_an_argument_that_another_launch_passes(tmp_path: Path, include: str, said: str) -> None:
    (tmp_path / "teleop.launch").write_text(f"<launch><include file={include}</include></launch>")
    (tmp_path / "sensors.launch").touch()
    check(f"""
        //- {tmp_path}/sensors.launch
        <launch>
          <arg name="camera" default="true"/>
                     ^^^^^^ {said}
        </launch>
        //- {tmp_path}/package.xml
        <package><name>p</name></package>
    """)


@pytest.mark.parametrize(
    "left_out",
    ["<!-- <param name='rate' value='$(arg rate)'/> -->", "<rosparam><![CDATA[# rate: $(arg rate)]]></rosparam>"],
)
def test_an_argument_whose_use_is_left_out_is_for_information(left_out: str) -> None:
    check(f"""
        <launch>
          <include file="/inc.launch"><arg name="rate" value="2"/></include>
                                                 ^^^^ info[ARG008] argument 'rate' has no effect: '/inc.launch' uses
        </launch>
        //- /inc.launch
        <launch>
          <arg name="rate" default="10"/>
          {left_out}
        </launch>
    """)
