"""The coordinate frame under the cursor."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.queries.definition import definition
from preflight_analysis.queries.hover import hover
from preflight_analysis.queries.references import references
from support.workspace_harness import TestWorkspace, create_workspace

ROBOT = """
    <launch>
      <node pkg="tf2_ros" type="static_transform_publisher" name="s" args="0 0 1 0 0 0 %smap %sodom"/>
      <node pkg="tf2_ros" type="static_transform_publisher" name="t" args="0 0 1 0 0 0 odom %sbase"/>
      <node pkg="robot_localization" type="ekf_localization_node" name="ekf">
        <param name="publish_tf" value="false"/>
        <param name="base_link_frame" value="%sbase"/>
      </node>
      <node pkg="p" type="t" name="driver"><param name="lidar_frame" value="%slaser"/></node>
    </launch>
    //- p/scripts/t
    #!/bin/sh
    """


def at(tmp_path: Path, number: int) -> TestWorkspace:
    return create_workspace(tmp_path, ROBOT % tuple("$0" if each == number else "" for each in range(5)))


def told(workspace: TestWorkspace) -> str:
    found = hover(workspace.context.analyses, workspace.context.path, workspace.offset, 0, workspace.context)
    assert found is not None
    return found.markdown


def test_hover_of_a_frame(tmp_path: Path) -> None:
    text = told(at(tmp_path, 3))
    assert text.startswith("frame `base`\n\nPath to the root: `base` → `odom` → `map`\n\n- `odom` → `base` by /t")
    assert text.rpartition("\n\n")[2].startswith("Used by\n- `/ekf`, parameter ")


def test_hover_of_a_root(tmp_path: Path) -> None:
    assert told(at(tmp_path, 0)).startswith("frame `map`\n\nRoot of its tree\n\nChildren: `odom`\n\n- `map` → `odom`")


def test_hover_of_one_that_nothing_publishes(tmp_path: Path) -> None:
    text = told(at(tmp_path, 4))
    assert text.startswith("frame `laser`\n\nNo node of this launch is known to publish it.")
    assert "may be incomplete" in text


@pytest.mark.parametrize(("number", "place"), [(3, "main.launch:3 <node"), (1, "main.launch:2 <node")])
def test_definition_and_references(tmp_path: Path, number: int, place: str) -> None:
    workspace = at(tmp_path, number)
    (target,) = definition(workspace.context, workspace.offset, ())
    assert workspace.shown(target.location).startswith(place)
    found = [workspace.shown(each.location) for each in references(workspace.context, workspace.offset)]
    assert any(each.startswith(place) for each in found)
    assert ("main.launch:6 base" in found) == (number == 3)


def test_a_configuration_of_rviz(tmp_path: Path) -> None:
    text = """
        <launch>
          <node pkg="tf2_ros" type="static_transform_publisher" name="s" args="0 0 1 0 0 0 $0map odom"/>
          <node pkg="rviz" type="rviz" name="rviz" args="-d {folder}/a.rviz"/>
        </launch>
        //- a.rviz
        Visualization Manager:
          Global Options: {Fixed Frame: map}
          Tools: [{Reference Frame: odom}]
        """
    workspace = create_workspace(tmp_path, text)
    found = [workspace.shown(each.location) for each in references(workspace.context, workspace.offset)]
    assert "a.rviz:2 map" in found
    assert not [each for each in found if each.endswith("odom")]


def test_a_parameter_file(tmp_path: Path) -> None:
    text = """
        <launch>
          <node pkg="robot_localization" exec="ekf_node" name="ekf"><param from="{folder}/ekf.yaml"/></node>
        </launch>
        //- ekf.yaml
        ekf:
          ros__parameters:
            base_link_frame: $0base
        """
    workspace = create_workspace(tmp_path, text)
    path = str(tmp_path / "ekf.yaml")
    found = hover(workspace.context.analyses, path, workspace.offset, 0, workspace.context)
    assert found is not None
    assert found.markdown.startswith("frame `base`\n\nPath to the root: `base` → `odom`")


def test_a_link_of_the_robot(tmp_path: Path) -> None:
    text = """
        <launch>
          <param name="robot_description" textfile="{folder}/p/urdf/robot.urdf"/>
          <node pkg="robot_state_publisher" type="robot_state_publisher" name="rsp"/>
          <node pkg="p" type="t" name="driver"><param name="lidar_frame" value="$0laser"/></node>
        </launch>
        //- p/package.xml
        <package><name>p</name></package>
        //- p/urdf/robot.urdf
        <robot name="r">
        <link name="base"/>
        <link name="laser"/>
        <joint name="j" type="fixed"><parent link="base"/><child link="laser"/></joint>
        </robot>
        """
    workspace = create_workspace(tmp_path, text)
    found = [workspace.shown(each.location) for each in definition(workspace.context, workspace.offset, ())]
    assert found == ["p/urdf/robot.urdf:3 laser", "p/urdf/robot.urdf:4 j"]
    assert "Path to the root: `laser` → `base`" in told(workspace)


def test_a_line_of_the_source(tmp_path: Path) -> None:
    text = """
        <launch>
          <node pkg="p" type="t.py" name="n"/>
          <node pkg="p" type="u" name="driver"><param name="lidar_frame" value="$0laser"/></node>
        </launch>
        //- p/package.xml
        <package><name>p</name></package>
        //- p/scripts/t.py
        #!/usr/bin/env python3
        import rospy, tf
        rospy.init_node('t')
        tf.TransformBroadcaster().sendTransform((0, 0, 0), (0, 0, 0, 1), rospy.Time.now(), 'laser', 'base')
        //- interfaces
        {"/n": {"frames": [["base", "laser", false, true, false, "{folder}/p/scripts/t.py", 4]]}}
        """
    workspace = create_workspace(tmp_path, text)
    (target,) = definition(workspace.context, workspace.offset, ())
    assert workspace.shown(target.location).startswith("p/scripts/t.py:4 tf.")
