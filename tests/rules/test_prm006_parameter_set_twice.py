"""PRM006: a parameter is set to one value and then to another."""

import pytest
from support.check import check


def test_a_parameter_set_twice_where_the_lost_value_is_easily_missed() -> None:
    first, *_ = check("""
        <launch>
          <param name="use_sim_time" value="true"/>
                       ^^^^^^^^^^^^ warning[PRM006] overridden: parameter '/use_sim_time' is set again by a later
          <param name="n/rate" value="1"/>
                       ^^^^^^ warning[PRM006] overridden: parameter '/n/rate' is set again below to '2', not '1'
          <node pkg="p" type="t" name="n">
            <param name="rate" value="2"/>
            <param name="limit" value="3"/>
            <rosparam>{limit: 4}</rosparam>
                       ^^^^^ warning[PRM006] overridden: parameter '/n/limit' is set by the <param> of the <node>,
            <param name="tolerance" value="0.2"/>
                         ^^^^^^^^^ warning[PRM006] overridden: parameter '/n/tolerance' is set again below to '0.1',
            <param name="tolerance" value="0.1"/>
          </node>
          <group>
            <param name="~frame" value="map"/>
            <node pkg="p" type="t" name="m"><rosparam param="frame">odom</rosparam></node>
                                            ^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM006] overridden: parameter '/m/frame'
          </group>
          <param name="m/gain" value="1"/>
                       ^^^^^^ warning[PRM006] overridden: parameter '/m/gain' is set again by a later file to '2', not
          <rosparam file="/gains.yaml"/>
          <include file="/inc.launch"/>
        </launch>
        //- /inc.launch
        <launch><param name="use_sim_time" value="false"/></launch>
        //- /gains.yaml
        m: {gain: 2}
    """)
    assert first.related[0].location.file == "/inc.launch"


@pytest.mark.silent
def test_parameters_that_are_overridden_on_purpose() -> None:
    check("""
        <launch>
          <arg name="sim" default="true"/>
          <param name="use_sim_time" value="false"/>
          <param name="use_sim_time" value="true" if="$(arg sim)"/>
          <include file="/inc.launch"/>
          <param name="speed" value="2"/>
          <param name="mode" value="1"/>
          <include file="/mode.launch" if="$(arg sim)"/>
          <param name="~rate" value="1"/>
          <node pkg="p" type="t" name="n">
            <param name="rate" value="2"/>
            <rosparam file="/defaults.yaml"/>
            <param name="gain" value="3"/>
            <param name="same" value="3"/>
            <param name="same" value="3"/>
          </node>
        </launch>
        //- /inc.launch
        <launch><param name="speed" value="1"/></launch>
        //- /mode.launch
        <launch><param name="mode" value="2"/></launch>
        //- /defaults.yaml
        {rate: 5, gain: 1}
    """)


def test_settings_that_may_be_layers_are_hints() -> None:
    check("""
        <launch>
          <rosparam param="a">{x: 1, y: 2}</rosparam>
                               ^ hint[PRM006] overridden: parameter '/a/x' is set again by a later <rosparam> to '3',
          <rosparam param="a">{x: 3}</rosparam>
          <include file="/one.launch"/>
          <include file="/two.launch"/>
        </launch>
        //- /one.launch
        <launch><param name="speed" value="1"/></launch>
                             ^^^^^ hint[PRM006] overridden: parameter '/speed' is set again by another included file
        //- /two.launch
        <launch><param name="speed" value="2"/></launch>
    """)


def test_a_key_that_stands_twice_in_a_dictionary() -> None:
    check("""
        <launch>
          <rosparam file="/a.yaml"/>
          <rosparam>{rate: 1, rate: 1}</rosparam>
        </launch>
        //- /a.yaml
        costmap:
        ^^^^^^^ warning[PRM006] duplicate key 'costmap' in this dictionary: the later one overrides this one
          width: 3
        costmap:
          height: 4
        lists: [{a: 1}, {a: 2}]
    """)


def test_a_private_parameter_around_a_node_that_is_named_in_full_as_well() -> None:
    check("""
        <launch>
          <param name="~rate" value="1"/>
          <param name="n/rate" value="2"/>
                       ^^^^^^ warning[PRM006] overridden: parameter '/n/rate' is set by an earlier <param> for the
          <node pkg="p" type="t" name="n"/>
        </launch>
    """)


