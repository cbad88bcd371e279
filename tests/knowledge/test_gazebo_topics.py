"""Which topics Gazebo's sensors and plugins have."""

import re

import pytest
from preflight_analysis.knowledge.conversions import gazebo_types
from preflight_analysis.knowledge.gazebo import TopicForm, gazebo_topics, is_of_classic, plugin_name

_NOT_BRIDGED = frozenset({"*", "SerializedStepMap", "Scene", "UInt32_V", "Wind", "WorldStatistics", "AirSpeed"})


def _forms() -> list[TopicForm]:
    known = gazebo_topics()
    sensors = [form for each in known.sensors.values() for form in each.topics]
    return [*sensors, *known.world, *(form for forms in known.plugins.values() for form in forms)]


@pytest.mark.parametrize(
    ("filename", "name"),
    [
        ("gz-sim-diff-drive-system", "diff-drive"),
        ("libgz-sim-diff-drive-system.so", "diff-drive"),
        ("gz-sim8-imu-system", "imu"),
        ("libignition-gazebo6-sensors-system.so", "sensors"),
        ("libgz_ros2_control-system.so", "gz_ros2_control"),
        ("libmine.so", "mine"),
        ("", ""),
    ],
)
def test_the_name_of_a_plugin(filename: str, name: str) -> None:
    assert plugin_name(filename) == name


def test_plugins_of_classic() -> None:
    assert is_of_classic("libgazebo_ros_diff_drive.so")
    assert not is_of_classic("gz-sim-diff-drive-system")


def test_types_are_those_of_gazebo() -> None:
    bridged = {name for names in gazebo_types().values() for name in names}
    assert {form.type for form in _forms()} - _NOT_BRIDGED <= bridged


def test_each_form_is_whole() -> None:
    for form in _forms():
        assert form.names
        assert all(re.fullmatch(r"[\w{}/*]+", name) for name in form.names)


def test_the_systems_of_sensors_are_known() -> None:
    known = gazebo_topics()
    assert {each.system for each in known.sensors.values()} <= known.plugins.keys()
