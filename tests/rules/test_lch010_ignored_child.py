"""LCH010: an element that roslaunch drops where it stands."""

import pytest
from support.check import check


def test_an_element_that_an_include_drops() -> None:
    check("""
        <launch>
          <include file="/inc.launch"><remap from="a" to="b"/></include>
                                       ^^^^^ warning[LCH010] <remap> has no effect in <include>
        </launch>
        //- /inc.launch
        <launch/>
    """)


@pytest.mark.silent
def test_what_an_include_passes_on() -> None:
    check("""
        <launch>
          <include file="/inc.launch"><arg name="a" value="1"/><env name="B" value="2"/></include>
        </launch>
        //- /inc.launch
        <launch><arg name="a"/><param name="a" value="$(arg a)"/></launch>
    """)
