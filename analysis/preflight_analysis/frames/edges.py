"""The transforms that a node broadcasts, by all that is known of it."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.meanings import Known, Settings, own_params
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree, Param
from preflight_analysis.frames.model import Edge
from preflight_analysis.graph.build import effective_remaps
from preflight_analysis.graph.tf_frames import frame_in_arguments
from preflight_analysis.robot.model import GazeboPlugin
from preflight_analysis.robot.of_launch import Robot
from preflight_analysis.tracing.interface import Frame, Interface

_STATE_PUBLISHERS = ("robot_state_publisher", "state_publisher")
ANY = "*"
"""In what is known of a package: frames that no parameter names."""
_FIXED = "="
"""In what is known of a package: before a frame that no parameter names."""
_OTHER = "$"
"""Likewise before the name of a parameter whose value is a default."""
_DRIVES = ("diff_drive", "diff-drive", "skid_steer", "planar_move", "ackermann", "mecanum", "tricycle", "odometry-pub")
"""In the names of Gazebo's plugins that broadcast odometry."""
_ODOMETRY = ("odometry_frame", "odometryFrame", "odom_frame", "frame_id")
_BASE = ("robot_base_frame", "robotBaseFrame", "base_frame", "child_frame_id")
_SAYS_NOT = ("publish_odom_tf", "publishOdomTF", "publishTf", "publish_tf", "broadcastTF")
_NO = ("false", "0")
_YES = ("true", "1")


def plain(frame: str) -> str:
    """A frame without leading slashes: tf takes them off where it is broadcast, in both generations."""
    return frame.lstrip("/")


def space_of(node: LaunchNode, generation: int) -> str:
    """The namespace of the topic that a node has for `/tf`: "" for that itself, `/robot1` where it is remapped. Another
    topic, such as `/raw_tf`, has a node that passes its frames on."""
    if not node.remaps and ":=" not in node.args:
        return ""
    remap = effective_remaps(node, generation).get("/tf")
    return remap[1].removesuffix("/tf") if remap is not None and names.leaf(remap[1]) == "tf" else ""


def is_state_publisher(node: LaunchNode) -> bool:
    """Whether it publishes the frames of a robot description."""
    if node.package != "robot_state_publisher":
        return False
    return node.plugin is not None or node.executable in _STATE_PUBLISHERS


def edges_of_node(
    node: LaunchNode,
    interface: Interface | None,
    known: Known | None,
    given: Sequence[Param],
    generation: int,
    prefixed: bool,
) -> tuple[Edge, ...]:
    """What a node broadcasts beside the frames of a robot description: by its arguments, its run, its parameters.
    With a `tf_prefix` that it may heed, or parameters that are not known, nothing of the last is sure."""
    space = space_of(node, generation)
    found: dict[tuple[str, str], Edge] = {}

    def add(edge: Edge) -> None:
        if edge.parent and edge.child:
            found.setdefault((edge.parent, edge.child), edge)

    arguments = frame_in_arguments(node)
    if arguments is not None:
        parent, child = plain(arguments.parent), plain(arguments.child)
        add(Edge(parent, child, arguments.static, "arguments", node, node.location, space))
    frames = interface.frames if interface is not None else ()
    for frame in frames:
        if not frame.evidence.inferred:
            parent, child = plain(frame.parent), plain(frame.child)
            add(Edge(parent, child, frame.static, "run", node, node.location, space, detail="seen in a run"))
    # A controller has parameters in any case.
    guessed = _lacks_params(node) or (known is not None and "controllers" in known.entry.names and not given)
    for edge in _of_knowledge(node, known, given, space):
        add(replace(edge, sure=False, guessed=guessed) if guessed or prefixed else edge)
    # What is known of it otherwise is more than its text tells.
    for frame in frames if not found else ():
        add(_of_source(frame, node, space))
    return tuple(found.values())


def _lacks_params(node: LaunchNode) -> bool:
    """Whether a parameter file in the node's own tag is not known (ROS 2)."""
    files = sum(child.kind == "param" and child.value("from") is not None for child in node.action.children)
    return files > sum(source.path is not None and not source.pushed for source in node.param_sources)


def _of_source(frame: Frame, node: LaunchNode, space: str) -> Edge:
    """A transform that the source tells: never sure, as the node may not come to where it broadcasts."""
    return Edge(
        plain(frame.parent),
        plain(frame.child),
        frame.static,
        "source",
        node,
        node.location,
        space,
        False,
        detail=f"{os.path.basename(frame.source_file)}:{frame.source_line}",
        conditional=frame.evidence.conditional,
        source_file=frame.source_file,
        source_line=frame.source_line,
    )