def test_a_parameter_from_two_sources() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <set_parameter name="rate" value="1"/>
          <node pkg="p" exec="a" name="a">
            <param name="rate" value="10"/>
                         ^^^^ warning[PRM006] overridden: parameter 'rate' of /a is set again by a later parameter
            <param from="/a.yaml"/>
          </node>
          <node pkg="p" exec="b" name="b">
            <param from="/a.yaml"/>
            <param name="rate" value="10"/>
          </node>
          <node pkg="p" exec="c" name="c">
            <param name="rate" value="10"/>
                         ^^^^ warning[PRM006] overridden: parameter 'rate' of /c is set again below to '11', not '10'
            <param name="rate" value="11"/>
          </node>
        </launch>
        //- /a.yaml
        /**:
          ros__parameters: {rate: 20}
    """)


def test_a_wildcard_after_the_name_and_a_value_after_both() -> None:
    """As real rclpy has it: `tests/evaluation/test_params_against_rclpy.py`."""
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a">
            <param from="/wild_last.yaml"/>
          </node>
          <node pkg="p" exec="b" name="b">
            <param from="/wild_first.yaml"/>
            <param name="rate" value="10"/>
                         ^^^^ warning[PRM006] overridden: parameter 'rate' of /b is set by key '/b' of an earlier
          </node>
          <node pkg="p" exec="b" name="b" namespace="own">
            <param from="/wild_first.yaml"/>
            <param name="rate" value="10"/>
          </node>
          <node_container pkg="p" exec="c" name="c" namespace="">
            <composable_node pkg="p" plugin="p::D" name="d" namespace="">
              <param from="/composable.yaml"/>
            </composable_node>
          </node_container>
        </launch>
        //- /wild_last.yaml
        /a:
          ros__parameters: {rate: 1}
                            ^^^^ warning[PRM006] overridden: parameter 'rate' of /a is set again by the later key
        /**:
          ros__parameters: {rate: 2}
        //- /composable.yaml
        /d:
          ros__parameters: {rate: 1}
        /**:
          ros__parameters: {rate: 2}
        //- /wild_first.yaml
        /**:
          ros__parameters: {rate: 1}
        /b:
          ros__parameters: {rate: 2}
        /own/b:
          ros__parameters: {rate: 3}
    """)


@pytest.mark.silent
def test_one_number_in_two_forms() -> None:
    check("""
        <launch>
          <param name="rate" value="1.0"/>
          <param name="rate" value="1"/>
        </launch>
    """)


def test_an_argument_before_a_file_that_sets_its_default() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="sim" default="false"/>
          <node pkg="p" exec="a" name="a">
            <param name="use_sim_time" value="$(var sim)"/>
                         ^^^^^^^^^^^^ warning[PRM006] is set again by a later parameter file; argument 'sim' does not
            <param from="/a.yaml"/>
          </node>
          <node pkg="p" exec="b" name="b">
            <param from="/a.yaml"/>
            <param name="use_sim_time" value="$(var sim)"/>
          </node>
          <node pkg="p" exec="c" name="c">
            <param name="use_sim_time" value="false"/>
            <param from="/a.yaml"/>
          </node>
          <node pkg="p" exec="d" name="d">
            <param name="use_sim_time" value="$(var sim)"/>
            <param from="/d.yaml" allow_substs="true"/>
          </node>
        </launch>
        //- /a.yaml
        /**:
          ros__parameters: {use_sim_time: false}
        //- /d.yaml
        /**:
          ros__parameters:
            use_sim_time: $(var sim)
    """)


def test_a_key_of_a_file_of_ros2_stands_there_twice() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="pump" name="pump"><param from="/pump.yaml"/></node>
        </launch>
        //- /pump.yaml
        pump:
          ros__parameters:
            message: all is well
            ^^^^^^^ warning[PRM006] duplicate key 'message' in this section: the later one overrides it with 'off'
            limits.high: 2
            ^^^^^^^^^^^ hint[PRM006] duplicate key 'limits.high' in this section
            message: 'off'
            limits: {high: 2, low: 1}
        other:
          ros__parameters: {message: ''}
    """)
