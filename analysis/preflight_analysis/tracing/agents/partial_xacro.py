"""xacro where packages are missing that a description includes: what can be known without them.

An include of a package that is not here is left out, and so is what depends on it: macros that nothing else defines,
conditions and names whose properties are not known. A comment at the top of the document says what it lacks.
Without a missing package xacro does what it always does, with its errors.
"""

from __future__ import annotations

import re
from typing import Any

from .anything import BEGIN, END, is_unknown, unknown_text

INCOMPLETE = " incomplete for ros-preflight without "
"""How the comment begins that names the packages, apart by commas. It is no key for those who read the text as YAML."""
MOST_NAMED = 20
_MARKED = re.compile(f"{BEGIN}[^{END}]*{END}?")
_OTHERS = "unresolved values"
_NAMED = re.compile(r"[A-Za-z][\w-]*")
_FIND = re.compile(r"\$\(find +([^\s()]+) *\)")


class Lacking:
    """What a document lacks; `packages` is empty where it lacks nothing."""

    def __init__(self) -> None:
        self.packages: dict[str, None] = {}
        self.tag = ""
        """Of the element whose attributes xacro asked for last."""
        self.block = ""
        """The name of the block that it is to insert, if it is one that inserts a block."""

    def miss(self, package: str) -> str:
        """A package is not here: the text that stands for its folder."""
        name = package if _NAMED.fullmatch(package) else _OTHERS
        if len(self.packages) < MOST_NAMED:
            self.packages[name.replace("--", "-")] = None
        return unknown_text(f"the share folder of {package}")


def install(xacro: Any, lacking: Lacking) -> None:
    """From now on the module leaves out what is not known."""
    include, call, evaluate = xacro.process_include, xacro.handle_macro_call, xacro.safe_eval
    extension, truth, process = xacro.eval_extension, xacro.get_boolean_value, xacro.process_doc
    attributes = xacro.check_attrs
    nothing = xacro.xml.dom.minidom.Document().createElement("unknown")

    class Symbols(dict):  # type: ignore[type-arg]
        """The global ones; a block that nobody gives is nothing, where its macro's caller may be left out."""

        def __contains__(self, key: Any) -> bool:
            return dict.__contains__(self, key) or (bool(lacking.packages) and key == f"*{lacking.block}")

        def __missing__(self, key: Any) -> Any:
            if key == f"*{lacking.block}" and lacking.packages:
                return nothing
            raise KeyError(key)

    def eval_extension(text: str) -> Any:
        try:
            found = extension(text)
        except Exception:
            if not lacking.packages:
                raise
            return unknown_text(text)
        if is_unknown(found):
            package = _FIND.search(text)
            lacking.miss(package[1] if package is not None else _OTHERS)
        return found

    def safe_eval(expression: str, symbols: Any, local: Any = None) -> Any:
        if is_unknown(expression) or (lacking.packages and _names_unknown(expression, symbols)):
            return unknown_text(expression)
        try:
            return evaluate(expression, symbols, local)
        except Exception:
            if not lacking.packages:
                raise
            return unknown_text(expression)

    def get_boolean_value(value: Any, condition: Any) -> bool:
        if condition is not None and is_unknown(value):
            return lacking.tag.endswith("unless")
        return bool(truth(value, condition))

    def check_attrs(tag: Any, *names: Any) -> Any:
        lacking.tag = tag.tagName
        lacking.block = tag.getAttribute("name") if tag.tagName == "xacro:insert_block" else ""
        return attributes(tag, *names)

    def process_include(element: Any, macros: Any, symbols: Any, func: Any) -> None:
        if is_unknown(str(xacro.eval_text(element.getAttribute("filename"), symbols))):
            xacro.replace_node(element, by=None)
        else:
            include(element, macros, symbols, func)

    def handle_macro_call(node: Any, macros: Any, symbols: Any) -> Any:
        if lacking.packages and _is_unknown_call(xacro, node, macros, symbols):
            xacro.replace_node(node, by=None)
            return True
        depth = len(xacro.macrostack or ())
        try:
            return call(node, macros, symbols)
        except Exception:
            if not lacking.packages:
                raise
            # A block that it needs may be one of those that are left out.
            del xacro.macrostack[depth:]
            xacro.replace_node(node, by=None)
            return True

    def process_doc(doc: Any, *args: Any, **kwargs: Any) -> None:
        lacking.packages.clear()
        process(doc, *args, **kwargs)
        if lacking.packages:
            _clean(doc.documentElement)
            doc.insertBefore(doc.createComment(f"{INCOMPLETE}{', '.join(lacking.packages)} "), doc.firstChild)

    xacro.eval_extension, xacro.safe_eval, xacro.get_boolean_value = eval_extension, safe_eval, get_boolean_value
    xacro.process_include, xacro.handle_macro_call = process_include, handle_macro_call
    xacro.process_doc, xacro.check_attrs, xacro._global_symbols = (
        process_doc,
        check_attrs,
        Symbols(xacro._global_symbols),
    )


def can_install(xacro: Any) -> bool:
    """Whether it is a version of which the parts are known."""
    names = ("process_include", "handle_macro_call", "safe_eval", "eval_extension", "get_boolean_value")
    return all(
        hasattr(xacro, name)
        for name in (
            *names,
            "process_doc",
            "check_attrs",
            "eval_text",
            "resolve_macro",
            "_global_symbols",
            "macrostack",
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


def _clean(element: Any) -> None:
    """No mark is left: a text that is not known is an expression, as it was."""
    waiting = [element]
    while waiting:
        each = waiting.pop()
        for name, value in list((each.attributes or {}).items()):
            if BEGIN in value:
                each.setAttribute(name, _MARKED.sub("${unknown}", value))
        if BEGIN in (getattr(each, "data", None) or ""):
            each.data = _MARKED.sub("${unknown}", each.data)
        waiting += each.childNodes
