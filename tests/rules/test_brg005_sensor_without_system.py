"""BRG005: a bridge to a sensor of Gazebo that no plugin makes work."""

from pathlib import Path

import pytest
from support.gazebo_launch import WORLD, findings, row, sensor

_NAVSAT = row("/gps", "sensor_msgs/msg/NavSatFix NavSat", "GZ_TO_ROS")
_IMU = row("/imu", "sensor_msgs/msg/Imu IMU", "GZ_TO_ROS")
_PLUGIN = '<plugin filename="gz-sim-navsat-system" name="n"/>'


def test_a_world_without_the_system(tmp_path: Path) -> None:
    (found,) = findings(tmp_path, "BRG005", _NAVSAT, sensor("navsat", "<topic>gps</topic>"))
    assert found.message == "the sensor 's' publishes nothing on '/gps': 'gz-sim-navsat-system' is not loaded"
    assert (found.severity, found.confidence) == ("warning", "likely")


def test_a_world_without_plugins(tmp_path: Path) -> None:
    world = '<sdf version="1.9"><world name="w"/></sdf>'
    (found,) = findings(tmp_path, "BRG005", _IMU, sensor("imu", "<topic>imu</topic>"), world=world)
    assert "gz-sim-imu-system" in found.message


@pytest.mark.silent
@pytest.mark.parametrize(
    ("rows", "model"),
    [
        (_IMU, sensor("imu", "<topic>imu</topic>")),
        (_NAVSAT, sensor("navsat", "<topic>gps</topic>") + _PLUGIN),
        ("", sensor("navsat", "<topic>gps</topic>")),
    ],
)
def test_a_system_of_the_world_or_the_robot(rows: str, model: str, tmp_path: Path) -> None:
    assert not findings(tmp_path, "BRG005", rows, model)


@pytest.mark.silent
def test_what_is_not_known_may_load_it(tmp_path: Path) -> None:
    world = WORLD.replace("</world>", '<plugin filename="libmine.so" name="m"/></world>')
    assert not findings(tmp_path, "BRG005", _NAVSAT, sensor("navsat", "<topic>gps</topic>"), world=world)
