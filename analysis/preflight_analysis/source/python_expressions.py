"""What the expressions of a Python program come to."""

from __future__ import annotations

import ast
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

from preflight_analysis.source.branches import Branches
from preflight_analysis.source.python_modules import Calls
from preflight_analysis.source.python_operators import (
    BUILTINS,
    MAX_ITEMS,
    binary,
    formatted,
    item_at,
    items_of,
    joined,
    shortened,
    truth_of,
    unary,
)
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
    after,
    is_plain,
    known,
)

MAX_STEPS = 60_000


class TooLargeError(Exception):
    """The program is larger than what is looked at."""


class Expressions(ABC):
    """Evaluates expressions; what is not known is `UNKNOWN`."""

    def __init__(self, calls: Calls) -> None:
        self._calls = calls
        self._branches = Branches()
        calls.begin(self._branches)
        self._steps = 0

    @abstractmethod
    def _call(self, node: ast.Call, scope: Scope) -> Any:
        """The value of a call."""

    @abstractmethod
    def _call_function(
        self, function: Function, args: Sequence[Any], kwargs: Mapping[str, Any], unknown: bool = False
    ) -> Any:
        """What a function of the program returns; `unknown`: its parameters are not known."""

    def _value(self, node: ast.expr, scope: Scope) -> Any:
        """What an expression comes to, where something depends on it."""
        return known(self._held(node, scope))

    def _held(self, node: ast.expr, scope: Scope) -> Any:
        """The same where it is only stored, passed on or left alone: it may be asked for `Later`."""
        self._step()
        match node:
            case ast.Constant():
                return shortened(node.value) if is_plain(node.value) else UNKNOWN
            case ast.Name():
                return self._name(node.id, scope)
            case ast.Attribute():
                return self._attribute(self._value(node.value, scope), node.attr)
            case ast.Call():
                return self._call(node, scope)
            case ast.JoinedStr():
                return after(joined, *[self._held(part, scope) for part in node.values])
            case ast.FormattedValue():
                value = self._held(node.value, scope)
                simple = node.format_spec is None and node.conversion in (-1, ord("s"))
                return after(formatted, value) if simple else UNKNOWN
            case ast.BinOp():
                return self._binary(node, scope)
            case ast.List() | ast.Tuple() | ast.Set():
                values = [self._value(item, scope) for item in node.elts]
                if any(isinstance(item, ast.Starred) for item in node.elts) or len(values) > MAX_ITEMS:
                    return UNKNOWN
                return tuple(values) if isinstance(node, ast.Tuple) else values
            case ast.Dict():
                return self._dict(node, scope)
            case ast.Subscript():
                return item_at(self._value(node.value, scope), self._value(node.slice, scope))
            case ast.IfExp():
                truth = truth_of(self._value(node.test, scope))
                if truth is not None:
                    return self._held(node.body if truth else node.orelse, scope)
                return self._branches.either_value(
                    lambda: self._held(node.body, scope), lambda: self._held(node.orelse, scope)
                )
            case ast.BoolOp():
                return self._bool_op(node, scope)
            case ast.UnaryOp():
                return unary(node.op, self._value(node.operand, scope))
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
                self._held(node.value, scope)
                return UNKNOWN
            case _:
                for child in ast.iter_child_nodes(node):
                    if isinstance(child, ast.expr):
                        self._held(child, scope)
                return UNKNOWN

    def _binary(self, node: ast.BinOp, scope: Scope) -> Any:
        left, right = self._held(node.left, scope), self._held(node.right, scope)
        # Of two texts it may wait. What a list comes to may be another one by then.
        if isinstance(node.op, ast.Add) and (isinstance(left, str) or isinstance(right, str)):
            return after(partial(binary, node.op), left, right)
        return binary(node.op, known(left), known(right))

    def _name(self, name: str, scope: Scope) -> Any:
        current: Scope | None = scope
        while current is not None:
            # The names of a class's body are not seen from its methods.
            if name in current.names and (current is scope or not is_class_body(current)):
                return current.names[name]
            current = current.parent
        if name in scope.module.names:
            return scope.module.names[name]
        if name in BUILTINS:
            return Imported(f"builtins.{name}")
        return StarImported(name, tuple(scope.module.stars)) if scope.module.stars else UNKNOWN

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
        base = cls.imported_base if known(value) is UNKNOWN else None
        return self._calls.value(f"{base}.{name}") if base is not None else value

    def _bind(self, value: Any, instance: Any) -> Any:
        if not isinstance(value, Function) or isinstance(value.node, ast.Lambda):
            return value
        decorators = {simple_name(d) for d in value.node.decorator_list}
        if "staticmethod" in decorators:
            return value
        bound = Function(value.node, value.scope, value.owner, instance)
        return self._call_function(bound, [], {}) if "property" in decorators else bound

    def _dict(self, node: ast.Dict, scope: Scope) -> Any:
        found: dict[Any, Any] = {}
        for key, value in zip(node.keys, node.values, strict=True):
            name = self._value(key, scope) if key is not None else UNKNOWN
            what = self._value(value, scope)
            if isinstance(name, (str, int)) and len(found) < MAX_ITEMS:
                found[name] = what
        return found

    def _bool_op(self, node: ast.BoolOp, scope: Scope) -> Any:
        value: Any = UNKNOWN
        stop = isinstance(node.op, ast.Or)
        certain = True
        for operand in node.values:
            compute = partial(self._value, operand, scope)
            value = compute() if certain else self._branches.maybe_value(compute)
            truth = truth_of(value)
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
        items = items_of(self._value(first.iter, scope))
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

    def _assign(self, target: ast.expr, value: Any, scope: Scope) -> None:
        match target:
            case ast.Name():
                names = scope.module.names if target.id in scope.globals else scope.names
                self._store(names, target.id, value)
            case ast.Attribute():
                owner = self._value(target.value, scope)
                if isinstance(owner, (Instance, Class, Module)):
                    self._store(owner.names, target.attr, value)
                elif owner is UNKNOWN:
                    self._calls.given(value)
            case ast.Tuple() | ast.List():
                items = items_of(known(value))
                starred = any(isinstance(t, ast.Starred) for t in target.elts)
                fits = items is not None and len(items) == len(target.elts) and not starred
                for index, each in enumerate(target.elts):
                    self._assign(each, items[index] if fits and items is not None else UNKNOWN, scope)
            case ast.Starred():
                self._assign(target.value, UNKNOWN, scope)
            case ast.Subscript():
                owner, key = self._value(target.value, scope), self._value(target.slice, scope)
                if isinstance(owner, dict) and isinstance(key, str) and len(owner) < MAX_ITEMS:
                    self._store(owner, key, known(value))
            case _:
                pass

    def _store(self, names: dict[str, Any], name: str, value: Any) -> None:
        self._branches.store(names, name, value)

    def _step(self) -> None:
        self._steps += 1
        if self._steps > MAX_STEPS:
            raise TooLargeError


def is_class_body(scope: Scope) -> bool:
    """Whether the names of a scope are the attributes of a class."""
    return scope.owner is not None and scope.names is scope.owner.names


def simple_name(node: ast.expr) -> str | None:
    """The name that an expression is, None if it is more than one."""
    return node.id if isinstance(node, ast.Name) else None
