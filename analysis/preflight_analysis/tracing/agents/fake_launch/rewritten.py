"""Code in which what is made of something unknown stays unknown where Python alone would lose it.

`str` and an f-string give a plain text, `int` and `dict` want a real number and real pairs, `type` and `isinstance`
tell what stands in for the value, a dictionary has no item of a name that nobody knows, and nobody knows how many parts
a text has, what a number of it is, or what `**` of a mapping gives a call. The code of a launch file, and of the
modules of the workspace, asks us in these places.
"""

from __future__ import annotations

import ast
import builtins
import collections
import importlib.machinery
import inspect
import os
import re
import sys
import types
from typing import Any, Iterator

from ..anything import MARKS, AnyModule, Anything, asked, is_unknown, marked, readable, unknown_text
from .base import RECORDER, is_own_file

_TEXT, _OF, _IN = "__preflight_text__", "__preflight_of__", "__preflight_in__"
_PARTS, _EACH = "__preflight_parts__", "__preflight_each__"
_WITH, _MORE = "__preflight_with__", "__preflight_more__"
_PERCENT = "__preflight_percent__"
_CALLED, _AS_TEXT, _MODULE = "__preflight_called__", "__preflight_as_text__", "__preflight_module__"
_AS_CODE, _VALUE = "__preflight_as_code__", "__preflight_value__"
_FORMATTED = "__preflight_formatted__"
_GIVEN = {"map": _CALLED, "eval": _AS_CODE}
"""Functions of which the first argument is asked."""
_OF_TEXTS = ("join", "replace", "startswith", "endswith", "write", "writelines", "format")
"""Methods that want texts."""
_MAY_BE_TEXTS = (ast.Name, ast.Attribute, ast.Subscript, ast.IfExp, ast.BoolOp)
"""What may be a text that does not tell: others are asked as they are made."""
_FORMAT = re.compile(r"%(\(\w+\))?[#0\- +]*(?:\*|\d+)?(?:\.(?:\*|\d+))?[diouxXeEfFgGcrsa]")
_COLLECTIONS: tuple[type, ...] = (dict, list, tuple)
_PLAIN: tuple[type, ...] = (str, int, float, bool)
_PASSED: tuple[type, ...] = (list, tuple, map, types.GeneratorType)
"""What a text is taken apart with."""
_SETS: tuple[type, ...] = (dict, set, frozenset, type({}.keys()))
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
    values = {
        _TEXT: marked,
        _FORMATTED: _formatted,
        _PERCENT: _percent,
        _OF: _of,
        _IN: _in,
        _PARTS: _parts,
        _EACH: _each,
        _AS_TEXT: _as_text,
    }
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
        for value in node.values:
            if isinstance(value, ast.FormattedValue):
                value.value = _call(_FORMATTED, self.visit(value.value))
                if value.format_spec is not None:
                    self.generic_visit(value.format_spec)
        return _call(_TEXT, node)

    def visit_Subscript(self, node: ast.Subscript) -> Any:
        self.generic_visit(node)
        if isinstance(node.ctx, ast.Load) and not isinstance(node.slice, ast.Tuple):
            node.value = _call(_OF, node.value)
        return node

    def visit_BinOp(self, node: ast.BinOp) -> Any:
        self.generic_visit(node)
        if isinstance(node.op, ast.Mod):
            return ast.copy_location(ast.Call(_named(_PERCENT, node), [node.left, node.right], []), node)
        return _call(_TEXT, node) if isinstance(node.op, (ast.Add, ast.Mult)) else node

    def visit_If(self, node: Any) -> Any:
        self.generic_visit(node)
        node.test = _may_tell(node.test)
        return node

    visit_While = visit_IfExp = visit_Assert = visit_If  # noqa: N815, as ast calls them

    def visit_BoolOp(self, node: ast.BoolOp) -> Any:
        self.generic_visit(node)
        node.values = list(map(_may_tell, node.values))
        return node

    def visit_UnaryOp(self, node: ast.UnaryOp) -> Any:
        self.generic_visit(node)
        node.operand = _may_tell(node.operand) if isinstance(node.op, ast.Not) else node.operand
        return node

    def visit_Match(self, node: Any) -> Any:
        node.subject = _may_tell(self.visit(node.subject))
        for case in node.cases:  # patterns are no expressions
            case.guard = case.guard and _may_tell(self.visit(case.guard))
            case.body = [self.visit(each) for each in case.body]
        return node

    def visit_AnnAssign(self, node: ast.AnnAssign) -> Any:
        node.value = node.value and self.visit(node.value)
        return node

    def visit_arg(self, node: ast.arg) -> Any:
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
        node.ifs = list(map(_may_tell, node.ifs))
        return node if node.is_async else _with_parts(node)

    def visit_Compare(self, node: ast.Compare) -> Any:
        self.generic_visit(node)
        node.left, node.comparators = _may_tell(node.left), list(map(_may_tell, node.comparators))
        if len(node.ops) == 1 and isinstance(node.ops[0], (ast.In, ast.NotIn)):
            node.comparators[0] = _call(_IN, node.comparators[0])
        return node

    def visit_Call(self, node: ast.Call) -> Any:
        self.generic_visit(node)
        if isinstance(node.func, ast.Attribute):
            node.func.value = _may_tell(node.func.value)
            if node.func.attr == "get":
                node.func.value = _call(_OF, node.func.value)
            elif node.func.attr in _OF_TEXTS:
                name = _FORMATTED if node.func.attr == "format" else _AS_TEXT
                node.args = [each if isinstance(each, ast.Starred) else _call(name, each) for each in node.args]
                for each in node.keywords if name == _FORMATTED else ():
                    each.value = _call(name, each.value) if each.arg is not None else each.value
        elif isinstance(node.func, ast.Name) and node.func.id in _GIVEN and node.args:
            node.args[0] = _call(_GIVEN[node.func.id], node.args[0])
        if isinstance(node.func, (ast.Name, ast.Attribute)):
            node.func = _call(_CALLED, node.func)
        more = [each for each in node.keywords if each.arg is None]
        for each in more:
            each.value = _call(_MORE, each.value)
        starred = any(isinstance(each, ast.Starred) for each in node.args)
        if more or starred:
            node.func = _call(_WITH, node.func, int(starred))
        return _call(_TEXT, node)


