"""What a check launches: the files that are named, or all that a folder has."""

from __future__ import annotations

import argparse
import os
from collections.abc import Mapping, Sequence
from dataclasses import field
from types import MappingProxyType

from preflight_analysis.dataclass import dataclass
from preflight_analysis.environment.detect import workspace_of
from preflight_analysis.environment.model import Package
from preflight_analysis.findings.severities import Severities
from preflight_analysis.launch.recognize import FileKind, file_kind
from preflight_analysis.workspace.index import Root
from preflight_analysis.workspace.project_settings import read_project_settings
from preflight_analysis.workspace.workspace import Workspace

from preflight_server.cli import options
from preflight_server.cli.errors import CannotDoError, require
from preflight_server.cli.output import say
from preflight_server.cli.project import OpenWorkspace, open_workspace

STANDARD_INPUT = "-"
_CHECKED = (
    "files that can be checked: launch files, parameter files in YAML, package.xml, CMakeLists.txt, setup.py, "
    "setup.cfg and Python modules of a package, robot descriptions in a package"
)
_OF_PACKAGE: frozenset[FileKind] = frozenset(("build file", "module", "robot description", "behavior tree"))
"""What is checked as a part of its package alone."""


@dataclass(frozen=True, slots=True)
class Launches:
    """Roots in the workspace that they belong to."""

    home: str
    """The workspace's folder."""
    workspace: OpenWorkspace
    roots: tuple[Root, ...]
    asked: frozenset[Root]
    """Those that the command or the settings name: launched even if another one includes them."""
    packages: tuple[Package, ...] = ()
    """Those in the folders that are named."""
    files: Mapping[str, FileKind] = field(default_factory=dict)
    """Those that are named and are no launch files."""


def launches(
    args: argparse.Namespace, *, chosen: Sequence[Severities] = (), typed: Mapping[str, str] = MappingProxyType({})
) -> list[Launches]:
    """What `args.launch_args` name, by workspace; the current folder where they name nothing. `chosen` as for
    `Workspace`. Of the files in `typed`, absolute paths, that text counts, and `-` stands for them.

    A file is launched as it is, with the arguments `name:=value`. Of a folder each file that nothing includes is, and
    what the settings name, once with each of their profiles of arguments. Raises `CannotDoError` for a path that does
    not exist, a file of which no check knows anything, and for a folder without launch files and packages.
    """
    values = [each for each in args.launch_args if ":=" in each]
    paths = [each for each in args.launch_args if ":=" not in each]
    if not paths and values:
        raise CannotDoError("name:=value is for a launch file, and none is named")
    wanted: dict[str, list[Root]] = {}
    asked: dict[str, set[Root]] = {}
    packages: dict[str, dict[str, Package]] = {}
    files: dict[str, dict[str, FileKind]] = {}
    opened: dict[str, OpenWorkspace] = {}
    named_paths = [each for given in paths or ["."] for each in (typed if given == STANDARD_INPUT else (given,))]
    for given in named_paths:
        path = given if given in typed else require(given)
        folder = os.path.isdir(path)
        home = workspace_of(os.path.join(path, "_") if folder else path)
        if home not in opened:
            opened[home] = open_workspace(options.environment(args, home), args, chosen=chosen)
            opened[home].workspace.sources.take(typed)
        if folder and values:
            raise CannotDoError(f"{given} is a folder; arguments for its launch files stand in .ros-preflight.yaml")
        kind = None if folder else _kind(given, path, opened[home].workspace)
        if kind is not None and kind != "launch file":
            files.setdefault(home, {})[path] = kind
            continue
        named = _named_below(path, home) if folder else [Root.of(path, options.launch_args(values, path))]
        found = _roots_below(path, named, opened[home]) if folder else named
        own = opened[home].workspace.environment.own_packages if folder else ()
        below = {each.share: each for each in own if _below(each.share, path)}
        if not found and folder:
            if not below:
                raise CannotDoError(f"there are no launch files in {given}")
            say(f"ros-preflight: there are no launch files in {given}; packages and parameter files are checked")
        packages.setdefault(home, {}).update(below)
        wanted.setdefault(home, []).extend(found)
        asked.setdefault(home, set()).update(named)
    if values and not any(wanted.values()):
        raise CannotDoError("name:=value is for a launch file, and none is named")
    return [
        Launches(
            home,
            workspace,
            tuple(dict.fromkeys(wanted.get(home, ()))),
            frozenset(asked.get(home, ())),
            tuple(packages.get(home, {}).values()),
            files.get(home, {}),
        )
        for home, workspace in opened.items()
    ]


def _kind(given: str, path: str, workspace: Workspace) -> FileKind:
    """What a file is that is named. Raises `CannotDoError` where no check has anything to say of it."""
    kind = file_kind(workspace.sources.db, path)
    if kind is None:
        raise CannotDoError(f"{given} is no file that can be checked; {_CHECKED}")
    if kind in _OF_PACKAGE and workspace.package_of(path) is None:
        raise CannotDoError(f"{given} is in no package, there is no package.xml in its folder or above; {_CHECKED}")
    return kind


def _named_below(folder: str, home: str) -> list[Root]:
    return [root for root in read_project_settings(home).roots if _below(root.path, folder)]


def _roots_below(folder: str, named: Sequence[Root], opened: OpenWorkspace) -> list[Root]:
    # A check of single files starts faster without.
    from preflight_analysis.workspace.index_store import IndexStore, build_from_kept  # noqa: PLC0415

    index = build_from_kept(IndexStore(), opened.workspace, folder, named)
    return sorted(index.entries) if index is not None else []


def _below(path: str, folder: str) -> bool:
    return os.path.commonpath((path, folder)) == folder
