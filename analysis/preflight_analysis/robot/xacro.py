"""What is written in one file of a robot description or a world, without xacro: what it defines, what it asks for.

The names are those of xacro 1.14 and 2.0 (`xacro/__init__.py`: `eval_all`, `grab_macro`, `global_symbols`), which reads
files in order, looks a property up when it is used, and keeps those of a macro's call in a scope of its own.
"""

from __future__ import annotations

import ast
import builtins
import math
import re
import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field
from typing import Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.disk import text_of
from preflight_analysis.documents.document import Document, Element, SpannedText, Text
from preflight_analysis.documents.reading import Text as FileText
from preflight_analysis.documents.span import Span
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query

XACRO = "xacro:"
_LONGEST = 400_000
"""Characters of a file that is read: worlds may have all that is in them in one."""
_PARAMETER = re.compile(r"\s*([^\s:=]+)\s*(?:(:?=)\s*(\^\|?)?((?:'[^']*')|(?:\"[^\"]*\")|[^\s]*))?")
# With bounds: an unclosed bracket may have thousands of others behind it.
_EXPRESSION = re.compile(r"(?<!\$)(\$+)(?:\{([^}]{0,1000})\}|\(([^()]{0,1000})\))")
COMPUTED = re.compile(r"(?<!\$)\$+(?:\{[^}]{0,1000}\}|\([^()]{0,1000}\))")
"""What xacro puts a value in the place of."""
_GAZEBO = "gazebo"
_CONTROL = "ros2_control"
_NAMING = re.compile(r"(?i)(?:.*joint(?:_?name)?|body_?name|frame_?name)$")
"""Elements of Gazebo's plugins that name a joint, link or frame."""
_ELSEWHERE = frozenset(("gazebo", "transmission", "ros2_control", "group", "group_state", "plugin", "sensor"))
"""Elements whose links and joints are not those of the robot; those of `<gazebo>` come to the model beside them."""
OF_JOINTS = frozenset(("preserveFixedJoint", "disableFixedJointLumping"))
"""Elements of `<gazebo>` that sdformat looks up by the name of a joint alone (`FixedJointShouldBeReduced`)."""
_FINISHED = (".urdf", ".srdf", ".sdf", ".world")
_OLD_TAGS = ("property", "include", "macro", "arg")
"""Which xacro took without its prefix."""
_BUILT_IN = frozenset(
    ("arg", "attribute", "call", "element", "if", "include", "insert_block", "macro", "property", "unless")
)
_SYMBOLS = frozenset(
    (*dir(builtins), *dir(math), "abs_filename", "arg", "degrees", "dotify", "error", "fatal", "load_yaml",
     "message", "print_location", "python", "math", "radians", "tokenize", "warning", "xacro", "yaml")
)  # fmt: skip
"""What an expression has without a definition."""


@dataclass(frozen=True, slots=True)
class Parameter:
    """A parameter of a macro. Of a `block` an element of the call is it."""

    name: str
    has_default: bool
    block: bool


@dataclass(frozen=True, slots=True)
class Macro:
    """A `<xacro:macro>`; `span` is that of its name."""

    name: str
    parameters: tuple[Parameter, ...]
    span: Span

    def parameter(self, name: str) -> Parameter | None:
        """Its parameter of that name that is no block."""
        return next((each for each in self.parameters if each.name == name and not each.block), None)


@dataclass(frozen=True, slots=True)
class Around:
    """Where something stands: in the body of the macro `macro`, "" outside of any, with the names that only its body
    has; in a tag that a condition may leave out."""

    macro: str = ""
    names: frozenset[str] = frozenset()
    conditional: bool = False


@dataclass(frozen=True, slots=True)
class Call:
    """An element that calls the macro `name`, or one that might with `xacro:` before it (`prefixed` is false)."""

    name: str
    attributes: Mapping[str, Span]
    blocks: int
    span: Span
    around: Around
    parent: str = ""
    prefixed: bool = True
    placed: bool = False
    """Whether an `<origin>` is in it."""


@dataclass(frozen=True, slots=True)
class Use:
    """A name that is asked for: of a property in `${...}`, an argument in `$(arg ...)`, a block to insert, a package in
    `$(find ...)` or `package://`. `refused` is what Python says of an expression that is none."""

    kind: Literal["property", "argument", "block", "package", "expression"]
    name: str
    span: Span
    around: Around
    refused: str = ""
    value_of: str = ""
    """The property in whose value it is: xacro computes that when the property is used."""


@dataclass(frozen=True, slots=True)
class Written:
    """A name of a file as it is written, such as that of an include or a mesh; `tag` is that of its element."""

    text: str
    span: Span
    tag: str
    around: Around
    optional: bool = False


