"""The systems of a textbook chapter on ROS 2 launch files (fixtures/ros2/chapter), none of which is built.

Each is what the chapter says, in every format, from its sources alone and by running its nodes with a real rclpy;
nothing is complained of, and one mistake in it is.
"""

from __future__ import annotations

import os
import shutil
import threading
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.commands import CommandCache, CommandRunner
from preflight_analysis.tracing.trace import Tracer
from preflight_analysis.workspace.commands import CommandResults
from preflight_analysis.workspace.not_run import not_run
from preflight_analysis.workspace.resolve_commands import Resolving, resolve_commands
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace
from support.ros2_harness import ros2_prefix

pytestmark = pytest.mark.ros

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
    "lifecycle/launch/autostart": {"/camera": {}},
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
    "lifecycle/launch/camera": {
        "/image_info": (["/camera"], []),
        "/diagnostics": (["/lifecycle_manager"], []),  # by the catalogue
    },
    "lifecycle/launch/autostart": {"/image_info": (["/camera"], [])},
}
SUFFIXES = (".launch.xml", ".launch.yaml", ".launch.py")
OPEN_ENDED = ("single_node", "lifecycle")
"""Systems that publish for somebody outside: a hint says so."""
MARKS = {
    "exec": "executable='",
    "name": "name='",
    "default": "default_value='",
    "value": "'robot': '",
    "to": "remappings=",
    "from": "config",
    "autostart": "autostart=",
}
"""How Python writes what an attribute of XML is."""
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
    ("lifecycle/launch/camera", "@node_names", "camera", "camra", "LCH044"),
    ("lifecycle/launch/autostart", "autostart", "true", "0", "LCH035"),
]


def settled_in(folder: Path, launch: Path, cache: Path, variables: Mapping[str, str]) -> tuple[Workspace, Analysis]:
    """The launch file; one in Python was run for it."""
    environment = detect_environment(str(folder), variables)
    results = CommandResults(lambda: None)
    workspace = Workspace(environment, Sources(), str(folder), results)
    runner = CommandRunner(environment, str(folder), CommandCache(cache))
    return workspace, resolve_commands(workspace, str(launch), {}, Resolving(results, runner))


def analysed(folder: Path, launch: Path, cache: Path) -> Analysis:
    """As far as sources tell: no node is run."""
    workspace, analysis = settled_in(folder, launch, cache, {"PATH": "/usr/bin:/bin"})
    return workspace.with_interfaces(analysis, [not_run(node, "a test") for node in analysis.tree.nodes], "a test")


def traced(folder: Path, launch: Path, cache: Path) -> Analysis:
    """With its nodes run."""
    variables = {"PATH": f"{ros2_prefix() / 'bin'}:/usr/bin:/bin", "HOME": os.environ["HOME"]}
    workspace, analysis = settled_in(folder, launch, cache / "commands", variables)
    tracer = Tracer(workspace.environment, TraceCache(cache / "traces"))
    interfaces = []
    for request in workspace.requests(analysis):
        assert request is not None
        interfaces.append(tracer.trace(request, threading.Event()))
    return workspace.with_interfaces(analysis, interfaces, None)


def nodes_of(analysis: Analysis) -> dict[str, dict[str, Any]]:
    """The nodes with their parameters."""
    return {node.name: {param.name: param.value for param in node.params} for node in analysis.tree.nodes}


def topics_of(analysis: Analysis) -> dict[str, tuple[list[str], list[str]]]:
    """Who publishes and who subscribes, but for what each node has by itself."""
    assert analysis.graph is not None
    return {
        name: (sorted(end.node.name for end in channel.providers), sorted(end.node.name for end in channel.consumers))
        for name, channel in analysis.graph.topics.items()
        if not all(end.endpoint.builtin for end in (*channel.providers, *channel.consumers))
    }


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize("system", NODES)
def test_the_system_is_as_the_chapter_says(system: str, suffix: str, tmp_path: Path) -> None:
    analysis = analysed(CHAPTER, CHAPTER / (system + suffix), tmp_path)
    assert nodes_of(analysis) == NODES[system]
    assert topics_of(analysis) == TOPICS[system]
    assert [f.message for f in analysis.findings if f.severity in ("error", "warning")] == []


@pytest.mark.parametrize("system", [system for system in NODES if system != "lifecycle/launch/camera"])
def test_the_system_runs_as_the_chapter_says(system: str, tmp_path: Path) -> None:
    for suffix in SUFFIXES:
        analysis = traced(CHAPTER, CHAPTER / (system + suffix), tmp_path)
        assert analysis.graph is not None
        outcomes = [(found.source, found.outcome.status) for found in analysis.graph.interfaces]
        assert outcomes == [("trace", "spinning")] * len(NODES[system]), suffix
        assert nodes_of(analysis) == NODES[system]
        assert topics_of(analysis) == TOPICS[system]
        said = {finding.rule: finding.severity for finding in analysis.findings}
        assert said == ({"TOP002": "hint"} if system.startswith(OPEN_ENDED) else {}), suffix


def test_no_robot_hears_the_other(tmp_path: Path) -> None:
    for suffix in SUFFIXES:
        graph = traced(CHAPTER, CHAPTER / f"dual_robot/launch/robots{suffix}", tmp_path).graph
        assert graph is not None
        for channels in (graph.topics, graph.services, graph.actions):
            for channel in channels.values():
                ends = [end for end in (*channel.providers, *channel.consumers) if not end.endpoint.builtin]
                assert len({end.node.name.split("/")[1] for end in ends}) <= 1, channel


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize(("file", "where", "right", "wrong", "rule"), BROKEN, ids=lambda value: str(value))
def test_a_mistake_in_it_is_found(
    file: str, where: str, right: str, wrong: str, rule: str, suffix: str, tmp_path: Path
) -> None:
    shutil.copytree(CHAPTER, tmp_path, dirs_exist_ok=True)
    system = file if file in NODES else next(name for name in NODES if name.split("/")[0] == file.split("/")[0])
    launch = tmp_path / (system + suffix)
    broken = launch if file == system else tmp_path / file
    text = broken.read_text()
    marks = {".xml": f'{where}="', ".yaml": f"{where}: ", ".py": MARKS.get(where, "")}
    mark = where[1:] if where.startswith("@") else marks[broken.suffix]
    right = right.capitalize() if broken.suffix == ".py" and right == "true" else right
    # The last place of the attribute that has the text.
    start = text.rindex(mark) if where and right in text[text.rindex(mark) :] else 0
    at = text.index(right, start)
    broken.write_text(text[:at] + wrong + text[at + len(right) :])
    assert rule in [finding.rule for finding in analysed(tmp_path, launch, tmp_path / "cache").findings]
