"""C++ text to what a file declares, also where the text does not quite parse. Knows the language and no library."""

from __future__ import annotations

import re
import threading
from collections.abc import Iterator, Sequence
from dataclasses import field

import tree_sitter_cpp
from tree_sitter import Language, Node, Parser

from preflight_analysis.dataclass import dataclass

MAX_CHARACTERS = 1_000_000
MAX_DEPTH = 40
_LANGUAGE = Language(tree_sitter_cpp.language())
_parsing = threading.Lock()
_MACROS = re.compile(
    r"\b(?:Q_OBJECT|Q_GADGET|EIGEN_MAKE_ALIGNED_OPERATOR_NEW|(?!RMW_QOS_)[A-Z][A-Z0-9_]*_(?:PUBLIC|EXPORT|LOCAL)"
    r"|RCLCPP_\w+_DEFINITIONS(?:_NOT_COPYABLE)?\(\s*[\w:]+\s*\))(?!\w)(?!\s*\()"
)
"""What stands in a class without a semicolon, or in front of a name, and the parser takes for a part of it."""

CONDITIONAL = frozenset({"preproc_if", "preproc_ifdef", "preproc_else", "preproc_elif", "preproc_elifdef"})
"""What stands between `#if` and `#endif` is in them; it may be anything that may stand around them."""
_CONTAINERS = CONDITIONAL | {"translation_unit", "declaration_list", "linkage_specification", "ERROR"}
_CLASSES = frozenset({"class_specifier", "struct_specifier"})


@dataclass(frozen=True, slots=True)
class Parameter:
    """One parameter of a function. `changes` tells that it is a reference through which the caller's may change."""

    name: str
    type: Node | None
    changes: bool
    default: Node | None = None


@dataclass(frozen=True, slots=True)
class FunctionText:
    """A function with a body, or the declaration of one. `scope` are the names around it, its class among them."""

    name: str
    scope: tuple[str, ...]
    parameters: tuple[Parameter, ...]
    body: Node | None
    initializers: Node | None
    template: tuple[str, ...]
    file: FileText


@dataclass(frozen=True, slots=True)
class FieldText:
    """A member of a class that is a value, a variable outside of functions, or a local one."""

    name: str
    type: Node
    declarator: Node
    value: Node | None
    """What initialises it: an expression, or the list of a constructor's arguments."""
    scope: tuple[str, ...]
    file: FileText
    static: bool = False


@dataclass(eq=False, slots=True)
class ClassText:
    """A class as its definition has it."""

    name: str
    scope: tuple[str, ...]
    bases: tuple[Node, ...]
    fields: tuple[FieldText, ...]
    template: tuple[str, ...]
    file: FileText
    line: int

    @property
    def path(self) -> tuple[str, ...]:
        """The names around it and its own."""
        return (*self.scope, self.name)


Path = tuple[str, ...]
"""A qualified name: `("ns", "Class", "method")`."""


@dataclass(eq=False, slots=True)
class FileText:
    """What one file declares, each by its qualified name."""

    path: str
    includes: list[str] = field(default_factory=list)
    defines: dict[str, str] = field(default_factory=dict)
    """Macros, and what each stands for; "" also for one that is defined as this and as that: the build decides."""
    classes: dict[Path, ClassText] = field(default_factory=dict)
    functions: dict[Path, list[FunctionText]] = field(default_factory=dict)
    aliases: dict[Path, tuple[Node, tuple[str, ...]]] = field(default_factory=dict)
    """Names of types: the type, and the names around it."""
    variables: dict[Path, FieldText] = field(default_factory=dict)
    namespaces: list[Path] = field(default_factory=list)
    """All of which is used by its short name."""


def parse(path: str, text: str) -> FileText | None:
    """What the file declares; None if it is too large to be looked at."""
    if len(text) > MAX_CHARACTERS:
        return None
    plain = _MACROS.sub(lambda macro: " " * len(macro[0]), text)
    with _parsing:  # a parser is for one thread
        tree = _parser.parse(plain.encode("utf-8", "replace"))
    found = FileText(path)
    _collect(tree.root_node, (), (), found, 0)
    return found


