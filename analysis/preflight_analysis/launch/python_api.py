"""What Python launch files call of launch, for those who read or write their text.

It is declared where the sandbox sees it, too: in `tracing/agents/fake_launch/api.py`.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from functools import cache
from typing import NamedTuple

from preflight_analysis.launch.substitutions_ros2 import SUBSTITUTIONS_ROS2
from preflight_analysis.tracing.agents.fake_launch import api

_ALSO_IN = {
    "launch_ros.parameter_descriptions": "launch_ros.descriptions",
    "launch.event_handlers": "launch",
    "launch.launch_description_sources": "launch",
    "ament_index_python": "ament_index_python.packages",
}
"""Modules that have names of another one."""
Call = api.Call
CHILDREN: Mapping[str, str] = api.CHILDREN
PARAMETERS: Mapping[str, str] = api.PARAMETERS
BY_SHORT_NAME: Mapping[str, Call] = api.BY_SHORT_NAME
BY_NAME: Mapping[str, Call] = {each.name: each for each in api.CALLS}
KINDS: Mapping[str, str] = {name: each.kind for name, each in BY_SHORT_NAME.items()}
"""The kinds of what classes make, by their names without modules."""
COMMANDS: Mapping[str, str] = {
    each.short_name: each.kind for each in api.CALLS if each.kind in SUBSTITUTIONS_ROS2 and each.kind != "string-join"
}
"""What substitutions of Python, and functions in their place, are called in the other formats, of those that take the
same in the same order."""
SUBSTITUTIONS = frozenset(each.short_name for each in api.CALLS if "substitutions." in each.name)
CONDITIONS = frozenset(each.short_name for each in api.CALLS if each.name.startswith("launch.conditions."))
NAMES: Mapping[str, tuple[str, str]] = {
    each.short_name: (each.kind or "var", each.takes.partition(",")[0])
    for each in api.CALLS
    if each.kind in ("var", "env", "find-pkg-share", "find-pkg-prefix")
    or each.name.startswith("launch.conditions.Launch")
}
"""Calls whose first argument is a name, each with the command for such a name, and its parameter."""
_OF_PROCESSES = ("node", "lifecycle_node", "node_container")
NODES: Mapping[str, str] = {name: kind for name, kind in KINDS.items() if kind in (*_OF_PROCESSES, "composable_node")}
"""The kinds of what makes nodes, by the names of the classes."""
PROCESSES = frozenset(name for name, kind in NODES.items() if kind in _OF_PROCESSES)
"""The classes of nodes that are processes of their own."""
_BY_KIND: Mapping[str, Call] = {each.kind: each for each in reversed(api.CALLS) if each.kind}
_NOTHING = Call("")


class Parameter(NamedTuple):
    """A parameter; `default` is how that is written, None where there is none."""

    name: str
    default: str | None
    positional: bool
    """Whether it may be given without its keyword."""


def call_named(full_name: str) -> Call | None:
    """That of `launch.actions.LogInfo`, which `launch.actions.log_info` has, too."""
    module, _, name = full_name.rpartition(".")
    above = module.rpartition(".")[0]
    modules = (module, above, _ALSO_IN.get(module, ""))
    return next((found for each in modules if (found := BY_NAME.get(f"{each}.{name}")) is not None), None)


def own_doc(call: Call, parameter: str) -> str:
    """What a class, or one that it is made from, says of a parameter itself, in one sentence; "" for nothing."""
    found: Call | None = call
    while found is not None:
        if (doc := api.PARAMETERS.get(f"{found.short_name}.{parameter}")) is not None:
            return doc
        found = BY_SHORT_NAME.get(found.of)
    return ""


def made_by(kind: str) -> Call:
    """What makes actions of a kind: the first of several, which take the same."""
    return _BY_KIND.get(kind, _NOTHING)


def parameter_of(call: Call, attribute: str) -> str:
    """The parameter that gives an attribute."""
    return "condition" if attribute in ("if", "unless") else call.attributes.get(attribute, attribute)


def positional(call: Call) -> tuple[str, ...]:
    """The parameters that may be given without their keyword, in order."""
    return tuple(each.name for each in parameters(call) or () if each.positional)


def parameters(call: Call) -> tuple[Parameter, ...] | None:
    """All of them, those first that the class has itself; None where it takes any number of arguments."""
    return _parameters(call.name)


@cache
def _parameters(name: str) -> tuple[Parameter, ...] | None:
    call = BY_NAME.get(name, _NOTHING)
    above = BY_SHORT_NAME.get(call.of)
    if call.inherits and above is not None:
        return parameters(above)
    given = _arguments(call.takes)
    if given.vararg is not None:
        return None
    own = tuple(_own(given))
    names = {*call.gives, *(each.name for each in own)}
    handed_on = parameters(above) or () if above is not None and given.kwarg is not None else ()
    return (*own, *(each._replace(positional=False) for each in handed_on if each.name not in names))


def _arguments(takes: str) -> ast.arguments:
    made = ast.parse(f"def f({takes}): 0").body[0]
    assert isinstance(made, ast.FunctionDef)
    return made.args


def _own(given: ast.arguments) -> Iterator[Parameter]:
    missing = [None] * (len(given.args) - len(given.defaults))
    for argument, default in zip(given.args, [*missing, *given.defaults], strict=True):
        yield Parameter(argument.arg, ast.unparse(default) if default is not None else None, True)
    for argument, default in zip(given.kwonlyargs, given.kw_defaults, strict=True):
        yield Parameter(argument.arg, ast.unparse(default) if default is not None else None, False)
