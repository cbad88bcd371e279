"""The names that a module of Python has once it is imported."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator

from preflight_analysis.documents.document import Document
from preflight_analysis.incremental.derived import derived


@derived
def names_of_module(document: Document) -> frozenset[str] | None:
    """What the module defines, assigns and imports; None where that cannot be told."""
    try:
        body = ast.parse(document.text).body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None
    found = frozenset(_names(body))
    return None if "*" in found or "__getattr__" in found else found


@derived
def runs_when_imported(document: Document) -> bool:
    """Whether the module is a program as a whole: it starts what it does outside of any function."""
    try:
        body = ast.parse(document.text).body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return False
    return any(isinstance(each, ast.Expr) and isinstance(each.value, ast.Call) and _starts(each.value) for each in body)


def _starts(call: ast.Call) -> bool:
    name = call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")
    return "spin" in name or name in ("main", "run")


def _names(body: Iterable[ast.stmt]) -> Iterator[str]:
    for statement in body:
        match statement:
            case ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name) | ast.ClassDef(name=name):
                yield name
            case ast.Import(names=names) | ast.ImportFrom(names=names):
                yield from (alias.asname or alias.name.partition(".")[0] for alias in names)
            case ast.If() | ast.For() | ast.While() | ast.With() | ast.Try():
                for part in ("body", "orelse", "finalbody"):
                    yield from _names(getattr(statement, part, ()))
                for handler in getattr(statement, "handlers", ()):
                    yield from _names(handler.body)
            case ast.Expr(value=ast.Call(func=ast.Name(id="exec" | "globals"))):
                yield "*"
        # An assignment, also by `:=` or within a `for`.
        if not isinstance(statement, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            for node in ast.walk(statement):
                if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
                    yield node.id