_parser = Parser(_LANGUAGE)
_TYPE_NAME = re.compile(r"(?:\w+::)+[A-Z]\w*")


def parse_expression(text: str) -> Node | None:
    """The expression that a macro stands for."""
    with _parsing:
        tree = _parser.parse(f"auto x = {text};".encode("utf-8", "replace"))
    declaration = first_child(tree.root_node)
    declarator = declaration.child_by_field_name("declarator") if declaration is not None else None
    return declarator.child_by_field_name("value") if declarator is not None else None


def parse_type(name: str) -> Node | None:
    """The type that a qualified name stands for."""
    with _parsing:
        tree = _parser.parse(f"using T = {name};".encode())
    declaration = first_child(tree.root_node)
    return declaration.child_by_field_name("type") if declaration is not None else None


def text_of(node: Node | None) -> str:
    """The text of a node; "" for none."""
    return (node.text or b"").decode("utf-8", "replace") if node is not None else ""


def first_child(node: Node | None) -> Node | None:
    """The first named child, None if there is none."""
    return node.named_child(0) if node is not None and node.named_child_count else None


def path_of(node: Node | None) -> Path:
    """The names of a qualified name, template arguments left out."""
    if node is None:
        return ()
    if node.type == "qualified_identifier":
        return path_of(node.child_by_field_name("scope")) + path_of(node.child_by_field_name("name"))
    if node.type in ("template_type", "template_function", "template_method", "dependent_name", *_CLASSES):
        return path_of(node.child_by_field_name("name") or first_child(node))
    if node.type == "nested_namespace_specifier":
        return tuple(part.strip() for part in text_of(node).split("::"))
    return (text_of(node),)


def declarators(node: Node) -> Iterator[tuple[Node, Node | None]]:
    """Each declarator of a declaration, with what initialises it."""
    values = {n.start_byte: n for n in node.children_by_field_name("default_value")}
    found = node.children_by_field_name("declarator")
    for index, declarator in enumerate(found):
        if declarator.type == "init_declarator":
            inner = declarator.child_by_field_name("declarator")
            if inner is not None:
                yield inner, declarator.child_by_field_name("value")
            continue
        end = found[index + 1].start_byte if index + 1 < len(found) else node.end_byte
        value = next((v for at, v in values.items() if declarator.end_byte <= at < end), None)
        yield declarator, value


def declared_name(declarator: Node | None) -> Node | None:
    """The name within `*&name[3]`."""
    for _ in range(MAX_DEPTH):
        if declarator is None or declarator.type in (
            "identifier",
            "field_identifier",
            "type_identifier",
            "qualified_identifier",
            "destructor_name",
            "operator_name",
        ):
            return declarator
        inner = declarator.child_by_field_name("declarator")
        if inner is None and declarator.type in (
            "reference_declarator",
            "parenthesized_declarator",
            "variadic_declarator",
        ):
            inner = first_child(declarator)
        declarator = inner
    return None


def is_pointer(declarator: Node | None) -> bool:
    """Whether `declarator` declares a pointer."""
    return _declares(declarator, ("pointer_declarator", "abstract_pointer_declarator"))


def is_reference(declarator: Node | None) -> bool:
    """Whether `declarator` declares a reference."""
    return _declares(declarator, ("reference_declarator",))


def _declares(declarator: Node | None, kinds: tuple[str, ...]) -> bool:
    for _ in range(MAX_DEPTH):
        if declarator is None or declarator.type in ("identifier", "field_identifier"):
            return False
        if declarator.type in kinds:
            return True
        declarator = declarator.child_by_field_name("declarator") or first_child(declarator)
    return False


def function_declarator(declarator: Node | None) -> Node | None:
    """The `name(parameters)` within a declarator, None if it declares no function."""
    for _ in range(MAX_DEPTH):
        if declarator is None:
            return None
        if declarator.type == "function_declarator":
            return declarator
        if declarator.type not in ("pointer_declarator", "reference_declarator"):
            return None
        declarator = declarator.child_by_field_name("declarator") or first_child(declarator)
    return None


