"""The files that launch files hand over, open in an editor: robot descriptions and behavior trees."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest
from lsprotocol import types
from support.editor_harness import Harness
from support.lsp_client import Editor, editing
from support.xacro_package import create_robot

pytestmark = pytest.mark.ros

ARM = """<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="$(find arm)/urdf/macros.xacro"/>
  <link name="base_link"/>
  <link name="tool"/>
  <joint name="tool_joint" type="fixed"><parent link="base_link"/><child link="tool"/></joint>
  <xacro:lidar side="left" parent="base_link"/>
</robot>
"""
MACROS = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="lidar" params="side parent">
    <link name="${side}_lidar"/>
    <joint name="lidar_joint" type="fixed"><parent link="${parent}"/><child link="left_lidar"/></joint>
  </xacro:macro>
</robot>
"""
MANIFEST = """<package format="3"><name>robot</name><version>1.0.0</version>
<export><build_type>ament_cmake</build_type></export></package>
"""
READING = """import os
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    path = os.path.join(os.path.dirname(__file__), "..", "urdf", "arm.urdf")
    description = {"robot_description": open(path).read()}
    return LaunchDescription([Node(package="p", executable="e", parameters=[description])])
"""
NAVIGATION = """<launch>
  <node pkg="nav2_bt_navigator" exec="bt_navigator" name="bt_navigator">
    <param name="default_nav_to_pose_bt_xml" value="$(dirname)/../trees/go.xml"/>
  </node>
</launch>
"""
TREE = """<root BTCPP_format="4" main_tree_to_execute="Main">
  <BehaviorTree ID="Main">
    <RecoveryNode number_of_retries="6"><Wait/><Spin/></RecoveryNode>
  </BehaviorTree>
</root>
"""


def write(files: Mapping[Path, str]) -> None:
    for path, text in files.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


@pytest.fixture
def robot(harness: Harness) -> Path:
    """The launch file of a robot whose description is made of two files."""
    launch = create_robot(harness.home / "robots")
    urdf = launch.parents[1] / "urdf"
    write({urdf / "arm.xacro": ARM, urdf / "macros.xacro": MACROS})
    return launch


@pytest.mark.parametrize("language", ["xml", "xacro", "plaintext"])
async def test_the_text_of_a_xacro_file_counts_as_it_is_typed(harness: Harness, robot: Path, language: str) -> None:
    arm = robot.parents[1] / "urdf/arm.xacro"
    async with editing(harness, trusted=True, folder=harness.home / "robots") as editor:
        editor.open(arm, language=language)
        text = ARM.replace('<parent link="base_link"', '<parent link="base_lnk"')
        editor.change(arm, text)
        found = await editor.having(arm, "URD002")
        assert editor.covered(arm, found.range) == "base_lnk"
        editor.change(arm, "<!-- a line more -->\n" + text)
        moved = await editor.having(arm, "URD002")
        assert moved.range.start.line == found.range.start.line + 1
        editor.change(arm, ARM)
        await editor.without(arm, "URD002")
        assert arm.read_text() == ARM


async def test_so_does_that_of_one_that_it_includes(harness: Harness, robot: Path) -> None:
    macros = robot.parents[1] / "urdf/macros.xacro"
    async with editing(harness, trusted=True, folder=harness.home / "robots") as editor:
        editor.open(macros, language="xml")
        editor.change(macros, MACROS.replace('"left_lidar"', '"left_lida"'))
        found = await editor.having(macros, "URD002")
        assert editor.covered(macros, found.range) == "left_lida"
        editor.close(macros)  # not saved
        await editor.without(macros, "URD002")


async def test_half_typed_the_last_text_counts_until_it_is_saved(harness: Harness, robot: Path) -> None:
    arm = robot.parents[1] / "urdf/arm.xacro"
    async with editing(harness, trusted=True, folder=harness.home / "robots") as editor:
        editor.open(robot)
        editor.open(arm, language="xml")
        editor.change(arm, ARM.replace('<parent link="base_link"', '<parent link="base_lnk"'))
        await editor.having(arm, "URD002")
        starts = harness.sandbox_starts()
        editor.change(arm, editor.texts[arm].replace("</robot>", "<link"))
        editor.change(robot, editor.texts[robot].replace('default="right"', 'default="left"'))
        await editor.until(lambda: harness.sandbox_starts() > starts)  # the new command
        await editor.until(lambda: editor.rules(robot) == [])
        await editor.having(arm, "URD002")
        editor.save(arm)
        await editor.having(robot, "PRM008")
        editor.change(arm, ARM)
        await editor.without(robot, "PRM008")


async def test_nothing_is_run_for_a_xacro_file_where_the_workspace_is_not_trusted(
    harness: Harness, robot: Path
) -> None:
    arm = robot.parents[1] / "urdf/arm.xacro"
    async with editing(harness, folder=harness.home / "robots") as editor:
        editor.open(robot)
        editor.open(arm, language="xml")
        editor.change(arm, ARM.replace('<parent link="base_link"', '<parent link="base_lnk"'))
        await editor.having(robot, "LCH018")
        assert harness.sandbox_starts() == 0


async def test_a_urdf_file_counts_as_it_is_typed(harness: Harness, robot: Path) -> None:
    urdf = robot.parents[1] / "urdf/arm.urdf"
    good = '<robot name="arm"><link name="base_link"/></robot>'
    reading = '<launch><param name="robot_description" textfile="$(find arm)/urdf/arm.urdf"/></launch>'
    write({urdf: good, robot: reading})
    async with editing(harness, folder=harness.home / "robots") as editor:
        editor.open(urdf, language="urdf")
        editor.change(urdf, good.replace("</robot>", '<link name="base_link"/></robot>'))
        await editor.having(urdf, "URD004")
        editor.change(urdf, good)
        await editor.without(urdf, "URD004")


