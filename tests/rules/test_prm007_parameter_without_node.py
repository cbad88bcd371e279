"""PRM007: a parameter under a name that no node of the launch has."""

import pytest
from support.check import apply, check


def test_a_common_leaf_name_alone_is_no_evidence() -> None:
    check("""
        <launch>
          <param name="/camera_driver/frame_id" value="front"/>
                       ^^^^^^^^^^^^^^^^^^^^^^^ hint[PRM007] '/camera_driver' is neither a node nor a namespace of this
          <node pkg="p" type="t" name="laser"/>
        </launch>
        //- interfaces
        {"/laser": {"params": {"~frame_id": "laser"}}}
    """)


def test_a_parameter_for_a_node_that_is_called_otherwise() -> None:
    text = """
        <launch>
          <param name="/talkr/rate" value="10"/>
                       ^^^^^^^^^^^ warning[PRM007] '/talkr' is not a node of this launch (parameter '/talkr/rate');
          <node pkg="p" type="t" name="talker"/>
          <group ns="robot"><node pkg="p" type="t" name="n"/></group>
          <param name="robto/n/rate" value="1"/>
                       ^^^^^^^^^^^^ warning[PRM007] did you mean '/robot'?
          <param name="base/rate" value="1"/>
                       ^^^^^^^^^ hint[PRM007] '/base' is neither a node nor a namespace of this launch (parameter
        </launch>
    """
    first, *_ = check(text)
    assert 'name="/talker/rate"' in apply(text, first.fixes[0].edits)["/main.launch"]


@pytest.mark.silent
def test_the_section_of_a_node_that_a_condition_leaves_out() -> None:
    check("""
        <launch>
          <arg name="mesh" default="false"/>
          <rosparam>{obj_to_cloud: {frame_id: map}}</rosparam>
          <node pkg="p" type="t" name="obj_to_cloud" if="$(arg mesh)"/>
          <node pkg="p" type="t" name="pcd_to_cloud"/>
        </launch>
    """)


@pytest.mark.silent
def test_the_section_of_a_controller_that_a_spawner_is_given() -> None:
    check("""
        <launch>
          <rosparam>{pan_controller: {joint_name: pan}}</rosparam>
          <node pkg="p" type="spawner" name="s" args="--port a pan_controller"/>
          <node pkg="p" type="t" name="face_controller"/>
        </launch>
    """)


@pytest.mark.silent
def test_parameters_that_need_no_node() -> None:
    check("""
        <launch>
          <param name="/use_sim_time" value="true"/>
          <param name="/robot_description_kinematics/arm" value="x"/>
          <param name="robot/rate" value="1"/>
          <rosparam>{controller: {p: 1}, nodes: {x: 1}, node2: {x: 1}}</rosparam>
          <param name="arm_controller/type" value="position"/>
          <param name="arm_controller/joint" value="elbow"/>
          <param name="leg_controller/joint" value="knee"/>
          <node pkg="p" type="t" name="spawner" args="leg_controller"/>
          <node pkg="p" type="t" name="node"/>
          <node pkg="p" type="t" name="node1" ns="robot"><param name="below/rate" value="1"/></node>
        </launch>
    """)


@pytest.mark.silent
def test_parameters_of_a_launch_file_without_nodes() -> None:
    check('<launch><param name="talkr/rate" value="10"/></launch>')


def test_a_dictionary_for_a_node_that_is_called_otherwise() -> None:
    text = """
        <launch>
          <rosparam file="/a.yaml"/>
          <node pkg="p" type="t" name="talker"/>
        </launch>
        //- /a.yaml
        talkr:
        ^^^^^ warning[PRM007] '/talkr' is not a node of this launch (parameter '/talkr/rate' and 1 more); did you mean
          rate: 3
          sub: {limit: 4}
    """
    (finding,) = check(text)
    assert apply(text, finding.fixes[0].edits)["/a.yaml"].startswith("talker:\n  rate: 3")


@pytest.mark.silent
def test_the_section_of_a_node_that_is_started_elsewhere() -> None:
    check("""
        <launch>
          <rosparam>
            amcl: {odom_frame: odom_combined, base_frame: base_footprint, beams: 30, particles: 100, alpha: 0.1}
            planner: {odom_frame: odom, base_frame: base_link}
          </rosparam>
          <node pkg="p" type="t" name="base"/>
        </launch>
        //- interfaces
        {"/base": {"params": {"~odom_frame": "odom", "~base_frame": "base_link", "~rate": 10}}}
    """)
