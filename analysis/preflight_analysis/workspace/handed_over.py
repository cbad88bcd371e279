"""Which launches hand a file over that no launch file includes: a robot description, or a behavior tree."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator

from preflight_analysis.documents.document import Document
from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.environment.model import Environment
from preflight_analysis.environment.package_files import files_in
from preflight_analysis.workspace.index import Root, WorkspaceIndex
from preflight_analysis.workspace.sources import Sources

_MOST_PACKAGES = 60
"""Of more packages only the one around the file is searched for files that include it."""
_MOST_NAMES = 30
_MOST_ROOTS = 2
"""A file that many launches name is looked at in the first of them: each takes an evaluation."""
_INCLUDE = (".xacro", ".urdf", ".srdf", ".xml")


def roots_naming(index: WorkspaceIndex, sources: Sources, environment: Environment, path: str) -> tuple[Root, ...]:
    """The first roots of which a launch file, or a file of parameters, has the name of the file in its text, or the
    name of one that includes it; those in the file's own package first. Whether they read it, their evaluation says.
    It reads files, all of some packages at the first call."""
    own = package_around(environment, path)
    naming = _naming(_names(sources, environment, path))
    found = [
        root
        for root, entry in index.entries.items()
        if path not in entry.files
        and any(naming.search(text) for text in _texts(sources, (*entry.files, *entry.inputs)))
    ]
    found.sort(key=lambda root: (own is None or not root.path.startswith(own.share.rstrip("/") + "/"), root))
    return tuple(found[:_MOST_ROOTS])


def _names(sources: Sources, environment: Environment, path: str) -> list[str]:
    """The names of a file and of those that include it, and so on."""
    own = package_around(environment, path)
    packages = environment.own_packages
    if len(packages) > _MOST_PACKAGES:
        packages = [own] if own is not None else []
    files = [
        file
        for package in packages
        for file in files_in(sources, package.share, deep=True)
        if file.endswith(_INCLUDE) and os.path.basename(file) != "package.xml"
    ]
    names = [os.path.basename(path)]
    while len(names) < _MOST_NAMES:
        naming = _naming(names)
        including = {os.path.basename(f) for f in files if any(naming.search(text) for text in _texts(sources, [f]))}
        more = sorted(including.difference(names))
        if not more:
            break
        names += more
    return names


def _naming(names: Iterable[str]) -> re.Pattern[str]:
    return re.compile(rf"(?<![\w.-])(?:{'|'.join(map(re.escape, names))})(?![\w.-])")


def _texts(sources: Sources, paths: Iterable[str]) -> Iterator[str]:
    for path in dict.fromkeys(paths):
        if isinstance(found := sources.text(path), Document):
            yield found.text
