"""Topics that nodes are given by their command lines: those of topic_tools, of bridges to Gazebo, rostopic's,
image_transport's, and of the configuration of RViz.

http://wiki.ros.org/topic_tools, https://github.com/ros-tooling/topic_tools, http://wiki.ros.org/rostopic,
https://docs.ros.org/en/jazzy/p/ros_gz_image/, http://wiki.ros.org/image_transport. Such a node takes any type, and its
source does not say which topics: the command line does, where the node was not run.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import compress

from preflight_analysis.documents.document import Document
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.arguments import remaps_in
from preflight_analysis.evaluation.ros2.bridges import config_file_of, is_bridge
from preflight_analysis.evaluation.rviz import rviz_config_of
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree
from preflight_analysis.graph.annotations import read_annotation
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.nodl.bridges import bridged
from preflight_analysis.nodl.rviz import displayed
from preflight_analysis.tracing.interface import Endpoint, Interface, Role
from preflight_analysis.tracing.request import split_args

_TOPIC = re.compile(r"[~/A-Za-z_][A-Za-z0-9_/]*")
_ANY = "*"
_IMAGES = "image_transport"
_ENDS = ("in", "out")
_TRANSPORTED = {
    "raw": "sensor_msgs/Image",
    "compressed": "sensor_msgs/CompressedImage",
    "compressedDepth": "sensor_msgs/CompressedImage",
    "theora": "theora_image_transport/Packet",
}


def with_command_lines(
    tree: LaunchTree, interfaces: Sequence[Interface], documents: Mapping[str, Document], kept: Kept
) -> Sequence[Interface]:
    """The interfaces of the nodes of `tree`, in order, with what their command lines name, and the files of bridges and
    of RViz."""
    files = [documents.get(_file_of(node) or "") for node in tree.nodes]
    found = kept.each_row(_endpoints, (tree.nodes, files), tree.ros.kinds_in_types)
    if not any(found):
        return interfaces
    whole = list(interfaces)
    for at, endpoints in compress(enumerate(found), found):
        # A run tells what is made on demand, and an annotation is the user's word for all of it.
        if not whole[at].complete and read_annotation(tree.nodes[at].action)[0] is None:
            source = whole[at].source if whole[at].known else "source"
            if tree.nodes[at].package == _IMAGES:
                others = tuple(end for end in whole[at].endpoints if end.name not in _ENDS)
                whole[at] = replace(whole[at], endpoints=(*others, *endpoints), source=source)
            elif files[at] is not None and not is_bridge(tree.nodes[at]):
                whole[at] = whole[at].with_more(source, endpoints, ())
            else:
                whole[at] = replace(whole[at].with_more(source, endpoints, ()), whole=True)
    return whole


def _file_of(node: LaunchNode) -> str | None:
    return config_file_of(node) if is_bridge(node) else rviz_config_of(node)


def _endpoints(node: LaunchNode, config: Document | None, kinds_in_types: bool) -> tuple[Endpoint, ...]:
    if is_bridge(node):
        return tuple(bridged(node, config, kinds_in_types))
    if config is not None:
        return displayed(config, kinds_in_types)
    made = _MAKING.get(node.package)
    if made is None or node.unknowns:
        return ()
    # Remaps and private parameters (`_lazy:=true`) may stand anywhere.
    given = [word for word in split_args(node.args) if ":=" not in word]
    ends = dict.fromkeys(made(node, given, kinds_in_types))
    return tuple(Endpoint(role, name, type_) for role, name, type_ in ends if _TOPIC.fullmatch(name))


_Made = Iterator[tuple[Role, str, str]]
"""Role, name and type of each end."""


def _of_rostopic(node: LaunchNode, words: list[str], _: bool) -> _Made:
    """`rostopic pub [OPTION]... TOPIC TYPE [ARGS...]`."""
    command, *rest = words or [""]
    given = iter(rest) if node.executable == "rostopic" and command == "pub" else iter(())
    for word in given:
        if word in _WITH_VALUE:
            next(given, None)
        elif not word.startswith("-"):
            type_ = next(given, "")
            if _TYPE.fullmatch(type_):
                yield "publisher", word, type_
            return


def _of_images(node: LaunchNode, words: list[str], kinds_in_types: bool) -> _Made:
    """Each topic of images in Gazebo that an `image_bridge` names is one in ROS."""
    for name in words if node.executable == "image_bridge" else ():
        if not name.startswith("-"):
            yield "publisher", name, "sensor_msgs/msg/Image" if kinds_in_types else "sensor_msgs/Image"


def _of_republish(node: LaunchNode, words: list[str], kinds_in_types: bool) -> _Made:
    """`republish IN_TRANSPORT [OUT_TRANSPORT]`: the topics `in` and `out` are those of a transport, whose name comes
    behind the remapped one. Without the second all transports are published."""
    if kinds_in_types or node.executable != "republish" or not words:
        return
    tagged = tuple((remap.source, remap.target) for remap in node.remaps)
    remapped = names.resolve_remaps((*remaps_in(split_args(node.args)), *tagged), node.name)
    roles: tuple[Role, Role] = ("subscriber", "publisher")
    for role, name, transport in zip(roles, _ENDS, (words[0], (*words[1:], "raw")[0]), strict=True):
        resolved = names.resolve(name, node.name, remapped)
        topic = name if transport == "raw" else f"{resolved}/{transport}"
        yield role, topic, _TRANSPORTED.get(transport, _ANY)


def _of_topic_tools(node: LaunchNode, words: list[str], _: bool) -> _Made:
    for role, name in _of_tool(node, words):
        yield role, name, _ANY


_MAKING: Mapping[str, Callable[[LaunchNode, list[str], bool], _Made]] = {
    "topic_tools": _of_topic_tools,
    "rostopic": _of_rostopic,
    _IMAGES: _of_republish,
    **dict.fromkeys(("ros_gz_image", "ros_ign_image"), _of_images),
}
_WITH_VALUE = ("-r", "--rate", "-f", "--file", "-s", "--substitute")
_TYPE = re.compile(r"\w+/\w+")


def _of_tool(node: LaunchNode, given: list[str]) -> Iterator[tuple[Role, str]]:
    own = {param.name: param.value for param in node.params if isinstance(param.value, str)}
    if node.executable == "mux":
        yield from ((("publisher" if at == 0 else "subscriber"), name) for at, name in enumerate(given))
    elif node.executable == "demux":
        yield from ((("subscriber" if at == 0 else "publisher"), name) for at, name in enumerate(given))
    elif node.executable == "throttle":
        kind, *rest = given or [""]
        yield from _passed_on(rest, {"messages": 2, "bytes": 3}.get(kind, len(rest)), "throttle", own)
    elif node.executable in _OUTPUT_AT:
        yield from _passed_on(given, _OUTPUT_AT[node.executable], node.executable, own)


_OUTPUT_AT = {"relay": 1, "drop": 3, "delay": 2}
"""Behind the input and how many other words the output stands, which is the input with the tool's name else."""


def _passed_on(words: list[str], output_at: int, tool: str, own: dict[str, str]) -> Iterator[tuple[Role, str]]:
    """The input and the output; ROS 2 has parameters for both."""
    source = words[0] if words else own.get("input_topic")
    if source is None or 0 < len(words) < output_at:
        return
    yield "subscriber", source
    yield "publisher", words[output_at] if len(words) > output_at else own.get("output_topic", f"{source}_{tool}")
