"""Traces on disk: what a run gave, with everything it depended on, valid for as long as none of that has changed."""

from __future__ import annotations

import dataclasses
import hashlib
import json
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from preflight_analysis.evaluation import names
from preflight_analysis.tracing.agents.params import ParamTree
from preflight_analysis.tracing.interface import Endpoint, Frame, Interface, Outcome, ParamUse
from preflight_analysis.tracing.observation import Dependencies, ParamDependency
from preflight_analysis.tracing.recipe import Recipe
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.run import encode_params
from preflight_analysis.tracing.store import MAX_BYTES, Store, changed_since, fingerprint, listing

SCHEMA = "ros-preflight/trace-cache/2"
MAX_ENTRY_BYTES = 4 << 20


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
                interface = _decode(entry["interface"])
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
            if changed_since(path, started):
                return False
        known: dict[str, Any] = {
            "files": files,
            "listings": {folder: listing(folder) for folder in listings},
            "params": [[d.access, d.name, d.given, view.look(d)] for d in dependencies.params],
            "asked": {what: view.identity(what) for what in sorted(dependencies.asked)},
        }
        conditions = [known["params"], known["asked"]]
        entry = {"dependencies": known, "interface": _encode(interface)}
        return self._keep(self._place(recipe, request), conditions, entry)

    def _place(self, recipe: Recipe, request: TraceRequest) -> Path:
        named = {
            "executable": os.path.realpath(request.executable),
            "given": request.executable,
            "package": request.package,
            "python": recipe.python,
            "watched": recipe.remapped,
            "interpreter": list(recipe.argv[: recipe.argv.index(request.executable)]),
            "args": list(request.args),
            "env": dict(recipe.stable),
            "cwd": recipe.cwd,
        }
        return self._folder_of(named)


class _View:
    """What a run with this request would find: parameters, names."""

    def __init__(self, request: TraceRequest, remapped: bool) -> None:
        self._node = request.node
        self._remaps = names.resolve_remaps(request.remaps, request.node) if remapped else {}
        self._tree = ParamTree()
        for name, value in encode_params(request.params):
            self._tree.set(name, value)

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

    def identity(self, what: str) -> Any:
        """The node's name, its namespace or its remaps."""
        if what == "remaps":
            return sorted([source, target] for source, target in self._remaps.items())
        return self._node if what == "name" else names.parent(self._node)


def _valid(known: Mapping[str, Any], view: _View) -> bool:
    return (
        all(view.identity(what) == value for what, value in known["asked"].items())
        and all(view.look(ParamDependency(a, n, bool(g))) == digest for a, n, g, digest in known["params"])
        and all(fingerprint(path) == value for path, value in known["files"].items())
        and all(listing(folder) == value for folder, value in known["listings"].items())
    )


def _encode(interface: Interface) -> dict[str, Any]:
    return dataclasses.asdict(interface)


def _decode(data: Mapping[str, Any]) -> Interface:
    outcome = dict(data["outcome"])
    outcome["stderr_tail"] = tuple(outcome["stderr_tail"])
    outcome["answers"] = tuple(outcome["answers"])
    return Interface(
        data["source"],
        Outcome(**outcome),
        tuple(Endpoint(**endpoint) for endpoint in data["endpoints"]),
        tuple(ParamUse(**use) for use in data["params"]),
        notes=tuple(data["notes"]),
        frames=tuple(Frame(**frame) for frame in data["frames"]),
    )
