"""Definition and references in launch files of ROS 2, in XML and Python."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.queries.definition import definition
from preflight_analysis.queries.hover import hover
from preflight_analysis.queries.references import references
from support.workspace_harness import create_workspace

PACKAGE = """
//- p/package.xml
<package format="3"><name>p</name><export><build_type>ament_python</build_type></export></package>
//- p/setup.py
from setuptools import setup
setup(name="p", packages=["p"], entry_points={"console_scripts": ["talker = p.talker:start"]})
//- p/p/__init__.py
//- p/p/talker.py
import rclpy


class Talker:
    def start(self):
        pass


def start():
    rclpy.spin(Talker())
"""
CPP = """
//- p/package.xml
<package format="3"><name>p</name><export><build_type>ament_cmake</build_type></export></package>
//- p/CMakeLists.txt
project(p)
add_library(filters SHARED src/filter.cpp)
rclcpp_components_register_nodes(filters "p::Filter")
//- p/src/filter.hpp
namespace p {
class Filter;
class Filter : public rclcpp::Node {
public:
  explicit Filter(const rclcpp::NodeOptions & options);
};
}
//- p/src/filter.cpp
#include "filter.hpp"
namespace p {
Filter::Filter(const rclcpp::NodeOptions & options) : Node("filter", options) {}
}
"""


def gone_to(tmp_path: Path, text: str, build_type: str = "ament_python", *, runs: bool = False) -> list[str]:
    workspace = create_workspace(tmp_path, text, build_type=build_type, runs=runs)
    return [workspace.shown(target.location) for target in definition(workspace.context, workspace.offset, ())]


def hovered(tmp_path: Path, text: str, build_type: str = "ament_python", *, runs: bool = False) -> list[str]:
    """The lines of the hover, without the empty ones."""
    workspace = create_workspace(tmp_path, text, build_type=build_type, runs=runs)
    context = workspace.context
    found = hover(context.analyses, context.path, workspace.offset, context=context)
    return [line for line in found.markdown.split("\n") if line] if found else []


def named_at(tmp_path: Path, text: str, *, runs: bool = False) -> list[str]:
    workspace = create_workspace(tmp_path, text, build_type="ament_python", runs=runs)
    return [workspace.shown(reference.location) for reference in references(workspace.context, workspace.offset)]


def test_an_entry_point_leads_to_its_function(tmp_path: Path) -> None:
    text = '//- main.launch.xml\n<launch>\n  <node pkg="p" exec="tal$0ker" name="a"/>\n</launch>\n' + PACKAGE
    assert gone_to(tmp_path, text) == ["p/p/talker.py:9 def start():"]


@pytest.mark.ros
def test_an_entry_point_leads_to_its_function_from_python(tmp_path: Path) -> None:
    text = PYTHON.replace('"talker"', '"tal$0ker"', 1) + PACKAGE
    assert gone_to(tmp_path, text, runs=True) == ["p/p/talker.py:9 def start():"]


def test_a_component_leads_to_its_class(tmp_path: Path) -> None:
    text = """
//- main.launch.xml
<launch>
  <node_container pkg="rclcpp_components" exec="component_container" name="c" namespace="">
    <composable_node pkg="p" plugin="p::Fil$0ter" name="filter"/>
  </node_container>
  <load_composable_node target="/c">
    <composable_node pkg="p" plugin="p::Filter" name="other"/>
  </load_composable_node>
</launch>
"""
    assert gone_to(tmp_path / "a", text + CPP, "ament_cmake") == [
        "p/src/filter.hpp:3 class Filter : public rclcpp::Node {"
    ]
    workspace = create_workspace(tmp_path / "b", text + CPP, build_type="ament_cmake")
    assert [workspace.shown(each.location) for each in references(workspace.context, workspace.offset)] == [
        "main.launch.xml:3 p::Filter",
        "main.launch.xml:6 p::Filter",
        "p/CMakeLists.txt:3 p::Filter",
        "p/src/filter.hpp:3 class Filter : public rclcpp::Node {",
    ]


XML = """
//- main.launch.xml
<launch>
  <node pkg="p" exec="talker" name="talker" namespace="front">
    <param name="ra$0te" value="5"/>
    <param from="{folder}/params.yaml"/>
    <remap from="%schatter" to="/words"/>
  </node>
  <node pkg="p" exec="talker" name="listener"><remap from="heard" to="/wo%srds"/></node>
