"""The robot descriptions that a launch hands to its nodes."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import compress, repeat
from operator import contains
from typing import Protocol

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.partial_text import is_whole
from preflight_analysis.evaluation.tree import CommandValue, LaunchNode, LaunchTree, Param
from preflight_analysis.incremental.derived import derived
from preflight_analysis.robot.model import Description
from preflight_analysis.robot.parse import parse_description
from preflight_analysis.robot.semantic import Semantic, parse_semantic

DESCRIPTION = "robot_description"
"""The name of the parameter that robot_state_publisher, controller managers and planners read."""
SEMANTIC = "robot_description_semantic"
"""The name of the parameter that MoveIt reads for the groups of a robot."""


class Described(Protocol):
    """A text that describes a robot, and the first parameter that has it."""

    @property
    def text(self) -> str:
        """The text."""

    @property
    def param(self) -> Param:
        """The parameter."""


@dataclass(frozen=True, slots=True)
class Robot:
    """A robot of a launch. `param` is the first parameter that has its description; `nodes` are those that get it
    (ROS 2) or below whose namespace it is (ROS 1: `/arm/robot_description` is for the nodes in `/arm`)."""

    description: Description
    text: str
    param: Param
    nodes: tuple[LaunchNode, ...]


@dataclass(frozen=True, slots=True)
class SemanticRobot:
    """What MoveIt is given of a robot beside its description, as `Robot` has that."""

    semantic: Semantic
    text: str
    param: Param
    nodes: tuple[LaunchNode, ...]


def robots_of(tree: LaunchTree) -> tuple[Robot, ...]:
    """The descriptions that the launch has, each once; the same objects each time. One whose command was not run is not
    there (`unread_of`), nor is what is no URDF."""
    return _robots(tree)


def unread_of(tree: LaunchTree) -> tuple[Param, ...]:
    """The parameters that hold a description which is not known, or not as a whole."""
    return _unread(tree)


def robot_of(tree: LaunchTree, node: LaunchNode) -> Robot | None:
    """The robot whose description a node gets, else the one of its namespace, else the only one of the launch."""
    robots = [robot for robot in robots_of(tree) if robot.description.is_whole]
    mine = [robot for robot in robots if any(each is node for each in robot.nodes)]
    near = [robot for robot in robots if any(each.namespace == node.namespace for each in robot.nodes)]
    found = mine or near or robots
    return found[0] if len(found) == 1 else None


def semantics_of(tree: LaunchTree) -> tuple[SemanticRobot, ...]:
    """The semantic descriptions that the launch has, each once for the nodes that get it."""
    return _semantics(tree)


def given_robot(tree: LaunchTree, node: LaunchNode) -> Robot | None:
    """The robot whose description is for certain the one that a node of MoveIt works with: it gets it as a parameter,
    or all of the launch is known and there is one robot."""
    robots = [robot for robot in robots_of(tree) if robot.description.is_whole]
    mine = [robot for robot in robots if any(each is node for each in robot.nodes)]
    if not mine and tree.complete and not node.unknowns and not unread_of(tree):
        mine = robots
    return mine[0] if len(mine) == 1 else None


@derived
def _semantics(tree: LaunchTree) -> tuple[SemanticRobot, ...]:
    found: dict[str, SemanticRobot] = {}
    for param, nodes in _params(tree, SEMANTIC):
        semantic = parse_semantic(param.value) if isinstance(param.value, str) and is_whole(param.value) else None
        if semantic is None or not isinstance(param.value, str):
            continue
        known = found.get(param.value)
        before = known.nodes if known is not None else ()
        more = tuple(node for node in nodes if all(node is not each for each in before))
        first = known.param if known is not None else param
        found[param.value] = SemanticRobot(semantic, param.value, first, before + more)
    return tuple(found.values())


def _is_name(value: str) -> bool:
    """Whether a parameter has the name of the description's own one (`/arm/robot_description`, `arm_description`),
    which programs ask for that by."""
    return bool(value) and names.is_legal(value)


@derived
def _robots(tree: LaunchTree) -> tuple[Robot, ...]:
    found: dict[str, Robot] = {}
    for param, nodes in _params(tree, DESCRIPTION):
        if not isinstance(param.value, str) or _is_name(param.value):
            continue
        known = found.get(param.value)
        if known is None:
            found[param.value] = Robot(parse_description(param.value), param.value, param, nodes)
        else:
            more = tuple(node for node in nodes if all(node is not each for each in known.nodes))
            found[param.value] = Robot(known.description, known.text, known.param, known.nodes + more)
    return tuple(found.values())


@derived
def _unread(tree: LaunchTree) -> tuple[Param, ...]:
    raw = {id(robot.param) for robot in robots_of(tree) if robot.description.kind == "xacro" or robot.description.lacks}
    given = (param for param, _ in _params(tree, DESCRIPTION))
    return tuple(param for param in given if isinstance(param.value, CommandValue) or id(param) in raw)


@derived
def _params(tree: LaunchTree, wanted: str) -> tuple[tuple[Param, tuple[LaunchNode, ...]], ...]:
    return tuple(_those_of(tree, wanted))


def _those_of(tree: LaunchTree, wanted: str) -> Iterator[tuple[Param, tuple[LaunchNode, ...]]]:
    if tree.ros.own_parameters:
        for node in tree.nodes:
            for param in node.params:
                if param.name == wanted:
                    yield param, (node,)
        return
    for name in _names_of_descriptions(tree):
        if names.leaf(name) == wanted:
            space = names.parent(name)
            yield tree.params[name], tuple(node for node in tree.nodes if node.name.startswith(space))


@derived
def _names_of_descriptions(tree: LaunchTree) -> tuple[str, ...]:
    """The names of parameters that begin as that of a description: few of thousands."""
    return tuple(compress(tree.params, map(contains, tree.params, repeat(DESCRIPTION))))
