"""TOP001: a node subscribes to what nobody publishes."""

from collections.abc import Iterator

from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.model import Connection, Graph
from preflight_analysis.rules.idle_remaps import meant_endpoints
from preflight_analysis.rules.near_miss import (
    NearMiss,
    by_type,
    dangling_consumers,
    dangling_topic_providers,
    fixes,
    lone_of_type,
    nodes_looked_at,
    topic_near_misses,
    weight,
)
from preflight_analysis.rules.places import connection_location, endpoints_of, related_endpoint
from preflight_analysis.rules.problems import include_chain
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    if graph is None:
        return
    # Where a remap that has no effect was meant for the end, TOP004 says so, with the better fix.
    remapped = context.once(meant_endpoints)
    pairs = context.once(topic_near_misses)
    near = [pair for pair in pairs if remapped.isdisjoint((id(pair.consumer), id(pair.provider)))]
    dangling, whole = by_type(context.once(dangling_topic_providers)), nodes_looked_at(graph)
    for pair in near:
        severity, confidence = weight(graph, pair)
        yield rule.finding(
            _near_message(graph, pair),
            connection_location(pair.site),
            severity=severity,
            confidence=confidence,
            related=(
                related_endpoint(pair.other, "publishes" if pair.other is pair.provider else "subscribes to"),
                *include_chain(pair.site.node.origin),
            ),
            fixes=fixes(context, pair),
            endpoints=endpoints_of(pair.consumer, pair.provider),
        )
    explained = {id(pair.consumer) for pair in near} | remapped
    for connection in dangling_consumers(context, "topics"):
        if id(connection) not in explained and not graph.blind:
            sure = graph.complete and not connection.endpoint.uncertain
            lone = lone_of_type(connection, dangling)
            yield context.kept.get(_hint, (connection.name, connection.node.name), rule, whole, connection, lone, sure)


def _near_message(graph: Graph, pair: NearMiss) -> str:
    consumer, provider = pair.consumer, pair.provider
    if pair.site is consumer:
        return (
            f"{nodes_looked_at(graph)} publishes '{consumer.name}', to which {consumer.node.name} subscribes; "
            f"did you mean '{provider.name}', published by {provider.node.name} ({pair.why})?"
        )
    return (
        f"{provider.node.name} publishes '{provider.name}', but {consumer.node.name} subscribes to '{consumer.name}' "
        f"({pair.why}), which {nodes_looked_at(graph)} publishes; did you mean '{consumer.name}'?"
    )


def _hint(rule: Rule, whole: str, connection: Connection, lone: Connection | None, sure: bool) -> Finding:
    kind = f" ({connection.endpoint.type})" if connection.endpoint.type else ""
    message = f"{whole} publishes '{connection.name}'{kind}, to which {connection.node.name} subscribes"
    related = include_chain(connection.node.origin)
    if lone is not None:
        message += f"; '{lone.name}' of {lone.node.name} has this type and no subscriber"
        related = (related_endpoint(lone, "publishes"), *related)
    return rule.finding(
        message,
        connection_location(connection),
        severity="hint",
        confidence="likely" if sure else "possible",
        related=related,
        endpoints=endpoints_of(connection),
    )


RULE = Rule(
    id="TOP001",
    name="subscribed-not-published",
    severity="warning",
    what="Reports a node that subscribes to a topic which no node of the launch publishes. Where one publishes a topic "
    "of a like name and the same type, or one that differs by a leading slash or a namespace, it is a warning that "
    "names both, at the remap that gave the name if there is one; otherwise only a hint, as the publisher may be "
    "started elsewhere, and nothing where a node ended before its event loop: it may be that one's.",
    why="The node waits for messages that never come, and nothing says so: not `roslaunch`, not the node.",
    example='<!-- talker publishes chatter -->\n<node pkg="rospy_tutorials" type="listener" name="listener">\n'
    '  <remap from="chatter" to="chater"/>\n</node>',
    instead='<node pkg="rospy_tutorials" type="listener" name="listener">\n'
    '  <remap from="chatter" to="chatter"/>\n</node>',
    check=_check,
    needs_graph=True,
    every_root=True,
)
