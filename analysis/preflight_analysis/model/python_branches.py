"""Nodes that a Python launch file makes in a branch that this launch need not take."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from itertools import combinations

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Span
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.python_api import PROCESSES
from preflight_analysis.launch.python_source import python_source, walk

_HOLDERS = frozenset({"LaunchDescription", "append", "extend", "add_action"})
"""Calls that change nothing of a node that they get."""
_MOST_NODES = 500


@dataclass(frozen=True, slots=True)
class Twice:
    """Two nodes of a function with one name: where both names are, and the test under which there are both."""

    first: Span
    second: Span
    test: str


@dataclass(frozen=True, slots=True)
class _Made:
    name: ast.expr
    key: str
    """Name and namespace as they are written."""
    arms: tuple[tuple[int, int], ...]
    """The branches that it is in, the outermost first."""
    test: ast.expr | None
    """That of the innermost."""
    target: str | None
    """The variable that it, or the list that it is in, is assigned to."""


@derived
def made_twice(launch_file: LaunchFile) -> tuple[Twice, ...]:
    """The pairs of nodes of which one is made always, and the other one of its name only in a branch."""
    source = python_source(launch_file.document)
    found: list[Twice] = []
    for function in source.nodes if source.module is not None else ():
        if not isinstance(function, ast.FunctionDef):
            continue
        all_made = list(_in_block(function.body, (), None))
        if not any(each.arms for each in all_made):
            continue
        assigned = [n.id for n in walk(function) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)]
        made = [each for each in all_made if _is_fixed(each.name, assigned)][:_MOST_NODES]
        for one, other in combinations(made, 2):
            outer, inner = sorted((one, other), key=lambda each: len(each.arms))
            below = len(outer.arms) < len(inner.arms) and inner.arms[: len(outer.arms)] == outer.arms
            instead = outer.target is not None and outer.target == inner.target
            if below and one.key == other.key and not instead and inner.test is not None:
                spans = source.whole_span(outer.name), source.whole_span(inner.name)
                found.append(Twice(*spans, ast.unparse(inner.test)))
    return tuple(found)


def _is_fixed(name: ast.expr, assigned: Sequence[str]) -> bool:
    """Whether the expression is the same text wherever it stands in the function."""
    names = [node.id for node in ast.walk(name) if isinstance(node, ast.Name)]
    plain = all(isinstance(node, (ast.Constant, ast.Name, ast.expr_context)) for node in ast.walk(name))
    return plain and all(assigned.count(each) <= 1 for each in names)


def _in_block(body: Sequence[ast.stmt], arms: tuple[tuple[int, int], ...], test: ast.expr | None) -> Iterator[_Made]:
    for at, statement in enumerate(body):
        if isinstance(statement, ast.If):
            yield from _in_block(statement.body, (*arms, (id(statement), 0)), statement.test)
            yield from _in_block(statement.orelse, (*arms, (id(statement), 1)), None)
            if _leaves(statement):
                # What follows is another branch.
                yield from _in_block(body[at + 1 :], (*arms, (id(statement), 2)), None)
                return
        elif isinstance(statement, (ast.Assign, ast.Expr, ast.Return, ast.AugAssign)):
            target = statement.targets[0] if isinstance(statement, ast.Assign) else None
            if statement.value is not None:
                for call in _nodes_in(statement.value):
                    yield from _made(call, arms, test, ast.unparse(target) if target is not None else None)


def _leaves(statement: ast.If) -> bool:
    return any(isinstance(node, (ast.Return, ast.Raise)) for node in ast.walk(statement))


def _nodes_in(value: ast.expr) -> Iterator[ast.Call]:
    """The nodes that an expression makes and hands on as they are."""
    if isinstance(value, (ast.List, ast.Tuple)):
        for each in value.elts:
            yield from _nodes_in(each)
    elif isinstance(value, ast.Call):
        name = value.func.attr if isinstance(value.func, ast.Attribute) else getattr(value.func, "id", "")
        if name in PROCESSES:
            yield value
        elif name in _HOLDERS:
            for each in value.args:
                yield from _nodes_in(each)


def _made(
    call: ast.Call, arms: tuple[tuple[int, int], ...], test: ast.expr | None, target: str | None
) -> Iterator[_Made]:
    given = {keyword.arg: keyword.value for keyword in call.keywords}
    name, namespace = given.get("name"), given.get("namespace")
    if name is None or None in given or "condition" in given:
        return
    key = f"{ast.dump(name)} {ast.dump(namespace) if namespace is not None else ''}"
    yield _Made(name, key, arms, test, target)
