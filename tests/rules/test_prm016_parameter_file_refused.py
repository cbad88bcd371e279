"""PRM016: a parameter file that is YAML and that rcl refuses (ROS 2)."""

import pytest
from support.check import check


def test_what_a_parameter_file_cannot_have() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a"><param from="/a.yaml"/></node>
          <node_container pkg="p" exec="c" name="c" namespace="">
            <composable_node pkg="p" plugin="p::D" name="d" namespace="/b"><param from="/d.yaml"/></composable_node>
          </node_container>
        </launch>
        //- /d.yaml
        /b:
          /d:
            ros__parameters: {x: 1}
        //- /a.yaml
        a:
          ros__parameters:
            gains: [1, 2.5]
                   ^^^^^^^^ error[PRM016] a list with doubles and integers in it: 'gains'; rcl refuses the whole file,
            grid: [[1, 2], [3, 4]]
                  ^^^^^^^^^^^^^^^^ error[PRM016] a list of lists: 'grid'
            tilde: ~
            fine: [1.0, 2.5]
        /b:
        ^^ error[PRM016] a node's name with two slashes: '/b//c'
          /c:
            ros__parameters: {x: 1}
    """)


def test_what_rcl_makes_nothing_of() -> None:
    """As real rcl has it: `tests/evaluation/test_types_against_rclpy.py`."""
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a"><param from="/a.yaml"/></node>
          <node pkg="p" exec="b" name="b"><param from="/b.yaml"/></node>
          <node pkg="p" exec="c" name="c"><param from="/c.yaml"/></node>
        </launch>
        //- /a.yaml
        a:
          ros__parameters:
          ^^^^^^^^^^^^^^^ error[PRM016] 'ros__parameters' without parameters below it
        //- /b.yaml
        b:
          ros__parameters:
            rate: &rate 5
            again: *rate
                   ^^^^^ error[PRM016] an alias ('*rate'); rcl refuses the whole file
        //- /c.yaml
        c:
          ros__parameters:
            plugins: [{name: front, port: 3}]
                     ^^^^^^^^^^^^^^^^^^^^^^^^ error[PRM016] a list with dictionaries in it: 'plugins'
            gains: {}
            ^^^^^ error[PRM016] an empty group of parameters before others: 'gains'
            rate: 5
    """)


def test_one_bad_value_stops_each_node_that_gets_the_file() -> None:
    """As real rclpy has it: `tests/evaluation/test_types_against_rclpy.py`."""
    findings = check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a"><param from="/a.yaml"/></node>
          <node pkg="p" exec="b" name="b"><param from="/a.yaml"/></node>
          <node pkg="p" exec="c" name="c"><param name="axes" value="[x, y, z]"/></node>
                                                       ^^^^ error[PRM016] parameter 'axes' arrives as a list with
          <node pkg="p" exec="d" name="d"><param name="axes" value="[a, b]"/></node>
        </launch>
        //- /a.yaml
        a:
          ros__parameters:
            axes: [x, y, z]
                  ^^^^^^^^^ error[PRM016] a list with bools and texts in it: 'axes'; rcl refuses the whole file, and
            quoted: [x, "y", z]
        b:
          ros__parameters: {rate: 1}
    """)
    (of_file,) = (finding for finding in findings if finding.location.file == "/a.yaml")
    assert [each.message for each in of_file.related] == ["/a gets the file here", "/b gets the file here"]


def test_a_parameter_file_whose_substitutions_launch_makes() -> None:
    """What they come to is not in the text: `[$(var a), 2.5]` is a list of doubles, and a key may become any name."""
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="gain" default="1.5"/>
          <arg name="name" default="arm"/>
          <node pkg="p" exec="arm" name="$(var name)">
            <param from="/named.yaml" allow_substs="true"/>
            <param from="/gains.yaml" allow_substs="true"/>
          </node>
        </launch>
        //- /named.yaml
        $(var name):
          ros__parameters:
            gains: [$(var gain), 2.5]
        //- /gains.yaml
        arm:
          ros__parameters:
            offsets: [1, 2.5]
                     ^^^^^^^^ error[PRM016] a list with doubles and integers in it: 'offsets'
    """)


def test_a_substitution_in_a_parameter_file_that_nobody_makes() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="arm" name="arm"><param from="/gains.yaml"/></node>
        </launch>
        //- /gains.yaml
        arm:
          ros__parameters:
            gains: [$(var gain), 2.5]
                   ^^^^^^^^^^^^^^^^^^ error[PRM016] a list with doubles and texts in it: 'gains'
                    ^^^^^^^^^^^ warning[LCH029] '$(var gain)' is treated as literal text; substitutions in YAML need
    """)


@pytest.mark.silent
def test_values_that_a_parameter_file_can_have() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a"><param from="/a.yaml"/></node>
        </launch>
        //- /a.yaml
        /ns/b:
          ros__parameters: {x: 1}
        a:
          ros__parameters:
            gains: [1.0, 2.5]
            names: [x, "z"]
            tilde: ~
            nested: {rate: 1}
    """)
