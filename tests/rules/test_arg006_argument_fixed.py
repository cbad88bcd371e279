"""ARG006: a value is passed for an argument that the file fixes."""

import pytest
from support.check import check


def test_an_argument_that_the_file_fixes() -> None:
    check("""
        <launch>
          <include file="/inc.launch"><arg name="a" value="1"/></include>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[ARG006] argument 'a' cannot be passed
        </launch>
        //- /inc.launch
        <launch><arg name="a" value="2"/></launch>
    """)


@pytest.mark.silent
def test_a_default_may_be_replaced() -> None:
    check("""
        <launch>
          <include file="/inc.launch"><arg name="a" value="1"/></include>
        </launch>
        //- /inc.launch
        <launch><arg name="a" default="2"/><arg name="b" value="$(arg a)"/><param name="b" value="$(arg b)"/></launch>
    """)
