"""The files of a C++ program: which there are says the package's `CMakeLists.txt`, which they include they themselves.

Headers of packages in source form are followed, and with a header of another package the source that goes with it.
"""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import PurePath
from typing import NamedTuple

from lxml import etree

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.build import LISTS, Build, Target
from preflight_analysis.environment.installed_paths import cmake_build
from preflight_analysis.environment.model import Package
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.source.cpp_program import CppProgram
from preflight_analysis.source.cpp_text import FileText, parse
from preflight_analysis.source.parameter_library import ParameterLibrary, read_parameter_library

MAX_FILES = 200
"""How many files of one program are looked at."""

_MAX_TEXTS = 256
_PLUGIN_FILES = 10
_REGISTERED = re.compile(r"\bRCLCPP_COMPONENTS_REGISTER_NODE\s*\(\s*(?:::)?([\w:]+)\s*\)")
_PLUGINS = frozenset({"nodelet", "pluginlib"})


@query(limit=_MAX_TEXTS)
def _file_text(db: Database, path: str) -> FileText | None:
    """What a file declares; None where there is none."""
    text = Disk(db).content(path)
    return parse(path, text) if text is not None else None


class Plugin(NamedTuple):
    """A class that a package exports for pluginlib, with the program that has it."""

    program: CppProgram
    cls: str
    package: str
    base: str