def parameters_of(declarator: Node | None) -> tuple[Parameter, ...]:
    """The parameters of a function or of a lambda."""
    listed = declarator.child_by_field_name("parameters") if declarator is not None else None
    found: list[Parameter] = []
    for child in listed.named_children if listed is not None else ():
        if child.type not in ("parameter_declaration", "optional_parameter_declaration"):
            continue
        inner = child.child_by_field_name("declarator")
        reference = inner is not None and inner.type in ("reference_declarator", "abstract_reference_declarator")
        constant = any(c.type == "type_qualifier" and text_of(c) == "const" for c in child.children)
        type_ = child.child_by_field_name("type")
        if text_of(type_) == "void" and inner is None:
            continue
        name = text_of(declared_name(inner))
        found.append(Parameter(name, type_, reference and not constant, child.child_by_field_name("default_value")))
    return tuple(found)


def _collect(node: Node, scope: Path, template: tuple[str, ...], file: FileText, depth: int) -> None:
    if depth > MAX_DEPTH:
        return
    for child in node.named_children:
        _declaration(child, scope, template, file, depth)


def _declaration(node: Node, scope: Path, template: tuple[str, ...], file: FileText, depth: int) -> None:
    match node.type:
        case "preproc_include":
            file.includes.append(text_of(node.child_by_field_name("path")).strip('"<>'))
        case "preproc_def":
            name = text_of(node.child_by_field_name("name"))
            value = text_of(node.child_by_field_name("value")).strip()
            file.defines[name] = value if file.defines.get(name, value) == value else ""
            if _TYPE_NAME.fullmatch(value):  # of a base class, for instance; of several the first counts
                type_ = parse_type(value)
                if type_ is not None:
                    file.aliases.setdefault((name,), (type_, ()))
        case "preproc_if" if text_of(node.child_by_field_name("condition")) == "0":
            other = node.child_by_field_name("alternative")
            if other is not None:
                _collect(other, scope, template, file, depth + 1)
        case kind if kind in _CONTAINERS:
            _broken(node, scope, file)
            _collect(node, scope, template, file, depth + 1)
        case "namespace_definition":
            body = node.child_by_field_name("body")
            name_node = node.child_by_field_name("name")
            names = tuple(part for part in text_of(name_node).replace("inline", "").split("::") if part.strip())
            if body is not None:
                _collect(body, (*scope, *names), (), file, depth + 1)
        case "template_declaration":
            names = _template_names(node.child_by_field_name("parameters"))
            _collect(node, scope, (*template, *names), file, depth + 1)
        case "class_specifier" | "struct_specifier":
            _class(node, scope, template, file, depth)
        case "function_definition":
            _function(node, scope, template, file, depth)
        case "declaration" | "field_declaration":
            _variables(node, scope, template, file, depth)
        case "type_definition" | "alias_declaration":
            for name_, type_ in aliases_in(node):
                file.aliases.setdefault((*scope, name_), (type_, scope))
            inner = node.child_by_field_name("type")
            if inner is not None and inner.type in _CLASSES:
                _class(inner, scope, template, file, depth)
        case "namespace_alias_definition":
            alias = text_of(node.child_by_field_name("name"))
            meant = node.named_children[-1] if node.named_child_count > 1 else None
            if meant is not None:
                file.aliases.setdefault((*scope, alias), (meant, scope))
        case "using_declaration":
            names_used = path_of(next((c for c in node.named_children), None))
            if any(c.type == "namespace" for c in node.children):
                file.namespaces.append(names_used)
            elif len(names_used) > 1 and (target := first_child(node)) is not None:
                file.aliases.setdefault((*scope, names_used[-1]), (target, ()))
        case _:
            pass


def _broken(node: Node, scope: Path, file: FileText) -> None:
    """A function in which something does not parse may be no function any more: its statements follow its head."""
    heads = [child for child in node.named_children if child.type == "function_declarator"]
    if node.type == "ERROR" and heads and (names := path_of(heads[0].child_by_field_name("declarator"))):
        path = (*scope, *names)
        text = FunctionText(path[-1], path[:-1], parameters_of(heads[0]), node, None, (), file)
        file.functions.setdefault(path, []).append(text)


