"""Which function a call in a C++ program means: its own, one of the language, or one of a library."""

from __future__ import annotations

import itertools
from abc import abstractmethod
from dataclasses import replace
from typing import Any

from tree_sitter import Node

from preflight_analysis.source.branches import ExitError
from preflight_analysis.source.cpp_frames import message_of
from preflight_analysis.source.cpp_objects import Objects
from preflight_analysis.source.cpp_operators import (
    MAX_ITEMS,
    converted,
    items_method,
    text_method,
    text_of_stream,
)
from preflight_analysis.source.cpp_program import CppProgram, template_arguments
from preflight_analysis.source.cpp_text import FunctionText, Path, path_of
from preflight_analysis.source.cpp_types import CALLABLE, SMART_POINTERS, STANDARD, standard
from preflight_analysis.source.cpp_values import (
    Argument,
    Call,
    Calls,
    CppType,
    Fluent,
    Function,
    Instance,
    Message,
    Place,
    Placeholder,
    Reference,
    Scope,
    Stream,
    value_at,
    values,
)
from preflight_analysis.source.python_values import UNKNOWN

MAX_WAITING = 500
_CASTS = frozenset({"static_cast", "dynamic_cast", "const_cast", "reinterpret_cast", "lexical_cast"})
_SAME = frozenset({"ref", "cref", "move", "forward", "dynamic_pointer_cast", "static_pointer_cast"})
_MAKERS = frozenset({"make_shared", "make_unique"})
_EXITS = frozenset({"exit", "_exit", "abort", "quick_exit"})


