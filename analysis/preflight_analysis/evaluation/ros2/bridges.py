"""What the launch hands to bridges between ROS and Gazebo (`ros_gz_bridge`): arguments and configuration files.

https://docs.ros.org/en/jazzy/p/ros_gz_bridge/; how an argument is taken apart, and what is refused: `main` in
src/parameter_bridge.cpp of gazebosim/ros_gz, the same in humble 5cc92f80, jazzy 739cb42a and ros2 a4d00a90.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import yaml

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, compose_fast, span_of
from preflight_analysis.evaluation.ros2.unknown_text import is_unknown
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.evaluation.words import beside_ros, words_of
from preflight_analysis.incremental.derived import derived

if TYPE_CHECKING:
    from preflight_analysis.evaluation.ros2.state import State

PACKAGES = ("ros_gz_bridge", "ros_ign_bridge")
_CONFIG = "config_file"
_PROGRAM = "parameter_bridge"
_DIRECTIONS = "@[]"
"""In the order in which they are looked for: both ways, to ROS, to Gazebo."""
_OF_SUBSTITUTION = frozenset("$()")


@dataclass(frozen=True, slots=True)
class Argument:
    """One argument of a bridge. `direction` is `@`, `[` or `]`, empty where it has none. `refused` says why the bridge
    does not take it, in words that follow the argument; `ends`: it then exits, with all its topics."""

    word: str
    topic: str = ""
    ros: str = ""
    direction: str = ""
    gazebo: str = ""
    refused: str = ""
    ends: bool = False

    @property
    def is_service(self) -> bool:
        """Whether it names a service instead of a topic."""
        return "/srv/" in self.ros


@dataclass(frozen=True, slots=True)
class Row:
    """One entry of a bridge's file: its scalars by their keys with their places, and the places of all keys. `is_map`:
    whether it has keys at all."""

    values: Mapping[str, tuple[str, Span]]
    keys: Mapping[str, Span]
    span: Span
    is_map: bool = True

    @property
    def ros_topic(self) -> str | None:
        """The key that has the name on the side of ROS, as the bridge takes it."""
        return next((key for key in _ROS_NAMES if key in self.values and self.values[key][0]), None)


_ROS_NAMES = ("topic_name", "ros_topic_name", "gz_topic_name", "ign_topic_name")


@derived
def rows_of(document: Document) -> tuple[Row, ...]:
    """The entries of a file of a bridge; ask through `document.once`."""
    root = root_of(document)
    return tuple(map(_row, root.value)) if isinstance(root, yaml.SequenceNode) else ()


def _row(node: yaml.Node) -> Row:
    pairs = node.value if isinstance(node, yaml.MappingNode) else ()
    named = [(key, value) for key, value in pairs if isinstance(key, yaml.ScalarNode)]
    values = {key.value: (value.value, span_of(value)) for key, value in named if isinstance(value, yaml.ScalarNode)}
    keys = {key.value: span_of(key) for key, _ in named}
    return Row(values, keys, span_of(pairs[0][0] if pairs else node), isinstance(node, yaml.MappingNode))


@derived
def root_of(document: Document) -> yaml.Node | None:
    """What a file of a bridge has; None where that is nothing, or no YAML."""
    try:
        return compose_fast(document.text)
    except CONSTRUCTION_ERRORS:
        return None


def arguments_of(node: LaunchNode) -> Iterator[Argument]:
    """Those of a bridge beside the ones that are for ROS, as far as they are known; none of other nodes."""
    if not is_bridge(node) or node.executable != _PROGRAM:
        return
    whole = not node.unknowns and "$(" not in node.args
    for word in beside_ros(words_of(node.args)):
        given = parse_argument(word)
        # A substitution that is not known may have blanks in it: its pieces are no arguments.
        if whole or not (given.refused or is_unknown(word) or _OF_SUBSTITUTION.intersection(word)):
            yield given


def parse_argument(word: str) -> Argument:
    """The argument, taken apart as the bridge does."""
    topic, sign, rest = word.partition("@")
    if not sign or not topic:
        return Argument(word, refused="is not TOPIC@ROS_TYPE@GZ_TYPE", ends=True)
    # A sign in the first place is none, as the type of ROS would be empty.
    direction = next((each for each in _DIRECTIONS if rest.find(each) > 0), "")
    ros, _, gazebo = rest.partition(direction) if direction else (rest, "", "")
    found = Argument(word, topic, ros, direction, gazebo)
    refused = _refused(found)
    return Argument(word, topic, ros, direction, gazebo, refused, bool(direction)) if refused else found


def _refused(given: Argument) -> str:
    if given.is_service:
        if given.direction in ("[", "]"):
            return f"separates the types of a service by '{given.direction}' instead of '@'"
        request, sign, _ = given.gazebo.partition("@")
        return "names one type of Gazebo, a service has two" if given.direction and not (request and sign) else ""
    if not given.direction:
        return "names no type of Gazebo"
    if not given.gazebo:
        return f"names no type of Gazebo after '{given.direction}'"
    return "has more than two types" if "@" in given.gazebo else ""


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
