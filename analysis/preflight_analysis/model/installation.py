"""Whether a file of the source will be in the share folder of its package, and as what (ROS 2)."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from typing import Literal, NamedTuple

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.python_text import is_python
from preflight_analysis.documents.span import Location
from preflight_analysis.environment.build import BUILD_FILES, LISTS
from preflight_analysis.environment.installed_paths import (
    installed_at,
    installed_elsewhere,
    installed_from,
    installs_more,
    made_by_build,
    package_around,
)
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.packages import MANIFEST
from preflight_analysis.evaluation.tree import LaunchNode, Use
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context

_IN_PYTHON = ("get_package_share_directory", "get_package_share_path", "FindPackageShare")
"""A program may name the folder anywhere."""


class Installation(NamedTuple):
    """What comes of a file of a package's source: `below` is its path in the package, `places` are where it is in the
    share folder, as far as is known. `state`: `same` if something is there at the same path, `unknown` where the build
    files do more than is understood, `elsewhere` if it is at other paths alone, `nowhere` if it is not installed."""

    package: Package
    below: str
    places: tuple[str, ...]
    state: Literal["same", "unknown", "elsewhere", "nowhere"]

    @property
    def build_file(self) -> str:
        """The name of the file that says what is installed."""
        return "setup.py" if self.package.build_type == "ament_python" else LISTS

    @property
    def problem(self) -> str:
        """Why nothing is at its path in the share folder, in words; "" where something is, or may be."""
        if self.state in ("same", "unknown"):
            return ""
        what = f"installs it as '{self.places[0]}'" if self.places else "does not list it"
        return (
            f"file '{self.below}' is not installed in the share folder: {self.build_file} of '{self.package.name}' "
            f"{what}"
        )


def installation(context: Context, path: str) -> Installation | None:
    """What comes of a file; None where it is in the source of no package."""
    return installation_in(context.disk, context.environment, path)


def installation_in(disk: Disk, environment: Environment, path: str) -> Installation | None:
    """Likewise without a launch."""
    package = package_around(environment, path)
    if package is None or not package.is_ament or not path.startswith(package.share + os.sep):
        return None
    if any(disk.is_file(os.path.join(folder, MANIFEST)) for folder in _between(package.share, path)):
        return None  # a package within, which that build does not know
    if not disk.is_file(path):
        return None
    below, places = os.path.relpath(path, package.share), installed_at(disk, package, path)
    if below in places or installed_from(disk, package, below) is not None:
        return Installation(package, below, places, "same")
    if installs_more(disk, package):
        return Installation(package, below, places, "unknown")
    return Installation(package, below, places, "elsewhere" if places else "nowhere")


def named_installation(context: Context, use: Use) -> Installation | None:
    """What comes of the file that a value names by its share folder: what stands at that path in the source is taken
    for what is there once it is installed. None for what is named in other ways, such as beside the launch file."""
    if use.kind not in ("include", "file") or use.target is None or not is_by_share(context, use.location):
        return None
    return installation(context, os.path.normpath(use.name))


def will_be_there(context: Context, path: str) -> bool:
    """Whether the build makes what is installed at a path."""
    return made_by_build(context.disk, context.environment, path) is not None


def installed_below(context: Context, package: Package, below: str) -> Iterator[tuple[str, bool]]:
    """The names in a folder of the share folder for which the source has nothing at the same path, each with whether
    it is a folder."""
    folder = os.path.normpath(os.path.join(package.share, below))
    for where, source in installed_elsewhere(context.disk, package):
        if where.startswith(f"{folder}/"):
            name, inside, _ = where[len(folder) + 1 :].partition("/")
            yield name, bool(inside) or context.disk.is_folder(source)
        elif f"{folder}/".startswith(f"{where}/") and context.disk.is_folder(source):
            there = os.path.normpath(os.path.join(source, os.path.relpath(folder, where)))
            yield from ((name, context.disk.is_folder(os.path.join(there, name))) for name in context.disk.names(there))


def _between(share: str, path: str) -> Iterator[str]:
    folder = os.path.dirname(path)
    while len(folder) > len(share):
        yield folder
        folder = os.path.dirname(folder)


def is_by_share(context: Context, location: Location) -> bool:
    """Whether a path is that of a share folder: what is named beside the launch file is found in the source too."""
    document = context.documents.get(location.file)
    if document is None:
        return False
    if is_python(document.path, document.text):
        return "__file__" not in document.text and any(name in document.text for name in _IN_PYTHON)
    return "find-pkg-share" in document.text[location.span.start : location.span.end]


@derived
def packages_of(context: Context) -> tuple[Package, ...]:
    """The packages of the workspace that a launch has to do with."""
    return packages_in(context.environment, context.launch_files, context.tree.nodes)


def packages_in(environment: Environment, files: Iterable[str], nodes: Iterable[LaunchNode]) -> tuple[Package, ...]:
    """Those of launch files and of nodes."""
    found = {package.name: package for file in files if (package := package_around(environment, file))}
    named = {node.package for node in nodes} & environment.packages.keys()
    found |= {name: environment.packages[name] for name in sorted(named)}
    return tuple(package for package in found.values() if not environment.is_installed(package))


def build_files_of(disk: Disk, package: Package) -> tuple[str, ...]:
    """The files that say how a package is built and installed."""
    paths = (os.path.join(package.share, name) for name in BUILD_FILES)
    return tuple(path for path in paths if disk.is_file(path))
