"""The parameters of a launch by namespace: they are many, loaded from YAML by the hundred, and namespaces are few."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import compress
from operator import is_not

from preflight_analysis.evaluation.meanings import namespace_of, params_by_namespace
from preflight_analysis.evaluation.tree import Param
from preflight_analysis.findings.finding import Fix
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import replacement
from preflight_analysis.tracing.interface import ParamUse

OF_ALL_NODES = {
    "use_sim_time": ParamUse("~use_sim_time", "get", False, has_default=True, builtin=True),
    "start_type_description_service": ParamUse(
        "~start_type_description_service", "get", True, has_default=True, builtin=True
    ),
}
"""What the client libraries of ROS 2 declare for each node, whatever is known of it; the second since Jazzy."""


@derived
def by_namespace(context: Context) -> Mapping[str, tuple[Param, ...]]:
    """All parameters by their namespace. A group that is as before an edit is the same object."""
    return params_by_namespace(context.tree, context.kept)


@derived
def groups_of_params(context: Context) -> tuple[tuple[Param, ...], ...]:
    """Those of `by_namespace`."""
    return tuple(by_namespace(context).values())


@derived
def namespaces_around(context: Context) -> Mapping[str, tuple[tuple[Param, ...], ...]]:
    """The groups of `by_namespace` that are in or below each namespace but the root."""
    return context.indexed(_around, "", groups_of_params(context))


@derived
def around_each(context: Context) -> tuple[tuple[str, ...], ...]:
    """For each group of `by_namespace` its namespace and those that this is in but the root, the innermost first."""
    return context.each(_around, groups_of_params(context))


def _around(params: tuple[Param, ...]) -> tuple[str, ...]:
    found = []
    space = namespace_of(params[0])
    while space:
        found.append(space)
        space = space.rpartition("/")[0]
    return tuple(found)


def changed_names(before: Sequence[Param], params: Sequence[Param]) -> set[str]:
    """The names of the parameters that are other objects than before, or that came or went."""
    if len(before) == len(params):
        changed = [*map(is_not, before, params)]
        return {param.name for param in (*compress(before, changed), *compress(params, changed))}
    old, new = {id(param): param for param in before}, {id(param): param for param in params}
    return {param.name for param in (*(old[at] for at in old.keys() - new), *(new[at] for at in new.keys() - old))}


def grouped(params: Iterable[Param]) -> dict[str, list[Param]]:
    """These parameters by namespace."""
    groups: dict[str, list[Param]] = {}
    for param in params:
        groups.setdefault(namespace_of(param), []).append(param)
    return groups


def renamed(context: Context, param: Param, name: str) -> tuple[Fix, ...]:
    """A fix where the name is written as such: in an attribute as far as the two names differ, or as a YAML key."""
    location = param.name_location
    if location is None:
        return ()
    written = context.text(location)
    mark = "~" if written.startswith("~") else ""
    stem = written[len(mark) :]
    if stem.startswith("/"):
        new = name if stem == param.name else None
    else:
        prefix = param.name.removesuffix(stem)
        new = name[len(prefix) :] if param.name.endswith("/" + stem) and name.startswith(prefix) else None
    return replacement(context, location, mark + new, f"Rename '{written}' to '{mark}{new}'") if new else ()
