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
                                          ^^^^^^^ warning[LCH005] no attribute 'respwan'; did you mean 'respawn'?
        </launch>
    """)


@pytest.mark.silent
def test_attributes_that_are_known() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n" ns="a" args="x" respawn="true" respawn_delay="3" required="false" output="log"
                cwd="node" launch-prefix="nice" clear_params="false"/>
        </launch>
    """)
