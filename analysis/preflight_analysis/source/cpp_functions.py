"""Runs the bodies of a C++ program's functions, with their parameters bound to arguments."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from typing import Any

from tree_sitter import Node

from preflight_analysis.source.branches import Branches, same
from preflight_analysis.source.cpp_frames import BROADCAST
from preflight_analysis.source.cpp_names import Names
from preflight_analysis.source.cpp_program import CppProgram, words_in
from preflight_analysis.source.cpp_text import FunctionText, Parameter, parameters_of
from preflight_analysis.source.cpp_types import PRIMITIVES, pointed, standard
from preflight_analysis.source.cpp_values import Argument, Calls, CppType, Function, Instance, Scope, Unmade
from preflight_analysis.source.python_values import UNKNOWN

MAX_DEPTH = 30
_MAX_CALLS = 100


class Functions(Names):
    """What is being run, how deep, and how often it was before."""

    def __init__(self, program: CppProgram, calls: Calls) -> None:
        super().__init__(program, calls)
        self._branches = Branches()
        calls.begin(self._branches)
        self._call_counts: dict[int, int] = {}
        self._active: set[int] = set()
        self._returns: list[list[Any]] = []
        self._depth = 0
        self._leading = program.leading_to(calls.words)
        self._known_leading: dict[int, bool] = {}
        self._broadcasting = program.leading_to(frozenset({BROADCAST}))
        self._flags = program.flags() if len(self._broadcasting) > 1 else frozenset[str]()
        self._open_flags = False
        """Whether flags that callbacks change are not known: in a condition of a function that leads to a broadcast."""
        self._known_broadcasting: dict[int, bool] = {}
        self._leads_to_broadcast = False
        self._late = False
        """Whether only callbacks are left: what leads to no call of a library is left out then."""

    @abstractmethod
    def _statement(self, node: Node, scope: Scope) -> bool:
        """Run a statement: whether what follows it in the block is not reached."""

    def _call_value(self, function: Function, args: list[Argument]) -> Any:
        if function.text is not None:
            return self._call_text(function.text, function.instance, args, {})
        if function.body is None or function.scope is None:
            return UNKNOWN
        outer = function.scope
        scope = Scope({}, outer.where, outer.file, {}, outer.this, outer)
        parameters = parameters_of(function.body.child_by_field_name("declarator"))
        self._bind_parameters(parameters, parameters, args, scope)
        body = function.body.child_by_field_name("body")
        if body is None:
            return UNKNOWN
        self._call_counts[function.body.id] = self._call_counts.get(function.body.id, 0) + 1
        return self._returned(body, scope)

    def _call_text(
        self, text: FunctionText, instance: Instance | None, args: list[Argument], types: dict[str, CppType]
    ) -> Any:
        if text.body is None or (self._late and text.name not in self._leading):
            return UNKNOWN
        scope = Scope({}, text.scope, text.file, self._types(text, instance, types), instance)
        self._bind(text, args, scope)
        return self._returned(text.body, scope)

    def _returned(self, body: Node, scope: Scope) -> Any:
        key = body.id
        if key in self._active:
            return UNKNOWN
        if self._depth > MAX_DEPTH or self._call_counts.get(key, 0) >= _MAX_CALLS:
            if self._leads(body):
                self._calls.cut_short()
            return UNKNOWN
        self._active.add(key)
        self._depth += 1
        self._returns.append([])
        try:
            self._body(body, scope)
            found = self._returns[-1]
            result = found[0] if found else None
            for other in found[1:]:
                result = same(result, other)
            return result
        finally:
            self._returns.pop()
            self._depth -= 1
            self._active.discard(key)

    def _body(self, body: Node, scope: Scope) -> None:
        self._call_counts[body.id] = self._call_counts.get(body.id, 0) + 1
        caught, self._branches.caught = self._branches.caught, False
        before = self._leads_to_broadcast
        self._leads_to_broadcast = self._is_broadcasting(body)
        try:
            self._statement(body, scope)
        finally:
            self._branches.caught = caught
            self._leads_to_broadcast = before

    def _is_broadcasting(self, body: Node) -> bool:
        if not self._flags:
            return False
        if body.id not in self._known_broadcasting:
            self._known_broadcasting[body.id] = not self._broadcasting.isdisjoint(words_in(body))
        return self._known_broadcasting[body.id]

    def _leads(self, body: Node) -> bool:
        """Whether something of a library may be called in it."""
        if body.id not in self._known_leading:
            self._known_leading[body.id] = not self._leading.isdisjoint(words_in(body))
        return self._known_leading[body.id]

    def _bind(self, text: FunctionText, args: list[Argument], scope: Scope) -> None:
        others = self._program.functions.get((*text.scope, text.name), ())
        alike = [o for o in others if len(o.parameters) == len(text.parameters)]
        declared = max(alike, key=lambda o: sum(p.default is not None for p in o.parameters), default=text)
        self._bind_parameters(text.parameters, declared.parameters, args, scope)

    def _bind_parameters(
        self, parameters: Sequence[Parameter], declared: Sequence[Parameter], args: list[Argument], scope: Scope
    ) -> None:
        for index, parameter in enumerate(parameters):
            value: Any = UNKNOWN
            if index < len(args):
                given = args[index]
                value = given.reference if parameter.changes and given.reference is not None else given.value
            elif (default := parameter.default or declared[index].default) is not None:
                value = self._value(default, scope)
            if value is UNKNOWN and (type_ := self._type(parameter.type, scope)) is not None:
                value = Unmade(pointed(type_)) if standard(type_.name) not in PRIMITIVES | {"std::string"} else UNKNOWN
            if parameter.name:
                scope.names[parameter.name] = value
