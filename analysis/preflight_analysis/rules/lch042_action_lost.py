"""LCH042: an action that a Python launch file makes and never launches (ROS 2)."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from collections.abc import Set as AbstractSet
from typing import NamedTuple

from preflight_analysis.documents.span import Span
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Alike, Finding, Related
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.python_source import PythonSource, python_source
from preflight_analysis.model.context import Context
from preflight_analysis.model.python_names import BoundNames, bound_names
from preflight_analysis.rules.further_reading import FORMATS
from preflight_analysis.rules.rule import Rule

_ACTIONS = frozenset(
    {
        "ComposableNodeContainer", "DeclareLaunchArgument", "ExecuteProcess", "GroupAction", "IncludeLaunchDescription",
        "LifecycleNode", "LoadComposableNodes", "Node", "RegisterEventHandler", "SetEnvironmentVariable", "TimerAction",
    }
)  # fmt: skip


_ASKS_FOR_NAMES = frozenset({"locals", "globals", "vars", "eval", "exec"})


_OF_A_MENU = say("actions of this file are never launched")


class _Lost(NamedTuple):
    name: str
    """That of its variable, "" where it has none."""
    kind: str
    span: Span
    again: Span | None = None
    """Where the variable gets another action."""
    same: bool = False
    """Whether it is the very same action: the second one takes its place."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for path, launch_file in context.launch_files.items():
        for lost in _lost(launch_file) if launch_file.is_python else ():
            again = (Related("assigned again here", context.location(path, lost.again)),) if lost.again else ()
            is_unused = bool(lost.name) and lost.again is None
            yield rule.claim(
                say(_why(lost), name=lost.name, kind=lost.kind),
                context.location(path, lost.span),
                subject=Subject("variable", lost.name) if lost.name else Subject("action", lost.kind),
                kind="duplicate" if lost.same else None,
                effect="style" if lost.same else None,
                doubts=doubts(INTENDED=is_unused),
                related=again,
                alike=Alike(_OF_A_MENU, lost.name) if is_unused else None,
            )


def _why(lost: _Lost) -> str:
    if not lost.name:
        return "'{kind}' is not part of the launch description: it is never launched"
    if lost.again is None:
        return "'{name}' is not used: this {kind} is never launched"
    said = "'{name}' is assigned again before its first use: this {kind} is never launched"
    return f"{said}, the next one is the same" if lost.same else said


@derived
def _lost(launch_file: LaunchFile) -> tuple[_Lost, ...]:
    source = python_source(launch_file.document)
    if source.module is None:
        return ()
    names = bound_names(launch_file.document)
    blocks = [node.body for node in source.nodes if isinstance(node, (ast.Module, ast.FunctionDef, ast.If, ast.With))]
    again = [lost for block in blocks for lost in _in_block(source, names, block)]
    loaded = {node.id for node in source.nodes if isinstance(node, ast.Name) and _is_used(node)}
    bare = [lost for block in blocks for lost in _bare(source, names, block, loaded)]
    return (*again, *bare)


def _is_used(node: ast.Name) -> bool:
    return not isinstance(node.ctx, ast.Store)


def _bare(source: PythonSource, names: BoundNames, block: list[ast.stmt], used: AbstractSet[str]) -> Iterator[_Lost]:
    """Actions that no statement can come back to: a call by itself, and what is in a variable that the file never uses.
    One that a comment names was taken out on purpose."""
    for statement in block:
        value = statement.value if isinstance(statement, (ast.Expr, ast.Assign)) else None
        made = names.made_by(value) if isinstance(value, ast.Call) else None
        if made not in _ACTIONS:
            continue
        if isinstance(statement, ast.Expr):
            yield _Lost("", made, source.whole_span(statement.value))
        elif isinstance(statement, ast.Assign) and not _ASKS_FOR_NAMES.isdisjoint(used):
            continue
        elif isinstance(statement, ast.Assign) and all(isinstance(each, ast.Name) for each in statement.targets):
            own = [each for each in statement.targets if isinstance(each, ast.Name)]
            commented = any(re.search(rf"#.*\b{re.escape(each.id)}\b", source.text) for each in own)
            if not commented and used.isdisjoint(each.id for each in own):
                yield _Lost(own[0].id, made, source.whole_span(own[0]))


def _in_block(source: PythonSource, names: BoundNames, block: list[ast.stmt]) -> Iterator[_Lost]:
    """Of two assignments in the same block the first one, if no statement between them speaks of the name."""
    waiting: dict[str, tuple[ast.Name, str, str]] = {}
    for statement in block:
        target = statement.targets[0] if isinstance(statement, ast.Assign) and len(statement.targets) == 1 else None
        made = names.made_by(statement.value) if isinstance(statement, ast.Assign) else None
        own = target if isinstance(target, ast.Name) else None
        for each in ast.walk(statement) if waiting else ():
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
    sometimes=("style", Reason.INTENDED),
    what="Checks for an action that a Python launch file makes and never launches. No list has it, or its variable "
    "gets another action before its first use.",
    why="The node, process or include is never launched, and no tool reports it. Often a name was copied with a line.",
    example='front = Node(package="camera", executable="front")\nfront = Node(package="camera", executable="rear")',
    instead='front = Node(package="camera", executable="front")\nrear = Node(package="camera", executable="rear")',
    references=(FORMATS,),
    generations=(2,),
    check=_check,
    in_branches=True,
)