@dataclass(frozen=True, slots=True)
class Part:
    """A link or joint that a file has, or one that it names: the attribute or text of an element `tag` of Gazebo."""

    tag: str
    name: str
    span: Span
    around: Around

    @property
    def of_joint(self) -> bool:
        """Whether what has this name has to be a joint."""
        return self.tag in OF_JOINTS or self.tag.lower().endswith(("joint", "joint_name", "jointname"))

    @property
    def variables(self) -> frozenset[str]:
        """What its name is computed of, as it is written."""
        return frozenset(each[0] for each in _EXPRESSION.finditer(self.name))

    @property
    def literals(self) -> tuple[str, ...]:
        """The pieces of its name between what is computed."""
        return tuple(COMPUTED.split(self.name))

    def may_be(self, other: Part) -> bool:
        """Whether both names may come to one. The names of variables are those of one thing within a macro, and in two
        macros that have the same ones."""
        if self.name == other.name:
            return True
        if not self.variables and not other.variables:
            return False
        same_macro = self.around.macro == other.around.macro
        if self.variables == other.variables and (same_macro or any(map(str.strip, other.literals))):
            return False
        ends = ((self.literals[at], other.literals[at]) for at in (0, -1))
        (a, b), (c, d) = ends
        if not self.variables or not other.variables:
            whole, pieces = (self.name, other.literals) if not self.variables else (other.name, self.literals)
            return is_made_of(whole, pieces)
        return (a.startswith(b) or b.startswith(a)) and (c.endswith(d) or d.endswith(c))


@dataclass(frozen=True, slots=True)
class XacroFile:
    """What is written in one file. `open`: it defines properties whose names are computed, or is
    not well-formed, so that nobody knows what it defines."""

    document: Document
    is_xacro: bool = False
    macros: tuple[Macro, ...] = ()
    properties: Mapping[str, str | None] = field(default_factory=dict)
    """With the value of each that has one alone."""
    arguments: frozenset[str] = frozenset()
    includes: tuple[Written, ...] = ()
    files: tuple[Written, ...] = ()
    """Meshes, textures and models."""
    calls: tuple[Call, ...] = ()
    uses: tuple[Use, ...] = ()
    open: bool = False
    parts: tuple[Part, ...] = ()
    """The links and joints of the robot."""
    named: tuple[Part, ...] = ()
    """What elements of Gazebo call so."""
    texts: tuple[tuple[SpannedText, Around], ...] = ()
    """The values and texts that xacro computes."""
    materials: frozenset[str] = frozenset()
    """The materials that have a color or a texture."""
    materials_used: tuple[Written, ...] = ()
    """Those that links name."""
    plugins: tuple[Written, ...] = ()
    """The classes that hardware of ros2_control is to be loaded by."""


def is_made_of(text: str, pieces: Sequence[str]) -> bool:
    """Whether a text is made of these pieces with anything between them. Not by a regular expression: the time of that
    grows with each piece."""
    first, *between, last = pieces
    at, end = len(first), len(text) - len(last)
    if at > end or not text.startswith(first) or not text.endswith(last):
        return False
    for piece in between:
        found = text.find(piece, at, end)
        if found < 0:
            return False
        at = found + len(piece)
    return True


@query
def xacro_file(db: Database, path: str) -> XacroFile | None:
    """What is written in a file; None where it cannot be read, or is very long."""
    text = text_of(db, path)
    if not isinstance(text, FileText) or len(text.text) > _LONGEST:
        return None
    return _Reader(parse_xml(path, text.text, text.encoding, text.lines)).read()


