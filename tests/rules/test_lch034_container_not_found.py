"""LCH034: components for a container that the launch does not start (ROS 2)."""

import pytest
from support.check import check


def test_a_container_that_is_not_there() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <group>
            <push_ros_namespace namespace="robot"/>
            <node_container pkg="rclcpp_components" exec="component_container" name="vision" namespace=""/>
            <load_composable_node target="vision">
                                          ^^^^^^ warning[LCH034] no node '/vision'
              <composable_node pkg="p" plugin="p::Detector" name="detector"/>
            </load_composable_node>
            <load_composable_node target="/robot/vision">
              <composable_node pkg="p" plugin="p::Tracker" name="tracker"/>
            </load_composable_node>
          </group>
          <load_composable_node target="/elsewhere">
                                        ^^^^^^^^^^ hint[LCH034] no node '/elsewhere' is started by this launch
            <composable_node pkg="p" plugin="p::Mapper" name="mapper"/>
          </load_composable_node>
        </launch>
        //- /rclcpp_components/package.xml
        <package><name>rclcpp_components</name></package>
    """)


def test_the_only_container_is_meant_where_it_stays_empty() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node_container pkg="p" exec="component_container" name="camera_container" namespace=""/>
          <load_composable_node target="cam_container">
                                        ^^^^^^^^^^^^^ warning[LCH034] did you mean '/camera_container'?
            <composable_node pkg="p" plugin="p::Mapper" name="mapper"/>
          </load_composable_node>
        </launch>
    """)


@pytest.mark.silent
def test_a_container_in_its_namespace() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <group>
            <push_ros_namespace namespace="robot"/>
            <node_container pkg="p" exec="component_container" name="vision" namespace=""/>
          </group>
          <load_composable_node target="/robot/vision">
            <composable_node pkg="p" plugin="p::A" name="a"/>
          </load_composable_node>
        </launch>
    """)
