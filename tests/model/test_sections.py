"""To which nodes a section of a parameter file applies, and why to none: asked of the rule, hover and `where`."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.model.sections import param_file, param_files
from preflight_analysis.queries.hover import hover
from preflight_analysis.queries.node_names import mentions_of
from preflight_analysis.queries.parameters import parameters
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.rules.registry import found_in_loose_files
from preflight_analysis.workspace.index import WorkspaceIndex
from preflight_analysis.workspace.workspace import Analysis
from support.python_launch_harness import PythonHarness
from support.query_harness import at_cursor

CONTROLLER = """//- /main.launch.xml
<launch>
  <node pkg="nav2_controller" exec="controller_server" name="controller_server"><param from="/p.yaml"/></node>
</launch>
//- /p.yaml
controller_sever$0:
  ros__parameters: {controller_frequency: 20.0}
local_costmap:
  local_costmap:
    ros__parameters: {global_frame: odom}
"""


def test_three_who_ask_get_one_answer() -> None:
    there = at_cursor(CONTROLLER)
    analysis = there.analysis
    said = hover([analysis], "/p.yaml", there.offset)
    (found,) = parameters(analysis, "controller_frequency")
    (unapplied,) = found.unapplied
    (claimed,) = [f for f in analysis.findings if f.rule == "PRM011"]
    assert said is not None
    assert said.markdown == (
        "`/controller_sever` fits no node that gets this file\n\nDid you mean '/controller_server'?"
    )
    assert claimed.message == (
        "section '/controller_sever' applies to no node that gets this file; did you mean '/controller_server'?"
    )
    assert (found.name, found.settings) == ("/controller_server:controller_frequency", ())
    assert unapplied.use.section.pattern == "/controller_sever"
    assert unapplied.use.reason == "no node that gets the file is called so; did you mean '/controller_server'?"
    assert unapplied.place.span.start < there.document.text.index("20.0")


def answers(analysis: Analysis, path: str = "/p.yaml") -> Mapping[str, object]:
    """By what each section is for: the nodes to which it applies, or why to none, whose it may be, and the doubts."""
    used = param_file(analysis.context, path)
    assert used is not None
    return {
        each.section.pattern: [node.name for node in each.nodes]
        or (each.why_not, [node.name for node in each.candidates], [doubt.reason.name for doubt in each.doubts])
        for each in used.sections
    }


def test_why_a_section_applies_to_no_node() -> None:
    there = at_cursor("""//- /main.launch.xml
<launch>
  <node pkg="p" exec="camera" name="camera" namespace="front"><param from="/p.yaml"/></node>
  <node pkg="p" exec="pilot" name="pilot"><param from="/p.yaml"/></node>
  <node pkg="p" exec="arm" name="arm"/>
