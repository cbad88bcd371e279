"""What a launch file that is read finds around it: built-in functions and modules.

Modules of launch are the fakes of `agents/fake_launch/`, as in a run. Of the standard library there is what is named
here; modules of the workspace are read like the launch file. All else only a run knows.
"""

from __future__ import annotations

import ast
import builtins
import collections
import copy
import importlib
import itertools
import json
import math
import os
import posixpath
import re
import string
import sys
import textwrap
import types
import typing
import xml.etree.ElementTree
from collections.abc import Callable, Iterator, Mapping
from functools import cached_property, lru_cache
from typing import Any

import yaml

from preflight_analysis.tracing.agents.anything import Anything, UnknownText, is_unknown, marked, readable, unknown_text
from preflight_analysis.tracing.agents.fake_launch import (
    base,
    modules,
    moveit_configs,
    reads,
    rewritten,
    substitutions,
    tables,
)
from preflight_analysis.tracing.agents.fake_launch.tables import FOLDERS
from preflight_analysis.tracing.reading.data_classes import FIELD, dataclass, members, replaced
from preflight_analysis.tracing.reading.files import Files, Path
from preflight_analysis.tracing.reading.interpreter import Frame, Interpreter
from preflight_analysis.tracing.reading.values import (
    FAKES,
    MAX_DEPTH,
    MAX_ITEMS,
    MAX_TEXT,
    METHODS,
    SAFE_TYPES,
    Function,
    Module,
    NotRead,
    Raised,
    Wrapped,
    check_size,
    is_fake,
    is_program_class,
    may_have,
    whole,
)

_OURS = __name__.rpartition(".")[0]
_OF_TAGS = ("add_constructor", "add_multi_constructor", "add_implicit_resolver", "add_path_resolver")
_LOADER: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
_MAX_YAML = 300_000
_MAX_EXPRESSION = 5_000
_MAX_MANIFEST = 100_000
_MAX_MODULE = 300_000
_MAX_PATTERN_WORK = 20_000_000
_PATHS = "os.path"
_OF_LIBRARY = "what it gives is known only when it is launched"
_NOT_FOUND = "whether the module is installed is known only when it is launched"
_ASKS_ENVIRONMENT = re.compile(
    r"HOME|PATH|PWD|TMP|TMPDIR|TEMP|LD_.*|PYTHON.*|XDG_.*|AMENT_.*|COLCON_.*|CMAKE_.*|ROS_(?!DISTRO$|VERSION$|PYTHON_VERSION$|DOMAIN_ID$).*|LANG|LC_.*"
)
"""Variables that the sandbox sets itself."""


_WITHOUT_END = ("factorial", "comb", "perm", "lcm")


def _named(module: Any, *names: str) -> dict[str, Any]:
    return {name: getattr(module, name) for name in names}


_NATIVE: dict[str, dict[str, Any]] = {
    "math": {k: v for k, v in vars(math).items() if not k.startswith("_") and k not in _WITHOUT_END},
    "itertools": _named(itertools, "chain", "product", "zip_longest", "islice"),
    "string": {k: v for k, v in vars(string).items() if isinstance(v, str) and not k.startswith("_")},
    "textwrap": _named(textwrap, "dedent"),
    "posixpath": {},
    "typing": {k: v for k, v in vars(typing).items() if k[:1].isupper() and k != "NamedTuple"},
    "collections": _named(collections, "OrderedDict", "defaultdict", "Counter", "deque"),
    "collections.abc": {k: v for k, v in vars(collections.abc).items() if k[:1].isupper()},
}
_PURE_PATHS = (
    *("join", "dirname", "basename", "normpath", "split", "splitext", "isabs", "commonpath", "commonprefix"),
    "normcase",
)
_PLAIN_BUILTINS = (
    *("abs", "all", "any", "ascii", "bool", "bytes", "callable", "chr", "dict", "divmod", "enumerate", "filter"),
    *("float", "format", "frozenset", "int", "isinstance", "issubclass", "iter", "len", "list", "map", "max", "min"),
    *("next", "object", "ord", "pow", "property", "range", "repr", "reversed", "round", "set", "slice", "sorted"),
    *(
        "staticmethod",
        "classmethod",
        "str",
        "sum",
        "super",
        "tuple",
        "type",
        "zip",
        "bin",
        "hex",
        "oct",
        "NotImplemented",
    ),
    *("Ellipsis", "complex"),
)
_EXCEPTIONS = {k: v for k, v in vars(builtins).items() if isinstance(v, type) and issubclass(v, BaseException)}
_ALLOWED_TYPES = frozenset(
    (
        *SAFE_TYPES,
        *(object, property, type),
        *(each for name in ("itertools", "collections") for each in _NATIVE[name].values() if isinstance(each, type)),
    )
)
_ALLOWED_FUNCTIONS = frozenset(
    (
        *(getattr(builtins, name) for name in _PLAIN_BUILTINS if callable(getattr(builtins, name))),
        *(getattr(posixpath, name) for name in _PURE_PATHS),
        *(v for k in ("math", "textwrap") for v in _NATIVE[k].values() if callable(v)),
        *rewritten._INSTEAD.values(),
    )
)
_NOT_OF_FAKES = frozenset(
    (
        *("load_python_launch_file_as_module", "get_launch_description_from_python_launch_file"),
        *("get_launch_description_from_any_launch_file", "get_launch_description_from_frontend_launch_file"),
        *("get_search_paths", "instantiate_extension"),
    )
)
_UNREAD_FAKES = ("launch_pal",)


