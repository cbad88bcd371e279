"""A walk through a Python program in the order in which it would run, with the values that its text alone tells.

Both ways of a condition are taken where it is not known, a loop once; callbacks come last, with arguments unknown.
Nothing is imported or executed: calls of modules that are not followed go to `Calls`, which knows what ROS's do.
"""

from __future__ import annotations

import ast
import os
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

from preflight_analysis.source.python_values import (
    UNKNOWN,
    Class,
    Function,
    Imported,
    Instance,
    Module,
    Scope,
    StarImported,
    Super,
    is_plain,
)
from preflight_analysis.source.ways import ExitError, Ways, same

MAX_STEPS = 60_000
_MAX_DEPTH = 30
_MAX_VISITS = 40
_MAX_ITEMS = 64
_MAX_TEXT = 4_096
_BIG_NUMBER = re.compile(r"\d{3}|\*")
_TEXT_METHODS = frozenset(
    "format strip lstrip rstrip lower upper title capitalize replace split rsplit join startswith endswith".split()  # noqa: SIM905
)
_OBJECT_METHODS = frozenset({"keys", "values", "items", "get", "copy", "index", "count"})


class Calls(Protocol):
    """What calls of modules that are not followed do."""

    def call(self, path: str, args: Sequence[Any], kwargs: Mapping[str, Any], file: str, line: int) -> Any:
        """The value of `path(*args, **kwargs)` at this place, UNKNOWN if that cannot be told."""

    def begin(self, ways: Ways) -> None:
        """The walk begins; `ways` tells what may well not be done."""

    def value(self, path: str) -> Any:
        """The value of an attribute such as `sys.argv`; `Imported(path)` if nothing else is known."""


Load = Callable[[str, int, str], "tuple[str, ast.Module] | None"]
"""A module by its dotted name, the number of leading dots and the file that imports it: its path and tree."""


class _TooLargeError(Exception):
    """The program is larger than what is looked at."""


def walk(path: str, tree: ast.Module, load: Load, calls: Calls, entry: str | None = None) -> None:
    """Go through the program whose main file is `path`; what it calls is told to `calls`. `entry` is the function that
    is called in a program that is started by an entry point."""
    _Walk(load, calls).main(path, tree, entry)