class _Reader:
    def __init__(self, document: Document) -> None:
        self.document = document
        self.macros: list[Macro] = []
        self.properties: dict[str, str | None] = {}
        self.arguments: set[str] = set()
        self.includes: list[Written] = []
        self.files: list[Written] = []
        self.calls: list[Call] = []
        self.uses: list[Use] = []
        self.parts: list[Part] = []
        self.named: list[Part] = []
        self.texts: list[tuple[SpannedText, Around]] = []
        self.materials: set[str] = set()
        self.materials_used: list[Written] = []
        self.plugins: list[Written] = []
        self.open = bool(document.problems)
        root = document.root
        self.is_xacro = document.path.endswith(".xacro") or (root is not None and _is_xacro(root, document.path))

    def read(self) -> XacroFile:
        waiting = [(self.document.root, Around(), "", "")] if self.document.root is not None else []
        while waiting:
            element, around, parent, within = waiting.pop()
            inside = self._element(element, around, parent, within)
            self._parts(element, around, within)
            within = within or (element.tag if element.tag in _ELSEWHERE else "")
            waiting += ((each, inside, element.tag, within) for each in reversed(list(element.elements)))
        return XacroFile(
            self.document,
            self.is_xacro,
            tuple(self.macros),
            self.properties,
            frozenset(self.arguments),
            tuple(self.includes),
            tuple(self.files),
            tuple(self.calls),
            tuple(self.uses),
            self.open,
            tuple(self.parts),
            tuple(self.named),
            tuple(self.texts),
            frozenset(self.materials),
            tuple(self.materials_used),
            tuple(self.plugins),
        )

    def _element(self, element: Element, around: Around, parent: str, within: str) -> Around:
        """Note what an element has; where its children stand."""
        tag = element.tag
        own = tag.removeprefix(XACRO)
        is_own = tag.startswith(XACRO) or (self.is_xacro and tag in _OLD_TAGS and self._is_old(element))
        self._values(element, around, tag)
        self._file_names(element, around)
        if tag == "material":
            self._material(element, around, parent)
        elif tag == "plugin" and within == _CONTROL:
            self.plugins += _text_of(element, around)
        if not self.is_xacro:
            return around
        if not is_own:
            self.calls.append(_call(tag, element, around, parent, prefixed=False))
            return around
        if own == "macro":
            return self._macro(element, around)
        if own == "property":
            self._property(element)
        elif own == "arg":
            self.arguments.update(_values_of(element, "name"))
        elif own == "include":
            self._include(element, around)
        elif own == "insert_block":
            name = element.get("name")
            if name is not None and "$" not in name.value.text:
                self.uses.append(Use("block", name.value.text, name.value.span, around))
        elif own in ("if", "unless"):
            return Around(around.macro, around.names, conditional=True)
        elif own == "call":
            macro = element.get("macro")
            if macro is not None and "$" not in macro.value.text:
                self.calls.append(_call(macro.value.text, element, around, parent))
        elif own not in _BUILT_IN:
            self.calls.append(_call(own, element, around, parent))
        return around

    def _parts(self, element: Element, around: Around, within: str) -> None:
        tag = element.tag
        attribute = element.get("reference") if tag == _GAZEBO else element.get("name")
        if attribute is not None and within in ("", _GAZEBO) and tag in ("link", "joint", _GAZEBO):
            of_joint = next((each.tag for each in element.elements if each.tag in OF_JOINTS), tag)
            found = Part(of_joint, attribute.value.text, attribute.value.span, around)
            (self.named if tag == _GAZEBO else self.parts).append(found)
        elif within == _GAZEBO and tag not in OF_JOINTS and _NAMING.match(tag):
            text = next((each.content for each in element.children if isinstance(each, Text)), None)
            name = text.text.strip() if text is not None else ""
            if text is not None and name and not any(map(str.isspace, name)):
                at = text.text.index(name)
                self.named.append(Part(tag, name, text.slice_span(at, at + len(name)), around))

    def _is_old(self, element: Element) -> bool:
        """Whether it is one of xacro as it was written once, and none of SDF."""
        needed = {"property": "name", "include": "filename", "macro": "params", "arg": "default"}
        return element.get(needed[element.tag]) is not None and element.get("uri") is None

    def _macro(self, element: Element, around: Around) -> Around:
        name = element.get("name")
        given = next(iter(_values_of(element, "params")), "")
        parameters = tuple(_parameters(given))
        if name is not None:
            self.macros.append(Macro(name.value.text.removeprefix(XACRO), parameters, name.value.span))
        names = around.names.union(each.name for each in parameters)
        return Around(name.value.text.removeprefix(XACRO) if name is not None else "", names, around.conditional)

    def _property(self, element: Element) -> None:
        value = next(iter(_values_of(element, "value")), None)
        default = next(iter(_values_of(element, "default")), None)
        for name in _values_of(element, "name"):
            self.open = self.open or "$" in name
            known = value if value is not None else default
            self.properties[name] = known if name not in self.properties or self.properties[name] == known else None

    def _include(self, element: Element, around: Around) -> None:
        name = element.get("filename")
        self.properties.update(dict.fromkeys(_values_of(element, "ns")))
        if name is not None:
            optional = next(iter(_values_of(element, "optional")), "false") != "false"
            self.includes.append(Written(name.value.text, name.value.span, "include", around, optional))

    def _file_names(self, element: Element, around: Around) -> None:
        name = element.get("filename") if element.tag in ("mesh", "texture") else None
        if name is not None:
            self.files.append(Written(name.value.text, name.value.span, element.tag, around))
        elif element.tag == "uri":
            self.files += _text_of(element, around)

    def _material(self, element: Element, around: Around, parent: str) -> None:
        name = element.get("name")
        if name is None:
            return
        if any(element.elements):
            self.materials.add(name.value.text)
        elif parent == "visual":
            self.materials_used.append(Written(name.value.text, name.value.span, "material", around))

    def _values(self, element: Element, around: Around, tag: str) -> None:
        values = [each.value for each in element.attributes if not each.name.startswith("xmlns")]
        is_lazy = tag == f"{XACRO}property" and not any(map(element.get, ("scope", "lazy_eval")))
        lazy = next(iter(_values_of(element, "name")), "") if is_lazy else ""
        values += (each.content for each in element.children if isinstance(each, Text))
        if tag == f"{XACRO}macro":  # its defaults are computed where it is called, of names that are known there
            values = []
        for value in values:
            if not value.text.strip():
                continue
            if self.is_xacro:
                self.texts.append((value, around))
                self.uses += _uses(value, around, lazy)
            for match in re.finditer(r"package://([A-Za-z][\w-]*)(?=/)", value.text):
                self.uses.append(Use("package", match[1], value.slice_span(*match.span(1)), around))


