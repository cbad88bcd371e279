"""Makes the values of a C++ program's variables, and its objects with their bases and members."""

from __future__ import annotations

from abc import abstractmethod
from typing import Any

from tree_sitter import Node

from preflight_analysis.source.cpp_frames import message_of
from preflight_analysis.source.cpp_functions import MAX_DEPTH, Functions
from preflight_analysis.source.cpp_names import fitting
from preflight_analysis.source.cpp_operators import converted
from preflight_analysis.source.cpp_text import FieldText, Path, first_child, is_pointer, is_reference, path_of
from preflight_analysis.source.cpp_types import (
    CALLABLE,
    LISTS,
    MAPS,
    PRIMITIVES,
    SMART_POINTERS,
    STREAMS,
    pointed,
    standard,
)
from preflight_analysis.source.cpp_values import (
    Argument,
    Class,
    CppType,
    Instance,
    Message,
    Place,
    Scope,
    Stream,
    Unmade,
    value_at,
)
from preflight_analysis.source.python_values import UNKNOWN

_DELEGATED = ""
"""What stands among the names of bases and members for another constructor of the class."""


class Objects(Functions):
    """What a declaration or a constructor makes. A class that is not of the program is left to `Calls`."""

    @abstractmethod
    def _arguments(self, node: Node | None, scope: Scope) -> list[Argument]:
        """The arguments of a call."""

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
            given = self._made_of(type_, node, scope)
            if is_reference(field.declarator) and self._class(type_) is not None:
                value = value_at(given, 0)  # the object itself, no other one that is made of it
                return Unmade(type_) if value is UNKNOWN else value
            return self._make(type_, given, place, scope)
        value = self._value(node, scope)
        if type_ is None or type_.name in PRIMITIVES:
            return converted(value, type_)
        if isinstance(value, list) and standard(type_.name) in LISTS | MAPS:
            return self._make(type_, [Argument(value)], place, scope)
        if value is UNKNOWN and standard(type_.name) != "std::string":
            return Unmade(type_)
        return value.copy() if isinstance(value, Message) and not (pointer or is_reference(field.declarator)) else value

    def _new(self, node: Node, scope: Scope) -> Any:
        type_ = self._type(node.child_by_field_name("type"), scope)
        listed = node.child_by_field_name("arguments") or node.child_by_field_name("value")
        if type_ is None:
            if listed is not None:
                self._arguments(listed, scope)
            return UNKNOWN
        args = self._made_of(type_, listed, scope) if listed is not None else []
        return self._make(type_, args, self._place(node, scope), scope)

    def _made_of(self, type_: CppType, listed: Node, scope: Scope) -> list[Argument]:
        """What an object is made of: of a container, what stands in braces are its items."""
        if listed.type == "initializer_list" and listed.named_child_count and standard(type_.name) in LISTS | MAPS:
            return [Argument(self._value(listed, scope))]
        return self._arguments(listed, scope)

    def _make(self, type_: CppType, args: list[Argument], place: Place, scope: Scope) -> Any:
        """An object of a type."""
        first = value_at(args, 0)
        name, last = standard(type_.name), type_.name.rpartition("::")[2]
        if name == "std::string":
            return "" if not args else first if isinstance(first, str) and len(args) == 1 else UNKNOWN
        if name in PRIMITIVES:
            return converted(first, type_) if len(args) == 1 else UNKNOWN
        if name in LISTS:
            return _listed(type_, args)
        if name in MAPS:
            pairs = first if args and isinstance(first, list) else []
            known = {p[0]: p[1] for p in pairs if isinstance(p, list) and len(p) == 2 and isinstance(p[0], (str, int))}
            return known if len(known) == len(pairs) else UNKNOWN
        if name in STREAMS:
            return Stream([first] if args else [])
        cls = self._class(type_)
        if cls is not None:
            copied = len(args) == 1 and isinstance(first, Instance) and cls in first.cls.order()
            if copied and not self._has_constructor(cls, 1):
                return first
            return self._object(cls, args)
        if last in SMART_POINTERS or last.endswith("Ptr") or name in CALLABLE:
            return first if args else Unmade(pointed(type_))
        if (message := message_of(type_, args)) is not None:
            return message
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
        return fitting(self._program.functions.get((*cls.text.path, cls.text.name), ()), arity) is not None

    def _construct(self, instance: Instance, cls: Class, args: list[Argument]) -> None:
        """What a constructor does to an object."""
        key = id(cls)
        if key in self._active or self._depth > MAX_DEPTH:
            return
        self._active.add(key)
        self._depth += 1
        try:
            declared = self._program.functions.get((*cls.text.path, cls.text.name), ())
            text = fitting(declared, len(args))
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
            self._branches.store(instance.names, field.name, value)


def _listed(type_: CppType, args: list[Argument]) -> Any:
    """A container of the items that are given."""
    first = value_at(args, 0)
    if not args:
        return []
    kind = type_.args[0] if type_.args else None
    return [converted(each, kind) for each in first] if len(args) == 1 and isinstance(first, list) else UNKNOWN


def _initializers(node: Node | None, cls: Path) -> dict[str, Node]:
    """What a constructor initialises its bases and members with, by their last name; a base may be called as the class
    is in another namespace."""
    found: dict[str, Node] = {}
    for child in node.named_children if node is not None else ():
        if child.type == "field_initializer" and child.named_child_count > 1:
            listed = child.named_children[-1]
            if listed.type in ("argument_list", "initializer_list"):
                path = path_of(child.named_children[0])
                found[_DELEGATED if _is_class(path, cls) else path[-1]] = listed
    return found


def _is_class(path: Path, cls: Path) -> bool:
    """Whether it names the class, or its constructor: `Filter<T>`, `Filter<T>::Filter`."""
    return path == cls[-len(path) :] or (path[-1] == cls[-1] and path[:-1] == cls[-len(path) + 1 :])
