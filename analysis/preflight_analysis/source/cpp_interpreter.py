"""Goes through a C++ program in the order in which it would run, with the values that its text alone tells.

As in `python_interpreter`: both branches of a condition are taken where it is not known, a loop once; callbacks come
last, with arguments unknown. What is not of the program goes to `Calls`, which knows what ROS's libraries do.
"""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from typing import Any

from tree_sitter import Node

from preflight_analysis.source.branches import ExitError
from preflight_analysis.source.cpp_expressions import Expressions, TooLargeError
from preflight_analysis.source.cpp_operators import MAX_ITEMS, truth
from preflight_analysis.source.cpp_program import CppProgram, words_in
from preflight_analysis.source.cpp_text import (
    CONDITIONAL,
    FieldText,
    FunctionText,
    Parameter,
    Path,
    aliases_in,
    declarators,
    declared_name,
    first_child,
    function_declarator,
    path_of,
    text_of,
)
from preflight_analysis.source.cpp_types import standard
from preflight_analysis.source.cpp_values import Argument, Calls, Class, CppType, Instance, Scope
from preflight_analysis.source.python_values import UNKNOWN

_MAX_ITERATIONS = 64
_LEAVES = frozenset({"throw", "return", "exit", "abort", "terminate", "shutdown"})
"""How a handler of exceptions ends its function, or all of the program."""
_FEW_ITERATIONS = 8
_ACTIVATE = "activate"
_FOREVER = frozenset({"(true)", "(1)"})


def interpret_main(program: CppProgram, argv: Sequence[str], calls: Calls) -> bool:
    """Go through the program from its `main`; what it calls is told to `calls`. False if it has none."""
    main = program.main()
    if main is None:
        return False
    _Interpreter(program, calls).run(main, None, [len(argv), list(argv)])
    return True


def interpret_class(program: CppProgram, name: str, method: str | None, calls: Calls) -> bool:
    """Make an object of a class of the program, and call a method of it if one is given. False if there is no such
    class."""
    return _Interpreter(program, calls).made(tuple(name.split("::")), method)


def interpret_plugin(program: CppProgram, cls: str, method: str, name: str, calls: Calls) -> None:
    """Make an object of a class of the program, and call the method of it that gets a node, and a name; then it is
    activated."""
    _Interpreter(program, calls).loaded(tuple(cls.split("::")), method, name)


