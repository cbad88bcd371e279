"""ARG011: the launch is given an argument that nothing asks for."""

import pytest
from support.check import check


def test_an_argument_of_the_command_line_that_nothing_asks_for() -> None:
    fixture = """
        <launch>
         ^^^^^^ warning[ARG011] unknown argument 'cammera': no file of this launch declares it; did you mean 'camera'?
          <arg name="camera" default="true"/>
          <arg name="sim" default="false"/>
          <group if="$(arg sim)"><arg name="lidar" default="true"/><param name="a" value="$(arg lidar)"/></group>
          <node pkg="p" type="t" name="n" args="$(arg camera)"/>
        </launch>
    """
    check(fixture, args={"cammera": "false", "lidar": "x", "__ns": "/a"})


@pytest.mark.silent
def test_an_include_may_be_handed_what_is_not_declared() -> None:
    check(
        """
        <launch>
          <include file="/camera.launch" pass_all_args="true"/>
        </launch>
        //- /camera.launch
        <launch><arg name="camera" default="true"/><node pkg="p" type="t" name="$(arg camera)"/></launch>
        """,
        args={"camera": "false"},
    )


def test_an_argument_of_a_ros_2_launch_that_nothing_asks_for() -> None:
    """What an included file declares is known in it without being passed; what is not read may ask for anything."""
    fixture = """
        //- /robot.launch.xml
        <launch>
         ^^^^^^ warning[ARG011] unknown argument 'cammera': no file of this launch declares it; did you mean 'camera'?
          <include file="/camera.launch.xml"/>
          <log message="$(var mode)"/>
        </launch>
        //- /camera.launch.xml
        <launch><arg name="camera" default="true"/><log message="$(var camera)"/></launch>
    """
    check(fixture, args={"cammera": "false", "camera": "true", "mode": "slow"})
    check(
        """
        //- /robot.launch.xml
        <launch>
          <arg name="mode" default="slow"/>
          <include file="/camera.launch.xml" if="$(equals $(var mode) fast)"/>
        </launch>
        //- /camera.launch.xml
        <launch><arg name="camera" default="true"/><log message="$(var camera)"/></launch>
        """,
        args={"camera": "false"},
    )
