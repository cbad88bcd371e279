"""Finds what is missing on this machine: the last to be asked for a module."""

from __future__ import annotations

import functools
import importlib.abc
import importlib.machinery
import json
import os
import re
import sys
from typing import Any, Sequence

from .. import channel
from ..anything import AnyModule, importer, on_use
from ..missing_modules import IMPORTS, MissingModules, provided_for
from ..variables import AGAIN, STAND_INS
from .definitions import KINDS, Definitions
from .interfaces import InterfaceModule, Maker
from .names_elsewhere import Lacking

LIBRARIES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "libraries")
OF_GENERATION = {
    number: frozenset(
        name.partition(".")[0]
        for folder in (f"ros{number}", "both")
        for name in os.listdir(os.path.join(LIBRARIES, folder))
        if not name.startswith("__")
    )
    for number in (1, 2)
}
"""The libraries that have a stand-in of their own, by generation of ROS."""
_IMPORTS_OF = {
    1: re.compile(r"^\s*(?:import|from) (?:genpy|roslib|rospy)\b", re.MULTILINE),
    2: re.compile(r"^\s*(?:import|from) (?:rclpy|rosidl_\w+)\b", re.MULTILINE),
}
"""What libraries and messages of each generation import."""


def _library(fullname: str, folders: Sequence[str]) -> Any:
    """A module of `libraries/`, which has what it lacks of the real one from elsewhere."""
    spec = importlib.machinery.PathFinder.find_spec(fullname, folders)
    if spec is not None and isinstance(spec.loader, importlib.machinery.SourceFileLoader):
        spec.loader = _LibraryLoader(spec.loader.name, spec.loader.path)
    return spec


class _LibraryLoader(importlib.machinery.SourceFileLoader):
    lacking: Lacking

    def exec_module(self, module: Any) -> None:
        super().exec_module(module)
        if "__getattr__" not in vars(module):
            module.__getattr__ = functools.partial(self.lacking.name_in, module.__name__)


class _PartsOfLibraries(importlib.abc.MetaPathFinder):
    """Finds the modules within a package of `libraries/`."""

    def find_spec(self, fullname: str, path: Any = None, target: Any = None) -> Any:
        return _library(fullname, path) if any(str(each).startswith(LIBRARIES) for each in path or ()) else None


