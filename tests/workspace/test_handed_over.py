"""Which launches hand a file over."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.workspace.handed_over import roots_naming
from support.workspace_harness import create_workspace

WORKSPACE = """
    <launch>$0<param name="robot_description" command="xacro {folder}/p/urdf/arm.xacro"/></launch>
    //- other.launch
    <launch><param name="robot_description" command="xacro $(find p)/urdf/$(arg robot).xacro"/></launch>
    //- unrelated.launch
    <launch><param name="arm" value="p"/></launch>
    //- tree.launch
    <launch><param name="tree" value="go.xml"/></launch>
    //- p/urdf/arm.xacro
    <robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:include filename="finger.xacro"/></robot>
    //- p/urdf/finger.xacro
    <robot/>
    //- p/urdf/my_finger.xacro
    <robot/>
    //- p/trees/go.xml
    <root/>
    //- p/trees/stay.xml
    <root/>
    //- p/package.xml
    <package><name>p</name></package>
    """


@pytest.mark.parametrize(
    ("name", "roots"),
    [
        ("p/urdf/arm.xacro", ["main.launch"]),
        ("p/urdf/finger.xacro", ["main.launch"]),
        ("p/urdf/my_finger.xacro", ["main.launch", "other.launch"]),  # its name may be put together
        ("p/trees/go.xml", ["tree.launch"]),
        ("p/trees/stay.xml", []),
        ("elsewhere.xacro", []),
    ],
)
def test_the_roots_of_a_file(tmp_path: Path, name: str, roots: list[str]) -> None:
    context = create_workspace(tmp_path, WORKSPACE).context
    sources, environment = context.workspace.sources, context.workspace.environment
    found = roots_naming(context.index, sources, environment, str(tmp_path / name))
    assert [Path(root.path).name for root in found] == roots
