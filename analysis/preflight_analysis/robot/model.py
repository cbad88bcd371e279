"""What a robot description says, as plain data (http://wiki.ros.org/urdf/XML), and what others add to it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation.partial_text import Catalogued


@dataclass(frozen=True, slots=True)
class Joint:
    """A `<joint>` of the robot. `parent` and `child` are links, "" where the element does not name one; `mimic` is the
    joint that it follows."""

    name: str
    type: str
    parent: str
    child: str
    mimic: str | None = None
    limited: bool = False
    """Whether it has a `<limit>`, which revolute and prismatic ones need."""
    catalogued: str = ""
    """The package that the catalogue has it of, where that is not installed; its type may then be "", not known."""


@dataclass(frozen=True, slots=True)
class ControlJoint:
    """A joint that a `<ros2_control>` or `<transmission>` element names, with its interfaces: of `<ros2_control>` those
    for commands and those for states, of a transmission its hardware interfaces as commands."""

    name: str
    commands: tuple[str, ...] = ()
    states: tuple[str, ...] = ()
    mimic: str = ""
    """Its attribute `mimic`, which says whether it follows the joint that the robot's own one follows."""


@dataclass(frozen=True, slots=True)
class Transmission:
    """A `<transmission>` element, of ros_control or within `<ros2_control>`."""

    name: str
    joints: tuple[ControlJoint, ...]


@dataclass(frozen=True, slots=True)
class ControlSystem:
    """A `<ros2_control>` element. `sensors` and `gpios` have their interfaces as joints do; `unknown` are the tags of
    elements that it may not have, `around` is the tag of the element that it is in."""

    name: str
    type: str
    plugin: str
    joints: tuple[ControlJoint, ...]
    sensors: tuple[ControlJoint, ...] = ()
    gpios: tuple[ControlJoint, ...] = ()
    transmissions: tuple[Transmission, ...] = ()
    unknown: tuple[str, ...] = ()
    around: str = "robot"


@dataclass(frozen=True, slots=True)
class GazeboPlugin:
    """A `<plugin>` in a `<gazebo>` element. `params` has the texts of the elements in it by their tags, the first one
    of each; `reference` is the link that the element is about, "" for the robot."""

    name: str
    filename: str
    params: Mapping[str, str]
    reference: str = ""
    joints: tuple[tuple[str, str], ...] = ()
    """The tags of its elements that name joints, each with the joint."""


@dataclass(frozen=True, slots=True)
class GazeboReference:
    """A `<gazebo reference="...">`: what it is about, and whether it adds a sensor or plugin to that."""

    name: str
    adds: bool


@dataclass(frozen=True, slots=True)
class SimulatedSensor:
    """A `<sensor>` of Gazebo. `texts` has those of its elements that name topics; `within` is what it is in, as the
    default names of topics have it: `/link/L`, `/joint/J`, `/link/*` where that is not known."""

    name: str
    type: str
    texts: Mapping[str, str]
    within: str


@dataclass(frozen=True, slots=True)
class IncludedModel:
    """An `<include>` of a world or model: what it names, and the name that the model gets, "" for its own."""

    uri: str
    name: str = ""


@dataclass(frozen=True, slots=True)
class Simulated:
    """A world or model of Gazebo (http://sdformat.org/spec), or what the `<gazebo>` elements of a robot add to it."""

    kind: Literal["world", "model"]
    name: str
    plugins: tuple[GazeboPlugin, ...] = ()
    sensors: tuple[SimulatedSensor, ...] = ()
    models: tuple[Simulated, ...] = ()
    includes: tuple[IncludedModel, ...] = ()


@dataclass(frozen=True, slots=True)
class SensorFrame:
    """The frame that the messages of a simulated sensor have: the text of the element `tag`, in the sensor `sensor`."""

    sensor: str
    tag: str
    frame: str


@dataclass(frozen=True, slots=True)
class Malformed:
    """Why a text is no XML: the parser's words, and the line of the text, counted from 1."""

    message: str
    line: int


@dataclass(frozen=True, slots=True)
class Description:
    """A robot description. Names are in the order of the text, repeated as there. `kind` is the tag of the root:
    `robot` for URDF, `xacro` for what xacro has yet to make a URDF of. Of another one than `robot` (`sdf`) nothing
    else is read, nor where the text is `malformed`."""

    kind: str
    name: str = ""
    links: tuple[str, ...] = ()
    joints: tuple[Joint, ...] = ()
    meshes: tuple[str, ...] = ()
    """Each file once, as written."""
    systems: tuple[ControlSystem, ...] = ()
    misplaced: tuple[ControlSystem, ...] = ()
    """`<ros2_control>` elements that are not below the root, which nobody reads."""
    transmissions: tuple[Transmission, ...] = ()
    plugins: tuple[GazeboPlugin, ...] = ()
    sensors: tuple[SimulatedSensor, ...] = ()
    references: tuple[GazeboReference, ...] = ()
    sensor_frames: tuple[SensorFrame, ...] = ()
    malformed: Malformed | None = None
    lacks: tuple[str, ...] = ()
    """The packages that it includes and that are not installed here: links, joints and all else may be missing."""
    catalogued: Catalogued | None = None
    """The packages that it includes and that are not installed here either, but known from the catalogue: links, joints
    and interfaces, without shapes and values."""

    @property
    def is_whole(self) -> bool:
        """Whether it is a robot of which all is known: what it does not have then does not exist."""
        return self.kind == "robot" and not self.lacks

    @property
    def roots(self) -> tuple[str, ...]:
        """The links that no joint has as its child, each once."""
        children = {joint.child for joint in self.joints}
        return tuple(dict.fromkeys(link for link in self.links if link not in children))
