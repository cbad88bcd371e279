"""Where names have their values."""

from __future__ import annotations

import ast
from typing import Any, Literal, NamedTuple


class Names(NamedTuple):
    """The names of a function: those that it sets itself, and those that it says are somebody else's."""

    own: frozenset[str]
    of_module: frozenset[str]
    of_outside: frozenset[str]
    is_generator: bool


class Scope:
    """The names of a module, class, function or comprehension. `names`: None where it has those that are set in it."""

    __slots__ = ("globals", "handled", "is_class", "is_comprehension", "name", "names", "outer", "values")

    def __init__(
        self,
        values: dict[str, Any],
        outer: Scope | None,
        module: dict[str, Any],
        names: Names | None,
        *,
        of: Literal["module", "class", "function", "comprehension"] = "module",
        name: str = "",
    ) -> None:
        self.values, self.outer, self.globals, self.names = values, outer, module, names
        self.is_class, self.is_comprehension, self.name = of == "class", of == "comprehension", name
        self.handled: Any = None

    def get(self, name: str) -> Any:
        """The value of a name. Raises KeyError where there is none, a kind of NameError where it is not set yet."""
        names = self.names
        if names is not None and name in names.own:
            try:
                return self.values[name]
            except KeyError:
                message = f"cannot access local variable '{name}' where it is not associated with a value"
                raise UnboundLocalError(message, name=name) from None
        if names is None and name in self.values:
            return self.values[name]
        if names is None or name not in names.of_module:
            outer = self.outer
            while outer is not None:
                if not outer.is_class:
                    if outer.names is None and name in outer.values:
                        return outer.values[name]
                    if outer.names is not None and name in outer.names.own:
                        if name in outer.values:
                            return outer.values[name]
                        message = f"cannot access free variable '{name}' where it is not associated with a value"
                        raise NameError(f"{message} in enclosing scope", name=name)
                outer = outer.outer
        return self.globals[name]

    def set(self, name: str, value: Any) -> None:
        """Give a name a value."""
        self._owner(name)[name] = value

    def remove(self, name: str) -> None:
        """Take its value away."""
        self._owner(name).pop(name, None)

    def _owner(self, name: str) -> dict[str, Any]:
        if self.names is not None and name in self.names.of_module:
            return self.globals
        if self.names is not None and name in self.names.of_outside:
            outer = self.outer
            while outer is not None:
                if outer.names is not None and name in outer.names.own:
                    return outer.values
                outer = outer.outer
        return self.values

    def function(self) -> Scope:
        """That around comprehensions."""
        scope = self
        while scope.is_comprehension and scope.outer is not None:
            scope = scope.outer
        return scope

    def qualified(self, name: str) -> str:
        """The whole name of what is defined in it."""
        scope = self.function()
        return f"{scope.name}.{name}" if scope.name else name


def names_of(node: Any) -> Names:
    """The names of a function or `lambda`."""
    given = node.args
    own = {each.arg for each in (*given.posonlyargs, *given.args, *given.kwonlyargs)}
    own |= {each.arg for each in (given.vararg, given.kwarg) if each is not None}
    finder = _Finder()
    body = node.body if isinstance(node.body, list) else [node.body]
    for each in body:
        finder.visit(each)
    of_module, of_outside = frozenset(finder.of_module), frozenset(finder.of_outside)
    return Names(frozenset((own | finder.own) - of_module - of_outside), of_module, of_outside, finder.is_generator)


class _Finder(ast.NodeVisitor):
    def __init__(self) -> None:
        self.own: set[str] = set()
        self.of_module: set[str] = set()
        self.of_outside: set[str] = set()
        self.is_generator = False
        self._in_comprehension = 0

    def visit_Name(self, node: ast.Name) -> None:
        if not isinstance(node.ctx, ast.Load) and not self._in_comprehension:
            self.own.add(node.id)

    def visit_NamedExpr(self, node: ast.NamedExpr) -> None:
        self.own.add(node.target.id)
        self.visit(node.value)

    def visit_FunctionDef(self, node: Any) -> None:
        self.own.add(node.name)
        for each in (*node.decorator_list, *node.args.defaults, *(d for d in node.args.kw_defaults if d is not None)):
            self.visit(each)

    visit_AsyncFunctionDef = visit_FunctionDef

    def visit_ClassDef(self, node: ast.ClassDef) -> None:
        self.own.add(node.name)

    def visit_Lambda(self, node: ast.Lambda) -> None:
        pass

    def visit_ListComp(self, node: Any) -> None:
        self._in_comprehension += 1
        self.generic_visit(node)
        self._in_comprehension -= 1

    visit_SetComp = visit_DictComp = visit_GeneratorExp = visit_ListComp

    def visit_Global(self, node: ast.Global) -> None:
        self.of_module.update(node.names)

    def visit_Nonlocal(self, node: ast.Nonlocal) -> None:
        self.of_outside.update(node.names)

    def visit_Import(self, node: Any) -> None:
        for alias in node.names:
            self.own.add((alias.asname or alias.name).partition(".")[0])

    visit_ImportFrom = visit_Import

    def visit_ExceptHandler(self, node: ast.ExceptHandler) -> None:
        if node.name is not None:
            self.own.add(node.name)
        self.generic_visit(node)

    def visit_MatchAs(self, node: Any) -> None:
        if node.name is not None:
            self.own.add(node.name)
        self.generic_visit(node)

    def visit_Yield(self, node: Any) -> None:
        self.is_generator = True
        self.generic_visit(node)

    visit_YieldFrom = visit_Yield
