"""What the names of a Python launch file stand for that are bound in one place only."""

from __future__ import annotations

import ast
from collections import Counter

from preflight_analysis.documents.document import Document
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.python_source import PythonSource, python_source


class BoundNames:
    """The names of a file, as far as it tells what they stand for: one that is bound in several places, or is an
    argument of a function somewhere, may be anything, and so may what no module of launch has."""

    def __init__(self, source: PythonSource) -> None:
        bound: Counter[str] = Counter()
        self._imported: set[str] = set()
        for node in source.nodes:
            if isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Load):
                bound[node.id] += 1
            elif isinstance(node, ast.arg):
                bound[node.arg] += 2
            elif isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
                bound[node.name] += 1
            elif isinstance(node, (ast.Import, ast.ImportFrom)):
                module = node.module or "" if isinstance(node, ast.ImportFrom) else ""
                for alias in node.names:
                    bound[alias.asname or alias.name] += 1
                    if "launch" in f"{module}.{alias.name}":
                        self._imported.add(alias.asname or alias.name)
        self._values = {name: value for name, value in source.assigned.items() if bound[name] == 1}
        self._bound = bound

    def value_of(self, node: ast.expr) -> ast.expr | None:
        """What a name stands for, None if that may be anything; any other expression is itself."""
        return self._values.get(node.id) if isinstance(node, ast.Name) else node

    def made_by(self, node: ast.expr) -> str | None:
        """The class of `launch` whose call a value is, as it is written or by its name; None for all else."""
        value = self.value_of(node)
        if not isinstance(value, ast.Call):
            return None
        called = value.func
        if isinstance(called, ast.Name):
            return called.id if called.id in self._imported and self._bound[called.id] == 1 else None
        return called.attr if isinstance(called, ast.Attribute) and self._is_module(called.value) else None

    def _is_module(self, node: ast.expr) -> bool:
        """Whether it is a module that is imported, or one within such a one: `launch.conditions`."""
        while isinstance(node, ast.Attribute):
            node = node.value
        return isinstance(node, ast.Name) and (
            node.id in self._imported or any(name.startswith(f"{node.id}.") for name in self._imported)
        )


@derived
def bound_names(document: Document) -> BoundNames:
    """Those of a document, once for all who ask."""
    return BoundNames(python_source(document))
