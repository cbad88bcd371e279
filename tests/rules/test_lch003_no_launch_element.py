"""LCH003: the document element is not <launch>."""

import pytest
from support.check import check


def test_no_launch_element() -> None:
    check("""
        <robot>
         ^^^^^ error[LCH003] root element is <robot>, not <launch>
        </robot>
    """)


def test_a_second_launch_element_is_told_once() -> None:
    check("""
        <launch>
          <launch>
           ^^^^^^ error[LCH003] <launch> inside of <launch>; roslaunch allows only one
            <arg name="a" value="1"/>
          </launch>
        </launch>
    """)


@pytest.mark.silent
def test_a_comment_before_the_launch_element() -> None:
    check("""
        <!-- a robot -->
        <launch/>
    """)
