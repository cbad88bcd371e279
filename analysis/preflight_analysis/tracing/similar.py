"""What a node may do by the runs of the same executable under other configurations: "similar" traces, after Witte and
Tichy.

They are used where a run of the node itself does not tell. Which executable it is tells its package and name; a trace
of another build counts as long as that was found at the same path. One that was made for another workspace never
counts: a package of the same name may be somebody else's, and lie. Names that came with the other run's arguments or
parameters and that this node is not given are left out: nobody knows what it has instead.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import field, replace
from typing import Any

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.disk import STATUS, Disk
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import Input, query
from preflight_analysis.tracing import nodelets
from preflight_analysis.tracing.cache import Kept, TraceCache, bare, name_of, part, texts
from preflight_analysis.tracing.interface import Elsewhere, Interface
from preflight_analysis.tracing.request import Component, TraceRequest, split_args
from preflight_analysis.tracing.store import fingerprint

_MAX_REMEMBERED = 4096

_Key = tuple[int, str, str, "str | None"]


@dataclass(frozen=True, slots=True)
class Asked:
    """A node as it is looked for: by its full name, with its arguments as written. `path` is that of its executable, ""
    where there is none, `traces` names those of its executable."""

    path: str
    name: str
    args: str
    request: TraceRequest = field(compare=False)
    traces: _Key


def asked(node: LaunchNode, generation: int) -> Asked:
    """`generation` is that of ROS: the other one may have a node of the same name."""
    path = node.resolved.path or ""
    executable, args, entry_point = path or node.executable, split_args(node.args), node.resolved.entry_point
    component = Component(node.plugin) if node.kind == "composable" and node.plugin is not None else None
    request = nodelets.alone(
        TraceRequest(
            node.name,
            node.package,
            executable,
            args,
            generation=generation,
            entry_point=entry_point,
            component=component,
        )
    )
    return Asked(path, node.name, node.args, request, (generation, node.package, name_of(request), part(request)))


@dataclass(frozen=True, slots=True)
class _Best:
    """The most similar run of a node."""

    kept: Kept
    given: frozenset[str]
    """Texts that its names came with, which are not among the node's own arguments."""
    of_another_build: bool


class SimilarTraces:
    """Looks for them in a cache, for one environment. Thread-safe; runs nothing. What it found is remembered by the
    database of `disk`."""

    def __init__(self, cache: TraceCache, environment: Environment, disk: Disk | None = None) -> None:
        self.cache = cache
        self.folders = frozenset((*environment.workspace_folders, *environment.named_folders))
        self._disk = disk or Disk()

    def each(self, nodes: Sequence[Asked], params: Mapping[str, Any]) -> list[Interface | None]:
        """What the executable of each node did in the most similar run; None where none is known. `params` is the
        parameter server of the launch. The names are as the node would give them.

        The disk is asked once for each executable, and again by `look`.
        """
        db = self._disk.db

        def work() -> list[Interface | None]:
            known = {traces for traces in {node.traces for node in nodes} if _traces(db, self.cache, traces)}
            said: list[frozenset[str]] = []
            return [self._of(node, params, said) if node.traces in known else None for node in nodes]

        return db.in_one_revision(work)

    def _of(self, node: Asked, params: Mapping[str, Any], said: list[frozenset[str]]) -> Interface | None:
        """`said` are the texts of the parameters, gathered for the first node that needs them."""
        db = self._disk.db
        best = _best(db, self, node)
        if best is None:
            return None
        if best.given and not said:
            said.append(frozenset(map(bare, texts(params))))
        return _similar(db, self, node, best.given - said[0] if best.given else best.given)

    def look(self) -> None:
        """Notice what runs have told since."""
        db = self._disk.db
        outdated = db.outdated(_STATE)
        if outdated:
            with db.writing() as write:
                for key in outdated:
                    write.reload(_STATE, *key)


def _state(cache: TraceCache, key: _Key) -> object:
    return cache.state_of(*key)


_STATE = Input(_state, durable=False)
"""What changes with what the cache has of an executable."""


@query(limit=_MAX_REMEMBERED)
def _traces(db: Database, cache: TraceCache, key: _Key) -> tuple[Kept, ...]:
    _STATE(db, cache, key)
    return cache.traces_of(*key)[1]


@query
def _build(db: Database, path: str) -> str:
    STATUS(db, path)
    return fingerprint(path)


@query(limit=_MAX_REMEMBERED)
def _best(db: Database, similar: SimilarTraces, node: Asked) -> _Best | None:
    traces = _traces(db, similar.cache, node.traces)
    if not traces:
        return None
    build = _build(db, node.path)
    candidates = [
        kept
        for kept in traces
        if _reports(kept.interface)
        and similar.folders.issuperset(kept.workspaces)
        and (not node.path or kept.executable == node.path or kept.build == build)
    ]
    if not candidates:
        return None
    best = max(candidates, key=lambda kept: _likeness(kept, node.request, build))
    return _Best(best, best.given - frozenset(map(bare, node.request.args)), best.build != build)


@query(limit=_MAX_REMEMBERED)
def _similar(db: Database, similar: SimilarTraces, node: Asked, strange: frozenset[str]) -> Interface | None:
    """`strange` are the texts in names of the run that this node is not given."""
    best = _best(db, similar, node)
    if best is None:
        return None
    elsewhere = Elsewhere(best.kept.node, best.kept.launch, best.of_another_build)
    found = replace(_as_of(best.kept, node.request, strange), elsewhere=elsewhere)
    return found if found.endpoints or found.params else None


def _reports(interface: Interface) -> bool:
    """Whether a run came to an end of its own and shows anything but what every node has: one that printed its usage
    does not."""
    own = any(not endpoint.builtin for endpoint in interface.endpoints) or any(not p.builtin for p in interface.params)
    return own and interface.outcome.status in ("spinning", "exited")


def _likeness(kept: Kept, request: TraceRequest, build: str) -> tuple[bool, bool, bool, bool, float]:
    """The more alike, the greater."""
    return (
        kept.build == build,
        kept.interface.complete,
        kept.args == request.args,
        kept.node == request.node,
        kept.used,
    )


def _as_of(kept: Kept, request: TraceRequest, unsaid: Iterable[str]) -> Interface:
    """The trace as one of this node, without names that came with the texts `unsaid`."""
    strange = [f"/{text}/" for text in unsaid]
    endpoints = tuple(
        replace(endpoint, name=_private(endpoint.name, kept, request))
        for endpoint in kept.interface.endpoints
        if not any(text in f"/{endpoint.name.strip('/~')}/" for text in strange)
    )
    params = tuple(replace(use, name=_private(use.name, kept, request)) for use in kept.interface.params)
    return replace(kept.interface, source="similar", endpoints=endpoints, params=params)


def _private(name: str, kept: Kept, request: TraceRequest) -> str:
    """A name that holds that of the other node, as the master or a node that asked for its name tells it, as a private
    one."""
    below = name.removeprefix(f"{kept.node}/")
    return f"~{below}" if below != name and kept.node != request.node else name
