"""xacro where packages are missing that a description includes: what can be known without them.

An include of a package that is not here is left out, and so is what depends on it: macros that nothing else defines,
conditions and names whose properties are not known. A comment at the top of the document says what it lacks.
Without a missing package xacro does what it always does, with its errors.

Of common packages the catalogue has the structure (`skeletons.py`), which takes their place; another comment names
them. Of shapes, places and values it knows nothing. Where a name depends on one of these the package is lacking.
"""

from __future__ import annotations

import re
from typing import Any, Optional

from .anything import MARKS, is_unknown, unknown_text
from .skeletons import PACKAGE, Skeletons

INCOMPLETE = " incomplete for ros-preflight without "
"""How the comment begins that names the packages, apart by commas. No comment is a key where YAML reads the text."""
INEXACT = " values unknown to ros-preflight without "
"""How the comment begins that names packages without which values are not known, but all names and relations are."""
CATALOGUED = " from the catalogue of ros-preflight for "
"""How the comment begins that names a distribution and the packages that the catalogue has of it, apart by commas."""
MOST_NAMED = 20
_OTHERS = "unresolved values"
_NAMED = re.compile(r"[A-Za-z][\w-]*")
_FIND = re.compile(r"\$\(find +([^\s()]+) *\)")
_NAMING = {
    "link": ("name",),
    "joint": ("name", "type"),
    "parent": ("link",),
    "child": ("link",),
    "mimic": ("joint",),
    "ros2_control": ("name",),
    "transmission": ("name",),
    "gpio": ("name",),
    "command_interface": ("name",),
    "state_interface": ("name",),
    "hardwareInterface": (),
}
"""The elements whose names a robot is made of, each with the attributes that have to be known."""
_SHAPES = frozenset(
    {
        *("origin", "inertial", "visual", "collision", "material", "axis", "limit", "dynamics", "calibration"),
        *("safety_controller", "geometry", "mesh", "mass", "inertia"),
    }
)
_CONTAINERS = ("xacro:if", "xacro:unless", "xacro:property")


class Lacking:
    """What a document lacks. `skeletons` has the structure of packages that are not here."""

    def __init__(self, skeletons: Optional[Skeletons] = None) -> None:
        self.skeletons = skeletons or Skeletons()
        self.asked: dict[str, None] = {}
        """The packages that are not here, and that the document asks for."""
        self.used: dict[str, None] = {}
        """Those of them of which the structure is known."""
        self.packages: dict[str, None] = {}
        """Those without which names or relations of the robot are not known."""
        self.element: Any = None
        """The one whose attributes xacro asked for last."""
        self.block = ""
        """The name of the block that it is to insert, if it is one that inserts a block."""

    def clear(self) -> None:
        """Another document begins."""
        for packages in (self.asked, self.used, self.packages):
            packages.clear()

    @property
    def is_inexact(self) -> bool:
        """Whether something is not here: a value that is not known is no mistake then."""
        return bool(self.asked)

    def share_of(self, package: str) -> str:
        """A package is not here: the text that stands for its folder."""
        folder = self.skeletons.folder_of(package)
        if len(self.asked) < MOST_NAMED:
            self.asked[_label(package)] = None
            self.used.update({package: None} if folder else {})
        return folder or unknown_text(f"the share folder of {package}")

    def miss(self, *packages: str) -> None:
        """Names or relations depend on more than is known of packages: of these, or else of any that it asks for."""
        if packages or not self.packages:
            self.packages.update(dict.fromkeys(map(_label, packages)) if packages else self.asked)

    @property
    def notes(self) -> dict[str, str]:
        """The packages, apart by commas, by the beginnings of the comments that name them."""
        others = [name for name in self.asked if name not in self.used and name not in self.packages]
        by_note = {
            INCOMPLETE: self.packages,
            f"{CATALOGUED}{self.skeletons.distro}, ": self.used,
            INEXACT: others,
        }
        return {note: ", ".join(packages) for note, packages in by_note.items() if packages}


def _label(package: str) -> str:
    """The name of a package as a comment may have it."""
    return (package if _NAMED.fullmatch(package) else _OTHERS).replace("--", "-")