def aliases_in(node: Node) -> Iterator[tuple[str, Node]]:
    """The names that a `typedef` or `using` gives to a type."""
    type_ = node.child_by_field_name("type")
    if type_ is None:
        return
    if node.type == "alias_declaration":
        yield text_of(node.child_by_field_name("name")), type_
        return
    for declarator in node.children_by_field_name("declarator"):
        name = declared_name(declarator)
        if name is not None:
            yield text_of(name), type_


def _template_names(parameters: Node | None) -> tuple[str, ...]:
    found = []
    for child in parameters.named_children if parameters is not None else ():
        name = child.child_by_field_name("name") or (child.named_children[0] if child.named_children else None)
        found.append(text_of(declared_name(child.child_by_field_name("declarator")) or name))
    return tuple(found)


def _class(node: Node, scope: Path, template: tuple[str, ...], file: FileText, depth: int) -> None:
    body = node.child_by_field_name("body")
    names = path_of(node.child_by_field_name("name"))
    if body is None or not names or depth > MAX_DEPTH:
        return
    path = (*scope, *names)
    bases: list[Node] = []
    for clause in node.children:
        if clause.type == "base_class_clause":
            bases += [
                c
                for c in clause.named_children
                if c.type in ("type_identifier", "qualified_identifier", "template_type")
            ]
    before = set(file.variables)
    _collect(body, path, template, file, depth + 1)
    own = [key for key in file.variables if key not in before and key[:-1] == path]
    fields = tuple(file.variables[key] for key in own)
    for key, each in zip(own, fields, strict=True):
        if not each.static:
            del file.variables[key]
    line = node.start_point.row + 1
    file.classes.setdefault(path, ClassText(path[-1], path[:-1], tuple(bases), fields, template, file, line))


def _function(node: Node, scope: Path, template: tuple[str, ...], file: FileText, depth: int) -> None:
    declarator = function_declarator(node.child_by_field_name("declarator"))
    body = node.child_by_field_name("body")
    if declarator is None:
        # A macro that the parser does not know may stand in front of a class or namespace.
        if body is not None and body.type != "compound_statement":
            _collect(body, scope, template, file, depth + 1)
        return
    names = path_of(declarator.child_by_field_name("declarator"))
    if not names:
        return
    initializers = next((c for c in node.children if c.type == "field_initializer_list"), None)
    if body is None:  # `: a_(b) try { ... }`
        body = next((c for c in node.children if c.type in ("compound_statement", "try_statement")), None)
    path = (*scope, *names)
    text = FunctionText(path[-1], path[:-1], parameters_of(declarator), body, initializers, template, file)
    file.functions.setdefault(path, []).append(text)


def _variables(node: Node, scope: Path, template: tuple[str, ...], file: FileText, depth: int) -> None:
    type_ = node.child_by_field_name("type")
    if type_ is not None and type_.type in _CLASSES:
        _class(type_, scope, template, file, depth)
    static = any(c.type == "storage_class_specifier" and text_of(c) == "static" for c in node.children)
    for declarator, value in declarators(node):
        if (called := function_declarator(declarator)) is not None and not arguments_as_declared(called):
            names = path_of(called.child_by_field_name("declarator"))
            path = (*scope, *names)
            if names:
                text = FunctionText(path[-1], path[:-1], parameters_of(called), None, None, template, file)
                file.functions.setdefault(path, []).append(text)
            continue
        name = declared_name(declarator if called is None else called.child_by_field_name("declarator"))
        if name is None or type_ is None:
            continue
        path = (*scope, *path_of(name))
        given = value if called is None else called.child_by_field_name("parameters")
        found = FieldText(path[-1], type_, declarator, given, path[:-1], file, static)
        known = file.variables.get(path)
        if known is None or known.value is None:
            file.variables[path] = found


def arguments_as_declared(declarator: Node) -> Sequence[Node]:
    """The arguments of a variable that reads like a function's declaration: `Thing thing(handle, "x");`.

    Only where one of them cannot be a parameter; `Thing thing(handle)` is told by where it stands.
    """
    listed = declarator.child_by_field_name("parameters")
    children = listed.named_children if listed is not None else []
    plain = ("parameter_declaration", "optional_parameter_declaration", "variadic_parameter_declaration", "comment")
    return children if any(child.type not in plain for child in children) else ()
