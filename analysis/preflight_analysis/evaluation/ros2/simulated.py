"""Controller managers that run inside of a simulator: the robot description that is spawned there asks for them.

`gz_ros2_control`, `ign_ros2_control` and `gazebo_ros2_control` are plugins of Gazebo. The description gives them
parameter files, a namespace and remaps, and the launch file has no node for the manager.
https://control.ros.org/jazzy/doc/gz_ros2_control/doc/index.html,
https://github.com/ros-controls/gz_ros2_control/blob/jazzy/gz_ros2_control/src/gz_ros2_control_plugin.cpp (`Configure`)
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import NamedTuple
from xml.sax.saxutils import unescape

from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.xml import without_comments
from preflight_analysis.environment.model import Executable
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.files import without_dots
from preflight_analysis.evaluation.ros2.param_files import EVERY, read_param_file
from preflight_analysis.evaluation.ros2.params import Sources, of_file
from preflight_analysis.evaluation.ros2.spawners import MANAGER, SPAWN, asked_of, is_spawner
from preflight_analysis.evaluation.ros2.state import State
from preflight_analysis.evaluation.tree import LaunchNode, Param, ParamSource, Remap, Unknown

KIND = "simulated"
"""The `LaunchNode.kind` of a node that the simulator makes, not the launch."""
_DESCRIPTION = "robot_description"
_PUBLISHER = "robot_state_publisher"
_NAME = "controller_manager"
_PLUGIN = re.compile(r"\b(?:lib)?(?:gz|ign|gazebo)_ros2_control\b")
_KEPT = 64


class _Plugin(NamedTuple):
    """What a robot description says to the plugin."""

    name: str
    namespace: str
    files: tuple[str, ...]
    remaps: tuple[tuple[str, str], ...]


def simulated_managers(state: State) -> tuple[LaunchNode, ...]:
    """The managers that the robots of a launch have in the simulator that they are spawned in, each with its parameters
    as if the launch file gave them. `origin` and tag are those of what spawns the robot."""
    spawns = [node for node in state.nodes if (node.package, node.executable) in SPAWN]
    if not spawns:
        return ()
    described = [(node, text) for node in state.nodes if (text := _description(node)) is not None]
    published = [each for each in described if each[0].executable == _PUBLISHER]
    there = {node.name for node in state.nodes if (node.package, node.executable) == MANAGER}
    found: dict[str, LaunchNode] = {}
    for node, text in published or described:
        for plugin in plugins_in(text):
            name = manager_name(plugin)
            if name not in there and name not in found:
                found[name] = _manager(state, plugin, _spawn_of(node, spawns))
    return tuple(found.values())


def note_files_of_spawners(state: State) -> None:
    """Read the parameter files that spawners hand to controllers: what they say is the launch's."""
    for node in state.nodes:
        asked = asked_of(node) if is_spawner(node) else None
        for path in asked.files if asked is not None else ():
            state.read_text(path)


def _description(node: LaunchNode) -> str | None:
    value = next((param.value for param in node.params if param.name == _DESCRIPTION), None)
    return value if isinstance(value, str) and "_ros2_control" in value else None


def _spawn_of(publisher: LaunchNode, spawns: Sequence[LaunchNode]) -> LaunchNode:
    """What spawns the robot whose description a node publishes: what is in its namespace, else the first."""
    return next((each for each in spawns if each.namespace == publisher.namespace), spawns[0])


@lru_cache(maxsize=_KEPT)
def plugins_in(text: str) -> tuple[_Plugin, ...]:
    """The plugins that a robot description (URDF, SDF) has."""
    found = _elements(without_comments(text), "plugin")
    named = (_plugin(content) for head, content in found if _PLUGIN.search(head))
    return tuple(each for each in named if not any("${" in file for file in each.files))


def manager_name(plugin: _Plugin) -> str:
    """The full name of the manager that a plugin has."""
    return names.join(plugin.namespace, plugin.name)


def _plugin(content: str) -> _Plugin:
    ros = next((content for _, content in _elements(content, "ros")), "")
    namespace = next(_texts(ros, "namespace"), "")
    remaps = (each.partition(":=") for each in _texts(ros, "remapping"))
    return _Plugin(
        next(_texts(content, "controller_manager_name"), _NAME),
        f"/{namespace.strip('/')}",
        tuple(_texts(content, "parameters")),
        tuple((source, target) for source, sign, target in remaps if sign and source and target),
    )


def _texts(content: str, tag: str) -> Iterator[str]:
    """The texts of the elements of a name that are not empty."""
    texts = (unescape(text, {"&quot;": '"', "&apos;": "'"}).strip() for _, text in _elements(content, tag))
    return filter(None, texts)


def _elements(text: str, tag: str) -> Iterator[tuple[str, str]]:
    """Start tag and content of each element of a name, in time linear in the length; those within another one of the
    name are its content."""
    at = 0
    while (start := text.find(f"<{tag}", at)) >= 0 and (end := text.find(">", start)) >= 0:
        at = end + 1
        if text[start + 1 + len(tag)] not in " \t\r\n>" or text[end - 1] == "/":
            continue
        if (close := text.find(f"</{tag}", at)) < 0:
            return
        yield text[start:end], text[at:close]
        at = close


def _manager(state: State, plugin: _Plugin, spawn: LaunchNode) -> LaunchNode:
    full = manager_name(plugin)
    to, unknowns = Sources(full), []
    for each in plugin.files:
        path = without_dots(state.files, state.located(each)) or each
        found = state.read_text(path)
        if isinstance(found, Unreadable):
            unknowns.append(Unknown(path, found.reason, spawn.location))
        else:
            to.add(of_file(read_param_file(found), path, found.lines, spawn.origin, to))
    # The plugin sets it, and the manager hands it on to its controllers.
    to.add(ParamSource(None, (Param("use_sim_time", True, spawn.origin),), spawn.origin, (EVERY,), pushed=True))
    at = spawn.location
    return LaunchNode(
        full,
        plugin.namespace if plugin.namespace.endswith("/") else f"{plugin.namespace}/",
        *MANAGER,
        KIND,
        "",
        tuple(Remap(source, target, spawn.origin, at, at, True) for source, target in plugin.remaps),
        (),
        spawn.origin,
        spawn.tag,
        Executable(None),
        unknowns=tuple(unknowns),
        params=to.effective(),
        param_sources=tuple(to.found),
        deferred=spawn.deferred,
    )
