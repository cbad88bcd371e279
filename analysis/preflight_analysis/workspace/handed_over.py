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
"""Of more packages only the one around the file is searched for files that include it; that of a behavior tree in any
case."""
_MOST_NAMES = 30
_MOST_ROOTS = 2
"""A file that many launches name is looked at in the first of them: each takes an evaluation."""
ROBOTS = (".xacro", ".urdf", ".srdf")
"""The ends of the names of robot descriptions."""
_DESCRIBES = re.compile(r"robot_description|xacro")


def roots_naming(index: WorkspaceIndex, sources: Sources, environment: Environment, path: str) -> tuple[Root, ...]:
    """The first roots of which a launch file, or a file of parameters, has the name of the file in its text, or the
    name of one that includes it; those in the file's own package first. Where none has, the name of a robot description
    may be put together: those that speak of one and of the file's package. Whether they read it, their evaluation says.
    It reads files, all of some packages at the first call."""
    own = package_around(environment, path)
    naming = _naming(_names(sources, environment, path))
    found = [root for root in index.entries if _has(index, sources, root, path, naming)]
    if not found and own is not None and path.endswith(ROBOTS):
        speaking = (_DESCRIBES, _naming([own.name]))
        found = [root for root in index.entries if all(_has(index, sources, root, path, each) for each in speaking)]
    found.sort(key=lambda root: (own is None or not root.path.startswith(own.share.rstrip("/") + "/"), root))
    return tuple(found[:_MOST_ROOTS])


def _has(index: WorkspaceIndex, sources: Sources, root: Root, path: str, pattern: re.Pattern[str]) -> bool:
    """Whether a file of a root has the pattern in its text, and the file at `path` is none that it launches."""
    entry = index.entries[root]
    texts = _texts(sources, (*entry.files, *entry.inputs))
    return path not in entry.files and any(pattern.search(text) for text in texts)


def _names(sources: Sources, environment: Environment, path: str) -> list[str]:
    """The names of a file and of those that include it, and so on."""
    own = package_around(environment, path)
    packages = environment.own_packages
    suffixes = ROBOTS if path.endswith(ROBOTS) else (".xml",)
    if len(packages) > _MOST_PACKAGES or suffixes != ROBOTS:
        packages = [own] if own is not None else []
    files = [file for package in packages for file in files_in(sources, package.share, deep=True)]
    files = [file for file in files if file.endswith(suffixes)]
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
