"""Frames of a launch as plain data."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.incremental.derived import Remembering, derived
from preflight_analysis.robot.of_launch import Robot

How = Literal["urdf", "arguments", "run", "source", "knowledge", "gazebo"]
"""How a transform is known: from the joint of a robot description, the arguments of a static transform publisher, a run
of the node, its source, what is known of its package, or a plugin of Gazebo in the description."""
MOST_STEPS = 1000
"""From a frame up to its root."""


@dataclass(frozen=True, slots=True)
class Edge:
    """A transform from `parent` to `child`, names without a leading slash, that is broadcast in `space`: the namespace
    of its topics, "" where these are `/tf` and `/tf_static`. `node` broadcasts it; None for a joint whose robot
    description no node of the launch publishes. `sure`: it is known of this node in this version."""

    parent: str
    child: str
    static: bool
    how: How
    node: LaunchNode | None
    location: Location
    space: str = ""
    sure: bool = True
    guessed: bool = False
    """It is known by defaults alone: the file with the parameters of the node is not known."""
    detail: str = ""
    """The joint, the parameters, the plugin or the words in which it is known."""
    robot: Robot | None = None
    conditional: bool = False
    """In the source, only a condition that is not known leads there."""
    source_file: str = ""
    """Where in the node's source it is broadcast, line counted from 1."""
    source_line: int = 0
    likely: bool = False
    """Not sure, but known of the version that is used."""
    catalogued: str = ""
    """The package and its distribution, where the catalogue has the joint: `ur_description of jazzy`."""

    @property
    def doubt(self) -> str:
        """How far it is from sure, in a word for the user; empty where it is sure."""
        if self.sure:
            return ""
        return "likely" if self.likely or (self.how == "source" and not self.conditional) else "possible"

    @property
    def by(self) -> str:
        """Who broadcasts it, for the user."""
        if self.node is None:
            return "robot_description (no robot_state_publisher in this launch)"
        detail = f"{self.detail}, catalogue: {self.catalogued}" if self.catalogued else self.detail
        return f"{self.node.name} ({detail})" if detail else self.node.name


@dataclass(frozen=True, slots=True)
class Use:
    """A frame that a node names. `written` is as given, `frame` without a leading slash. `looked_up`: it asks for the
    transform, and does not only write the name into its messages. `what` says how: `parameter 'base_frame'`; `param` is
    that parameter, None for its default, or where no parameter names the frame."""

    frame: str
    written: str
    node: LaunchNode
    what: str
    param: Param | None = None
    space: str = ""
    looked_up: bool = True
    sure: bool = True
    call: str = ""
    """What of the node's source gets the frame, as of `FrameUse`; empty where it is known otherwise."""
    of_sensor: bool = False
    """Whether a sensor's messages have it."""
    robot: Robot | None = None
    """The one whose description has it, of a simulated sensor; the node is then one that gets the description."""
    tag: str = ""
    """Likewise the element in the description."""

    @property
    def does(self) -> str:
        """What the node does with the frame, for the user."""
        if not self.of_sensor:
            return f"{self.node.name} uses it ({self.what})"
        who = self.node.name if self.robot is None else "a simulated sensor"
        return f"{who} stamps its messages with it ({self.what})"

    @property
    def location(self) -> Location:
        """Where the parameter is set, else the node."""
        return self.param.place if self.param is not None else self.node.location


@dataclass(frozen=True, slots=True)
class Mention:
    """A frame that a parameter names of a node of which is not known what it does with that: it may broadcast it."""

    frame: str
    node: LaunchNode
    parameter: str
    param: Param
    space: str = ""


@dataclass(frozen=True, slots=True)
class Frames(Remembering):
    """All frames of a launch. `gaps` says why there may be more, a sentence each."""

    edges: tuple[Edge, ...] = ()
    uses: tuple[Use, ...] = ()
    mentions: tuple[Mention, ...] = ()
    gaps: tuple[str, ...] = ()
    simulated: bool = False
    """Whether the launch starts a simulator, or puts a robot into one: otherwise the plugins of a description do
    nothing."""

    def names(self, space: str) -> frozenset[str]:
        """The frames that are broadcast in a space."""
        return _names(self).get(space, frozenset())

    def parents(self, space: str) -> Mapping[str, tuple[Edge, ...]]:
        """The transforms of a space by their child."""
        return _parents(self).get(space, {})

    def trees(self, space: str) -> Mapping[str, str]:
        """The frames of a space, each with a frame that stands for its tree: all that are joined have the same."""
        return _trees(self).get(space, {})

    @property
    def spaces(self) -> tuple[str, ...]:
        """Those in which something is broadcast, the plain one first."""
        return tuple(sorted(_names(self)))

    @property
    def complete(self) -> bool:
        """Whether nothing speaks for more frames."""
        return not self.gaps

    def robot_root(self, space: str) -> str | None:
        """The root of the only robot description that is published in a space, if all of its links are known."""
        return _robot_roots(self).get(space)

    def path(self, space: str, frame: str) -> tuple[Edge, ...]:
        """The transforms from a frame up to its root, the first one that is known at each step."""
        parents, found, met = self.parents(space), list[Edge](), {frame}
        while len(found) < MOST_STEPS and (edges := parents.get(frame)):
            frame = edges[0].parent
            found.append(edges[0])
            if frame in met:
                break
            met.add(frame)
        return tuple(found)

    def root(self, space: str, frame: str) -> str:
        """The root of the tree that a frame is in."""
        path = self.path(space, frame)
        return path[-1].parent if path else frame


@derived
def _robot_roots(frames: Frames) -> Mapping[str, str]:
    found: dict[str, str] = {}
    for space in {edge.space for edge in frames.edges if edge.how == "urdf" and edge.sure}:
        edges = [edge for edge in frames.edges if edge.how == "urdf" and edge.space == space]
        children = {edge.child for edge in edges}
        roots = {edge.parent for edge in edges if edge.parent not in children}
        if len(roots) == 1 and all(edge.sure and edge.robot and edge.robot.description.is_whole for edge in edges):
            found[space] = roots.pop()
    return found


@derived
def _names(frames: Frames) -> Mapping[str, frozenset[str]]:
    found: dict[str, set[str]] = {}
    for edge in frames.edges:
        found.setdefault(edge.space, set()).update((edge.parent, edge.child))
    return {space: frozenset(names) for space, names in found.items()}


@derived
def _parents(frames: Frames) -> Mapping[str, Mapping[str, tuple[Edge, ...]]]:
    found: dict[str, dict[str, list[Edge]]] = {}
    for edge in frames.edges:
        found.setdefault(edge.space, {}).setdefault(edge.child, []).append(edge)
    return {space: {child: tuple(edges) for child, edges in of.items()} for space, of in found.items()}


@derived
def _trees(frames: Frames) -> Mapping[str, Mapping[str, str]]:
    found: dict[str, dict[str, list[str]]] = {}
    for edge in frames.edges:
        trees = found.setdefault(edge.space, {})
        one, other = (trees.setdefault(end, [end]) for end in (edge.parent, edge.child))
        if one is other:
            continue
        small, large = sorted((one, other), key=len)
        large += small
        for frame in small:
            trees[frame] = large
    return {space: {frame: tree[0] for frame, tree in of.items()} for space, of in found.items()}