class _Walk:
    def __init__(self, load: Load, calls: Calls) -> None:
        self._load = load
        self._calls = calls
        self._modules: dict[str, Module] = {}
        self._steps = 0
        self._depth = 0
        self._active: set[int] = set()
        self._visits: dict[int, int] = {}
        self._waiting: list[Function] = []
        self._returns: list[list[Any]] = []
        self._ways = Ways()
        calls.begin(self._ways)

    def main(self, path: str, tree: ast.Module, entry: str | None) -> None:
        try:
            module = self._module(path, tree, "__main__" if entry is None else os.path.basename(path))
            function = module.names.get(entry) if entry is not None else None
            if isinstance(function, Function):
                self._call_function(function, [], {})
            self._ways.late = True
            for function in self._waiting:  # grows while it is gone through
                if not self._visits.get(id(function.node)):
                    self._call_function(function, [], {}, unknown=True)
        except (_TooLargeError, ExitError, RecursionError):
            return

    def _module(self, path: str, tree: ast.Module, name: str) -> Module:
        module = self._modules[path] = Module(path, {"__name__": name, "__file__": path})
        try:
            self._block(tree.body, Scope(module.names, module))
        except ExitError:
            if name != "__main__":
                raise
        return module

    # Statements. Each returns whether what follows it in the block is not reached.

    def _block(self, statements: Sequence[ast.stmt], scope: Scope) -> bool:
        return any(self._statement(statement, scope) for statement in statements)

    def _statement(self, node: ast.stmt, scope: Scope) -> bool:
        self._step()
        match node:
            case ast.Expr():
                self._value(node.value, scope)
            case ast.Assign():
                value = self._value(node.value, scope)
                for target in node.targets:
                    self._assign(target, value, scope)
            case ast.AnnAssign():
                if node.value is not None:
                    self._assign(node.target, self._value(node.value, scope), scope)
            case ast.AugAssign():
                old = self._value(node.target, scope)
                new = self._value(node.value, scope)
                self._assign(node.target, _operate(node.op, old, new), scope)
            case ast.FunctionDef() | ast.AsyncFunctionDef():
                self._define(node, scope)
            case ast.ClassDef():
                self._class(node, scope)
            case ast.Import():
                for alias in node.names:
                    self._import(alias, scope)
            case ast.ImportFrom():
                self._import_from(node, scope)
            case ast.If():
                return self._if(node, scope)
            case ast.For() | ast.AsyncFor():
                self._for(node, scope)
            case ast.While():
                if _truth(self._value(node.test, scope)) is not False:
                    self._block(node.body, scope)
                self._block(node.orelse, scope)
            case ast.With() | ast.AsyncWith():
                for item in node.items:
                    value = self._value(item.context_expr, scope)
                    if item.optional_vars is not None:
                        self._assign(item.optional_vars, value if isinstance(value, Instance) else UNKNOWN, scope)
                return self._block(node.body, scope)
            case ast.Try():
                ended = self._block(node.body, scope)
                for handler in node.handlers:
                    if handler.name:
                        self._store(scope.names, handler.name, UNKNOWN)
                    self._aside(handler.body, scope)
                return self._block(node.orelse, scope) | self._block(node.finalbody, scope) or (
                    ended and not node.handlers
                )
            case ast.Return():
                value = self._value(node.value, scope) if node.value is not None else None
                if self._returns:
                    self._returns[-1].append(value)
                return True
            case ast.Raise():
                if node.exc is not None:
                    self._value(node.exc, scope)
                return True
            case ast.Break() | ast.Continue():
                return True
            case ast.Global():
                scope.globals.update(node.names)
            case ast.Assert():
                self._value(node.test, scope)
            case _:
                pass
        return False

    def _if(self, node: ast.If, scope: Scope) -> bool:
        truth = _truth(self._value(node.test, scope))
        if truth is not None:
            return self._block(node.body if truth else node.orelse, scope)
        return self._ways.either(lambda: self._block(node.body, scope), lambda: self._block(node.orelse, scope))

    def _aside(self, statements: Sequence[ast.stmt], scope: Scope) -> None:
        """Go through what is seldom reached; the values that it sets do not count."""
        self._ways.try_out(lambda: self._block(statements, scope))

    def _for(self, node: ast.For | ast.AsyncFor, scope: Scope) -> None:
        items = _items(self._value(node.iter, scope))
        for item in items if items is not None else [UNKNOWN]:
            self._assign(node.target, item, scope)
            self._block(node.body, scope)
        self._block(node.orelse, scope)

    def _define(self, node: ast.FunctionDef | ast.AsyncFunctionDef, scope: Scope) -> None:
        self._store(scope.names, node.name, Function(node, scope, scope.owner if _is_class(scope) else None))
        for decorator in node.decorator_list:
            if _dotted(decorator) is None:
                self._value(decorator, scope)

    def _class(self, node: ast.ClassDef, scope: Scope) -> None:
        bases = tuple(self._value(base, scope) for base in node.bases)
        cls = Class(node.name, {}, bases)
        self._block(node.body, Scope(cls.names, scope.module, scope, owner=cls))
        self._store(scope.names, node.name, cls)

    def _import(self, alias: ast.alias, scope: Scope) -> None:
        found = self._follow(alias.name, 0, scope.module.path)
        if alias.asname:
            self._store(scope.names, alias.asname, found or Imported(alias.name))
        else:
            top = alias.name.partition(".")[0]
            self._store(scope.names, top, self._chain(alias.name, found) if found else Imported(top))

    def _chain(self, dotted: str, module: Module) -> Module:
        """The module that `import a.b.c` makes known as `a`, given `c`."""
        parent, _, leaf = dotted.rpartition(".")
        if not parent:
            return module
        above = self._follow(parent, 0, module.path) or Module("")
        above.names[leaf] = module
        return self._chain(parent, above)

    def _import_from(self, node: ast.ImportFrom, scope: Scope) -> None:
        base = node.module or ""
        module = self._follow(base, node.level, scope.module.path)
        value: Any
        for alias in node.names:
            if alias.name == "*":
                if module is None:
                    scope.module.stars.append(base)
                else:
                    public = {n: v for n, v in module.names.items() if not n.startswith("_")}
                    for name, value in public.items():
                        self._store(scope.names, name, value)
                    scope.module.stars += module.stars
                continue
            if module is not None and alias.name in module.names:
                value = module.names[alias.name]
            else:
                dotted = f"{base}.{alias.name}" if base else alias.name
                value = self._follow(dotted, node.level, scope.module.path)
                value = value or (UNKNOWN if node.level else Imported(dotted))
            self._store(scope.names, alias.asname or alias.name, value)

    def _follow(self, name: str, level: int, importer: str) -> Module | None:
        loaded = self._load(name, level, importer)
        if loaded is None:
            return None
        path, tree = loaded
        return self._modules.get(path) or self._module(path, tree, name)

    # Names and values.

    def _store(self, names: dict[str, Any], name: str, value: Any) -> None:
        self._ways.store(names, name, value)

    def _assign(self, target: ast.expr, value: Any, scope: Scope) -> None:
        match target:
            case ast.Name():
                names = scope.module.names if target.id in scope.globals else scope.names
                self._store(names, target.id, value)
            case ast.Attribute():
                owner = self._value(target.value, scope)
                if isinstance(owner, (Instance, Class, Module)):
                    self._store(owner.names, target.attr, value)
            case ast.Tuple() | ast.List():
                items = _items(value)
                starred = any(isinstance(t, ast.Starred) for t in target.elts)
                fits = items is not None and len(items) == len(target.elts) and not starred
                for index, each in enumerate(target.elts):
                    self._assign(each, items[index] if fits and items is not None else UNKNOWN, scope)
            case ast.Starred():
                self._assign(target.value, UNKNOWN, scope)
            case ast.Subscript():
                owner, key = self._value(target.value, scope), self._value(target.slice, scope)
                if isinstance(owner, dict) and isinstance(key, str) and len(owner) < _MAX_ITEMS:
                    self._store(owner, key, value)
            case _:
                pass

    def _name(self, name: str, scope: Scope) -> Any:
        current: Scope | None = scope
        while current is not None:
            # The names of a class's body are not seen from its methods.
            if name in current.names and (current is scope or not _is_class(current)):
                return current.names[name]
            current = current.parent
        if name in scope.module.names:
            return scope.module.names[name]
        if name in _BUILTINS:
            return Imported(f"builtins.{name}")
        return StarImported(name, tuple(scope.module.stars)) if scope.module.stars else UNKNOWN

    def _value(self, node: ast.expr, scope: Scope) -> Any:
        self._step()
        match node:
            case ast.Constant():
                return _short(node.value) if is_plain(node.value) else UNKNOWN
            case ast.Name():
                return self._name(node.id, scope)
            case ast.Attribute():
                return self._attribute(self._value(node.value, scope), node.attr)
            case ast.Call():
                return self._call(node, scope)
            case ast.JoinedStr():
                return _joined([self._value(part, scope) for part in node.values])
            case ast.FormattedValue():
                value = self._value(node.value, scope)
                simple = node.format_spec is None and node.conversion in (-1, ord("s"))
                return str(value) if simple and isinstance(value, (str, int, float)) else UNKNOWN
            case ast.BinOp():
                return _operate(node.op, self._value(node.left, scope), self._value(node.right, scope))
            case ast.List() | ast.Tuple() | ast.Set():
                values = [self._value(item, scope) for item in node.elts]
                if any(isinstance(item, ast.Starred) for item in node.elts) or len(values) > _MAX_ITEMS:
                    return UNKNOWN
                return tuple(values) if isinstance(node, ast.Tuple) else values
            case ast.Dict():
                return self._dict(node, scope)
            case ast.Subscript():
                return _item(self._value(node.value, scope), self._value(node.slice, scope))
            case ast.IfExp():
                truth = _truth(self._value(node.test, scope))
                if truth is not None:
                    return self._value(node.body if truth else node.orelse, scope)
                return same(self._value(node.body, scope), self._value(node.orelse, scope))
            case ast.BoolOp():
                return self._bool_op(node, scope)
            case ast.UnaryOp():
                return _unary(node.op, self._value(node.operand, scope))
            case ast.Compare():
                return self._compare(node, scope)
            case ast.Lambda():
                return Function(node, scope)
            case ast.ListComp() | ast.GeneratorExp() | ast.SetComp() | ast.DictComp():
                return self._comprehension(node, scope)
            case ast.NamedExpr():
                value = self._value(node.value, scope)
                self._assign(node.target, value, scope)
                return value
            case ast.Starred() | ast.Await() | ast.YieldFrom():
                self._value(node.value, scope)
                return UNKNOWN
            case _:
                for child in ast.iter_child_nodes(node):
                    if isinstance(child, ast.expr):
                        self._value(child, scope)
                return UNKNOWN

    def _dict(self, node: ast.Dict, scope: Scope) -> Any:
        found: dict[Any, Any] = {}
        for key, value in zip(node.keys, node.values, strict=True):
            name = self._value(key, scope) if key is not None else UNKNOWN
            what = self._value(value, scope)
            if isinstance(name, (str, int)) and len(found) < _MAX_ITEMS:
                found[name] = what
        return found

    def _bool_op(self, node: ast.BoolOp, scope: Scope) -> Any:
        value: Any = UNKNOWN
        stop = isinstance(node.op, ast.Or)
        certain = True
        for operand in node.values:
            value = self._value(operand, scope)
            truth = _truth(value)
            if truth is None:
                certain = False
            elif truth is stop:
                return value if certain or value in (True, False) else UNKNOWN
        return value if certain else UNKNOWN

    def _compare(self, node: ast.Compare, scope: Scope) -> Any:
        values = [self._value(each, scope) for each in (node.left, *node.comparators)]
        if len(values) != 2 or not all(is_plain(v) for v in values):
            return UNKNOWN
        left, right = values
        try:
            match node.ops[0]:
                case ast.Eq():
                    return left == right
                case ast.NotEq():
                    return left != right
                case ast.Is():
                    return left is right if left is None or right is None else UNKNOWN
                case ast.IsNot():
                    return left is not right if left is None or right is None else UNKNOWN
                case ast.In():
                    return left in right
                case ast.NotIn():
                    return left not in right
                case ast.Lt():
                    return left < right
                case ast.LtE():
                    return left <= right
                case ast.Gt():
                    return left > right
                case ast.GtE():
                    return left >= right
        except TypeError:
            return UNKNOWN
        return UNKNOWN

    def _comprehension(self, node: ast.ListComp | ast.GeneratorExp | ast.SetComp | ast.DictComp, scope: Scope) -> Any:
        inner = Scope({}, scope.module, scope)
        first = node.generators[0]
        items = _items(self._value(first.iter, scope))
        known = items is not None and len(node.generators) == 1 and not first.ifs
        found = []
        for item in items if items is not None else [UNKNOWN]:
            self._assign(first.target, item, inner)
            for generator in node.generators[1:]:
                self._value(generator.iter, inner)
                self._assign(generator.target, UNKNOWN, inner)
            if isinstance(node, ast.DictComp):
                found.append((self._value(node.key, inner), self._value(node.value, inner)))
            else:
                found.append(self._value(node.elt, inner))
        if not known:
            return UNKNOWN
        if isinstance(node, ast.DictComp):
            return {key: value for key, value in found if isinstance(key, (str, int))}
        return found

    def _attribute(self, owner: Any, name: str) -> Any:
        match owner:
            case Imported():
                return self._calls.value(f"{owner.path}.{name}")
            case Module():
                return owner.names.get(name, UNKNOWN)
            case Class():
                return owner.find(name)
            case Instance():
                if name in owner.names:
                    return owner.names[name]
                return self._inherited(self._bind(owner.cls.find(name), owner), owner.cls, name)
            case Super():
                for cls in owner.cls.order()[1:]:
                    if name in cls.names:
                        return self._bind(cls.names[name], owner.instance)
                return self._inherited(UNKNOWN, owner.cls, name)
            case _:
                return UNKNOWN

    def _inherited(self, value: Any, cls: Class, name: str) -> Any:
        """What a class that is not followed gives to those made of it: the methods of a node of rclpy."""
        base = cls.imported_base if value is UNKNOWN else None
        return self._calls.value(f"{base}.{name}") if base is not None else value

    def _bind(self, value: Any, instance: Any) -> Any:
        if not isinstance(value, Function) or isinstance(value.node, ast.Lambda):
            return value
        decorators = {_dotted(d) for d in value.node.decorator_list}
        if "staticmethod" in decorators:
            return value
        bound = Function(value.node, value.scope, value.owner, instance)
        return self._call_function(bound, [], {}) if "property" in decorators else bound

    # Calls.

    def _call(self, node: ast.Call, scope: Scope) -> Any:
        if isinstance(node.func, ast.Attribute):
            owner = self._value(node.func.value, scope)
            method = node.func.attr
            args, kwargs = self._arguments(node, scope)
            if isinstance(owner, (str, list, tuple, dict)):
                return self._of_plain(owner, method, args)
            callee = self._attribute(owner, method)
        else:
            callee = self._value(node.func, scope)
            args, kwargs = self._arguments(node, scope)
        if isinstance(callee, Function):
            return self._call_function(callee, args, kwargs)
        if isinstance(callee, Class):
            return self._instantiate(callee, args, kwargs)
        for value in (*args, *kwargs.values()):
            self._may_be_called(value)
        if isinstance(callee, Imported):
            return self._imported(callee.path, args, kwargs, node, scope)
        if isinstance(callee, StarImported):
            return self._star(callee, args, kwargs, node, scope)
        return UNKNOWN

    def _arguments(self, node: ast.Call, scope: Scope) -> tuple[list[Any], dict[str, Any]]:
        args: list[Any] = []
        for each in node.args:
            if isinstance(each, ast.Starred):
                args += _items(self._value(each.value, scope)) or [UNKNOWN]
            else:
                args.append(self._value(each, scope))
        kwargs: dict[str, Any] = {}
        for keyword in node.keywords:
            value = self._value(keyword.value, scope)
            if keyword.arg is not None:
                kwargs[keyword.arg] = value
            elif isinstance(value, dict):
                kwargs.update({key: each for key, each in value.items() if isinstance(key, str)})
        return args, kwargs

    def _may_be_called(self, value: Any) -> None:
        if isinstance(value, Function) and len(self._waiting) < 500:
            self._waiting.append(value)

    def _star(self, callee: StarImported, args: list[Any], kwargs: dict[str, Any], node: ast.Call, scope: Scope) -> Any:
        for module in callee.modules:
            value = self._imported(f"{module}.{callee.name}", args, kwargs, node, scope)
            if value is not UNKNOWN:
                return value
        return UNKNOWN

    def _imported(self, path: str, args: list[Any], kwargs: dict[str, Any], node: ast.Call, scope: Scope) -> Any:
        if path in ("sys.exit", "os._exit", "builtins.exit", "builtins.quit"):
            raise ExitError
        if path == "builtins.super":
            if len(args) == 2 and isinstance(args[0], Class):
                return Super(args[0], args[1])
            return Super(scope.owner, scope.instance) if scope.owner is not None else UNKNOWN
        if path.startswith("builtins."):
            return _builtin(path.removeprefix("builtins."), args)
        return self._calls.call(path, args, kwargs, scope.module.path, node.lineno)

    def _instantiate(self, cls: Class, args: list[Any], kwargs: dict[str, Any]) -> Any:
        instance = Instance(cls)
        made = cls.find("__init__")
        if isinstance(made, Function):
            self._call_function(Function(made.node, made.scope, made.owner, instance), args, kwargs)
        if any(
            base is UNKNOWN or (isinstance(base, Imported) and base.path != "builtins.object") for base in cls.bases
        ):
            # A thread, a state, a behaviour: what it is based on calls its methods.
            for name, value in list(cls.names.items()):
                if isinstance(value, Function) and not name.startswith("__"):
                    self._may_be_called(Function(value.node, value.scope, value.owner, instance))
        return instance

    def _call_function(
        self, function: Function, args: Sequence[Any], kwargs: Mapping[str, Any], unknown: bool = False
    ) -> Any:
        self._step()
        node = function.node
        key = id(node)
        self._visits[key] = self._visits.get(key, 0) + 1
        if key in self._active or self._depth >= _MAX_DEPTH or self._visits[key] > _MAX_VISITS:
            return UNKNOWN
        names = self._parameters(function, args, kwargs, unknown)
        parent = function.scope if function.scope.names is not function.scope.module.names else None
        scope = Scope(names, function.scope.module, parent, owner=function.owner, instance=function.instance)
        if function.owner is not None and function.instance is None and args:
            scope.instance = args[0]
        self._active.add(key)
        self._depth += 1
        self._returns.append([])
        try:
            if isinstance(node, ast.Lambda):
                return self._value(node.body, scope)
            self._block(node.body, scope)
            returned = self._returns[-1]
        finally:
            self._returns.pop()
            self._depth -= 1
            self._active.discard(key)
        result = returned[0] if returned else None
        for other in returned[1:]:
            result = same(result, other)
        return result

    def _parameters(
        self, function: Function, args: Sequence[Any], kwargs: Mapping[str, Any], unknown: bool
    ) -> dict[str, Any]:
        given = function.node.args
        positional = [a.arg for a in (*given.posonlyargs, *given.args)]
        names: dict[str, Any] = {}
        defaults = dict(zip(reversed(positional), reversed(given.defaults), strict=False))
        defaults.update({a.arg: d for a, d in zip(given.kwonlyargs, given.kw_defaults, strict=True) if d is not None})
        for name, default in defaults.items():
            names[name] = UNKNOWN if unknown else self._value(default, function.scope)
        values = [function.instance, *args] if function.instance is not None else list(args)
        names.update(zip(positional, values, strict=False))
        allowed = {*positional, *(a.arg for a in given.kwonlyargs)}
        names.update({name: value for name, value in kwargs.items() if name in allowed})
        for name in allowed:
            names.setdefault(name, UNKNOWN)
        if given.vararg is not None:
            names[given.vararg.arg] = UNKNOWN if unknown else list(values[len(positional) :])
        if given.kwarg is not None:
            names[given.kwarg.arg] = {} if unknown else {k: v for k, v in kwargs.items() if k not in allowed}
        return names

    def _of_plain(self, owner: Any, method: str, args: list[Any]) -> Any:
        if isinstance(owner, str):
            return _text_method(owner, method, args)
        if method in ("append", "add") and isinstance(owner, list) and args:
            if len(owner) < _MAX_ITEMS and not self._ways.inside:
                owner.append(args[0])
            return None
        if isinstance(owner, dict) and method in _OBJECT_METHODS:
            if method == "get" and args:
                key = args[0]
                other = args[1] if len(args) > 1 else None
                return owner.get(key, other) if isinstance(key, (str, int)) else UNKNOWN
            if method in ("keys", "values", "items"):
                return list(getattr(owner, method)())
        return UNKNOWN

    def _step(self) -> None:
        self._steps += 1
        if self._steps > MAX_STEPS:
            raise _TooLargeError