def install(xacro: Any, lacking: Lacking) -> None:
    """From now on the module leaves out what is not known."""
    include, call, evaluate = xacro.process_include, xacro.handle_macro_call, xacro.safe_eval
    extension, truth, process = xacro.eval_extension, xacro.get_boolean_value, xacro.process_doc
    attributes, parse = xacro.check_attrs, xacro.parse
    nothing = xacro.xml.dom.minidom.Document().createElement("unknown")

    class Symbols(dict):  # type: ignore[type-arg]
        """The global ones; a block that nobody gives is nothing, where its macro's caller may be left out."""

        def __contains__(self, key: Any) -> bool:
            return dict.__contains__(self, key) or (lacking.is_inexact and key == f"*{lacking.block}")

        def __missing__(self, key: Any) -> Any:
            if key == f"*{lacking.block}" and lacking.is_inexact:
                lacking.miss()
                return nothing
            raise KeyError(key)

    def eval_extension(text: str) -> Any:
        try:
            found = extension(text)
        except Exception:
            if not lacking.is_inexact:
                raise
            return unknown_text(text)
        if is_unknown(found):
            package = _FIND.search(text)
            return lacking.share_of(package[1] if package is not None else "")
        return found

    def safe_eval(expression: str, symbols: Any, local: Any = None) -> Any:
        if is_unknown(expression) or (lacking.is_inexact and _names_unknown(expression, symbols)):
            return unknown_text(expression)
        try:
            return evaluate(expression, symbols, local)
        except Exception:
            if not lacking.is_inexact:
                raise
            return unknown_text(expression)

    def get_boolean_value(value: Any, condition: Any) -> bool:
        if condition is not None and is_unknown(value):
            if _is_structure(lacking.element):
                lacking.miss()
            _leave_properties(lacking.element)
            return not lacking.element.tagName.endswith("unless")
        return bool(truth(value, condition))

    def check_attrs(tag: Any, *names: Any) -> Any:
        lacking.element = tag
        lacking.block = tag.getAttribute("name") if tag.tagName == "xacro:insert_block" else ""
        return attributes(tag, *names)

    def process_include(element: Any, macros: Any, symbols: Any, func: Any) -> None:
        name = str(xacro.eval_text(element.getAttribute("filename"), symbols))
        if is_unknown(name):
            lacking.miss(*_FIND.findall(element.getAttribute("filename")))
            xacro.replace_node(element, by=None)
        elif lacking.skeletons.lacks(name):
            lacking.miss(lacking.skeletons.package_of(name))
            xacro.replace_node(element, by=None)
        else:
            include(element, macros, symbols, func)

    def read(inp: Any, filename: Any = None) -> Any:
        found = lacking.skeletons.document(str(filename)) if inp is None else None
        return found if found is not None else parse(inp, filename)

    def handle_macro_call(node: Any, macros: Any, symbols: Any) -> Any:
        if lacking.is_inexact and node.tagName in macros:
            lacking.miss()  # a call as before ROS Jade, which xacro no longer knows
        if lacking.is_inexact and _is_unknown_call(xacro, node, macros, symbols):
            lacking.miss()
            xacro.replace_node(node, by=None)
            return True
        depth, files = len(xacro.macrostack or ()), len(xacro.filestack or ())
        try:
            return call(node, macros, symbols)
        except Exception:
            if not lacking.is_inexact:
                raise
            # A block that it needs may be one of those that are left out.
            lacking.miss()
            del xacro.macrostack[depth:], xacro.filestack[files:]
            xacro.replace_node(node, by=None)
            return True

    def process_doc(doc: Any, mappings: Any = None, **kwargs: Any) -> None:
        lacking.clear()
        if package := lacking.skeletons.package_of(str((xacro.filestack or [""])[0])):
            lacking.share_of(package)
        before, given = doc.documentElement.cloneNode(deep=True), dict(mappings or {})
        try:
            process(doc, mappings, **kwargs)
        except Exception:
            if not lacking.used:
                raise
            # The package may be another one on the robot: it is lacking as a whole.
            skeletons, lacking.skeletons = lacking.skeletons, Skeletons()
            lacking.clear()
            del xacro.filestack[1:], xacro.macrostack[:]
            doc.replaceChild(before, doc.documentElement)
            try:
                process(doc, given, **kwargs)
            finally:
                lacking.skeletons = skeletons
        if lacking.is_inexact:
            _clean(doc.documentElement, lacking)
            for note, packages in lacking.notes.items():
                doc.insertBefore(doc.createComment(f"{note}{packages} "), doc.firstChild)

    xacro.eval_extension, xacro.safe_eval, xacro.get_boolean_value = eval_extension, safe_eval, get_boolean_value
    xacro.process_include, xacro.handle_macro_call = process_include, handle_macro_call
    xacro.process_doc, xacro.check_attrs, xacro.parse = process_doc, check_attrs, read
    xacro._global_symbols = Symbols(xacro._global_symbols)


