"""ARG003: the file cannot be launched without an argument on the command line."""

import pytest
from support.check import check


def test_an_argument_that_the_command_line_must_give() -> None:
    text = """
        <launch>
          <arg name="robot"/>
                     ^^^^^ info[ARG003] argument 'robot' has no default; launch with robot:=...
          <param name="a" value="$(arg robot)"/>
        </launch>
    """
    (finding,) = check(text)
    assert finding.stops_launch
    without = "\n".join(line for line in text.splitlines() if "^" not in line)
    assert check(without, args={"robot": "tb"}) == []


def test_an_argument_needed_though_it_is_set_before() -> None:
    """launch looks for required arguments before it executes anything."""
    check("""
        //- /a.launch.xml
        <launch>
          <let name="a" value="1"/>
          <arg name="a"/>
          ^^^^^^^^^^^^^^^ info[ARG003] argument 'a' has no default; launch with a:=...
        </launch>
    """)


@pytest.mark.silent
def test_arguments_that_are_given_or_have_a_default() -> None:
    check(
        """
        <launch>
          <arg name="robot"/>
          <arg name="mode" default="slow"/>
          <param name="mode" value="$(arg mode) $(arg robot)"/>
        </launch>
    """,
        args={"robot": "r2"},
    )
