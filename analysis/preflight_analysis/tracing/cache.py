"""Traces on disk: what a run gave, with everything it depended on, valid for as long as none of that has changed.

The traces of one executable share a folder, whatever its configuration and build were: where a node cannot be run, they
tell what the executable does elsewhere (`similar.py`).
"""

from __future__ import annotations

import contextlib
import dataclasses
import functools
import hashlib
import json
import os
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.typed_json import from_json
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.ros2.remaps import overrides_qos
from preflight_analysis.tracing import nodelets
from preflight_analysis.tracing.dependencies import Dependencies, ParamDependency
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.parameter_server import SharedParams
from preflight_analysis.tracing.recipe import Recipe
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.store import MAX_BYTES, Place, Store, any_changed_since, digest_of, fingerprint, listing

SCHEMA = "ros-preflight/trace-cache/8"
MAX_ENTRY_BYTES = 4 << 20
MOST_OF_ONE_EXECUTABLE = 64
"""How many traces of an executable are looked at for a similar one, the last used."""


@dataclass(frozen=True, slots=True)
class Kept:
    """A trace with what it was made from, which may be out of date.

    `executable` is its path, `build` its fingerprint then, `workspaces` as in its recipe; `given` are the parts of
    names in `interface` that came with the arguments or parameters, as `bare` texts.
    """

    interface: Interface
    node: str
    launch: str | None
    executable: str
    build: str
    args: tuple[str, ...]
    workspaces: tuple[str, ...]
    given: frozenset[str]
    used: float
    """When it was last of use, in seconds since the epoch."""


@dataclass(frozen=True, slots=True)
class _Made:
    """What of a run is kept in its entry: see `Kept`."""

    node: str
    launch: str | None
    executable: str
    args: tuple[str, ...]
    workspaces: tuple[str, ...]
    given: tuple[str, ...]


class TraceCache(Store):
    """Cached interfaces."""

    def __init__(self, folder: Path | None = None, max_bytes: int = MAX_BYTES) -> None:
        super().__init__("traces", SCHEMA, MAX_ENTRY_BYTES, folder, max_bytes)

    def load(self, recipe: Recipe, request: TraceRequest) -> Interface | None:
        """The interface, if a run of this recipe is known and nothing it depended on has changed."""
        view: _View | None = None
        for path, entry in self._entries(self._place(recipe, request)):
            view = view or _View(request, recipe.remapped)
            try:
                if not _valid(entry["dependencies"], view):
                    continue
                interface = from_json(Interface, entry["interface"])
            except (KeyError, TypeError, ValueError, AttributeError):
                continue
            self._used(path)
            return dataclasses.replace(interface, cached=True)
        return None

    def store(
        self,
        recipe: Recipe,
        request: TraceRequest,
        interface: Interface,
        dependencies: Dependencies,
        *,
        listings: Iterable[str] = (),
        started: float,
    ) -> bool:
        """Keep a trace of a run that began at `started` (seconds since the epoch). `listings` are folders whose
        modules it depended on. False if it was not kept: a file has changed since, or the disk refused."""
        view = _View(request, recipe.remapped)
        files = {}
        for path in dict.fromkeys((request.executable, *dependencies.files)):
            files[path] = fingerprint(path)
        if any_changed_since(files, started):
            return False
        known: dict[str, Any] = {
            "files": files,
            "listings": {folder: listing(folder) for folder in listings},
            "params": [[d.access, d.name, d.given, view.look(d)] for d in dependencies.params],
            "asked": {what: view.identity(what) for what in sorted(dependencies.asked)},
        }
        conditions = [known["params"], known["asked"]]
        # For `similar.py`. Of values no more is kept than the interface tells anyway.
        made = _Made(
            request.node,
            request.launch,
            request.executable,
            tuple(request.args),
            tuple(recipe.workspaces),
            tuple(sorted(_given(interface, (*request.args, *view.values(dependencies.params))))),
        )
        entry = {
            "dependencies": known,
            "interface": dataclasses.asdict(interface),
            "made": dataclasses.asdict(made),
        }
        return self._keep(self._place(recipe, request), conditions, entry)

    def traces_of(
        self, generation: int, package: str, executable: str, plugin: str | None
    ) -> tuple[object, tuple[Kept, ...]]:
        """What is kept of an executable (a nodelet: of its plugin), the last used first, and what tells when that has
        changed. The generation of ROS, `package` and the file's name tell which one it is, wherever it is now and
        however often it was built.
        """
        folder = self._executable_folder(generation, package, executable, plugin)
        try:
            state = os.stat(folder).st_mtime_ns
            paths = [path for path in folder.iterdir() if path.suffix == ".json"]
        except OSError:
            return None, ()
        dated = []
        for path in paths:
            with contextlib.suppress(OSError):
                dated.append((path.stat().st_mtime, path))
        kept = (self._kept(path, used) for used, path in sorted(dated, reverse=True)[:MOST_OF_ONE_EXECUTABLE])
        return state, tuple(each for each in kept if each is not None)

    def state_of(self, generation: int, package: str, executable: str, plugin: str | None) -> object:
        """What changes with what `traces_of` gives."""
        # For each executable of a launch after each edit: no `Path` is made.
        digest = _executable_digest(generation, package, executable, plugin)
        try:
            return os.stat(os.path.join(self.folder, digest[:2], digest)).st_mtime_ns
        except OSError:
            return None

    def _kept(self, path: Path, used: float) -> Kept | None:
        entry = self._read(path)
        if entry is None:
            return None
        try:
            made = from_json(_Made, entry["made"])
            return Kept(
                from_json(Interface, entry["interface"]),
                made.node,
                made.launch,
                made.executable,
                str(entry["dependencies"]["files"][made.executable]),
                made.args,
                made.workspaces,
                frozenset(made.given),
                used,
            )
        except (KeyError, TypeError, ValueError, AttributeError):
            return None

    def _executable_folder(self, generation: int, package: str, executable: str, plugin: str | None) -> Path:
        return self._folder_of(_executable_digest(generation, package, executable, plugin))

    def _place(self, recipe: Recipe, request: TraceRequest) -> Place:
        given = request.given_to(None) if request.ros.own_parameters else {}
        named = {
            "executable": os.path.realpath(request.executable),
            "given": request.executable,
            "package": request.package,
            "python": recipe.python,
            "watched": recipe.remapped,
            "interpreter": list(recipe.argv[: recipe.argv.index(request.program)]),
            "args": list(request.args),
            "entry_point": request.entry_point,
            "named": request.named,
            "renames": request.renames,
            "each": request.each,
            "qos": sorted([name, value] for name, value in given.items() if overrides_qos(name)),
            "env": dict(recipe.stable),
            "cwd": recipe.cwd,
            "workspaces": list(recipe.workspaces),
        }
        if request.component is not None:
            named["component"] = dataclasses.asdict(dataclasses.replace(request.component, container_node=""))
        folder = self._executable_folder(request.generation, request.package, name_of(request), part(request))
        return self._place_of(named, folder)