class Context(base.LaunchContext):
    """`launch.LaunchContext`."""

    _around: Around
    """Of the reading that goes on."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.launch_configurations = reads.Configurations()

    @property
    def environment(self) -> Any:
        """The variables that the file sees."""
        return self._around.environment

    def perform_substitution(self, substitution: Any) -> Any:
        """The text of a substitution."""
        return self._around.performed(substitution, self)


Context.__name__ = Context.__qualname__ = "LaunchContext"
Context.__module__ = base.__name__


class Environment(dict[str, str]):
    """`os.environ`."""

    def __init__(self, around: Around, values: Mapping[str, str]) -> None:
        super().__init__(values)
        self._around = around

    def __getitem__(self, name: str) -> Any:
        base.RECORDER.asks_for(name, None)
        if dict.__contains__(self, name):
            return marked(dict.__getitem__(self, name))
        if self._is_of_sandbox(name):
            return str(self._around.unknown(f"the variable {name}", _OF_LIBRARY))
        if not isinstance(name, str) or self._around.is_provided_for(("KeyError", "LookupError")):
            raise KeyError(name)
        base.RECORDER.miss("variable", name)
        return unknown_text(f"the variable {name}")

    def get(self, name: Any, default: Any = None) -> Any:
        """One, or what there is without it."""
        base.RECORDER.asks_for(name, None)
        if not dict.__contains__(self, name) and self._is_of_sandbox(name):
            return str(self._around.unknown(f"the variable {name}", _OF_LIBRARY))
        if not default and not dict.__contains__(self, name):
            self._around.asked_for_unset()
        value = dict.get(self, name, default)
        if value is None and isinstance(name, str):
            base.RECORDER.none.setdefault(name, base.RECORDER.place())
        return marked(value)

    def __contains__(self, name: object) -> bool:
        if not dict.__contains__(self, name):
            if self._is_of_sandbox(name):
                return bool(self._around.unknown(f"the variable {name}", _OF_LIBRARY))
            self._around.asked_for_unset()
        return dict.__contains__(self, name)

    def _is_of_sandbox(self, name: object) -> bool:
        return isinstance(name, str) and _ASKS_ENVIRONMENT.fullmatch(name) is not None

    def copy(self) -> Any:
        """All."""
        self._around.unknown("os.environ", "all variables of the environment are asked for")
        return dict(dict.items(self))

    def items(self) -> Any:
        """All."""
        self._around.unknown("os.environ", "all variables of the environment are asked for")
        return dict.items(self)

    def __iter__(self) -> Iterator[str]:
        self._around.unknown("os.environ", "all variables of the environment are asked for")
        return dict.__iter__(self)

    def keys(self) -> Any:
        """All names."""
        return dict.fromkeys(self).keys()

    def values(self) -> Any:
        """All values."""
        return dict(self.items()).values()


Environment.__module__ = base.__name__


class Quiet:
    """What logs: it is dropped."""

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return _nothing


Quiet.__module__ = base.__name__


def _nothing(*args: Any, **kwargs: Any) -> None:
    return None


def _identity(thing: Any = None, *args: Any, **kwargs: Any) -> Any:
    return thing if isinstance(thing, (Function, type)) else (lambda given: given)


@lru_cache(maxsize=64)
def parsed(text: str) -> ast.Module | None:
    """The syntax tree; None where there is none, or the text is longer than anyone writes."""
    try:
        return ast.parse(text) if len(text) <= _MAX_MODULE else None
    except (SyntaxError, ValueError, MemoryError, RecursionError):
        return None


class Services:
    """What the fakes have in the place of modules of Python, in a reading. What is not named is not there."""

    def __init__(self, **names: Any) -> None:
        vars(self).update(names)

    def __getattr__(self, name: str) -> Any:
        raise NotRead(f"{name} of the system")


class Around:
    """What a reading has around it; `interpreter.Around`."""

    def __init__(
        self,
        job: Mapping[str, Any],
        files: Callable[[Callable[[str, str], Any]], Files],
        folders: tuple[str, ...],
        variables: Mapping[str, str],
    ) -> None:
        self.job = job
        self.unread: dict[tuple[str, str, int], Any] = {}
        """What only a run tells: names, reasons and lines, with the places."""
        self.asked_unset = False
        self.files = files(self.unknown)
        Path._files = self.files
        Context._around = self
        self.environment = self.files.variables = Environment(self, variables)
        self.interpreter = Interpreter(self, str(job["file"]), base.RECORDER.written)
        self.path: list[Any] = list(folders)
        self._modules: dict[str, Any] = {}
        self._more: dict[str, Any] = {}
        self._safe_loader, self._has_own_tags = self._loader("SafeLoader"), False
        self._builtins = self._make_builtins()

    # What is not known

    def unknown(self, name: str, reason: str) -> Any:
        """A stand-in for what only a run knows, which is noted."""
        place = base.RECORDER.place()
        self.unread.setdefault((readable(name), reason, place[0] if place else 0), place)
        base.RECORDER.unknown = True
        if any(frame.tries for frame in self.interpreter.frames):
            base.RECORDER.note_guess(name, None)  # it may raise, and the program goes on in another way
        return Anything(readable(name))

    def asked_for_unset(self) -> None:
        """The program asks for a variable that is not set: another answer is tried in a run, where it raises then."""
        self.asked_unset = True

    def is_provided_for(self, errors: Any) -> bool:
        """Whether the program handles one of these errors where it is."""
        from preflight_analysis.tracing.agents import missing_modules  # noqa: PLC0415

        frames = self.interpreter.frames
        return bool(frames) and self.interpreter.is_provided_for(
            errors, missing_modules._catches, missing_modules._ends
        )

    def _unread_function(self, name: str) -> Any:
        return lambda *args, **kwargs: self.unknown(f"{name}()", _OF_LIBRARY)

    # Built-in functions

    def builtin(self, name: str) -> Any:
        """A built-in function; raises KeyError."""
        return self._builtins[name]

    def _make_builtins(self) -> dict[str, Any]:
        found: dict[str, Any] = {name: getattr(builtins, name) for name in _PLAIN_BUILTINS}
        found.update(_EXCEPTIONS)
        found.update(
            print=_nothing,
            open=self.files.open,
            getattr=self._getattr,
            hasattr=self._hasattr,
            setattr=self.interpreter.set_attribute,
            vars=self._vars,
            isinstance=self._isinstance,
            str=str,
        )
        for name in ("eval", "exec", "compile", "__import__", "globals", "locals", "id", "hash", "dir", "delattr"):
            found[name] = self._unread_function(name)
        found["input"] = lambda prompt="": unknown_text("input()")
        for name in ("exit", "quit"):
            found[name] = self._exit
        return found

    @staticmethod
    def _exit(code: Any = None) -> None:
        raise Raised(SystemExit(code))

    def _getattr(self, thing: Any, name: Any, *default: Any) -> Any:
        if rewritten._is_unknown(name):
            return Anything(str(name))
        try:
            return self.interpreter.attribute(thing, name)
        except Raised as raised:
            if default and isinstance(raised.error, AttributeError):
                return default[0]
            raise

    def _hasattr(self, thing: Any, name: Any) -> bool:
        try:
            self.interpreter.attribute(thing, name)
        except Raised as raised:
            if isinstance(raised.error, AttributeError):
                return False
            raise
        return True

    @staticmethod
    def _vars(*things: Any) -> Any:
        if len(things) == 1 and may_have(things[0], "__dict__"):
            return vars(things[0])
        raise NotRead("vars()")

    def _isinstance(self, thing: Any, kind: Any) -> Any:
        if isinstance(thing, Module) or isinstance(kind, (Module, Function)):
            raise NotRead("isinstance() of what is not read")
        return self.interpreter._native(rewritten._isinstance, thing, kind)

    # What may be called

    def instead(self, function: Any) -> Any:
        """What is called in the place of a function."""
        of, name = getattr(function, "__self__", None), getattr(function, "__name__", "")
        module = getattr(function, "__module__", None) or ""
        if isinstance(function, type):
            return self._class(function)
        if module.startswith(_OURS):
            return function
        if isinstance(function, types.MethodType) and (is_fake(type(of)) or isinstance(of, Path)):
            return self._method(function, of, name)
        if isinstance(function, types.FunctionType) and module.startswith(FAKES):
            return self._unread_function(name) if name in _NOT_OF_FAKES else function
        if isinstance(of, type) and is_fake(of) and not name.startswith("_"):
            return function
        if _is_hashable(function) and function in _ALLOWED_FUNCTIONS:
            return function
        if isinstance(function, types.BuiltinMethodType) and name in METHODS.get(
            of if isinstance(of, type) else type(of), ()
        ):
            return function
        is_bound = isinstance(function, types.MethodType)
        if is_bound and (is_fake(type(of)) or isinstance(of, Path) or of is Path or is_program_class(type(of))):
            return function
        if is_program_class(type(function)) or isinstance(function, (modules._Anything, Quiet)):
            return function
        if isinstance(function, types.MethodWrapperType) and name == "__init__" and is_program_class(type(of)):
            return function  # no class between this one and `object` has one
        return self._unread_function(name or type(function).__name__)

    def _class(self, kind: type) -> Any:
        if kind is type:
            return self._type
        if kind in _ALLOWED_TYPES or is_fake(kind) or kind is Path or kind in _EXCEPTIONS.values():
            return kind
        return self._unread_function(kind.__name__)

    @staticmethod
    def _type(*args: Any) -> Any:
        if len(args) != 1:
            raise NotRead("type() with three arguments")
        return rewritten._type(*args)

    def _method(self, function: Any, of: Any, name: str) -> Any:
        if isinstance(of, base.Substitution) and name == "perform" and not base.overrides(of, name):
            return lambda context: self.performed(of, context)
        return function

    def performed(self, substitution: Any, context: Any) -> Any:
        """The text of a substitution."""
        self.interpreter.step()
        if is_program_class(type(substitution)) and base.overrides(substitution, "perform"):
            return self.interpreter.call(substitution.perform, (context,), {})
        if isinstance(substitution, substitutions.Command):
            return str(self.unknown("Command()", "the command was not run"))
        if isinstance(substitution, substitutions.FindExecutable):
            return str(self.unknown("FindExecutable()", "which programs there are is known only where it is launched"))
        if isinstance(substitution, (substitutions.LaunchLogDir, moveit_configs.Xacro)):
            return str(self.unknown(type(substitution).__name__, _OF_LIBRARY))
        return self.interpreter.made(substitution.perform(context))

    def evaluated(self, text: Any, _: Any, values: dict[str, Any]) -> Any:
        """The value of an expression that is written in a text, as `eval` gives it."""
        if is_unknown(text) or not isinstance(text, str) or len(text) > _MAX_EXPRESSION:
            return self.unknown("the expression", _OF_LIBRARY)
        try:
            tree = ast.parse(text.strip(), mode="eval")
        except (SyntaxError, ValueError, MemoryError, RecursionError):
            return self.unknown("the expression", _OF_LIBRARY)
        return self.interpreter.expression(tree.body, values)

    def parsed_xml(self, path: Any) -> Any:
        """`xml.etree.ElementTree.parse`, of a manifest."""
        text = self.files.text(path)
        if not isinstance(text, str) or len(text) > _MAX_MANIFEST or "<!" in text.replace("<!--", ""):
            raise NotRead("a manifest that is not plain")
        return xml.etree.ElementTree.ElementTree(xml.etree.ElementTree.fromstring(text))  # noqa: S314 - no entities

    def imported(self, name: Any) -> Any:
        """`importlib.import_module` for the fakes."""
        if not isinstance(name, str) or is_unknown(name):
            raise NotRead("a module without a name")
        if name == "yaml":
            return Services(safe_load=self.load_yaml, dump=self.dump_yaml)
        if name == "xacro":
            return Services(process_file=lambda *_, **__: self.unknown("xacro", "the command was not run"))
        return self.module(name, None, 0)

    # Modules

    def module(self, name: str, frame: Frame | None, level: int) -> Any:
        """An imported module; raises `Raised` where there is none."""
        if level:
            name = self._absolute(name, frame, level)
        found = self._modules.get(name)
        if found is None:
            above = name.rpartition(".")[0]
            if above and name != _PATHS:
                self.module(above, frame, 0)
            self._modules[name] = found = self._make(name)
            if above and isinstance(found, Module):
                parent = self._modules.get(above)
                if isinstance(parent, Module):
                    parent.contents.setdefault(name.rpartition(".")[2], found)
        return found

    def _absolute(self, name: str, frame: Frame | None, level: int) -> str:
        own = next(
            (k for k, v in self._modules.items() if isinstance(v, Module) and frame and v.file == frame.file), ""
        )
        parts = own.split(".")
        is_package = bool(frame and frame.file.endswith("/__init__.py"))
        keep = len(parts) - level + is_package
        if not own or keep <= 0:
            raise Raised(ImportError("attempted relative import with no known parent package"))
        return ".".join([*parts[:keep], *([name] if name else [])])

    def _make(self, name: str) -> Any:
        top = name.partition(".")[0]
        if top in modules._TOP:
            return self._of_launch(name)
        if name in (_PATHS, "posixpath"):
            return self._paths()
        if top in sys.stdlib_module_names:
            return Module(name, self._library(name))
        if name == "xacro":
            return Module(name, {})  # whose it is, ROS's or ours, makes no difference
        file = self._file(name)
        if file is not None:
            return self._read(name, *file)
        if top in modules._FALLBACK_TOP and top not in _UNREAD_FAKES:
            contents = modules._contents(name, tables.FALLBACK)
            if contents is not None:
                if top in base.RECORDER.packages:
                    self.unknown(f"the module {name}", _NOT_FOUND)
                return Module(name, dict(contents))
        if name == "yaml":
            return Module(name, self._yaml())
        self.unknown(f"the module {name}", _NOT_FOUND)
        return Module(name, {})

    def _of_launch(self, name: str) -> Any:
        contents = modules._contents(name, tables.TABLE)
        if contents is None:
            raise Raised(ModuleNotFoundError(f"No module named '{name}'", name=name))
        copied = {k: list(v) if isinstance(v, list) else v for k, v in contents.items()}
        if "LaunchContext" in copied:
            copied["LaunchContext"] = Context
        if "get_logger" in copied or "launch_config" in copied:
            copied = {k: (lambda *a, **kw: Quiet()) if k.startswith("get_") else v for k, v in copied.items()}
            copied["launch_config"] = Quiet()
        return Module(name, copied)

    def member(self, module: Module, name: str) -> Any:
        """What a module has that is not in its contents."""
        top = module.name.partition(".")[0]
        below = f"{module.name}.{name}"
        if top in modules._TOP:
            if below in tables.TABLE or (modules._contents(below, tables.TABLE) is not None and module.name in FOLDERS):
                return self.module(below, None, 0)
            if top == "launch_testing" and not name.startswith("__"):
                return modules._Anything
            if module.name not in FOLDERS:
                having = modules.module_with(name)
                if having:
                    return tables.TABLE[having][name]
        elif name in ("__name__", "__file__"):
            return module.name if name == "__name__" else module.file
        elif module.file is not None:
            if self._file(below) is not None:
                return self.module(below, None, 0)
        elif top in modules._FALLBACK_TOP and not name.startswith("__"):
            modules._miss(module.name)
            return self._more.setdefault(below, Anything(below))
        elif top not in sys.stdlib_module_names:
            # Of others it is unknown already whether they are there.
            return self.unknown(below, _OF_LIBRARY) if top in ("yaml", "xacro") else Anything(below)
        else:
            return self.unknown(below, _OF_LIBRARY)
        raise Raised(AttributeError(f"module '{module.name}' has no attribute '{name}'"))

    def _file(self, name: str) -> tuple[str, bool] | None:
        """The file of a module of the workspace, and whether it is a package."""
        top, _, rest = name.partition(".")
        for folder in self._folders(top):
            path = posixpath.join(folder, *rest.split(".")) if rest else folder
            init = posixpath.join(path, "__init__.py")
            if self.files.has(init):
                return init, True
            if rest and self.files.has(path + ".py"):
                return path + ".py", False
            if not rest and self.files.has(folder + ".py"):
                return folder + ".py", False
        return None

    def _folders(self, top: str) -> Iterator[str]:
        for folder in self.path:
            if isinstance(folder, str) and not is_unknown(folder) and folder.startswith("/"):
                yield posixpath.join(folder, top)
        share = base.RECORDER.packages.get(top)
        if share is not None:
            yield posixpath.join(share, top)
            yield posixpath.join(share, "src", top)
        for package, path, words in self._installed:
            if words[0].replace("${PROJECT_NAME}", package) == top:
                folder = dict(itertools.pairwise(words[1:])).get("PACKAGE_DIR", top)
                yield posixpath.join(path, folder.replace("${PROJECT_NAME}", package))

    @cached_property
    def _installed(self) -> list[tuple[str, str, list[str]]]:
        """The modules that packages install by CMake."""
        made: list[tuple[str, str, list[str]]] = []
        for package, path in base.RECORDER.packages.items():
            build = posixpath.join(path, "CMakeLists.txt")
            text = self.files.text(build) if self.files.has(build) else ""
            if isinstance(text, str) and len(text) <= _MAX_MODULE:
                words = (found[1].replace('"', "").split() for found in modules._INSTALLED.finditer(text))
                made += [(package, path, each) for each in words if each]
        return made

    def _read(self, name: str, file: str, is_package: bool) -> Module:
        text = self.files.text(file)
        if not isinstance(text, str):
            return Module(name, {})
        tree = parsed(text)
        if tree is None:
            raise NotRead(f"the module {name} does not parse")
        contents: dict[str, Any] = {"__name__": name, "__file__": file}
        module = Module(name, contents, file)
        self._modules[name] = module
        try:
            self.interpreter.run_module(tree, file, contents)
        except Raised:
            del self._modules[name]
            raise
        except NotRead as error:
            if self.files.is_of_workspace(file):
                raise
            self.unknown(f"the module {name}", str(error))
            self._modules[name] = module = Module(name, {})
        return module

    # The standard library

    def _paths(self) -> Module:
        files = self.files
        contents: dict[str, Any] = {name: getattr(posixpath, name) for name in _PURE_PATHS}
        contents.update(
            exists=files.exists,
            lexists=files.exists,
            isfile=files.isfile,
            isdir=files.isdir,
            realpath=files.realpath,
            abspath=files.abspath,
            expanduser=self._expanduser,
            expandvars=self._expandvars,
            relpath=self._relpath,
            sep="/",
            pathsep=":",
        )
        contents["dirname"] = rewritten._dirname
        return Module("os.path", contents)

    def _expanduser(self, path: Any) -> Any:
        return self.files.expanduser(os.fspath(path))

    def _expandvars(self, path: Any) -> Any:
        text = os.fspath(path)
        return self.unknown("expandvars()", _OF_LIBRARY) if "$" in text else text

    def _relpath(self, path: Any, start: Any = None) -> Any:
        if start is None or not str(path).startswith("/") or not str(start).startswith("/"):
            return self.unknown("relpath()", "the folder that it is launched in is not known")
        return posixpath.relpath(path, start)

    def _library(self, name: str) -> dict[str, Any]:
        made = getattr(self, f"_library_{name.replace('.', '_')}", None)
        if made is not None:
            return dict(made())
        return dict(_NATIVE.get(name, {}))

    def _library_os(self) -> dict[str, Any]:
        return {
            **{"path": self.module(_PATHS, None, 0), "environ": self.environment, "getenv": self.environment.get},
            **{"sep": "/", "pathsep": ":", "linesep": "\n", "name": "posix", "curdir": ".", "pardir": ".."},
            **{"fspath": os.fspath, "PathLike": os.PathLike, "listdir": self.files.listdir},
            "makedirs": self._unread_function("os.makedirs"),
        }

    def _library_sys(self) -> dict[str, Any]:
        return {
            **{"path": self.path, "argv": ["ros2", "launch", str(self.job["file"])], "platform": "linux"},
            **{"version_info": tuple(sys.version_info), "maxsize": sys.maxsize, "exit": self._exit},
            **{"stdout": Quiet(), "stderr": Quiet()},
        }

    def _library_pathlib(self) -> dict[str, Any]:
        return {"Path": Path, "PurePath": Path, "PosixPath": Path, "PurePosixPath": Path}

    def _library_json(self) -> dict[str, Any]:
        return {
            "loads": self._json_loads,
            "load": self._json_load,
            "dumps": self._json_dumps,
            "JSONDecodeError": json.JSONDecodeError,
        }

    def _json_loads(self, text: Any, **kwargs: Any) -> Any:
        if is_unknown(text) or isinstance(text, Anything) or kwargs:
            return Anything("json.loads()") if not kwargs else self.unknown("json.loads()", _OF_LIBRARY)
        return json.loads(check_size(text))

    def _json_load(self, file: Any, **kwargs: Any) -> Any:
        return self._json_loads(file.read(), **kwargs)

    def _json_dumps(self, value: Any, **kwargs: Any) -> Any:
        whole(value)
        if set(kwargs) - {"indent", "sort_keys"} or not isinstance(kwargs.get("indent", 2), (int, type(None))):
            return self.unknown("json.dumps()", _OF_LIBRARY)
        if isinstance(kwargs.get("indent"), int) and kwargs["indent"] > 20:
            raise NotRead("a text is too long")
        return json.dumps(value, **kwargs)

    def _library_copy(self) -> dict[str, Any]:
        return {"copy": self._copy, "deepcopy": self._deepcopy}

    @staticmethod
    def _copy(value: Any) -> Any:
        return copy.copy(value) if type(value) in METHODS else _not_read("copy()")

    @staticmethod
    def _deepcopy(value: Any) -> Any:
        whole(value)
        return copy.deepcopy(value) if _is_plain(value, with_fakes=True) else _not_read("deepcopy()")

    def _library_functools(self) -> dict[str, Any]:
        return {
            "partial": self._partial,
            "reduce": self._reduce,
            **dict.fromkeys(("wraps", "lru_cache", "cache", "total_ordering", "cached_property"), _decorates),
        }

    def _partial(self, function: Any, *args: Any, **kwargs: Any) -> Any:
        def called(more: Any, named: Any) -> Any:
            return self.interpreter.call(function, (*args, *more), {**kwargs, **named})

        return Wrapped(called, "partial", "partial")

    def _reduce(self, function: Any, values: Any, *initial: Any) -> Any:
        items = list(self.interpreter.each(values))
        result = initial[0] if initial else items.pop(0)
        for each in items:
            result = self.interpreter.call(function, (result, each), {})
        return result

    def _library_re(self) -> dict[str, Any]:
        functions = {
            name: self._searching(name) for name in ("match", "search", "fullmatch", "findall", "sub", "split")
        }
        return {
            **functions,
            "escape": re.escape,
            "I": re.I,
            "IGNORECASE": re.I,
            "M": re.M,
            "MULTILINE": re.M,
            "S": re.S,
            "DOTALL": re.S,
            "error": re.error,
            "VERBOSE": re.X,
            "X": re.X,
        }

    def _searching(self, name: str) -> Any:
        def called(pattern: Any, *args: Any, **kwargs: Any) -> Any:
            if kwargs or not isinstance(pattern, str) or not all(isinstance(each, (str, int)) for each in args):
                return self.unknown(f"re.{name}()", _OF_LIBRARY)
            if any(map(is_unknown, (pattern, *args))):
                return Anything(f"re.{name}()")
            texts = [each for each in args if isinstance(each, str)]
            numbers = [each for each in args if not isinstance(each, str)]
            flags = int(numbers[-1]) if numbers else 0
            if not is_quick(pattern, texts[-1] if texts else "", flags):
                return self.unknown(f"re.{name}()", "the pattern may take too long")
            if name == "sub" and len(texts) == 2 and (len(texts[1]) + 1) * (len(texts[0]) + 1) > MAX_TEXT:
                raise NotRead("a text is too long")
            return getattr(re, name)(pattern, *args)

        return called

    def _library_logging(self) -> dict[str, Any]:
        quiet = dict.fromkeys(("debug", "info", "warning", "error", "critical", "basicConfig", "exception"), _nothing)
        levels = {"DEBUG": 10, "INFO": 20, "WARNING": 30, "ERROR": 40, "CRITICAL": 50}
        return {**quiet, **levels, "getLogger": lambda *args: Quiet()}

    def _library_warnings(self) -> dict[str, Any]:
        return {"warn": _nothing, "filterwarnings": _nothing, "simplefilter": _nothing}

    def _library_typing(self) -> dict[str, Any]:
        return {**_NATIVE["typing"], "TYPE_CHECKING": False, "cast": lambda kind, value: value}

    def _library_tempfile(self) -> dict[str, Any]:
        return {"NamedTemporaryFile": self.files.temporary}

    def _library_abc(self) -> dict[str, Any]:
        return {"ABC": object, "abstractmethod": _identity, "ABCMeta": type}

    def _library_dataclasses(self) -> dict[str, Any]:
        return {
            "dataclass": lambda *args, **kwargs: dataclass(self.interpreter, *args, **kwargs),
            "field": FIELD,
            "asdict": members,
            "replace": replaced,
        }

    def _library___future__(self) -> dict[str, Any]:
        return {"annotations": None}

    def _yaml(self) -> dict[str, Any]:
        return {
            **dict.fromkeys(("SafeLoader", "CSafeLoader"), self._safe_loader),
            **dict.fromkeys(("FullLoader", "Loader", "UnsafeLoader"), self._loader("Loader")),
            "safe_load": self.load_yaml,
            "load": lambda stream, Loader=None: self._load_yaml_by(Loader, stream),  # noqa: N803
            "full_load": lambda stream: self._load_yaml_by(None, stream),
            "YAMLError": yaml.YAMLError,
            "dump": self.dump_yaml,
            "safe_dump": self.dump_yaml,
        }

    def _loader(self, name: str) -> Module:
        return Module(f"yaml.{name}", dict.fromkeys(_OF_TAGS, self._read_tags))

    def _read_tags(self, *_args: Any) -> None:
        """What the program makes of a tag of its own."""
        self._has_own_tags = True

    def load_yaml(self, stream: Any) -> Any:
        """`yaml.safe_load`."""
        text = stream.read() if hasattr(stream, "read") else stream
        if isinstance(text, Anything) or is_unknown(text):
            return Anything("yaml.safe_load()")
        if not isinstance(text, str) or len(text) > _MAX_YAML or text.count("*") > 2000:
            return self.unknown("yaml.safe_load()", "the text is too long")
        self.interpreter.step(len(text) // 20)
        if _is_deep(text):
            return self.unknown("yaml.safe_load()", "the text is too deep")
        try:
            value = yaml.load(text, Loader=_Loader)  # noqa: S506 - a safe one
        except yaml.constructor.ConstructorError:
            if self._has_own_tags:
                return self.unknown("yaml.safe_load()", "the program says what its tags are")
            raise
        self.interpreter.step(whole(value))
        return value

    def _load_yaml_by(self, loader: Any, stream: Any) -> Any:
        """`yaml.load`. What a loader that is not safe makes of a tag only a run knows."""
        try:
            return self.load_yaml(stream)
        except yaml.constructor.ConstructorError:
            if loader is self._safe_loader:
                raise
            return self.unknown("yaml.load()", "it makes objects of Python")

    def dump_yaml(self, data: Any, stream: Any = None, **kwargs: Any) -> Any:
        """`yaml.dump`."""
        whole(data)
        if not _is_plain(data) or set(kwargs) - {"default_flow_style", "sort_keys", "allow_unicode"}:
            return self.unknown("yaml.dump()", _OF_LIBRARY)
        text = yaml.dump(data, Dumper=_Dumper, **kwargs)
        if stream is None:
            return text
        stream.write(text)
        return None


def _decorates(*args: Any, **kwargs: Any) -> Any:
    return args[0] if len(args) == 1 and not kwargs and isinstance(args[0], (Function, type)) else _identity


def _not_read(what: str) -> Any:
    raise NotRead(what)


def _is_hashable(value: Any) -> bool:
    try:
        hash(value)
    except Exception:
        return False
    return True


def _is_plain(value: Any, *, with_fakes: bool = False) -> bool:
    """Whether it is made of plain values alone, or of those and what launch has."""
    if isinstance(value, dict):
        return all(_is_plain(each, with_fakes=with_fakes) for pair in value.items() for each in pair)
    if isinstance(value, (list, tuple, set)):
        return all(_is_plain(each, with_fakes=with_fakes) for each in value)
    if with_fakes and is_fake(type(value)):
        return True
    return isinstance(value, (str, int, float, bool, type(None), Anything))


def is_quick(pattern: str, text: str, flags: int) -> bool:
    """Whether a search ends soon, whatever the text is: by the number of ways in which the pattern may fit."""
    if len(pattern) > 500 or len(text) > 20_000:
        return False
    if flags & re.VERBOSE or "(?" in pattern.replace("(?:", "").replace("(?P<", ""):
        return False
    try:
        tree = _PARSER.parse(pattern)
    except (re.error, OverflowError):
        return True  # it raises
    except RecursionError:
        return False
    ways = _ways(tree, max(len(text), 2))
    return ways is not None and (len(text) + 1) * ways <= _MAX_PATTERN_WORK


_PARSER: Any = importlib.import_module("re._parser" if sys.version_info >= (3, 11) else "sre_parse")
_ONE_WAY = frozenset(("LITERAL", "NOT_LITERAL", "IN", "ANY", "AT", "CATEGORY", "RANGE"))


def _ways(tree: Any, length: int) -> int | None:
    """In how many ways a pattern fits a text of so many characters; None where nobody knows."""
    ways = 1
    for operation, argument in tree:
        name = str(operation)
        if name in ("MAX_REPEAT", "MIN_REPEAT"):
            least, most, inner = argument
            within = _ways(inner, length)
            count = min(int(most), length + 1) - min(int(least), length + 1) + 1
            if within is None or (within > 1 and int(most) > 1):
                return None
            ways *= max(count, 1) * within
        elif name == "SUBPATTERN":
            within = _ways(argument[3], length)
            if within is None:
                return None
            ways *= within
        elif name == "BRANCH":
            all_within = [_ways(each, length) for each in argument[1]]
            if None in all_within:
                return None
            ways *= sum(each or 0 for each in all_within)
        elif name not in _ONE_WAY:
            return None
        if ways > _MAX_PATTERN_WORK:
            return None
    return ways


def _is_deep(text: str) -> bool:
    """Whether a text of YAML may have more within each other than Python can bear."""
    depth, most = 0, 0
    for each in re.findall(r"[][{}]", text):
        depth += 1 if each in "[{" else -1
        most = max(most, depth)
    return (
        most > MAX_DEPTH or re.search(r"(?:[-?:][ \t]+){60}", text) is not None or _DIGITS_AND.search(text) is not None
    )


_DIGITS_AND = re.compile(r"[0-9_:]{400}")
"""A number that takes long to read."""


class _Dumper(yaml.Dumper):
    """As a run writes texts that are not known."""


_Dumper.add_representer(UnknownText, lambda dumper, text: dumper.represent_str(str.__str__(text)))
_Dumper.add_representer(Anything, lambda dumper, value: dumper.represent_str(str.__str__(str(value))))


class _Loader(_LOADER):  # type: ignore[misc]
    """`yaml.SafeLoader`, with a bound of what merged mappings have."""

    def flatten_mapping(self, node: Any) -> None:
        left = MAX_ITEMS
        for key, value in node.value:
            if key.tag == "tag:yaml.org,2002:merge":
                for each in value.value if isinstance(value, yaml.SequenceNode) else [value]:
                    if isinstance(each, yaml.MappingNode):
                        self.flatten_mapping(each)
                        left -= len(each.value)
        if left < len(node.value):
            raise NotRead("a mapping is too large")
        super().flatten_mapping(node)
