"""Code in which what is made of something unknown stays unknown where Python alone would lose it.

An f-string gives a plain text, `int` and `dict` want a real number and real pairs, `type` tells what stands in for the
value, and a dictionary has no item of a name that nobody knows. The code of a launch file, and of the modules of the
workspace, asks us in these places.
"""

from __future__ import annotations

import ast
import builtins
import importlib.machinery
import sys
import types
from typing import Any

from ..anything import Anything, asked, is_unknown, marked
from .base import RECORDER, is_own_file

_TEXT, _OF, _IN = "__preflight_text__", "__preflight_of__", "__preflight_in__"
_OF_VALUES = ("int", "float", "dict", "type")
_COLLECTIONS: tuple[type, ...] = (dict, list, tuple)
_SETS: tuple[type, ...] = (dict, set, frozenset, str, type({}.keys()))
"""Which tell whether something is in them without asking it."""


def compiled(text: Any, file: str) -> types.CodeType:
    """The code of a file; raises what `compile` raises."""
    tree = compile(text, file, "exec", ast.PyCF_ONLY_AST, dont_inherit=True)
    try:
        return compile(ast.fix_missing_locations(_Rewriter().visit(tree)), file, "exec", dont_inherit=True)
    except RecursionError:
        return compile(text, file, "exec", dont_inherit=True)


def install() -> None:
    """From now on the modules of the workspace are compiled so."""
    vars(builtins).update({_TEXT: marked, _OF: _of, _IN: _in})
    loader: Any = importlib.machinery.SourceFileLoader
    get_code = loader.get_code

    def code_of(self: Any, fullname: str) -> Any:
        if not is_own_file(self.path):
            return get_code(self, fullname)
        return compiled(self.get_data(self.path), self.path)

    loader.get_code = code_of


class _Rewriter(ast.NodeTransformer):
    def visit_JoinedStr(self, node: ast.JoinedStr) -> Any:
        self.generic_visit(node)
        return _call(_TEXT, node)

    def visit_FormattedValue(self, node: ast.FormattedValue) -> Any:
        node.value = self.visit(node.value)
        return node

    def visit_Subscript(self, node: ast.Subscript) -> Any:
        self.generic_visit(node)
        if isinstance(node.ctx, ast.Load) and not isinstance(node.slice, (ast.Constant, ast.Slice, ast.Tuple)):
            node.value = _call(_OF, node.value)
        return node

    def visit_Compare(self, node: ast.Compare) -> Any:
        self.generic_visit(node)
        if len(node.ops) == 1 and isinstance(node.ops[0], (ast.In, ast.NotIn)):
            node.comparators[0] = _call(_IN, node.comparators[0])
        return node

    def visit_Call(self, node: ast.Call) -> Any:
        self.generic_visit(node)
        if isinstance(node.func, ast.Attribute) and node.func.attr == "get":
            node.func.value = _call(_OF, node.func.value)
        elif isinstance(node.func, ast.Name) and node.func.id in _OF_VALUES:
            node.func = _call(_OF, node.func)
        return node


def _call(name: str, node: Any) -> ast.Call:
    return ast.copy_location(ast.Call(ast.copy_location(ast.Name(name, ast.Load()), node), [node], []), node)


class _Of:
    """A collection that is asked for something, which may be unknown."""

    def __init__(self, of: Any) -> None:
        self._of = of

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, Anything) and not isinstance(self._of, dict):
            return key[0]
        try:
            return self._of[key]
        except KeyError:
            if not _is_unknown(key):
                raise
        return Anything(f"[{key}]")

    def get(self, key: Any, *default: Any) -> Any:
        found = self._of.get(key, *default)
        if not _is_unknown(key) or key in self._of or not asked(str(key), sys._getframe(1), False):
            return found
        return Anything(f"get({key})")

    def __contains__(self, item: Any) -> bool:
        found = item in self._of
        return asked(str(item), sys._getframe(1), found) if _is_unknown(item) else found


def _of(thing: Any) -> Any:
    if isinstance(thing, type):
        return _MADE_OF_UNKNOWN.get(thing, thing)
    return _Of(thing) if type(thing) in _COLLECTIONS else thing


def _in(thing: Any) -> Any:
    return _Of(thing) if type(thing) in _SETS else thing


def _is_unknown(value: Any) -> bool:
    return isinstance(value, Anything) or is_unknown(value)


def _int(*args: Any, **kwargs: Any) -> Any:
    return Anything(f"int({args[0]})") if args and _is_unknown(args[0]) else int(*args, **kwargs)


def _float(*args: Any) -> Any:
    return Anything(f"float({args[0]})") if args and _is_unknown(args[0]) else float(*args)


def _dict(*args: Any, **kwargs: Any) -> Any:
    try:
        return dict(*args, **kwargs)
    except (TypeError, ValueError):
        if not RECORDER.unknown:
            raise
        return Anything("dict()")  # of pairs that nobody knows


def _type(*args: Any) -> Any:
    """Which type that is would be asked of the value: `type(x) == list` may hold or not."""
    return Anything(f"type({args[0]})") if len(args) == 1 and isinstance(args[0], Anything) else type(*args)


_MADE_OF_UNKNOWN: dict[type, Any] = {int: _int, float: _float, dict: _dict, type: _type}