def _may_tell(node: Any) -> Any:
    """What is asked whether it holds, or compared: a text that is not known tells of it."""
    return _call(_TEXT, node) if isinstance(node, _MAY_BE_TEXTS) else node


def _named(name: str, node: Any) -> ast.Name:
    return ast.copy_location(ast.Name(name, ast.Load()), node)


def _call(name: str, node: Any, *numbers: int) -> ast.Call:
    of = [node, *(ast.copy_location(ast.Constant(number), node) for number in numbers)]
    return ast.copy_location(ast.Call(_named(name, node), of, []), node)


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
        return marked(value)
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
        if isinstance(key, slice):
            return self._slice(key)
        if isinstance(key, Anything) and not isinstance(self._of, dict):
            return key[0]
        if isinstance(self._of, dict) and _is_unknown(key) and key not in self._of:
            return Anything(f"[{key}]")
        try:
            return self._of[key]
        except KeyError:
            if not any(map(_is_unknown, self._of)):
                raise
        except IndexError:
            if not any(map(_is_unknown, self._of)):
                raise
            part = next(filter(_is_unknown, self._of))
            return part if isinstance(part, str) else part[0]
        return Anything(f"[{key}]")

    def _slice(self, key: slice) -> Any:
        bounds = [each for each in (key.start, key.stop, key.step) if isinstance(each, Anything)]
        found = self._of[key]
        unknown = next(filter(_is_unknown, self._of), None)
        return [*found, bounds[0][0]] if bounds else found or ([] if unknown is None else [unknown])

    def get(self, key: Any, *default: Any) -> Any:
        found = self._of.get(key, *default)
        is_open = key not in self._of and (_is_unknown(key) or any(map(_is_unknown, self._of)))
        if not is_open or not asked(str(key), sys._getframe(1), False):
            return found
        return Anything(f"get({key})")

    def __contains__(self, item: Any) -> bool:
        found = item in self._of
        is_open = _is_unknown(item) or (not found and any(map(_is_unknown, self._of)))
        return asked(str(item), sys._getframe(1), found) if is_open else found


class _OfText:
    """A text of which some is not known: what is in front of that is known, and what is behind it."""

    def __init__(self, of: str) -> None:
        self._of = of

    def __getitem__(self, key: Any) -> Any:
        parts = MARKS.split(self._of)
        before, behind = len(parts[0]), len(parts[-1])
        start, stop = (key.start, key.stop) if isinstance(key, slice) else (key, None)
        if any(isinstance(each, Anything) for each in (start, stop)):
            return unknown_text(f"a part of {readable(self._of)}")
        if isinstance(key, slice):
            is_before = stop is not None and (start or 0) >= 0 and 0 <= stop <= before
            is_behind = start is not None and -behind <= start < 0 and (stop is None or stop < 0)
        else:
            is_before, is_behind = 0 <= start < before, -behind <= start < 0
        return self._of[key] if is_before or is_behind else unknown_text(f"a part of {readable(self._of)}")


