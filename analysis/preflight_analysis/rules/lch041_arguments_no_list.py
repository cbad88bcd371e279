"""LCH041: arguments of a process that are no list: one text, of which each character is one, or a set (ROS 2)."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from preflight_analysis.documents.span import Span
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.python_source import python_source
from preflight_analysis.model.context import Context
from preflight_analysis.model.python_names import bound_names
from preflight_analysis.rules.further_reading import FORMATS, NODE_ARGUMENTS
from preflight_analysis.rules.rule import Rule

_TAKE_LISTS = {
    "ComposableNodeContainer": ("arguments", "ros_arguments"),
    "ExecuteLocal": ("cmd",),
    "ExecuteProcess": ("cmd",),
    "LifecycleNode": ("arguments", "ros_arguments"),
    "Node": ("arguments", "ros_arguments"),
}


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for path, launch_file in context.launch_files.items():
        for span, message in _no_lists(launch_file) if launch_file.is_python else ():
            yield rule.claim(message, context.location(path, span), subject=Subject("keyword", message))


@derived
def _no_lists(launch_file: LaunchFile) -> tuple[tuple[Span, str], ...]:
    source = python_source(launch_file.document)
    if source.module is None:
        return ()
    names = bound_names(launch_file.document)
    found: list[tuple[Span, str]] = []
    for node in source.nodes:
        made = names.made_by(node) if isinstance(node, ast.Call) else None
        for keyword in node.keywords if isinstance(node, ast.Call) and made is not None else ():
            why = _problem(keyword.value) if keyword.arg in _TAKE_LISTS.get(made or "", ()) else None
            if why is not None:
                found.append((source.whole_span(keyword.value), f"'{keyword.arg}' requires a list: {why}"))
    return tuple(found)


def _problem(given: ast.expr) -> str | None:
    text = isinstance(given, ast.Constant) and isinstance(given.value, str) and len(given.value) > 1
    if text or isinstance(given, ast.JoinedStr):
        return "each character of a text becomes one argument"
    if isinstance(given, ast.Set) and len(given.elts) > 1:
        return "the order of a set differs at each launch"
    return None


RULE = Rule(
    id="LCH041",
    name="arguments-no-list",
    effect="stops-node",
    kind="invalid",
    what="Checks for `arguments=` of a node, or `cmd=` of a process, that is a single text or a set instead of a list.",
    why="launch iterates over the value. Each character of a text becomes one argument. The items of a set come in "
    "another order at each launch, so options lose their values.",
    example='Node(package="tf2_ros", executable="static_transform_publisher", arguments="0 0 0 0 0 0 map odom")',
    instead='Node(package="tf2_ros", executable="static_transform_publisher",\n'
    '     arguments=["--frame-id", "map", "--child-frame-id", "odom"])',
    references=(
        FORMATS,
        NODE_ARGUMENTS,
    ),
    generations=(2,),
    check=_check,
    in_branches=True,
)
