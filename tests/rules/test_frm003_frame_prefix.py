"""FRM003: a frame whose prefix or namespace differs between its publisher and its user."""

import pytest
from support.check import check
from support.frame_launch import EKF, EKF_COLUMN, below, fixture, robot, static

_PREFIX = '<param name="frame_prefix" value="{}"/>'


@pytest.mark.parametrize(
    ("prefix", "used", "said"),
    [
        ("one/", "base", "frame 'base' is published as 'one/base': /ekf uses it (parameter 'base_link_frame')"),
        ("one", "base", "frame 'base' is published as 'onebase'"),
        # https://github.com/ros/robot_state_publisher/issues/205
        ("one", "one/base", "(parameter 'base_link_frame'); 'frame_prefix' lacks the '/' at its end"),
        ("", "one/base", "frame 'one/base' is published as 'base'"),
    ],
)
def test_a_prefix_on_one_side(prefix: str, used: str, said: str) -> None:
    publisher = robot(("base", "laser"), more=_PREFIX.format(prefix) if prefix else "")
    odom = static("s", "odom", f"{prefix}base")
    expected = below(EKF_COLUMN, len(used), f"warning[FRM003] {said}")
    check(fixture(f"{publisher}\n{odom}\n{EKF.format(used, chr(10) + expected + chr(10))}"))


def test_a_namespace_of_tf_on_one_side() -> None:
    remap = '<remap from="/tf" to="/one/tf"/><remap from="/tf_static" to="/one/tf_static"/>'
    said = "frame 'base' is published on '/one/tf', and /ekf listens to '/tf' (parameter 'base_link_frame')"
    expected = below(EKF_COLUMN, 4, f"warning[FRM003] {said}")
    nodes = f"{robot(('base', 'laser'), more=remap)}\n{static('s', 'odom', 'other')}"
    check(fixture(f"{nodes}\n{EKF.format('base', chr(10) + expected + chr(10))}"))


@pytest.mark.silent
def test_the_same_on_both_sides() -> None:
    publisher = robot(("base", "laser"), more=_PREFIX.format("one/"))
    check(fixture(f"{publisher}\n{static('s', 'odom', 'one/base')}\n{EKF.format('one/base', '')}"))


@pytest.mark.silent
def test_a_topic_that_a_node_passes_on() -> None:
    """As in medipick_moveit_config: a node makes `/tf` of `/raw_tf`."""
    remap = '<remap from="/tf" to="/one/raw_tf"/><remap from="/tf_static" to="/one/raw_tf_static"/>'
    check(fixture(f"{robot(('base', 'laser'), more=remap)}\n{EKF.format('base', '')}"))