def _called(function: Any) -> Any:
    """A function, or what a launch file gets in the place of one that would make a fact of what is not known."""
    kind = type(function)
    if kind is type or kind is types.FunctionType:
        return _INSTEAD.get(function, function)
    if kind not in _BUILTIN:
        return function
    of = getattr(function, "__self__", None)
    if isinstance(of, str) and is_unknown(of) and function.__name__ in _NUMBERS_OF_TEXT:
        return lambda *args: Anything(f"{readable(of)}.{function.__name__}()")
    counts = getattr(function, "__module__", None) in _CALCULATING or function in _COUNTING
    return _calculated(function) if counts or isinstance(of, re.Pattern) else _INSTEAD.get(function, function)


def _calculated(function: Any) -> Any:
    """A function that gives numbers or the like: of what is not known nobody knows them."""

    def called(*args: Any, **kwargs: Any) -> Any:
        given = (*args, *kwargs.values())
        if any(map(_is_unknown, given)):
            return Anything(f"{function.__name__}()")
        return function(*args, **kwargs)

    return called


def _ordered(function: Any) -> Any:
    """One that compares what it is given."""

    def called(*args: Any, **kwargs: Any) -> Any:
        args = tuple(list(each) if type(each) in _PASSED else each for each in args)
        unknown = next((each for each in _items(args) if _is_unknown(each)), None)
        if unknown is not None:
            asked(str(unknown), sys._getframe(1))
        return function(*args, **kwargs)

    return called


def _items(values: Any) -> Iterator[Any]:
    for value in values:
        yield from value if isinstance(value, list) else (value,)


def _of(thing: Any) -> Any:
    if isinstance(thing, str):
        return _OfText(thing) if is_unknown(thing) else thing
    return _Of(thing) if type(thing) in _COLLECTIONS or type(thing) in _KINDS_OF_DICT else thing


def _in(thing: Any) -> Any:
    if type(thing) in (list, tuple):
        return type(thing)(map(marked, thing)) if any(map(_is_unknown, thing)) else thing
    return _Of(thing) if type(thing) in _SETS else thing


def _is_unknown(value: Any) -> bool:
    if isinstance(value, (bytes, bytearray)):
        return is_unknown(value.decode(errors="ignore"))
    return isinstance(value, Anything) or is_unknown(value)


def _formatted(value: Any) -> Any:
    """What is written into a text."""
    return marked(RECORDER.in_place_of_none(value))


def _percent(left: Any, right: Any) -> Any:
    """What `%` gives. Of what is not known no precision is taken."""
    if type(left) is str:
        given = right if isinstance(right, tuple) else right.values() if isinstance(right, dict) else (right,)
        if any(map(_is_unknown, given)):
            left = _FORMAT.sub(lambda found: f"%{found[1] or ''}s", left)
        if isinstance(right, tuple):
            right = tuple(map(RECORDER.in_place_of_none, right))
        elif right is None:
            right = RECORDER.in_place_of_none(right)
    return marked(left % right)


def _str(*args: Any, **kwargs: Any) -> Any:
    return marked(str(*map(RECORDER.in_place_of_none, args), **kwargs))


def _bool(*args: Any) -> Any:
    return asked(str(args[0]), sys._getframe(1)) if args and _is_unknown(args[0]) else bool(*args)


def _getattr(thing: Any, name: Any, *default: Any) -> Any:
    return Anything(f"{name}") if _is_unknown(name) else getattr(thing, name, *default)


def _dirname(path: Any) -> Any:
    found = _os_dirname(path)
    return found if found or not _is_unknown(path) else unknown_text(f"the folder of {readable(str(path))}")


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


_os_dirname = os.path.dirname
_INSTEAD: dict[Any, Any] = {
    **{int: _int, float: _float, dict: _dict, type: _type, str: _str, bool: _bool, isinstance: _isinstance},
    **{getattr: _getattr, _os_dirname: _dirname},
    **{each: _ordered(each) for each in (min, max, sorted)},
}
_BUILTIN = (types.BuiltinFunctionType, types.MethodWrapperType, type(re.compile("").search))
_CALCULATING = ("math", "cmath", "_hashlib", "_sha1", "_sha256", "_md5", "zlib", "binascii")
"""Modules whose functions give a value that shows nothing of what it is made of."""
_COUNTING = frozenset((abs, bin, divmod, hash, hex, len, oct, ord, pow, round))
_NUMBERS_OF_TEXT = ("count", "find", "index", "rfind", "rindex", "__len__", "__hash__")
_KINDS_OF_DICT = (collections.OrderedDict, collections.defaultdict)
