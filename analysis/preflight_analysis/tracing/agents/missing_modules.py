"""Modules that are not installed: whoever imports one gets a stand-in (`anything`), and the import is noted.

An import that the program itself provides for, by `try` and another way where it fails, fails as it does outside. So
does what only asks whether a module is there.
"""

from __future__ import annotations

import ast
import dis
import importlib.abc
import importlib.machinery
import linecache
import os
import sys
from typing import Any, Callable, Optional, Sequence

from .anything import AnyModule, importer

GENERATED = ("msg", "srv", "action")
"""Below a package that is only source: what building it makes."""
IMPORTS = ("ImportError", "ModuleNotFoundError")
_ALL = ("Exception", "BaseException")
_STANDARD_LIBRARY = os.path.dirname(os.path.abspath(os.__file__)) + os.sep
_ENDS = ("exit", "_exit", "quit", "abort")

Note = Callable[[str, str, int], None]
"""Told of a module's name, and of the file and line (0: not known) that imported it first."""


class MissingModules(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """The last of `sys.meta_path`. `stands_in` says whether a module may have a stand-in that is missing in a package
    which is there; where the package is missing as well it has one. `lacked` is told of a module without which the
    program itself goes on."""

    def __init__(
        self,
        note: Note,
        stands_in: Callable[[str], bool] = lambda name: False,
        lacked: Callable[[str], None] = lambda name: None,
    ) -> None:
        self._note, self._stands_in, self._lacked = note, stands_in, lacked
        self.noted: dict[str, None] = {}

    def find_spec(self, fullname: str, path: Any = None, target: Any = None) -> Any:
        above, _, name = fullname.rpartition(".")
        within = isinstance(sys.modules.get(above), AnyModule)
        if above and not within and name not in GENERATED and not self._stands_in(fullname):
            return None
        if not above and fullname in getattr(sys, "stdlib_module_names", ()):
            return None  # another system's
        frame = importer()
        if frame is None or not _imports(frame, fullname) or _only_asks():
            return None
        if provided_for(frame, IMPORTS):
            self._lacked(fullname)
            return None
        if not within and fullname not in self.noted:
            self.noted[fullname] = None
            self._note(fullname, frame.f_code.co_filename, frame.f_lineno)
        return importlib.machinery.ModuleSpec(fullname, self, is_package=True)

    def create_module(self, spec: Any) -> Any:
        return AnyModule(spec.name)

    def exec_module(self, module: Any) -> None:
        return None


def _imports(frame: Any, fullname: str) -> bool:
    """Whether it is a program that imports it, and not the standard library or an extension that the program loads."""
    file = frame.f_code.co_filename
    if file.startswith("<frozen") or (file.startswith(_STANDARD_LIBRARY) and "-packages" + os.sep not in file):
        return False
    code, at = frame.f_code.co_code, frame.f_lasti
    if not 0 <= at < len(code) - 1 or dis.opname[code[at]] != "IMPORT_NAME":
        return True
    argument, before = code[at + 1], at - 2
    while before >= 0 and dis.opname[code[before]] == "EXTENDED_ARG":
        argument, before = argument | code[before + 1] << 8 * (at - before) // 2, before - 2
    name = frame.f_code.co_names[argument]
    return "." in fullname or name.partition(".")[0] == fullname


def _only_asks() -> bool:
    frame: Any = sys._getframe(2)
    while frame is not None:
        if frame.f_globals.get("__name__") == "importlib.util" and frame.f_code.co_name == "find_spec":
            return True
        frame = frame.f_back
    return False


def provided_for(frame: Any, errors: Sequence[str]) -> bool:
    """Whether a program stands in a `try` that goes on in another way after one of the errors, which it may name."""
    try:
        tree = ast.parse("".join(linecache.getlines(frame.f_code.co_filename)))
    except (SyntaxError, ValueError):
        return False
    return any(
        isinstance(node, ast.Try)
        and node.body[0].lineno <= frame.f_lineno <= (node.body[-1].end_lineno or 0)
        and any(_catches(each.type, errors) and not _ends(each) for each in node.handlers)
        for node in ast.walk(tree)
    )


def _catches(kind: Optional[ast.expr], errors: Sequence[str]) -> bool:
    if kind is None:
        return True
    kinds = kind.elts if isinstance(kind, ast.Tuple) else [kind]
    names = [each.attr if isinstance(each, ast.Attribute) else getattr(each, "id", "") for each in kinds]
    return any(name in errors or name in _ALL for name in names)


def _ends(handler: ast.ExceptHandler) -> bool:
    """Whether the program does not go on after it."""
    for node in ast.walk(handler):
        if isinstance(node, ast.Raise):
            return True
        if isinstance(node, ast.Call):
            called = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
            if called in _ENDS:
                return True
    return False