</launch>
//- /p.yaml
camera: {ros__parameters: {a: 1}}
pilto: {ros__parameters: {a: 1}}
arm: {ros__parameters: {a: 1}}
gripper: {ros__parameters: {a: 1}}
/**: {ros__parameters: {a: 1}}
//- /other.yaml
camera: {ros__parameters: {a: 1}}
""")
    assert answers(there.analysis) == {
        "/camera": ("namespace", ["/front/camera"], []),
        "/pilto": ("misspelt", ["/pilot"], []),
        "/arm": ("elsewhere", ["/arm"], []),
        "/gripper": ("nowhere", [], []),
        "/**": ["/front/camera", "/pilot"],
    }
    assert answers(there.analysis, "/other.yaml") == {"/camera": ("not-given", [], [])}
    assert [used.path for used in param_files(there.analysis.context)] == ["/p.yaml"]


@pytest.mark.parametrize("section", ["local_costmap", "local_costmap/local_costmp"])
def test_the_other_nodes_of_a_process_are_meant_too(section: str) -> None:
    text = CONTROLLER.replace("controller_sever$0", "controller_server")
    text = text.replace("local_costmap:\n  local_costmap:\n    ros__", f"{section}:\n  ros__")
    analysis = at_cursor(text).analysis
    assert answers(analysis) == {
        "/controller_server": ["/controller_server"],
        f"/{section}": (
            "namespace" if section == "local_costmap" else "misspelt",
            ["/local_costmap/local_costmap"],
            [],
        ),
    }
    assert [f.message.partition("; ")[2] for f in analysis.findings if f.rule == "PRM011"] == [
        "did you mean '/local_costmap/local_costmap'?"
    ]


def test_what_a_component_and_its_container_get() -> None:
    there = at_cursor("""//- /main.launch.xml
<launch>
  <node_container pkg="rclcpp_components" exec="component_container" name="box" namespace="">
    <composable_node pkg="p" plugin="p::Pump" name="pump"><param from="/p.yaml"/></composable_node>
  </node_container>
</launch>
//- /p.yaml
/*: {ros__parameters: {a: 1}}
/**: {ros__parameters: {a: 1}}
pump: {ros__parameters: {a: 1}}
""")
    # launch_ros, which reads it for a component, knows no other wildcard than `/**`.
    assert answers(there.analysis) == {
        "/*": ("wildcard", ["/pump"], []),
        "/**": ["/pump"],
        "/pump": ["/pump"],
    }


def test_what_leaves_the_answer_open() -> None:
    there = at_cursor("""//- /main.launch.xml
<launch>
  <node pkg="p" exec="pump" name="pump"><param from="/p.yaml"/></node>
  <node pkg="p" exec="free"><param from="/q.yaml"/></node>
  <include file="$(find-pkg-share not_here)/more.launch.xml"><arg name="params" value="/p.yaml"/></include>
</launch>
//- /p.yaml
pumo: {ros__parameters: {a: 1}}
//- /q.yaml
own_name: {ros__parameters: {a: 1}}
""")
    assert answers(there.analysis) == {"/pumo": ("misspelt", ["/pump"], ["PARTLY_READ"])}
    assert answers(there.analysis, "/q.yaml") == {"/own_name": ("nowhere", [], ["NOT_ANALYSED"])}
    assert {(f.severity, f.confidence) for f in there.analysis.findings if f.rule == "PRM011"} == {("info", "possible")}


def test_a_file_that_an_include_from_the_catalogue_gives_to_its_nodes() -> None:
    there = at_cursor("""//- /main.launch.xml
<launch>
  <include file="$(find-pkg-share nav2_bringup)/launch/navigation_launch.py">
    <arg name="params_file" value="/p.yaml"/>
  </include>
</launch>
//- /p.yaml
bt_navigator: {ros__parameters: {bt_loop_duration: 10}}
local_costmap: {local_costmap: {ros__parameters: {global_frame: odom}}}
planner_sever: {ros__parameters: {expected_planner_frequency: 20.0}}
map_server: {ros__parameters: {yaml_filename: a}}
""")
    assert answers(there.analysis) == {
        "/bt_navigator": ["/bt_navigator"],
        "/local_costmap/local_costmap": ["/local_costmap/local_costmap"],
        "/planner_sever": ("misspelt", ["/planner_server"], ["NOT_ANALYSED", "CATALOGUE"]),
        "/map_server": ("nowhere", [], ["NOT_ANALYSED"]),
    }
    assert [(f.message, f.severity, f.confidence) for f in there.analysis.findings if f.rule == "PRM011"] == [
        (
            "section '/planner_sever' applies to no node that gets this file; did you mean '/planner_server'?",
            "warning",
            "possible",
        )
    ]


@pytest.mark.ros
def test_a_file_that_a_launch_file_rewrites(tmp_path: Path) -> None:
    harness = PythonHarness(tmp_path)
    path = harness.write(
        "params.yaml",
        "server: {ros__parameters: {rate: 20.0}}\nplanr: {ros__parameters: {a: 1}}\n",
    )
    launch = harness.write(
        "launch/a.launch.py",
        """
import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node
from nav2_common.launch import RewrittenYaml

def generate_launch_description():
    file = os.path.join(get_package_share_directory("p"), "params.yaml")
    made = RewrittenYaml(source_file=file, root_key="r1", param_rewrites={})
    return LaunchDescription([
        Node(package="p", executable=name, name=name, namespace="r1", parameters=[made]) for name in ("server", "plan")
    ])
""",
    )
    assert answers(harness.launch(launch), str(path)) == {
        "/server": ["/r1/server"],
        "/planr": ("misspelt", ["/r1/plan"], []),
    }


def test_a_namespace_that_is_a_slip_of_one_in_several_files_is_one_for_all_who_ask(tmp_path: Path) -> None:
    package = tmp_path / "p"
    package.mkdir()
    for at in range(2):
        (package / f"{at}.yaml").write_text("second_robot:\n  nav:\n    ros__parameters: {a: 1}\n")
    (package / "main.launch.xml").touch()
    (package / "ihm.yaml").write_text("seond_robot:\n")
    there = at_cursor(f"""//- {package}/main.launch.xml
<launch>
  <node pkg="p" exec="ihm" name="ihm" namespace="main_robot"><param from="{package}/ihm.yaml"/></node>
</launch>
//- {package}/package.xml
<package><name>p</name></package>
//- {package}/ihm.yaml
main_robot:
  ihm:
    ros__parameters: {{a: 1}}
seond_robot:
  ih$0m:
    ros__parameters: {{b: 1}}
""")
    asked = "id you mean '/second_robot/ihm'? 2 parameter files nearby have that namespace"
    (claimed,) = [f for f in there.analysis.findings if f.rule == "PRM011"]
    said = hover([there.analysis], f"{package}/ihm.yaml", there.offset)
    (found,) = parameters(there.analysis, "b")
    assert claimed.message == f"section '/seond_robot/ihm' applies to no node; d{asked}"
    assert said is not None
    assert f"D{asked}" in said.markdown
    assert found.unapplied[0].use.reason == f"no node that gets the file is called so; d{asked}"


MANAGED_AND_REWRITTEN = """
import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node
from nav2_common.launch import RewrittenYaml

def generate_launch_description():
    file = os.path.join(get_package_share_directory("p"), "params.yaml")
    made = RewrittenYaml(source_file=file, param_rewrites={})
    return LaunchDescription([
        Node(package="p", executable="robot", parameters=[made]),
        Node(package="p", executable="pilot", name="pilot", parameters=[made]),
        Node(package="controller_manager", executable="spawner", arguments=["whels"]),
    ])
"""


@pytest.mark.ros
def test_who_asks_of_a_rewritten_file_asks_of_the_one_that_people_edit(tmp_path: Path) -> None:
    harness = PythonHarness(tmp_path)
    path = harness.write(
        "params.yaml",
        """
        controller_manager:
          ros__parameters:
            wheels: {type: diff_drive_controller/DiffDriveController}
        pilot: {ros__parameters: {rate: 20.0}}
        """,
    )
    analysis = harness.launch(harness.write("launch/a.launch.py", MANAGED_AND_REWRITTEN))
    # Some node of the robot's own program is the manager, whose file was written by the launch file.
    (found,) = [f for f in analysis.findings if f.rule == "PRM019"]
    assert "did you mean 'wheels'?" in found.message
    assert harness.workspace is not None
    context = QueryContext(str(path), (analysis,), WorkspaceIndex(), harness.workspace)
    pilot = next(node for node in analysis.tree.nodes if node.name == "/pilot")
    (mention,) = mentions_of(context, (analysis.tree,), frozenset({pilot.name}))
    assert (mention.value.file, context.text(mention.value)) == (str(path), "pilot")


@pytest.mark.ros
def test_a_rewritten_file_is_given_to_its_nodes_for_all_rules(tmp_path: Path) -> None:
    """The rules about files that no node gets leave it alone, those about files that nodes get look into it."""
    harness = PythonHarness(tmp_path)
    harness.write(
        "params.yaml",
        """
        pilot:
          ros__parameters:
            plugins: ["voxel_layer", "inflation_layer"]
            obstacle_layer:
              plugin: "nav2_costmap_2d::ObstacleLayer"
            inflation_layer:
              plugin: "nav2_costmap_2d::InflationLayer"
        """,
    )
    analysis = harness.launch(harness.write("launch/a.launch.py", MANAGED_AND_REWRITTEN))
    (found,) = [f for f in analysis.findings if f.rule == "PRM018"]
    assert Reason.NOT_GIVEN not in [doubt.reason for doubt in found.doubts]
    assert [each.rule for each in found_in_loose_files(analysis.context)] == []


def test_a_file_that_an_include_from_the_catalogue_is_handed_is_given() -> None:
    there = at_cursor("""//- /main.launch.xml
<launch>
  <include file="$(find-pkg-share nav2_bringup)/launch/navigation_launch.py">
    <arg name="params_file" value="/p.yaml"/>
  </include>
</launch>
//- /p.yaml
bt_navigator:
  ros__parameters:
    plugins: ["voxel_layer", "inflation_layer"]
    obstacle_layer: {plugin: "nav2_costmap_2d::ObstacleLayer"}
    inflation_layer: {plugin: "nav2_costmap_2d::InflationLayer"}
""")
    (found,) = [f for f in there.analysis.findings if f.rule == "PRM018"]
    assert [doubt.reason for doubt in found.doubts if doubt.reason is Reason.CATALOGUE] == [Reason.CATALOGUE]
