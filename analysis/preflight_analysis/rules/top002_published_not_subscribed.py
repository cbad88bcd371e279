"""TOP002: a node publishes what nobody subscribes to."""

from collections.abc import Iterator

from preflight_analysis.documents.span import Location
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.model import Connection
from preflight_analysis.model.channels import OF_ENDS, doubts_of_ends, not_all_known
from preflight_analysis.model.context import Context
from preflight_analysis.model.places import connection_location, endpoints_of, related_endpoint
from preflight_analysis.model.problems import include_chain, quoted
from preflight_analysis.model.reach import crossed, unmet
from preflight_analysis.model.remaps_elsewhere import BY_FILES
from preflight_analysis.rules.further_reading import TOPICS, TOPICS_2
from preflight_analysis.rules.remaps_elsewhere import elsewhere_finding
from preflight_analysis.rules.rule import Rule

_CROSSED = (
    "{node} is remapped to '{theirs}' of {other}: nobody subscribes to '{own}' of {publisher}, its name without that"
)
_LONE = "{topics} {have} no subscriber in this launch (publisher: {node})"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    if graph is None or graph.blind:
        return
    found = unmet(context, "topics")
    for each in found.providers:
        if id(each) in found.elsewhere:
            said = say(_LONE, topics=f"'{each.name}'", have="has", node=each.node.name)
            yield elsewhere_finding(rule, context, each, said, found.elsewhere[id(each)])
    taken = crossed(context)
    for each in found.providers:
        if id(each) in taken and id(each) not in found.elsewhere:
            yield _crossed(rule, each, *taken[id(each)], lacks=not_all_known(graph))
    dangling = [each for each in found.providers if id(each) not in found.elsewhere and id(each) not in taken]
    # A sensor's driver publishes a dozen topics of which two are used: one hint for all that stand at one place.
    grouped = context.grouped(_place, rule.id, dangling)
    yield from context.each(_finding, grouped.values(), rule, not_all_known(graph))


def _crossed(rule: Rule, own: Connection, end: Connection, other: Connection, *, lacks: str | bool) -> Finding:
    said = {"node": end.node.name, "theirs": end.name, "other": other.node.name}
    return rule.claim(
        say(_CROSSED, own=own.name, publisher=own.node.name, **said),
        connection_location(end),
        subject=Subject("topic", own.name),
        kind="near",
        effect="misbehaves",
        doubts=(*doubts(INTENDED=True), *doubts_of_ends(own, end, other, lacks=lacks)),
        candidates=(own.name,),
        related=(related_endpoint(own, "publishes"), *include_chain(end.node.origin)),
        endpoints=endpoints_of(own, end),
    )


def _place(connection: Connection) -> tuple[Location, str]:
    return connection_location(connection), connection.node.name


def _finding(connections: tuple[Connection, ...], rule: Rule, lacks: str | bool) -> Finding:
    topics, node = sorted({connection.name for connection in connections}), connections[0].node
    have = "has" if len(topics) == 1 else "have"
    return rule.claim(
        say(_LONE, topics=quoted(topics), have=have, node=node.name),
        connection_location(connections[0]),
        subject=Subject("topic", topics[0]),
        doubts=(*doubts(OTHER_LAUNCH=True), *doubts_of_ends(*connections, lacks=lacks)),
        related=include_chain(node.origin),
        endpoints=endpoints_of(*connections),
    )


RULE = Rule(
    id="TOP002",
    name="published-not-subscribed",
    effect="style",
    kind="unused",
    always=(Reason.UNSEEN,),
    sometimes=("breaks", "misbehaves", Reason.OTHER_LAUNCH, Reason.INTENDED, *BY_FILES, *OF_ENDS),
    what="Checks for published topics without a subscriber in the launch, per node. The finding says where a remap "
    "takes the subscriber to the same topic of another robot.",
    why="Most of these topics are fine. If a robot does not move, check them first.",
    example='<remap from="cmd_vel" to="base/cmd_velocity"/> <!-- the base subscribes to base/cmd_vel -->',
    instead='<remap from="cmd_vel" to="base/cmd_vel"/>',
    references=(
        TOPICS,
        TOPICS_2,
    ),
    settings=(
        "external",
        "nodes",
    ),
    check=_check,
    needs_graph=True,
    every_root=True,
)
