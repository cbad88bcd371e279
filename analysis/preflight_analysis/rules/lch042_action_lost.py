"""LCH042: an action of a Python launch file whose variable gets another one before it is used (ROS 2)."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import NamedTuple

from preflight_analysis.documents.span import Span
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.python_source import PythonSource
from preflight_analysis.model.context import Context
from preflight_analysis.model.python_names import BoundNames
from preflight_analysis.rules.further_reading import FORMATS
from preflight_analysis.rules.rule import Rule

_ACTIONS = frozenset(
    {
        "ComposableNodeContainer", "DeclareLaunchArgument", "ExecuteProcess", "GroupAction", "IncludeLaunchDescription",
        "LifecycleNode", "LoadComposableNodes", "Node", "RegisterEventHandler", "SetEnvironmentVariable", "TimerAction",
    }
)  # fmt: skip


class _Lost(NamedTuple):
    name: str
    kind: str
    span: Span
    again: Span
    same: bool
    """Whether it is the very same action: the second one takes its place."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for path, launch_file in context.launch_files.items():
        for lost in _lost(launch_file) if launch_file.is_python else ():
            message = f"'{lost.name}' is assigned again before its first use: this {lost.kind} is never launched"
            yield rule.claim(
                f"{message}, the next one is the same" if lost.same else message,
                context.location(path, lost.span),
                subject=Subject("variable", lost.name),
                kind="duplicate" if lost.same else None,
                effect="style" if lost.same else None,
                related=(Related("assigned again here", context.location(path, lost.again)),),
            )


@derived
def _lost(launch_file: LaunchFile) -> tuple[_Lost, ...]:
    source = PythonSource(launch_file.document.text, launch_file.document.lines)
    if source.module is None:
        return ()
    names = BoundNames(source)
    return tuple(
        lost
        for node in ast.walk(source.module)
        if isinstance(node, (ast.Module, ast.FunctionDef, ast.If, ast.With))
        for lost in _in_block(source, names, node.body)
    )


def _in_block(source: PythonSource, names: BoundNames, block: list[ast.stmt]) -> Iterator[_Lost]:
    """Of two assignments in the same block the first one, if no statement between them speaks of the name."""
    waiting: dict[str, tuple[ast.Name, str, str]] = {}
    for statement in block:
        target = statement.targets[0] if isinstance(statement, ast.Assign) and len(statement.targets) == 1 else None
        made = names.made_by(statement.value) if isinstance(statement, ast.Assign) else None
        own = target if isinstance(target, ast.Name) else None
        for each in ast.walk(statement):
            if isinstance(each, ast.Name) and each is not own:
                waiting.pop(each.id, None)
        if own is None:
            continue
        before = waiting.pop(own.id, None)
        if made in _ACTIONS and isinstance(statement, ast.Assign):
            text = ast.dump(statement.value)
            if before is not None:
                first, kind, before_text = before
                yield _Lost(own.id, kind, source.whole_span(first), source.whole_span(own), before_text == text)
            waiting[own.id] = (own, str(made), text)


RULE = Rule(
    id="LCH042",
    name="action-lost",
    effect="no-effect",
    kind="unreachable",
    always=(Reason.FROM_SOURCE,),
    sometimes=("style",),
    what="Checks for an action in a Python launch file that is assigned to a variable which gets another action "
    "before its first use.",
    why="The name was copied with the line. The first node, process or include is never launched, and no tool "
    "reports it.",
    example='front = Node(package="camera", executable="front")\nfront = Node(package="camera", executable="rear")',
    instead='front = Node(package="camera", executable="front")\nrear = Node(package="camera", executable="rear")',
    references=(FORMATS,),
    generations=(2,),
    check=_check,
    in_branches=True,
)
