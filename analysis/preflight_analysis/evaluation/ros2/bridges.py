"""The configuration files of bridges between ROS and Gazebo (`ros_gz_bridge`), which the launch hands to them.

https://docs.ros.org/en/jazzy/p/ros_gz_bridge/
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.evaluation.words import words_of

if TYPE_CHECKING:
    from preflight_analysis.evaluation.ros2.state import State

PACKAGES = ("ros_gz_bridge", "ros_ign_bridge")
_CONFIG = "config_file"


def is_bridge(node: LaunchNode) -> bool:
    """Whether it carries the topics of its command line or its configuration file."""
    return node.package in PACKAGES


def config_file_of(node: LaunchNode) -> str | None:
    """The path of the file, from a parameter or the command line (`-p config_file:=PATH`); None where there is none."""
    found = next((param.value for param in node.params if param.name == _CONFIG), None)
    for word in words_of(node.args):
        name, sign, value = word.partition(":=")
        if sign and name.rpartition(":")[2] == _CONFIG:
            found = value
    return found if isinstance(found, str) and found.startswith("/") else None


def note_files_of_bridges(state: State) -> None:
    """Read the files: what they say is the launch's."""
    for node in state.nodes:
        path = config_file_of(node) if is_bridge(node) else None
        if path is not None:
            state.read_text(state.located(path))