</launch>
//- params.yaml
/**:
  ros__parameters:
    rate: 7
//- interfaces
{"/front/talker": {"publishers": {"chatter": "std_msgs/msg/String"}, "params": {"rate": 1},
                   "made": {"chatter": ["{folder}/p/p/talker.py", 5], "rate": ["{folder}/p/p/talker.py", 6]}},
 "/listener": {"subscribers": {"heard": "std_msgs/msg/String"}, "made": {"heard": ["{folder}/p/p/talker.py", 9]}}}
"""


def test_a_parameter_is_found_where_it_is_set_and_declared(tmp_path: Path) -> None:
    assert named_at(tmp_path, XML.replace("%s", "") + PACKAGE) == [
        "main.launch.xml:3 rate",
        "p/p/talker.py:6 pass",
        "params.yaml:3 rate",
    ]


def test_a_parameter_is_found_from_its_file(tmp_path: Path) -> None:
    text = XML.replace("%s", "").replace("$0", "").replace("    rate: 7", "    ra$0te: 7") + PACKAGE
    assert named_at(tmp_path, text) == ["params.yaml:3 rate", "main.launch.xml:3 rate", "p/p/talker.py:6 pass"]


@pytest.mark.parametrize("at", [0, 1])
def test_a_topic_is_found_at_all_its_ends(tmp_path: Path, at: int) -> None:
    cursors = tuple("$0" if n == at else "" for n in range(2))
    assert named_at(tmp_path, XML.replace("$0", "") % cursors + PACKAGE) == [
        "main.launch.xml:5 chatter",
        "main.launch.xml:5 /words",
        "main.launch.xml:7 heard",
        "main.launch.xml:7 /words",
        "p/p/talker.py:5 def start(self):",
        "p/p/talker.py:9 def start():",
    ]


PYTHON = """
//- main.launch.py
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(
            package="p", executable="talker", name="talker", namespace="front",
            remappings=[("chatter", "/words")],
            parameters=[{"rate": 5}],
        ),
        Node(package="p", executable="talker", name="listener", remappings=[("heard", "/words")]),
    ])
//- interfaces
""" + XML.partition("//- interfaces\n")[2]


@pytest.mark.ros
@pytest.mark.parametrize("name", ['"$0chatter"', '"$0/words"', '"$0heard"'])
def test_remaps_in_python(tmp_path: Path, name: str) -> None:
    text = PYTHON.replace(name.replace("$0", ""), name, 1) + PACKAGE
    assert named_at(tmp_path, text, runs=True) == [
        "main.launch.py:9 chatter",
        "main.launch.py:9 /words",
        "main.launch.py:12 heard",
        "main.launch.py:12 /words",
        "p/p/talker.py:5 def start(self):",
        "p/p/talker.py:9 def start():",
    ]


@pytest.mark.ros
def test_parameters_in_python(tmp_path: Path) -> None:
    text = PYTHON.replace('"rate": 5', '"$0rate": 5') + PACKAGE
    assert named_at(tmp_path, text, runs=True) == ["main.launch.py:10 rate", "p/p/talker.py:6 pass"]


@pytest.mark.ros
@pytest.mark.parametrize(("name", "met"), [('"$0/words"', 9), ('"$0heard"', 5)])
def test_a_remap_in_python_leads_to_the_other_end(tmp_path: Path, name: str, met: int) -> None:
    text = PYTHON.replace(name.replace("$0", ""), name, 1) + PACKAGE
    ends = {9: "p/p/talker.py:9 def start():", 5: "p/p/talker.py:5 def start(self):"}
    own = {9: [], 5: [ends[9]]}[met]
    assert gone_to(tmp_path / "a", text, runs=True) == (own or [ends[met]])
    lines = hovered(tmp_path / "b", text, runs=True)
    assert "- topic `/words`: subscriber `/listener` `std_msgs/msg/String` — " in " ".join(lines)
    assert not any("talker` —" in line for line in lines[:1]), "the remap, not the node around it"


COMPONENT_IN_PYTHON = """
//- main.launch.py
from launch import LaunchDescription
from launch_ros.actions import ComposableNodeContainer
from launch_ros.descriptions import ComposableNode


def generate_launch_description():
    one = ComposableNode(package="p", plugin="p::Fil$0ter", name="filter")
    return LaunchDescription([
        ComposableNodeContainer(
            package="rclcpp_components", executable="component_container", name="c", namespace="",
            composable_node_descriptions=[one],
        ),
    ])
//- other.launch.xml
<launch>
  <load_composable_node target="/c"><composable_node pkg="p" plugin="p::Filter" name="other"/></load_composable_node>
</launch>
"""


def test_a_component_in_python_is_found_without_a_run(tmp_path: Path) -> None:
    made = "p/src/filter.hpp:3 class Filter : public rclcpp::Node {"
    assert gone_to(tmp_path / "a", COMPONENT_IN_PYTHON + CPP, "ament_cmake") == [made]
    workspace = create_workspace(tmp_path / "b", COMPONENT_IN_PYTHON + CPP, build_type="ament_cmake")
    assert [workspace.shown(each.location) for each in references(workspace.context, workspace.offset)] == [
        "main.launch.py:7 p::Filter",
        "other.launch.xml:2 p::Filter",
        "p/CMakeLists.txt:3 p::Filter",
        made,
    ]


@pytest.mark.ros
def test_a_component_in_python_is_described_once_the_file_was_run(tmp_path: Path) -> None:
    lines = hovered(tmp_path, COMPONENT_IN_PYTHON + CPP, "ament_cmake", runs=True)
    assert lines[0].startswith("**/filter** `p/p::Filter`")


