"""What a node may do by the runs of the same executable under other configurations: "similar" traces, after Witte and
Tichy.

They are used where a run of the node itself does not tell. Which executable it is tells its package and name; a trace
of another build counts as long as that was found at the same path. Names that came with the other run's arguments or
parameters and that this node is not given are left out: nobody knows what it has instead.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.tracing import nodelets
from preflight_analysis.tracing.cache import Kept, TraceCache, bare, texts
from preflight_analysis.tracing.interface import Elsewhere, Interface
from preflight_analysis.tracing.request import TraceRequest, split_args
from preflight_analysis.tracing.store import fingerprint

_MAX_REMEMBERED = 1024

_Key = tuple[str, str, "str | None"]


class SimilarTraces:
    """Looks for them in a cache; what was read is remembered until the cache changes. Thread-safe; runs nothing."""

    def __init__(self, cache: TraceCache) -> None:
        self._cache = cache
        self._lock = threading.Lock()
        self._remembered: dict[_Key, tuple[object, tuple[Kept, ...]]] = {}

    def of(self, node: LaunchNode, params: Mapping[str, Any]) -> Interface | None:
        """What the executable of the node did in the most similar run; None where none is known. `params` is the
        parameter server of the launch. The names are as this node would give them, everything is marked `similar`.
        """
        path = node.resolved.path or ""
        request = nodelets.standalone(
            TraceRequest(node.name, node.package, path or node.executable, split_args(node.args), params=params)
        )
        build = fingerprint(path)
        candidates = [
            kept
            for kept in self._traces(request)
            if kept.interface.outcome.status in ("spinning", "exited")
            and (not path or kept.executable == path or kept.build == build)
        ]
        if not candidates:
            return None
        best = max(candidates, key=lambda kept: _likeness(kept, request, build))
        found = replace(_as_of(best, request), elsewhere=Elsewhere(best.node, best.launch, best.build != build))
        return found if found.endpoints or found.params else None

    def _traces(self, request: TraceRequest) -> tuple[Kept, ...]:
        key = (request.package, os.path.basename(request.executable), nodelets.plugin(request))
        known = self._remembered.get(key)
        if known is None or known[0] != self._cache.state_of(*key):
            known = self._cache.traces_of(*key)
            with self._lock:
                self._remembered[key] = known
                if len(self._remembered) > _MAX_REMEMBERED:
                    del self._remembered[next(iter(self._remembered))]
        return known[1]


def _likeness(kept: Kept, request: TraceRequest, build: str) -> tuple[bool, bool, bool, bool, float]:
    """The more alike, the greater."""
    return (
        kept.build == build,
        kept.interface.complete,
        kept.args == request.args,
        kept.node == request.node,
        kept.used,
    )


def _as_of(kept: Kept, request: TraceRequest) -> Interface:
    """The trace as one of this node."""
    strange: list[str] = []
    if kept.given:
        said = {bare(text) for text in (*request.args, *texts(request.params))}
        strange = [f"/{text}/" for text in kept.given - said]
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
