"""What a call in a Python program does: of its own functions and classes, of the language, or of a library."""

from __future__ import annotations

import ast
from abc import abstractmethod
from collections.abc import Mapping, Sequence
from typing import Any

from preflight_analysis.source.branches import ExitError, same
from preflight_analysis.source.python_expressions import Expressions
from preflight_analysis.source.python_frames import Message
from preflight_analysis.source.python_modules import Calls
from preflight_analysis.source.python_operators import MAX_ITEMS, builtin, items_of, text_method
from preflight_analysis.source.python_values import (
    UNKNOWN,
    Class,
    Function,
    Imported,
    Instance,
    Scope,
    StarImported,
    Super,
    known,
)

_MAX_DEPTH = 30
_MAX_CALLS = 40
_OBJECT_METHODS = frozenset({"keys", "values", "items", "get", "copy", "index", "count"})


class CallExpressions(Expressions):
    """Calls functions of the program with their arguments. One that is an argument may be called later: it waits until
    the end."""

    def __init__(self, calls: Calls) -> None:
        super().__init__(calls)
        self._depth = 0
        self._active: set[int] = set()
        self._call_counts: dict[int, int] = {}
        self._waiting: list[Function] = []
        self._returns: list[list[Any]] = []

    @abstractmethod
    def _block(self, statements: Sequence[ast.stmt], scope: Scope) -> bool:
        """Run statements: whether what follows them is not reached."""

    def _call(self, node: ast.Call, scope: Scope) -> Any:
        if isinstance(node.func, ast.Attribute):
            owner = self._value(node.func.value, scope)
            method = node.func.attr
            args, kwargs = self._arguments(node, scope)
            if isinstance(owner, (str, list, tuple, dict)):
                return self._of_plain(owner, method, [*map(known, args)])
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
                args += items_of(self._value(each.value, scope)) or [UNKNOWN]
            else:
                args.append(self._held(each, scope))
        kwargs: dict[str, Any] = {}
        for keyword in node.keywords:
            value = self._held(keyword.value, scope)
            if keyword.arg is not None:
                kwargs[keyword.arg] = value
            elif isinstance(every := known(value), dict):
                kwargs.update({key: each for key, each in every.items() if isinstance(key, str)})
        return args, kwargs

    def _may_be_called(self, value: Any) -> None:
        if isinstance(value, Function) and len(self._waiting) < 500:
            self._waiting.append(value)

    def _star(self, callee: StarImported, args: list[Any], kwargs: dict[str, Any], node: ast.Call, scope: Scope) -> Any:
        for module in callee.modules:
            value = self._imported(f"{module}.{callee.name}", args, kwargs, node, scope)
            if known(value) is not UNKNOWN:
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
            return builtin(path.removeprefix("builtins."), [*map(known, args)])
        return self._calls.call(path, args, kwargs, scope.module.path, node.lineno)

    def _instantiate(self, cls: Class, args: list[Any], kwargs: dict[str, Any]) -> Any:
        if isinstance(maker := cls.find("__new__"), Function) and not _makes_own(maker):
            self._calls.cut_short()
            return UNKNOWN
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
        self._call_counts[key] = self._call_counts.get(key, 0) + 1
        if key in self._active:
            return UNKNOWN
        if self._depth >= _MAX_DEPTH or self._call_counts[key] > _MAX_CALLS:
            self._calls.cut_short()
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
                return self._held(node.body, scope)
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
            names[given.vararg.arg] = UNKNOWN if unknown else [*map(known, values[len(positional) :])]
        if given.kwarg is not None:
            names[given.kwarg.arg] = {} if unknown else {k: known(v) for k, v in kwargs.items() if k not in allowed}
        return names

    def _of_plain(self, owner: Any, method: str, args: list[Any]) -> Any:
        if isinstance(owner, str):
            return text_method(owner, method, args)
        if method in ("append", "add") and isinstance(owner, list) and args:
            if len(owner) < MAX_ITEMS and not self._branches.inside:
                owner.append(args[0].copy() if isinstance(args[0], Message) else args[0])
            return None
        if isinstance(owner, dict) and method in _OBJECT_METHODS:
            if method == "get" and args:
                key = args[0]
                other = args[1] if len(args) > 1 else None
                return owner.get(key, other) if isinstance(key, (str, int)) else UNKNOWN
            if method in ("keys", "values", "items"):
                return list(getattr(owner, method)())
        return UNKNOWN


def _makes_own(maker: Function) -> bool:
    """Whether a `__new__` asks another one for what it gives, as that of a class with one instance does."""
    calls = (each.func for each in ast.walk(maker.node) if isinstance(each, ast.Call))
    return any(isinstance(func, ast.Attribute) and func.attr == "__new__" for func in calls)
