"""What a node of ROS 2 that ended says of the parameter that it ended for.

The constructor of a node declares parameters, and most nodes end where one has another type than is declared, is out of
range, or has to be set and is not: before the node publishes that parameter, or anything at all.
"""

from __future__ import annotations

import re

from preflight_analysis.tracing.interface import Outcome, ParamUse, telling_line

_NAME = r"'(?P<name>[^']{1,200})'"
_TYPE = r"(?P<type>(?:bool|integer|double|string|byte)(?:_array)?)"
_OTHER_TYPE = (
    re.compile(
        rf"parameter {_NAME} has invalid type: Wrong parameter type, .*? is of type {{{_TYPE}}}, setting it to "
    ),
    re.compile(rf"parameter {_NAME} has invalid type: expected \[{_TYPE}\] got \[(?!not set)"),
    re.compile(rf"Trying to set parameter {_NAME} to '.*' of type '\w+', expecting type '{_TYPE}'", re.IGNORECASE),
)
"""What rclcpp says, of two versions, and rclpy."""
_BAD_VALUE = re.compile(rf"parameter {_NAME} could not be set: (?P<why>.+)")
_UNSET = (
    re.compile(rf"Statically typed parameter {_NAME} must be initialized"),
    re.compile(rf"[Pp]arameter {_NAME} is not initialized"),
    re.compile(rf"parameter {_NAME} has invalid type: expected \[{_TYPE}\] got \[not set\]"),
)


def refused_param(outcome: Outcome) -> ParamUse | None:
    """The parameter that the node ended for, with what it said; None where it did not end for one."""
    if outcome.status != "crashed":
        return None
    said = telling_line(outcome.stderr_tail)
    for pattern in _OTHER_TYPE:
        found = pattern.search(said)
        if found is not None:
            return ParamUse(f"~{found['name']}", "get", type=found["type"].lower().replace("_", " "), refused=said)
    found = _BAD_VALUE.search(said)
    if found is not None:
        return ParamUse(f"~{found['name']}", "get", refused=found["why"])
    for pattern in _UNSET:
        found = pattern.search(said)
        if found is not None:
            return ParamUse(f"~{found['name']}", "get", mandatory=True, refused=said)
    return None
