"""A walk through a C++ program in the order in which it would run, with the values that its text alone tells.

As in `python_walk`: both ways of a condition are taken where it is not known, a loop once; callbacks come last, with
arguments unknown. What is not of the program goes to `Calls`, which knows what ROS's libraries do.
"""

from __future__ import annotations

import ast
import contextlib
import itertools
import re
from collections.abc import Sequence
from typing import Any

from tree_sitter import Node

from preflight_analysis.source.cpp_operators import (
    MAX_ITEMS,
    binary,
    converted,
    item,
    items_method,
    number,
    text_method,
    text_of_stream,
    truth,
    unary,
)
from preflight_analysis.source.cpp_program import CppProgram, template_arguments, words_in
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
    is_pointer,
    parameters_of,
    parse_expression,
    path_of,
    text_of,
)
from preflight_analysis.source.cpp_values import (
    Argument,
    Calls,
    Class,
    CppType,
    Fluent,
    Function,
    Instance,
    Place,
    Placeholder,
    Reference,
    Scope,
    Stream,
    Unmade,
    value_at,
    values,
)
from preflight_analysis.source.python_values import UNKNOWN
from preflight_analysis.source.ways import ExitError, Ways, same

MAX_STEPS = 80_000
_MAX_DEPTH = 30
_MAX_NESTING = 150
_MAX_VISITS = 100
_MAX_WAITING = 500
_MAX_TURNS = 64
_FEW_TURNS = 8
_PRIMITIVES = frozenset("int bool double float char unsigned long short size_t auto".split())  # noqa: SIM905
_SMART = frozenset({"shared_ptr", "unique_ptr", "scoped_ptr", "intrusive_ptr", "weak_ptr", "Ptr", "ConstPtr"})
_LISTS = frozenset({"std::vector", "std::list", "std::set", "std::deque", "std::array", "std::initializer_list"})
_MAPS = frozenset({"std::map", "std::unordered_map"})
_STREAMS = frozenset({"std::stringstream", "std::ostringstream"})
_OWN = _LISTS | _MAPS | _STREAMS | {"std::string"}
_CALLABLE = frozenset({"std::function", "boost::function"})
_CASTS = frozenset({"static_cast", "dynamic_cast", "const_cast", "reinterpret_cast", "lexical_cast"})
_SAME = frozenset({"ref", "cref", "move", "forward", "dynamic_pointer_cast", "static_pointer_cast"})
_MAKERS = frozenset({"make_shared", "make_unique"})
_PLACEHOLDER = re.compile(r"_\d\Z")
_FOREVER = frozenset({"(true)", "(1)"})
_DELEGATED = ""
"""What stands among the names of bases and members for another constructor of the class."""
_EXITS = frozenset({"exit", "_exit", "abort", "quick_exit"})


class _TooLargeError(Exception):
    """The program is larger than what is looked at."""


def walk_main(program: CppProgram, argv: Sequence[str], calls: Calls) -> bool:
    """Go through the program from its `main`; what it calls is told to `calls`. False if it has none."""
    main = program.main()
    if main is None:
        return False
    _Walk(program, calls).run(main, None, [len(argv), list(argv)])
    return True


def walk_class(program: CppProgram, name: str, method: str | None, calls: Calls) -> bool:
    """Make an object of a class of the program, and call a method of it if one is given. False if there is no such
    class."""
    return _Walk(program, calls).made(tuple(name.split("::")), method)


