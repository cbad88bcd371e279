"""ARG007: an include's <arg> without a value."""

import pytest
from support.check import check


def test_an_argument_that_is_passed_without_a_value() -> None:
    check("""
        <launch>
          <include file="/inc.launch"><arg name="a"/></include>
                                                 ^ error[ARG007] argument 'a' is passed without a value
        </launch>
        //- /inc.launch
        <launch><arg name="a" default="2"/><param name="a" value="x$(arg a)"/></launch>
    """)


@pytest.mark.silent
def test_an_empty_value_is_one() -> None:
    check("""
        <launch>
          <include file="/inc.launch"><arg name="a" value=""/></include>
        </launch>
        //- /inc.launch
        <launch><arg name="a" default="2"/><param name="a" value="x$(arg a)"/></launch>
    """)
