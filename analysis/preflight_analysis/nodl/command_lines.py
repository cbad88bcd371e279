"""Topics that nodes are given by their command lines: those of topic_tools, and bridges to Gazebo.

http://wiki.ros.org/topic_tools, https://github.com/ros-tooling/topic_tools. Such a node takes any type, and its source
does not say which topics: the command line does, where the node was not run.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import compress

from preflight_analysis.documents.document import Document
from preflight_analysis.evaluation.ros2.bridges import config_file_of, is_bridge
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree
from preflight_analysis.graph.annotations import read_annotation
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.nodl.bridges import bridged
from preflight_analysis.tracing.interface import Endpoint, Interface, Role
from preflight_analysis.tracing.request import split_args

_TOPIC = re.compile(r"[~/A-Za-z_][A-Za-z0-9_/]*")
_ANY = "*"


def with_command_lines(
    tree: LaunchTree, interfaces: Sequence[Interface], documents: Mapping[str, Document], kept: Kept
) -> Sequence[Interface]:
    """The interfaces of the nodes of `tree`, in order, with what their command lines name, and the files of bridges."""
    files = [documents.get(config_file_of(node) or "") if is_bridge(node) else None for node in tree.nodes]
    found = kept.each_row(_endpoints, (tree.nodes, files), tree.ros.kinds_in_types)
    if not any(found):
        return interfaces
    whole = list(interfaces)
    for at, endpoints in compress(enumerate(found), found):
        # A run tells what is made on demand, and an annotation is the user's word for all of it.
        if not whole[at].complete and read_annotation(tree.nodes[at].action)[0] is None:
            source = whole[at].source if whole[at].known else "source"
            whole[at] = replace(whole[at].with_more(source, endpoints, ()), whole=True)
    return whole


def _endpoints(node: LaunchNode, config: Document | None, kinds_in_types: bool) -> tuple[Endpoint, ...]:
    if is_bridge(node):
        return tuple(bridged(node, config, kinds_in_types))
    if node.package != "topic_tools" or node.unknowns:
        return ()
    return tuple(Endpoint(role, name, _ANY) for role, name in dict.fromkeys(_of_tool(node)) if _TOPIC.fullmatch(name))


def _of_tool(node: LaunchNode) -> Iterator[tuple[Role, str]]:
    # Remaps and private parameters (`_lazy:=true`) may stand anywhere.
    given = [word for word in split_args(node.args) if ":=" not in word]
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