class CppFiles:
    """Puts one program together. Files of the packages `known` are left out of the programs of others."""

    def __init__(self, packages: Mapping[str, Package], disk: Disk, known: Collection[str] = ()) -> None:
        self._packages = packages
        self._disk = disk
        self._known = known

    def build(self, package: str) -> Build:
        """What a package builds; nothing for one that is not there in source form."""
        found = self._packages.get(package)
        return cmake_build(self._disk, found) if found is not None else Build()

    def executable(self, package: str, name: str) -> CppProgram | None:
        """The program that an executable of a package is built from."""
        target = self.build(package).executable(name)
        return self._program(package, target) if target is not None else None

    def component(self, package: str, cls: str) -> CppProgram | None:
        """The program with the class that a package registers as an rclcpp component."""
        build = self.build(package)
        target = build.targets.get(build.components.get(cls, ""))
        if target is None:  # by a macro of the package's own, for instance
            libraries = (each for each in build.targets.values() if each.kind == "library")
            target = next((each for each in libraries if self._registers(each, cls)), None)
        return self._program(package, target) if target is not None else None

    def parameter_library(self, package: str, space: str, includes: Sequence[str]) -> ParameterLibrary | None:
        """What is declared by the library of generate_parameter_library that has a C++ namespace: one of the package,
        or one whose header is included. Without a namespace it is that of a package that has no other."""
        paths = list(self.build(package).parameter_libraries.values())
        if not space and len(paths) > 1:
            return None
        for include in includes:
            other, _, header = include.rpartition("/")
            if other != package and other in self._packages:
                path = self.build(other).parameter_libraries.get(PurePath(header).stem)
                paths += [path] if path is not None else []
        for path in dict.fromkeys(paths):
            text = self._disk.content(path)
            found = read_parameter_library(path, text) if text is not None else None
            if found is not None and space in ("", found[0]):
                return found[1]
        return None

    def _registers(self, target: Target, cls: str) -> bool:
        texts = (self._disk.content(source) or "" for source in target.sources)
        return any(found[1] == cls for text in texts for found in _REGISTERED.finditer(text))

    def plugin(self, name: str, bases: Collection[str], of: str | None = None) -> Plugin | None:
        """The plugin `package/Name` (or `package::Name`) of one of the base classes. `of`: the package that has it,
        where that is known."""
        wanted = name.replace("/", "::")
        for package in self._having_plugins(wanted.partition("::")[0] if of is None else of):
            for library, type_, plugin, base in self._plugins(package, bases):
                if wanted in (plugin.replace("/", "::"), type_):
                    target = self.build(package).library(PurePath(library).name)
                    return Plugin(self._program(package, target), type_, package, base) if target is not None else None
        return None

    def plugins(self, package: str, bases: Collection[str] | None = None) -> tuple[str, ...]:
        """The names of the plugins of these base classes, or of any, that a package exports."""
        return tuple(dict.fromkeys(name for _, _, name, _ in self._plugins(package, bases)))

    def _having_plugins(self, likely: str) -> Iterator[str]:
        """Packages in source form that may have a plugin: the one that its name begins with by convention, first."""
        if likely in self._packages:
            yield likely
            return
        for name, package in self._packages.items():
            needs = not _PLUGINS.isdisjoint(package.dependencies)
            if needs and self._disk.is_file(os.path.join(package.share, LISTS)):
                yield name

    def _plugins(self, package: str, bases: Collection[str] | None) -> Iterator[tuple[str, str, str, str]]:
        """Library, class, name and base class of each plugin that a package exports."""
        found = self._packages.get(package)
        if found is None:
            return
        manifest = _xml(self._disk.content(found.manifest))
        exported = manifest.find(".//export") if manifest is not None else None
        paths = [
            value.replace("${prefix}", found.share)
            for element in (exported if exported is not None else ())
            for value in (element.get("plugin"),)
            if value and isinstance(element.tag, str)
        ]
        paths += self.build(package).plugin_files
        for path in paths[:_PLUGIN_FILES]:
            described = _xml(self._disk.content(os.path.normpath(os.path.join(found.share, path))))
            for library in described.iter("library") if described is not None else ():
                for cls in library.iter("class"):
                    base = cls.get("base_class_type")
                    if base is not None and (bases is None or base in bases) and (type_ := cls.get("type")):
                        yield library.get("path") or "", type_, cls.get("name") or type_, base

    def _program(self, package: str, target: Target) -> CppProgram:
        found: dict[str, FileText] = {}
        pending = list(self.build(package).sources(target))
        known = set(pending)
        while pending and len(found) < MAX_FILES:
            path = pending.pop(0)
            text = _file_text(self._disk.db, path)
            if text is None:
                continue
            found[path] = text
            for more in self._included(text, package):
                if more not in known:
                    known.add(more)
                    pending.append(more)
        return CppProgram(list(found.values()))

    def _included(self, file: FileText, package: str) -> Iterator[str]:
        for include in file.includes:
            folders = [os.path.dirname(file.path), *self._folders(package)]
            other = self._package_of(include)
            if other != package:
                folders += self._folders(other) if other not in self._known else []
            paths = (os.path.normpath(os.path.join(folder, include)) for folder in folders)
            path = next((path for path in paths if self._disk.is_file(path)), None)
            if path is None:
                continue
            yield path
            if other in self._packages and other != package and other not in self._known:
                yield from self._implementing(path, other)

    def _package_of(self, include: str) -> str:
        """The package that a header is of by convention: `pkg/x.hpp`, or `project/name/x.hpp` of `project_name`."""
        first, _, rest = include.partition("/")
        joined = f"{first}_{rest.partition('/')[0]}"
        return joined if first not in self._packages and "/" in rest and joined in self._packages else first

    def _folders(self, package: str) -> list[str]:
        found = self._packages.get(package)
        if found is None:
            return []
        share = found.share
        by_convention = (os.path.join(share, *below) for below in (("include",), ("src",), (), ("include", package)))
        return list(dict.fromkeys((*by_convention, *self.build(package).include_folders)))

    def _implementing(self, header: str, package: str) -> Iterator[str]:
        stem = PurePath(header).stem
        for target in self.build(package).targets.values():
            if target.kind == "library":
                yield from (source for source in target.sources if PurePath(source).stem == stem)


def _xml(text: str | None) -> etree._Element | None:
    if text is None:
        return None
    parser = etree.XMLParser(encoding="utf-8", recover=True, resolve_entities=False, no_network=True, load_dtd=False)
    try:
        # Descriptions of plugins often have several elements at the top.
        body = text[text.find("?>") + 2 :] if text.lstrip().startswith("<?xml") else text
        return etree.fromstring(f"<all>{body}</all>".encode("utf-8", "surrogatepass"), parser)
    except etree.XMLSyntaxError:
        return None