class CallExpressions(Objects):
    """Calls of functions and methods. A function that is an argument may be called later: it waits until the end."""

    def __init__(self, program: CppProgram, calls: Calls) -> None:
        super().__init__(program, calls)
        self._waiting: list[Function] = []

    @abstractmethod
    def _lvalue(self, node: Node | None, scope: Scope) -> Reference | None:
        """The variable that an expression is."""

    def _call(self, node: Node, scope: Scope) -> Any:
        callee, listed = node.child_by_field_name("function"), node.child_by_field_name("arguments")
        if callee is None:
            return UNKNOWN
        place = self._place(node, scope)
        types = [t for each in template_arguments(_last(callee)) if (t := self._type(each, scope)) is not None]
        if callee.type == "field_expression":
            return self._call_method(callee, listed, types, place, scope)
        args = self._arguments(listed, scope)
        path = path_of(callee)
        if callee.type not in ("identifier", "qualified_identifier", "template_function") or not path:
            if callee.type in ("primitive_type", "type_identifier", "template_type"):
                type_ = self._type(callee, scope)
                return self._make(type_, args, place, scope) if type_ is not None else UNKNOWN
            value = self._value(callee, scope)
            return self._call_value(value, args) if isinstance(value, Function) else UNKNOWN
        return self._call_named(callee, path, types, args, place, scope)

    def _call_named(
        self, callee: Node, path: Path, types: list[CppType], args: list[Argument], place: Place, scope: Scope
    ) -> Any:
        name = path[-1]
        if name in _CASTS or name in _SAME:
            return converted(value_at(args, 0), types[0] if types else None)
        if name in _MAKERS and (types or len(path) > 1):
            return self._make(types[0] if types else self._program.named_type(path[:-1], (), scope), args, place, scope)
        if name == "bind":
            return _bound(args)
        if name in _EXITS and path[0] in (name, "std"):
            raise ExitError
        if name == "to_string":
            first = value_at(args, 0)
            return str(first) if isinstance(first, int) else UNKNOWN
        if len(path) == 1:
            variable = self._variable(path, scope)
            held = variable.names.get(variable.name) if variable is not None else None
            if isinstance(held, Function):
                return self._call_value(held, args)
        call = Call(name, types, args, place, self._store)
        taken = self._calls.takes(None if len(path) > 1 else scope.this, call)
        function = self._function(path, scope, len(args)) if not taken else None
        if function is not None and function.text is not None:
            if function.instance is not None:
                self._calls.notice(function.instance, call)
            return self._call_text(function.text, function.instance, args, self._given(function.text, types))
        type_ = self._type(callee, scope) if not taken else None  # `using nav2_util::declare_or_get_parameter;`
        if type_ is not None and (self._class(type_) is not None or type_.name != "::".join(p for p in path if p)):
            return self._make(type_, args, place, scope)
        if type_ is not None and (name in SMART_POINTERS or standard(type_.name) in STANDARD | CALLABLE):
            return self._make(type_, args, place, scope)
        if type_ is not None and (message := message_of(type_, args)) is not None:
            return message
        if len(path) == 1 and scope.this is not None:
            found = self._library_method(scope.this, call)
            if found is not UNKNOWN:
                return found
        self._may_be_set(path, args)
        written = type_.name if type_ is not None else "::".join(path)
        return self._calls.function(replace(call, name=written))

    def _call_method(self, callee: Node, listed: Node | None, types: list[CppType], place: Place, scope: Scope) -> Any:
        target = callee.child_by_field_name("argument")
        owner = self._value(target, scope)
        field = callee.child_by_field_name("field")
        path = path_of(field)
        args = self._arguments(listed, scope)
        if not path:
            return UNKNOWN
        name = path[-1]
        if name == "get" and not args and not types and not isinstance(owner, (str, list, dict)):
            return owner
        call = Call(name, types, args, place, self._store)
        if isinstance(owner, Instance) and not self._calls.takes(owner, call):
            text = self._method(owner, name, len(args))
            if text is not None:
                self._calls.notice(owner, call)
                return self._call_text(text, owner, args, self._given(text, types))
        if name == "reset" and len(args) == 1 and not isinstance(owner, (str, list, dict, Stream)):
            reference = self._lvalue(target, scope)
            if reference is not None:
                self._branches.store(reference.names, reference.name, args[0].value)
            return None
        if isinstance(owner, Stream):
            return self._stream(owner, name, args)
        if isinstance(owner, str):
            found = text_method(owner, name, values(args))
            if name == "append" and (reference := self._lvalue(target, scope)) is not None:
                self._branches.store(reference.names, reference.name, found)
            return found
        if isinstance(owner, (list, dict)):
            return self._container(owner, name, args)
        if owner is UNKNOWN or isinstance(owner, Instance):
            self._may_be_set(path, args)
        if owner is UNKNOWN:
            return UNKNOWN
        found = self._library_method(owner, call)
        if isinstance(owner, Fluent) and isinstance(found, type(owner)):
            self._changed(target, found, scope)
        return found

    def _argument(self, node: Node, scope: Scope) -> Argument:
        value = self._value(node, scope)
        if isinstance(value, Function) and len(self._waiting) < MAX_WAITING:
            self._waiting.append(value)
        return Argument(value, self._lvalue(node, scope))

    def _arguments(self, node: Node | None, scope: Scope) -> list[Argument]:
        children = [c for c in node.named_children if c.type != "comment"] if node is not None else []
        found = [self._argument(child, scope) for child in children]
        for index, (each, following) in enumerate(itertools.pairwise(found)):
            unbound = isinstance(each.value, Function) and each.value.text is not None
            if unbound and isinstance(following.value, Instance):
                text = each.value.text
                if any(cls.text.path == text.scope for cls in following.value.cls.order()):
                    bound = self._as_value(text, following.value)
                    self._waiting.append(bound)
                    found[index] = Argument(bound)
        return found

    def _may_be_set(self, path: Path, args: list[Argument]) -> None:
        """An empty text or container that is given to a function of which nothing is known is for what that finds."""
        for arg in args if path[0] != "ros" else ():
            if arg.reference is not None and arg.value in ("", [], {}):
                self._branches.store(arg.reference.names, arg.reference.name, UNKNOWN)

    def _given(self, text: FunctionText, types: list[CppType]) -> dict[str, CppType]:
        return dict(zip(text.template, types, strict=False))

    def _changed(self, node: Node | None, value: Any, scope: Scope) -> None:
        """Store what the variable holds now on which `a.f().g()` was called."""
        while node is not None and node.type == "call_expression":
            callee = node.child_by_field_name("function")
            node = callee.child_by_field_name("argument") if callee is not None else None
        reference = self._lvalue(node, scope)
        if reference is not None:
            self._branches.store(reference.names, reference.name, value)

    def _stream(self, stream: Stream, name: str, args: list[Argument]) -> Any:
        if name == "str":
            if not args:
                return text_of_stream(stream)
            stream.parts[:] = [args[0].value] if args[0].value != "" else []
        return UNKNOWN

    def _container(self, owner: list[Any] | dict[Any, Any], name: str, args: list[Argument]) -> Any:
        if isinstance(owner, list) and name in ("push_back", "emplace_back", "insert", "push", "add") and args:
            if len(owner) < MAX_ITEMS and not self._branches.inside:
                last = args[-1].value
                owner.append(last.copy() if isinstance(last, Message) else last)
            return None
        if name == "clear" and not self._branches.inside:
            owner.clear()
            return None
        return items_method(owner, name, values(args))

    def _library_method(self, owner: Any, call: Call) -> Any:
        found = self._calls.method(owner, call)
        for base in owner.bases if isinstance(owner, Instance) and found is UNKNOWN else ():
            found = self._calls.method(base, call)
            if found is not UNKNOWN:
                break
        return found

    def _store(self, argument: Argument, value: Any, /) -> None:
        if argument.reference is not None:
            self._branches.store(argument.reference.names, argument.reference.name, value)


def _bound(args: list[Argument]) -> Any:
    """What `boost::bind(function, ...)` gives: the parameters that its placeholders stand for are left."""
    function = value_at(args, 0)
    if not isinstance(function, Function):
        return UNKNOWN
    skip = 2 if function.is_method else 1
    given = args[skip:]
    types: dict[int, CppType | None] = {}
    for index, arg in enumerate(given):
        if isinstance(arg.value, Placeholder) and index < len(function.parameters):
            types[arg.value.number] = function.parameters[index]
    left = tuple(types.get(number) for number in range(1, max(types, default=0) + 1))
    return Function(function.text, function.instance, left, function.body, function.scope)


def _last(callee: Node) -> Node | None:
    return callee.child_by_field_name("field") if callee.type == "field_expression" else callee
