"""The parameters of a launch by namespace: they are many, loaded from YAML by the hundred, and namespaces are few."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from preflight_analysis.evaluation.tree import Param
from preflight_analysis.rules.rule import Context


def by_namespace(context: Context) -> Mapping[str, list[Param]]:
    """All of them, `/a/b/c` under `/a/b` and `/c` under the empty text. Ask through `context.once`."""
    return grouped(context.tree.params.values())


def grouped(params: Iterable[Param]) -> dict[str, list[Param]]:
    """These parameters by namespace."""
    groups: dict[str, list[Param]] = {}
    for param in params:
        groups.setdefault(param.name.rpartition("/")[0], []).append(param)
    return groups
