"""LCH044: a parameter or argument names a node that the launch does not start."""

import pytest
from support.check import check


def test_a_lifecycle_manager_that_has_another_name() -> None:
    check("""
        //- /map.launch.xml
        <launch>
          <node pkg="nav2_map_server" exec="map_server" name="map_server"/>
          <node pkg="nav2_amcl" exec="amcl" name="amcl"/>
          <node pkg="nav2_lifecycle_manager" exec="lifecycle_manager" name="manager">
            <param name="node_names" value="[map_sever, amcl, planner]"/>
                         ^^^^^^^^^^ warning[LCH044] '/map_sever' is not a node of this launch; /manager waits
                         ^^^^^^^^^^ info[LCH044] '/planner' is not a node of this launch; /manager waits for it
          </node>
        </launch>
        //- /nav2_map_server/package.xml
        <package><name>nav2_map_server</name></package>
        //- /nav2_amcl/package.xml
        <package><name>nav2_amcl</name></package>
        //- /nav2_lifecycle_manager/package.xml
        <package><name>nav2_lifecycle_manager</name></package>
    """)


def test_nodes_among_arguments() -> None:
    check("""
        //- /a.launch
        <launch>
          <node pkg="p" type="camera" name="camera"/>
          <node name="a" pkg="dynamic_reconfigure" type="dynparam"
            args="set /camra exposure 5"/>
                  ^^^^^^^^^^^^^^^^^^^^^ warning[LCH044] '/camra' is not a node of this launch; /a waits for it; did you
          <node name="b" pkg="dynamic_reconfigure" type="dynparam"
            args="get -t 5 /other"/>
                  ^^^^^^^^^^^^^^^ info[LCH044] '/other' is not a node of this launch; /b waits for it
        </launch>
        //- /p/package.xml
        <package><name>p</name></package>
        //- /dynamic_reconfigure/package.xml
        <package><name>dynamic_reconfigure</name></package>
    """)


@pytest.mark.silent
def test_nodes_that_are_there_and_what_is_below_them() -> None:
    check("""
        //- /a.launch
        <launch>
          <node pkg="p" type="camera" name="camera" ns="robot"/>
          <node pkg="dynamic_reconfigure" type="dynparam" name="one" ns="robot" args="set camera exposure 5"/>
          <node pkg="dynamic_reconfigure" type="dynparam" name="two" args="get /robot/camera/stereo/left"/>
          <node pkg="dynamic_reconfigure" type="dynparam" name="list" args="list"/>
        </launch>
        //- /p/package.xml
        <package><name>p</name></package>
        //- /dynamic_reconfigure/package.xml
        <package><name>dynamic_reconfigure</name></package>
    """)


@pytest.mark.silent
def test_the_rest_of_the_launch_is_not_known() -> None:
    check("""
        //- /map.launch.xml
        <launch>
          <arg name="more" default="false"/>
          <node pkg="nav2_lifecycle_manager" exec="lifecycle_manager" name="manager">
            <param name="node_names" value="[map_server]"/>
          </node>
          <include file="$(env MAPS /elsewhere.launch.xml)"/>
                         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[LCH013] included file '/elsewhere.launch.xml' does not
        </launch>
        //- /nav2_lifecycle_manager/package.xml
        <package><name>nav2_lifecycle_manager</name></package>
    """)
