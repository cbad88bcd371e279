"""PRM020: what `RewrittenYaml` or `ReplaceString` is to replace is not in the file."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.findings.finding import Finding
from support.python_launch_harness import PythonHarness

pytestmark = pytest.mark.ros

PARAMS = """
amcl:
  ros__parameters:
    use_sim_time: false
    frame: <robot_namespace>/base
    limits: {speed: 0.5}
"""
REAL = """
import launch

class RewrittenYaml(launch.Substitution):
    def __init__(self, source_file, param_rewrites, root_key=None):
        self.__source_file = launch.utilities.normalize_to_list_of_substitutions(source_file)
        self.__param_rewrites = {}
        for key in param_rewrites:
            self.__param_rewrites[key] = launch.utilities.normalize_to_list_of_substitutions(param_rewrites[key])

    @property
    def name(self):
        return self.__source_file

    def describe(self):
        return ""

    def perform(self, context):
        return launch.utilities.perform_substitutions(context, self.name)
"""


def _found(folder: Path, made: str, *, real: bool = False) -> list[Finding]:
    harness = PythonHarness(folder)
    harness.write("config/params.yaml", PARAMS)
    module = "p_launch" if real else "nav2_common.launch"
    if real:
        harness.write("launch/p_launch.py", REAL)
    path = harness.write(
        "launch/a.launch.py",
        f"""
import os, sys
sys.path.insert(0, os.path.dirname(__file__))
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.conditions import IfCondition
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from {module} import *

def generate_launch_description():
    file = os.path.join(get_package_share_directory("p"), "config", "params.yaml")
    made = {made}
    return LaunchDescription([
        DeclareLaunchArgument("sim", default_value="true"),
        Node(package="p", executable="x", name="amcl", parameters=[made]),
    ])
""",
    )
    return [each for each in harness.launch(path).findings if each.rule == "PRM020"]


@pytest.mark.parametrize("real", [False, True])
def test_a_slip_in_a_key_that_is_to_be_rewritten(tmp_path: Path, real: bool) -> None:
    made = """RewrittenYaml(source_file=file, param_rewrites={"use_sim_tiem": LaunchConfiguration("sim")})"""
    (finding,) = _found(tmp_path, made, real=real)
    assert (finding.severity, finding.confidence) == ("warning", "certain")
    assert "key 'use_sim_tiem' of RewrittenYaml replaces nothing" in finding.message
    assert [edit.text for edit in finding.fixes[0].edits] == ["use_sim_time"]


def test_a_slip_in_a_text_that_is_to_be_replaced(tmp_path: Path) -> None:
    made = """ReplaceString(source_file=file, replacements={"<robot_namespce>": "r1"})"""
    (finding,) = _found(tmp_path, made)
    assert finding.severity == "warning"
    assert "text '<robot_namespce>' of ReplaceString replaces nothing" in finding.message


def test_what_is_like_nothing_in_the_file_is_but_a_hint(tmp_path: Path) -> None:
    (finding,) = _found(tmp_path, """RewrittenYaml(source_file=file, param_rewrites={"autostart": "true"})""")
    assert (finding.severity, finding.confidence) == ("hint", "certain")


def test_a_class_of_that_name_which_is_another_one(tmp_path: Path) -> None:
    made = """type("RewrittenYaml", (__import__("launch").Substitution,), {
        "__init__": lambda self: self.__dict__.update(source_file="/x", param_rewrites={"a": 1}),
        "perform": lambda self, context: file})()"""
    harness = PythonHarness(tmp_path)
    assert not _found(tmp_path, made)
    assert harness.launch(harness.package / "launch/a.launch.py").tree.complete


@pytest.mark.silent
def test_what_is_in_the_file_or_added_to_it_or_not_replaced_now(tmp_path: Path) -> None:
    made = """RewrittenYaml(
        source_file=ReplaceString(file, {"<robot_namespace>": "r1"}),
        param_rewrites={"use_sim_time": "true", "speed": "1", "amcl.ros__parameters.limits.sped": "2"})"""
    assert not _found(tmp_path, made)
    made = """ReplaceString(file, {"<robot_namespce>": "r1"}, condition=IfCondition("false"))"""
    assert not _found(tmp_path, made)
