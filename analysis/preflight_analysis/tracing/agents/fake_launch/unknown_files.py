"""What lies in a folder that is not known, and a variable of the environment that is not set: unknown as well.

A path with a mark in it (`anything`) is there, whoever asks; what is read of it is a text that is not known. Parsers
that get such a text give a stand-in.
"""

from __future__ import annotations

import builtins
import functools
import glob
import importlib.abc
import importlib.util
import io
import os
import pathlib
import shutil
import sys
import xml.dom.minidom
from typing import Any, Callable, Iterator

from .. import partial_xacro
from ..anything import MARKS, Anything, UnknownText, asked, is_unknown, marked, name_of, readable, unknown_text
from ..missing_modules import provided_for
from ..skeletons import Skeletons
from . import programs, written
from .base import OURS, RECORDER, is_own

_SHARE = "the share folder of "
_PARSERS = {
    "ast": ("literal_eval",),
    "json": ("load", "loads"),
    "re": ("findall", "finditer", "fullmatch", "match", "search", "split", "sub"),
    "yaml": ("load", "safe_load", "full_load", "unsafe_load", "load_all", "safe_load_all"),
    "socket": ("gethostbyname", "getaddrinfo", "getfqdn"),
    "tomllib": ("load", "loads"),
    "xacro": ("process", "process_file", "parse", "process_doc"),
    "xml.dom.minidom": ("parse", "parseString"),
    "xml.etree.ElementTree": ("parse", "fromstring"),
    "subprocess": ("check_output", "run", "check_call", "call", "getoutput", "getstatusoutput"),
}
"""Functions whose value is unknown where something of what they are given is."""
_DATA = ("json.", "yaml.")
"""Modules whose functions give what a text says."""
_SYSTEM_ERRORS = ("OSError", "IOError", "error", "gaierror", "herror", "timeout")
_MAPPINGS = ("_collections_abc", "collections.abc", "os")
"""Which ask for a variable to tell whether it is there."""


def install() -> None:
    """From now on what is unknown is there."""
    open_file = written.install(io.open)

    def opened(file: Any, mode: str = "r", *args: Any, **kwargs: Any) -> Any:
        if not _is_of_unknown(file):
            return open_file(file, mode, *args, **kwargs)
        text = _Text(str(file)) if "b" not in mode else io.BytesIO(str(file).encode())
        text.name = str(file)
        return text

    for module in (builtins, io):
        module.open = opened  # type: ignore[attr-defined]
    for name in ("exists", "lexists", "isfile", "isdir"):
        setattr(os.path, name, _true(getattr(os.path, name)))
    for name in ("exists", "is_file", "is_dir"):
        setattr(pathlib.Path, name, _true(getattr(pathlib.Path, name)))
    os.listdir = _instead(os.listdir, lambda folder: [_in(folder)], list)
    os.walk = _instead(os.walk, lambda folder: [(folder, [], [_in(folder)])], list)
    os.scandir = _instead(os.scandir, lambda folder: Anything(f"scandir({folder})"), list)
    glob.glob = _instead(glob.glob, lambda pattern: [_in(pattern)], list)
    for name in ("glob", "rglob", "iterdir"):
        setattr(pathlib.Path, name, _instead(getattr(pathlib.Path, name), _paths_in, _no_paths))
    for name in ("getsize", "getmtime", "getctime", "getatime"):
        setattr(os.path, name, _unasked(getattr(os.path, name), _about))
    os.stat = _unasked(os.stat, _about)
    setattr(pathlib.Path, "stat", _unasked(pathlib.Path.stat, _about))  # noqa: B010, mypy holds methods to be fixed
    os.chdir = _unasked(os.chdir, lambda _: None)
    builtins.input = _asked
    shutil.which = _which(shutil.which)
    os.getlogin = _answered(os.getlogin)
    environment: Any = type(os.environ)
    environment.__getitem__ = _variable(environment.__getitem__)
    _look_for_variables(environment)
    for name, functions in _PARSERS.items():
        if name in sys.modules:
            _guard(sys.modules[name], functions)
    sys.meta_path.insert(0, _Guards())


class _Text(io.StringIO):
    name = ""


