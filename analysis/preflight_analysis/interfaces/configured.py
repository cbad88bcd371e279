"""Topics that are written in configuration files of nodes: those that bridges to Gazebo carry, which their command
lines may name as well, and what displays of RViz subscribe to."""

from __future__ import annotations

from collections.abc import Sequence

from preflight_analysis.documents.document import Document
from preflight_analysis.evaluation.ros2.bridges import config_file_of, is_bridge
from preflight_analysis.evaluation.rviz import rviz_config_of
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.interfaces.bridges import bridged
from preflight_analysis.interfaces.part import Launch, Part, Rows
from preflight_analysis.interfaces.rviz import displayed
from preflight_analysis.tracing.interface import ENDS, Endpoint, Interface


def configured_asked(launch: Launch, known: Sequence[Interface]) -> Rows | None:
    """The file that each node is configured by, and what it names."""
    files = [launch.documents.get(_file_of(node) or "") for node in launch.nodes]
    found = launch.kept.each_row(_endpoints, (launch.nodes, files), launch.tree.ros.kinds_in_types)
    return Rows((found,)) if any(found) else None


def configured(node: LaunchNode, known: Interface, ends: tuple[Endpoint, ...]) -> Part | None:
    """What the file of a bridge or of RViz names, and the arguments of a bridge. A run tells what is made on demand."""
    if not ends or known.complete:
        return None
    return Part("source", ends, closed=ENDS if is_bridge(node) else (), leads=False)


def _file_of(node: LaunchNode) -> str | None:
    return config_file_of(node) if is_bridge(node) else rviz_config_of(node)


def _endpoints(node: LaunchNode, config: Document | None, kinds_in_types: bool) -> tuple[Endpoint, ...]:
    if is_bridge(node):
        return tuple(bridged(node, config, kinds_in_types))
    return displayed(config, kinds_in_types) if config is not None else ()
