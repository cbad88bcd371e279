"""What a node may do by the runs of the same executable under other configurations: "similar" traces, after Witte and
Tichy.

They are used where a run of the node itself does not tell. Which executable it is tells its package and name; a trace
of another build counts as long as that was found at the same path. One that was made for another workspace never
counts: a package of the same name may be somebody else's, and lie. Names that came with the other run's arguments or
parameters and that this node is not given are left out: nobody knows what it has instead.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.tracing import nodelets
from preflight_analysis.tracing.cache import Kept, TraceCache, bare, part, texts
from preflight_analysis.tracing.interface import Elsewhere, Interface
from preflight_analysis.tracing.request import TraceRequest, split_args
from preflight_analysis.tracing.store import fingerprint

_MAX_REMEMBERED = 4096

_Key = tuple[int, str, str, "str | None"]


@dataclass(frozen=True, slots=True)
class _Memo:
    """What was told of one node, and all that it rests on."""

    traces: tuple[Kept, ...]
    build: str
    given: frozenset[str]
    """Texts that the names of the run came with."""
    strange: frozenset[str]
    """Those of them that this node is not given."""
    found: Interface | None


@dataclass(frozen=True, slots=True)
class Asked:
    """A node as it is looked for. `path` is that of its executable, "" where there is none; `args` are its arguments as
    written, `traces` names those of its executable."""

    path: str
    args: str
    request: TraceRequest
    traces: _Key


def asked(node: LaunchNode, generation: int) -> Asked:
    """`generation` is that of ROS: the other one may have a node of the same name."""
    path = node.resolved.path or ""
    executable, args, entry_point = path or node.executable, split_args(node.args), node.resolved.entry_point
    request = nodelets.standalone(
        TraceRequest(node.name, node.package, executable, args, generation=generation, entry_point=entry_point)
    )
    return Asked(path, node.args, request, (generation, node.package, os.path.basename(executable), part(request)))


class SimilarTraces:
    """Looks for them in a cache, for one environment; what was read is remembered until the cache changes.
    Thread-safe; runs nothing."""

    def __init__(self, cache: TraceCache, environment: Environment) -> None:
        self._cache = cache
        self._folders = frozenset((*environment.workspace_folders, *environment.named_folders))
        self._lock = threading.Lock()
        self._remembered: dict[_Key, tuple[object, tuple[Kept, ...]]] = {}
        self._memos: dict[tuple[int, str, str, str, str], _Memo] = {}

    def looking(self, params: Mapping[str, Any]) -> Callable[[Asked], Interface | None]:
        """What the executable of a node did in the most similar run; None where none is known. `params` is the
        parameter server of the launch. The names are as the node would give them, everything is marked `similar`.

        For the nodes of one launch, each as `asked` has it: the disk is asked once for each executable.
        """
        said: list[frozenset[str]] = []
        known: dict[_Key, tuple[Kept, ...]] = {}
        builds: dict[str, str] = {}

        def of(node: Asked) -> Interface | None:
            traces = known.get(node.traces)
            if traces is None:
                traces = known[node.traces] = self._traces(node.traces)
            if not traces:
                return None
            if node.path not in builds:
                builds[node.path] = fingerprint(node.path)
            if not said and any(kept.given for kept in traces):
                said.append(frozenset(map(bare, texts(params))))
            return self._of(node, traces, builds[node.path], said[0] if said else frozenset())

        return of

    def _of(self, node: Asked, traces: tuple[Kept, ...], build: str, said: frozenset[str]) -> Interface | None:
        path, request = node.path, node.request
        key = (
            request.generation,
            request.node,
            request.package,
            f"{request.executable}:{request.entry_point}",
            node.args,
        )
        memo = self._memos.get(key)
        if memo is not None and memo.traces is traces and memo.build == build and memo.strange == memo.given - said:
            return memo.found
        candidates = [
            kept
            for kept in traces
            if _reports(kept.interface)
            and self._folders.issuperset(kept.workspaces)
            and (not path or kept.executable == path or kept.build == build)
        ]
        given: frozenset[str] = frozenset()
        found = None
        if candidates:
            best = max(candidates, key=lambda kept: _likeness(kept, request, build))
            given = best.given - frozenset(map(bare, request.args))
            elsewhere = Elsewhere(best.node, best.launch, best.build != build)
            as_of = replace(_as_of(best, request, given - said), elsewhere=elsewhere)
            found = as_of if as_of.endpoints or as_of.params else None
        with self._lock:
            self._memos[key] = _Memo(traces, build, given, given - said, found)
            if len(self._memos) > _MAX_REMEMBERED:
                del self._memos[next(iter(self._memos))]
        return found

    def _traces(self, key: _Key) -> tuple[Kept, ...]:
        known = self._remembered.get(key)
        if known is None or known[0] != self._cache.state_of(*key):
            known = self._cache.traces_of(*key)
            with self._lock:
                self._remembered[key] = known
                if len(self._remembered) > _MAX_REMEMBERED:
                    del self._remembered[next(iter(self._remembered))]
        return known[1]


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
        replace(endpoint, name=_private(endpoint.name, kept, request), similar=True)
        for endpoint in kept.interface.endpoints
        if not any(text in f"/{endpoint.name.strip('/~')}/" for text in strange)
    )
    params = tuple(replace(use, name=_private(use.name, kept, request), similar=True) for use in kept.interface.params)
    return replace(kept.interface, source="similar", endpoints=endpoints, params=params)


def _private(name: str, kept: Kept, request: TraceRequest) -> str:
    """A name that holds that of the other node, as the master or a node that asked for its name tells it, as a private
    one."""
    below = name.removeprefix(f"{kept.node}/")
    return f"~{below}" if below != name and kept.node != request.node else name
