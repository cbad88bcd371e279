"""The modules of `launch`, `launch_ros` and the like that a launch file imports, and the Python modules of packages."""

from __future__ import annotations

import importlib
import importlib.abc
import importlib.machinery
import importlib.util
import os
import re
import sys
import types
from typing import Any, Optional

from ..anything import member
from ..missing_modules import MissingModules
from .base import RECORDER, Action
from .tables import FALLBACK, FOLDERS, SIBLINGS, TABLE

_TOP = {name.partition(".")[0] for name in TABLE}
_FALLBACK_TOP = {name.partition(".")[0] for name in FALLBACK}


def _snake(name: str) -> str:
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()


def _contents(fullname: str, table: dict[str, dict[str, Any]]) -> Optional[dict[str, Any]]:
    """What a module has: `launch.actions.node` what `launch.actions` has."""
    found = table.get(fullname)
    if found is None:
        parent, _, name = fullname.rpartition(".")
        above = table.get(parent)
        if above and (name in SIBLINGS.get(parent, ()) or any(_snake(each) == name for each in above)):
            return above
    return found


def module_with(name: str) -> str:
    """The module of launch that has a name; "" where there is none."""
    having = [module for module, names in TABLE.items() if name in names]
    return min(having, key=lambda module: (module.count("."), module), default="")


class _Anything(Action):
    """Whatever tests are made of: it starts no node."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__()

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return lambda *args, **kwargs: None

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        """A decorator leaves what it is given as it is."""
        return args[0] if args else self

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "test"


def _anything(name: str) -> Any:
    if name.startswith("__"):
        raise AttributeError(name)
    below = f"launch_testing.{name}"
    return importlib.import_module(below) if below in TABLE else _Anything


def _below(module: str) -> Any:
    """The modules of a package, which the real one imports all: `launch.substitution`."""

    def attribute(name: str) -> Any:
        if name.startswith("__") or _contents(f"{module}.{name}", TABLE) is None:
            raise AttributeError(f"module '{module}' has no attribute '{name}'")
        return importlib.import_module(f"{module}.{name}")

    return attribute


def _imported(name: str) -> Any:
    """What a module that is no folder may have: it imports what others define, and which of it is not known."""
    having = module_with(name)
    if not having:
        raise AttributeError(name)
    return TABLE[having][name]


def _more_of_launch(module: str) -> Any:
    return _below(module) if module in FOLDERS else _imported


def _more(module: str) -> Any:
    """What a module has that is not here, and of which not all is known."""
    made: dict[str, Any] = {}

    def attribute(name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        _miss(module)
        return member(made, module, name)

    return attribute


def _stands_in(name: str) -> bool:
    """Whether a module is of a package that is not here, and of which we have some modules; or one that is compiled
    when its package, of which there is the source alone, is built."""
    top = name.partition(".")[0]
    spec = getattr(sys.modules.get(top), "__spec__", None)
    origin = getattr(spec, "origin", None)
    if origin and "-packages" + os.sep not in origin and _is_compiled(name.rpartition(".")[2], origin):
        return True
    return top in _FALLBACK_TOP and isinstance(getattr(spec, "loader", None), _Loader)


def _is_compiled(name: str, origin: str) -> bool:
    """Whether a module of a package with the source `origin` is one that building it compiles."""
    if name.startswith("_"):
        return True
    folder = os.path.dirname(origin)
    while not os.path.isfile(os.path.join(folder, "package.xml")) and folder != os.path.dirname(folder):
        folder = os.path.dirname(folder)
    return any(re.search(rule % re.escape(name), _text_of(folder, file)) for file, rule in _COMPILES.items())


def _text_of(folder: str, name: str) -> str:
    try:
        with open(os.path.join(folder, name), encoding="utf-8", errors="replace") as file:
            return re.sub(r"#.*", "", file.read())
    except OSError:
        return ""


def _miss(name: str, *_: Any) -> None:
    top = name.partition(".")[0]
    RECORDER.miss("module", top if top in _FALLBACK_TOP else name)


class _Loader(importlib.abc.Loader):
    def __init__(self, contents: dict[str, Any], *, stands_in: bool) -> None:
        self._contents, self._stands_in = contents, stands_in

    def create_module(self, spec: Any) -> Any:
        module = types.ModuleType(spec.name)
        module.__getattr__ = _more_of_launch(spec.name)  # type: ignore[method-assign]
        if spec.name.partition(".")[0] == "launch_testing":
            module.__getattr__ = _anything  # type: ignore[method-assign]
        if self._stands_in:
            module.__getattr__ = _more(spec.name)  # type: ignore[method-assign]
        vars(module).update(self._contents)
        return module

    def exec_module(self, module: Any) -> None:
        return None


class _Finder(importlib.abc.MetaPathFinder):
    def __init__(self, table: dict[str, dict[str, Any]]) -> None:
        self._table = table

    def find_spec(self, fullname: str, path: Any = None, target: Any = None) -> Any:
        contents = _contents(fullname, self._table)
        if contents is None:
            if fullname.partition(".")[0] in _TOP and self._table is TABLE:
                raise ModuleNotFoundError(f"No module named '{fullname}'", name=fullname)
            return None
        loader = _Loader(contents, stands_in=self._table is FALLBACK)
        spec = importlib.machinery.ModuleSpec(fullname, loader, is_package=True)
        spec.submodule_search_locations = []
        return spec


_COMPILES = {
    "CMakeLists.txt": r"(?i)add_(?:module|library)\s*\(\s*%s\b",
    "setup.py": r"Extension\w*\s*\(\s*(?:name\s*=\s*)?['\"][\w.]*\b%s['\"]",
}
"""Where a package says which modules it compiles, and how."""
_INSTALLED = re.compile(r"ament_python_install_package\s*\(([^()]*)\)")


class _PackageFinder(importlib.abc.MetaPathFinder):
    """Python modules of ROS packages that are only source."""

    def find_spec(self, fullname: str, path: Any = None, target: Any = None) -> Any:
        for folder in self._folders(fullname) if path is None else ():
            init = os.path.join(folder, "__init__.py")
            if os.path.isfile(init):
                return importlib.util.spec_from_file_location(fullname, init, submodule_search_locations=[folder])
        return None

    def _folders(self, name: str) -> Any:
        share = RECORDER.packages.get(name)
        if share is not None:
            yield os.path.join(share, name)
            yield os.path.join(share, "src", name)
        for package, share in RECORDER.packages.items():
            for words in self._installed(share):
                if words and words[0].replace("${PROJECT_NAME}", package) == name:
                    folder = dict(zip(words[1:], words[2:])).get("PACKAGE_DIR", name)
                    yield os.path.join(share, folder.replace("${PROJECT_NAME}", package))

    @staticmethod
    def _installed(share: str) -> Any:
        """What each `ament_python_install_package` of a package is given."""
        for found in _INSTALLED.finditer(_text_of(share, "CMakeLists.txt")):
            yield found[1].replace('"', "").split()


class _OwnXacro(importlib.abc.MetaPathFinder):
    """The module that the analysis has, where the launch file's Python has none."""

    def find_spec(self, fullname: str, path: Any = None, target: Any = None) -> Any:
        if fullname != "xacro" or not RECORDER.own_xacro:
            return None
        folder = RECORDER.own_xacro
        init = os.path.join(folder, "__init__.py")
        return importlib.util.spec_from_file_location(fullname, init, submodule_search_locations=[folder])