class _Interpreter(Expressions):
    def __init__(self, program: CppProgram, calls: Calls) -> None:
        super().__init__(program, calls)
        self._in_dead_code = False

    def run(self, function: FunctionText, instance: Instance | None, args: Sequence[Any]) -> None:
        try:
            with contextlib.suppress(ExitError):
                self._call_text(function, instance, [Argument(arg) for arg in args], {})
            self._callbacks()
        except (TooLargeError, RecursionError):
            self._calls.cut_short()

    def made(self, path: Path, method: str | None) -> bool:
        cls = self._class_at(path)
        if cls is None:
            return False
        try:
            instance = self._object(cls, [Argument(UNKNOWN)] if method is None else [])
            if method is None:
                self._callbacks()
                return True
        except ExitError:
            return True
        except (TooLargeError, RecursionError):
            self._calls.cut_short()
            return True
        found = self._method(instance, method, 0)
        if found is None:
            return False
        self.run(found, instance, [])
        return True

    def loaded(self, path: Path, method: str, name: str) -> None:
        cls = self._class_at(path)
        if cls is None:
            return
        try:
            instance = self._object(cls, [])
            found = self._method(instance, method, None)
            given = [self._for_plugin(each, name, found) for each in found.parameters] if found is not None else []
        except ExitError:
            return
        except (TooLargeError, RecursionError):
            self._calls.cut_short()
            return
        for called, args in ((found, given), (self._method(instance, _ACTIVATE, 0), [])):
            if called is not None:
                self._late = self._branches.late = False
                self.run(called, instance, args)

    def _class_at(self, path: Path) -> Class | None:
        classes = self._program.classes
        text = classes.get(path) or self._program.lookup(classes, path[-1:], path[:-1])
        if text is None:  # it is registered within its namespace, by the name that it has there
            within = [each for each in classes if each[-len(path) :] == path]
            text = classes[within[0]] if len(within) == 1 else None
        return self._class(CppType("::".join(text.path))) if text is not None else None

    def _for_plugin(self, parameter: Parameter, name: str, method: FunctionText) -> Any:
        """What a plugin gets: its name, and an object of a class of the program that can be made of nothing."""
        type_ = self._type(parameter.type, Scope({}, method.scope, method.file))
        if type_ is None or standard(type_.name) == "std::string":
            return name if type_ is not None else UNKNOWN
        cls = self._class(type_)
        made = self._program.functions.get((*cls.text.path, cls.text.name), ()) if cls is not None else ()
        return self._object(cls, []) if cls is not None and any(not each.parameters for each in made) else UNKNOWN

    def _callbacks(self) -> None:
        self._late = self._branches.late = True
        for waiting in self._waiting:  # grows while it is gone through
            body = waiting.text.body if waiting.text is not None else waiting.body
            if body is not None and not self._call_counts.get(body.id):
                with contextlib.suppress(ExitError):
                    self._call_value(waiting, [])

    # Each returns whether what follows it in the block is not reached.

    def _block(self, nodes: Sequence[Node], scope: Scope) -> bool:
        ended = False
        for index, node in enumerate(nodes):
            ended = self._statement(node, scope) or ended
            if ended and not self._in_dead_code:
                self._dead_code(nodes[index + 1 :], scope)
                break
        return ended

    def _dead_code(self, nodes: Sequence[Node], scope: Scope) -> None:
        """Go through what is not reached, if that tells something, and take back all that it did."""
        if self._in_dead_code or not any(self._leads(node) for node in nodes) or not self._calls.dead_code(True):
            return
        self._in_dead_code = True
        waiting, returned = len(self._waiting), len(self._returns[-1]) if self._returns else 0
        try:
            self._branches.try_out(lambda: self._block(nodes, scope))
        finally:
            self._calls.dead_code(False)
            self._in_dead_code = False
            del self._waiting[waiting:]
            if self._returns:
                del self._returns[-1][returned:]

    def _statement(self, node: Node, scope: Scope) -> bool:
        self._step()
        match node.type:
            case "compound_statement" | "ERROR" | "labeled_statement" | "case_statement" | "else_clause":
                return self._block(node.named_children, scope)
            case "expression_statement":
                for child in node.named_children:
                    self._value(child, scope)
            case "declaration":
                self._declaration(node, scope)
            case "if_statement":
                return self._if(node, scope)
            case "for_statement":
                self._for(node, scope)
            case "for_range_loop":
                self._for_range(node, scope)
            case "while_statement" | "do_statement":
                self._while(node, scope)
            case "switch_statement":
                self._switch(node, scope)
            case "try_statement":
                return self._try(node, scope)
            case "return_statement":
                value = self._value(first_child(node), scope) if node.named_child_count else None
                if self._returns:
                    self._returns[-1].append(value)
                return True
            case "throw_statement" | "break_statement" | "continue_statement" | "goto_statement":
                return True
            case "type_definition" | "alias_declaration":
                for name, type_node in aliases_in(node):
                    type_ = self._type(type_node, scope)
                    if type_ is not None:
                        scope.types[name] = type_
            case "using_declaration":
                path = path_of(first_child(node))
                if len(path) > 1 and all(c.type != "namespace" for c in node.children):
                    scope.types[path[-1]] = self._program.named_type(path, (), scope)
            case "preproc_if" if text_of(node.child_by_field_name("condition")) == "0":
                other = node.child_by_field_name("alternative")
                return other is not None and self._statement(other, scope)
            case kind if kind in CONDITIONAL:
                self._branches.either(
                    lambda: self._block([c for c in node.named_children if not _is_directive(c)], scope), lambda: False
                )
                other = node.child_by_field_name("alternative")
                if other is not None:
                    self._statement(other, scope)
            case _:
                if node.type.endswith(("_expression", "identifier")):
                    self._value(node, scope)
        return False

    def _declaration(self, node: Node, scope: Scope) -> None:
        type_node = node.child_by_field_name("type")
        if type_node is None:
            return
        for declarator, value in declarators(node):
            called = function_declarator(declarator)
            if called is not None:
                # `Thing thing(handle);` reads like the declaration of a function.
                name = declared_name(called.child_by_field_name("declarator"))
                listed = called.child_by_field_name("parameters")
                args = self._vexed(listed, scope)
                if name is not None and args is not None:
                    type_ = self._type(type_node, scope)
                    made = self._make(type_, args, self._place(node, scope), scope) if type_ else UNKNOWN
                    self._branches.store(scope.names, text_of(name), made)
                continue
            name = declared_name(declarator)
            if name is not None:
                field = FieldText(text_of(name), type_node, declarator, value, (), scope.file)
                self._branches.store(scope.names, field.name, self._initial(field, scope))

    def _vexed(self, listed: Node | None, scope: Scope) -> list[Argument] | None:
        found: list[Argument] = []
        for child in listed.named_children if listed is not None else ():
            if child.type in ("parameter_declaration", "optional_parameter_declaration"):
                declarator = child.child_by_field_name("declarator")
                if declarator is not None and declarator.type == "abstract_function_declarator":
                    found.append(Argument(UNKNOWN))  # `f()`
                    continue
                if declarator is not None:
                    return None
                type_node = child.child_by_field_name("type")
                path = path_of(type_node)
                if type_node is None or type_node.type == "primitive_type" or not path:
                    return None
                found.append(Argument(self._named(path, scope), self._variable(path, scope)))
            else:
                found.append(self._argument(child, scope))
        return found or None

    def _if(self, node: Node, scope: Scope) -> bool:
        condition = node.child_by_field_name("condition")
        met = self._condition(condition, scope)
        known = truth(met) if not self._in_dead_code else None
        then, other = node.child_by_field_name("consequence"), node.child_by_field_name("alternative")
        if known is not None:
            way, left = (then, other) if known else (other, then)
            if self._is_open(condition, scope):
                other_ends = False
                if left is not None:
                    other_ends, _ = self._branches.try_out(lambda: self._statement(left, scope))
                return way is not None and self._statement(way, scope) and other_ends
            if left is not None:
                self._dead_code([left], scope)
            return way is not None and self._statement(way, scope)
        return self._branches.either(
            lambda: then is not None and self._statement(then, scope),
            lambda: other is not None and self._statement(other, scope),
        )

    def _condition(self, node: Node | None, scope: Scope) -> Any:
        before, self._open_flags = self._open_flags, False
        try:
            return self._condition_value(node, scope)
        finally:
            self._open_flags = before

    def _is_open(self, condition: Node | None, scope: Scope) -> bool:
        """Whether a condition that is known hangs on what callbacks change, in a function that leads to a broadcast."""
        if not self._leads_to_broadcast and not self._open_flags:
            return False
        before, self._open_flags = self._open_flags, True
        try:
            return truth(self._condition_value(condition, scope)) is None
        finally:
            self._open_flags = before

    def _condition_value(self, node: Node | None, scope: Scope) -> Any:
        if node is None:
            return UNKNOWN
        if node.type == "condition_clause":
            first = node.child_by_field_name("initializer")
            if first is not None:
                for child in first.named_children:
                    self._statement(child, scope)
            return self._condition_value(node.child_by_field_name("value"), scope)
        if node.type == "declaration":
            self._declaration(node, scope)
            return UNKNOWN
        return self._value(node, scope)

    def _for(self, node: Node, scope: Scope) -> None:
        first, condition = node.child_by_field_name("initializer"), node.child_by_field_name("condition")
        update, body = node.child_by_field_name("update"), node.child_by_field_name("body")
        counters: list[str] = []
        if first is not None and first.type == "declaration":
            self._declaration(first, scope)
            counters = [text_of(declared_name(declarator)) for declarator, _ in declarators(first)]
        elif first is not None:
            self._value(first, scope)
        if body is None:
            return
        for _ in range(self._most_iterations(body)):
            known = truth(self._value(condition, scope)) if condition is not None else None
            if known is None:
                for name in counters:
                    self._branches.store(scope.names, name, UNKNOWN)
                self._once(body, scope)
                return
            if not known or self._statement(body, scope):
                return
            if update is not None:
                self._value(update, scope)

    def _most_iterations(self, body: Node) -> int:
        """How often a loop is gone through: only where a library is called a large number is worth it."""
        return _MAX_ITERATIONS if self._leads(body) else _FEW_ITERATIONS

    def _once(self, body: Node, scope: Scope) -> None:
        """Go through what may be done any number of times."""
        self._branches.either(lambda: self._statement(body, scope), lambda: False)

    def _for_range(self, node: Node, scope: Scope) -> None:
        items = self._value(node.child_by_field_name("right"), scope)
        body = node.child_by_field_name("body")
        name = text_of(declared_name(node.child_by_field_name("declarator")))
        if body is None:
            return
        if isinstance(items, list):
            for each in items[:MAX_ITEMS]:
                self._branches.store(scope.names, name, each)
                self._statement(body, scope)
            return
        self._branches.store(scope.names, name, UNKNOWN)
        self._once(body, scope)

    def _while(self, node: Node, scope: Scope) -> None:
        condition, body = node.child_by_field_name("condition"), node.child_by_field_name("body")
        if body is None:
            return
        first, done = node.type == "do_statement", False
        literal = text_of(condition) in _FOREVER
        for _ in range(1 if literal else self._most_iterations(body)):
            known = True if first else truth(self._condition(condition, scope))
            if known is False and not done and self._is_open(condition, scope):
                known = None
            first = False
            if known is None and not done:
                self._once(body, scope)
            done = True
            if not known or self._statement(body, scope):
                return

    def _switch(self, node: Node, scope: Scope) -> None:
        self._condition(node.child_by_field_name("condition"), scope)
        body = node.child_by_field_name("body")
        for case in body.named_children if body is not None else ():
            _, changes = self._branches.try_out(lambda case=case: self._statement(case, scope))  # type: ignore[misc]
            for change in changes.values():
                self._branches.store(change.names, change.name, UNKNOWN)

    def _try(self, node: Node, scope: Scope) -> bool:
        body = node.child_by_field_name("body")
        handlers = [child for child in node.named_children if child.type == "catch_clause"]
        caught = self._branches.caught
        self._branches.caught = caught or (bool(handlers) and all(_LEAVES.isdisjoint(words_in(h)) for h in handlers))
        try:
            ended = body is not None and self._statement(body, scope)
        finally:
            self._branches.caught = caught
        for handler in handlers:
            inside = handler.child_by_field_name("body")
            if inside is not None:
                self._branches.try_out(lambda inside=inside: self._statement(inside, scope))  # type: ignore[misc]
        return ended and not handlers


def _is_directive(node: Node) -> bool:
    return node.type in ("preproc_else", "preproc_elif", "preproc_elifdef", "identifier", "preproc_defined")
