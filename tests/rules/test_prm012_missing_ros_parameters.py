"""PRM012: values of a parameter file that stand below no `ros__parameters` (ROS 2)."""

import pytest
from support.check import check


def test_values_above_the_mark() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a"><param from="/a.yaml"/></node>
        </launch>
        //- /a.yaml
        a:
          rate: 30
          ^^^^ error[PRM012] 'rate' does not stand below 'ros__parameters'
          name: front
    """)


@pytest.mark.silent
def test_a_component_takes_a_file_without_the_mark() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node_container pkg="p" exec="x" name="c" namespace="">
            <composable_node pkg="p" plugin="p::A" name="a"><param from="/a.yaml"/></composable_node>
          </node_container>
        </launch>
        //- /a.yaml
        rate: 30
        //- interfaces
        {"/a": {"params": {"~rate": 1}}}
    """)
