"""What the names in a C++ program stand for: types, classes, variables, macros and functions."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Any

from tree_sitter import Node

from preflight_analysis.source.cpp_program import CppProgram
from preflight_analysis.source.cpp_text import FieldText, FunctionText, Path, parse_expression
from preflight_analysis.source.cpp_values import (
    Calls,
    Class,
    CppType,
    Function,
    Instance,
    Place,
    Placeholder,
    Reference,
    Scope,
)
from preflight_analysis.source.python_values import UNKNOWN

_PLACEHOLDER = re.compile(r"_\d\Z")


class Names(ABC):
    """Looks names up; what a global variable or a macro comes to is made when it is first asked for."""

    def __init__(self, program: CppProgram, calls: Calls) -> None:
        self._program = program
        self._calls = calls
        self._globals: dict[str, Any] = {}
        self._classes: dict[tuple[object, ...], Class] = {}
        self._macros: dict[str, Any] = {}

    @abstractmethod
    def _value(self, node: Node | None, scope: Scope) -> Any:
        """What an expression comes to."""

    @abstractmethod
    def _initial(self, field: FieldText, scope: Scope) -> Any:
        """The value of a variable as it is declared."""

    def _type(self, node: Node | None, scope: Scope) -> CppType | None:
        return self._program.type_of(node, scope)

    def _class(self, type_: CppType) -> Class | None:
        text = self._program.class_of(type_)
        if text is None:
            return None
        key = (text.path, type_.args)
        if key not in self._classes:
            types = dict(zip(text.template, type_.args, strict=False))
            known = self._classes[key] = Class(text, types)
            scope = Scope({}, text.scope, text.file, types)
            bases = (self._class(base) for node in text.bases if (base := self._type(node, scope)) is not None)
            known.bases = tuple(base for base in bases if base is not None)
        return self._classes[key]

    def _named(self, path: Path, scope: Scope) -> Any:
        """The value of a variable or function by its name."""
        if len(path) == 1:
            current: Scope | None = scope
            while current is not None:
                if path[0] in current.names:
                    found = current.names[path[0]]
                    return found.names.get(found.name, UNKNOWN) if isinstance(found, Reference) else found
                current = current.parent
            if scope.this is not None and path[0] in scope.this.names:
                return scope.this.names[path[0]]
        reference = self._global(path, scope)
        if reference is not None:
            return reference.names.get(reference.name, UNKNOWN)
        if len(path) == 1 and path[0] in self._program.defines:
            return self._macro(path[0], scope)
        if _PLACEHOLDER.match(path[-1]):
            return Placeholder(int(path[-1][1:]))
        function = self._function(path, scope)
        if function is not None:
            return function
        return self._calls.named("::".join(path))

    def _variable(self, path: Path, scope: Scope) -> Reference | None:
        """The variable of a name, if it is one."""
        if len(path) == 1:
            current: Scope | None = scope
            while current is not None:
                if path[0] in current.names:
                    found = current.names[path[0]]
                    return found if isinstance(found, Reference) else Reference(current.names, path[0])
                current = current.parent
            if scope.this is not None and path[0] in scope.this.names:
                return Reference(scope.this.names, path[0])
        return self._global(path, scope)

    def _global(self, path: Path, scope: Scope) -> Reference | None:
        places = [scope.where]
        if scope.this is not None:
            places += [cls.text.path for cls in scope.this.cls.order()]
        table = self._program.variables
        key = next((k for where in places if (k := self._program.find(table, path, where)) is not None), None)
        if key is None:
            return None
        name = "::".join(key)
        if name not in self._globals:
            self._globals[name] = UNKNOWN
            field = self._program.variables[key]
            self._globals[name] = self._initial(field, Scope({}, field.scope, field.file))
        return Reference(self._globals, name)

    def _macro(self, name: str, scope: Scope) -> Any:
        if name not in self._macros:
            self._macros[name] = UNKNOWN
            node = parse_expression(self._program.defines[name])
            if node is not None:
                self._macros[name] = self._value(node, Scope({}, (), scope.file))
        return self._macros[name]

    def _function(self, path: Path, scope: Scope, arity: int | None = None) -> Function | None:
        """A function of the program by its name; a method of the object at hand is bound to it."""
        if len(path) == 1 and scope.this is not None:
            text = self._method(scope.this, path[0], arity)
            if text is not None:
                return self._as_value(text, scope.this)
        found = self._program.find(self._program.functions, path, scope.where)
        if found is None and len(path) > 1:
            # `&Alias::method`, or a method that the class has from its base.
            cls = self._class(self._program.named_type(path[:-1], (), scope))
            text = self._method(Instance(cls), path[-1], arity) if cls is not None else None
            return self._as_value(text, self._own(text, scope)) if text is not None else None
        text = fitting(self._program.functions[found], arity) if found is not None else None
        return self._as_value(text, self._own(text, scope)) if text is not None else None

    def _own(self, text: FunctionText, scope: Scope) -> Instance | None:
        this = scope.this
        return this if this is not None and any(c.text.path == text.scope for c in this.cls.order()) else None

    def _method(self, instance: Instance, name: str, arity: int | None) -> FunctionText | None:
        for cls in instance.cls.order():
            found = fitting(self._program.functions.get((*cls.text.path, name), ()), arity)
            if found is not None:
                return found
        return None

    def _as_value(self, text: FunctionText, instance: Instance | None) -> Function:
        scope = Scope({}, text.scope, text.file, self._types(text, instance, {}), instance)
        types = tuple(self._type(p.type, scope) for p in text.parameters)
        return Function(text, instance, types, is_method=text.scope in self._program.classes)

    def _types(self, text: FunctionText, instance: Instance | None, given: dict[str, CppType]) -> dict[str, CppType]:
        """What the names of template parameters stand for in a function."""
        found = dict(given)
        if instance is not None:
            for cls in instance.cls.order():
                if cls.text.path == text.scope:
                    found |= cls.types
                    # A method that is defined outside of the class may give them other names.
                    found |= dict(zip(text.template, cls.types.values(), strict=False))
        return found

    def _place(self, node: Node, scope: Scope) -> Place:
        return Place(scope.file.path, node.start_point.row + 1)


def fitting(functions: Sequence[FunctionText], arity: int | None) -> FunctionText | None:
    """The one among overloaded functions that takes so many arguments; with a body, if there is one."""
    found = [f for f in functions if f.body is not None]
    if arity is None or not found:
        return found[0] if found else None
    for each in found:
        if len(each.parameters) == arity:
            return each
    # Others have defaults, which may stand in a declaration that was not seen.
    return min((f for f in found if len(f.parameters) > arity), key=lambda f: len(f.parameters), default=None)