def has_unnamed(node: LaunchNode, interface: Interface | None, known: Known | None, given: Sequence[Param]) -> bool:
    """Whether it broadcasts frames whose names are not known."""
    if interface is not None and any(not (frame.parent and frame.child) for frame in interface.frames):
        return True
    if known is None or not any(each.child == ANY for each in known.entry.frames):
        return False
    settings = Settings(known, own_params(node, given))
    return any(settings.holds(each.when) for each in known.entry.frames if each.child == ANY)


def _of_knowledge(node: LaunchNode, known: Known | None, given: Sequence[Param], space: str) -> Iterator[Edge]:
    if known is None or not known.entry.frames:
        return
    settings = Settings(known, own_params(node, given))
    for each in known.entry.frames:
        if each.child == ANY:
            continue
        parent, child = _frame(settings, each.parent), _frame(settings, each.child)
        if not (parent and child) or not settings.holds(each.when):
            continue
        params = (_param(settings, name) for name in (each.child, each.parent))
        place = next((param.place for param in params if param is not None), node.location)
        detail = " -> ".join(name for name in (each.parent, each.child) if not name.startswith(_FIXED))
        yield Edge(parent, child, each.static, "knowledge", node, place, space, known.is_used, detail=detail)


def _param(settings: Settings, name: str) -> Param | None:
    """What sets a parameter, or the one whose value is its default."""
    found, default = settings.params.get(name), settings.defaults.get(name)
    if found is None and isinstance(default, str) and default.startswith(_OTHER):
        return settings.params.get(default.removeprefix(_OTHER))
    return found


def _frame(settings: Settings, name: str) -> str:
    value = settings.filled(name.removeprefix(_FIXED)) if name.startswith(_FIXED) else settings.value(name)
    return plain(value) if isinstance(value, str) else ""


def edges_of_robot(
    robot: Robot, publisher: LaunchNode | None, prefix: str, space: str, distro: str | None
) -> tuple[Edge, ...]:
    """The frames of a robot description, as a node publishes them with a prefix. `distro` is the distribution in use:
    what the catalogue has of another one is no more than possible."""
    catalogued = robot.description.catalogued
    links = frozenset(robot.description.links)
    return tuple(
        Edge(
            plain(prefix + joint.parent),
            plain(prefix + joint.child),
            joint.type == "fixed",
            "urdf",
            publisher,
            robot.param.place,
            space,
            publisher is not None and not joint.catalogued,
            detail=f"joint {joint.name}",
            robot=robot,
            likely=catalogued is not None and bool(joint.catalogued) and catalogued.distro == distro,
            catalogued=f"{joint.catalogued} of {catalogued.distro}" if catalogued and joint.catalogued else "",
        )
        for joint in robot.description.joints
        # robot_state_publisher leaves floating joints to others.
        if joint.parent in links and joint.child in links and joint.type != "floating"
    )


def edges_of_plugins(robot: Robot, node: LaunchNode | None, space: str) -> Iterator[Edge]:
    """The odometry that plugins of a simulator broadcast. What their elements say is sure; what they leave to a default
    differs by version."""
    for plugin in robot.description.plugins:
        if not any(word in plugin.filename for word in _DRIVES):
            continue
        if any(plugin.params.get(name, "").lower() in _NO for name in _SAYS_NOT):
            continue
        parent, child = _first(plugin, _ODOMETRY), _first(plugin, _BASE)
        if parent and child:
            said = any(plugin.params.get(name, "").lower() in _YES for name in _SAYS_NOT)
            place, sure = robot.param.place, said and node is not None
            yield Edge(
                plain(parent), plain(child), False, "gazebo", node, place, space, sure, detail=plugin.name, robot=robot
            )


def _first(plugin: GazeboPlugin, tags: Sequence[str]) -> str:
    return next((plugin.params[tag] for tag in tags if plugin.params.get(tag)), "")


def prefix_of(node: LaunchNode, tree: LaunchTree) -> str:
    """What a robot_state_publisher puts before the names of links: `frame_prefix` as it is given (ROS 2), `tf_prefix`
    of the closest namespace and a slash (ROS 1, `JointStateListener`)."""
    if tree.ros.own_parameters:
        return plain(_text({param.name: param for param in node.params}, "frame_prefix"))
    space = node.name
    while True:
        prefix = plain(_text(tree.params, names.join(space, "tf_prefix") if space != "/" else "/tf_prefix"))
        if prefix or space == "/":
            return f"{prefix}/" if prefix else ""
        space = names.parent(space).rstrip("/") or "/"


def _text(params: Mapping[str, Param], name: str) -> str:
    found = params.get(name)
    return found.value if found is not None and isinstance(found.value, str) else ""
