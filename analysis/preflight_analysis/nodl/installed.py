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
from dataclasses import dataclass, replace

from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree
from preflight_analysis.graph.annotations import read_annotation
from preflight_analysis.nodl.read import Described, read_nodl
from preflight_analysis.source.analyse import Texts
from preflight_analysis.tracing.interface import Endpoint, Interface, ParamUse

MAX_INCLUDED = 64
"""Documents that one is made of."""
_INDEX = os.path.join("share", "ament_index", "resource_index", "nodl")
_FILE = re.compile(r"(.+?)(?:\.nodl)?\.(?:yaml|yml|json|xml)\Z")
_WORD = re.compile(r"(?<=[a-z0-9])(?=[A-Z])")


@dataclass(frozen=True, slots=True)
class _Known:
    digests: tuple[tuple[str, str], ...]
    """Of the files that it was made of; "" of one that is not there."""
    said: Described | None


class NodlFiles:
    """Reads the documents of one environment. Which there are is looked up once for each package; what they hold is
    read again when it changes. Thread-safe; raises nothing."""

    def __init__(self, environment: Environment, texts: Texts) -> None:
        self._environment = environment
        self._texts = texts
        self._files: dict[str, tuple[tuple[str, str], ...]] = {}
        self._known: dict[tuple[str, str, int], _Known] = {}
        self._filled: dict[int, tuple[Interface, Described, Interface]] = {}

    def fill_in(self, tree: LaunchTree, interfaces: Sequence[Interface]) -> Sequence[Interface]:
        """The interfaces of the nodes of `tree`, in order; to what a run did not tell to its end is added what a
        document says. Annotations and settings count before it."""
        packages = {node.package for node in tree.nodes}
        with_files = {name for name in packages if self._files_of(name)}
        if not with_files:
            return interfaces
        said: dict[tuple[str, str], Described | None] = {}
        filled = list(interfaces)
        for at, (node, interface) in enumerate(zip(tree.nodes, interfaces, strict=True)):
            if node.package not in with_files or interface.complete or read_annotation(node.action)[0] is not None:
                continue
            key = node.package, _name(node)
            if key not in said:
                said[key] = self._about(*key, tree.generation)
            found = said[key]
            if found is not None:
                filled[at] = self._with(at, interface, found)
        return filled

    def _with(self, at: int, interface: Interface, found: Described) -> Interface:
        """The same object for the same, so that what was made of it is found again."""
        known = self._filled.get(at)
        if known is None or known[1] is not found or known[0] != interface:
            known = interface, found, interface.with_more("nodl", found.endpoints, found.params)
            self._filled[at] = known
        return known[2]

    def _about(self, package: str, name: str, generation: int) -> Described | None:
        key = package, name, generation
        known = self._known.get(key)
        if known is None or any(self._texts.digest(path) != digest for path, digest in known.digests):
            known = self._known[key] = self._read(package, name, generation)
        return known.said

    def _read(self, package: str, name: str, generation: int) -> _Known:
        digests: dict[str, str] = {}
        for stem, path in self._files_of(package):
            if not path.endswith(".xml") and _plain(stem) != _plain(name):
                continue
            for said in self._said(path, generation, digests):
                if said.executable in (None, name):
                    return _Known(tuple(digests.items()), self._whole(said, path, generation, digests))
        return _Known(tuple(digests.items()), None)

    def _said(self, path: str, generation: int, digests: dict[str, str]) -> tuple[Described, ...]:
        digests[path] = self._texts.digest(path)
        document = self._texts.text(path)
        return () if isinstance(document, Unreadable) else read_nodl(path, document.text, generation)

    def _whole(self, said: Described, path: str, generation: int, digests: dict[str, str]) -> Described:
        """With what it includes. A document that cannot be found adds nothing."""
        endpoints: list[Endpoint] = list(said.endpoints)
        params: list[ParamUse] = list(said.params)
        wanted = [(ref, path) for ref in said.includes]
        seen = {path}
        while wanted and len(seen) < MAX_INCLUDED:
            ref, origin = wanted.pop(0)
            place = self._place(ref, origin)
            if place is None or place in seen:
                continue
            seen.add(place)
            for more in self._said(place, generation, digests):
                endpoints += more.endpoints
                params += more.params
                wanted += [(each, place) for each in more.includes]
        return replace(said, endpoints=tuple(endpoints), params=tuple(params), includes=())

    def _place(self, ref: str, origin: str) -> str | None:
        scheme, _, body = ref.partition("://")
        if scheme == "local":
            return os.path.normpath(os.path.join(os.path.dirname(origin), body))
        package, _, name = body.partition("/")
        if scheme != "nodl":
            return None
        return next((path for stem, path in self._files_of(package) if _plain(stem) == _plain(name)), None)

    def _files_of(self, package: str) -> tuple[tuple[str, str], ...]:
        """Name and path of each document of a package, in the order in which they count."""
        files = self._files.get(package)
        if files is None:
            files = self._files[package] = tuple(self._listed(package))
        return files

    def _listed(self, package: str) -> list[tuple[str, str]]:
        found: list[tuple[str, str]] = []
        known = self._environment.packages.get(package)
        if known is not None:
            for folder in (os.path.join(known.share, "nodl"), known.share):
                for name in _names(folder):
                    match = _FILE.match(name)
                    if match and (".nodl." in name or folder != known.share):
                        found.append((match[1], os.path.join(folder, name)))
        for prefix in self._environment.ament_prefixes:
            folder = os.path.join(prefix, _INDEX)
            start = f"{package}__"
            found += [(n.removeprefix(start), os.path.join(folder, n)) for n in _names(folder) if n.startswith(start)]
        return found


def _names(folder: str) -> list[str]:
    try:
        return sorted(os.listdir(folder))
    except OSError:
        return []


def _name(node: LaunchNode) -> str:
    """What the document of a node is named after: its executable, of a component its class."""
    return node.plugin.rpartition("::")[2] if node.plugin else node.executable


def _plain(name: str) -> str:
    """`MinimalPublisher`, `minimal-publisher` and `minimal_publisher.py` are called alike."""
    return _WORD.sub("_", name.removesuffix(".py")).replace("-", "_").lower()
