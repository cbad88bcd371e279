"""What the expressions of a C++ program come to."""

from __future__ import annotations

import ast
from functools import partial
from typing import Any

from tree_sitter import Node

from preflight_analysis.source.cpp_call_expressions import MAX_WAITING, CallExpressions
from preflight_analysis.source.cpp_operators import MAX_ITEMS, binary, item, next_word, number, truth, unary
from preflight_analysis.source.cpp_program import CppProgram
from preflight_analysis.source.cpp_text import first_child, parameters_of, path_of, text_of
from preflight_analysis.source.cpp_values import Calls, Fluent, Function, Instance, Message, Reference, Scope, Stream
from preflight_analysis.source.python_values import UNKNOWN

MAX_STEPS = 80_000
_MAX_NESTING = 150


class TooLargeError(Exception):
    """The program is larger than what is looked at."""


class Expressions(CallExpressions):
    """Evaluates expressions; what is not known is `UNKNOWN`."""

    def __init__(self, program: CppProgram, calls: Calls) -> None:
        super().__init__(program, calls)
        self._steps = 0
        self._nesting = 0

    def _value(self, node: Node | None, scope: Scope) -> Any:
        self._step()
        if node is None or self._nesting > _MAX_NESTING:
            return UNKNOWN
        self._nesting += 1
        try:
            return self._valued(node, scope)
        finally:
            self._nesting -= 1

    def _valued(self, node: Node, scope: Scope) -> Any:
        match node.type:
            case "string_literal" | "raw_string_literal":
                return _literal(node)
            case "concatenated_string":
                parts = [self._value(child, scope) for child in node.named_children if child.type != "comment"]
                return "".join(parts) if all(isinstance(part, str) for part in parts) else UNKNOWN
            case "char_literal":
                text = text_of(node)
                return text[1] if len(text) == 3 else UNKNOWN
            case "number_literal":
                return number(text_of(node))
            case "true" | "false":
                return node.type == "true"
            case "null" | "nullptr":
                return None
            case "this":
                return scope.this if scope.this is not None else UNKNOWN
            case "identifier" | "qualified_identifier" | "template_function" | "type_identifier":
                path = path_of(node)
                return UNKNOWN if self._open_flags and path and path[-1] in self._flags else self._named(path, scope)
            case "field_expression":
                return self._field(node, scope)
            case "call_expression":
                return self._call(node, scope)
            case "new_expression" | "compound_literal_expression":
                return self._new(node, scope)
            case "binary_expression":
                return self._binary(node, scope)
            case "assignment_expression":
                return self._assign(node, scope)
            case "update_expression":
                return self._update(node, scope)
            case "unary_expression":
                operand = self._value(node.child_by_field_name("argument"), scope)
                return unary(text_of(node.child_by_field_name("operator")), operand)
            case "pointer_expression":
                return self._value(node.child_by_field_name("argument"), scope)
            case "parenthesized_expression":
                return self._value(first_child(node), scope)
            case "cast_expression":
                return self._value(node.child_by_field_name("value"), scope)
            case "conditional_expression":
                return self._conditional(node, scope)
            case "subscript_expression":
                owner = self._value(node.child_by_field_name("argument"), scope)
                indices = node.child_by_field_name("indices")
                key = self._value(first_child(indices), scope)
                return item(owner, key)
            case "initializer_list":
                found = [self._value(child, scope) for child in node.named_children if child.type != "comment"]
                return found[:MAX_ITEMS]
            case "lambda_expression":
                parameters = parameters_of(node.child_by_field_name("declarator"))
                types = tuple(self._type(p.type, scope) for p in parameters)
                return Function(None, scope.this, types, node, scope)
            case "comment":
                return UNKNOWN
            case _:
                for child in node.named_children:
                    self._value(child, scope)
                return UNKNOWN

    def _field(self, node: Node, scope: Scope) -> Any:
        owner = self._value(node.child_by_field_name("argument"), scope)
        name = text_of(node.child_by_field_name("field"))
        if isinstance(owner, Instance):
            return UNKNOWN if self._open_flags and name in self._flags else owner.names.get(name, UNKNOWN)
        return owner.inner(name) if isinstance(owner, Message) else UNKNOWN

    def _binary(self, node: Node, scope: Scope) -> Any:
        operator = text_of(node.child_by_field_name("operator"))
        left = self._value(node.child_by_field_name("left"), scope)
        if operator == ">>" and not isinstance(left, int):
            read = self._lvalue(node.child_by_field_name("right"), scope)
            is_text = read is not None and isinstance(read.names.get(read.name), str)
            word = next_word(left) if isinstance(left, Stream) and is_text else UNKNOWN
            if read is not None and word is not None:
                self._branches.store(read.names, read.name, word)
            return UNKNOWN if word is UNKNOWN else word is not None
        if operator not in ("&&", "||", "and", "or"):
            return binary(operator, left, self._value(node.child_by_field_name("right"), scope))
        stop = operator in ("||", "or")
        known = truth(left)
        if known is stop:
            return stop
        compute = partial(self._value, node.child_by_field_name("right"), scope)
        right = truth(compute() if known is not None else self._branches.maybe_value(compute))
        return right if right is stop or (known is not None and right is not None) else UNKNOWN

    def _conditional(self, node: Node, scope: Scope) -> Any:
        known = truth(self._value(node.child_by_field_name("condition"), scope))
        branches = node.child_by_field_name("consequence"), node.child_by_field_name("alternative")
        if known is not None:
            return self._value(branches[0] if known else branches[1], scope)
        return self._branches.either_value(
            lambda: self._value(branches[0], scope), lambda: self._value(branches[1], scope)
        )

    def _assign(self, node: Node, scope: Scope) -> Any:
        target = node.child_by_field_name("left")
        operator = text_of(node.child_by_field_name("operator"))
        value = self._value(node.child_by_field_name("right"), scope)
        if operator != "=":
            value = binary(operator.rstrip("="), self._value(target, scope), value)
        if target is not None and target.type == "subscript_expression":
            owner = self._value(target.child_by_field_name("argument"), scope)
            indices = target.child_by_field_name("indices")
            key = self._value(first_child(indices), scope)
            if isinstance(owner, dict) and isinstance(key, str) and len(owner) < MAX_ITEMS:
                self._branches.store(owner, key, value)
            return value
        reference = self._lvalue(target, scope)
        if target is not None and target.type == "field_expression" and reference is None:
            inside = target.child_by_field_name("argument")
            if isinstance(self._value(inside, scope), Fluent):
                self._changed(inside, UNKNOWN, scope)  # a field of it, of which nothing is known
            elif isinstance(value, Function) and len(self._waiting) < MAX_WAITING:
                self._waiting.append(value)  # a callback among the options of something
        if reference is not None:
            if isinstance(value, list):
                value = list(value)
            stored = value.copy() if isinstance(value, Message) else value
            self._branches.store(reference.names, reference.name, stored)
        return value

    def _update(self, node: Node, scope: Scope) -> Any:
        target = node.child_by_field_name("argument")
        old = self._value(target, scope)
        step = 1 if "++" in text_of(node.child_by_field_name("operator")) else -1
        new = old + step if isinstance(old, int) else UNKNOWN
        reference = self._lvalue(target, scope)
        if reference is not None:
            self._branches.store(reference.names, reference.name, new)
        return new if text_of(node).startswith(("++", "--")) else old

    def _lvalue(self, node: Node | None, scope: Scope) -> Reference | None:
        """The variable that an expression is."""
        if node is None:
            return None
        match node.type:
            case "identifier" | "qualified_identifier":
                return self._variable(path_of(node), scope)
            case "field_expression":
                owner = self._value(node.child_by_field_name("argument"), scope)
                if isinstance(owner, (Instance, Message)):
                    return Reference(owner.names, text_of(node.child_by_field_name("field")))
            case "pointer_expression":
                return self._lvalue(node.child_by_field_name("argument"), scope)
            case "parenthesized_expression":
                return self._lvalue(first_child(node), scope)
            case "call_expression":
                callee = node.child_by_field_name("function")
                if callee is not None and text_of(callee.child_by_field_name("field")) == "append":
                    return self._lvalue(callee.child_by_field_name("argument"), scope)  # it gives its own text
            case _:
                pass
        return None

    def _step(self) -> None:
        self._steps += 1
        if self._steps > MAX_STEPS:
            raise TooLargeError


def _literal(node: Node) -> Any:
    if node.type == "raw_string_literal":
        return "".join(text_of(child) for child in node.named_children if child.type == "raw_string_content")
    text = "".join(text_of(child) for child in node.named_children)
    if "\\" not in text:
        return text
    try:
        found = ast.literal_eval('"' + text.replace('"', '\\"') + '"')
    except (ValueError, SyntaxError):
        return UNKNOWN
    return found if isinstance(found, str) else UNKNOWN
