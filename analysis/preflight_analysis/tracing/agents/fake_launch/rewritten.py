"""Code in which what is made of something unknown stays unknown where Python alone would lose it.

An f-string gives a plain text, `int` and `dict` want a real number and real pairs, `type` and `isinstance` tell what
stands in for the value, a dictionary has no item of a name that nobody knows, and nobody knows how many parts a text
has, or what `**` of a mapping gives a call. The code of a launch file, and of the modules of the workspace, asks us in
these places.
"""

from __future__ import annotations

import ast
import builtins
import importlib.machinery
import inspect
import sys
import types
from typing import Any, Iterator

from ..anything import BEGIN, AnyModule, Anything, asked, is_unknown, marked, unknown_text
from .base import RECORDER, is_own_file

_TEXT, _OF, _IN = "__preflight_text__", "__preflight_of__", "__preflight_in__"
_PARTS, _EACH = "__preflight_parts__", "__preflight_each__"
_WITH, _MORE = "__preflight_with__", "__preflight_more__"
_CALLED, _AS_TEXT, _MODULE = "__preflight_called__", "__preflight_as_text__", "__preflight_module__"
_AS_CODE, _VALUE = "__preflight_as_code__", "__preflight_value__"
_OF_VALUES = ("int", "float", "dict", "type", "isinstance")
_GIVEN = {"map": _CALLED, "eval": _AS_CODE}
"""Functions of which the first argument is asked."""
_OF_TEXTS = ("join", "replace", "startswith", "endswith", "write", "writelines")
"""Methods that want texts."""
_COLLECTIONS: tuple[type, ...] = (dict, list, tuple)
_PLAIN: tuple[type, ...] = (str, int, float, bool)
_PASSED: tuple[type, ...] = (list, tuple, map, types.GeneratorType)
"""What a text is taken apart with."""
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
    values = {_TEXT: marked, _OF: _of, _IN: _in, _PARTS: _parts, _EACH: _each, _AS_TEXT: _as_text}
    calls = {_CALLED: _called, _WITH: _with, _MORE: _more, _MODULE: AnyModule, _AS_CODE: _as_code}
    vars(builtins)[_VALUE] = Anything("eval()")
    vars(builtins).update({**values, **calls})
    loader: Any = importlib.machinery.SourceFileLoader
    get_code = loader.get_code

    def code_of(self: Any, fullname: str) -> Any:
        if is_unknown(self.path):
            return compile(f"__getattr__ = {_MODULE}(__name__).__getattr__", self.path, "exec")
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
        if isinstance(node.ctx, ast.Load) and not isinstance(node.slice, (ast.Slice, ast.Tuple)):
            node.value = _call(_OF, node.value)
        return node

    def visit_Assign(self, node: ast.Assign) -> Any:
        self.generic_visit(node)
        count = _count(node.targets[0]) if len(node.targets) == 1 else 0
        if count and not isinstance(node.value, (ast.Tuple, ast.List)):
            node.value = _call(_PARTS, node.value, count)
        return node

    def visit_For(self, node: ast.For) -> Any:
        self.generic_visit(node)
        return _with_parts(node)

    def visit_comprehension(self, node: ast.comprehension) -> Any:
        self.generic_visit(node)
        return node if node.is_async else _with_parts(node)

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
            node.func = _call(_CALLED, node.func)
        elif isinstance(node.func, ast.Name) and node.func.id in _GIVEN and node.args:
            node.args[0] = _call(_GIVEN[node.func.id], node.args[0])
        elif isinstance(node.func, ast.Attribute) and node.func.attr in _OF_TEXTS:
            node.args = [each if isinstance(each, ast.Starred) else _call(_AS_TEXT, each) for each in node.args]
        more = [each for each in node.keywords if each.arg is None]
        for each in more:
            each.value = _call(_MORE, each.value)
        starred = any(isinstance(each, ast.Starred) for each in node.args)
        if more or starred:
            node.func = _call(_WITH, node.func, int(starred))
        return node


def _call(name: str, node: Any, *numbers: int) -> ast.Call:
    of = [node, *(ast.copy_location(ast.Constant(number), node) for number in numbers)]
    return ast.copy_location(ast.Call(ast.copy_location(ast.Name(name, ast.Load()), node), of, []), node)


def _count(target: Any) -> int:
    """How many parts a value is taken apart to; 0 if it is not, or to any number."""
    if not isinstance(target, (ast.Tuple, ast.List)) or any(isinstance(each, ast.Starred) for each in target.elts):
        return 0
    return len(target.elts)


def _with_parts(loop: Any) -> Any:
    count = _count(loop.target)
    if count:
        loop.iter = _call(_EACH, loop.iter, count)
    return loop


def _parts(value: Any, count: int) -> Any:
    """What is taken apart to `count` values. Of what is made of a text that is not known nobody knows how many parts it
    has."""
    if isinstance(value, str):
        return [unknown_text(value)] * count if is_unknown(value) else value
    if type(value) not in _PASSED:
        return value
    parts = list(value)
    if len(parts) == count or not any(map(_is_unknown, parts)):
        return parts
    first = next(filter(_is_unknown, parts))
    return [first] * count


