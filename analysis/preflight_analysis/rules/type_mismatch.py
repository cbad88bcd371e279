"""Ends that meet under one name with types that do not."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import chain

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.value_places import value_place
from preflight_analysis.findings.claim import say
from preflight_analysis.findings.doubt import Doubt, Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.graph.model import ChannelKind, Connection, Graph
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.channels import OF_ENDS, channels_of, doubts_of_ends, of_all_kinds
from preflight_analysis.model.context import Context
from preflight_analysis.model.controllers import controllers_of
from preflight_analysis.model.fit import TypeMisfit, in_short, type_misfits
from preflight_analysis.model.interface_files import lacks_type
from preflight_analysis.model.places import Verbs, connection_location, endpoints_of, related_endpoint, subject_of
from preflight_analysis.model.problems import include_chain, rename
from preflight_analysis.rules.rule import Rule

_MESSAGES = "_msgs"
_SAID = "type mismatch on '{name}': {node} {provides} {type}, {other} {consumes} {other_type}{difference}"
OF_MISMATCHES = (Reason.PARTLY_READ, Reason.OTHER_VERSION, *OF_ENDS)
"""Doubts of what `mismatches` finds."""


def mismatches(rule: Rule, context: Context, kind: ChannelKind, verbs: Verbs) -> Iterator[Finding]:
    """A finding for each consumer and each type that does not fit it."""
    graph = context.graph
    if graph is None:
        return
    for misfit in chain.from_iterable(_all_misfits(context)[kind]):
        consumer, provider = site, other = misfit.consumer, misfit.provider
        if not consumer.is_placed and provider.is_placed:
            site, other = provider, consumer
        advice, fixes = _deciding_parameter(context, provider, consumer)
        provided, consumed = misfit.types
        yield rule.claim(
            say(
                _SAID,
                name=consumer.name,
                node=provider.node.name,
                provides=verbs.provides,
                type=provided,
                other=consumer.node.name,
                consumes=verbs.consumes,
                other_type=consumed,
                difference=f"{misfit.difference}{advice}",
            ),
            connection_location(site),
            subject=subject_of(site),
            # The robot moves without what a display shows.
            effect="misbehaves" if consumer.endpoint.displayed else None,
            doubts=_doubts(context, graph, consumer, provider),
            fixes=fixes,
            related=(
                related_endpoint(other, verbs.provides if other is provider else verbs.consumes),
                *include_chain(site.node.origin),
            ),
            endpoints=endpoints_of(consumer, provider),
        )


def _deciding_parameter(context: Context, provider: Connection, consumer: Connection) -> tuple[str, tuple[Fix, ...]]:
    """The parameter that would give one end the type of the other, for the message; and what changes it where it is
    set."""
    for end, other in ((provider, consumer), (consumer, provider)):
        by = end.endpoint.typed_by
        for value, type_ in by.types if by is not None and other.endpoint.type is not None else ():
            if by is not None and in_short(type_) == in_short(other.endpoint.type or ""):
                advice = f"; set '{by.parameter}' of {end.node.name} to {value}"
                return advice, _set_to(context, by.place, value) if by.place is not None else ()
    return "", ()


def _set_to(context: Context, place: Location, value: str) -> tuple[Fix, ...]:
    """What writes the value, true or false, for the other one; `place` is that of the parameter's name, or its tag."""
    document = context.documents.get(place.file)
    for other in {"true": ("false", "False"), "false": ("true", "True")}.get(value, ()):
        at = value_place(place, other, document) or place
        if found := rename(context, at, other, value.title() if other.istitle() else value):
            return found
    return ()


def _doubts(context: Context, graph: Graph, *ends: Connection) -> tuple[Doubt, ...]:
    """Why the types may not be those. One for which its package has no file is from another module than the program
    seems to have it from."""
    by_node = {id(node): interface.source for node, interface in zip(graph.tree.nodes, graph.interfaces, strict=True)}
    assumed = next((each.node.name for each in ends if _is_assumed(context, each)), "")
    not_run = next((each.node.name for each in ends if by_node[id(each.node)] != "trace"), "")
    found = doubts(
        PARTLY_READ=any(lacks_type(context, each.endpoint.type) for each in ends),
        OTHER_VERSION=_is_moved(*ends),
        ASSUMED=assumed,
        FROM_SOURCE=not_run,
    )
    told = {each.reason for each in found}
    return (*found, *(each for each in doubts_of_ends(*ends, assumed="") if each.reason not in told))


def _is_assumed(context: Context, end: Connection) -> bool:
    """Whether it is only assumed that the node has the end. What the catalogue says of a controller is sure enough once
    the launch activates that."""
    known = end.endpoint.evidence
    if not known.assumed or known.source != "catalogue" or "other distribution" in known.doubts:
        return known.assumed
    return end.node.name not in _active_controllers(context)


@derived
def _active_controllers(context: Context) -> frozenset[str]:
    """The full names of the nodes of controllers that the launch activates."""
    return frozenset(
        names.join(names.parent(each.manager), each.name) for each in controllers_of(context) if each.is_active
    )


def _is_moved(consumer: Connection, provider: Connection) -> bool:
    """Whether an end of the catalogue may be of another version, with the message in another package of the same
    project, for messages alone (`rtabmap_msgs`, `rtabmap_ros`)."""
    one, other = consumer.endpoint, provider.endpoint
    if not (one.evidence.of_catalogue or other.evidence.of_catalogue) or one.type is None or other.type is None:
        return False
    (package, _, name), (other_package, _, other_name) = one.type.partition("/"), other.type.partition("/")
    moved = package.endswith(_MESSAGES) != other_package.endswith(_MESSAGES)
    return moved and name == other_name and package.partition("_")[0] == other_package.partition("_")[0]


@derived
def _all_misfits(context: Context) -> Mapping[ChannelKind, tuple[tuple[TypeMisfit, ...], ...]]:
    return of_all_kinds(context, type_misfits, channels_of(context))
