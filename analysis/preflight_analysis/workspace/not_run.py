"""Why the interface of a node is not there, in words for the user."""

from __future__ import annotations

from functools import lru_cache

from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.model.context import ExecutableNames
from preflight_analysis.model.nearest import did_you_mean, nearest_class
from preflight_analysis.tracing.interface import Interface, Outcome
from preflight_analysis.workspace.components import Containers


def not_run(
    node: LaunchNode, executables: ExecutableNames, reason: str | None = None, containers: Containers | None = None
) -> Interface:
    """An empty interface that says why: what the launch file leaves unknown, nothing that could be run, or else
    `reason`."""
    if node.unknowns:
        first = node.unknowns[0]
        reason = f"{first.what} is not known ({first.reason})"
    elif node.resolved.path is None:
        reason = _why_not_there(node, executables)
    elif node.kind == "composable" and containers is not None:
        reason = containers.lack(node) or reason
    return _not_run(reason)


def _why_not_there(node: LaunchNode, executables: ExecutableNames) -> str:
    if node.resolved.not_executable:
        return f"'{node.resolved.not_executable[0]}' is not executable"
    if node.package and node.resolved.package_path is None:
        return f"package {node.package!r} is not installed here"
    if node.plugin is None:
        return f"there is no executable {node.executable!r} in package {node.package!r}"
    registered = executables.components(node.package)
    if node.plugin in registered:
        return "it is not built yet"
    if not registered:
        return f"no component of package {node.package!r} is known here"
    near = nearest_class(node.plugin, registered)
    return f"component {node.plugin!r} is not registered by package {node.package!r}{did_you_mean(near)}"


@lru_cache(maxsize=1024)
def _not_run(reason: str | None) -> Interface:
    # The same object for the same reason, so that what was made of it is found again.
    return Interface("none", Outcome("not-run", reason=reason))
