"""LCH012: $(env) of a variable that is not set."""

import pytest
from support.check import check


def test_an_environment_variable_that_is_not_set() -> None:
    (finding,) = check("""
        <launch>
          <param name="a" value="$(env NOT_SET_ANYWHERE)"/>
                                 ^^^^^^^^^^^^^^^^^^^^^^^ warning[LCH012] 'NOT_SET_ANYWHERE' is not set
        </launch>
    """)
    assert finding.stops_launch


@pytest.mark.silent
def test_a_variable_that_need_not_be_set() -> None:
    check("""
        <launch>
          <arg name="more" default="false"/>
          <param name="a" value="$(optenv NOT_SET_ANYWHERE none)"/>
          <param name="b" value="$(env NOT_SET_ANYWHERE)" if="$(arg more)"/>
        </launch>
    """)
