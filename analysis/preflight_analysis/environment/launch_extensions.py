"""Tags that packages add to the XML and YAML launch language of ROS 2.

A package with the entry point `launch.frontend.launch_extension` is imported by launch before it parses the first
file, and each `@expose_action('tag')` in it defines one.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.model import Environment
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query

_GROUP = "launch.frontend.launch_extension"
_SETUP = ("setup.cfg", "setup.py", "pyproject.toml")
_EXPOSED = re.compile(r"@expose_action\(\s*['\"]([^'\"]+)['\"]\s*\)")
_OWN = frozenset({"launch", "launch_ros"})
"""What these expose is the language itself."""
_MAX_FILES = 500
"""Of one package, with its folders: what a file of the workspace names may be anything."""


def exposed_actions(disk: Disk, environment: Environment) -> Mapping[str, str]:
    """The tags of all extensions that the environment has, each with the package that defines it."""
    return _exposed(disk.db, environment)


@query
def _exposed(db: Database, environment: Environment) -> Mapping[str, str]:
    disk = Disk(db)
    found: dict[str, str] = {}
    for name, package in sorted(environment.packages.items()):
        if name not in _OWN and name.isidentifier() and _is_extension(disk, package.share):
            for folder in (os.path.join(package.share, name), os.path.join(package.share, "src", name)):
                found.update(dict.fromkeys(_tags_of(disk, folder), name))
    for prefix in environment.ament_prefixes:
        for folder, name in _installed(disk, prefix):
            if name not in _OWN:
                found.update(dict.fromkeys(_tags_of(disk, folder), name))
    return found


def _is_extension(disk: Disk, share: str) -> bool:
    return any(_GROUP in (disk.content(os.path.join(share, setup)) or "") for setup in _SETUP)


def _installed(disk: Disk, prefix: str) -> Iterator[tuple[str, str]]:
    """The modules of a prefix that are extensions, with their names."""
    for version in disk.names(os.path.join(prefix, "lib")):
        site = os.path.join(prefix, "lib", version, "site-packages")
        for folder in disk.names(site) if version.startswith("python3") else ():
            if folder.endswith((".egg-info", ".dist-info")):
                _, group, below = (disk.content(os.path.join(site, folder, "entry_points.txt")) or "").partition(
                    f"[{_GROUP}]"
                )
                for line in below.partition("\n[")[0].splitlines() if group else ():
                    module = line.partition("=")[2].strip().partition(":")[0].partition(".")[0]
                    if module.isidentifier():
                        yield os.path.join(site, module), module


def _tags_of(disk: Disk, folder: str) -> Iterator[str]:
    count, pending = 0, [folder]
    while pending:
        place = pending.pop()
        names = disk.names(place)
        programs = [name for name in names if name.endswith(".py")]
        count += 1 + len(programs)
        if count > _MAX_FILES:
            return
        for name in programs:
            yield from _EXPOSED.findall(disk.content(os.path.join(place, name)) or "")
        inner = (os.path.join(place, name) for name in reversed(names) if not name.endswith(".py"))
        pending += (path for path in inner if disk.is_folder(path) and not disk.is_link(path))
