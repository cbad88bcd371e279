"""LCH008: an attribute's value is not one of those that it can have."""

import pytest
from support.check import check
from support.fixes import fixed, unfixable


def test_what_a_command_printed_must_be_of_the_type() -> None:
    check("""
        <launch>
          <param name="a" type="int" command="echo one"/>
                                              ^^^^^^^^ error[LCH008] an integer
          <param name="b" type="yaml" command="echo '[1, 2]'"/>
        </launch>
        //- commands
        {"echo one": {"output": "one\\n"}, "echo '[1, 2]'": {"output": "[1, 2]\\n"}}
    """)


@pytest.mark.parametrize(
    ("tag", "after"),
    [
        ('<node pkg="p" type="t" name="n" respawn="ture"/>', '<node pkg="p" type="t" name="n" respawn="true"/>'),
        ('<node pkg="p" type="t" name="n" respawn="1"/>', '<node pkg="p" type="t" name="n" respawn="true"/>'),
        ('<group if="yes"/>', '<group if="true"/>'),
        ('<group unless="Off"/>', '<group unless="false"/>'),
        ('<param name="a" value="1" type="duble"/>', '<param name="a" value="1" type="double"/>'),
        ('<param name="a" value="10.0" type="int"/>', '<param name="a" value="10" type="int"/>'),
        ('<rosparam command="laod" file="x"/>', '<rosparam command="load" file="x"/>'),
        (
            '<machine name="m" address="a" default="nevr"/>',
            '<machine name="m" address="a" default="never"/>',
        ),
    ],
)
def test_a_bad_value_becomes_the_one_that_is_meant(tag: str, after: str) -> None:
    assert fixed(tag, "LCH008") == after


@pytest.mark.parametrize(
    "tag", ['<group if="perhaps"/>', '<param name="a" value="10.5" type="int"/>', '<group ns=""/>']
)
def test_a_bad_value_that_could_be_anything_has_no_fix(tag: str) -> None:
    assert unfixable(tag, "LCH008")


def test_a_bad_value_and_the_nearest_choice() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n" output="scren"/>
                                                  ^^^^^ error[LCH008] did you mean 'screen'?
          <node pkg="p" type="t" name="m" if="maybe"/>
                                              ^^^^^ error[LCH008] invalid value 'maybe' of attribute 'if' of <node>:
        </launch>
    """)


def test_a_condition_that_is_no_boolean() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="joystick" default="enabled"/>
          <group if="$(var joystick)">
                     ^^^^^^^^^^^^^^^ error[LCH008] invalid value 'enabled' of attribute 'if' of <group>: expected
            <node pkg="p" exec="joy"/>
          </group>
          <group unless="$(equals $(var joystick) enabled)">
            <node pkg="nowhere" exec="$(var never)"/>
          </group>
        </launch>
    """)


def test_yaml_that_is_no_text() -> None:
    """`launch_yaml` makes nothing of anything, and most attributes are texts."""
    check("""
        //- /a.launch.yaml
        launch:
          - arg: {name: rate, default: 5}
                                       ^ error[LCH008] invalid value '5' of attribute 'default' of <arg>: expected a
          - let: {name: sim, value: true}
                                    ^^^^ error[LCH008] invalid value 'true' of attribute 'value' of <let>: expected a
          - log: {message: $(var rate)}
          - executable: {cmd: ls, sigterm_timeout: 5}
                                                   ^ error[LCH008] invalid value '5' of attribute 'sigterm_timeout' of
    """)


@pytest.mark.silent
def test_yaml_that_is_what_it_has_to_be() -> None:
    check("""
        //- /a.launch.yaml
        launch:
          - arg: {name: rate, default: '5'}
          - log: {message: $(var rate)}
          - executable: {cmd: ls, sigterm_timeout: 5.0, shell: true, respawn: 'false', respawn_max_retries: 3}
          - group: {scoped: true, children: []}
          - node: {pkg: p, exec: e, name: n, param: [{name: a, value: 1}, {name: b, value: [1]}]}
    """)


def test_a_refused_value_where_a_condition_is_false() -> None:
    """The whole file is read before any of it is executed."""
    check("""
        //- /a.launch.xml
        <launch>
          <group if="false">
            <node pkg="p" exec="e" name="n" args="it's" respawn_delay="$(var delay)">
                                                  ^^^^ error[LCH008] invalid value 'it's' of attribute 'args' of
                                                                       ^^^^^^^^^^^^ error[LCH008] invalid value '$(var
              <param name="a" value="[1, 2.5]"/>
                                     ^^^^^^^^ error[LCH008] invalid value '[1, 2.5]' of attribute 'value' of <param>:
              <param name="b" value="[$(var x), 1, y]"/>
                                     ^^^^^^^^^^^^^^^^ error[LCH008] invalid value '[$(var x), 1, y]' of attribute
              <param name="c" type="float" value="fast"/>
                                                  ^^^^ error[LCH008] invalid value 'fast' of attribute 'value' of
              <param name="d" value="$(unknown x)"/>
                                     ^^^^^^^^^^^^ error[LCH011] 'unknown' is not a substitution
            </node>
          </group>
        </launch>
    """)


def test_simulated_time_by_a_tag() -> None:
    """The frontends hand a text over where the action takes a bool only."""
    check("""
        //- /a.launch.xml
        <launch>
          <set_use_sim_time value="true" if="false"/>
          <set_use_sim_time value="true"/>
                                   ^^^^ error[LCH008] invalid value 'true' of attribute 'value' of <set_use_sim_time>:
        </launch>
    """)


def test_an_output_that_launch_does_not_know() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="to" default="image"/>
          <node pkg="p" exec="e" output="$(var to)"/>
                                         ^^^^^^^^^ error[LCH008] invalid value 'image' of attribute 'output' of
          <executable cmd="ls" output="scren"/>
                                       ^^^^^ error[LCH008] did you mean 'screen'?
          <node pkg="p" exec="f" output="own_log"/>
        </launch>
    """)


@pytest.mark.silent
def test_outputs_in_python() -> None:
    check("""
        //- /robot.launch.py
        from launch import LaunchDescription
        from launch_ros.actions import Node

        def generate_launch_description():
            return LaunchDescription([
                Node(package="p", executable="e", output={"stdout": "screen", "stderr": "log"}),
                Node(package="p", executable="f", output="both"),
            ])
    """)


def test_a_namespace_that_is_empty_as_its_argument_is() -> None:
    check("""
        <launch>
          <arg name="robot" default=""/>
          <node pkg="p" type="t" name="n" ns="$(arg robot)"/>
                                              ^^^^^^^^^^^^ info[LCH008] is empty; set argument 'robot'
        </launch>
    """)
