"""From a path in the share folder of a package to the file in its source, and back.

A launch file names what is installed: `$(find-pkg-share p)/config/a.yaml`. Its author edits what is in the source. For
a package of the workspace `Package.share` is the folder of the source, which has the same files at the same places as
long as the package installs them so; what it installs under other names, or makes, is found here.
"""

from __future__ import annotations

import os
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache

from preflight_analysis.documents.reading import Text, read_text
from preflight_analysis.environment.build import Build
from preflight_analysis.environment.cmake import read_build
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.setup_py import PythonBuild, read_python_build


def located(environment: Environment, path: str) -> str:
    """The file that a path leads to: itself if it is there, else what the package around it installs there, else what
    is installed; itself if there is nothing of all that."""
    if os.path.exists(path):
        return path
    package = package_around(environment, path)
    if package is None or not package.is_ament:
        return path
    below = os.path.relpath(path, package.share)
    source = installed_from(package, below)
    if source is not None and os.path.exists(source):
        return source
    for prefix in environment.ament_prefixes:
        candidate = os.path.join(prefix, "share", package.name, below)
        if os.path.exists(candidate):
            return candidate
    return path


def package_around(environment: Environment, path: str) -> Package | None:
    """The package whose folder a path is in."""
    folders = _by_folder(environment)
    folder = os.path.dirname(path)
    while folder and folder != os.path.dirname(folder):
        if folder in folders:
            return folders[folder]
        folder = os.path.dirname(folder)
    return None


_FOLDERS: dict[int, tuple[Mapping[str, Package], Mapping[str, Package]]] = {}
"""The packages of an environment by their folders. By identity: they are hundreds, and asked for at each keystroke."""
_MOST_ENVIRONMENTS = 8


def _by_folder(environment: Environment) -> Mapping[str, Package]:
    packages = environment.packages
    known = _FOLDERS.get(id(packages))
    if known is None or known[0] is not packages:
        if len(_FOLDERS) >= _MOST_ENVIRONMENTS:
            _FOLDERS.clear()
        known = _FOLDERS[id(packages)] = packages, {p.share.rstrip("/"): p for p in packages.values()}
    return known[1]


def installed_from(package: Package, below: str) -> str | None:
    """The file of the source that is installed at this place of the share folder, None if none is known to be."""
    if package.build_type == "ament_python":
        return python_build(package).data.get(below)
    for where, source in _installed_by_cmake(package):
        if where == ".":
            path = os.path.join(source, below)
        elif below.startswith(where + os.sep):
            path = os.path.join(source, os.path.relpath(below, where))
        elif below == where:
            path = source
        else:
            continue
        if os.path.exists(path):
            return path
    return None


def installed_elsewhere(package: Package) -> list[tuple[str, str]]:
    """Paths in the share folder of a package of the workspace, and the files and folders of its source that they will
    lead to once it is built, where those lie elsewhere."""
    if not package.is_ament:
        return []
    python = package.build_type == "ament_python"
    found = python_build(package).data.items() if python else _installed_by_cmake(package)
    pairs = ((os.path.normpath(os.path.join(package.share, where)), os.path.normpath(path)) for where, path in found)
    return [(where, source) for where, source in pairs if where != source]


def _installed_by_cmake(package: Package) -> Iterator[tuple[str, str]]:
    """What is installed below the package's share folder: where there, and the file or folder of the source."""
    share = f"share/{package.name}"
    for item in cmake_build(package).installed:
        destination = os.path.normpath(item.destination.replace("${PROJECT_NAME}", package.name)).lstrip("/")
        if destination == share or destination.startswith(share + "/"):
            yield os.path.normpath(os.path.join(destination[len(share) :].lstrip("/"), item.name)), item.source


def installs_more(package: Package) -> bool:
    """Whether the package may install files that are not known: its build files do more than is understood."""
    if package.build_type == "ament_python":
        build = python_build(package)
        return not (build.complete and build.data)
    return package.build_type != "ament_cmake" or not cmake_build(package).complete


def installed_at(package: Package, path: str) -> tuple[str, ...]:
    """Where in the share folder of its package a file of the source is installed, as far as is known."""
    path = os.path.normpath(path)
    if package.build_type == "ament_python":
        return tuple(below for below, source in python_build(package).data.items() if source == path)
    found = []
    for where, source in _installed_by_cmake(package):
        if path == source:
            found.append(where)
        elif path.startswith(source + os.sep):
            found.append(os.path.normpath(os.path.join(where, os.path.relpath(path, source))))
    return tuple(found)


def python_build(package: Package) -> PythonBuild:
    """What `setup.py` and its like say, as they and the folders that they list are now."""
    key = package.share, package.name
    known = _PYTHON_BUILDS.get(key)
    if known is not None and known.is_current():
        return known.build
    at = time.time_ns()
    build = read_python_build(*key, _text)
    if known is not None and known.build == build:
        build = known.build
    if len(_PYTHON_BUILDS) >= _MOST_BUILDS:
        _PYTHON_BUILDS.clear()
    _PYTHON_BUILDS[key] = _KnownBuild(build, {path: _signature(path) for path in build.looked_at}, at)
    return build


@dataclass(frozen=True, slots=True)
class _KnownBuild:
    """What was read, of files and folders that looked so, and when (nanoseconds)."""

    build: PythonBuild
    signatures: Mapping[str, tuple[int, int] | None]
    at: int

    def is_current(self) -> bool:
        """Whether all of it looks as it did, and was not changed so shortly before that another change may not show."""
        newest = max((signature[0] for signature in self.signatures.values() if signature is not None), default=0)
        same = all(_signature(path) == signature for path, signature in self.signatures.items())
        return same and newest + _TICK < self.at


_PYTHON_BUILDS: dict[tuple[str, str], _KnownBuild] = {}
_MOST_BUILDS = 256
_TICK = 50_000_000
"""Nanoseconds in which a file system may give two changes the same time."""


def cmake_build(package: Package) -> Build:
    """What `CMakeLists.txt` says, as it is now."""
    return _cmake_build(package.share, package.name, _signature(os.path.join(package.share, "CMakeLists.txt")))


@lru_cache(maxsize=256)
def _cmake_build(share: str, name: str, _: object) -> Build:
    return read_build(share, name, _text)


def _signature(path: str) -> tuple[int, int] | None:
    try:
        status = os.stat(path)
    except OSError:
        return None
    return status.st_mtime_ns, status.st_size


def _text(path: str) -> str | None:
    found = read_text(path)
    return found.text if isinstance(found, Text) else None