class _Walk:
    def __init__(self, program: CppProgram, calls: Calls) -> None:
        self._program = program
        self._calls = calls
        self._ways = Ways()
        calls.begin(self._ways)
        self._globals: dict[str, Any] = {}
        self._classes: dict[tuple[object, ...], Class] = {}
        self._macros: dict[str, Any] = {}
        self._waiting: list[Function] = []
        self._visits: dict[int, int] = {}
        self._active: set[int] = set()
        self._returns: list[list[Any]] = []
        self._leading = program.leading_to(calls.words)
        self._late = False
        """Whether only callbacks are left: what leads to no call of a library is left out then."""
        self._known_leading: dict[int, bool] = {}
        self._is_aside = False
        self._steps = 0
        self._depth = 0
        self._nesting = 0

    def run(self, function: FunctionText, instance: Instance | None, args: Sequence[Any]) -> None:
        try:
            with contextlib.suppress(ExitError):
                self._call_text(function, instance, [Argument(arg) for arg in args], {})
            self._callbacks()
        except (_TooLargeError, RecursionError):
            self._calls.cut_short()

    def _callbacks(self) -> None:
        self._late = self._ways.late = True
        for waiting in self._waiting:  # grows while it is gone through
            body = waiting.text.body if waiting.text is not None else waiting.body
            if body is not None and not self._visits.get(body.id):
                with contextlib.suppress(ExitError):
                    self._call_value(waiting, [])

    def made(self, path: Path, method: str | None) -> bool:
        text = self._program.classes.get(path) or self._program.lookup(self._program.classes, path[-1:], path[:-1])
        if text is None:
            return False
        cls = self._class(CppType("::".join(text.path)))
        if cls is None:
            return False
        try:
            instance = self._object(cls, [Argument(UNKNOWN)] if method is None else [])
            if method is None:
                self._callbacks()
                return True
        except ExitError:
            return True
        except (_TooLargeError, RecursionError):
            self._calls.cut_short()
            return True
        found = self._method(instance, method, 0)
        if found is None:
            return False
        self.run(found, instance, [])
        return True

    # Statements. Each returns whether what follows it in the block is not reached.

    def _block(self, nodes: Sequence[Node], scope: Scope) -> bool:
        ended = False
        for index, node in enumerate(nodes):
            ended = self._statement(node, scope) or ended
            if ended and not self._is_aside:
                self._aside(nodes[index + 1 :], scope)
                break
        return ended

    def _aside(self, nodes: Sequence[Node], scope: Scope) -> None:
        """Go through what is not reached, if that tells something, and take back all that it did."""
        if self._is_aside or not any(self._leads(node) for node in nodes) or not self._calls.aside(True):
            return
        self._is_aside = True
        waiting, returned = len(self._waiting), len(self._returns[-1]) if self._returns else 0
        try:
            self._ways.try_out(lambda: self._block(nodes, scope))
        finally:
            self._calls.aside(False)
            self._is_aside = False
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
                self._ways.either(
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
                    self._ways.store(scope.names, text_of(name), made)
                continue
            name = declared_name(declarator)
            if name is not None:
                field = FieldText(text_of(name), type_node, declarator, value, (), scope.file)
                self._ways.store(scope.names, field.name, self._initial(field, scope))

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

    def _initial(self, field: FieldText, scope: Scope) -> Any:
        """The value of a variable as it is declared."""
        type_ = self._type(field.type, scope)
        pointer = is_pointer(field.declarator)
        place = self._place(field.declarator, scope)
        node = field.value
        if node is None:
            if type_ is None or pointer:
                return Unmade(type_) if type_ is not None else UNKNOWN
            return self._make(type_, [], place, scope)
        if node.type in ("argument_list", "initializer_list"):
            if type_ is None or pointer:
                return self._value(first_child(node), scope) if node.named_child_count else None
            if node.type == "initializer_list" and _standard(type_.name) in _LISTS | _MAPS:
                return self._make(type_, [Argument(self._value(node, scope))], place, scope)
            return self._make(type_, self._arguments(node, scope), place, scope)
        value = self._value(node, scope)
        if type_ is None or type_.name in _PRIMITIVES:
            return converted(value, type_)
        if isinstance(value, list) and _standard(type_.name) in _LISTS | _MAPS:
            return self._make(type_, [Argument(value)], place, scope)
        return Unmade(type_) if value is UNKNOWN and _standard(type_.name) != "std::string" else value

    def _if(self, node: Node, scope: Scope) -> bool:
        condition = node.child_by_field_name("condition")
        met = self._condition(condition, scope)
        known = truth(met) if not self._is_aside else None
        then, other = node.child_by_field_name("consequence"), node.child_by_field_name("alternative")
        if known is not None:
            way, left = (then, other) if known else (other, then)
            if left is not None:
                self._aside([left], scope)
            return way is not None and self._statement(way, scope)
        return self._ways.either(
            lambda: then is not None and self._statement(then, scope),
            lambda: other is not None and self._statement(other, scope),
        )

    def _condition(self, node: Node | None, scope: Scope) -> Any:
        if node is None:
            return UNKNOWN
        if node.type == "condition_clause":
            first = node.child_by_field_name("initializer")
            if first is not None:
                for child in first.named_children:
                    self._statement(child, scope)
            return self._condition(node.child_by_field_name("value"), scope)
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
        for _ in range(self._most_turns(body)):
            known = truth(self._value(condition, scope)) if condition is not None else None
            if known is None:
                for name in counters:
                    self._ways.store(scope.names, name, UNKNOWN)
                self._once(body, scope)
                return
            if not known or self._statement(body, scope):
                return
            if update is not None:
                self._value(update, scope)

    def _most_turns(self, body: Node) -> int:
        """How often a loop is gone through: only where a library is called a large number is worth it."""
        return _MAX_TURNS if self._leads(body) else _FEW_TURNS

    def _leads(self, body: Node) -> bool:
        """Whether something of a library may be called in it."""
        if body.id not in self._known_leading:
            self._known_leading[body.id] = not self._leading.isdisjoint(words_in(body))
        return self._known_leading[body.id]

    def _once(self, body: Node, scope: Scope) -> None:
        """Go through what may be done any number of times."""
        self._ways.either(lambda: self._statement(body, scope), lambda: False)

    def _for_range(self, node: Node, scope: Scope) -> None:
        items = self._value(node.child_by_field_name("right"), scope)
        body = node.child_by_field_name("body")
        name = text_of(declared_name(node.child_by_field_name("declarator")))
        if body is None:
            return
        if isinstance(items, list):
            for each in items[:MAX_ITEMS]:
                self._ways.store(scope.names, name, each)
                self._statement(body, scope)
            return
        self._ways.store(scope.names, name, UNKNOWN)
        self._once(body, scope)

    def _while(self, node: Node, scope: Scope) -> None:
        condition, body = node.child_by_field_name("condition"), node.child_by_field_name("body")
        if body is None:
            return
        first, done = node.type == "do_statement", False
        literal = text_of(condition) in _FOREVER
        for _ in range(1 if literal else self._most_turns(body)):
            known = True if first else truth(self._condition(condition, scope))
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
            _, changes = self._ways.try_out(lambda case=case: self._statement(case, scope))  # type: ignore[misc]
            for change in changes.values():
                self._ways.store(change.names, change.name, UNKNOWN)

    def _try(self, node: Node, scope: Scope) -> bool:
        body = node.child_by_field_name("body")
        ended = body is not None and self._statement(body, scope)
        handlers = [child for child in node.named_children if child.type == "catch_clause"]
        for handler in handlers:
            inside = handler.child_by_field_name("body")
            if inside is not None:
                self._ways.try_out(lambda inside=inside: self._statement(inside, scope))  # type: ignore[misc]
        return ended and not handlers

    # Names and types.

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
        text = _fitting(self._program.functions[found], arity) if found is not None else None
        return self._as_value(text, self._own(text, scope)) if text is not None else None

    def _own(self, text: FunctionText, scope: Scope) -> Instance | None:
        this = scope.this
        return this if this is not None and any(c.text.path == text.scope for c in this.cls.order()) else None

    def _method(self, instance: Instance, name: str, arity: int | None) -> FunctionText | None:
        for cls in instance.cls.order():
            found = _fitting(self._program.functions.get((*cls.text.path, name), ()), arity)
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

    # Values.

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
                return self._named(path_of(node), scope)
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
            return owner.names.get(name, UNKNOWN)
        return UNKNOWN

    def _binary(self, node: Node, scope: Scope) -> Any:
        operator = text_of(node.child_by_field_name("operator"))
        left = self._value(node.child_by_field_name("left"), scope)
        if operator == ">>" and not isinstance(left, int):
            read = self._lvalue(node.child_by_field_name("right"), scope)
            if read is not None:
                self._ways.store(read.names, read.name, UNKNOWN)
            return UNKNOWN
        if operator not in ("&&", "||", "and", "or"):
            return binary(operator, left, self._value(node.child_by_field_name("right"), scope))
        stop = operator in ("||", "or")
        known = truth(left)
        if known is stop:
            return stop
        right = truth(self._value(node.child_by_field_name("right"), scope))
        return right if right is stop or (known is not None and right is not None) else UNKNOWN

    def _conditional(self, node: Node, scope: Scope) -> Any:
        known = truth(self._value(node.child_by_field_name("condition"), scope))
        ways = node.child_by_field_name("consequence"), node.child_by_field_name("alternative")
        if known is not None:
            return self._value(ways[0] if known else ways[1], scope)
        return same(self._value(ways[0], scope), self._value(ways[1], scope))

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
                self._ways.store(owner, key, value)
            return value
        reference = self._lvalue(target, scope)
        if target is not None and target.type == "field_expression" and reference is None:
            inside = target.child_by_field_name("argument")
            if isinstance(self._value(inside, scope), Fluent):
                self._changed(inside, UNKNOWN, scope)  # a field of it, of which nothing is known
            elif isinstance(value, Function) and len(self._waiting) < _MAX_WAITING:
                self._waiting.append(value)  # a callback among the options of something
        if reference is not None:
            if isinstance(value, list):
                value = list(value)
            self._ways.store(reference.names, reference.name, value)
        return value

    def _update(self, node: Node, scope: Scope) -> Any:
        target = node.child_by_field_name("argument")
        old = self._value(target, scope)
        step = 1 if "++" in text_of(node.child_by_field_name("operator")) else -1
        new = old + step if isinstance(old, int) else UNKNOWN
        reference = self._lvalue(target, scope)
        if reference is not None:
            self._ways.store(reference.names, reference.name, new)
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
                if isinstance(owner, Instance):
                    return Reference(owner.names, text_of(node.child_by_field_name("field")))
            case "pointer_expression":
                return self._lvalue(node.child_by_field_name("argument"), scope)
            case "parenthesized_expression":
                return self._lvalue(first_child(node), scope)
            case _:
                pass
        return None

    # Objects.

    def _new(self, node: Node, scope: Scope) -> Any:
        type_ = self._type(node.child_by_field_name("type"), scope)
        listed = node.child_by_field_name("arguments") or node.child_by_field_name("value")
        args = self._arguments(listed, scope) if listed is not None else []
        return self._make(type_, args, self._place(node, scope), scope) if type_ is not None else UNKNOWN

    def _make(self, type_: CppType, args: list[Argument], place: Place, scope: Scope) -> Any:
        """An object of a type."""
        first = value_at(args, 0)
        name, last = _standard(type_.name), type_.name.rpartition("::")[2]
        if name == "std::string":
            return "" if not args else first if isinstance(first, str) and len(args) == 1 else UNKNOWN
        if name in _PRIMITIVES:
            return converted(first, type_) if len(args) == 1 else UNKNOWN
        if name in _LISTS:
            return _listed(type_, args)
        if name in _MAPS:
            pairs = first if args and isinstance(first, list) else []
            known = {p[0]: p[1] for p in pairs if isinstance(p, list) and len(p) == 2 and isinstance(p[0], (str, int))}
            return known if len(known) == len(pairs) else UNKNOWN
        if name in _STREAMS:
            return Stream([first] if args else [])
        cls = self._class(type_)
        if cls is not None:
            copied = len(args) == 1 and isinstance(first, Instance) and cls in first.cls.order()
            if copied and not self._has_constructor(cls, 1):
                return first
            return self._object(cls, args)
        if last in _SMART or last.endswith("Ptr") or name in _CALLABLE:
            return first if args else Unmade(_pointed(type_))
        return self._calls.make(type_, args, place)

    def _object(self, cls: Class, args: list[Argument]) -> Instance:
        """A new object, with what its library does with it before anything else."""
        instance = Instance(cls)
        self._construct(instance, cls, args)
        for name in self._calls.called_later(instance):
            text = self._method(instance, name, None)
            if text is not None:
                self._call_text(text, instance, [], {})
        return instance

    def _has_constructor(self, cls: Class, arity: int) -> bool:
        return _fitting(self._program.functions.get((*cls.text.path, cls.text.name), ()), arity) is not None

    def _construct(self, instance: Instance, cls: Class, args: list[Argument]) -> None:
        """What a constructor does to an object."""
        key = id(cls)
        if key in self._active or self._depth > _MAX_DEPTH:
            return
        self._active.add(key)
        self._depth += 1
        try:
            declared = self._program.functions.get((*cls.text.path, cls.text.name), ())
            text = _fitting(declared, len(args))
            if text is None and args and declared and cls.text.bases:
                self._calls.cut_short()  # it is defined in a file that is not known
            types = dict(cls.types)
            file = text.file if text is not None else cls.text.file
            scope = Scope({}, cls.text.path, file, types, instance)
            inits: dict[str, Node] = {}
            if text is not None:
                types |= dict(zip(text.template, cls.types.values(), strict=False))
                self._bind(text, args, scope)
                inits = _initializers(text.initializers, cls.text.path)
            if _DELEGATED in inits:  # another constructor of the same class
                self._active.discard(key)
                self._construct(instance, cls, self._arguments(inits[_DELEGATED], scope))
                self._active.add(key)
            else:
                self._bases(instance, cls, inits, scope)
                self._fields(instance, cls, inits, scope)
            if text is not None and text.body is not None:
                self._body(text.body, scope)
        finally:
            self._depth -= 1
            self._active.discard(key)

    def _bases(self, instance: Instance, cls: Class, inits: dict[str, Node], scope: Scope) -> None:
        around = Scope({}, cls.text.scope, cls.text.file, dict(cls.types))
        for node in cls.text.bases:
            listed = inits.get(path_of(node)[-1])
            args = self._arguments(listed, scope) if listed is not None else []
            type_ = self._type(node, around)
            if type_ is None:
                continue
            base = self._class(type_)
            if base is not None:
                self._construct(instance, base, args)
            else:
                instance.bases.append(self._calls.make(type_, args, self._place(listed or node, scope)))

    def _fields(self, instance: Instance, cls: Class, inits: dict[str, Node], scope: Scope) -> None:
        for field in cls.text.fields:
            if field.static:
                continue
            listed = inits.get(field.name)
            if listed is not None:
                given = FieldText(field.name, field.type, field.declarator, listed, (), scope.file)
                type_scope = Scope(scope.names, cls.text.path, scope.file, scope.types, instance)
                value = self._initial(given, type_scope)
            else:
                value = self._initial(field, Scope({}, cls.text.path, field.file, dict(cls.types), instance))
            self._ways.store(instance.names, field.name, value)

    # Calls.

    def _argument(self, node: Node, scope: Scope) -> Argument:
        value = self._value(node, scope)
        if isinstance(value, Function) and len(self._waiting) < _MAX_WAITING:
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
        taken = self._calls.takes(None if len(path) > 1 else scope.this, name, types, args)
        function = self._function(path, scope, len(args)) if not taken else None
        if function is not None and function.text is not None:
            if function.instance is not None:
                self._calls.notice(function.instance, name, types, args, place)
            return self._call_text(function.text, function.instance, args, self._given(function.text, types))
        type_ = self._type(callee, scope)
        if type_ is not None and (self._class(type_) is not None or type_.name != "::".join(p for p in path if p)):
            return self._make(type_, args, place, scope)
        if type_ is not None and (name in _SMART or _standard(type_.name) in _OWN | _CALLABLE):
            return self._make(type_, args, place, scope)
        if len(path) == 1 and scope.this is not None:
            found = self._library_method(scope.this, name, types, args, place)
            if found is not UNKNOWN:
                return found
        self._may_be_set(path, args)
        written = type_.name if type_ is not None else "::".join(path)
        return self._calls.function(written, types, args, place, self._store)

    def _may_be_set(self, path: Path, args: list[Argument]) -> None:
        """An empty text or container that is given to a function of which nothing is known is for what that finds."""
        for arg in args if path[0] != "ros" else ():
            if arg.reference is not None and arg.value in ("", [], {}):
                self._ways.store(arg.reference.names, arg.reference.name, UNKNOWN)

    def _given(self, text: FunctionText, types: list[CppType]) -> dict[str, CppType]:
        return dict(zip(text.template, types, strict=False))

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
        if isinstance(owner, Instance) and not self._calls.takes(owner, name, types, args):
            text = self._method(owner, name, len(args))
            if text is not None:
                self._calls.notice(owner, name, types, args, place)
                return self._call_text(text, owner, args, self._given(text, types))
        if name == "reset" and len(args) == 1 and not isinstance(owner, (str, list, dict, Stream)):
            reference = self._lvalue(target, scope)
            if reference is not None:
                self._ways.store(reference.names, reference.name, args[0].value)
            return None
        if isinstance(owner, Stream):
            return self._stream(owner, name, args)
        if isinstance(owner, str):
            found = text_method(owner, name, values(args))
            if name == "append" and (reference := self._lvalue(target, scope)) is not None:
                self._ways.store(reference.names, reference.name, found)
            return found
        if isinstance(owner, (list, dict)):
            return self._container(owner, name, args)
        if owner is UNKNOWN or isinstance(owner, Instance):
            self._may_be_set(path, args)
        if owner is UNKNOWN:
            return UNKNOWN
        found = self._library_method(owner, name, types, args, place)
        if isinstance(owner, Fluent) and isinstance(found, type(owner)):
            self._changed(target, found, scope)
        return found

    def _changed(self, node: Node | None, value: Any, scope: Scope) -> None:
        """Store what the variable holds now on which `a.f().g()` was called."""
        while node is not None and node.type == "call_expression":
            callee = node.child_by_field_name("function")
            node = callee.child_by_field_name("argument") if callee is not None else None
        reference = self._lvalue(node, scope)
        if reference is not None:
            self._ways.store(reference.names, reference.name, value)

    def _stream(self, stream: Stream, name: str, args: list[Argument]) -> Any:
        if name == "str":
            if not args:
                return text_of_stream(stream)
            stream.parts[:] = [args[0].value] if args[0].value != "" else []
        return UNKNOWN

    def _container(self, owner: list[Any] | dict[Any, Any], name: str, args: list[Argument]) -> Any:
        if isinstance(owner, list) and name in ("push_back", "emplace_back", "insert", "push", "add") and args:
            if len(owner) < MAX_ITEMS and not self._ways.inside:
                owner.append(args[-1].value)
            return None
        if name == "clear" and not self._ways.inside:
            owner.clear()
            return None
        return items_method(owner, name, values(args))

    def _library_method(self, owner: Any, name: str, types: list[CppType], args: list[Argument], place: Place) -> Any:
        found = self._calls.method(owner, name, types, args, place, self._store)
        for base in owner.bases if isinstance(owner, Instance) and found is UNKNOWN else ():
            found = self._calls.method(base, name, types, args, place, self._store)
            if found is not UNKNOWN:
                break
        return found

    def _store(self, argument: Argument, value: Any, /) -> None:
        if argument.reference is not None:
            self._ways.store(argument.reference.names, argument.reference.name, value)

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
        self._visits[function.body.id] = self._visits.get(function.body.id, 0) + 1
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
        if self._depth > _MAX_DEPTH or self._visits.get(key, 0) >= _MAX_VISITS:
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
        self._visits[body.id] = self._visits.get(body.id, 0) + 1
        self._statement(body, scope)

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
                value = (
                    Unmade(_pointed(type_)) if _standard(type_.name) not in _PRIMITIVES | {"std::string"} else UNKNOWN
                )
            if parameter.name:
                scope.names[parameter.name] = value

    def _place(self, node: Node, scope: Scope) -> Place:
        return Place(scope.file.path, node.start_point.row + 1)

    def _step(self) -> None:
        self._steps += 1
        if self._steps > MAX_STEPS:
            raise _TooLargeError


def _pointed(type_: CppType) -> CppType:
    """What a pointer of that type points to; the type itself if it is none."""
    return type_.args[0] if type_.args and type_.name.rpartition("::")[2] in _SMART else type_


def _listed(type_: CppType, args: list[Argument]) -> Any:
    """A container of the items that are given."""
    first = value_at(args, 0)
    if not args:
        return []
    kind = type_.args[0] if type_.args else None
    return [converted(each, kind) for each in first] if len(args) == 1 and isinstance(first, list) else UNKNOWN


def _standard(name: str) -> str:
    """`std::string` of `string`, where all of `std` is used."""
    return f"std::{name}" if f"std::{name}" in _OWN else name


def _fitting(functions: Sequence[FunctionText], arity: int | None) -> FunctionText | None:
    """The one among overloaded functions that takes so many arguments; with a body, if there is one."""
    found = [f for f in functions if f.body is not None]
    if arity is None or not found:
        return found[0] if found else None
    for each in found:
        if len(each.parameters) == arity:
            return each
    # Others have defaults, which may stand in a declaration that was not seen.
    return min((f for f in found if len(f.parameters) > arity), key=lambda f: len(f.parameters), default=None)


def _initializers(node: Node | None, cls: Path) -> dict[str, Node]:
    """What a constructor initialises its bases and members with, by their last name; a base may be called as the class
    is in another namespace."""
    found: dict[str, Node] = {}
    for child in node.named_children if node is not None else ():
        if child.type == "field_initializer" and child.named_child_count > 1:
            listed = child.named_children[-1]
            if listed.type in ("argument_list", "initializer_list"):
                path = path_of(child.named_children[0])
                found[_DELEGATED if path == cls[-len(path) :] else path[-1]] = listed
    return found


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


def _is_directive(node: Node) -> bool:
    return node.type in ("preproc_else", "preproc_elif", "preproc_elifdef", "identifier", "preproc_defined")
