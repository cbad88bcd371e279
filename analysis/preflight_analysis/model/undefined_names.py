"""The names in a Python file that nothing in it defines."""

from __future__ import annotations

import ast
import builtins
import symtable
from collections.abc import Iterator

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.python_source import PythonSource, python_source
from preflight_analysis.model.nearest import nearest

_KNOWN = {*dir(builtins), "__file__", "__path__", "__annotations__", "WindowsError"}
_MADE_AT_RUN_TIME = ("globals", "vars", "locals", "exec", "eval", "setattr")
"""What may define names that the text does not."""
_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)
_SCOPES = (
    ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.Lambda, ast.ListComp, ast.SetComp, ast.DictComp,
    ast.GeneratorExp,
)  # fmt: skip


@derived
def undefined_names(document: Document) -> tuple[tuple[str, str | None, Span, bool], ...]:
    """The names, each with what was probably meant, its first place, and whether the file speaks of its function."""
    source = python_source(document)
    if source.module is None:
        return ()
    try:
        top = symtable.symtable(source.text, document.path, "exec")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return ()
    tables = [*_tables(top)]
    defined = {s.get_name() for s in top.get_symbols() if s.is_assigned() or s.is_imported() or s.is_namespace()}
    defined |= {s.get_name() for t in tables for s in t.get_symbols() if s.is_declared_global() and s.is_assigned()}
    outside = [
        (symbol.get_name(), table)
        for table in tables
        for symbol in table.get_symbols()
        if symbol.is_referenced() and (symbol.is_global() or (table is top and not symbol.is_local()))
    ]
    within: dict[str, list[symtable.SymbolTable]] = {}
    for name, table in outside:
        if name not in defined and name not in _KNOWN:
            within.setdefault(name, []).append(table)
    missing = [(name, t.get_lineno() if t is not top else 0) for name, those in within.items() for t in those]
    if not missing or _is_open(source):
        return ()
    noted = {id(inner) for each in source.nodes for note in _notes(each) for inner in ast.walk(note)}
    scopes: dict[int, ast.AST] = {0: source.module}
    for node in source.nodes:
        if isinstance(node, _SCOPES):
            scopes.setdefault(node.lineno, node)
    places: dict[str, ast.Name] = {}
    for name, line in missing:
        for node in ast.walk(scopes.get(line, source.module)):
            if isinstance(node, ast.Name) and node.id == name and id(node) not in noted:
                first = places.setdefault(name, node)
                if (node.lineno, node.col_offset) < (first.lineno, first.col_offset):
                    places[name] = node
    idle = [scopes[line] for _, line in missing if isinstance(scopes.get(line), _FUNCTIONS)]
    idle = [each for each in idle if not _is_spoken_of(source.module, each)]
    idle += [each for each in source.module.body if isinstance(each, ast.If) and _is_of_a_program(each.test)]
    unused = {id(inner) for each in idle for inner in ast.walk(each)}
    return tuple(
        (name, nearest(name, defined | _own(within[name])), source.whole_span(node), id(node) not in unused)
        for name, node in sorted(places.items())
    )


def _own(tables: list[symtable.SymbolTable]) -> set[str]:
    """The names of the one function that asks for a name; where several do, none is there for all."""
    symbols = tables[0].get_symbols() if len(tables) == 1 else ()
    return {each.get_name() for each in symbols if each.is_local()}


def _is_spoken_of(module: ast.Module, function: ast.AST) -> bool:
    name = getattr(function, "name", "")
    return name == "generate_launch_description" or any(
        isinstance(node, ast.Name) and node.id == name for node in ast.walk(module)
    )


def _is_of_a_program(test: ast.expr) -> bool:
    """`__name__ == "__main__"`, which no launch makes true."""
    return isinstance(test, ast.Compare) and isinstance(test.left, ast.Name) and test.left.id == "__name__"


def _tables(table: symtable.SymbolTable) -> Iterator[symtable.SymbolTable]:
    yield table
    for child in table.get_children():
        yield from _tables(child)


def _is_open(source: PythonSource) -> bool:
    """Whether more names may be there than the text tells."""
    for node in source.nodes:
        if isinstance(node, ast.ImportFrom) and any(alias.name == "*" for alias in node.names):
            return True
        if isinstance(node, ast.Name) and node.id in _MADE_AT_RUN_TIME:
            return True
        if isinstance(node, ast.ExceptHandler) and "NameError" in ast.dump(node.type or node):
            return True
    return False


def _notes(node: ast.AST) -> Iterator[ast.AST]:
    """Annotations, which newer versions of Python do not look up."""
    for each in (getattr(node, "annotation", None), getattr(node, "returns", None)):
        if isinstance(each, ast.AST):
            yield each
