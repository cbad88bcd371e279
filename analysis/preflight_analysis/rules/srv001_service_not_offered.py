"""SRV001: a node calls a service that nobody offers."""

from collections.abc import Iterable, Iterator, Mapping, Sequence

from preflight_analysis.evaluation import names
from preflight_analysis.findings.claim import Text, say
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.model import Connection
from preflight_analysis.model.channels import not_all_known
from preflight_analysis.model.context import Context
from preflight_analysis.model.dangling import by_type, dangling_consumers, dangling_providers
from preflight_analysis.model.idle_remaps import meant_endpoints
from preflight_analysis.model.near_miss import OF_NEAR_MISSES, doubts_of, not_analysed
from preflight_analysis.model.near_miss_search import near_misses
from preflight_analysis.model.nearest import numbers_in, share_words
from preflight_analysis.model.places import Verbs, related_endpoint, subject_of
from preflight_analysis.model.remaps_elsewhere import BY_FILES, used_elsewhere
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
    # Where a remap that has no effect was meant for the client, TOP004 says so, with the better fix.
    remapped = meant_endpoints(context)
    pairs = near_misses(context, "services")
    near = [pair for pair in pairs if id(pair.consumer) not in remapped and not _loads(pair.consumer)]
    lacks, unknown = not_all_known(graph), not_analysed(graph)
    for pair in near:
        client, server = pair.consumer, pair.provider
        nodes = {"node": client.node.name, "other": server.node.name}
        said = say(_NEAR, name=client.name, near=server.name, **nodes, why=pair.why, aside=unknown)
        why = doubts_of(pair, lacks, graph.likely_complete)
        yield near_miss_finding(rule, pair, said, subject_of(client), _VERBS, fixes_in(context, pair), why)
    explained = {id(pair.consumer) for pair in near} | remapped
    lone = [each for each in dangling_consumers(context, "services") if id(each) not in explained and not _loads(each)]
    if not lone:
        return
    answers = {
        id(n): i.outcome.answers for n, i in zip(graph.tree.nodes, graph.interfaces, strict=True) if i.outcome.answers
    }
    unused = by_type(context, "services", dangling_providers(context, "services")) if answers else {}
    elsewhere = used_elsewhere(context)
    meant = [_meant(each, answers.get(id(each.node), ()), unused) for each in lone] if answers else [None] * len(lone)
    hints: list[tuple[Connection, Connection | None]] = []
    for client, offer in zip(lone, meant, strict=True):
        if offer is None and (graph.blind or client.endpoint.catalogued):
            continue  # of a common node it is no news, as gazebo offers what its spawners call
        if offer is None and id(client) in elsewhere:
            yield elsewhere_finding(rule, context, client, _message(client, unknown), elsewhere[id(client)])
        else:
            hints.append((client, offer))
    if hints:
        yield from context.each_row(_hint, zip(*hints, strict=True), rule, unknown, lacks)


def _message(client: Connection, unknown: str) -> Text:
    return say(_LONE, name=with_type(client), node=client.node.name, aside=unknown)


def _hint(client: Connection, meant: Connection | None, rule: Rule, unknown: str, lacks: str | bool) -> Finding:
    said = _message(client, unknown)
    return lone_finding(
        rule,
        client,
        said.followed_by(_WAITS, near=meant.name) if meant is not None else said,
        lacks=lacks,
        meant=meant,
        related=(related_endpoint(meant, _VERBS.provides),) if meant is not None else (),
    )


def _loads(connection: Connection) -> bool:
    """Whether a nodelet asks its manager to be loaded: LCH034 says where that is not there."""
    return connection.endpoint.type == "nodelet/NodeletLoad" and connection.node.package == "nodelet"


def _meant(
    connection: Connection, answers: Iterable[str], unused: Mapping[str | None, Sequence[Connection]]
) -> Connection | None:
    """For a client that its node was seen to wait for before it did anything else: the one service of its type that
    nobody calls and that has a word in common."""
    given = {connection.name, connection.endpoint.name, names.resolve(connection.endpoint.name, connection.node.name)}
    if not any(answer.startswith(f"it waits for the service {name}, ") for name in given for answer in answers):
        return None
    alike = [
        offer
        for offer in unused.get(connection.endpoint.type, ())
        if connection.endpoint.type
        and offer.node is not connection.node
        and not offer.endpoint.uncertain
        and share_words(offer.name, connection.name)
        and numbers_in(offer.name) == numbers_in(connection.name)
    ]
    return alike[0] if len(alike) == 1 else None


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
