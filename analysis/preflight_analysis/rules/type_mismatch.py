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
from preflight_analysis.graph.model import Channel, ChannelKind, Connection, Graph
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.channels import OF_ENDS, channels_of, doubts_of_ends, of_all_kinds
from preflight_analysis.model.context import Context
from preflight_analysis.model.controllers import controllers_of
from preflight_analysis.model.interface_files import lacks_type
from preflight_analysis.model.places import Verbs, connection_location, endpoints_of, related_endpoint, subject_of
from preflight_analysis.model.problems import include_chain, rename
from preflight_analysis.rules.rule import Rule

_MESSAGES = "_msgs"
_SAID = "type mismatch on '{name}': {node} {provides} {type}, {other} {consumes} {other_type}{difference}"
_NO_TYPE = "an unknown type"
OF_MISMATCHES = (Reason.PARTLY_READ, Reason.OTHER_VERSION, *OF_ENDS)
"""Doubts of what `mismatches` finds."""
_SAME = {"tf/tfMessage": "tf2_msgs/TFMessage"}
"""Types of two packages with one definition, and so with one sum."""


def mismatches(rule: Rule, context: Context, kind: ChannelKind, verbs: Verbs) -> Iterator[Finding]:
    """A finding for each consumer and each type that does not fit it."""
    graph = context.graph
    if graph is None:
        return
    for consumer, provider, difference in chain.from_iterable(_all_misfits(context)[kind]):
        site, other = (consumer, provider)
        if not consumer.is_placed and provider.is_placed:
            site, other = provider, consumer
        advice, fixes = _deciding_parameter(context, provider, consumer)
        yield rule.claim(
            say(
                _SAID,
                name=consumer.name,
                node=provider.node.name,
                provides=verbs.provides,
                type=provider.endpoint.type or _NO_TYPE,
                other=consumer.node.name,
                consumes=verbs.consumes,
                other_type=consumer.endpoint.type or _NO_TYPE,
                difference=f"{difference}{advice}",
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


_Misfit = tuple[Connection, Connection, str]
"""A consumer, a provider that does not fit it, and what to add to the message."""


@derived
def _all_misfits(context: Context) -> Mapping[ChannelKind, tuple[tuple[_Misfit, ...], ...]]:
    return of_all_kinds(context, _misfits, channels_of(context))


def _misfits(channel: Channel) -> tuple[_Misfit, ...]:
    # Of those that are alike the first one is told; a topic that all nodes share has many.
    providers: dict[tuple[str | None, str | None, bool], Connection] = {}
    for connection in channel.providers:
        providers.setdefault((connection.endpoint.type, connection.endpoint.md5, connection.action is None), connection)
    found: list[_Misfit] = []
    for consumer in channel.consumers:
        reported: set[tuple[str | None, str]] = set()
        for provider in providers.values():
            if consumer.action is not None and provider.action is not None:
                continue  # said once of the action, not of each of its topics
            known = consumer.endpoint.evidence, provider.endpoint.evidence
            if consumer.node is provider.node and all(each.of_catalogue for each in known):
                continue  # within a node of others, as move_base's footprints
            difference = _difference(consumer, provider)
            if difference is not None and (provider.endpoint.type, difference) not in reported:
                reported.add((provider.endpoint.type, difference))
                found.append((consumer, provider, difference))
    return tuple(found)


def _difference(consumer: Connection, provider: Connection) -> str | None:
    """None when they fit; else what to add to the message, which is empty when the types' names tell it all."""
    mine, theirs = consumer.endpoint, provider.endpoint
    if "*" in (mine.type, theirs.type, mine.md5, theirs.md5):
        return None
    sums_differ = bool(mine.md5 and theirs.md5) and mine.md5 != theirs.md5
    if mine.type is None or theirs.type is None:
        # A roscpp client of a service knows no type, but what it sends is known by the sum.
        return f" (MD5 sums {theirs.md5} and {mine.md5})" if sums_differ else None
    if in_short(mine.type) != in_short(theirs.type):
        # Of a service only the sums are compared when it is called.
        return None if mine.role == "client" and mine.md5 and mine.md5 == theirs.md5 else ""
    if sums_differ:
        return f" (different definitions, MD5 sums {theirs.md5} and {mine.md5})"
    return None


def in_short(name: str) -> str:
    """A type's name without the folder that ROS 2 has in it: a launch file of a package for both generations may be
    answered by nodes of either."""
    package, _, rest = name.partition("/")
    short = f"{package}/{rest.rpartition('/')[2]}"
    return _SAME.get(short, short)
