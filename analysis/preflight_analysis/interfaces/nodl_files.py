"""The NoDL documents of packages, and what they say of the nodes of a launch.

https://github.com/ros-tooling/nodl: `ament_nodl_register` puts a document into the ament index as
`nodl/<package>__<name>` and into `share/<package>/nodl`; in a source folder it lies wherever its author likes, `nodl/`
in the documentation. A document does not say which node it is about, "the file's location" does: it is taken to be
that of the executable, or of the component, of its name.
"""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from dataclasses import replace

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.interfaces.nodl_read import Described, read_nodl
from preflight_analysis.tracing.interface import Endpoint, ParamUse

MAX_INCLUDED = 64
"""Documents that one is made of."""
_INDEX = os.path.join("share", "ament_index", "resource_index", "nodl")
_FILE = re.compile(r"(.+?)(?:\.nodl)?\.(?:yaml|yml|json|xml)\Z")
_WORD = re.compile(r"(?<=[a-z0-9])(?=[A-Z])")


def nodl_of(
    generation: int, environment: Environment, disk: Disk, nodes: Sequence[LaunchNode]
) -> tuple[Described | None, ...]:
    """What the document of each node says, None where there is none."""
    having = {name for name in {node.package for node in nodes} if _files_of(disk.db, environment, name)}
    return tuple(
        _about(disk.db, environment, node.package, _name(node), generation) if node.package in having else None
        for node in nodes
    )


@query
def _about(db: Database, environment: Environment, package: str, name: str, generation: int) -> Described | None:
    """What is said of a node: of an executable, or of a component."""
    for stem, path in _files_of(db, environment, package):
        if not path.endswith(".xml") and _plain(stem) != _plain(name):
            continue
        for said in _said(db, path, generation):
            if said.executable in (None, name):
                return _whole(db, environment, said, path, generation)
    return None


@query
def _said(db: Database, path: str, generation: int) -> tuple[Described, ...]:
    document = Disk(db).text(path)
    return () if isinstance(document, Unreadable) else tuple(read_nodl(path, document.text, generation))


def _whole(db: Database, environment: Environment, said: Described, path: str, generation: int) -> Described:
    """With what it includes. A document that cannot be found adds nothing."""
    endpoints: list[Endpoint] = list(said.endpoints)
    params: list[ParamUse] = list(said.params)
    wanted = [(ref, path) for ref in said.includes]
    seen = {path}
    while wanted and len(seen) < MAX_INCLUDED:
        ref, origin = wanted.pop(0)
        place = _place(db, environment, ref, origin)
        if place is None or place in seen:
            continue
        seen.add(place)
        for more in _said(db, place, generation):
            endpoints += more.endpoints
            params += more.params
            wanted += [(each, place) for each in more.includes]
    return replace(said, endpoints=tuple(endpoints), params=tuple(params), includes=())


def _place(db: Database, environment: Environment, ref: str, origin: str) -> str | None:
    scheme, _, body = ref.partition("://")
    if scheme == "local":
        return os.path.normpath(os.path.join(os.path.dirname(origin), body))
    package, _, name = body.partition("/")
    if scheme != "nodl":
        return None
    files = _files_of(db, environment, package)
    return next((path for stem, path in files if _plain(stem) == _plain(name)), None)


@query
def _files_of(db: Database, environment: Environment, package: str) -> tuple[tuple[str, str], ...]:
    """Name and path of each document of a package, in the order in which they count."""
    disk, found = Disk(db), list[tuple[str, str]]()
    known = environment.packages.get(package)
    if known is not None:
        for folder in (os.path.join(known.share, "nodl"), known.share):
            for name in disk.names(folder):
                match = _FILE.match(name)
                if match and (".nodl." in name or folder != known.share):
                    found.append((match[1], os.path.join(folder, name)))
    for prefix in environment.ament_prefixes:
        folder = os.path.join(prefix, _INDEX)
        start = f"{package}__"
        listed = (name for name in disk.names(folder) if name.startswith(start))
        found += ((name.removeprefix(start), os.path.join(folder, name)) for name in listed)
    return tuple(found)


def _name(node: LaunchNode) -> str:
    """What the document of a node is named after: its executable, of a component its class."""
    return node.plugin.rpartition("::")[2] if node.plugin else node.executable


def _plain(name: str) -> str:
    """`MinimalPublisher`, `minimal-publisher` and `minimal_publisher.py` are called alike."""
    return _WORD.sub("_", name.removesuffix(".py")).replace("-", "_").lower()
