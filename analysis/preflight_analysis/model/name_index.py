"""The index of names: every place in the files of the workspace that defines or uses one, launched or not.

Of each file it has what its parser says, once for each text. A file that changes costs what is read of it, and what is
asked of many files is made anew only where the names of that kind are others.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from itertools import chain
from typing import Literal

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.python_text import is_python
from preflight_analysis.documents.quoted import Program
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.environment.build import BUILD_FILES, LISTS, SETTINGS, SETUP
from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.environment.model import Environment
from preflight_analysis.environment.package_files import files_in
from preflight_analysis.environment.packages import MANIFEST
from preflight_analysis.evaluation.reading import launch_file_of
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.recognize import YAML_SUFFIXES, launch_files_of, launch_format_on_disk
from preflight_analysis.model.context import Context
from preflight_analysis.model.entry import Entry, Kind, Mention
from preflight_analysis.model.names_of_builds import names_of_cmake, names_of_settings, names_of_setup
from preflight_analysis.model.names_of_data import names_of_manifest, names_of_rviz, names_of_xml, names_of_yaml
from preflight_analysis.model.names_of_launch_files import (
    entries_of_launch_file,
    names_of_launch_file,
    names_of_python_launch_file,
)
from preflight_analysis.model.names_of_programs import names_of_program

Files = Literal["launch", "robots", "yaml", "programs", "all"]
_CPP = (".cpp", ".cc", ".cxx", ".hpp", ".h")
_ROBOTS = (".xacro", ".urdf", ".srdf", ".sdf", ".world", ".gazebo")
RVIZ = ".rviz"
_PROGRAMS = (".py", *_CPP, ".cfg", ".l", ".rs", ".js")
_SUFFIXES: Mapping[Files, tuple[str, ...]] = {
    "robots": _ROBOTS,
    "yaml": YAML_SUFFIXES,
    "all": (*_ROBOTS, *YAML_SUFFIXES, *_PROGRAMS, ".launch", ".xml"),
}
_SCRIPTS = ("bin", "nodes", "scripts", "src")
"""Folders in which files without a suffix are programs."""
_MOST = 500
"""Files of one package that are read."""
_MOST_SOURCES = 600
"""Of more nothing is said."""
_MOST_PACKAGES = 30
"""Packages beside one that are looked at."""
_MOST_OWN = 60
"""Packages of a workspace of which all sources are read."""


@query
def entries_in(db: Database, path: str) -> frozenset[Entry]:
    """The names in a file."""
    document = Disk(db).text(path)
    return frozenset(_entries(db, path, document.text)) if isinstance(document, Document) else frozenset()


def _entries(db: Database, path: str, text: str) -> Iterable[Entry]:
    if (launch_file := _tags_of(db, path, text)) is not None:
        return entries_of_launch_file(launch_file)
    return (each.entry for each in _mentions(db, path, text))


@query
def mentions_in(db: Database, path: str) -> tuple[Mention, ...]:
    """The names in a file with their places, which an edit moves: what follows from the names alone asks for those."""
    document = Disk(db).text(path)
    return tuple(_mentions(db, path, document.text)) if isinstance(document, Document) else ()


def _mentions(db: Database, path: str, text: str) -> Iterator[Mention]:
    name = os.path.basename(path)
    if (launch_file := _tags_of(db, path, text)) is not None:
        yield from names_of_launch_file(launch_file)
    elif name == SETTINGS:
        yield from names_of_settings(text)
    elif is_python(path, text) or is_program(path):
        program = Program(path, text)
        yield from names_of_program(program)
        yield from names_of_python_launch_file(program) if launch_format_on_disk(db, path) is not None else ()
        yield from names_of_setup(program) if name == SETUP else ()
    elif path.endswith(YAML_SUFFIXES):
        yield from names_of_yaml(text)
    elif path.endswith(RVIZ):
        yield from names_of_rviz(text)
    elif name == LISTS:
        yield from names_of_cmake(text)
    elif name == MANIFEST:
        yield from names_of_manifest(text)
    else:
        yield from names_of_xml(text)


def _tags_of(db: Database, path: str, text: str) -> LaunchFile | None:
    """A launch file in XML or YAML."""
    if is_python(path, text) or is_program(path) or launch_format_on_disk(db, path) is None:
        return None
    found = launch_file_of(db, path, None)
    return None if isinstance(found, Unreadable) else found


def is_program(path: str) -> bool:
    """Whether a file may be a program, by its name and its folder."""
    folder, name = os.path.split(path)
    return path.endswith(_PROGRAMS) or ("." not in name and os.path.basename(folder) in _SCRIPTS)


@query
def named_in(db: Database, path: str, kind: Kind) -> frozenset[Entry]:
    """Those of one kind."""
    return frozenset(entry for entry in entries_in(db, path) if entry.kind == kind)


@query
def counted_in(db: Database, folder: str, kind: Kind, files: Files = "launch") -> Mapping[Entry, int]:
    """In how many files below a folder each name of a kind is."""
    there = files_in(Disk(db), folder, deep=True)
    paths = launch_files_of(db, there) if files == "launch" else [p for p in there if p.endswith(_SUFFIXES[files])]
    return dict(Counter(chain.from_iterable(named_in(db, path, kind) for path in paths[:_MOST])))


def in_package(context: Context, kind: Kind) -> Mapping[Entry, int]:
    """In how many launch files of the package of the root each name is."""
    package = package_around(context.environment, context.root)
    return counted_in(context.disk.db, package.share, kind, "launch") if package is not None else {}


def around(context: Context, kind: Kind, files: Files = "launch") -> Mapping[Entry, int]:
    """As `in_package`, with the packages beside that: a robot's description, navigation, ... mostly are."""
    return _around(context.disk.db, context.environment, context.root, kind, files)


