"""What the classes of `launch` and `launch_ros` take by keyword. A run of a launch file finds the same classes."""

from __future__ import annotations

import inspect
from functools import cache

from preflight_analysis.tracing.agents.fake_launch.tables import TABLE

_MODULES = frozenset(
    {
        *("launch", "launch.actions", "launch.conditions", "launch.descriptions", "launch.event_handlers"),
        *("launch.launch_description", "launch.launch_description_sources", "launch.substitutions"),
        *("launch_ros.actions", "launch_ros.descriptions", "launch_ros.parameter_descriptions"),
        "launch_ros.substitutions",
    }
)


@cache
def keywords_of(full_name: str) -> frozenset[str] | None:
    """The keywords that a class takes, which is named as `launch.actions.LogInfo`; None where that is not known."""
    module, _, name = full_name.rpartition(".")
    made = TABLE[module].get(name) if module in _MODULES else None
    found: set[str] = set()
    for each in made.__mro__[:-1] if isinstance(made, type) else ():
        if "__init__" not in vars(each):
            continue
        parameters = list(inspect.signature(vars(each)["__init__"]).parameters.values())[1:]
        found.update(p.name for p in parameters if p.kind in (p.POSITIONAL_OR_KEYWORD, p.KEYWORD_ONLY))
        if all(p.kind is not p.VAR_KEYWORD for p in parameters):
            return frozenset(found)
    return None
