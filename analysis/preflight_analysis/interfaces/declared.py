"""What somebody has written down of a node: an annotation in its tag, the settings, a NoDL document of its package."""

from __future__ import annotations

from collections.abc import Sequence

from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.graph.annotations import read_annotation
from preflight_analysis.interfaces.nodl_files import nodl_of
from preflight_analysis.interfaces.nodl_read import Described
from preflight_analysis.interfaces.part import Launch, Part, Rows
from preflight_analysis.interfaces.settings import NodeSettings
from preflight_analysis.tracing.interface import Interface


def annotated(node: LaunchNode, known: Interface) -> Part | None:
    """The user's word for all that the node does."""
    annotation = read_annotation(node.action)[0] if _asks(node, known) else None
    return Part("annotation", annotation.endpoints, annotation.params) if annotation is not None else None


def settings_asked(launch: Launch, known: Sequence[Interface]) -> Rows | None:
    """The settings, where there are any."""
    return Rows(shared=(launch.settings,)) if launch.settings else None


def of_settings(node: LaunchNode, known: Interface, settings: Sequence[NodeSettings]) -> Part | None:
    """The first that speak of the node."""
    said = next((each for each in settings if each.speaks_of(node)), None) if _asks(node, known) else None
    return Part("settings", said.endpoints, said.params) if said is not None else None


def nodl_asked(launch: Launch, known: Sequence[Interface]) -> Rows | None:
    """What the documents of packages say of each node."""
    found = nodl_of(launch.tree.generation, launch.environment, launch.disk, launch.nodes)
    return Rows((found,)) if any(found) else None


def of_nodl(node: LaunchNode, known: Interface, said: Described | None) -> Part | None:
    """The document of the node."""
    return Part("nodl", said.endpoints, said.params) if said is not None and _asks(node, known) else None


def _asks(node: LaunchNode, known: Interface) -> bool:
    """Whether the words of others count. Those of a simulated node would be of what spawns its robot."""
    return not known.complete and node.kind != "simulated"
