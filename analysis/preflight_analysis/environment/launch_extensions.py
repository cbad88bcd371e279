"""Tags that packages add to the XML and YAML launch language of ROS 2.

A package with the entry point `launch.frontend.launch_extension` is imported by launch before it parses the first
file, and each `@expose_action('tag')` in it defines one.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping
from functools import lru_cache

from preflight_analysis.documents.reading import Text, read_text
from preflight_analysis.environment.model import Environment

_GROUP = "launch.frontend.launch_extension"
_SETUP = ("setup.cfg", "setup.py", "pyproject.toml")
_EXPOSED = re.compile(r"@expose_action\(\s*['\"]([^'\"]+)['\"]\s*\)")
_OWN = frozenset({"launch", "launch_ros"})
"""What these expose is the language itself."""
_MAX_FILES = 500
"""Of one package, with its folders: what a file of the workspace names may be anything."""


def exposed_actions(environment: Environment) -> Mapping[str, str]:
    """The tags of all extensions that the environment has, each with the package that defines it."""
    shares = tuple((name, package.share) for name, package in sorted(environment.packages.items()) if name not in _OWN)
    return _exposed(shares, environment.ament_prefixes, tuple(_signatures(shares)))


def _signatures(shares: tuple[tuple[str, str], ...]) -> Iterator[tuple[int, int] | None]:
    """What changes when a package becomes an extension, or exposes another tag."""
    for name, share in shares:
        for path in (*(os.path.join(share, setup) for setup in _SETUP), os.path.join(share, name)):
            try:
                status = os.stat(path)
            except OSError:
                continue
            yield status.st_mtime_ns, status.st_size


@lru_cache(maxsize=4)
def _exposed(shares: tuple[tuple[str, str], ...], prefixes: tuple[str, ...], _: object) -> Mapping[str, str]:
    found: dict[str, str] = {}
    for name, share in shares:
        if name.isidentifier() and any(_GROUP in _text(os.path.join(share, setup)) for setup in _SETUP):
            for folder in (os.path.join(share, name), os.path.join(share, "src", name)):
                found.update(dict.fromkeys(_tags_of(folder), name))
    for prefix in prefixes:
        for folder, name in _installed(prefix):
            if name not in _OWN:
                found.update(dict.fromkeys(_tags_of(folder), name))
    return found


def _installed(prefix: str) -> Iterator[tuple[str, str]]:
    """The modules of a prefix that are extensions, with their names."""
    for version in _listed(os.path.join(prefix, "lib")):
        site = os.path.join(prefix, "lib", version, "site-packages")
        for folder in _listed(site) if version.startswith("python3") else ():
            if folder.endswith((".egg-info", ".dist-info")):
                _, group, below = _text(os.path.join(site, folder, "entry_points.txt")).partition(f"[{_GROUP}]")
                for line in below.partition("\n[")[0].splitlines() if group else ():
                    module = line.partition("=")[2].strip().partition(":")[0].partition(".")[0]
                    if module.isidentifier():
                        yield os.path.join(site, module), module


def _tags_of(folder: str) -> Iterator[str]:
    count = 0
    for place, folders, names in os.walk(folder):
        folders.sort()
        programs = sorted(name for name in names if name.endswith(".py"))
        count += 1 + len(programs)
        if count > _MAX_FILES:
            return
        for name in programs:
            yield from _EXPOSED.findall(_text(os.path.join(place, name)))


def _listed(folder: str) -> list[str]:
    try:
        return sorted(os.listdir(folder))
    except OSError:
        return []


def _text(path: str) -> str:
    found = read_text(path)
    return found.text if isinstance(found, Text) else ""
