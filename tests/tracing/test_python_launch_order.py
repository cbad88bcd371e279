"""Python launch files: scopes, event handlers, and whether all that is recorded is evaluated."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest
from preflight_analysis.evaluation.ros2.actions.registry import entities
from preflight_analysis.tracing.agents.fake_launch.api import CALLS
from preflight_analysis.tracing.backend import AGENTS
from support.python_launch_harness import PythonHarness

pytestmark = pytest.mark.ros

HEAD = """\
from launch import LaunchDescription, LaunchDescriptionSource
from launch.actions import *
from launch.conditions import IfCondition
from launch.event_handlers import *
from launch.substitutions import *
from launch_ros.actions import *
def n(name, **more):
    return Node(package='p', executable='x', name=name, **more)
"""


@pytest.fixture
def harness(tmp_path: Path) -> PythonHarness:
    return PythonHarness(tmp_path)


def _described(harness: PythonHarness, *actions: str, before: str = "") -> Path:
    text = HEAD + before + "\ndef generate_launch_description():\n    return LaunchDescription([\n"
    return harness.write(
        "launch/a.launch.py", text + "".join(f"        {action},\n" for action in actions) + "    ])\n"
    )


def _started(harness: PythonHarness, *actions: str, before: str = "", args: dict[str, str] | None = None) -> list[str]:
    """The names of the nodes in order, those that are deferred in brackets."""
    tree = harness.launch(_described(harness, *actions, before=before), args).tree
    assert not tree.problems
    return [f"({node.name})" if node.deferred else node.name for node in tree.nodes if node.kind != "process"]


def _kinds() -> Iterator[str]:
    """What the fake gives as the kind of an action or a child, wherever it does."""
    yield from (each.kind for each in CALLS if each.kind in entities())
    for path in (AGENTS.library / "fake_launch").glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.Assign):
                targets = [getattr(target, "attr", getattr(target, "id", "")) for target in node.targets]
                if {"kind", "preflight_kind"} & set(targets) and path.name != "substitutions.py":
                    yield from _texts(node.value)
            elif isinstance(node, ast.Call) and getattr(node.func, "attr", "") in ("child", "inside"):
                yield from _texts(node.args[0])
            elif isinstance(node, ast.Dict):
                for key, value in zip(node.keys, node.values, strict=True):
                    if isinstance(key, ast.Constant) and key.value == "k":
                        yield from _texts(value)


def _texts(node: ast.expr) -> Iterator[str]:
    for each in ast.walk(node):
        if isinstance(each, ast.Constant) and isinstance(each.value, str) and each.value:
            yield each.value


OF_SOURCES = {"python", "xml", "yaml"}
"""Kinds of sources of launch descriptions, not of actions."""


def test_what_is_recorded_is_declared() -> None:
    recorded = set(_kinds()) - OF_SOURCES
    assert {"push_env", "append_env", "node", "arg_passed", "param"} <= recorded
    assert not recorded - entities().keys()


def test_environments_have_a_stack_of_their_own(harness: PythonHarness) -> None:
    names = _started(
        harness,
        "SetEnvironmentVariable('A', 'one')",
        "SetLaunchConfiguration('c', 'one')",
        "PushEnvironment()",
        "PushLaunchConfigurations()",
        "SetEnvironmentVariable('A', 'two')",
        "AppendEnvironmentVariable('A', 'end', separator='_')",
        "SetLaunchConfiguration('c', 'two')",
        "n(['a_', EnvironmentVariable('A'), '_', LaunchConfiguration('c')])",
        "PopLaunchConfigurations()",
        "n(['b_', EnvironmentVariable('A'), '_', LaunchConfiguration('c')])",
        "PopEnvironment()",
        "n(['c_', EnvironmentVariable('A'), '_', LaunchConfiguration('c')])",
        "ResetEnvironment()",
        "n(['d_', EnvironmentVariable('A', default_value='none')])",
    )
    assert names == ["/a_two_end_two", "/b_two_end_one", "/c_one_one", "/d_none"]


def test_a_configuration_that_is_unset_is_none(harness: PythonHarness) -> None:
    used = "n(['a_', LaunchConfiguration('c', default='none')])"
    names = _started(harness, "SetLaunchConfiguration('c', 'one')", used, "UnsetLaunchConfiguration('c')", used)
    assert names == ["/a_one", "/a_none"]


def test_events_that_are_emitted_and_states_of_nodes_start_nothing(harness: PythonHarness) -> None:
    state = "LifecycleTransition(lifecycle_node_names=['n'], transition_ids=[1])"
    tree = harness.launch(_described(harness, "EmitEvent(event=None)", state, "n('n')")).tree
    assert [node.name for node in tree.nodes] == ["/n"]
    assert not tree.unknowns


def test_what_a_coroutine_does_is_not_known(harness: PythonHarness) -> None:
    tree = harness.launch(_described(harness, "OpaqueCoroutine(coroutine=None)", "n('n')")).tree
    assert [node.name for node in tree.nodes] == ["/n"]
    assert [unknown.what for unknown in tree.unknowns] == ["OpaqueCoroutine"]


@pytest.mark.parametrize("kind", ["Environment", "LaunchConfigurations"])
def test_a_pop_without_a_push_stops_launch(harness: PythonHarness, kind: str) -> None:
    path = _described(harness, f"Push{kind}()", f"Pop{kind}()", f"Pop{kind}()")
    (finding,) = harness.launch(path).findings
    assert (finding.rule, finding.stops_launch) == ("LCH032", True)
    assert finding.message.endswith("stack unexpectedly empty")
    assert path.read_text()[: finding.location.span.start].count("Pop") == 1


def test_what_a_group_keeps_is_set_one_after_the_other(harness: PythonHarness) -> None:
    kept = "launch_configurations={'a': '2', 'b': LaunchConfiguration('a')}"
    names = _started(
        harness,
        "SetLaunchConfiguration('a', '1')",
        f"GroupAction([n(['x', LaunchConfiguration('b')])], {kept})",
        f"GroupAction([n(['y', LaunchConfiguration('b')])], forwarding=False, {kept})",
    )
    assert names == ["/x2", "/y1"]


def test_a_description_within_another_is_no_scope(harness: PythonHarness) -> None:
    before = (
        "arguments = LaunchDescription([DeclareLaunchArgument('rate', default_value='5'),"
        " SetLaunchConfiguration('frame', 'base')])\n"
    )
    used = "n(['r', LaunchConfiguration('rate'), LaunchConfiguration('frame')])"
    assert _started(harness, "arguments", used, before=before) == ["/r5base"]
    assert _started(harness, "arguments", used, before=before, args={"rate": "6"}) == ["/r6base"]


def test_a_description_that_is_included_without_a_file_gets_arguments(harness: PythonHarness) -> None:
    before = "inner = LaunchDescription([DeclareLaunchArgument('rate'), n(['r', LaunchConfiguration('rate')])])\n"
    include = "IncludeLaunchDescription(LaunchDescriptionSource(inner), launch_arguments={'rate': '7'}.items())"
    assert _started(harness, include, before=before) == ["/r7"]


FIRST = "first = n('first')\nother = n('other', condition=IfCondition('false'))\n"


def _on_start(target: str, *nodes: str) -> str:
    return f"RegisterEventHandler(OnProcessStart({target}on_start=[{', '.join(nodes)}]))"


@pytest.mark.parametrize(
    ("actions", "expected"),
    [
        (("first", _on_start("target_action=first, ", "n('late')"), "n('end')"), ["/first", "/end", "/late"]),
        ((_on_start("target_action=first, ", "n('late')"), "first"), ["/first", "/late"]),
        (("first", "n('b')", _on_start("", "n('late')")), ["/first", "/b", "/late"]),
        # One that is not started has no event.
        (("first", "other", _on_start("target_action=other, ", "n('late')")), ["/first"]),
        (
            (
                "TimerAction(period=1.0, actions=[first])",
                _on_start("target_action=first, ", "n('late')"),
                "n('end')",
            ),
            ["/end", "(/first)", "(/late)"],
        ),
        (
            ("first", "RegisterEventHandler(OnProcessExit(target_action=first, on_exit=[n('late')]))"),
            ["/first", "(/late)"],
        ),
        # Within a group it is registered, outside of it executed.
        (
            ("GroupAction([PushRosNamespace('g'), first, " + _on_start("target_action=first, ", "n('late')") + "])",),
            ["/g/first", "/late"],
        ),
        # The one that was registered last comes first.
        (
            (_on_start("target_action=first, ", "n('a')"), _on_start("target_action=first, ", "n('b')"), "first"),
            ["/first", "/b", "/a"],
        ),
    ],
)
def test_nodes_of_the_start_of_a_process(harness: PythonHarness, actions: tuple[str, ...], expected: list[str]) -> None:
    assert _started(harness, *actions, before=FIRST) == expected


def test_starts_follow_each_other(harness: PythonHarness) -> None:
    second = "second = n('second')\n"
    names = _started(
        harness,
        _on_start("target_action=second, ", "n('third')"),
        _on_start("target_action=first, ", "second"),
        "first",
        before=FIRST + second,
    )
    assert names == ["/first", "/second", "/third"]


def test_a_handler_that_was_removed_does_nothing(harness: PythonHarness) -> None:
    before = FIRST + "handler = OnProcessStart(target_action=first, on_start=[n('late')])\n"
    names = _started(
        harness, "RegisterEventHandler(handler)", "UnregisterEventHandler(handler)", "first", before=before
    )
    assert names == ["/first"]


def test_a_handler_of_what_may_be_started_is_deferred(harness: PythonHarness) -> None:
    """Whether it is depends on a command, which is not run here."""
    before = "first = n('first', condition=IfCondition(Command('no_such_command')))\n"
    path = _described(harness, "first", _on_start("target_action=first, ", "n('late')"), before=before)
    assert [(node.name, node.deferred) for node in harness.launch(path).tree.nodes] == [("/late", True)]


def test_what_is_no_process_is_no_target(harness: PythonHarness) -> None:
    path = _described(harness, _on_start("target_action='first', ", "n('late')"))
    (finding,) = [f for f in harness.launch(path).findings if f.rule == "LCH032"]
    assert finding.message == "TypeError: action_matcher must be an 'ExecuteProcess' instance or a callable"
