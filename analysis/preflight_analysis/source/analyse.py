"""The source of a node to its possible endpoints and parameters, remembered until a file or a parameter changes."""

from __future__ import annotations

import ast
import os
import re
import shlex
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import Place
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, load_plain
from preflight_analysis.environment.cmake import read_build
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.source.config_params import ConfigParam, config_params
from preflight_analysis.source.known_params import KnownParams, LaunchParams
from preflight_analysis.source.python_interpreter import interpret
from preflight_analysis.source.python_text import parse
from preflight_analysis.source.python_values import UNKNOWN
from preflight_analysis.source.rclpy_calls import RclpyCalls
from preflight_analysis.source.rospy_calls import RospyCalls
from preflight_analysis.tracing.interface import Endpoint, MadeNode, ParamUse

if TYPE_CHECKING:
    from preflight_analysis.source.cpp_analysis import CppAnalysis

MAX_MODULES = 30
"""How many modules of one program are followed."""
_MAX_REMEMBERED = 4096
_MAX_TREES = 256
_RELAY = re.compile(r"^python_script = '([^'\n]+)'$", re.MULTILINE)
"""What catkin writes in the place of a script in a devel space."""

_SCALARS = (str, int, float, bool)


class Texts(Protocol):
    """What `workspace.sources.Sources` offers here."""

    def digest(self, path: str) -> str:
        """Names the content as it is now; "" where there is no such file."""

    def text(self, path: str) -> Document | Unreadable:
        """What the file holds."""


@dataclass(frozen=True, slots=True)
class SourceInterface:
    """What the source of a node says that it may do."""

    endpoints: tuple[Endpoint, ...] = ()
    params: tuple[ParamUse, ...] = ()
    nodes: tuple[MadeNode, ...] = ()
    """ROS 2: those that the process makes; empty where it is not known which."""


_NOTHING = SourceInterface()


@dataclass(slots=True)
class _Remembered:
    files: Mapping[str, str]
    asked: Mapping[str, Any]
    asked_of: int
    """The number of the last parameters that were seen to answer so."""
    found: SourceInterface


SourceKey = tuple[str | None, str, str, str, str, tuple[tuple[str, str], ...]]


def source_key(node: LaunchNode) -> SourceKey:
    """What the source of a node is read with: the file first, and last the remaps."""
    path = node.resolved.path or next(iter(node.resolved.not_executable), None)
    remaps = tuple((remap.source, remap.target) for remap in node.remaps)
    return path, node.package, node.executable, node.name, node.args, remaps


