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
    assert told(at(tmp_path, 0)).startswith("frame `map`\n\nRoot of its tree\n\n- `map` → `odom` by /s")


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
