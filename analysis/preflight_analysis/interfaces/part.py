"""The one shape of all sources of knowledge about nodes: of what they look at, and of what they give."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.meanings import KnownMeanings
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.interfaces.settings import NodeSettings
from preflight_analysis.source.analyse import SourceAnalysis
from preflight_analysis.tracing.interface import (
    Elsewhere,
    Endpoint,
    Frame,
    FrameUse,
    Kind,
    MadeNode,
    ParamUse,
    Source,
)
from preflight_analysis.tracing.similar import SimilarTraces


@dataclass(frozen=True, eq=False)
class Launch:
    """A launch whose nodes are asked about, and what is at hand for that. `documents` are the texts that it was made
    of; what was `kept` of the last time is taken over."""

    tree: LaunchTree
    environment: Environment
    documents: Mapping[str, Document]
    disk: Disk
    kept: Kept
    known: KnownMeanings
    settings: tuple[NodeSettings, ...] = ()
    similar: SimilarTraces | None = None

    @property
    def sources(self) -> SourceAnalysis:
        """Reads the sources of nodes and of plugins."""
        return SourceAnalysis(self.environment, self.disk)

    @property
    def nodes(self) -> tuple[LaunchNode, ...]:
        """All that are asked about, those that a simulator makes last."""
        return self.tree.nodes_and_simulated

    def shown(self, found: Mapping[int, Any]) -> Sequence[Any]:
        """A column that has what was found for some of the nodes, by their numbers."""
        return [found.get(at) for at in range(len(self.nodes))]


@dataclass(frozen=True, slots=True)
class Part:
    """What one source of knowledge gives of a node. It adds to what those before it gave.

    `leads`: whether it speaks of the node as a whole, which is known from `source` from there on; the others have
    details, and the node is known from them where nothing else speaks of it.
    """

    source: Source
    endpoints: tuple[Endpoint, ...] = ()
    params: tuple[ParamUse, ...] = ()
    nodes: tuple[MadeNode, ...] = ()
    frames: tuple[Frame, ...] = ()
    frame_uses: tuple[FrameUse, ...] = ()
    transitions: tuple[str, ...] = ()
    unnamed_calls: tuple[str, ...] = ()
    corrected: tuple[tuple[Endpoint | ParamUse, Endpoint | ParamUse | None], ...] = ()
    """What is known already, each with what it is instead; None for what the node does not do."""
    closed: tuple[Kind, ...] = ()
    """The kinds of which it tells all."""
    leads: bool = True
    reason: str | None = None
    """Why the node was not run, in other words than before."""
    elsewhere: Elsewhere | None = None


class Rows(NamedTuple):
    """What a source of knowledge looks at beside the node and what is known of it: for each node one item of each
    column, and what is the same for all."""

    columns: tuple[Sequence[Any], ...] = ()
    shared: tuple[Any, ...] = ()
