"""PRM017: a parameter outside of the range that its node declares (ROS 2)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from textwrap import shorten

from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.findings.claim import Text, say
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.rules.further_reading import PARAMETERS, PARAMETERS_DESIGN
from preflight_analysis.rules.refusals import OF_REFUSALS, refusal
from preflight_analysis.rules.rule import Rule
from preflight_analysis.tracing.interface import ParamUse, Range

_OUTSIDE = "parameter '{name}' is {value}, {outside}: {node} declares {range} and exits"
_REFUSED = "parameter '{name}' is {value}, which {node} refuses, and exits: {quoted}"
_CLOSE = 1e-6
"""As a part of the value; the client libraries are stricter."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    reported: set[tuple[object, ...]] = set()
    for node, interface in zip(graph.tree.nodes, graph.interfaces, strict=True) if graph is not None else ():
        if not node.params:
            continue
        declared = {u.name.removeprefix("~"): u for u in interface.params if u.access == "get" and not u.dynamic}
        for param in node.params:
            use = declared.get(param.name)
            why = _wrong(param, use, node) if use is not None else None
            at = param.place, why
            if use is None or why is None or at in reported:
                continue
            reported.add(at)
            yield refusal(rule, node, param, use, why.followed_by(" (InvalidParameterValueException)"))


def _wrong(param: Param, use: ParamUse, node: LaunchNode) -> Text | None:
    """What is wrong with the value; None if nothing is."""
    value = shorten(str(param.value), 60, placeholder="...")
    outside = _outside(param.value, use.range) if use.range and _is_of_its_type(param.value, use) else None
    if outside is not None:
        return say(_OUTSIDE, name=param.name, value=value, outside=outside, node=node.name, range=use.range)
    if use.refused is None or use.type is not None or use.mandatory:
        return None
    return say(_REFUSED, name=param.name, value=value, node=node.name, quoted=use.refused)


def _is_of_its_type(value: object, use: ParamUse) -> bool:
    """Whether it has the type that is declared; the range is looked at after that, and only for single numbers."""
    wanted = {"integer": int, "double": float}.get(use.type) if use.type else type(use.default)
    return wanted in (int, float) and type(value) is wanted


def _outside(value: float, allowed: Range) -> str | None:
    """Why the value is not allowed; None if it is. Both ends of the range are, whatever the steps."""
    if _is_close(value, allowed.low) or _is_close(value, allowed.high):
        return None
    if not allowed.low <= value <= allowed.high:
        return "out of range"
    if not allowed.step:
        return None
    try:
        nearest = allowed.low + round((value - allowed.low) / allowed.step) * allowed.step
    except OverflowError:
        return None  # so many steps that any value is one of them
    return None if _is_close(value, nearest) else "between the steps"


def _is_close(value: float, other: float) -> bool:
    return value == other or (isinstance(value, float) and math.isclose(value, other, rel_tol=_CLOSE, abs_tol=1e-12))


RULE = Rule(
    id="PRM017",
    name="parameter-out-of-range",
    effect="stops-node",
    kind="invalid",
    sometimes=(*OF_REFUSALS, Reason.NOT_GIVEN),
    of_param=True,
    what="Checks for a number outside of the range, or between the steps, of the descriptor with which the node "
    "declares the parameter.",
    why="rclcpp and rclpy raise InvalidParameterValueException in `declare_parameter`, and most nodes exit.",
    example="<!-- declare_parameter('rate', 10, ParameterDescriptor(integer_range=\n"
    "       [IntegerRange(from_value=1, to_value=50)])) -->\n"
    '<param name="rate" value="100"/>',
    instead='<param name="rate" value="50"/>',
    references=(
        PARAMETERS,
        PARAMETERS_DESIGN,
    ),
    settings=("nodes",),
    generations=(2,),
    check=_check,
    needs_graph=True,
)
