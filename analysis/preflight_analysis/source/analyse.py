"""The source of a node to its possible endpoints and parameters."""

from __future__ import annotations

import ast
import os
import re
import shlex
from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.span import Place
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, load_plain
from preflight_analysis.environment.installed_paths import cmake_build
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.source.collector import Collector
from preflight_analysis.source.config_params import ConfigParam, config_params
from preflight_analysis.source.known_params import KnownParams, LaunchParams
from preflight_analysis.source.python_text import parse
from preflight_analysis.source.python_values import UNKNOWN
from preflight_analysis.tracing.interface import Endpoint, Frame, FrameUse, MadeNode, ParamUse, Role

if TYPE_CHECKING:
    from preflight_analysis.source.cpp_analysis import CppAnalysis

MAX_MODULES = 30
"""How many modules of one program are followed."""
_MAX_DEPTH = 10
_MAX_TREES = 256
_RELAY = re.compile(r"^python_script = '([^'\n]+)'$", re.MULTILINE)
"""What catkin writes in the place of a script in a devel space."""

_SCALARS = (str, int, float, bool)


@dataclass(frozen=True, slots=True)
class SourceInterface:
    """What the source of a node says that it may do."""

    endpoints: tuple[Endpoint, ...] = ()
    params: tuple[ParamUse, ...] = ()
    nodes: tuple[MadeNode, ...] = ()
    """ROS 2: those that the process makes; empty where it is not known which."""
    whole: bool = False
    """Whether nothing is known of that was left out: each name is computed, and no library of which nothing is known
    was given the node."""
    frames: tuple[Frame, ...] = ()
    """The transforms that it broadcasts; a frame of them that is not known is empty."""
    frame_uses: tuple[FrameUse, ...] = ()
    """The frames that it asks for or puts into messages."""
    unnamed: tuple[tuple[Role, str | None], ...] = ()
    """Role and type of the ends that it makes beside these, under names that are not known."""
    transitions: tuple[str, ...] = ()
    """As of an `Interface`."""


_NOTHING = SourceInterface()


class SourceKey(NamedTuple):
    """All of a node that decides how its source is read, beside the parameters that it asks for."""

    path: str | None
    entry_point: str | None
    package: str
    executable: str
    plugin: str | None
    name: str
    args: str
    remaps: tuple[tuple[str, str], ...]


def source_key(node: LaunchNode) -> SourceKey:
    """What the source of a node is read with."""
    path = node.resolved.path or next(iter(node.resolved.not_executable), None)
    remaps = tuple((remap.source, remap.target) for remap in node.remaps)
    entry_point, plugin = node.resolved.entry_point, node.plugin
    return SourceKey(path, entry_point, node.package, node.executable, plugin, node.name, node.args, remaps)


class SourceAnalysis:
    """Reads the sources of nodes of one environment. Thread-safe; runs nothing and raises nothing."""

    def __init__(self, environment: Environment, disk: Disk) -> None:
        self._environment = environment
        self._disk = disk

    def read(self, node: LaunchNode, params: LaunchParams) -> SourceInterface | None:
        """What the source of the node says, None if there is none that can be read."""
        return self.read_each([source_key(node)], params)[0]

    def read_each(self, keys: Iterable[SourceKey], params: LaunchParams) -> list[SourceInterface | None]:
        """As `read` for nodes of which the `source_key` is at hand."""
        found = _read.answered_each(self._disk.db, params, [(self._environment, key) for key in keys])
        return [each if each is not _NOTHING else None for each in found]

    def controllers(self, package: str) -> tuple[str, ...]:
        """The controllers of ros2_control that a package exports; as the `plugin` of a `SourceKey` they are read."""
        return _cpp(self._environment, self._disk).controllers(package)

    def plugins(self, package: str) -> tuple[str, ...]:
        """The plugins that a package exports and `plugin` can read."""
        return _cpp(self._environment, self._disk).plugins(package)

    def exported(self, package: str) -> tuple[str, ...]:
        """All plugins that a package exports, of whatever base class."""
        return _cpp(self._environment, self._disk).exported(package)

    def plugin(self, name: str, given: str, params: LaunchParams, package: str | None = None) -> SourceInterface | None:
        """What a plugin (`package::Name`) makes in the node that loads it, and declares there, as `given` mostly
        (`~given.speed`). `package`: the one that has it, where that is known; `params` are those of `/node`."""
        found = _read_plugin.answered(self._disk.db, params, self._environment, name, given, package)
        return found if found is not _NOTHING else None

    def component(self, package: str, cls: str) -> Place | None:
        """Where the C++ class of a component is defined, None where its source is not there."""
        return _cpp(self._environment, self._disk).component(package, cls)

    def tree(self, path: str) -> ast.Module | None:
        """The syntax tree of a file in Python; None where it has none."""
        return _python_tree(self._disk.db, path)


