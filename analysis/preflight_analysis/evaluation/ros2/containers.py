"""Which container of a launch loads a composable node."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from preflight_analysis.evaluation.tree import LaunchNode


def containers_of(nodes: Iterable[LaunchNode]) -> Mapping[str, LaunchNode]:
    """What may load components, by full name: any program may."""
    return {node.name: node for node in nodes if node.kind != "composable" and not node.unknowns}


def container_of(node: LaunchNode, containers: Mapping[str, LaunchNode]) -> LaunchNode | None:
    """The one of a composable node; None where the launch does not start it. launch asks for
    `<container>/_container/load_node` from a node of its own, which lives in `/`."""
    container = node.container or ""
    return containers.get(container if container.startswith("/") else f"/{container}")
