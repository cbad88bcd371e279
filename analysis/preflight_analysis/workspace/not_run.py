"""Why the interface of a node is not there, in words for the user."""

from __future__ import annotations

from functools import lru_cache

from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.tracing.interface import Interface, Outcome


def not_run(node: LaunchNode, reason: str | None = None) -> Interface:
    """An empty interface that says why: what the launch file leaves unknown, no executable, or else `reason`."""
    if node.unknowns:
        first = node.unknowns[0]
        reason = f"{first.what} is not known ({first.reason})"
    elif node.resolved.path is None and node.resolved.not_executable:
        reason = f"'{node.resolved.not_executable[0]}' is not executable"
    elif node.resolved.path is None:
        reason = f"there is no executable {node.executable!r} in package {node.package!r}"
    return _not_run(reason)


@lru_cache(maxsize=1024)
def _not_run(reason: str | None) -> Interface:
    # The same object for the same reason, so that what was made of it is found again.
    return Interface("none", Outcome("not-run", reason=reason))
