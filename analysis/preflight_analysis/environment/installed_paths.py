"""From a path in the share folder of a package to the file in its source, and back.

A launch file names what is installed: `$(find-pkg-share p)/config/a.yaml`. Its author edits what is in the source. For
a package of the workspace `Package.share` is the folder of the source, which has the same files at the same places as
long as the package installs them so; what it installs under other names, or makes, is found here.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import TYPE_CHECKING

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.build import MADE
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query

if TYPE_CHECKING:
    from preflight_analysis.environment.build import Build
    from preflight_analysis.environment.setup_py import PythonBuild


def located(disk: Disk, environment: Environment, path: str) -> str:
    """The file that a path leads to: itself if it is there, else what the package around it installs there, else what
    is installed; itself if there is nothing of all that."""
    if disk.exists(path):
        return path
    package = package_around(environment, path)
    if package is None or not package.is_ament:
        return path
    below = os.path.relpath(path, package.share)
    source = installed_from(disk, package, below)
    if source is not None and disk.exists(source):
        return source
    for prefix in environment.ament_prefixes:
        candidate = os.path.join(prefix, "share", package.name, below)
        if disk.exists(candidate):
            return candidate
    return path


def package_around(environment: Environment, path: str) -> Package | None:
    """The package whose folder a path is in."""
    folders = environment.packages_by_folder
    folder, above = os.path.dirname(path), path
    while folder and folder != above:
        if folder in folders:
            return folders[folder]
        folder, above = os.path.dirname(folder), folder
    return None


def installed_from(disk: Disk, package: Package, below: str) -> str | None:
    """The file of the source that is installed at this place of the share folder, None if none is known to be."""
    if package.build_type == "ament_python":
        return python_build(disk, package).data.get(below)
    for where, source in _installed_by_cmake(disk, package):
        if where == ".":
            path = os.path.join(source, below)
        elif below.startswith(where + os.sep):
            path = os.path.join(source, os.path.relpath(below, where))
        elif below == where:
            path = source
        else:
            continue
        if disk.exists(path):
            return path
    return None


def installed_elsewhere(disk: Disk, package: Package) -> list[tuple[str, str]]:
    """Paths in the share folder of a package of the workspace, and the files and folders of its source that they will
    lead to once it is built, where those lie elsewhere."""
    if not package.is_ament:
        return []
    python = package.build_type == "ament_python"
    found = python_build(disk, package).data.items() if python else _installed_by_cmake(disk, package)
    pairs = ((os.path.normpath(os.path.join(package.share, where)), os.path.normpath(path)) for where, path in found)
    return [(where, source) for where, source in pairs if where != source]


def _installed_by_cmake(disk: Disk, package: Package) -> Iterator[tuple[str, str]]:
    """What is installed below the package's share folder: where there, and the file or folder of the source."""
    share = f"share/{package.name}"
    for item in cmake_build(disk, package).installed:
        destination = os.path.normpath(item.destination.replace("${PROJECT_NAME}", package.name)).lstrip("/")
        if destination == share or destination.startswith(share + "/"):
            yield os.path.normpath(os.path.join(destination[len(share) :].lstrip("/"), item.name)), item.source


def made_by_build(disk: Disk, environment: Environment, path: str) -> Package | None:
    """The package whose build makes the file that is then installed at this path."""
    package = package_around(environment, path)
    if package is None or not package.is_ament or package.build_type == "ament_python":
        return None
    below, made = os.path.relpath(path, package.share), os.path.join(package.share, MADE, "")
    for where, source in _installed_by_cmake(disk, package):
        if source.startswith(made) and (below == where or f"{below}/".startswith(f"{where}/") or where == "."):
            return package
    return None


def installs_more(disk: Disk, package: Package) -> bool:
    """Whether the package may install files that are not known: its build files do more than is understood."""
    if package.build_type == "ament_python":
        build = python_build(disk, package)
        return not (build.complete and build.data)
    return package.build_type != "ament_cmake" or not cmake_build(disk, package).complete


def installed_at(disk: Disk, package: Package, path: str) -> tuple[str, ...]:
    """Where in the share folder of its package a file of the source is installed, as far as is known."""
    path = os.path.normpath(path)
    if package.build_type == "ament_python":
        return tuple(below for below, source in python_build(disk, package).data.items() if source == path)
    found = []
    for where, source in _installed_by_cmake(disk, package):
        if path == source:
            found.append(where)
        elif path.startswith(source + os.sep):
            found.append(os.path.normpath(os.path.join(where, os.path.relpath(path, source))))
    return tuple(found)


def python_build(disk: Disk, package: Package) -> PythonBuild:
    """What `setup.py` and its like say."""
    return _python_build(disk.db, package.share, package.name)


@query
def _python_build(db: Database, share: str, name: str) -> PythonBuild:
    # Who has no package that is not installed starts faster without.
    from preflight_analysis.environment.setup_py import read_python_build  # noqa: PLC0415

    return read_python_build(share, name, Disk(db))


def cmake_build(disk: Disk, package: Package) -> Build:
    """What `CMakeLists.txt` says."""
    known = package.is_ament or package.build_type == "catkin"
    return _cmake_build(disk.db, package.share, package.name, package.generation if known else None)


@query
def _cmake_build(db: Database, share: str, name: str, generation: int | None) -> Build:
    from preflight_analysis.environment.cmake import read_build  # noqa: PLC0415, likewise

    return read_build(share, name, Disk(db), generation)