@query
def _read(db: Database, environment: Environment, node: SourceKey) -> SourceInterface:
    disk = Disk(db)
    try:
        args = shlex.split(node.args)
    except ValueError:
        args = node.args.split()
    params = KnownParams(db.ask, _private_params(args, node.name))
    resolved = names.resolve_remaps(node.remaps, node.name)
    having = environment.packages.get(node.package)
    is_ament = having is not None and having.is_ament

    def config(package: str, name: str) -> tuple[ConfigParam, ...]:
        owner = environment.packages.get(package)
        return config_params(owner.share, name, disk.content) if owner is not None else ()

    script = _installed_script(disk, having, node) if node.path is None and having is not None else None
    program = _Program(disk, environment, script or node.path, node.package)
    main = program.main()
    found: Collector
    if main is not None:
        # Who runs all nodes starts faster without.
        from preflight_analysis.source.python_interpreter import interpret  # noqa: PLC0415
        from preflight_analysis.source.rclpy_calls import RclpyCalls  # noqa: PLC0415
        from preflight_analysis.source.rospy_calls import RospyCalls  # noqa: PLC0415

        file, tree = main
        if node.entry_point is not None or is_ament:
            entry = (node.entry_point or "").partition(":")[2] or None
            rclpy = RclpyCalls(node.name, (file, *args), params)
            interpret(file, tree, program.load, rclpy, entry)
            found = rclpy.collected
        else:
            has_type = partial(_has_type, disk, environment)
            calls = RospyCalls(node.name, resolved, (file, *args), params, has_type, config)
            interpret(file, tree, program.load, calls)
            found = calls.collected
    elif is_ament:
        cpp, named = _cpp(environment, disk), (node.name, node.package, node.executable)
        found = cpp.read_ros2(named, args, params, node.plugin)
    else:
        cpp, named = _cpp(environment, disk), (node.name, node.package, node.executable)
        found = cpp.read(named, args, resolved, params, config)
    if main is not None and found.frames:
        program.expect_broadcasts(found)
    said = SourceInterface(found.endpoints, found.params, found.nodes, frames=found.frames, frame_uses=found.frame_uses)
    said = replace(said, transitions=found.transitions)
    return replace(said, whole=found.whole, unnamed=found.unnamed) if said != _NOTHING else _NOTHING


@query
def _read_plugin(db: Database, environment: Environment, name: str, given: str, package: str | None) -> SourceInterface:
    found = _cpp(environment, Disk(db)).read_plugin(name, package, given, KnownParams(db.ask, {}))
    return SourceInterface(found.endpoints, found.params, whole=found.whole) if found is not None else _NOTHING


@query(limit=_MAX_TREES)
def _python_tree(db: Database, path: str) -> ast.Module | None:
    text = Disk(db).content(path)
    return parse(text) if text is not None else None


def _cpp(environment: Environment, disk: Disk) -> CppAnalysis:
    # Loads the parser, which who has no C++ nodes does without.
    from preflight_analysis.source.cpp_analysis import CppAnalysis  # noqa: PLC0415

    return CppAnalysis(environment.packages, disk, partial(_has_type, disk, environment))


