"""What a check launches: the files that are named, or all that a folder has."""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence

from preflight_analysis.dataclass import dataclass
from preflight_analysis.environment.detect import workspace_of
from preflight_analysis.environment.model import Package
from preflight_analysis.workspace.index import Root
from preflight_analysis.workspace.project_settings import read_project_settings

from preflight_server.cli import options
from preflight_server.cli.errors import CannotDoError, require
from preflight_server.cli.project import OpenWorkspace, open_workspace


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
    """Those of ROS 2 in the folders that are named."""


def launches(args: argparse.Namespace) -> list[Launches]:
    """What `args.launch_args` name, by workspace; the current folder where they name nothing.

    A file is launched as it is, with the arguments `name:=value`. Of a folder each file that nothing includes is, and
    what the settings name, once with each of their profiles of arguments. Raises `CannotDoError` for a path that does
    not exist, and for a folder without launch files and packages.
    """
    values = [each for each in args.launch_args if ":=" in each]
    paths = [each for each in args.launch_args if ":=" not in each]
    if not paths and values:
        raise CannotDoError("name:=value is for a launch file, and none is named")
    wanted: dict[str, list[Root]] = {}
    asked: dict[str, set[Root]] = {}
    packages: dict[str, dict[str, Package]] = {}
    opened: dict[str, OpenWorkspace] = {}
    for given in paths or ["."]:
        path = require(given)
        folder = os.path.isdir(path)
        home = workspace_of(os.path.join(path, "_") if folder else path)
        if home not in opened:
            opened[home] = open_workspace(options.environment(args, home), args)
        if folder and values:
            raise CannotDoError(f"{given} is a folder; arguments for its launch files stand in .ros-preflight.yaml")
        named = _named_below(path, home) if folder else [Root.of(path, options.launch_args(values, path))]
        found = _roots_below(path, named, opened[home]) if folder else named
        own = opened[home].workspace.environment.own_packages if folder else ()
        below = {each.share: each for each in own if each.is_ament and _below(each.share, path)}
        if not found and not below:
            raise CannotDoError(f"there are no launch files in {given}")
        packages.setdefault(home, {}).update(below)
        wanted.setdefault(home, []).extend(found)
        asked.setdefault(home, set()).update(named)
    return [
        Launches(
            home, opened[home], tuple(dict.fromkeys(roots)), frozenset(asked[home]), tuple(packages[home].values())
        )
        for home, roots in wanted.items()
    ]


def _named_below(folder: str, home: str) -> list[Root]:
    return [root for root in read_project_settings(home).roots if _below(root.path, folder)]


def _roots_below(folder: str, named: Sequence[Root], opened: OpenWorkspace) -> list[Root]:
    # A check of single files starts faster without.
    from preflight_analysis.workspace.index_store import IndexStore, build_from_kept  # noqa: PLC0415

    index = build_from_kept(IndexStore(), opened.workspace, folder, named)
    return sorted(index.entries) if index is not None else []


def _below(path: str, folder: str) -> bool:
    return os.path.commonpath((path, folder)) == folder
