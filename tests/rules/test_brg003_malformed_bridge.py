"""BRG003: what a bridge is given and refuses: an argument, or an entry of its file."""

from pathlib import Path

import pytest
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.registry import run_rules
from support import package_elsewhere

_ROS, _GZ = "ros_type_name", "gz_type_name"
_TYPES = f"{_ROS}: std_msgs/msg/String, {_GZ}: gz.msgs.StringMsg"


_FILE = "--ros-args -p config_file:=$(dirname)/bridge.yaml"


def found_in(folder: Path, row: str, args: str = _FILE, distro: str | None = None) -> list[Finding]:
    text = f'<launch><node pkg="ros_gz_bridge" exec="parameter_bridge" args="{args}"/></launch>'
    analysis = package_elsewhere.analysed(folder, text, "a.launch.xml", distro, **{"bridge.yaml": row})
    return [each for each in run_rules(analysis.context) if each.rule == "BRG003"]


@pytest.mark.parametrize(
    ("row", "said", "at"),
    [
        (f"- {{topic_name: a, {_TYPES}, direction: ROS_TO_GS}}", "'ROS_TO_GS' is not a direction", "ROS_TO_GS"),
        ("- {topic_name: a, ros_type_name: std_msgs/msg/String}", "'gz_type_name' is missing", "topic_name"),
        (f"- {{topic_name: a, gz_topic_name: b, {_TYPES}}}", "'gz_topic_name' excludes 'topic_name'", "b"),
        (f"- {{ros_topic: a, {_TYPES}}}", "the entry names no topic", "ros_topic"),
        (f"- {{topic_name: /arm/0/cmd, {_TYPES}}}", "'/arm/0/cmd' is a topic name that ROS refuses", "/arm/0/cmd"),
        (f"- {{topic_name: my-robot, {_TYPES}}}", "'my-robot' is a topic name that ROS refuses", "my-robot"),
        ("- scan", "an entry of a bridge must have keys", "scan"),
        (f"bridges: [{{topic_name: a, {_TYPES}}}]", "the file of the bridge must be a list", "bridges"),
    ],
)
def test_what_the_bridge_refuses(tmp_path: Path, row: str, said: str, at: str) -> None:
    (found,) = found_in(tmp_path, row)
    assert said in found.message
    assert row[found.location.span.start : found.location.span.end] == at


def test_a_near_direction_is_the_fix(tmp_path: Path) -> None:
    (found,) = found_in(tmp_path, f"- {{topic_name: a, {_TYPES}, direction: ROS_TO_GS}}")
    assert found.fixes[0].edits[0].text == "ROS_TO_GZ"


@pytest.mark.parametrize(
    ("row", "wrong", "meant"),
    [
        ("{topic_name: a, ros_type: std_msgs/msg/String, gz_type_name: gz.msgs.StringMsg}", "ros_type", _ROS),
        (f"{{topic_name: a, {_TYPES}, diretion: GZ_TO_ROS}}", "diretion", "direction"),
    ],
)
def test_a_key_that_was_meant(tmp_path: Path, row: str, wrong: str, meant: str) -> None:
    (found,) = found_in(tmp_path, f"- {row}")
    assert found.location.span.end - found.location.span.start == len(wrong)
    assert found.fixes[0].edits[0].text == meant


def test_old_keys_are_gone_since_jazzy(tmp_path: Path) -> None:
    row = "- {topic_name: a, ros_type_name: std_msgs/msg/String, ign_type_name: ignition.msgs.StringMsg}"
    (found,) = found_in(tmp_path, row, distro="jazzy")
    assert (found.message.partition(":")[0], found.fixes[0].edits[0].text) == ("'gz_type_name' is missing", _GZ)


@pytest.mark.parametrize(
    ("argument", "said", "severity"),
    [
        ("scan", "is not TOPIC@ROS_TYPE@GZ_TYPE: parameter_bridge exits", "error"),
        ("@std_msgs/msg/String@gz.msgs.StringMsg", "is not TOPIC@ROS_TYPE@GZ_TYPE: parameter_bridge exits", "error"),
        ("/a@std_msgs/msg/String[", "names no type of Gazebo after '[': parameter_bridge exits", "error"),
        ("/a@std_msgs/msg/String", "names no type of Gazebo: nothing passes", "warning"),
        ("/a@std_msgs/msg/String@gz.msgs.StringMsg@b", "has more than two types: parameter_bridge exits", "error"),
        ("/s@a/srv/B[gz.msgs.C", "separates the types of a service by '[' instead of '@': parameter", "error"),
        ("/s@a/srv/B@gz.msgs.C", "names one type of Gazebo, a service has two: parameter_bridge exits", "error"),
        ("/model//scan@std_msgs/msg/String@gz.msgs.StringMsg", "has a topic name that ROS refuses: param", "info"),
        ("/arm/0/cmd@std_msgs/msg/String]gz.msgs.StringMsg", "has a topic name that ROS refuses: param", "error"),
        ("my-robot@std_msgs/msg/String@gz.msgs.StringMsg", "has a topic name that ROS refuses: param", "error"),
    ],
)
def test_arguments_that_it_refuses(tmp_path: Path, argument: str, said: str, severity: str) -> None:
    (found,) = found_in(tmp_path, "", argument)
    assert said in found.message
    assert found.severity == severity


@pytest.mark.silent
@pytest.mark.parametrize(
    "args",
    [
        "/a1/b_0@std_msgs/msg/String@gz.msgs.StringMsg b@std_msgs/msg/String[gz.msgs.StringMsg",
        "/s@a/srv/B /t@a/srv/B@gz.msgs.C@gz.msgs.D --ros-args -r a:=b -- c@std_msgs/msg/String]gz.msgs.StringMsg",
        "--ros-args -p config_file:=/nowhere/bridge.yaml",
        "/world/$(var name)/scan@std_msgs/msg/String@gz.msgs.StringMsg /a@std_msgs/msg/String[gz.msgs.StringMsg",
        "/world/$(command 'echo $(var name)')/scan@std_msgs/msg/String@gz.msgs.StringMsg",
    ],
)
def test_arguments_that_it_takes(tmp_path: Path, args: str) -> None:
    assert not found_in(tmp_path, "", args)


@pytest.mark.silent
@pytest.mark.parametrize(
    "row",
    [
        f"- {{ros_topic_name: a, gz_topic_name: b, {_TYPES}, direction: GZ_TO_ROS}}",
        f"- {{topic_name: a, {_TYPES}, lazy: true}}",
        f"- {{ros_topic_name: a, {_TYPES}, qos_profile: SENSOR_DATA}}",
        "- {service_name: s, ros_type_name: a/srv/B, gz_req_type_name: gz.msgs.C, gz_rep_type_name: gz.msgs.D}",
        "- {topic_name: a, ros_type_name: std_msgs/msg/String, ign_type_name: ignition.msgs.StringMsg}",
        "[",
    ],
)
def test_what_it_takes(tmp_path: Path, row: str) -> None:
    assert not found_in(tmp_path, row)