def _is_xacro(root: Element, path: str) -> bool:
    """Whether xacro reads it, which needs the prefix to be declared; what only does that may be the text that xacro
    made."""
    if not any(each.name == "xmlns:xacro" for each in root.attributes):
        return False
    if not path.endswith(_FINISHED):
        return True
    waiting = [root]
    while waiting:
        element = waiting.pop()
        if element.tag.startswith(XACRO):
            return True
        waiting += element.elements
    return False


def _text_of(element: Element, around: Around) -> Iterator[Written]:
    """The texts in an element, without what is around them."""
    for each in element.children:
        if isinstance(each, Text) and each.content.text.strip():
            start = len(each.content.text) - len(each.content.text.lstrip())
            text = each.content.text.strip()
            yield Written(text, each.content.slice_span(start, start + len(text)), element.tag, around)


def _values_of(element: Element, name: str) -> list[str]:
    found = element.get(name)
    return [found.value.text.strip()] if found is not None else []


def _parameters(text: str) -> Iterator[Parameter]:
    for match in _PARAMETER.finditer(text):
        name = match[1]
        yield Parameter(name.lstrip("*"), match[2] is not None, name.startswith("*"))


def _call(name: str, element: Element, around: Around, parent: str, *, prefixed: bool = True) -> Call:
    attributes = {
        each.name: each.name_span
        for each in element.attributes
        if ":" not in each.name and not (element.tag == f"{XACRO}call" and each.name == "macro")
    }
    elements = list(element.elements)
    # What a condition or another call in it comes to is not counted.
    blocks = -1 if any(each.tag.startswith(XACRO) for each in elements) else len(elements)
    placed = any(each.tag == "origin" for each in elements)
    return Call(name, attributes, blocks, element.tag_span, around, parent, prefixed, placed)


def _uses(value: SpannedText, around: Around, lazy: str) -> Iterator[Use]:
    for match in _EXPRESSION.finditer(value.text):
        if len(match[1]) % 2 == 0:
            continue  # `$${` is the text `${`
        if match[2] is not None:
            yield from _names(match[2], value, match.start(2), around, lazy)
            continue
        command, _, name = match[3].strip().partition(" ")
        name = name.strip()
        if "$" in name or " " in name or not name or command not in ("arg", "find"):
            continue
        at = match.start(3) + match[3].index(name, len(command))
        kind: Literal["argument", "package"] = "argument" if command == "arg" else "package"
        yield Use(kind, name, value.slice_span(at, at + len(name)), around, value_of=lazy)


def _names(expression: str, value: SpannedText, at: int, around: Around, lazy: str) -> Iterator[Use]:
    """The names that an expression asks for; what Python says where it is none."""
    span = value.slice_span(at, at + len(expression))
    if "$" in expression or "{" in expression or not expression.strip():
        return  # xacro ends an expression at the first brace
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(f"({expression.strip()})", mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        said = getattr(error, "msg", None) or str(error)
        yield Use("expression", expression.strip(), span, around, said, lazy)
        return
    nodes = list(ast.walk(tree))
    bound = {each.id for each in nodes if isinstance(each, ast.Name) and not isinstance(each.ctx, ast.Load)}
    bound.update(each.arg for each in nodes if isinstance(each, ast.arg))
    for name in dict.fromkeys(each.id for each in nodes if isinstance(each, ast.Name)):
        if name in bound or name in _SYMBOLS:
            continue
        found = re.search(rf"(?<![\w.]){re.escape(name)}(?!\w)", expression)
        where = value.slice_span(at + found.start(), at + found.end()) if found is not None else span
        yield Use("property", name, where, around, value_of=lazy)