def _each(values: Any, count: int) -> Any:
    return _taken_apart(values, count) if type(values) in _PASSED else values


def _taken_apart(values: Any, count: int) -> Iterator[Any]:
    for value in values:
        yield _parts(value, count)


def _more(given: Any) -> Any:
    """What `**` gives to a call."""
    return {str(given): given} if isinstance(given, Anything) else given


def _as_text(value: Any) -> Any:
    """A text, or texts, with those that nobody knows among them."""
    if isinstance(value, Anything):
        return str(value)
    if type(value) not in _PASSED:
        return value
    texts = [str(each) if isinstance(each, Anything) else each for each in value]
    return tuple(texts) if isinstance(value, tuple) else texts


def _as_code(text: Any) -> Any:
    return _VALUE if _is_unknown(text) else text


def _with(function: Any, starred: int) -> Any:
    """A function that is called with `**` or `*`: what it lacks is what nobody knows of that."""

    def called(*args: Any, **kwargs: Any) -> Any:
        names = [name for name in kwargs if is_unknown(name)]
        unknown = [kwargs[name] for name in names] or [each for each in args if starred and isinstance(each, Anything)]
        if not unknown or function is _dict:
            return function(*args, **kwargs)
        for name in names:
            del kwargs[name]
        return function(*args, **{**_lacking(function, args, kwargs, unknown[0]), **kwargs})

    return called


def _lacking(function: Any, args: Any, kwargs: Any, unknown: Any) -> dict[str, Any]:
    """The arguments without a default that a call does not have."""
    try:
        parameters = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):
        return {}
    by_place = [each for each in parameters if each.kind in (each.POSITIONAL_ONLY, each.POSITIONAL_OR_KEYWORD)]
    named = [*by_place[len(args) :], *(each for each in parameters if each.kind == each.KEYWORD_ONLY)]
    lacking = (each.name for each in named if each.default is each.empty and each.kind != each.POSITIONAL_ONLY)
    return {name: unknown[name] for name in lacking if name not in kwargs}


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
            if not _is_unknown(key) and not any(map(_is_unknown, self._of)):
                raise
        except IndexError:
            if not any(map(_is_unknown, self._of)):
                raise
            part = next(filter(_is_unknown, self._of))
            return part if isinstance(part, str) else part[0]
        return Anything(f"[{key}]")

    def get(self, key: Any, *default: Any) -> Any:
        found = self._of.get(key, *default)
        if not _is_unknown(key) or key in self._of or not asked(str(key), sys._getframe(1), False):
            return found
        return Anything(f"get({key})")

    def __contains__(self, item: Any) -> bool:
        found = item in self._of
        return asked(str(item), sys._getframe(1), found) if _is_unknown(item) else found


def _called(function: Any) -> Any:
    if function is isinstance:
        return _isinstance
    return _MADE_OF_UNKNOWN.get(function, function) if isinstance(function, type) else function


def _of(thing: Any) -> Any:
    return _Of(thing) if type(thing) in _COLLECTIONS else thing


def _in(thing: Any) -> Any:
    return _Of(thing) if type(thing) in _SETS else thing


def _is_unknown(value: Any) -> bool:
    if isinstance(value, bytes):
        return BEGIN.encode() in value
    return isinstance(value, Anything) or is_unknown(value)


def _int(*args: Any, **kwargs: Any) -> Any:
    return Anything(f"int({args[0]})") if args and _is_unknown(args[0]) else int(*args, **kwargs)


def _float(*args: Any) -> Any:
    return Anything(f"float({args[0]})") if args and _is_unknown(args[0]) else float(*args)


def _dict(*args: Any, **kwargs: Any) -> Any:
    if args and isinstance(args[0], Anything):
        return {**_more(args[0]), **kwargs}
    try:
        return dict(*args, **kwargs)
    except (TypeError, ValueError):
        if not RECORDER.unknown:
            raise
        return Anything("dict()")  # of pairs that nobody knows


def _type(*args: Any) -> Any:
    """Which type that is would be asked of the value: `type(x) == list` may hold or not."""
    if len(args) != 1 or not isinstance(args[0], Anything):
        return type(*args)
    found = Anything(f"type({args[0]})")
    found.__dict__["__name__"] = str(found)
    return found


def _isinstance(thing: Any, kind: Any) -> bool:
    """Whether it is one would be asked of the value: rather a plain value than a collection, which has more of them."""
    if not isinstance(thing, Anything):
        return isinstance(thing, kind)
    is_plain = not isinstance(kind, Anything) and all(each in _PLAIN for each in _kinds(kind))
    return asked(f"type({thing})", sys._getframe(1), is_plain)


def _kinds(kind: Any) -> Any:
    return [found for each in kind for found in _kinds(each)] if isinstance(kind, tuple) else [kind]


_MADE_OF_UNKNOWN: dict[type, Any] = {int: _int, float: _float, dict: _dict, type: _type}
