"""What the events of Python launch files ask of lifecycle nodes."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.python_launch_harness import PythonHarness

pytestmark = pytest.mark.ros
FILE = """
from launch import LaunchDescription
from launch.actions import EmitEvent, ExecuteProcess, OpaqueFunction, RegisterEventHandler, TimerAction
from launch.event_handlers import OnProcessStart
from launch.events import matches_action
from launch_ros.actions import LifecycleNode, LifecycleTransition, Node
from launch_ros.event_handlers import OnStateTransition
from launch_ros.events import matches_node_name
from launch_ros.events.lifecycle import ChangeState
from lifecycle_msgs.msg import Transition


def node(name, **kwargs):
    return LifecycleNode(package='p', executable='x', name=name, namespace='robot', **kwargs)


def ask(matcher, transition):
    return EmitEvent(event=ChangeState(lifecycle_node_matcher=matcher, transition_id=transition))


def configured(node, *then):
    return RegisterEventHandler(OnStateTransition(
        target_lifecycle_node=node, start_state='configuring', goal_state='inactive', entities=list(then)))


def generate_launch_description():
    one, two = node('one'), node('two')
    configure, activate = Transition.TRANSITION_CONFIGURE, Transition.TRANSITION_ACTIVATE
    return LaunchDescription([one, {}])
"""
NEVER, ONLY = "never activated", "configured, but never activated"


@pytest.mark.parametrize(
    ("actions", "said"),
    [
        ("", NEVER),
        ("ask(matches_action(one), configure)", ONLY),
        ("ask(matches_action(one), activate)", NEVER),
        ("configured(one, ask(matches_action(one), activate)), ask(matches_action(one), configure)", None),
        ("configured(one, ask(matches_action(one), activate))", NEVER),
        (
            "RegisterEventHandler(OnProcessStart(target_action=one, on_start=[ask(matches_action(one), configure), "
            "configured(one, ask(matches_action(one), activate))]))",
            None,
        ),
        (
            "TimerAction(period=2.0, actions=[ask(matches_action(one), configure)]), "
            "TimerAction(period=4.0, actions=[ask(matches_action(one), activate)])",
            None,
        ),
        ("two, ask(matches_action(two), configure), ask(matches_action(two), activate)", NEVER),
        ("ask(matches_node_name('/robot/one'), configure), ask(matches_node_name('/robot/one'), activate)", None),
        ("ask(matches_node_name('/one'), configure), ask(matches_node_name('/one'), activate)", NEVER),
        ("ask(lambda each: True, configure), ask(lambda each: True, activate)", None),
        ("LifecycleTransition(lifecycle_node_names=['/robot/one'], transition_ids=[configure, activate])", None),
        ("LifecycleTransition(lifecycle_node_names=['/robot/one'], transition_ids=[configure])", ONLY),
        ("LifecycleTransition(lifecycle_node_names=['/robot/two'], transition_ids=[configure, activate])", NEVER),
        (
            "OpaqueFunction(function=lambda context: [ask(matches_action(one), configure), "
            "ask(matches_action(one), activate)])",
            None,
        ),
        ("RegisterEventHandler(OnProcessStart(target_action=one, on_start=lambda event, context: []))", None),
        (
            "ExecuteProcess(cmd=['ros2', 'lifecycle', 'set', '/robot/one', 'configure']), "
            "ExecuteProcess(cmd=['ros2 lifecycle set /robot/one activate'], shell=True)",
            None,
        ),
        ("ExecuteProcess(cmd=['ros2', 'lifecycle', 'set', '/robot/one', 'configure'])", ONLY),
        ("ExecuteProcess(cmd=['activate_all.sh'])", None),
    ],
)
def test_who_activates_a_lifecycle_node(tmp_path: Path, actions: str, said: str | None) -> None:
    harness = PythonHarness(tmp_path)
    analysis = harness.launch(harness.write("launch/a.launch.py", FILE.replace("{}", actions)))
    messages = [each.message for each in analysis.findings if each.rule == "LCH035" and "/robot/one " in each.message]
    assert [m.split(" by this launch")[0] for m in messages] == (
        [f"lifecycle node /robot/one is {said}"] if said else []
    )


@pytest.mark.parametrize(("condition", "said"), [("'true'", False), ("'false'", True), ("some_robot.GO", False)])
def test_events_under_a_condition(tmp_path: Path, condition: str, said: bool) -> None:
    harness = PythonHarness(tmp_path)
    asked = "ask(matches_action(one), configure), ask(matches_action(one), activate)"
    group = f"GroupAction([{asked}], condition=IfCondition({condition}))"
    imports = "import some_robot\nfrom launch.actions import GroupAction\nfrom launch.conditions import IfCondition"
    analysis = harness.launch(harness.write("launch/a.launch.py", imports + FILE.replace("{}", group)))
    assert ("LCH035" in [each.rule for each in analysis.findings]) == said


@pytest.mark.parametrize("autostart", ["True", "'true'"])
def test_launch_ros_activates_it(tmp_path: Path, autostart: str) -> None:
    harness = PythonHarness(tmp_path)
    text = FILE.replace("node('one')", f"node('one', autostart={autostart})").replace("{}", "")
    analysis = harness.launch(harness.write("launch/a.launch.py", text))
    assert "LCH035" not in [each.rule for each in analysis.findings]


@pytest.mark.parametrize("actions", ["", "ask(matches_action(one), configure)"])
def test_what_a_file_that_was_not_run_asks_for_is_not_known(tmp_path: Path, actions: str) -> None:
    harness = PythonHarness(tmp_path)
    analysis = harness.launch(harness.write("launch/a.launch.py", FILE.replace("{}", actions)), why_not="it is not")
    assert "LCH035" not in [each.rule for each in analysis.findings]