class SourceAnalysis:
    """Reads the sources of nodes of one environment. Thread-safe; runs nothing and raises nothing."""

    def __init__(self, environment: Environment, texts: Texts) -> None:
        self._environment = environment
        self._texts = texts
        self._lock = threading.Lock()
        self._remembered: dict[SourceKey, _Remembered] = {}
        self._trees: dict[str, ast.Module | None] = {}

    def read(
        self, node: LaunchNode, params: LaunchParams, digests: dict[str, str] | None = None
    ) -> SourceInterface | None:
        """What the source of the node says, None if there is none that can be read. For the nodes of one launch
        `digests` keeps those of files that were looked at, so that the disk is asked once for each."""
        return self.read_as(source_key(node), node, params, {} if digests is None else digests)

    def read_as(
        self, key: SourceKey, node: LaunchNode, params: LaunchParams, digests: dict[str, str]
    ) -> SourceInterface | None:
        """As `read`, where the `source_key` of the node is at hand."""
        known = self._remembered.get(key)
        if known is None or not self._is_valid(known, params, digests):
            known = self._analyse(key[0], node, key[-1], params)
            with self._lock:
                self._remembered[key] = known
                if len(self._remembered) > _MAX_REMEMBERED:
                    del self._remembered[next(iter(self._remembered))]
        return known.found if known.found is not _NOTHING else None

    def _is_valid(self, known: _Remembered, params: LaunchParams, digests: dict[str, str]) -> bool:
        for path, digest in known.files.items():
            if path not in digests:
                digests[path] = self._texts.digest(path)
            if digests[path] != digest:
                return False
        alike = params.answer_alike(known.asked_of, known.asked)
        if not alike and any(params.look(name) != value for name, value in known.asked.items()):
            return False
        known.asked_of = params.number
        return True

    def _analyse(
        self, path: str | None, node: LaunchNode, remaps: tuple[tuple[str, str], ...], params: LaunchParams
    ) -> _Remembered:
        try:
            args = shlex.split(node.args)
        except ValueError:
            args = node.args.split()
        asked = KnownParams(params, _private_params(args, node.name))
        resolved = names.resolve_remaps(remaps, node.name)
        files: dict[str, str] = {}

        def text(name: str) -> tuple[str, str] | None:
            found = self.text(name)
            files[name] = found[1] if found is not None else self._texts.digest(name)
            return found

        def plain(name: str) -> str | None:
            found = text(name)
            return found[0] if found is not None else None

        def config(package: str, name: str) -> tuple[ConfigParam, ...]:
            having = self._environment.packages.get(package)
            return config_params(having.share, name, plain) if having is not None else ()

        script = self._installed_script(node, plain) if path is None else None
        program = _Program(self, script or path, node, files)
        main = program.main()
        if main is not None:
            file, tree = main
            if node.resolved.entry_point is not None or self._generation(node) == 2:
                entry = (node.resolved.entry_point or "").partition(":")[2] or None
                rclpy = RclpyCalls(node.name, (file, *args), asked)
                interpret(file, tree, program.load, rclpy, entry)
                found = rclpy.collected
            else:
                calls = RospyCalls(node.name, resolved, (file, *args), asked, self._has_type, config)
                interpret(file, tree, program.load, calls)
                found = calls.collected
        elif self._generation(node) == 2:
            found = self._cpp.read_ros2((node.name, node.package, node.executable), args, asked, text, node.plugin)
        else:
            found = self._cpp.read((node.name, node.package, node.executable), args, resolved, asked, text, config)
        said = SourceInterface(found.endpoints, found.params, found.nodes)
        return _Remembered(files, asked.asked, params.number, said if said != _NOTHING else _NOTHING)

    def _generation(self, node: LaunchNode) -> int:
        package = self._environment.packages.get(node.package)
        return package.generation if package is not None else 1

    def _installed_script(self, node: LaunchNode, read: Callable[[str], str | None]) -> str | None:
        """The script that an installation of its package gives the node's name."""
        package = self._environment.packages.get(node.package)
        if package is None:
            return None
        made = read_build(package.share, package.name, read).programs.get(node.executable)
        return made.path if made is not None else None

    @cached_property
    def _cpp(self) -> CppAnalysis:
        # Loads the parser, which who has no C++ nodes does without.
        from preflight_analysis.source.cpp_analysis import CppAnalysis  # noqa: PLC0415

        return CppAnalysis(self._environment.packages, self._has_type)

    def component(self, package: str, cls: str) -> Place | None:
        """Where the C++ class of a component is defined, None where its source is not there."""
        return self._cpp.component(package, cls, self.text)

    def text(self, path: str) -> tuple[str, str] | None:
        """What a file holds, with its digest."""
        digest = self._texts.digest(path)
        found = self._texts.text(path) if digest else None
        return (found.text, digest) if isinstance(found, Document) else None

    def tree(self, path: str) -> tuple[ast.Module | None, str]:
        """The syntax tree of a file, and the digest of what it was made from."""
        found = self.text(path)
        if found is None:
            return None, self._texts.digest(path)
        text, digest = found
        with self._lock:
            if digest in self._trees:
                return self._trees[digest], digest
        tree = parse(text)
        with self._lock:
            self._trees[digest] = tree
            if len(self._trees) > _MAX_TREES:
                del self._trees[next(iter(self._trees))]
        return tree, digest

    def package_source(self, name: str) -> str | None:
        """The folder with the Python modules of a package by catkin's convention."""
        package = self._environment.packages.get(name)
        if package is None:
            return None
        return package.share if package.is_ament else os.path.join(package.share, "src")

    def _has_type(self, package: str, kind: str, name: str) -> bool:
        found = self._environment.packages.get(package)
        return found is not None and os.path.isfile(os.path.join(found.share, kind, f"{name}.{kind}"))


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
    """The files of one program in Python. `files` gets the digest of each that was looked at."""

    def __init__(self, analysis: SourceAnalysis, path: str | None, node: LaunchNode, files: dict[str, str]) -> None:
        self._analysis = analysis
        self._path = path or ""
        self._package = node.package
        self._loaded = 0
        self.files = files

    def main(self) -> tuple[str, ast.Module] | None:
        """The main file with its tree, None if it is not in Python."""
        path = self._path
        found = self._analysis.text(path) if path else None
        if found is None:
            return None
        text, self.files[path] = found
        first = text.partition("\n")[0]
        if not path.endswith(".py") and not (first.startswith("#!") and "python" in first):
            return None
        relay = _RELAY.search(text)
        if relay is not None and "exec(compile(" in text:
            path = relay[1]
        tree, self.files[path] = self._analysis.tree(path)
        self._path = path
        return (path, tree) if tree is not None else None

    def load(self, name: str, level: int, importer: str) -> tuple[str, ast.Module] | None:
        """The module that an import means, if it is of a package in source form. Implements `python_modules.Load`."""
        for folder in self._folders(name, level, importer):
            base = os.path.join(folder, *name.split(".")) if name else folder
            for path in (f"{base}.py", os.path.join(base, "__init__.py")):
                if os.path.isfile(path):
                    if self._loaded >= MAX_MODULES:
                        return None
                    self._loaded += 1
                    tree, self.files[path] = self._analysis.tree(path)
                    return (path, tree) if tree is not None else None
        return None

    def _folders(self, name: str, level: int, importer: str) -> list[str]:
        if level:
            folder = os.path.dirname(importer)
            for _ in range(level - 1):
                folder = os.path.dirname(folder)
            return [folder]
        folders = [os.path.dirname(self._path)]
        for package in dict.fromkeys((self._package, name.partition(".")[0])):
            if (source := self._analysis.package_source(package)) is not None:
                folders.append(source)
        return folders
