"""What a module of `libraries/` lacks of the real one.

The real modules have what they import as well, and programs take it from them: `from rclpy.node import
ParameterDescriptor`. What no module of ours has may be in the real one of some distribution: its value is unknown.
"""

from __future__ import annotations

import importlib
import itertools
import os
import sys
from typing import Any, Iterator

from ..anything import Anything, importer, operation
from ..missing_modules import IMPORTS, provided_for
from .basic import DEFINITIONS
from .definitions import KINDS, Definitions

_TAKES = ("IMPORT_FROM", "LOAD_ATTR", "LOAD_METHOD")
"""Instructions that need the name: who asks by `hasattr` goes on without."""
_PACKAGES = sorted({name.partition("/")[0] for name in DEFINITIONS})
"""Those of the messages, services and actions that client libraries import."""


class Lacking:
    """`definitions` are those of messages, services and actions that are at hand."""

    def __init__(self, definitions: Definitions) -> None:
        self._definitions = definitions

    def name_in(self, module: str, name: str) -> Any:
        """What a module has by a name that it does not define. Raises `AttributeError` where the program provides for
        that, and for the names that Python itself asks for."""
        frame = importer()
        if (
            name.startswith("_")
            or frame is None
            or operation(frame)[0] not in _TAKES
            or provided_for(frame, (*IMPORTS, "AttributeError"))
        ):
            raise AttributeError(f"module '{module}' has no attribute '{name}'")
        found = itertools.chain(_of_library(module.partition(".")[0], name), self._interfaces(name))
        return next(found, None) or Anything(f"{module}.{name}")

    def _interfaces(self, name: str) -> Iterator[Any]:
        for package in _PACKAGES:
            for kind in KINDS:
                if self._definitions.text(package, kind, name) is not None:
                    yield getattr(importlib.import_module(f"{package}.{kind}"), name)


def _of_library(top: str, name: str) -> Iterator[Any]:
    """What the modules of a library define by the name."""
    root = os.path.dirname(str(sys.modules[top].__file__))
    for folder, _, files in os.walk(root):
        for file in sorted(files):
            below = os.path.relpath(os.path.join(folder, file), os.path.dirname(root))
            if file.endswith(".py") and file != "__init__.py":
                module = importlib.import_module(below[: -len(".py")].replace(os.sep, "."))
                found = vars(module).get(name)
                if getattr(found, "__module__", None) == module.__name__:
                    yield found