class _Guards(importlib.abc.MetaPathFinder):
    """Guards the parsers of a module once it is imported."""

    def __init__(self) -> None:
        self._open: set[str] = set()

    def find_spec(self, fullname: str, path: Any = None, target: Any = None) -> Any:
        if fullname not in _PARSERS or fullname in self._open:
            return None
        self._open.add(fullname)
        spec = importlib.util.find_spec(fullname)
        self._open.discard(fullname)
        if spec is not None and spec.loader is not None:
            execute = spec.loader.exec_module

            def exec_module(module: Any) -> None:
                execute(module)
                _guard(module, _PARSERS[fullname])

            spec.loader.exec_module = exec_module  # type: ignore[method-assign]
        return spec


def _guard(module: Any, names: Any) -> None:
    if module.__name__ == "yaml":
        for representer in (module.representer.SafeRepresenter, module.representer.Representer):
            representer.add_representer(UnknownText, module.representer.SafeRepresenter.represent_str)
            representer.add_representer(Anything, lambda to, value: to.represent_str(str(value)))
    elif module.__name__ == "subprocess":
        programs.install(module)
    elif module.__name__ == "xacro" and partial_xacro.can_install(module):
        partial_xacro.install(module, partial_xacro.Lacking(Skeletons(RECORDER.descriptions)))
    elif module.__name__ == "socket":
        for name in names:
            setattr(module, name, _answered(getattr(module, name)))
    elif module.__name__ == "json":
        module.JSONEncoder.default = _as_json(module.JSONEncoder.default)
    for name in names:
        function = getattr(module, name, None)
        if callable(function):
            setattr(module, name, _guarded(function, f"{module.__name__}.{name}()"))


def _guarded(function: Any, name: str) -> Any:
    def unknown() -> Any:
        if name == "xacro.process()":
            return unknown_text(name)
        return _Document(name) if name.startswith("xacro.") else Anything(name)

    @functools.wraps(function)
    def called(*args: Any, **kwargs: Any) -> Any:
        frame = sys._getframe(1)
        if frame.f_globals.get("__name__", "").partition(".")[0] == "xacro":
            return function(*args, **kwargs)  # its own functions are guarded as a whole
        if name.startswith("re.") and not is_own(frame):
            return function(*args, **kwargs)
        if name.startswith("xacro."):
            args = tuple(map(_as_described, args))
        if any(map(_is_of_unknown, args)) or any(map(_is_of_unknown, kwargs.values())):
            return unknown()
        line = args[0] if args else kwargs.get("args")
        if name.startswith("subprocess.") and programs.is_unknown(line, frame):
            RECORDER.unknown = True
            return unknown()
        try:
            found = function(*args, **kwargs)
            # A file that was written of something unknown has its mark and nothing else.
            return unknown() if name.startswith(_DATA) and isinstance(found, str) and is_unknown(found) else found
        except Exception as error:
            if not is_unknown(str(error)) and not name.startswith("xacro."):
                raise
            if not RECORDER.unknown:
                raise
            return unknown()  # it reads other files, which may be in a folder that is not known

    return called


def _as_described(path: Any) -> Any:
    """A path in a package that is not here, as xacro finds it where the catalogue has the package's descriptions."""
    if not isinstance(path, (str, os.PathLike)):
        return path
    skeletons = Skeletons(RECORDER.descriptions)

    def described(found: Any) -> str:
        name = name_of(found[0])
        return (skeletons.folder_of(name[len(_SHARE) :]) if name.startswith(_SHARE) else None) or str(found[0])

    return MARKS.sub(described, str(path))


def _as_json(default: Any) -> Any:
    def called(self: Any, value: Any) -> Any:
        return str(value) if isinstance(value, Anything) else default(self, value)

    return called


class _Document(xml.dom.minidom.Document):
    """A robot description that is not known."""

    def __init__(self, name: str) -> None:
        super().__init__()
        self._unknown = name
        self.appendChild(self.createElement("robot"))

    def toxml(self, *args: Any, **kwargs: Any) -> Any:
        return unknown_text(self._unknown)

    toprettyxml = toxml


def _is_of_unknown(value: Any) -> bool:
    """Whether it is a path, a text, a file or a command line in which something is unknown."""
    if isinstance(value, (str, Anything)):
        return isinstance(value, Anything) or is_unknown(value)
    if isinstance(value, bytes):
        return is_unknown(value.decode(errors="ignore"))
    if isinstance(value, (list, tuple)):
        return any(map(_is_of_unknown, value))
    if isinstance(value, os.PathLike):
        return is_unknown(os.fspath(value))
    return is_unknown(getattr(value, "name", None))


def _true(function: Callable[..., bool]) -> Any:
    return _instead(function, lambda _: True, lambda: False)


