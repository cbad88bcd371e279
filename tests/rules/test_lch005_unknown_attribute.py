"""LCH005: an attribute that roslaunch does not know."""

import pytest
from support.check import check
from support.fixes import unfixable


def test_no_attribute_becomes_a_second_one_of_its_name() -> None:
    assert unfixable('<param name="a" value="1" vaule="2"/>', "LCH005")


def test_an_unknown_attribute() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n" respwan="true"/>
                                          ^^^^^^^ warning[LCH005] unknown attribute 'respwan' of <node>; did you mean
        </launch>
    """)


@pytest.mark.silent
def test_attributes_that_are_known() -> None:
    check("""
        <launch xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="roslaunch.xsd">
          <node pkg="p" type="t" name="n" ns="a" args="x" respawn="true" respawn_delay="3" required="false" output="log"
                cwd="node" launch-prefix="nice" clear_params="false"/>
        </launch>
    """)


@pytest.mark.silent
def test_launch_of_ros2_asks_nothing_of_the_root() -> None:
    check("""
        //- /robot.launch.xml
        <launch version="0.1.0" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="a">
          <let name="a" value="1"/>
        </launch>
    """)


def test_launch_of_ros2_asks_of_everything_below_the_root() -> None:
    check("""
        //- /robot.launch.xml
        <launch version="0.1.0">
          <let name="a" value="1" version="0.1.0"/>
                                  ^^^^^^^ error[LCH005] unknown attribute 'version' of <let>
        </launch>
    """)
