"""Goes through a Python program in the order in which it would run, with the values that its text alone tells.

Both branches of a condition are taken where it is not known, a loop once; callbacks come last, with arguments unknown.
Nothing is imported or executed: calls of modules that are not followed go to `Calls`, which knows what ROS's do.
"""

from __future__ import annotations

import ast
import os
from collections.abc import Sequence
from typing import Any

from preflight_analysis.source.branches import ExitError
from preflight_analysis.source.python_call_expressions import CallExpressions
from preflight_analysis.source.python_expressions import TooLargeError, is_class_body, simple_name
from preflight_analysis.source.python_modules import Calls, Load
from preflight_analysis.source.python_operators import binary, items_of, truth_of
from preflight_analysis.source.python_values import UNKNOWN, Class, Function, Imported, Instance, Module, Scope


def interpret(path: str, tree: ast.Module, load: Load, calls: Calls, entry: str | None = None) -> None:
    """Go through the program whose main file is `path`; what it calls is told to `calls`. `entry` is the function that
    is called in a program that is started by an entry point."""
    _Interpreter(load, calls).main(path, tree, entry)


class _Interpreter(CallExpressions):
    def __init__(self, load: Load, calls: Calls) -> None:
        super().__init__(calls)
        self._load = load
        self._modules: dict[str, Module] = {}

    def main(self, path: str, tree: ast.Module, entry: str | None) -> None:
        try:
            module = self._module(path, tree, "__main__" if entry is None else os.path.basename(path))
            function = module.names.get(entry) if entry is not None else None
            if isinstance(function, Function):
                self._call_function(function, [], {})
            self._branches.late = True
            for function in self._waiting:  # grows while it is gone through
                if not self._call_counts.get(id(function.node)):
                    self._call_function(function, [], {}, unknown=True)
        except (TooLargeError, RecursionError):
            self._calls.cut_short()
        except ExitError:
            return

    def _module(self, path: str, tree: ast.Module, name: str) -> Module:
        module = self._modules[path] = Module(path, {"__name__": name, "__file__": path})
        try:
            self._block(tree.body, Scope(module.names, module))
        except ExitError:
            if name != "__main__":
                raise
        return module

    # Each returns whether what follows it in the block is not reached.

    def _block(self, statements: Sequence[ast.stmt], scope: Scope) -> bool:
        return any(self._statement(statement, scope) for statement in statements)

    def _statement(self, node: ast.stmt, scope: Scope) -> bool:
        self._step()
        match node:
            case ast.Expr():
                self._held(node.value, scope)
            case ast.Assign():
                value = self._held(node.value, scope)
                for target in node.targets:
                    self._assign(target, value, scope)
            case ast.AnnAssign():
                if node.value is not None:
                    self._assign(node.target, self._held(node.value, scope), scope)
            case ast.AugAssign():
                old = self._value(node.target, scope)
                new = self._value(node.value, scope)
                self._assign(node.target, binary(node.op, old, new), scope)
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
                if truth_of(self._value(node.test, scope)) is not False:
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
                    self._speculatively(handler.body, scope)
                return self._block(node.orelse, scope) | self._block(node.finalbody, scope) or (
                    ended and not node.handlers
                )
            case ast.Return():
                value = self._held(node.value, scope) if node.value is not None else None
                if self._returns:
                    self._returns[-1].append(value)
                return True
            case ast.Raise():
                if node.exc is not None:
                    self._held(node.exc, scope)
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
        truth = truth_of(self._value(node.test, scope))
        taken = node.body if truth else node.orelse
        # What a program raises for is no way to go: a value that is missing here is there on the robot.
        if truth is not None and not (taken and isinstance(taken[-1], ast.Raise)):
            return self._block(taken, scope)
        return self._branches.either(lambda: self._block(node.body, scope), lambda: self._block(node.orelse, scope))

    def _speculatively(self, statements: Sequence[ast.stmt], scope: Scope) -> None:
        """Go through what is seldom reached; the values that it sets do not count."""
        self._branches.try_out(lambda: self._block(statements, scope))

    def _for(self, node: ast.For | ast.AsyncFor, scope: Scope) -> None:
        items = items_of(self._value(node.iter, scope))
        for item in items if items is not None else [UNKNOWN]:
            self._assign(node.target, item, scope)
            self._block(node.body, scope)
        self._block(node.orelse, scope)

    def _define(self, node: ast.FunctionDef | ast.AsyncFunctionDef, scope: Scope) -> None:
        self._store(scope.names, node.name, Function(node, scope, scope.owner if is_class_body(scope) else None))
        for decorator in node.decorator_list:
            if simple_name(decorator) is None:
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
