"""BRG003: an entry in the file of a bridge that the bridge refuses."""

from pathlib import Path

import pytest
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.registry import run_rules
from support import package_elsewhere

_TYPES = "ros_type_name: std_msgs/msg/String, gz_type_name: gz.msgs.StringMsg"


def found_in(folder: Path, row: str) -> list[Finding]:
    args = "--ros-args -p config_file:=$(dirname)/bridge.yaml"
    text = f'<launch><node pkg="ros_gz_bridge" exec="parameter_bridge" args="{args}"/></launch>'
    analysis = package_elsewhere.analysed(folder, text, "a.launch.xml", **{"bridge.yaml": row})
    return [each for each in run_rules(analysis.context) if each.rule == "BRG003"]


@pytest.mark.parametrize(
    ("row", "said", "at"),
    [
        (f"- {{topic_name: a, {_TYPES}, direction: ROS_TO_GS}}", "'ROS_TO_GS' is not a direction", "ROS_TO_GS"),
        ("- {topic_name: a, ros_type_name: std_msgs/msg/String}", "'gz_type_name' is missing", "topic_name"),
        (f"- {{topic_name: a, gz_topic_name: b, {_TYPES}}}", "'gz_topic_name' excludes 'topic_name'", "b"),
    ],
)
def test_what_the_bridge_refuses(tmp_path: Path, row: str, said: str, at: str) -> None:
    (found,) = found_in(tmp_path, row)
    assert said in found.message
    assert row[found.location.span.start : found.location.span.end] == at


def test_a_near_direction_is_the_fix(tmp_path: Path) -> None:
    (found,) = found_in(tmp_path, f"- {{topic_name: a, {_TYPES}, direction: ROS_TO_GS}}")
    assert found.fixes[0].edits[0].text == "ROS_TO_GZ"


@pytest.mark.silent
@pytest.mark.parametrize(
    "row",
    [
        f"- {{ros_topic_name: a, gz_topic_name: b, {_TYPES}, direction: GZ_TO_ROS}}",
        f"- {{topic_name: a, {_TYPES}, lazy: true}}",
        "- {service_name: s, ros_type_name: a/srv/B, gz_req_type_name: gz.msgs.C, gz_rep_type_name: gz.msgs.D}",
        "- {topic_name: a, ros_type_name: std_msgs/msg/String, ign_type_name: ignition.msgs.StringMsg}",
        "- 3",
        "[",
    ],
)
def test_what_it_takes(tmp_path: Path, row: str) -> None:
    assert not found_in(tmp_path, row)