def test_the_function_of_an_executable_is_among_its_references(tmp_path: Path) -> None:
    text = '//- main.launch.xml\n<launch>\n  <node pkg="p" exec="tal$0ker" name="a"/>\n</launch>\n' + PACKAGE
    assert named_at(tmp_path, text) == [
        "main.launch.xml:2 talker",
        "p/p/talker.py:9 def start():",
        "p/setup.py:2 talker",
    ]


def test_what_stands_beside_a_parameter_file_in_python_is_not_its_package(tmp_path: Path) -> None:
    text = """
//- main.launch.py
def generate_launch_description():
    config = os.path.join(get_package_share_directory("p"), "params.yaml")
    return LaunchDescription([Node(package="p", executable="talker", parameters=[{"a": wor$0ds}, config])])
"""
    assert gone_to(tmp_path / "a", text + PACKAGE) == []
    text = text.replace("$0", "").replace(", config", ", con$0fig")
    assert gone_to(tmp_path / "b", text + PACKAGE) == ["p/params.yaml:1"]


IN_VARIABLES = [
    ('pkg = "$0p"', 'Node(package=pkg, executable="talker")', "p/package.xml:1"),
    ('pkg = "p"', 'Node(package=pk$0g, executable="talker")', "p/package.xml:1"),
    ('exe = "tal$0ker"', 'Node(package="p", executable=exe)', "p/p/talker.py:9 def start():"),
    ('exe = "talker"', 'Node(package="p", executable=ex$0e)', "p/p/talker.py:9 def start():"),
    ('a = LaunchConfiguration("$0a")', 'Node(package="p", executable="talker", name=a)', "main.launch.py:8 a"),
    ('a = LaunchConfiguration("a")', 'Node(package="p", executable="talker", name=$0a)', "main.launch.py:8 a"),
]


@pytest.mark.parametrize(("before", "node", "target"), IN_VARIABLES)
def test_from_where_a_value_is_written_and_from_where_it_is_given(
    tmp_path: Path, before: str, node: str, target: str
) -> None:
    text = f"""
//- main.launch.py
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
def generate_launch_description():
    {before}
    return LaunchDescription([
        DeclareLaunchArgument("a", default_value="b"), {node}
    ])
"""
    assert gone_to(tmp_path, text + PACKAGE) == [target]


def test_the_value_of_an_argument_that_is_passed(tmp_path: Path) -> None:
    text = """
//- main.launch.xml
<launch>
  <include file="{folder}/inc.launch.xml"><arg name="ra$0te" value="5"/></include>
</launch>
//- inc.launch.xml
<launch><arg name="rate" default="" description="How often"/></launch>
"""
    lines = hovered(tmp_path / "a", text + PACKAGE)
    assert lines[:3] == ["argument `rate` = `5`", "Default: `''`", "How often"]
    lines = hovered(tmp_path / "b", text.replace('inc.launch.xml"', 'none.launch.xml"') + PACKAGE)
    assert lines[0] == "argument `rate` = `5`"


