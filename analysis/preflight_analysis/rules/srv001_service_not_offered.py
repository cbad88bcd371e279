"""SRV001: a node calls a service that nobody offers."""

from collections.abc import Iterable, Iterator, Mapping, Sequence

from preflight_analysis.evaluation import names
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.model import Connection
from preflight_analysis.rules.dangling import by_type, dangling_consumers, dangling_providers
from preflight_analysis.rules.further_reading import SERVICES, SERVICES_2
from preflight_analysis.rules.idle_remaps import meant_endpoints
from preflight_analysis.rules.near_miss import not_analysed, weight
from preflight_analysis.rules.near_miss_fixes import fixes_in
from preflight_analysis.rules.near_miss_search import near_misses
from preflight_analysis.rules.nearest import numbers_in, share_words
from preflight_analysis.rules.places import Verbs, related_endpoint
from preflight_analysis.rules.remaps_elsewhere import elsewhere_finding, used_elsewhere
from preflight_analysis.rules.rule import Context, Rule
from preflight_analysis.rules.unmatched import lone_finding, near_miss_finding, with_type

_VERBS = Verbs("serves", "calls")


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    if graph is None:
        return
    # Where a remap that has no effect was meant for the client, TOP004 says so, with the better fix.
    remapped = context.once(meant_endpoints)
    pairs = near_misses(context, "services")
    near = [pair for pair in pairs if id(pair.consumer) not in remapped and not _loads(pair.consumer)]
    for pair in near:
        message = (
            f"service '{pair.consumer.name}' has no server (client: {pair.consumer.node.name}); did you mean "
            f"'{pair.provider.name}', served by {pair.provider.node.name} ({pair.why}{not_analysed(graph)})?"
        )
        weighed = weight(pair, graph.complete, graph.likely_complete)
        yield near_miss_finding(rule, pair, message, _VERBS, fixes_in(context, pair), weighed)
    explained = {id(pair.consumer) for pair in near} | remapped
    lone = [each for each in dangling_consumers(context, "services") if id(each) not in explained and not _loads(each)]
    if not lone:
        return
    answers = {
        id(n): i.outcome.answers for n, i in zip(graph.tree.nodes, graph.interfaces, strict=True) if i.outcome.answers
    }
    unused = by_type(context, "services", dangling_providers(context, "services")) if answers else {}
    elsewhere, unknown = context.once(used_elsewhere), not_analysed(graph)
    meant = [_meant(each, answers.get(id(each.node), ()), unused) for each in lone] if answers else [None] * len(lone)
    hints: list[tuple[Connection, Connection | None]] = []
    for client, server in zip(lone, meant, strict=True):
        if server is None and (graph.blind or client.endpoint.catalogued):
            continue  # of a common node it is no news, as gazebo offers what its spawners call
        if server is None and id(client) in elsewhere:
            yield elsewhere_finding(rule, context, client, _message(client, unknown), elsewhere[id(client)])
        else:
            hints.append((client, server))
    if hints:
        yield from context.kept.each_row(_hint, zip(*hints, strict=True), rule, unknown, graph.complete)


def _message(client: Connection, unknown: str) -> str:
    return f"service {with_type(client)} has no server in this launch (client: {client.node.name}){unknown}"


def _hint(client: Connection, meant: Connection | None, rule: Rule, unknown: str, complete: bool) -> Finding:
    hint = f"; the client waits for it on start; did you mean '{meant.name}', which has no client?" if meant else ""
    return lone_finding(
        rule,
        client,
        _message(client, unknown) + hint,
        whole=complete,
        severity="hint" if meant is None else "warning",
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
    severity="warning",
    what="Checks for a service client whose service has no server in the launch. The finding is a warning if a node "
    "serves one of a similar name and the same type. It is a warning too if the client's node waits for the service "
    "while a service with a word in common has no client. It is information if the client's remap is a typo of one "
    "in several launch files nearby, and a warning if the service is a typo of one in sources of the workspace with "
    "the same type. Otherwise it is a hint, because another launch may start the server.",
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