class _View:
    """What a run with this request would find: parameters, names."""

    def __init__(self, request: TraceRequest, remapped: bool) -> None:
        self._node = request.node
        self._remaps = names.resolve_remaps(request.remaps, request.node) if remapped else {}
        params = request.params
        self._tree = (params if isinstance(params, SharedParams) else SharedParams(params)).tree

    def look(self, dependency: ParamDependency) -> str:
        """A digest of the parameter server's answer; "" for nothing there."""
        answer: Any
        if dependency.access == "list":
            answer = sorted(self._tree.names())
        elif dependency.access == "search":
            answer = self._tree.search(self._node, dependency.name)
        else:
            name = dependency.name
            full = names.resolve(name, self._node, self._remaps) if dependency.given else name
            if not self._tree.has(full):
                return ""
            answer = True if dependency.access == "has" else self._tree.get(full)
        return hashlib.sha256(json.dumps(answer, sort_keys=True).encode(errors="surrogatepass")).hexdigest()

    def values(self, looked_at: Iterable[ParamDependency]) -> Iterator[str]:
        """The texts that these looks at the parameter server found."""
        for dependency in looked_at:
            full = names.resolve(dependency.name, self._node, self._remaps) if dependency.given else dependency.name
            if dependency.access == "get" and self._tree.has(full):
                yield from texts(self._tree.get(full))

    def identity(self, what: str) -> Any:
        """The node's name, its namespace or its remaps."""
        if what == "remaps":
            return sorted([source, target] for source, target in self._remaps.items())
        return self._node if what == "name" else names.parent(self._node)


@functools.lru_cache(maxsize=4096)
def _executable_digest(generation: int, package: str, executable: str, plugin: str | None) -> str:
    # Whatever version of this program made them: the traces of other versions are not read, but bounded as well.
    return digest_of({"generation": generation, "package": package, "executable": executable, "plugin": plugin})


def _valid(known: Mapping[str, Any], view: _View) -> bool:
    return (
        all(view.identity(what) == value for what, value in known["asked"].items())
        and all(view.look(ParamDependency(a, n, bool(g))) == digest for a, n, g, digest in known["params"])
        and all(fingerprint(path) == value for path, value in known["files"].items())
        and all(listing(folder) == value for folder, value in known["listings"].items())
    )


def name_of(request: TraceRequest) -> str:
    """What an executable is known by, wherever it is: a component by its class, as the library may not be there."""
    return request.component.plugin if request.component is not None else os.path.basename(request.executable)


def part(request: TraceRequest) -> str | None:
    """Which of the things that one file can run: a nodelet, an entry point, a component."""
    if request.component is not None:
        return "component"
    return request.entry_point or nodelets.plugin(request)


def texts(value: Any) -> Iterator[str]:
    """The texts in a parameter's value."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, Mapping):
        for item in value.values():
            yield from texts(item)
    elif isinstance(value, (list, tuple)):
        for item in value:
            yield from texts(item)


def bare(text: str) -> str:
    """A text as a part of names: what an argument `_topic:=/scan` gives is `scan`."""
    return text.rpartition(":=")[2].strip("/~")


def _given(interface: Interface, said: Iterable[str]) -> set[str]:
    """The bare texts of `said` that are whole parts of names in the interface."""
    found = {f"/{e.name.strip('/~')}/" for e in interface.endpoints if not e.builtin}
    return {text for text in map(bare, said) if text and any(f"/{text}/" in name for name in found)}