async def test_a_urdf_file_that_a_python_launch_file_reads(harness: Harness) -> None:
    folder = harness.home / "robots"
    urdf, launch = folder / "urdf/arm.urdf", folder / "launch/arm.launch.py"
    good = '<robot name="arm"><link name="base_link"/></robot>'
    write({urdf: good, launch: READING, folder / "package.xml": MANIFEST})
    async with editing(harness, trusted=True, folder=folder) as editor:
        editor.open(launch, language="python")
        editor.open(urdf, language="xml")
        editor.change(urdf, good.replace("</robot>", '<link name="base_link"/></robot>'))
        await editor.having(urdf, "URD004")
        editor.change(urdf, good)
        await editor.without(urdf, "URD004")


@pytest.fixture
def navigation(harness: Harness) -> Path:
    """The behavior tree of a launch of Nav2."""
    folder = harness.home / "navigation"
    write(
        {
            folder / "launch/go.launch.xml": NAVIGATION,
            folder / "trees/go.xml": TREE,
            folder / "package.xml": MANIFEST,
        }
    )
    return folder / "trees/go.xml"


async def test_a_behavior_tree_counts_as_it_is_typed(harness: Harness, navigation: Path) -> None:
    async with editing(harness, folder=navigation.parents[1]) as editor:
        editor.open(navigation, language="xml")
        editor.change(navigation, TREE.replace("RecoveryNode", "RecoveryNod"))
        found = await editor.having(navigation, "BTR002")
        assert editor.covered(navigation, found.range) == "RecoveryNod"
        editor.change(navigation, TREE)
        await editor.without(navigation, "BTR002")


@pytest.mark.parametrize("text", ["<project><target name='a'/></project>", "<root><a/></root>", "<rob", ""])
async def test_other_xml_is_left_alone(harness: Harness, text: str) -> None:
    other = harness.write("other.xml", text)
    async with editing(harness) as editor:
        editor.open(harness.launch_file)
        await editor.having(harness.launch_file, "TOP001")
        indexing = editor.progress_of("Indexing launch files").values()
        await editor.until(lambda: any(values[-1]["kind"] == "end" for values in indexing))
        await editor.hover(harness.launch_file, types.Position(0, 1))  # all that came of it is shown
        editor.open(other, language="xml")
        analysed = editor.analysed
        for n in range(5):
            editor.change(other, text + f"<!-- {n} -->")
        assert await editor.hover(other, types.Position(0, 1)) is None
        assert editor.analysed == analysed
        assert not editor.diagnostics(other)


async def hovered(editor: Editor, path: Path, where: types.Position) -> str:
    found = await editor.hover(path, where)
    return str(getattr(found.contents, "value", "")) if found is not None else ""


async def test_a_link_of_a_xacro_file(harness: Harness, robot: Path) -> None:
    arm, macros = robot.parents[1] / "urdf/arm.xacro", robot.parents[1] / "urdf/macros.xacro"
    async with editing(harness, trusted=True, folder=harness.home / "robots") as editor:
        editor.open(robot)
        editor.open(arm, language="xml")
        link = editor.at(arm, '<parent link="base_link"', 15)
        text = await editor.once(lambda: hovered(editor, arm, link), lambda found: "Children" in found)
        assert text.startswith("link `base_link`\n\nRoot of its tree\n\nChildren: `tool`, `left_lidar`")
        (target,) = await editor.definition(arm, link)
        assert target.target_range.start == editor.at(arm, '<link name="base_link"', 12)
        assert len(await editor.references(arm, link)) == 2
        labels = [item.label for item in await editor.completion(arm, link)]
        assert labels == ["base_link", "tool", "left_lidar"]
        (macro,) = await editor.definition(arm, editor.at(arm, "<xacro:lidar", 8))
        assert macro.target_uri == macros.as_uri()
        assert [each.target for each in await editor.links(arm)] == [macros.as_uri()]


async def test_what_is_for_launch_files_alone_says_nothing(harness: Harness, robot: Path) -> None:
    arm = robot.parents[1] / "urdf/arm.xacro"
    async with editing(harness, trusted=True, folder=harness.home / "robots") as editor:
        editor.open(arm, language="xml")
        link = editor.at(arm, '<parent link="base_link"', 15)
        await editor.once(lambda: hovered(editor, arm, link), bool)
        assert await editor.prepare_rename(arm, link) is None
        assert await editor.symbols(arm) == await editor.folds(arm) == []
        assert [lens.command.title for lens in await editor.lenses(arm) if lens.command] == [
            "launched by arm/launch/arm.launch"
        ]
        assert await editor.hierarchy(arm, link) == []
        assert await editor.signature(arm, link) is None
        assert await editor.completion(arm, editor.at(arm, "<xacro:include", 1)) == []


async def test_a_node_of_a_behavior_tree(harness: Harness, navigation: Path) -> None:
    async with editing(harness, folder=navigation.parents[1]) as editor:
        editor.open(navigation, language="xml")
        spin = editor.at(navigation, "<Spin", 2)
        text = await editor.once(lambda: hovered(editor, navigation, spin), bool)
        assert text.startswith("behavior tree node `Spin` of Nav2")
        assert "`spin_dist`" in text
        labels = [item.label for item in await editor.completion(navigation, spin)]
        assert {"Spin", "RecoveryNode", "Sequence"} <= set(labels)
