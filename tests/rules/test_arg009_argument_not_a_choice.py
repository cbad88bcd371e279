"""ARG009: an argument has a value that is not among its choices."""

import pytest
from support.check import check


def test_a_value_that_is_not_among_the_choices() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <include file="/lidar.launch.yaml">
            <arg name="model" value="s1"/>
                                     ^^ error[ARG009] invalid value 's1' of argument 'model'; the choices are 'a1',
          </include>
          <include file="/lidar.launch.yaml">
            <arg name="model" value="s2"/>
          </include>
        </launch>
        //- /lidar.launch.yaml
        launch:
          - arg:
              name: model
              default: a1
              choice:
                - value: a1
                - value: s2
          - log: {message: $(var model)}
    """)


@pytest.mark.silent
def test_values_among_the_choices() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="model" default="a1"><choice value="a1"/><choice value="s2"/></arg>
          <include file="/lidar.launch.xml"><arg name="kind" value="$(var model)"/></include>
        </launch>
        //- /lidar.launch.xml
        <launch>
          <arg name="kind"><choice value="a1"/></arg>
          <log message="$(var kind)"/>
        </launch>
    """)
