"""The declarations of all files of a C++ program together, and how a name in one of them is looked up."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TypeVar

from tree_sitter import Node

from preflight_analysis.source.cpp_text import (
    ClassText,
    FieldText,
    FileText,
    FunctionText,
    Path,
    first_child,
    path_of,
    text_of,
)
from preflight_analysis.source.cpp_values import CppType, Scope

_T = TypeVar("_T")
MAX_DEPTH = 12
_WORD = re.compile(r"[A-Za-z_]\w*")
_MAX_ARGUMENTS = 16
_CHANGED = re.compile(
    r"[;{})]\s*(?:this->)?(\w+)\s*=\s*(?:true|false|-?\d[\d.]*f?)\s*;"
    r"|(\w+)\s*(?:\.|->)\s*(?:push_back|push_front|push|emplace_back|emplace|insert)\s*\("
)
_OF_PARAMETERS = re.compile(r"[^;{}]*[pP]aram[^;{}]*;")


class CppProgram:
    """The files of one program, the one that counts for a name first."""

    def __init__(self, files: Sequence[FileText]) -> None:
        self.files = tuple(files)
        self.defines: dict[str, str] = {}
        self.classes: dict[Path, ClassText] = {}
        self.functions: dict[Path, list[FunctionText]] = {}
        self.variables: dict[Path, FieldText] = {}
        self._aliases: dict[Path, tuple[Node, Path, FileText]] = {}
        namespaces: dict[Path, None] = {}
        for file in self.files:
            self.defines = {**file.defines, **self.defines}
            self.classes = {**file.classes, **self.classes}
            namespaces.update(dict.fromkeys(file.namespaces))
            for path, (node, scope) in file.aliases.items():
                self._aliases.setdefault(path, (node, scope, file))
        self._namespaces = tuple(namespaces)
        self.includes = tuple(include for file in self.files for include in file.includes)
        for file in self.files:
            for path, functions in file.functions.items():
                whole = self._whole(path, file)
                found = functions if whole == path else [replace(each, scope=whole[:-1]) for each in functions]
                self.functions.setdefault(whole, []).extend(found)
            for path, variable in file.variables.items():
                whole = self._whole(path, file)
                known = self.variables.get(whole)
                if known is None or known.value is None:
                    self.variables[whole] = replace(variable, scope=whole[:-1])

    def _whole(self, path: Path, file: FileText) -> Path:
        """The name of a member that is defined outside of its class, where namespaces that are used are left out, or
        the file has another name for the class or its namespace."""
        cls = path[:-1]
        if not cls or cls in self.classes:
            return path
        for length in range(len(cls), 0, -1):
            meant = file.aliases.get(cls[:length])
            if meant is not None and (*(named := path_of(meant[0])), *cls[length:]) in self.classes:
                return (*named, *path[length:])
        for space in self._namespaces:
            if (*space, *cls) in self.classes:
                return (*space, *path)
        return path

    def lookup(self, table: Mapping[Path, _T], path: Path, where: Path) -> _T | None:
        """What `path` means at a place within the names `where`."""
        found = self.find(table, path, where)
        return table[found] if found is not None else None

    def find(self, table: Mapping[Path, object], path: Path, where: Path) -> Path | None:
        """The qualified name of what `path` means at a place within the names `where`."""
        if path[:1] == ("",):
            path, where = path[1:], ()
        for length in range(len(where), -1, -1):
            if (*where[:length], *path) in table:
                return (*where[:length], *path)
        return next(((*space, *path) for space in self._namespaces if (*space, *path) in table), None)

    def type_of(self, node: Node | None, scope: Scope, depth: int = 0) -> CppType | None:
        """The type that is written at `node`; None for `auto` and what is no type."""
        if node is None or depth > MAX_DEPTH:
            return None
        if node.type in ("type_descriptor", "dependent_type"):
            inner = node.child_by_field_name("type") or first_child(node)
            return self.type_of(inner, scope, depth + 1)
        if node.type in ("placeholder_type_specifier", "auto", "decltype"):
            return None
        args = tuple(
            found
            for each in template_arguments(node)[:_MAX_ARGUMENTS]
            if (found := self.type_of(each, scope, depth + 1)) is not None
        )
        return self.named_type(path_of(node), args, scope, depth)

    def named_type(self, path: Path, args: tuple[CppType, ...], scope: Scope, depth: int = 0) -> CppType:
        """The type of a name, what aliases mean put in its place."""
        bound: Scope | None = scope
        while bound is not None and path:
            if path[0] in bound.types:
                known = bound.types[path[0]]
                return _inside(known, path[1:], args)
            bound = bound.parent
        places = [scope.where]
        if scope.this is not None:
            places += [cls.text.path for cls in scope.this.cls.order()]
        for where in places:
            for length in range(len(path), 0, -1):
                if (found := self.find(self._aliases, path[:length], where)) is not None:
                    node, around, file = self._aliases[found]
                    if path_of(node) == path[:length] and around == where:
                        continue  # `using X = X;`
                    inner = Scope({}, around, file, scope.types, scope.this)
                    meant = self.type_of(node, inner, depth + 1)
                    if meant is not None:
                        return _inside(meant, path[length:], args)
        cls = next((c for where in places if (c := self.find(self.classes, path, where)) is not None), None)
        return CppType("::".join(cls or tuple(part for part in path if part)), args, scope.file)

    def leading_to(self, words: frozenset[str]) -> frozenset[str]:
        """The names of functions and types in whose text one of the words stands, or a name that leads to one."""
        parts: list[tuple[str, frozenset[str]]] = []
        for functions in self.functions.values():
            parts += [(f.name, words_in(f.body, f.initializers)) for f in functions if f.body is not None]
        for cls in self.classes.values():
            nodes = [node for field in cls.fields for node in (field.type, field.value)]
            parts.append((cls.name, words_in(*cls.bases, *nodes)))
        parts += [(path[-1], words_in(node)) for path, (node, _, _) in self._aliases.items()]
        found: set[str] = set(words)
        while True:
            more = {name for name, mentioned in parts if name not in found and not mentioned.isdisjoint(found)}
            if not more:
                return frozenset(found)
            found |= more

    def flags(self) -> frozenset[str]:
        """The variables that callbacks change from what they are at first: they get a literal or an item in a function
        that is neither a constructor nor `main`, and no parameter."""
        found, given = set[str](), set[str]()
        for each in (each for functions in self.functions.values() for each in functions if each.body is not None):
            text = text_of(each.body)
            for statement in _OF_PARAMETERS.findall(text):
                given.update(_WORD.findall(statement))
            if each.name != "main" and each.name not in each.scope[-1:]:
                found.update(match[1] or match[2] for match in _CHANGED.finditer(text))
        return frozenset(found - given)

    def class_of(self, type_: CppType) -> ClassText | None:
        """The class of the program that a type is."""
        return self.classes.get(tuple(type_.name.split("::")))

    def main(self) -> FunctionText | None:
        """Where the program starts."""
        found = self.functions.get(("main",), ())
        return next((each for each in found if each.body is not None), None)


def words_in(*nodes: Node | None) -> frozenset[str]:
    """The words in the text of the nodes."""
    return frozenset(word for node in nodes if node is not None for word in _WORD.findall(text_of(node)))


def _inside(type_: CppType, rest: Path, args: tuple[CppType, ...]) -> CppType:
    return CppType("::".join((type_.name, *rest)), args or type_.args, type_.file)


def template_arguments(node: Node | None) -> list[Node]:
    """The arguments of the last template in a qualified name."""
    for _ in range(MAX_DEPTH):
        if node is None:
            return []
        if node.type in ("template_type", "template_function", "template_method"):
            listed = node.child_by_field_name("arguments")
            return listed.named_children if listed is not None else []
        if node.type == "qualified_identifier":
            name = node.child_by_field_name("name")
            found = template_arguments(name)
            if found:
                return found
            node = node.child_by_field_name("scope")
        elif node.type == "dependent_name":
            node = first_child(node)
        else:
            return []
    return []
