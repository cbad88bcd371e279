"""PRM014: a parameter of another type than its node declares (ROS 2)."""

import pytest
from support.check import check


def test_a_parameter_of_another_type() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="pump" name="pump">
            <param name="rate" value="5"/>
                         ^^^^ error[PRM014] type mismatch of parameter 'rate': got an integer, /pump declares a
            <param name="speed" value="5.0"/>
            <param name="names" value="[a, b]"/>
            <param name="count" value="'5'"/>
                         ^^^^^ error[PRM014] type mismatch of parameter 'count': got a string, /pump declares an
            <param name="free" value="1"/>
            <param name="empty" value="[1, 2]"/>
          </node>
        </launch>
        //- interfaces
        {"/pump": {"params": {"~rate": 10.0, "~speed": 1.0, "~names": ["x"], "~count": 1, "~free": null, "~empty": []}}}
    """)


def test_a_parameter_of_another_type_than_it_arrives_with() -> None:
    """As real rclpy has it: `tests/evaluation/test_types_against_rclpy.py`."""
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a">
            <param name="rate" value="5"/>
                         ^^^^ error[PRM014] type mismatch of parameter 'rate': got an integer, /a declares a double;
            <param name="gains" value="[1, 2]"/>
                         ^^^^^ error[PRM014] type mismatch of parameter 'gains': got a list of integers, /a declares a
            <param name="axis" value="y" type="str"/>
                         ^^^^ error[PRM014] type mismatch of parameter 'axis': launch passes 'y' without quotes, and
            <param name="any" value="5"/>
            <param name="kind" value="5"/>
                         ^^^^ error[PRM014] type mismatch of parameter 'kind': got an integer, /a declares a string;
            <param name="frames" value="[a, b]"/>
                         ^^^^^^ error[PRM014] type mismatch of parameter 'frames': got a list of strings, /a declares
            <param from="/a.yaml"/>
          </node>
        </launch>
        //- /a.yaml
        a:
          ros__parameters:
            side: y
            ^^^^ error[PRM014] type mismatch of parameter 'side': got a bool, /a declares a string; the node exits
            name: "y"
            none: []
            ^^^^ error[PRM014] type mismatch of parameter 'none': an empty list has no type, /a declares a list of
        //- interfaces
        {"/a": {"params": {"~rate": 10.0, "~gains": [1.0], "~axis": "x", "~any": 1.0, "~side": "x", "~name": "x",
                           "~none": [1.0], "~kind": null, "~frames": []},
                "described": {"~any": {"dynamic": true}, "~kind": {"type": "string"},
                              "~frames": {"type": "byte array"}}}}
    """)


def test_simulated_time_that_is_no_bool() -> None:
    """As real rclpy has it: `tests/evaluation/test_types_against_rclpy.py`."""
    check("""
        //- /robot.launch.yaml
        launch:
          - set_parameter: {name: use_sim_time, value: simulated}
            ^^^^^^^^^^^^^ error[PRM014] type mismatch of parameter 'use_sim_time': got a string, /a declares a bool;
          - node: {pkg: p, exec: a, name: a}
          - node: {pkg: p, exec: b, name: b}
          - node:
              pkg: p
              exec: c
              name: c
              param:
                - {name: use_sim_time, value: 1}
                         ^^^^^^^^^^^^ error[PRM014] type mismatch of parameter 'use_sim_time': got an integer, /c
          - node:
              pkg: p
              exec: d
              name: d
              param:
                - {from: /d.yaml}
          - node:
              pkg: p
              exec: e
              name: e
              param:
                - {name: use_sim_time, value: false}
        //- /d.yaml
        d:
          ros__parameters:
            use_sim_time: yes please
            ^^^^^^^^^^^^ error[PRM014] type mismatch of parameter 'use_sim_time': got a string, /d declares a bool;
        //- interfaces
        {"/a": {}}
    """)


@pytest.mark.silent
def test_parameters_of_the_declared_type() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="pump" name="pump">
            <param name="speed" value="5.0"/>
            <param name="names" value="[a, b]"/>
            <param name="any" value="5"/>
          </node>
        </launch>
        //- interfaces
        {"/pump": {"params": {"~speed": 1.0, "~names": ["x"], "~any": 1.0}, "described": {"~any": {"dynamic": true}}}}
    """)


@pytest.mark.parametrize(
    ("value", "severity"), [("__MAX_SPEED__", "info"), ("'@MAX_SPEED@'", "info"), ("__init__", "error")]
)
def test_a_mark_that_a_program_replaces(value: str, severity: str) -> None:
    check(f"""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="pump" name="pump"><param from="/p/a.yaml"/></node>
        </launch>
        //- /p/a.yaml
        pump:
          ros__parameters:
            max_speed: {value}
            ^^^^^^^^^ {severity}[PRM014] type mismatch of parameter 'max_speed': got a string
        //- interfaces
        {{"/pump": {{"params": {{"~max_speed": 10.0}}}}}}
    """)


@pytest.mark.silent
def test_an_empty_list_for_an_empty_list() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="pump" name="pump"><param from="/p/a.yaml"/></node>
        </launch>
        //- /p/a.yaml
        pump:
          ros__parameters:
            fence: []
        //- interfaces
        {"/pump": {"params": {"~fence": {"type": "byte array"}}}}
    """)