class StandIns(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Finds libraries of ROS, and modules of messages."""

    def __init__(self, generation: int, packages: dict[str, str]) -> None:
        self._generation = generation
        self._libraries = OF_GENERATION[generation]
        self._folders = [os.path.join(LIBRARIES, f"ros{generation}"), os.path.join(LIBRARIES, "both")]
        self._definitions = Definitions(generation, packages)
        self._maker = Maker(generation, self._definitions)
        _LibraryLoader.lacking = Lacking(self._definitions)

    def find_spec(self, fullname: str, path: Any = None, target: Any = None) -> Any:
        top, _, rest = fullname.partition(".")
        if not rest and top in self._libraries:
            note(top)
            return _library(fullname, self._folders)
        known = self._definitions.has_package(top)
        if (not rest and known) or (rest in KINDS and (known or not _is_provided_for())):
            note(top)
            if self._generation == 2 and rest:
                _without_real_rclpy()
            return importlib.machinery.ModuleSpec(fullname, self, is_package=True)
        return None

    def in_place_of(self, top: str) -> Any:
        """What is found in the place of a library or a package of messages that is there."""
        note(top)
        if top in self._libraries:
            return _library(top, self._folders)
        return importlib.machinery.ModuleSpec(top, self, is_package=True)

    def create_module(self, spec: Any) -> Any:
        return InterfaceModule(spec.name, self._maker) if "." in spec.name else AnyModule(spec.name)

    def exec_module(self, module: Any) -> None:
        return None

    def stands_in(self, fullname: str) -> bool:
        """Whether a part of a module may have a stand-in whose whole is there: a part of a library that has one, or
        what is generated of parameters for dynamic_reconfigure."""
        top, _, rest = fullname.partition(".")
        return rest == "cfg" or top in self._libraries


def _is_provided_for() -> bool:
    frame = importer()
    return frame is not None and provided_for(frame, IMPORTS)


class _RclpyFirst(importlib.abc.MetaPathFinder):
    """Finds the stand-in of rclpy before the real one, which takes no messages but those that were generated for it."""

    def find_spec(self, fullname: str, path: Any = None, target: Any = None) -> Any:
        if fullname != "rclpy":
            return None
        note("rclpy")
        return _library(fullname, [os.path.join(LIBRARIES, "ros2")])


class _NoOtherGeneration(importlib.abc.MetaPathFinder):
    """Finds stand-ins before libraries and messages of the other generation of ROS, which Debian has for whatever
    program there is."""

    def __init__(self, generation: int, found: StandIns) -> None:
        self._generation, self._found = generation, found

    def find_spec(self, fullname: str, path: Any = None, target: Any = None) -> Any:
        spec = importlib.machinery.PathFinder.find_spec(fullname) if "." not in fullname else None
        folders = (spec.submodule_search_locations if spec is not None else None) or ()
        if not any(map(self._is_of_other, folders)):
            return None
        return self._found.in_place_of(fullname)

    def _is_of_other(self, folder: str) -> bool:
        parts = [below for kind in KINDS if os.path.isdir(below := os.path.join(folder, kind))]
        if os.path.basename(folder) in OF_GENERATION[self._generation]:
            parts.append(folder)
        return any(_imports(3 - self._generation, each) for each in parts)


def _imports(generation: int, folder: str) -> bool:
    """Whether a module in the folder imports what those of a generation do."""
    for name in sorted(os.listdir(folder)):
        if name.endswith(".py"):
            with open(os.path.join(folder, name), encoding="utf-8", errors="replace") as file:
                if _IMPORTS_OF[generation].search(file.read()):
                    return True
    return False


def _without_real_rclpy() -> None:
    """Messages are missing: from the start of the program on, rclpy is to be the stand-in."""
    rclpy = sys.modules.get("rclpy")
    if rclpy is None:
        if not any(isinstance(each, _RclpyFirst) for each in sys.meta_path):
            put_rclpy_first()
    elif not str(getattr(rclpy, "__file__", "")).startswith(LIBRARIES) and AGAIN not in os.environ:
        with open("/proc/self/cmdline", "rb") as file:
            words = file.read().split(b"\0")[:-1]
        os.execve(  # noqa: S606
            sys.executable, words, {**os.environ, AGAIN: "1"}
        )


def put_rclpy_first() -> None:
    """Find the stand-in of rclpy before the interpreter's own ways find a module; what weaves is asked even before."""
    _put_first(_RclpyFirst())


def _put_first(finder: importlib.abc.MetaPathFinder) -> None:
    own = (at for at, each in enumerate(sys.meta_path) if each is importlib.machinery.PathFinder)
    sys.meta_path.insert(next(own, len(sys.meta_path)), finder)


_noted: set[str] = set()


def note(name: str, file: str = "", line: int = 0) -> None:
    """Tell that a module has a stand-in, and where the real one could turn up."""
    top = name.partition(".")[0]
    if top not in _noted:
        _noted.add(top)
        ours = os.path.dirname(channel.PATH) + os.sep
        channel.send("stood-in", name=top, paths=[p for p in sys.path if os.path.isabs(p) and not p.startswith(ours)])


def lacked(name: str) -> None:
    """Tell of a module without which the program itself goes on."""
    channel.send("lacked", name=name.partition(".")[0])


def install() -> None:
    """Be asked last, where the host says so."""
    with open(os.environ[STAND_INS], encoding="utf-8") as file:
        job = json.load(file)
    on_use.append(lambda: channel.send("asked", what="stand-in"))
    found = StandIns(job["generation"], job["packages"])
    sys.meta_path += [found, MissingModules(note, found.stands_in, lacked)]
    _put_first(_PartsOfLibraries())
    _put_first(_NoOtherGeneration(job["generation"], found))
    if AGAIN in os.environ:
        put_rclpy_first()
