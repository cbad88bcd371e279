"""Hover on what a bridge to Gazebo is given."""

from __future__ import annotations

from pathlib import Path

from preflight_analysis.queries.hover import hover
from support import package_elsewhere

_NODE = '<node pkg="ros_gz_bridge" exec="parameter_bridge" name="bridge" args="{}"/>'
_TELEOP = '<node pkg="teleop_twist_joy" exec="teleop_node" name="teleop"/>'


def hovered(folder: Path, args: str, at: str, file: str = "a.launch.xml", **files: str) -> str | None:
    text = f"<launch>{_NODE.format(args)}{_TELEOP}</launch>"
    analysis = package_elsewhere.analysed(folder, text, "a.launch.xml", "jazzy", **files)
    path = str(folder / "ws" / "src" / "robot" / file)
    found = hover([analysis], path, {"a.launch.xml": text, **files}[file].index(at))
    return found.markdown if found is not None else None


def test_an_argument(tmp_path: Path) -> None:
    args = "/a@std_msgs/msg/String@gz.msgs.StringMsg /cmd_vel@geometry_msgs/msg/Twist]gz.msgs.Twist"
    assert hovered(tmp_path, args, "Twist]") == (
        "Bridge from ROS to Gazebo by `/bridge`\n\n- ROS: `/cmd_vel`, `geometry_msgs/msg/Twist`\n"
        "- Gazebo: `/cmd_vel`, `gz.msgs.Twist`\n- Publishers in ROS: `/teleop`"
    )


def test_an_entry(tmp_path: Path) -> None:
    row = "- ros_topic_name: scan\n  gz_topic_name: /lidar\n  ros_type_name: sensor_msgs/msg/LaserScan\n"
    row += "  gz_type_name: gz.msgs.LaserScan\n  direction: GZ_TO_ROS\n"
    args = "--ros-args -p config_file:=$(dirname)/bridge.yaml"
    for at in ("gz_type_name", "GZ_TO_ROS"):
        found = hovered(tmp_path, args, at, "bridge.yaml", **{"bridge.yaml": row})
        assert found == (
            "Bridge from Gazebo to ROS by `/bridge`\n\n- ROS: `scan`, `sensor_msgs/msg/LaserScan`\n"
            "- Gazebo: `/lidar`, `gz.msgs.LaserScan`\n- Subscribers in ROS: none known"
        )


def test_other_places_have_their_own(tmp_path: Path) -> None:
    found = hovered(tmp_path, "/a@std_msgs/msg/String@gz.msgs.StringMsg", "teleop_node")
    assert found is not None
    assert "Bridge" not in found