def _in(folder: Any) -> str:
    """The name of a file in a folder, or of the path that a pattern fits."""
    return unknown_text(f"a file in {readable(os.fspath(folder))}")


def _about(path: Any) -> Any:
    return Anything(f"stat({path})")


def _paths_in(folder: Any) -> Iterator[Any]:
    return iter([folder / _in(folder)])


def _no_paths() -> Iterator[Any]:
    return iter([])


def _instead(function: Any, there: Callable[[Any], Any], not_there: Callable[[], Any]) -> Any:
    """What is asked of a path that is not known: as if it were there, or the other way round."""

    @functools.wraps(function)
    def called(*args: Any, **kwargs: Any) -> Any:
        if not args or not _is_of_unknown(args[0]):
            found = function(*args, **kwargs)
            if args:
                RECORDER.looks_for(args[0], found, sys._getframe(1))
            return found
        is_there = asked(f"{function.__name__}({args[0]})", sys._getframe(1))
        return there(args[0]) if is_there else not_there()

    return called


def _which(which: Any) -> Any:
    """What looks for programs."""

    @functools.wraps(which)
    def called(cmd: Any, *args: Any, **kwargs: Any) -> Any:
        found = which(cmd, *args, **kwargs)
        RECORDER.looks_for(cmd, found, sys._getframe(1))
        return found

    return called


def _unasked(function: Any, value: Callable[[Any], Any]) -> Any:
    @functools.wraps(function)
    def called(path: Any, *args: Any, **kwargs: Any) -> Any:
        is_own_path = _is_of_unknown(path) and is_own(sys._getframe(1))
        return value(path) if is_own_path else function(path, *args, **kwargs)

    return called


def _answered(function: Any) -> Any:
    """What the sandbox does not tell: who is logged in, and which addresses the network has."""

    @functools.wraps(function)
    def called(*args: Any, **kwargs: Any) -> Any:
        try:
            return function(*args, **kwargs)
        except OSError:
            if provided_for(sys._getframe(1), _SYSTEM_ERRORS):
                raise
        RECORDER.unknown = True
        return marked(unknown_text(f"{function.__name__}()"))

    return called


def _asked(prompt: Any = "") -> str:
    """Nobody answers."""
    RECORDER.unknown = True
    return unknown_text("input()")


def _variable(getitem: Any) -> Any:
    def called(self: Any, key: Any) -> Any:
        RECORDER.asks_for(key, sys._getframe(1))
        try:
            found = getitem(self, key)
            RECORDER.unknown = RECORDER.unknown or is_unknown(found)
            return marked(found)
        except KeyError:
            frame: Any = sys._getframe(1)
            asks = frame.f_globals.get("__name__") in _MAPPINGS or frame.f_code.co_filename.startswith(OURS)
            if asks or not isinstance(key, str) or provided_for(frame, ("KeyError", "LookupError")):
                raise
        RECORDER.miss("variable", key)
        return unknown_text(f"the variable {key}")

    return called


def _look_for_variables(environment: Any) -> None:
    """A launch file that asks whether a variable is set, and raises where it is not, has one that is not known."""
    is_set, get = environment.__contains__, environment.get

    def contains(self: Any, key: Any) -> bool:
        return bool(is_set(self, key)) or _is_assumed(key, sys._getframe(1))

    def given(value: Any, key: Any) -> Any:
        if value is None and isinstance(key, str):
            RECORDER.none.setdefault(key, RECORDER.place())
        return value

    def found(self: Any, key: Any, default: Any = None) -> Any:
        RECORDER.asks_for(key, sys._getframe(1))
        assumed = not default and not is_set(self, key) and _is_assumed(key, sys._getframe(1))
        return unknown_text(f"the variable {key}") if assumed else given(get(self, key, default), key)

    def getenv(key: Any, default: Any = None) -> Any:
        RECORDER.asks_for(key, sys._getframe(1))
        assumed = not default and not is_set(os.environ, key) and _is_assumed(key, sys._getframe(1))
        return unknown_text(f"the variable {key}") if assumed else given(get(os.environ, key, default), key)

    environment.__contains__, environment.get, os.getenv = contains, found, getenv


def _is_assumed(name: Any, frame: Any) -> bool:
    """Whether a variable that is not set counts as set."""
    if not is_own(frame) or not isinstance(name, str) or not RECORDER.answers.is_set(name, frame):
        return False
    RECORDER.miss("variable", name)
    return True