_BUILTINS = frozenset(
    "str int float bool len range enumerate zip list tuple dict super sorted exit quit".split()  # noqa: SIM905
)


def _builtin(name: str, args: Sequence[Any]) -> Any:
    if name == "dict" and not args:
        return {}
    if name in ("list", "tuple", "sorted") and not args:
        return []
    if not args or not is_plain(list(args)):
        return UNKNOWN
    first = args[0]
    try:
        match name:
            case "str" if isinstance(first, (str, int, float)):
                return str(first)
            case "int" | "float" if isinstance(first, (str, int, float)) and len(str(first)) < 30:
                return int(first) if name == "int" else float(first)
            case "bool":
                return bool(first)
            case "len":
                return len(first)
            case "range" if all(isinstance(a, int) for a in args):
                return list(range(*args)) if len(range(*args)) <= _MAX_ITEMS else UNKNOWN
            case "enumerate":
                return list(enumerate(first))
            case "zip":
                return list(zip(*args, strict=False))
            case "list" | "tuple":
                return list(first)
            case "sorted":
                return sorted(first)
    except (TypeError, ValueError, OverflowError):
        return UNKNOWN
    return UNKNOWN


def _text_method(text: str, method: str, args: Sequence[Any]) -> Any:
    known = is_plain(list(args)) and sum(len(str(a)) for a in args) + len(text) <= _MAX_TEXT
    if method not in _TEXT_METHODS or not known or (method == "format" and _BIG_NUMBER.search(text)):
        return UNKNOWN
    if method == "replace" and len(text) * max(len(str(a)) for a in (*args, "")) > _MAX_TEXT:
        return UNKNOWN
    if method == "format" and ("." in text or "[" in text):
        return UNKNOWN  # attributes of the arguments
    try:
        return _short(getattr(text, method)(*args))
    except (TypeError, ValueError, LookupError, AttributeError):
        return UNKNOWN


