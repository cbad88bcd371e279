"""SRV001: a node calls a service that nobody offers."""

from collections.abc import Iterable, Iterator, Mapping, Sequence

from preflight_analysis.evaluation import names
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.model import Connection
from preflight_analysis.rules.idle_remaps import meant_ends
from preflight_analysis.rules.near_miss import (
    by_type,
    dangling_consumers,
    dangling_providers,
    fixes,
    near_misses,
    nodes_looked_at,
    weight,
)
from preflight_analysis.rules.nearest import numbers_in, share_words
from preflight_analysis.rules.places import connection_location, ends_of, related_end
from preflight_analysis.rules.problems import include_chain
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    if graph is None:
        return
    # Where a remap that has no effect was meant for the client, TOP004 says so, with the better fix.
    remapped = context.once(meant_ends)
    near = [pair for pair in near_misses(context, "services") if id(pair.consumer) not in remapped]
    for pair in near:
        severity, confidence = weight(graph, pair)
        yield rule.finding(
            f"{nodes_looked_at(graph)} offers service '{pair.consumer.name}', which {pair.consumer.node.name} calls; "
            f"did you mean '{pair.provider.name}', offered by {pair.provider.node.name} ({pair.why})?",
            connection_location(pair.site),
            severity=severity,
            confidence=confidence,
            related=(
                related_end(pair.other, "offers" if pair.other is pair.provider else "calls"),
                *include_chain(pair.site.node.origin),
            ),
            fixes=fixes(context, pair),
            ends=ends_of(pair.consumer, pair.provider),
        )
    answers = {
        id(n): i.outcome.answers for n, i in zip(graph.tree.nodes, graph.interfaces, strict=True) if i.outcome.answers
    }
    unused = by_type(dangling_providers(context, "services")) if answers else {}
    explained = {id(pair.consumer) for pair in near} | remapped
    for end in dangling_consumers(context, "services"):
        if id(end) not in explained:
            sure = graph.complete and not end.endpoint.uncertain
            kind = f" ({end.endpoint.type})" if end.endpoint.type else ""
            meant = _meant(end, answers.get(id(end.node), ()), unused)
            if graph.blind and meant is None:
                continue
            hint = f" and waits for when it starts; did you mean '{meant.name}', which nobody calls?" if meant else ""
            related = [related_end(meant, "offers")] if meant is not None else []
            yield rule.finding(
                f"{nodes_looked_at(graph)} offers service '{end.name}'{kind}, which {end.node.name} calls{hint}",
                connection_location(end),
                severity="hint" if meant is None else "warning",
                confidence="likely" if sure else "possible",
                related=(*related, *include_chain(end.node.origin)),
                ends=ends_of(end),
            )


def _meant(
    end: Connection, answers: Iterable[str], unused: Mapping[str | None, Sequence[Connection]]
) -> Connection | None:
    """For a client that its node was seen to wait for before it did anything else: the one service of its type that
    nobody calls and that has a word in common."""
    given = {end.name, end.endpoint.name, names.resolve(end.endpoint.name, end.node.name)}
    if not any(answer.startswith(f"it waits for the service {name}, ") for name in given for answer in answers):
        return None
    alike = [
        offer
        for offer in unused.get(end.endpoint.type, ())
        if end.endpoint.type
        and offer.node is not end.node
        and not offer.endpoint.uncertain
        and share_words(offer.name, end.name)
        and numbers_in(offer.name) == numbers_in(end.name)
    ]
    return alike[0] if len(alike) == 1 else None


RULE = Rule(
    id="SRV001",
    name="service-not-offered",
    severity="warning",
    what="Reports a node with a client of a service that no node of the launch offers. Where one offers a service of a "
    "like name and the same type, or one with a word in common that nobody calls while the client's node waits for its "
    "own, it is a warning that names both; otherwise a hint, as the service may be offered by "
    "something that is started elsewhere.",
    why="A client that waits for the service waits for ever; one that does not gets an error at its first call.",
    example='<!-- the base offers reset_odometry -->\n<remap from="reset" to="reset_odometri"/>',
    instead='<remap from="reset" to="reset_odometry"/>',
    check=_check,
    needs_graph=True,
    every_root=True,
)