_PYTHON = """
//- main.launch.py
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    sim = LaunchConfiguration("sim")
    return LaunchDescription([
        DeclareLaunchArgument("sim", default_value="SIM"),
        GroupAction([
            Node(package="p", executable="talker", name="node", parameters=[{"rate": 3}], remappings=[("a", "b")]),
        ], condition=IfCondition(sim)),
    ])
"""
_XML = """
//- main.launch.xml
<launch>
  <arg name="sim" default="SIM"/>
  <group if="$(var sim)">
    <node pkg="p" exec="talker" name="node" if="$(var sim)">
      <param name="rate" value="3"/>
      <remap from="a" to="b"/>
    </node>
  </group>
</launch>
"""
_YAML = """
//- main.launch.yaml
launch:
- arg: {name: "sim", default: "SIM"}
- group:
  - node: {pkg: "p", exec: "talker", name: "node", if: $(var sim),
           param: [{name: "rate", value: 3}], remap: [{from: "a", to: "b"}]}
"""
_ROS1 = """
<launch>
  <arg name="sim" default="SIM"/>
  <node pkg="p" type="talker.py" name="node" if="$(arg sim)">
    <param name="rate" value="3"/>
    <remap from="a" to="b"/>
  </node>
</launch>
//- p/scripts/talker.py
#!/usr/bin/env python
"""


def _said(folder: Path, text: str, cursor: str, *, runs: bool = False) -> tuple[list[str], list[str]]:
    """What hover and definition say at the first place that is written so."""
    text = text.replace(cursor.replace("$0", ""), cursor, 1)
    kind = "catkin" if text.startswith(_ROS1[:9]) else "ament_python"
    hovers = hovered(folder, text, kind, runs=runs)
    return [line.replace(str(folder), "") for line in hovers], gone_to(folder, text, kind, runs=runs)


@pytest.mark.parametrize("cursor", ['"tal$0ker', '"no$0de"', '"ra$0te"', '"a$0"', '"b$0"'])
@pytest.mark.parametrize(
    "text",
    [pytest.param(_PYTHON, marks=pytest.mark.ros, id="python"), _XML, _YAML, _ROS1],
    ids=["python", "xml", "yaml", "ros1"],
)
def test_a_node_that_a_condition_leaves_out_is_like_any_other(tmp_path: Path, text: str, cursor: str) -> None:
    more, runs = ("" if text == _ROS1 else PACKAGE), text == _PYTHON
    taken = _said(tmp_path / "a", text.replace("SIM", "true") + more, cursor, runs=runs)
    left_out = _said(tmp_path / "b", text.replace("SIM", "false") + more, cursor, runs=runs)
    assert taken[0]
    said = [line for line in left_out[0] if not line.startswith("Left out of this launch: condition `")]
    assert (said, left_out[1]) == taken
    assert (said == left_out[0]) == (cursor == '"ra$0te"')


def test_a_python_launch_file_that_was_not_run_tells_of_its_nodes(tmp_path: Path) -> None:
    text = _PYTHON.replace("SIM", "false") + PACKAGE
    said, led_to = _said(tmp_path, text, '"tal$0ker')
    assert said[0] == "**/node** `p/talker` — [talker.py](file:///p/p/talker.py)"
    assert said[-1] == "Left out of this launch: condition `IfCondition(sim)` (`if`) is false"
    assert led_to == ["p/p/talker.py:9 def start():"]


def test_a_file_that_is_included_twice_is_shown_where_it_is_taken(tmp_path: Path) -> None:
    text = """
//- main.launch.xml
<launch>
  <include file="{folder}/inc.launch.xml"><arg name="sim" value="false"/></include>
  <include file="{folder}/inc.launch.xml"><arg name="sim" value="true"/></include>
</launch>
//- inc.launch.xml
<launch><arg name="sim"/><node pkg="p" exec="tal$0ker" name="a" if="$(var sim)"/></launch>
"""
    lines = hovered(tmp_path, text + PACKAGE)
    assert lines[0].startswith("**/a** `p/talker`")
    assert not [line for line in lines if line.startswith("Left out")]
