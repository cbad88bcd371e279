"""The fake has the names of `launch` and `launch_ros` of each distribution, and they take what those do."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.launch.problems import BadValue
from support.python_launch_harness import PythonHarness

pytestmark = pytest.mark.ros

ROOT = Path(__file__).parent.parent.parent
LISTS = ROOT / "fixtures" / "ros2" / "launch_names"
Names = dict[str, dict[str, str | None]]


def _names(distribution: str) -> Names:
    """Kilted and today's Rolling are the last whole list and what came after it."""
    newer: dict[str, Any] = json.loads((LISTS / "newer.json").read_text())
    known = distribution if (LISTS / f"{distribution}.json").exists() else "rolling"
    names: Names = json.loads((LISTS / f"{known}.json").read_text())["names"]
    for each in {"kilted": ["kilted"], "rolling": ["kilted", "rolling"]}.get(distribution, []):
        for module, contents in newer[each]["names"].items():
            names.setdefault(module, {}).update(contents)
    return names


@pytest.mark.parametrize("distribution", ["humble", "jazzy", "kilted", "rolling"])
def test_the_fake_has_all_names(distribution: str) -> None:
    names = _names(distribution)
    assert sum(map(len, names.values())) > 400
    script = [sys.executable, str(ROOT / "tests" / "tracing" / "launch_names_missing.py")]
    done = subprocess.run(script, input=json.dumps(names), capture_output=True, text=True, check=True)
    assert json.loads(done.stdout) == {"missing": [], "other": []}


def test_what_a_launch_file_finds_without_importing_it(tmp_path: Path) -> None:
    """`ros2 launch` has imported launch before."""
    text = """
import sys
launch = sys.modules['launch']

def generate_launch_description():
    return launch.LaunchDescription([sys.modules['launch_ros'].actions.Node(package='p', executable='x', name='n')])
"""
    harness = PythonHarness(tmp_path)
    tree = harness.launch(harness.write("launch/a.launch.py", text)).tree
    assert [node.name for node in tree.nodes] == ["/n"]


LOADED = """
from launch import LaunchDescription
from launch.actions import OpaqueFunction
from launch.frontend.parse_substitution import parse_substitution
from launch.launch_description_sources import (
    get_launch_description_from_any_launch_file, get_launch_description_from_python_launch_file,
    load_python_launch_file_as_module)
from launch.substitutions import StringJoinSubstitution
from launch.utilities.type_utils import get_typed_value, perform_typed_substitution, normalize_typed_substitution
from launch_ros.actions import Node
import os
HERE = os.path.dirname(__file__)
OTHER = os.path.join(HERE, 'other.launch.py')

def setup(context):
    number = perform_typed_substitution(context, normalize_typed_substitution(parse_substitution('7'), int), int)
    return [Node(package='p', executable='x', name=f'n{number + get_typed_value("1", int)}')]

def generate_launch_description():
    module = load_python_launch_file_as_module(OTHER)
    joined = StringJoinSubstitution([['a', 'b'], parse_substitution('$(var of c)')], delimiter='_')
    return LaunchDescription([
        Node(package='p', executable='x', name=module.NAME), Node(package='p', executable='x', name=joined),
        *get_launch_description_from_python_launch_file(OTHER).entities,
        get_launch_description_from_any_launch_file(os.path.join(HERE, 'third.launch.xml')),
        OpaqueFunction(function=setup)])
"""


def test_what_they_do(tmp_path: Path) -> None:
    harness = PythonHarness(tmp_path)
    harness.write(
        "launch/other.launch.py",
        "from launch import LaunchDescription\nfrom launch_ros.actions import Node\nNAME = 'named'\n"
        "def generate_launch_description():\n"
        "    return LaunchDescription([Node(package='p', executable='x', name='other')])\n",
    )
    harness.write("launch/third.launch.xml", '<launch><node pkg="p" exec="x" name="third"/></launch>')
    tree = harness.launch(harness.write("launch/a.launch.py", LOADED)).tree
    assert not tree.problems
    assert [node.name for node in tree.nodes] == ["/named", "/ab_c", "/other", "/third", "/n8"]


def test_what_only_a_launch_can_do_is_no_error_of_the_file(tmp_path: Path) -> None:
    text = """
from launch import LaunchDescription
from launch.actions import OpaqueFunction
from launch_ros.ros_adapters import get_ros_node

def generate_launch_description():
    return LaunchDescription([OpaqueFunction(function=lambda context: [get_ros_node(context).get_name()])])
"""
    harness = PythonHarness(tmp_path)
    (finding,) = harness.launch(harness.write("launch/a.launch.py", text)).findings
    assert (finding.rule, finding.severity) == ("LCH018", "hint")
    assert "ROSAdapter.ros_node needs ROS" in finding.message


def test_loops_of_xml(tmp_path: Path) -> None:
    text = """
    <launch>
      <arg name="robots" default="{name: a, id: 1};{name: b};"/>
      <for len="2" name="i">
        <for len="$(index i)" name="j"><node pkg="p" exec="x" name="n$(index i)$(index j)"/></for>
      </for>
      <for_each values="$(var robots)">
        <node pkg="p" exec="x" name="$(string-join _ $(for-var name) $(for-var id 0))"/>
      </for_each>
      <for len="many" name="i"/>
    </launch>"""
    harness = PythonHarness(tmp_path)
    analysis = harness.launch(harness.write("launch/a.launch.xml", text))
    assert [node.name for node in analysis.tree.nodes] == ["/n10", "/a_1", "/b_0"]
    (problem,) = analysis.tree.problems
    assert isinstance(problem.kind, BadValue)
    assert problem.kind.expected == "an integer"