def install() -> None:
    """From now on these modules are ours."""
    sys.meta_path.insert(0, _Finder(TABLE))
    missing = MissingModules(_miss, _stands_in)
    found: list[Any] = [_PackageFinder(), _Finder(FALLBACK), _OwnXacro(), missing]
    sys.meta_path.extend(found)
    # `import launch; launch.actions.Node`: launch itself imports these.
    for name in ("actions", "conditions", "descriptions", "events", "frontend", "logging", "substitutions"):
        TABLE["launch"][name] = _module(f"launch.{name}")
    for name in ("event_handlers", "launch_description_sources", "utilities", "some_substitutions_type"):
        TABLE["launch"][name] = _module(f"launch.{name}")
    for name in ("actions", "descriptions", "event_handlers", "events", "substitutions", "parameter_descriptions"):
        TABLE["launch_ros"][name] = _module(f"launch_ros.{name}")
    TABLE["launch_ros"]["ros_adapters"] = _module("launch_ros.ros_adapters")
    TABLE["ament_index_python"]["packages"] = _module("ament_index_python.packages")
    for name in ("launch_xml", "launch_yaml"):
        TABLE[name]["launch_description_sources"] = _module(f"{name}.launch_description_sources")
    # `ros2 launch` has imported these when it comes to a launch file.
    for name in ("launch", "launch_ros", "launch_xml", "launch_yaml", "ament_index_python"):
        importlib.import_module(name)


def _module(name: str) -> Any:
    module = types.ModuleType(name)
    module.__getattr__ = _more_of_launch(name)  # type: ignore[method-assign]
    vars(module).update(TABLE[name])
    module.__path__ = []
    module.__spec__ = importlib.machinery.ModuleSpec(name, None, is_package=True)
    sys.modules[name] = module
    for below in TABLE:
        if below.rpartition(".")[0] == name:
            setattr(module, below.rpartition(".")[2], _module(below))
    return module
