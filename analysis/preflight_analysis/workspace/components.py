"""Which container a run starts for a composable node of ROS 2.

That is the one of the launch, where it is a program here. Where it is not, or another launch starts it, the container
of rclcpp_components stands in: what a component does is the same whoever loads it.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any

from preflight_analysis.documents.document import Document
from preflight_analysis.environment.model import Executable
from preflight_analysis.evaluation.files import Executables
from preflight_analysis.evaluation.ros2.containers import container_of, containers_of
from preflight_analysis.evaluation.ros2.params import sections_for_any_name
from preflight_analysis.evaluation.ros2.remaps import renames_nodes
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree
from preflight_analysis.tracing import preload
from preflight_analysis.tracing.request import Component, TraceRequest, split_args

_PACKAGE, _PROGRAM = "rclcpp_components", "component_container"


class Containers:
    """The containers of a launch."""

    def __init__(self, tree: LaunchTree, executables: Executables) -> None:
        self._tree = tree
        self._executables = executables

    def request(
        self, node: LaunchNode, params: Mapping[str, Any], documents: Mapping[str, Document]
    ) -> TraceRequest | None:
        """How to run a composable node; None where its library is not there, or no container for it."""
        host = self._host(node)
        if host is not None and not preload.applies(host.resolved.path or ""):
            host = None
        program = (host.resolved if host is not None else self._stand_in).path
        if node.unknowns or node.resolved.path is None or node.plugin is None or program is None:
            return None
        return TraceRequest(
            node.name,
            node.package,
            node.resolved.path,
            remaps=tuple((remap.source, remap.target) for remap in node.remaps),
            params=params,
            env=host.env if host is not None else (),
            cwd=host.cwd if host is not None else None,
            generation=2,
            named=node.named,
            component=Component(
                node.plugin,
                program,
                host.name if host is not None else f"/{_PROGRAM}",
                host.named if host is not None else False,
                split_args(host.args) if host is not None else (),
                tuple((r.source, r.target) for r in host.remaps if renames_nodes(r.source)) if host is not None else (),
                tuple((each.name, each.value) for each in node.extra_arguments),
            ),
            sections=sections_for_any_name(host, documents) if host is not None else (),
            launch=node.location.file,
        )

    def lack(self, node: LaunchNode) -> str | None:
        """Why there is no container to run a composable node in; None where there is."""
        if self._host(node) is not None or self._stand_in.path is not None:
            return None
        if self._stand_in.package_path is None:
            return f"its container is not here, nor is package {_PACKAGE!r}"
        return f"its container is not here, nor is {_PROGRAM!r} of package {_PACKAGE!r}"

    def _host(self, node: LaunchNode) -> LaunchNode | None:
        host = container_of(node, self._nodes)
        return host if host is not None and host.resolved.path is not None else None

    @cached_property
    def _nodes(self) -> Mapping[str, LaunchNode]:
        return containers_of(self._tree.nodes)

    @property
    def _stand_in(self) -> Executable:
        return self._executables.find(_PACKAGE, _PROGRAM)
