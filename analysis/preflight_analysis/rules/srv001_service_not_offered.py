"""SRV001: a node calls a service that nobody offers."""

from collections.abc import Iterator

from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.idle_remaps import meant_ends
from preflight_analysis.rules.near_miss import dangling_wants, fixes, near_misses, nodes_looked_at, weight
from preflight_analysis.rules.places import connection_location, related_end
from preflight_analysis.rules.problems import include_chain
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    if graph is None:
        return
    # Where a remap that has no effect was meant for the client, TOP004 says so, with the better fix.
    remapped = context.once(meant_ends)
    near = [pair for pair in near_misses(graph.services) if id(pair.wanting) not in remapped]
    for pair in near:
        severity, confidence = weight(graph, pair)
        yield rule.finding(
            f"{nodes_looked_at(graph)} offers service '{pair.wanting.name}', which {pair.wanting.node.name} calls; "
            f"did you mean '{pair.offering.name}', offered by {pair.offering.node.name} ({pair.why})?",
            connection_location(pair.site),
            severity=severity,
            confidence=confidence,
            related=(
                related_end(pair.other, "offers" if pair.other is pair.offering else "calls"),
                *include_chain(pair.site.node.origin),
            ),
            fixes=fixes(context, pair),
        )
    explained = {id(pair.wanting) for pair in near} | remapped
    for end in dangling_wants(graph.services):
        if id(end) not in explained:
            sure = graph.complete and not end.endpoint.uncertain
            kind = f" ({end.endpoint.type})" if end.endpoint.type else ""
            yield rule.finding(
                f"{nodes_looked_at(graph)} offers service '{end.name}'{kind}, which {end.node.name} calls",
                connection_location(end),
                severity="hint",
                confidence="likely" if sure else "possible",
                related=include_chain(end.node.origin),
            )


RULE = Rule(
    id="SRV001",
    name="service-not-offered",
    severity="warning",
    what="Reports a node with a client of a service that no node of the launch offers. Where one offers a service of a "
    "like name and the same type, it is a warning that names both; otherwise a hint, as the service may be offered by "
    "something that is started elsewhere.",
    why="A client that waits for the service waits for ever; one that does not gets an error at its first call.",
    example='<!-- the base offers reset_odometry -->\n<remap from="reset" to="reset_odometri"/>',
    instead='<remap from="reset" to="reset_odometry"/>',
    check=_check,
    needs_graph=True,
    every_root=True,
)
