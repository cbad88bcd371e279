"""The one place where what is known of a node comes together, and the order in which sources of knowledge count."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple, TypeVar

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.interfaces.catalogued import catalogue_asked, from_catalogue
from preflight_analysis.interfaces.configured import configured, configured_asked
from preflight_analysis.interfaces.declared import annotated, nodl_asked, of_nodl, of_settings, settings_asked
from preflight_analysis.interfaces.from_source import of_source, similar, similar_asked, source_asked
from preflight_analysis.interfaces.loaded_plugins import of_plugins, plugins_asked
from preflight_analysis.interfaces.moveit_clients import clients_asked, moveit_clients
from preflight_analysis.interfaces.named_endpoints import named, named_within, names_asked, names_within_asked
from preflight_analysis.interfaces.part import Launch, Part, Rows
from preflight_analysis.interfaces.simulated_controllers import controllers_asked, of_controllers
from preflight_analysis.tracing.interface import DECLARED, KINDS, NOT_RUN, Endpoint, Interface, ParamUse

_What = TypeVar("_What", Endpoint, ParamUse)


def _nothing_more(launch: Launch, known: Sequence[Interface]) -> Rows:
    return Rows()


class Provider(NamedTuple):
    """A source of knowledge.

    `part(node, known, *row, *shared)`: what it gives of a node; None where that is nothing, or where what is known
    counts before it. It is pure: it looks at its arguments alone. `asked(launch, known)`: what it looks at, made of
    what is known of each node so far; None where it has nothing to say of the launch.
    """

    part: Callable[..., Part | None]
    asked: Callable[[Launch, Sequence[Interface]], Rows | None] = _nothing_more

    def added(self, node: LaunchNode, known: Interface, *rest: Any) -> Interface:
        """What is known of a node, with what it gives."""
        part = self.part(node, known, *rest)
        return with_part(node.name, known, part) if part is not None else known


PROVIDERS: tuple[Provider, ...] = (
    # A run counts first. What it did not tell is the word of whoever wrote it down, the closest first, ...
    Provider(annotated),
    Provider(of_settings, settings_asked),
    Provider(of_nodl, nodl_asked),
    # ... else what the node does elsewhere, or may do by its source, else what the catalogue has of it.
    Provider(similar, similar_asked),
    Provider(of_source, source_asked),
    Provider(from_catalogue, catalogue_asked),
    # What a node is given decides what it does beyond that.
    Provider(of_controllers, controllers_asked),
    Provider(of_plugins, plugins_asked),
    Provider(configured, configured_asked),
    Provider(moveit_clients, clients_asked),
    Provider(named, names_asked),
    Provider(named_within, names_within_asked),
)
"""The sources of knowledge. Each adds to what those before it gave."""


def merged(launch: Launch, runs: Sequence[Interface]) -> Sequence[Interface]:
    """What each node of a launch does, in order, those that a simulator makes last. `runs` is what the runs of the
    nodes told."""
    known: Sequence[Interface] = (*runs, *(NOT_RUN for _ in launch.tree.simulated))
    for provider in PROVIDERS:
        rows = provider.asked(launch, known)
        if rows is not None:
            known = launch.kept.each_row(provider.added, (launch.nodes, known, *rows.columns), *rows.shared)
    return known


def with_part(node: str, known: Interface, part: Part) -> Interface:
    """What is known of the node of that full name with what another source gives beyond that, types of ends among it.
    Where that adds nothing to a node of which likely all is known, that stays known as before."""

    def full(what: Endpoint | ParamUse) -> str:
        return names.resolve(what.name, what.node or node)

    instead = {id(old): new for old, new in part.corrected}
    ends, uses = _corrected(known.endpoints, instead), _corrected(known.params, instead)
    seen = {(end.role, full(end)) for end in ends}
    asked = {full(use) for use in uses}
    broadcast = {(frame.parent, frame.child) for frame in known.frames}
    types = {(end.role, full(end)): end.type for end in part.endpoints}
    typed = [
        replace(end, type=type_) if end.type is None and (type_ := types.get((end.role, full(end)))) else end
        for end in ends
    ]
    more = [_said(end, part) for end in part.endpoints if (end.role, full(end)) not in seen]
    params = [_said(use, part) for use in part.params if full(use) not in asked]
    frames = [frame for frame in part.frames if (frame.parent, frame.child) not in broadcast]
    adds = more or params or frames or part.frame_uses or typed != ends
    leads = part.leads and (adds or part.source in DECLARED or not known.likely_complete)
    return replace(
        known,
        source=part.source if leads or not known.known else known.source,
        endpoints=(*typed, *more),
        params=(*uses, *params),
        nodes=known.nodes or part.nodes,
        frames=(*known.frames, *frames),
        frame_uses=known.frame_uses + part.frame_uses,
        transitions=tuple(sorted({*known.transitions, *part.transitions})),
        unnamed_calls=known.unnamed_calls + part.unnamed_calls,
        whole=tuple(kind for kind in KINDS if kind in known.whole or kind in part.closed),
        elsewhere=part.elsewhere if leads and part.elsewhere is not None else known.elsewhere,
        outcome=known.outcome if part.reason is None else replace(known.outcome, reason=part.reason),
    )


def _said(what: _What, part: Part) -> _What:
    """With the source that it is known from, which is that of the part where it has no other."""
    known = what.evidence
    return replace(what, evidence=replace(known, source=part.source)) if known.source == "trace" else what


def _corrected(known: Iterable[_What], instead: Mapping[int, Any]) -> list[_What]:
    return [new for each in known if (new := instead.get(id(each), each)) is not None]
