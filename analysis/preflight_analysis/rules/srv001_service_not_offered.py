"""SRV001: a node calls a service that nobody offers."""

from collections.abc import Iterator

from preflight_analysis.findings.claim import Text, say
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.model import Connection
from preflight_analysis.model.context import Context
from preflight_analysis.model.near_miss import OF_NEAR_MISSES, doubts_of
from preflight_analysis.model.places import Verbs, related_endpoint
from preflight_analysis.model.reach import Seen, awaited, seen, unmet
from preflight_analysis.model.remaps_elsewhere import BY_FILES
from preflight_analysis.rules.further_reading import SERVICES, SERVICES_2
from preflight_analysis.rules.near_miss_fixes import fixes_in
from preflight_analysis.rules.remaps_elsewhere import elsewhere_finding
from preflight_analysis.rules.rule import Rule
from preflight_analysis.rules.unmatched import lone_finding, near_miss_finding, with_type

_VERBS = Verbs("serves", "calls")
_NEAR = "service '{name}' has no server (client: {node}); did you mean '{near}', served by {other} ({why}{aside})?"
_LONE = "service {name} has no server in this launch (client: {node}){aside}"
_WAITS = "; the client waits for it on start; did you mean '{near}', which has no client?"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    if graph is None:
        return
    found, known = unmet(context, "services"), seen(context, graph)
    for pair in found.near:
        client, server = pair.consumer, pair.provider
        nodes = {"node": client.node.name, "other": server.node.name}
        said = say(_NEAR, name=client.name, near=server.name, **nodes, why=pair.why, aside=known.aside)
        why = doubts_of(pair, known.lacks, known.likely_complete)
        yield near_miss_finding(rule, pair, said, _VERBS, fixes_in(context, pair), why)
    offers = awaited(context)
    hints: list[tuple[Connection, Connection | None]] = []
    for client in found.consumers:
        offer = offers.get(id(client))
        if offer is None and (known.blind or client.endpoint.evidence.of_catalogue):
            continue  # of a common node it is no news, as gazebo offers what its spawners call
        if offer is None and id(client) in found.elsewhere:
            yield elsewhere_finding(rule, context, client, _message(client, known), found.elsewhere[id(client)])
        else:
            hints.append((client, offer))
    if hints:
        yield from context.each_row(_hint, zip(*hints, strict=True), rule, known)


def _message(client: Connection, known: Seen) -> Text:
    return say(_LONE, name=with_type(client), node=client.node.name, aside=known.aside)


def _hint(client: Connection, meant: Connection | None, rule: Rule, known: Seen) -> Finding:
    said = _message(client, known)
    return lone_finding(
        rule,
        client,
        said.followed_by(_WAITS, near=meant.name) if meant is not None else said,
        lacks=known.lacks,
        meant=meant,
        related=(related_endpoint(meant, _VERBS.provides),) if meant is not None else (),
    )


RULE = Rule(
    id="SRV001",
    name="service-not-offered",
    effect="breaks",
    kind="absent",
    always=(Reason.UNSEEN,),
    sometimes=(Reason.OTHER_LAUNCH, *BY_FILES, *OF_NEAR_MISSES),
    what="Checks for a service client whose service has no server in the launch. The finding names a service of a "
    "similar name or of the same type.",
    why="A client that waits for the service waits forever. A client that does not wait gets an error at its first "
    "call.",
    example='<!-- the base offers reset_odometry -->\n<remap from="reset" to="reset_odometri"/>',
    instead='<remap from="reset" to="reset_odometry"/>',
    references=(
        SERVICES,
        SERVICES_2,
    ),
    settings=("nodes",),
    check=_check,
    needs_graph=True,
    every_root=True,
)
