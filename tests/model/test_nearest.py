"""Which names count as near."""

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from preflight_analysis.model.nearest import is_word_more, likeness, nearest


@pytest.mark.parametrize(
    ("name", "candidates", "expected"),
    [
        ("camra", ["camera", "lidar"], "camera"),
        ("Camera", ["camera"], "camera"),
        ("my-node", ["my_node"], "my_node"),
        ("frame", ["frames", "frame_id"], "frames"),
        ("parm", ["param", "rosparam"], "param"),
        ("ab", ["ac"], None),
        ("talker", ["listener"], None),
        ("talker", ["talker"], None),
        ("talker", [], None),
        ("resolution_fixed", ["fixed_resolution", "resolution"], "fixed_resolution"),
        ("velocity_controller_left", ["vel_ctrl_left", "vel_controller_left"], "vel_controller_left"),
        ("velocity_left", ["vel_left", "velo_left"], None),
        ("left_front", ["front_right"], None),
        ("wheel", ["wheels_of_robot"], None),
    ],
)
def test_nearest(name: str, candidates: list[str], expected: str | None) -> None:
    assert nearest(name, candidates) == expected


@pytest.mark.parametrize(
    ("name", "other", "expected"),
    [
        ("/chater", "/chatter", "typo"),
        ("/base_waypoint", "/base_waypoints", "typo"),
        ("/cmdvel", "/cmd_vel", "typo"),
        ("/base/reset_odom", "/base/reset_odometry", "typo"),
        ("/robot/scan_row", "/robot/scan_raw", "typo"),
        ("/scan", "/narrow_scan", "words"),
        ("/imu/data", "/imu_filtered/data", "words"),
        ("/left_camera/image_raw", "/camera/left/image_raw", "words"),
        ("/teleop_cmd_vel", "/tb1/teleop_cmd_vel", "words"),
        ("/camera1/image", "/camera2/image", None),
        ("/joint_x", "/joint_y", None),
        ("/odom_in", "/odom_out", None),
        ("/left", "/right", None),
        ("/cloud", "/scan", None),
        ("/scan", "/scan", None),
    ],
)
def test_likeness(name: str, other: str, expected: str | None) -> None:
    found = likeness(name, other)
    assert (found[0] if found else None) == expected


graph_names = st.lists(st.from_regex(r"[a-z][a-z0-9_]{0,6}", fullmatch=True), min_size=1, max_size=3).map(
    lambda parts: "/" + "/".join(parts)
)


@settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])  # the machine may be busy
@given(graph_names, graph_names)
def test_likeness_is_symmetric(name: str, other: str) -> None:
    assert likeness(name, other) == likeness(other, name)


@pytest.mark.parametrize(
    ("name", "other", "expected"),
    [
        ("/robot_base_controller/odom", "/robot_xl_base_controller/odom", True),
        ("/ns/arm_controller/state", "/ns/left_arm_controller/state", True),
        ("/camera/image", "/front_camera/image", False),
        ("/laser/base_scan", "/laser/base_scan_filtered", False),
        ("/robot_base_controller/odom", "/robot_xl_base_controller/odometry", False),
        ("/robot_base_controller/odom", "/base_robot_xl_controller/odom", False),
        ("/robot_base_controller/odom", "/ns/robot_base_controller/odom", False),
    ],
)
def test_a_namespace_of_a_word_more(name: str, other: str, expected: bool) -> None:
    assert is_word_more(name, other) == is_word_more(other, name) == expected
