"""What is in the description that `generate_launch_description` returns, whatever happens: known without a run."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Span
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.python_api import PROCESSES
from preflight_analysis.launch.python_source import PythonSource, last_name, python_source

_MAX_DEPTH = 20
_NODES = frozenset(f"launch_ros.actions.{name}" for name in PROCESSES)
_DESCRIPTIONS = frozenset({"launch.LaunchDescription", "launch.launch_description.LaunchDescription"})
_ADDS = frozenset({"add_action", "add_entity", "append", "extend"})
_KEEP_NAMESPACE = frozenset(
    {
        *("DeclareLaunchArgument", "SetEnvironmentVariable", "AppendEnvironmentVariable", "ExecuteProcess", "LogInfo"),
        *("RegisterEventHandler", "TimerAction"),
    }
)
"""Actions after which nodes are in the namespace that they were in before."""


@dataclass(frozen=True, slots=True)
class SameName:
    """Two nodes of one name and namespace, by the places of the names of their classes."""

    first: Span
    second: Span


@derived
def always_twice(launch_file: LaunchFile) -> tuple[SameName, ...]:
    """The nodes that are started whatever happens, and have the literal name of one before them."""
    source = python_source(launch_file.document)
    first: dict[tuple[str, str], ast.Call] = {}
    found: list[SameName] = []
    written = [key for node in source.nodes if isinstance(node, ast.Call) and (key := _name_of(source, node))]
    if len(written) == len(set(written)):
        return ()
    for item in _Description(source).items():
        if item is None:
            first.clear()
        elif (key := _name_of(source, item)) is not None:
            other = first.setdefault(key, item)
            if other is not item:
                found.append(SameName(source.name_span(other), source.name_span(item)))
    return tuple(found)


def _name_of(source: PythonSource, call: ast.Call) -> tuple[str, str] | None:
    """Name and namespace of a node, where both are literals."""
    given = {keyword.arg: keyword.value for keyword in call.keywords}
    if None in given or "condition" in given or "name" not in given:
        return None
    texts = [source.resolved(given.get(each, ast.Constant(""))) for each in ("name", "namespace")]
    name, namespace = (each.value if isinstance(each, ast.Constant) else None for each in texts)
    return (name, namespace) if isinstance(name, str) and isinstance(namespace, str) else None


class _Description:
    def __init__(self, source: PythonSource) -> None:
        self._source = source
        functions = source.module.body if source.module is not None else ()
        self._body: list[ast.stmt] = next(
            (f.body for f in functions if isinstance(f, ast.FunctionDef) and f.name == "generate_launch_description"),
            [],
        )

    def items(self) -> Iterator[ast.Call | None]:
        """The nodes in their order; None for what may put those after it into another namespace, or is not known."""
        last = self._body[-1] if self._body else None
        if isinstance(last, ast.Return) and last.value is not None and id(last) in self._source.sure:
            yield from self._in(last.value, 0)

    def _in(self, value: ast.expr, depth: int) -> Iterator[ast.Call | None]:
        written = self._source.resolved(value)
        if depth > _MAX_DEPTH or id(written) not in self._source.sure:
            yield None
        elif isinstance(written, (ast.List, ast.Tuple)):
            for each in written.elts:
                yield from self._in(each.value if isinstance(each, ast.Starred) else each, depth + 1)
        elif isinstance(written, ast.BinOp) and isinstance(written.op, ast.Add):
            yield from self._in(written.left, depth + 1)
            yield from self._in(written.right, depth + 1)
        elif isinstance(written, ast.Call):
            yield from self._made(written, depth)
        else:
            yield None
        holds = not isinstance(written, ast.Call) or self._source.full_name(written.func) in _DESCRIPTIONS
        if isinstance(value, ast.Name) and written is not value and holds:
            yield from self._added(value.id, depth)

    def _made(self, call: ast.Call, depth: int) -> Iterator[ast.Call | None]:
        name = self._source.full_name(call.func) or ""
        if name in _DESCRIPTIONS:
            given = [*call.args, *(k.value for k in call.keywords if k.arg == "initial_entities")]
            for each in given[:1]:
                yield from self._in(each, depth + 1)
        elif name in _NODES:
            yield call
        elif name.rpartition(".")[2] not in _KEEP_NAMESPACE:
            yield None

    def _added(self, name: str, depth: int) -> Iterator[ast.Call | None]:
        """What statements add to a list or description that is kept in a variable."""
        for statement in self._body:
            adds = statement.value if isinstance(statement, ast.Expr) else None
            method = adds.func if isinstance(adds, ast.Call) and isinstance(adds.func, ast.Attribute) else None
            if isinstance(adds, ast.Call) and method is not None and last_name(method.value) == name:
                if id(adds) in self._source.sure and len(adds.args) == 1 and method.attr in _ADDS:
                    yield from self._in(adds.args[0], depth + 1)
                else:
                    yield None
            elif not isinstance(statement, (ast.Assign, ast.Return)) and _names(statement, name):
                yield None


def _names(statement: ast.stmt, name: str) -> bool:
    return any(isinstance(node, ast.Name) and node.id == name for node in ast.walk(statement))
