"""Topics that are written in configuration files of nodes: those that bridges to Gazebo carry, which their command
lines may name as well, and what displays of RViz subscribe to."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import compress

from preflight_analysis.documents.document import Document
from preflight_analysis.evaluation.ros2.bridges import config_file_of, is_bridge
from preflight_analysis.evaluation.rviz import rviz_config_of
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree
from preflight_analysis.graph.annotations import read_annotation
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.nodl.bridges import bridged
from preflight_analysis.nodl.rviz import displayed
from preflight_analysis.tracing.interface import ENDS, Endpoint, Interface


def with_configured(
    tree: LaunchTree, interfaces: Sequence[Interface], documents: Mapping[str, Document], kept: Kept
) -> Sequence[Interface]:
    """The interfaces of the nodes of `tree`, in order, with what the files of bridges and of RViz name."""
    files = [documents.get(_file_of(node) or "") for node in tree.nodes]
    found = kept.each_row(_endpoints, (tree.nodes, files), tree.ros.kinds_in_types)
    if not any(found):
        return interfaces
    whole = list(interfaces)
    for at, endpoints in compress(enumerate(found), found):
        # A run tells what is made on demand, and an annotation is the user's word for all of it.
        if not whole[at].complete and read_annotation(tree.nodes[at].action)[0] is None:
            source = whole[at].source if whole[at].known else "source"
            more = whole[at].with_more(tree.nodes[at].name, source, endpoints, ())
            whole[at] = replace(more, whole=ENDS) if is_bridge(tree.nodes[at]) else more
    return whole


def _file_of(node: LaunchNode) -> str | None:
    return config_file_of(node) if is_bridge(node) else rviz_config_of(node)


def _endpoints(node: LaunchNode, config: Document | None, kinds_in_types: bool) -> tuple[Endpoint, ...]:
    if is_bridge(node):
        return tuple(bridged(node, config, kinds_in_types))
    return displayed(config, kinds_in_types) if config is not None else ()
