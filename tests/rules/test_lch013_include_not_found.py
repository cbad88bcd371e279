"""LCH013: an include of a file that is not there."""

import pytest
from support.check import check, findings_of


def test_an_included_file_that_is_not_there() -> None:
    check("""
        <launch>
          <include file="$(find p)/launch/base.launch"/>
                         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[LCH013] included file 'p/launch/base.launch' does not exist
        </launch>
    """)


def test_a_file_outside_of_any_package_that_is_not_there() -> None:
    assert [f.rule for f in findings_of('<launch><include file="/nowhere/at_all.launch"/></launch>')] == ["LCH013"]


@pytest.mark.silent
def test_an_included_file_that_is_there_or_not_included() -> None:
    check("""
        <launch>
          <arg name="more" default="false"/>
          <include file="/inc.launch"/>
          <include file="/gone.launch" if="$(arg more)"/>
        </launch>
        //- /inc.launch
        <launch/>
    """)
