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
          ^^^^ error[PRM012] parameter 'rate' is not below 'ros__parameters'; rcl refuses the whole file
          name: front
    """)


@pytest.mark.silent
@pytest.mark.parametrize("lines", ["rate: 30", "x-common: {rate: 30}\n        a: {ros__parameters: {rate: 1}}"])
def test_a_component_takes_the_sections_of_a_file_or_all_of_it(lines: str) -> None:
    check(f"""
        //- /robot.launch.xml
        <launch>
          <node_container pkg="p" exec="x" name="c" namespace="">
            <composable_node pkg="p" plugin="p::A" name="a"><param from="/a.yaml"/></composable_node>
          </node_container>
        </launch>
        //- /a.yaml
        {lines}
        //- interfaces
        {{"/a": {{"params": {{"~rate": 1}}}}}}
    """)