def _operate(operator: ast.operator, left: Any, right: Any) -> Any:
    number = isinstance(left, (int, float)) and isinstance(right, (int, float))
    if not is_plain(left) or not is_plain(right):
        return UNKNOWN
    try:
        match operator:
            case ast.Add() if isinstance(left, (str, list, tuple)) and type(left) is type(right):
                both: Any = left + right if len(left) + len(right) <= _MAX_TEXT else UNKNOWN  # type: ignore[operator]
                return both
            case ast.Mod() if isinstance(left, str):
                return _short(left % right) if not _BIG_NUMBER.search(left) else UNKNOWN
            case ast.Add() if number:
                return _small(left + right)
            case ast.Sub() if number:
                return _small(left - right)
            case ast.Mult() if number:
                return _small(left * right)
            case ast.Div() if number:
                return _small(left / right)
            case ast.FloorDiv() if number:
                return _small(left // right)
            case ast.Mod() if number:
                return left % right
    except (TypeError, ValueError, ArithmeticError, LookupError):
        return UNKNOWN
    return UNKNOWN


def _short(value: Any) -> Any:
    return UNKNOWN if isinstance(value, str) and len(value) > _MAX_TEXT else value


def _small(number: float) -> Any:
    return number if abs(number) < 2**64 else UNKNOWN


def _unary(operator: ast.unaryop, value: Any) -> Any:
    if isinstance(operator, ast.Not):
        truth = _truth(value)
        return UNKNOWN if truth is None else not truth
    if isinstance(operator, ast.USub) and isinstance(value, (int, float)):
        return -value
    return UNKNOWN


def _joined(parts: Sequence[Any]) -> Any:
    texts = [part for part in parts if isinstance(part, str)]
    return "".join(texts) if len(texts) == len(parts) and sum(map(len, texts)) <= _MAX_TEXT else UNKNOWN


def _item(owner: Any, key: Any) -> Any:
    if isinstance(owner, (dict, list, tuple, str)) and isinstance(key, (str, int)):
        try:
            return owner[key]  # type: ignore[index]
        except (LookupError, TypeError):
            return UNKNOWN
    return UNKNOWN


def _items(value: Any) -> list[Any] | None:
    """What a loop over the value would get, None if that is not known."""
    if isinstance(value, (list, tuple, dict)):
        return list(value)[:_MAX_ITEMS]
    return None


def _truth(value: Any) -> bool | None:
    if isinstance(value, (list, tuple, dict)):
        return bool(value) or None  # what a branch that is not taken adds to it is not known
    return bool(value) if is_plain(value) else None


def _is_class(scope: Scope) -> bool:
    return scope.owner is not None and scope.names is scope.owner.names


def _dotted(node: ast.expr) -> str | None:
    return node.id if isinstance(node, ast.Name) else None
