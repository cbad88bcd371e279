"""Which program a node of some name is, whatever launch starts it: for parameter files that no launch is known to give
to a node (ROS 2)."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from preflight_analysis.catalogue.launches import CataloguedFile, path_of
from preflight_analysis.catalogue.launches import launch_files_of as catalogued_launch_files
from preflight_analysis.catalogue.packages import distribution_of, interfaces_of
from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.package_files import files_in
from preflight_analysis.evaluation.reading import launch_file_of
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.recognize import launch_files_of
from preflight_analysis.model.context import ExecutableNames

_GENERATION = 2
_NODES = ("node", "lifecycle_node")
_COMPONENT = "composable_node"
_WORD = re.compile(r"[A-Za-z_][\w:.-]*\Z")


class Program(NamedTuple):
    """What a node runs: an executable of a package, or the class `plugin` of a component."""

    package: str
    executable: str
    plugin: str = ""


def program_called(
    db: Database, environment: Environment, executables: ExecutableNames, package: Package, name: str
) -> Program | None:
    """The one program that a node of this name is, for a file of a package: what the launch files of the package start
    under that name, or those of the others around it; else the executable that is called so, of the package, of the
    workspace, or of what the package depends on. None where there are several, or none."""
    own = environment.own_packages
    for shares in ((package.share,), tuple(sorted({each.share for each in own}))):
        found = frozenset[Program]().union(*(_started(db, share).get(name, ()) for share in shares))
        if found:
            return next(iter(found)) if len(found) == 1 else None
    for packages in ((package.name,), tuple(sorted({each.name for each in own}))):
        found = frozenset(Program(each, name) for each in packages if name in executables.names(each))
        if found:
            return next(iter(found)) if len(found) == 1 else None
    distro = distribution_of(_GENERATION, environment.distro)
    known = frozenset[Program]()
    for each in sorted(package.dependencies - environment.packages.keys()):
        known |= _catalogued(db, each, distro).get(name, frozenset())
    return next(iter(known)) if len(known) == 1 else None


@query
def _started(db: Database, share: str) -> Mapping[str, frozenset[Program]]:
    """What the launch files of a package start, by the names that they give."""
    return _by_name(db, launch_files_of(db, files_in(Disk(db), share, deep=True)))


@query
def _catalogued(db: Database, package: str, distro: str) -> Mapping[str, frozenset[Program]]:
    """Likewise of a package from the catalogue, and its executables."""
    paths = [path_of(CataloguedFile(distro, package, below)) for below in catalogued_launch_files(package, distro)]
    found = dict(_by_name(db, paths))
    for name in interfaces_of(package, distro).get("executables", ()):
        found[name] = found.get(name, frozenset()) | {Program(package, name)}
    return found


def _by_name(db: Database, paths: list[str]) -> Mapping[str, frozenset[Program]]:
    found: dict[str, set[Program]] = {}
    for path in paths:
        launch_file = launch_file_of(db, path, None)
        if isinstance(launch_file, Unreadable) or launch_file.generation != _GENERATION or launch_file.root is None:
            continue
        for action in launch_file.root.walk():
            for name, program in _started_by(action):
                found.setdefault(name, set()).add(program)
    return {name: frozenset(each) for name, each in found.items()}


def _started_by(action: Action) -> Iterator[tuple[str, Program]]:
    is_component = action.kind == _COMPONENT
    if action.kind not in _NODES and not is_component:
        return
    values = [action.value(each) for each in ("name", "pkg", "plugin" if is_component else "exec")]
    name, package, program = [each.text if each is not None else "" for each in values]
    if all(map(_WORD.match, (name, package, program))):
        yield name, Program(package, "", program) if is_component else Program(package, program)
