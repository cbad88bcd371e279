"""ARG010: an argument of a file that an include in it sets to another value (ROS 2)."""

import pytest
from support.check import check


def test_an_argument_that_an_include_overwrites() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="name" default="robot"/>
          <include file="/camera.launch.xml">
            <arg name="name" value="front"/>
          </include>
          <node pkg="p" exec="base" name="$(var name)_base"/>
                                          ^^^^^^^^^^^ warning[ARG010] argument 'name' is overwritten with 'front' (was
        </launch>
        //- /camera.launch.xml
        <launch>
          <arg name="name"/>
          <node pkg="p" exec="camera" name="$(var name)_camera"/>
        </launch>
    """)


def test_an_argument_that_an_included_file_sets() -> None:
    check("""
        //- /robot.launch.yaml
        launch:
          - arg: {name: mode, default: slow}
          - include: {file: /arm.launch.xml}
          - node: {pkg: p, exec: base, name: $(var mode)}
                                             ^^^^^^^^^^^ warning[ARG010] argument 'mode' is overwritten with 'fast'
        //- /arm.launch.xml
        <launch>
          <let name="mode" value="fast"/>
          <log message="$(var mode)"/>
        </launch>
    """)


@pytest.mark.silent
def test_arguments_that_stay_what_they_are() -> None:
    """In a group, with the same value, not used any more, or set by the file itself."""
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="name" default="robot"/>
          <arg name="rate" default="5"/>
          <group>
            <include file="/camera.launch.xml"><arg name="name" value="front"/></include>
          </group>
          <include file="/camera.launch.xml"><arg name="name" value="robot"/></include>
          <node pkg="p" exec="base" name="$(var name)_base"/>
          <let name="rate" value="10"/>
          <log message="$(var rate)"/>
          <include file="/camera.launch.xml"><arg name="name" value="rear"/></include>
          <let name="name" value="robot"/>
          <log message="$(var name)"/>
        </launch>
        //- /camera.launch.xml
        <launch>
          <arg name="name" default="camera"/>
          <log message="$(var name)"/>
        </launch>
    """)
