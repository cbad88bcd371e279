"""What runs told of the nodes of each root, as far as it was not taken back: where the database has it from.

Like a file it lies outside, and is read with each snapshot (`Workspace.set_results`). Which request a result is of says
whether a node has to be run again, and nothing else: no value depends on it.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

from preflight_analysis.dataclass import dataclass
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.workspace.index import Root
from preflight_analysis.workspace.run_results import NodeKey


@dataclass(frozen=True, slots=True)
class _Result:
    request: TraceRequest | None
    """For which this was seen, None where it may be out of date."""
    interface: Interface


class NodeResults:
    """Of one session; use it on the event loop. A result stays until there is another one, so that its findings do not
    come and go with each keystroke."""

    def __init__(self) -> None:
        self._results: dict[Root, dict[NodeKey, _Result]] = {}
        self.edition = 0
        """How often files changed: what a run told that began before may be out of date."""
        self._cleared_in = 0

    def of(self, root: Root) -> dict[NodeKey, Interface]:
        """What the nodes of a root did when they were last seen."""
        return {key: result.interface for key, result in self._results.get(root, {}).items()}

    def lacking(self, root: Root, requests: Mapping[NodeKey, TraceRequest]) -> dict[NodeKey, TraceRequest]:
        """The requests for which nothing is known that is up to date."""
        known = self._results.get(root, {})
        return {key: each for key, each in requests.items() if key not in known or known[key].request != each}

    def put(self, root: Root, key: NodeKey, request: TraceRequest, interface: Interface, edition: int) -> bool:
        """What was seen for a request that was made in an edition. Whether it is something else than before; nothing
        where all was taken back since."""
        if edition < self._cleared_in:
            return False
        known = self._results.setdefault(root, {})
        before = known.get(key)
        known[key] = _Result(request if edition == self.edition else None, interface)
        return before is None or before.interface != interface

    def keep(self, root: Root, keys: Collection[NodeKey]) -> None:
        """Forget the nodes of a root but these."""
        known = self._results.get(root, {})
        for key in known.keys() - set(keys):
            del known[key]

    def look_again(self) -> None:
        """Files changed: all of it may be out of date."""
        self.edition += 1
        for root, known in self._results.items():
            self.look_again_at(root, known)

    def look_again_at(self, root: Root, keys: Collection[NodeKey]) -> None:
        """What is known of these may be out of date."""
        known = self._results.get(root, {})
        known.update({key: _Result(None, known[key].interface) for key in keys if key in known})

    def clear(self) -> None:
        """Take all of it back."""
        self.edition += 1
        self._cleared_in = self.edition
        self._results.clear()
