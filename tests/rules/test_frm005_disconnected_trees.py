"""FRM005: frames that a node uses together, in two trees that nothing joins."""

import pytest
from support.check import check
from support.frame_launch import below, fixture, robot, static

_SLAM = (
    '<node pkg="slam_toolbox" exec="async_slam_toolbox_node" name="slam"><param name="base_frame" value="{}"/></node>'
)
_LIDAR = '<node pkg="rplidar_ros" exec="rplidar_node" name="lidar"><param name="frame_id" value="{}"/></node>'
_PACKAGES = "".join(
    f"\n//- /{name}/package.xml\n<package><name>{name}</name></package>" for name in ("slam_toolbox", "rplidar_ros")
)
_DRIVER = '<node pkg="p" exec="driver" name="driver"/>'
_SCAN = "sensor_msgs/msg/LaserScan"
_ODOMETRY = {"frames": [["odom", "base_link"]]}
_SEEN = {
    "/lidar": {"publishers": {"scan": _SCAN}, "params": {"~frame_id": "laser"}},
    "/slam": {"subscribers": {"scan": _SCAN}, "params": {"~base_frame": "base_link"}},
}
_APART = robot(("base_link", "mast"))


def _said(tag: str, value: str, text: str) -> str:
    return f"{tag.format(value)}\n{below(tag.index('{}'), len(value), text)}"


def test_a_sensor_beside_the_robot() -> None:
    said = "warning[FRM005] frames 'odom' and 'laser' are in trees that nothing joins: /slam uses it (parameter 'odom"
    mount = static("s", "mount", "laser")
    nodes = "\n".join((_APART, mount, _DRIVER, _said(_LIDAR, "laser", said), _SLAM.format("base_link")))
    check(fixture(nodes, {**_SEEN, "/driver": _ODOMETRY}, _PACKAGES))


def test_where_another_launch_may_join_them() -> None:
    said = "info[FRM005] frames 'odom' and 'base_link' are in trees that nothing joins"
    nodes = f"{_APART}\n{_said(_SLAM, 'base_link', said)}"
    check(fixture(nodes, {"/slam": {"params": {"~base_frame": "base_link"}}}, _PACKAGES))


def test_what_one_call_needs() -> None:
    said = "info[FRM005] frames 'mount' and 'mast' are in trees that nothing joins: /driver uses it (lookupTransform in"
    uses = [[frame, "lookupTransform", True, False, "/p/d.cpp", line] for frame, line in (("mount", 3), ("mast", 3))]
    nodes = f"{_APART}\n{static('s', 'mount', 'laser')}\n{_DRIVER}\n{below(0, len(_DRIVER), said)}"
    check(fixture(nodes, {"/driver": {"frame_uses": uses}}))
    other = [uses[0], [*uses[1][:5], 4]]
    check(fixture(nodes.rpartition("\n")[0], {"/driver": {"frame_uses": other}}))


_EKF = '<node pkg="robot_localization" exec="ekf_node" name="ekf"><param name="base_link_frame" value="{}"/></node>'


@pytest.mark.parametrize(("more", "severity"), [("", "warning"), (f"{_DRIVER}\n", "info")])
def test_a_base_that_localization_publishes_and_the_robot_does_not_have(more: str, severity: str) -> None:
    said = f"{severity}[FRM005] frames 'base_footprint' and 'base_link' are in trees that nothing joins: /ekf (odom_fr"
    expected = below(_EKF.index("base_link_frame"), len("base_link_frame"), said)
    check(fixture(f"{_APART}\n{more}{_EKF.format('base_footprint')}\n{expected}", {}))


@pytest.mark.silent
@pytest.mark.parametrize(
    "nodes",
    [
        f"{static('s', 'base_footprint', 'base_link')}\n{_APART}\n{_EKF.format('base_footprint')}",
        f"{_APART}\n{_EKF.format('rear/base_link')}",
        _EKF.format("base_footprint"),
    ],
)
def test_a_base_of_the_robot(nodes: str) -> None:
    check(fixture(nodes, {}))


@pytest.mark.silent
@pytest.mark.parametrize(
    ("more", "seen"),
    [
        (static("m", "mast", "mount"), _ODOMETRY),
        # What the text of the driver does not tell may join them.
        ("", {"frames": [["odom", "base_link"], ["", "mount"]]}),
        ("", {"status": "not-run", "source": "none"}),
    ],
)
def test_what_is_joined_or_may_be(more: str, seen: dict[str, object]) -> None:
    # Nobody hears the sensor.
    mount, lidar = static("s", "mount", "laser"), _LIDAR.format("laser")
    seen_alone = {"/lidar": {"params": {"~frame_id": "laser"}}}
    check(fixture(f"{_APART}\n{mount}\n{lidar}", seen_alone, _PACKAGES))
    nodes = f"{_APART}\n{mount}\n{_DRIVER}\n{more}{lidar}\n{_SLAM.format('base_link')}"
    check(fixture(nodes, {**_SEEN, "/driver": seen}, _PACKAGES))