def can_install(xacro: Any) -> bool:
    """Whether it is a version of which the parts are known."""
    names = ("process_include", "handle_macro_call", "safe_eval", "eval_extension", "get_boolean_value")
    return all(
        hasattr(xacro, name)
        for name in (
            *names,
            *("process_doc", "check_attrs", "eval_text", "resolve_macro", "parse"),
            *("_global_symbols", "macrostack", "filestack"),
        )
    )


def _names_unknown(expression: str, symbols: Any) -> bool:
    """Whether an expression reads something that is not known: a comparison with that would have an answer."""
    for name in compile(expression.strip(), "<expression>", "eval").co_names:
        try:
            if is_unknown(symbols[name]):
                return True
        except Exception:  # noqa: S112 - a function, or a name that the evaluation complains about
            continue
    return False


def _is_unknown_call(xacro: Any, node: Any, macros: Any, symbols: Any) -> bool:
    """Whether it calls a macro that nothing defines which is here."""
    name = node.tagName
    if name == "xacro:call":
        name = f"xacro:{xacro.eval_text(node.getAttribute('macro'), symbols)}"
    if not name.startswith("xacro:"):
        return False
    if is_unknown(name):
        return True
    try:
        xacro.resolve_macro(name[len("xacro:") :], macros, symbols)
    except Exception:
        return True
    return False


def _is_structure(element: Any) -> bool:
    """Whether something in an element gives the robot names or relations, or may do so."""
    inside = [each for each in element.childNodes if each.nodeType == each.ELEMENT_NODE and each.tagName not in _SHAPES]
    return any(
        each.tagName in _NAMING
        or (each.tagName.startswith("xacro:") and each.tagName not in _CONTAINERS)
        or _is_structure(each)
        for each in inside
    )


def _leave_properties(condition: Any) -> None:
    """Of an element whose condition is not known the properties alone are left, which then are not known either."""
    properties = condition.getElementsByTagName("xacro:property")
    for each in list(condition.childNodes):
        condition.removeChild(each)
    for each in properties:
        for name in ("default", "remove"):
            if each.hasAttribute(name):
                each.removeAttribute(name)
        each.setAttribute("value", unknown_text(each.getAttribute("name")))
        condition.appendChild(each)


def _clean(element: Any, lacking: Lacking) -> None:
    """No mark is left: a text that is not known is an expression, as it was. Where a name is not known the packages are
    lacking that gave it."""
    waiting = [element]
    while waiting:
        each = waiting.pop()
        for name, value in list((each.attributes or {}).items()):
            cleaned = lacking.skeletons.without_folders(MARKS.sub("${unknown}", value))
            if cleaned == value:
                continue
            if name == "type" and each.getAttribute(PACKAGE):
                cleaned = ""  # of what the catalogue has, it depends on a value
            elif name in _NAMING.get(each.tagName, ()):
                lacking.miss()
            each.setAttribute(name, cleaned)
        data = getattr(each, "data", None) or ""
        cleaned = lacking.skeletons.without_folders(MARKS.sub("${unknown}", data))
        if cleaned != data:
            each.data = cleaned
            if each.parentNode.nodeName in _NAMING:
                lacking.miss()
        waiting += each.childNodes
