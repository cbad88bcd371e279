"""The systems of a textbook chapter on ROS 2 launch files (fixtures/ros2/chapter): nothing is built, no ROS is needed.

Each is what the chapter says, in every format, nothing is complained of, and one mistake in it is.
"""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.workspace.not_run import not_run
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace

CHAPTER = Path(__file__).parents[2] / "fixtures" / "ros2" / "chapter"
NODES = {
    "single_node/launch/single": {"/talker": {}},
    "talker_listener/launch/pair": {"/talker": {}, "/listener": {}},
    "yaml_parameters/launch/parameters": {"/talker": {"message": "good morning", "rate": 5.0}, "/listener": {}},
    "two_robots/launch/robots": {"/robot1/driver": {}, "/robot1/pilot": {}, "/robot2/driver": {}, "/robot2/pilot": {}},
    "topic_remapping/launch/remap": {"/talker": {}, "/listener": {}},
    "sub_launch/launch/system": {"/talker": {"message": "good evening"}, "/listener": {}},
    "configurable_chatter/launch/chatter": {"/talker": {"message": "slow", "rate": 0.5}, "/listener": {}},
    "dual_robot/launch/robots": {
        "/robot1/driver": {"max_speed": 1.0},
        "/robot1/pilot": {"speed": 0.1},
        "/robot2/driver": {"max_speed": 2.0},
        "/robot2/pilot": {"speed": 0.2},
    },
    "lifecycle/launch/camera": {
        "/camera": {},
        "/lifecycle_manager": {"autostart": True, "node_names": ["camera"]},
    },
}
CHATTER = {"/chatter": (["/talker"], ["/listener"])}
ROBOTS = {f"/{robot}/cmd_vel": ([f"/{robot}/pilot"], [f"/{robot}/driver"]) for robot in ("robot1", "robot2")}
TOPICS = {
    "single_node/launch/single": {"/chatter": (["/talker"], [])},
    "talker_listener/launch/pair": CHATTER,
    "yaml_parameters/launch/parameters": CHATTER,
    "two_robots/launch/robots": ROBOTS,
    "topic_remapping/launch/remap": {"/conversation": (["/talker"], ["/listener"])},
    "sub_launch/launch/system": CHATTER,
    "configurable_chatter/launch/chatter": CHATTER,
    "dual_robot/launch/robots": ROBOTS,
    "lifecycle/launch/camera": {"/image_info": (["/camera"], [])},
}
BROKEN = [
    ("single_node/launch/single", "exec", "talker", "talkr", "PKG002"),
    ("talker_listener/launch/pair", "name", "listener", "talker", "LCH016"),
    ("yaml_parameters/launch/parameters", "from", "config/talker.yaml", "config/taker.yaml", "PRM002"),
    ("yaml_parameters/config/talker.yaml", "", "talker:", "talkr:", "PRM011"),
    ("yaml_parameters/config/talker.yaml", "", "message:", "mesage:", "PRM013"),
    ("two_robots/two_robots/pilot.py", "", "'cmd_vel'", "'/cmd_vel'", "TOP001"),
    ("topic_remapping/launch/remap", "to", "/conversation", "/conversatoin", "TOP001"),
    ("sub_launch/launch/system", "name", "message", "mesage", "ARG004"),
    ("configurable_chatter/launch/chatter", "default", "slow", "slwo", "ARG009"),
    ("dual_robot/launch/robots", "value", "robot2", "robot3", "PRM002"),
    ("lifecycle/launch/camera", "", "[camera]", "[camra]", "LCH035"),
]


def analysed(folder: Path, launch: Path) -> Analysis:
    """As far as sources tell: nothing is run."""
    workspace = Workspace(detect_environment(str(folder), {}), Sources(), str(folder))
    analysis = workspace.static(str(launch), {})
    return workspace.with_interfaces(analysis, [not_run(node, "a test") for node in analysis.tree.nodes], "a test")


@pytest.mark.parametrize("suffix", [".launch.xml", ".launch.yaml"])
@pytest.mark.parametrize("system", NODES)
def test_the_system_is_as_the_chapter_says(system: str, suffix: str) -> None:
    analysis = analysed(CHAPTER, CHAPTER / (system + suffix))
    nodes = {node.name: {param.name: param.value for param in node.params} for node in analysis.tree.nodes}
    assert nodes == NODES[system]
    assert analysis.graph is not None
    topics: Mapping[str, tuple[list[str], list[str]]] = {
        name: (sorted(end.node.name for end in channel.offers), sorted(end.node.name for end in channel.wants))
        for name, channel in analysis.graph.topics.items()
        if not all(end.endpoint.builtin for end in (*channel.offers, *channel.wants))
    }
    assert topics == TOPICS[system]
    assert [f.message for f in analysis.findings if f.severity in ("error", "warning")] == []


@pytest.mark.parametrize("suffix", [".launch.xml", ".launch.yaml"])
@pytest.mark.parametrize(("file", "where", "right", "wrong", "rule"), BROKEN, ids=lambda value: str(value))
def test_a_mistake_in_it_is_found(
    file: str, where: str, right: str, wrong: str, rule: str, suffix: str, tmp_path: Path
) -> None:
    shutil.copytree(CHAPTER, tmp_path, dirs_exist_ok=True)
    system = next(name for name in NODES if name.partition("/")[0] == file.partition("/")[0])
    launch = tmp_path / (system + suffix)
    broken = launch if file == system else tmp_path / file
    text = broken.read_text()
    marks = {".xml": f'{where}="', ".yaml": f"{where}: "}
    # The last place of the attribute that has the text.
    start = text.rindex(marks[broken.suffix]) if where and right in text[text.rindex(marks[broken.suffix]) :] else 0
    at = text.index(right, start)
    broken.write_text(text[:at] + wrong + text[at + len(right) :])
    assert rule in [finding.rule for finding in analysed(tmp_path, launch).findings]