def _installed_script(disk: Disk, package: Package, node: SourceKey) -> str | None:
    """The script that an installation of its package gives the node's name."""
    made = cmake_build(disk, package).programs.get(node.executable)
    return made.path if made is not None else None


def _has_type(disk: Disk, environment: Environment, package: str, kind: str, name: str) -> bool:
    found = environment.packages.get(package)
    return found is not None and disk.is_file(os.path.join(found.share, kind, f"{name}.{kind}"))


def _private_params(args: Sequence[str], node: str) -> dict[str, Any]:
    """What `_name:=value` among the arguments sets, values as YAML as rospy takes them."""
    found: dict[str, Any] = {}
    for arg in args:
        name, mark, text = arg.partition(":=")
        if mark and name.startswith("_") and not name.startswith("__"):
            try:
                value = load_plain(text)
            except CONSTRUCTION_ERRORS:
                value = text
            found[names.resolve(f"~{name[1:]}", node)] = value if isinstance(value, _SCALARS) else UNKNOWN
    return found


class _Program:
    """The files of one program in Python."""

    def __init__(self, disk: Disk, environment: Environment, path: str | None, package: str) -> None:
        self._disk = disk
        self._environment = environment
        self._path = path or ""
        self._package = package
        self._loaded: set[str] = set()

    def main(self) -> tuple[str, ast.Module] | None:
        """The main file with its tree, None if it is not in Python."""
        path = self._path
        text = self._disk.content(path) if path else None
        if text is None:
            return None
        first = text.partition("\n")[0]
        if not path.endswith(".py") and not (first.startswith("#!") and "python" in first):
            return None
        relay = _RELAY.search(text)
        if relay is not None and "exec(compile(" in text:
            path = relay[1]
        tree = _python_tree(self._disk.db, path)
        self._path = path
        return (path, tree) if tree is not None else None

    def expect_broadcasts(self, collected: Collector) -> None:
        """Note the transforms that the program broadcasts somewhere."""
        from preflight_analysis.source.python_frames import broadcasts_in  # noqa: PLC0415 - as those of `_read`

        for path in (self._path, *self._loaded):
            tree = _python_tree(self._disk.db, path)
            for line in broadcasts_in(tree) if tree is not None else ():
                collected.expect_broadcast(path, line, line)

    def load(self, name: str, level: int, importer: str) -> tuple[str, ast.Module] | None:
        """The module that an import means, if it is of a package in source form. Implements `python_modules.Load`."""
        for folder in self._folders(name, level, importer):
            base = os.path.join(folder, *name.split(".")) if name else folder
            for path in (f"{base}.py", os.path.join(base, "__init__.py")):
                if self._disk.is_file(path):
                    if path not in self._loaded and len(self._loaded) >= MAX_MODULES:
                        return None
                    self._loaded.add(path)
                    tree = _python_tree(self._disk.db, path)
                    return (path, tree) if tree is not None else None
        return None

    def _folders(self, name: str, level: int, importer: str) -> list[str]:
        if level:
            folder = os.path.dirname(importer)
            for _ in range(level - 1):
                folder = os.path.dirname(folder)
            return [folder]
        folders = [os.path.dirname(self._path), *self._root()]
        for package in dict.fromkeys((self._package, name.partition(".")[0])):
            folders += self._sources_of(package)
        return folders

    def _root(self) -> list[str]:
        """The folder that Python finds the package in which the main file is a module."""
        folder = os.path.dirname(self._path)
        depth = 0
        while depth < _MAX_DEPTH and self._disk.is_file(os.path.join(folder, "__init__.py")):
            folder, depth = os.path.dirname(folder), depth + 1
        return [folder] if depth else []

    def _sources_of(self, name: str) -> list[str]:
        """The folders with the Python modules of a package, by convention and by what its build installs."""
        package = self._environment.packages.get(name)
        if package is None:
            return []
        if not package.is_ament:
            return [os.path.join(package.share, "src")]
        installed = cmake_build(self._disk, package).python_packages if package.build_type != "ament_python" else {}
        return [package.share, *(os.path.dirname(at) for name, at in installed.items() if os.path.basename(at) == name)]
