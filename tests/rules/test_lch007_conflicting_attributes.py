"""LCH007: attributes that exclude each other."""

import pytest
from support.check import check
from support.fixes import fixed


def test_one_of_the_attributes_that_exclude_each_other_is_kept() -> None:
    tag = '<param name="a" value="1"\n  textfile="b"/>'
    assert fixed(tag, "LCH007", 0) == '<param name="a" value="1"/>'
    assert fixed(tag, "LCH007", 1) == '<param name="a"\n  textfile="b"/>'


@pytest.mark.silent
def test_attributes_that_go_together() -> None:
    check("""
        <launch>
          <arg name="a" default="1" doc="the rate"/>
          <param name="a" value="$(arg a)" type="int"/>
        </launch>
    """)
