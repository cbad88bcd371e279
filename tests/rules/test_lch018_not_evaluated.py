"""LCH018: what roslaunch would evaluate and the analysis does not."""

import pytest
from support.check import check


def test_what_is_not_evaluated_is_said_and_stops_nothing() -> None:
    (finding,) = check("""
        <launch>
          <param name="a" value="$(eval [x for x in 'ab'])"/>
                                 ^^^^^^^^^^^^^^^^^^^^^^^^^ info[LCH018] is not evaluated
        </launch>
    """)
    assert not finding.stops_launch


def test_a_command_that_was_not_run_is_a_hint() -> None:
    check("""
        <launch>
          <arg name="model" default="arm"/>
          <param name="robot_description" command="xacro $(arg model).xacro"/>
                                                   ^^^^^^^^^^^^^^^^^^^^^^^^ hint[LCH018] command not run, its value is
        </launch>
        //- commands
        {"xacro arm.xacro": {"status": "not-run", "reason": "no trust"}}
    """)


@pytest.mark.silent
def test_expressions_of_values() -> None:
    check("""
        <launch>
          <arg name="a" default="2"/>
          <param name="a" value="$(eval max(arg('a'), 1) * 2 if arg('a') else 'none')"/>
        </launch>
    """)
