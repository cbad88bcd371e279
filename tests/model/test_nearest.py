"""Which names count as near."""

from collections.abc import Callable

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


SORTS = {
    "topic": ("/front/scan_raw", ["/front/imu", "/odom"]),
    "node": ("/robot/map_server", ["/robot/amcl", "/rviz"]),
    "parameter": ("max_velocity", ["rate", "base_frame"]),
    "file": ("front_camera.launch", ["drive.launch", "maps.launch"]),
    "argument": ("robot_name", ["rviz", "use_sim_time"]),
    "package": ("arm_bringup", ["leg_description", "nav2_amcl"]),
    "executable": ("lidar_driver", ["talker", "map_saver_cli"]),
    "frame": ("front/base_footprint", ["odom", "front/laser"]),
}
"""A name of each sort, and others beside it."""


def _of_leaf(name: str, change: Callable[[str], str]) -> str:
    above, _, leaf = name.rpartition("/")
    leaf, dot, suffix = leaf.partition(".")
    return f"{above}/{change(leaf)}{dot}{suffix}".removeprefix("" if "/" in name else "/")


def _words(leaf: str) -> list[str]:
    return leaf.split("_")


SLIPS: dict[str, Callable[[str], str]] = {
    "a letter is missing": lambda leaf: leaf[:2] + leaf[3:],
    "a letter too many": lambda leaf: leaf[:2] + leaf[1:],
    "two letters are swapped": lambda leaf: leaf[:2] + leaf[3] + leaf[2] + leaf[4:],
    "two letters": lambda leaf: leaf[:1] + leaf[2:-2] + leaf[-1:],
    "another order": lambda leaf: "_".join(reversed(_words(leaf))),
    "another order, in camel case": lambda leaf: "".join(word.capitalize() for word in reversed(_words(leaf))),
    "camel case": lambda leaf: "".join(word.capitalize() for word in _words(leaf)),
    "no underscore": lambda leaf: leaf.replace("_", ""),
    "dash": lambda leaf: leaf.replace("_", "-"),
    "plural": lambda leaf: f"{leaf}s",
    "plural of the first word": lambda leaf: "s_".join(_words(leaf)),
    "shortened": lambda leaf: "_".join(word[:3] for word in _words(leaf)),
    "a number": lambda leaf: f"{leaf}1",
}


@pytest.mark.parametrize("sort", SORTS)
@pytest.mark.parametrize("slip", SLIPS)
def test_each_slip_of_each_sort_of_name(slip: str, sort: str) -> None:
    name, others = SORTS[sort]
    written = _of_leaf(name, SLIPS[slip])
    assert written != name
    assert nearest(written, [*others, name]) == name


@pytest.mark.parametrize(
    ("written", "name"),
    [
        ("front/scan_raw", "/front/scan_raw"),
        ("/front/scan_raw/", "/front/scan_raw"),
        ("/scan_raw", "/front/scan_raw"),
        ("/robot/front/scan_raw", "/front/scan_raw"),
        ("/front/lidar/scan_raw", "/front/scan_raw"),
        ("/rear/scan_raw", "/front/scan_raw"),
        ("/camera_1/scan_raw", "/camera_2/scan_raw"),
        ("/base/max_velocity", "/drive/max_velocity"),
        ("base_footprint", "front/base_footprint"),
    ],
)
def test_slashes_levels_namespaces_and_numbers(written: str, name: str) -> None:
    others = ["/front/imu", "/odom", "/scan"]
    assert nearest(written, [*others, name]) == name
    assert nearest(name, [*others, written]) == written


@pytest.mark.parametrize(
    ("written", "candidates"),
    [
        ("/scan_raw", ["/front/scan_raw", "/rear/scan_raw"]),
        ("/left/rear/scan_raw", ["/front/upper/scan_raw"]),
        ("/scan_raw", ["/a/b/scan_raw"]),
        ("scan_raw", ["scan_filtered"]),
        ("name_of_robot", ["robot_name"]),
        ("s", ["t"]),
    ],
)
def test_what_is_no_slip(written: str, candidates: list[str]) -> None:
    assert nearest(written, candidates) is None


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
