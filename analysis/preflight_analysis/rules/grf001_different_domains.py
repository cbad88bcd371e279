"""GRF001: two nodes have ends of one name and cannot reach each other."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from preflight_analysis.documents.span import Location
from preflight_analysis.findings.claim import Text, say
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.graph.domains import Difference, processes_of
from preflight_analysis.model.channels import OF_ENDS, channels_of, doubts_of_ends
from preflight_analysis.model.context import Context
from preflight_analysis.model.fit import Separation, separations
from preflight_analysis.model.places import endpoints_of, related_endpoint, subject_of
from preflight_analysis.model.problems import include_chain, rename
from preflight_analysis.model.variables import setting_of
from preflight_analysis.rules.further_reading import DOMAINS, MASTER
from preflight_analysis.rules.further_reading import MIDDLEWARE as ABOUT_MIDDLEWARE
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    if graph is None or not graph.domains.by_node:
        return
    by_process = {id(node): each for node, each in zip(graph.tree.nodes, processes_of(graph.tree), strict=True)}
    found: dict[tuple[int, int], list[Separation]] = {}
    for channel in chain.from_iterable(channels_of(context).values()):
        for pair in separations(graph, channel):
            found.setdefault((id(pair.consumer.node), id(pair.provider.node)), []).append(pair)
    for pairs in found.values():
        consumer, provider, difference = pairs[0]
        places = [
            (place, end)
            for end in (consumer, provider)
            if (place := setting_of(context, by_process[id(end.node)], difference.variable)) is not None
        ]
        place, setter = places[0] if places else (consumer.node.location, consumer)
        other = provider if setter is consumer else consumer
        yield rule.claim(
            _message(pairs),
            place,
            subject=subject_of(consumer),
            # Two vendors of DDS communicate in part.
            effect=None if difference.separates else "note",
            doubts=doubts_of_ends(consumer, provider, assumed="DEPENDS"),
            related=(
                related_endpoint(other, "offers" if other is provider else "uses"),
                *include_chain(setter.node.origin),
            ),
            fixes=_aligned(context, place, difference, setter is consumer) if len(places) == 1 else (),
            endpoints=endpoints_of(*chain.from_iterable(pair[:2] for pair in pairs)),
        )


def _aligned(context: Context, place: Location, difference: Difference, of_consumer: bool) -> tuple[Fix, ...]:
    """The other node's value in place of this one, where only one of both is set."""
    old, new = (difference.other, difference.one) if of_consumer else (difference.one, difference.other)
    return rename(context, place, old, new, preferred=False) if difference.separates else ()


def _message(pairs: list[Separation]) -> Text:
    consumer, provider, difference = pairs[0]
    more = f" and {len(pairs) - 1} more" if len(pairs) > 1 else ""
    fact = f"{'are' if more else 'is'} not shared{'' if difference.separates else ' reliably'}"
    return say(
        "'{name}'{more} {fact}: {node} has {variable} {one}, {other} has {another}",
        **{"name": consumer.name, "more": more, "fact": fact, "node": provider.node.name, "other": consumer.node.name},
        **{"variable": difference.variable, "one": difference.one, "another": difference.other},
    )


RULE = Rule(
    id="GRF001",
    name="different-domains",
    effect="breaks",
    kind="unreachable",
    always=(Reason.UNSEEN,),
    sometimes=("note", *OF_ENDS),
    what="Checks for a subscriber or client whose only publishers or servers have another `ROS_DOMAIN_ID`, "
    "`RMW_IMPLEMENTATION`, `ROS_MASTER_URI` or a discovery range of `OFF`. There is no finding if a bridge of domains "
    "runs.",
    why="Each node finds only nodes of its own domain, or of its own master. The names are equal, and no message "
    "arrives.",
    example='<node pkg="laser" exec="driver" name="laser">\n  <env name="ROS_DOMAIN_ID" value="5"/>\n</node>\n'
    '<node pkg="mapping" exec="mapper" name="mapper"/>',
    instead='<set_env name="ROS_DOMAIN_ID" value="5"/>\n<node pkg="laser" exec="driver" name="laser"/>\n'
    '<node pkg="mapping" exec="mapper" name="mapper"/>',
    references=(DOMAINS, ABOUT_MIDDLEWARE, MASTER),
    settings=("external", "nodes"),
    check=_check,
    needs_graph=True,
    every_root=True,
)
