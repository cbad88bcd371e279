"""Python launch files: an answer of a file's own code holds wherever all that the code read is the same."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest
from preflight_analysis.evaluation.ros2.python_runs import parse_request
from preflight_analysis.workspace.workspace import Analysis
from support.python_launch_harness import PythonHarness

pytestmark = pytest.mark.ros

HEAD = """\
import os
from launch import LaunchDescription, Substitution
from launch.actions import *
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch.substitutions import *
from launch_ros.actions import *


class Own(Substitution):
    def __init__(self, function):
        super().__init__()
        self.function = function

    def perform(self, context):
        return self.function(context)


def n(name):
    return Node(package='p', executable='x', name=name)


def let(name, value):
    return SetLaunchConfiguration(name, value)
"""


@pytest.fixture
def harness(tmp_path: Path) -> PythonHarness:
    return PythonHarness(tmp_path)


def _launched(
    harness: PythonHarness, *actions: str, before: str = "", args: Mapping[str, str] | None = None
) -> Analysis:
    text = HEAD + before + "\ndef generate_launch_description():\n    return LaunchDescription([\n"
    path = harness.write("launch/a.launch.py", text + "".join(f"        {each},\n" for each in actions) + "    ])\n")
    return harness.launch(path, args)


def _names(analysis: Analysis) -> list[str]:
    assert not analysis.tree.problems
    return [node.name for node in analysis.tree.nodes]


def _calls(analysis: Analysis) -> int:
    """How many different calls of the file's own code were asked for."""
    asked = {command.line: parse_request(command.line) for command in analysis.tree.commands}
    return sum(1 for request in asked.values() if request is not None and request["calls"])


OF_ROBOT = "OWN = Own(lambda context: LaunchConfiguration('robot').perform(context))\n"


def test_what_is_not_read_makes_no_difference(harness: PythonHarness) -> None:
    analysis = _launched(
        harness,
        "DeclareLaunchArgument('robot', default_value='r1')",
        "n(['a_', OWN])",
        "let('speed', '1')",
        "n(['b_', OWN])",
        "SetEnvironmentVariable('SPEED', '2')",
        "n(['c_', OWN])",
        "let('speed', Own(lambda context: 'nothing'))",
        "n(['d_', OWN])",
        before=OF_ROBOT,
    )
    assert _names(analysis) == ["/a_r1", "/b_r1", "/c_r1", "/d_r1"]
    assert _calls(analysis) == 2


READS = {
    "by its name": ("context.launch_configurations['robot']", "let('robot', '{}')"),
    "if it is there": (
        "str('robot' in context.launch_configurations)",
        "let('robot', '{}') if {!r} == 'two' else let('other', '')",
    ),
    "all of them": ("'_'.join(sorted(context.launch_configurations))", "let('{}', '')"),
    "a copy": ("dict(context.launch_configurations)['robot']", "let('robot', '{}')"),
    "unpacked": ("(lambda robot, **more: robot)(**context.launch_configurations)", "let('robot', '{}')"),
    "a variable": ("os.environ.get('ROBOT', 'none')", "SetEnvironmentVariable('ROBOT', '{}')"),
    "a variable of the context": ("context.environment['ROBOT']", "SetEnvironmentVariable('ROBOT', '{}')"),
    "all variables": ("dict(os.environ).get('ROBOT', 'none')", "SetEnvironmentVariable('ROBOT', '{}')"),
    "in another program": (
        "__import__('subprocess').check_output(['/bin/sh', '-c', 'printf %s $ROBOT'], text=True)",
        "SetEnvironmentVariable('ROBOT', '{}')",
    ),
}


@pytest.mark.parametrize(("read", "written"), READS.values(), ids=READS.keys())
def test_what_is_read_makes_one(harness: PythonHarness, read: str, written: str) -> None:
    analysis = _launched(
        harness,
        written.format("one", "one"),
        "n(['a_', OWN])",
        written.format("two", "two"),
        "n(['b_', OWN])",
        before=f"OWN = Own(lambda context: {read})\n",
    )
    first, second = _names(analysis)
    assert first.removeprefix("/a_") != second.removeprefix("/b_")
    assert _calls(analysis) == 2


def test_the_current_launch_file_is_read(harness: PythonHarness) -> None:
    harness.write("launch/b.launch.xml", "<launch/>")
    analysis = _launched(
        harness,
        "n(['a_', OWN])",
        "IncludeLaunchDescription(AnyLaunchDescriptionSource([ThisLaunchFileDir(), '/b.launch.xml']))",
        "n(['b_', OWN])",
        before="OWN = Own(lambda context: os.path.basename(ThisLaunchFile().perform(context))[0])\n",
    )
    assert _names(analysis) == ["/a_a", "/b_b"]


def test_what_is_written_is_read(harness: PythonHarness) -> None:
    """The answer says what is different afterwards: nothing, where it was the same before."""
    analysis = _launched(
        harness,
        "let('robot', 'r1')",
        "SetEnvironmentVariable('ROBOT', 'r1')",
        "ACTION",
        "let('robot', 'r2')",
        "SetEnvironmentVariable('ROBOT', 'r2')",
        "ACTION",
        "n([LaunchConfiguration('robot'), EnvironmentVariable('ROBOT')])",
        before="""
def own(context):
    context.launch_configurations['robot'] = 'r1'
    os.environ['ROBOT'] = 'r1'


ACTION = OpaqueFunction(function=own)
""",
    )
    assert _names(analysis) == ["/r1r1"]


def test_a_call_within_a_call_is_asked_once_too(harness: PythonHarness) -> None:
    analysis = _launched(
        harness,
        "let('robot', 'r1')",
        "ACTION",
        "PushRosNamespace('a')",
        "ACTION",
        before=OF_ROBOT
        + """
def outer(context):
    return [OpaqueFunction(function=lambda inner: [n(LaunchConfiguration('robot').perform(inner))])]


ACTION = OpaqueFunction(function=outer)
""",
    )
    assert _names(analysis) == ["/r1", "/a/r1"]
    assert _calls(analysis) == 2


def test_an_include_is_run_once_where_it_reads_no_variable(harness: PythonHarness) -> None:
    harness.write(
        "launch/b.launch.py",
        HEAD + "\ndef generate_launch_description():\n    return LaunchDescription([n(LaunchConfiguration('name'))])\n",
    )
    include = "IncludeLaunchDescription(AnyLaunchDescriptionSource([ThisLaunchFileDir(), '/b.launch.py']))"
    analysis = _launched(
        harness, "let('name', 'a')", include, "SetEnvironmentVariable('SPEED', '2')", "let('name', 'b')", include
    )
    assert _names(analysis) == ["/a", "/b"]
    assert len({command.line for command in analysis.tree.commands}) == 2


def test_only_what_it_reads_makes_a_failure_uncertain(harness: PythonHarness) -> None:
    before = """
def own(context):
    raise ValueError(LaunchConfiguration('robot').perform(context))
"""
    actions = (
        "let('robot', 'r1')",
        "let('speed', EnvironmentVariable('NOT_SET_ANYWHERE'))",
        "OpaqueFunction(function=own)",
    )
    certain = _launched(harness, *actions, before=before)
    assert "LCH032" in {finding.rule for finding in certain.findings}
    unknown = _launched(harness, *actions, before=before.replace("'robot'", "'speed'"))
    assert "LCH032" not in {finding.rule for finding in unknown.findings}