def in_workspace(context: Context, kind: Kind) -> Iterator[Entry]:
    """The names of a kind in the launch files of all packages of the workspace."""
    for share in sorted({each.share for each in context.environment.own_packages}):
        yield from counted_in(context.disk.db, share, kind, "launch")


@query
def _around(db: Database, environment: Environment, root: str, kind: Kind, files: Files) -> Mapping[Entry, int]:
    package = package_around(environment, root)
    if package is None:
        return {}
    beside = os.path.dirname(package.share)
    shares = {each.share for each in environment.packages.values() if os.path.dirname(each.share) == beside}
    counts: Counter[Entry] = Counter()
    for share in shares if len(shares) <= _MOST_PACKAGES else (package.share,):
        counts.update(counted_in(db, share, kind, files))
    return dict(counts)


@query
def sources_in(db: Database, folder: str) -> tuple[str, ...] | None:
    """The programs of a package, and the declarations of their parameters; None where there are too many."""
    there = files_in(Disk(db), folder, deep=True)
    paths = [path for path in there if path.endswith(".yaml") or is_program(path)]
    return tuple(paths) if len(paths) <= _MOST_SOURCES else None


@query
def own_folders(db: Database, environment: Environment) -> tuple[str, ...]:
    """Those of the packages of the workspace, without what lies in another one; none where there are too many."""
    shares = {each.share for each in environment.own_packages}
    found = [share for share in sorted(shares) if os.path.dirname(share) not in shares]
    return tuple(found) if len(shares) <= _MOST_OWN else ()


def named_in_packages(
    db: Database, environment: Environment, kind: Kind, name: str, folders: Iterable[str] | None = None
) -> Iterator[tuple[str, Mention]]:
    """Where what describes and builds the packages of the workspace, or those in some folders, and their programs name
    something, launch files left out."""
    own = own_folders(db, environment)
    for folder in sorted({each.share for each in environment.own_packages}) if folders is None else folders:
        paths = [os.path.join(folder, each) for each in (MANIFEST, *BUILD_FILES)]
        for path in dict.fromkeys((*paths, *((sources_in(db, folder) or ()) if folder in own else ()))):
            if launch_format_on_disk(db, path) is None and any(each.text == name for each in named_in(db, path, kind)):
                yield from ((path, m) for m in mentions_in(db, path) if m.entry[:2] == (kind, name))
