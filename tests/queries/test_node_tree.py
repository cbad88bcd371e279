"""The tree of what a launch starts."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.findings.contexts import RootFindings, by_file
from preflight_analysis.queries.node_tree import Item, node_tree
from preflight_analysis.workspace.workspace import Analysis
from support.python_launch_harness import PythonHarness
from support.workspace_harness import TestWorkspace, create_workspace

ROBOT = """
    $0<launch>
      <arg name="sim" default="false"/>
      <param name="robot_name" value="r2"/>
      <node pkg="p" type="t" name="base"><param name="rate" value="5"/><remap from="scan" to="/laser/scan"/></node>
      <group ns="arm/left">
        <include file="{folder}/camera.launch"><arg name="rate" value="9"/></include>
      </group>
      <group if="$(arg sim)"><node pkg="p" type="t" name="gazebo"/></group>
      <include file="{folder}/camera.launch" unless="true"/>
    </launch>
    //- camera.launch
    <launch>
      <arg name="rate" default="1"/>
      <node pkg="p" type="missing" name="camera"/>
    </launch>
    //- p/scripts/t
    #!/bin/sh
    """


def outline(items: tuple[Item, ...], depth: int = 0) -> list[str]:
    lines = []
    for item in items:
        lines.append(f"{'  ' * depth}{item.kind} {item.label} {item.detail}".rstrip())
        lines += outline(item.children, depth + 1)
    return lines


def treed(workspace: TestWorkspace, analysis: Analysis) -> tuple[Item, ...]:
    files = frozenset(analysis.tree.files)
    findings = by_file([RootFindings(analysis.root, files, analysis.findings)], frozenset())
    return node_tree(analysis, findings).items


def named(items: tuple[Item, ...], name: str) -> Item:
    found = [i for i in items if i.name == name] or [named(i.children, name) for i in items if i.kind == "namespace"]
    return found[0]


def test_namespaces_nodes_includes_and_what_is_left_out(tmp_path: Path) -> None:
    workspace = create_workspace(tmp_path, ROBOT)
    analysis = workspace.context.analyses[0]
    items = treed(workspace, analysis)
    assert outline(items) == [
        "node base p/t",
        "  param rate 5",
        "  remap scan → /laser/scan",
        "namespace arm/left/",
        "  node camera p/missing",
        "section Includes 1",
        "  include camera.launch 1 node  rate:=9",
        "section Shared parameters 1",
        "  param /robot_name r2",
        "section Not started 2",
        "  not-taken group if $(arg sim) is false",
        "    not-taken gazebo",
        "  not-taken include {folder}/camera.launch unless true".replace("{folder}", str(tmp_path)),
    ]
    assert node_tree(analysis, {}).files == (str(tmp_path / "main.launch"), str(tmp_path / "camera.launch"))


def test_a_node_has_its_place_its_file_and_what_is_wrong_with_it(tmp_path: Path) -> None:
    workspace = create_workspace(tmp_path, ROBOT)
    items = treed(workspace, workspace.context.analyses[0])
    base, camera = named(items, "/base"), named(items, "/arm/left/camera")
    assert base.location is not None
    assert workspace.shown(base.location).startswith('main.launch:4 <node pkg="p" type="t" name="base"')
    assert camera.location is not None
    assert workspace.shown(camera.location).startswith("camera.launch:3 <node")
    assert camera.file == str(tmp_path / "camera.launch")
    assert (base.worst, base.findings) == (None, 0)
    assert (camera.worst, camera.findings) == ("error", 1)


def test_a_file_included_twice_has_its_own_conditions_each_time(tmp_path: Path) -> None:
    workspace = create_workspace(
        tmp_path,
        """
        $0<launch>
          <include file="{folder}/one.launch" ns="a"><arg name="on" value="true"/></include>
          <include file="{folder}/one.launch" ns="b"><arg name="on" value="0"/></include>
        </launch>
        //- one.launch
        <launch><arg name="on"/><node pkg="p" type="t" name="n" if="$(arg on)"/></launch>
        //- p/scripts/t
        #!/bin/sh
        """,
    )
    assert outline(treed(workspace, workspace.context.analyses[0])) == [
        "namespace a/",
        "  node n p/t",
        "section Includes 2",
        "  include one.launch 1 node  on:=true",
        "  include one.launch 0 nodes  on:=0",
        "section Not started 1",
        "  not-taken n if $(arg on) is 0",
    ]


def test_an_include_says_how_many_parameters_it_adds_beside_nodes(tmp_path: Path) -> None:
    workspace = create_workspace(
        tmp_path,
        """
        $0<launch>
          <param name="own" value="1"/>
          <include file="{folder}/params.launch"/>
          <include file="{folder}/missing_$(env NO_SUCH_ONE).launch"/>
        </launch>
        //- params.launch
        <launch>
          <param name="a" value="1"/><param name="b" value="1"/>
          <node pkg="p" type="t" name="n"><param name="c" value="1"/></node>
        </launch>
        //- p/scripts/t
        #!/bin/sh
        """,
    )
    lines = outline(treed(workspace, workspace.context.analyses[0]))
    assert "  include params.launch 1 node, 2 shared parameters" in lines


def test_what_a_node_was_seen_to_do_is_said_where_it_is_not_all(tmp_path: Path) -> None:
    workspace = create_workspace(
        tmp_path, ROBOT + '//- interfaces\n    {"/base": {"publishers": {"odom": "nav_msgs/Odometry"}}}'
    )
    items = treed(workspace, workspace.context.analyses[0])
    assert named(items, "/base").note == ""
    unknown = create_workspace(
        tmp_path / "other", '$0<launch><node pkg="p" type="t" name="n" args="$(env NO_SUCH_ONE)"/></launch>'
    )
    assert node_tree(unknown.context.analyses[0], {}).items[0].note != ""


@pytest.mark.ros
def test_a_line_of_python_that_includes_twice_has_the_nodes_of_each(tmp_path: Path) -> None:
    harness = PythonHarness(tmp_path)
    deep = harness.write("launch/deep.launch.xml", '<launch><node pkg="p" exec="t" name="deep"/></launch>')
    inner = """
        <launch>
          <arg name="ns"/>
          <node pkg="p" exec="t" name="n" namespace="$(var ns)"/>
          <include file="$(dirname)/deep.launch.xml" if="$(eval '\\'$(var ns)\\' == \\'b\\'')"/>
        </launch>
        """
    harness.write("launch/inner.launch.xml", inner.strip("\n"))
    main = harness.write(
        "launch/main.launch.py",
        f"""
        from launch import LaunchDescription
        from launch.actions import IncludeLaunchDescription
        from launch_xml.launch_description_sources import XMLLaunchDescriptionSource

        def generate_launch_description():
            path = "{deep.with_name("inner.launch.xml")}"
            return LaunchDescription([
                IncludeLaunchDescription(XMLLaunchDescriptionSource(path), launch_arguments=[("ns", ns)])
                for ns in ("a", "b", "c")
            ])
        """,
    )
    analysis = harness.launch(main)
    assert [node.name for node in analysis.tree.nodes] == ["/a/n", "/b/n", "/deep", "/c/n"]
    (includes,) = (item for item in node_tree(analysis, {}).items if item.label == "Includes")
    assert [line.replace(str(tmp_path), "") for line in outline(includes.children)] == [
        "include /src/p/launch/inner.launch.xml 1 node  ns:=a",
        "include /src/p/launch/inner.launch.xml 2 nodes  ns:=b",
        "  include /src/p/launch/deep.launch.xml 1 node",
        "include /src/p/launch/inner.launch.xml 1 node  ns:=c",
    ]


def test_frames(tmp_path: Path) -> None:
    node = '<node pkg="tf2_ros" type="static_transform_publisher" name="{}" args="0 0 0 0 0 0 {} {}"/>'
    nodes = node.format("s", "map", "odom") + node.format("t", "odom", "base")
    workspace = create_workspace(tmp_path, f"$0<launch>{nodes}</launch>")
    section = treed(workspace, workspace.context.analyses[0])[-1]
    assert (section.kind, section.label, section.detail) == ("section", "Frames", "3")
    (root,) = section.children
    assert (root.kind, root.label, [each.label for each in root.children]) == ("frame", "map", ["odom"])
    assert root.children[0].detail == "/s"
