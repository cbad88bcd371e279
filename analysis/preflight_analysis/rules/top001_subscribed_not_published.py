"""TOP001: a node subscribes to what nobody publishes."""

from collections.abc import Iterator

from preflight_analysis.documents.document import Document
from preflight_analysis.findings.finding import Confidence, Finding, Severity
from preflight_analysis.graph.model import Connection
from preflight_analysis.rules.dangling import by_type, dangling_consumers, dangling_topic_providers, lone_of_type
from preflight_analysis.rules.further_reading import REMAPPING_DESIGN, TOPICS, TOPICS_2
from preflight_analysis.rules.idle_remaps import meant_endpoints
from preflight_analysis.rules.near_miss import NearMiss, not_analysed, weight
from preflight_analysis.rules.near_miss_fixes import documents_of, fixes
from preflight_analysis.rules.near_miss_search import topic_near_misses
from preflight_analysis.rules.nearest import numbers_in
from preflight_analysis.rules.places import Verbs, related_endpoint
from preflight_analysis.rules.remaps_elsewhere import elsewhere_finding, in_use_around, used_elsewhere
from preflight_analysis.rules.rule import Context, Rule
from preflight_analysis.rules.unmatched import lone_finding, near_miss_finding, with_type

_VERBS = Verbs("publishes", "subscribes to")


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    if graph is None:
        return
    # Where a remap that has no effect was meant for the end, TOP004 says so, with the better fix.
    remapped = context.once(meant_endpoints)
    pairs = context.once(topic_near_misses)
    near = [pair for pair in pairs if remapped.isdisjoint((id(pair.consumer), id(pair.provider)))]
    unknown = not_analysed(graph)
    in_use = in_use_around(context, [pair.consumer for pair in near])
    columns = (near, in_use, *documents_of(context, near))
    yield from context.kept.each_row(_near, columns, rule, unknown, graph.complete, graph.likely_complete)
    if graph.blind:
        return
    explained = {id(pair.consumer) for pair in near} | remapped
    others = [each for each in dangling_consumers(context, "topics") if id(each) not in explained]
    if len(graph.tree.nodes) == 1:
        # RViz alone shows what another launch publishes.
        others = [each for each in others if not each.endpoint.displayed]
    if others:
        elsewhere = context.once(used_elsewhere)
        for each in others:
            if id(each) in elsewhere:
                yield elsewhere_finding(rule, context, each, _lone_message(unknown, each), elsewhere[id(each)])
        others = [each for each in others if id(each) not in elsewhere]
        dangling = by_type(context, "topics", context.once(dangling_topic_providers))
        # Of what a display might show instead its type says nothing.
        of_types = [() if each.endpoint.displayed else dangling.get(each.endpoint.type, ()) for each in others]
        lone = context.kept.each_row(lone_of_type, (others, of_types))
        yield from context.kept.each_row(_hint, (others, lone), rule, unknown, graph.complete)


def _near(
    pair: NearMiss,
    in_use: bool,
    consumers: Document | None,
    providers: Document | None,
    rule: Rule,
    unknown: str,
    complete: bool,
    likely_complete: bool,
) -> Finding:
    severity, confidence = weight(pair, complete, likely_complete)
    mild = severity == "warning" and (in_use or _shows_another(pair))
    weighed: tuple[Severity, Confidence] = ("info" if mild else severity, confidence)
    return near_miss_finding(
        rule, pair, _near_message(unknown, pair), _VERBS, fixes(pair, consumers, providers), weighed
    )


def _shows_another(pair: NearMiss) -> bool:
    """Whether a display shows what has another number, or one: that of a robot which another launch starts."""
    consumer, provider = pair.consumer, pair.provider
    return consumer.endpoint.displayed and numbers_in(consumer.name) != numbers_in(provider.name)


def _near_message(unknown: str, pair: NearMiss) -> str:
    consumer, provider = pair.consumer, pair.provider
    if pair.site is consumer:
        return (
            f"'{consumer.name}' has no publisher (subscriber: {consumer.node.name}); did you mean "
            f"'{provider.name}', published by {provider.node.name} ({pair.why}{unknown})?"
        )
    return (
        f"'{provider.name}', published by {provider.node.name}: did you mean '{consumer.name}'? {consumer.node.name} "
        f"subscribes to it, and it has no publisher ({pair.why}{unknown})"
    )


def _lone_message(unknown: str, connection: Connection) -> str:
    return f"{with_type(connection)} has no publisher in this launch (subscriber: {connection.node.name}){unknown}"


def _hint(connection: Connection, lone: Connection | None, rule: Rule, unknown: str, whole: bool) -> Finding:
    message = _lone_message(unknown, connection)
    if lone is None:
        return lone_finding(rule, connection, message, whole=whole)
    message += f"; '{lone.name}', published by {lone.node.name}, has the same type and no subscriber"
    return lone_finding(rule, connection, message, whole=whole, related=(related_endpoint(lone, _VERBS.provides),))


RULE = Rule(
    id="TOP001",
    name="subscribed-not-published",
    severity="warning",
    what="Checks for a subscriber whose topic has no publisher in the launch. The finding is a warning if a node "
    "publishes a topic of the same type and a similar name. The names may also differ by a leading slash or a "
    "namespace. It names both and is at the remap that set the name, if there is one. It is information if several "
    "launch files nearby write the topic, if a plugin of a simulator has it, or if a display of RViz has another "
    "number in its topic. It is information too if the remap is a typo of one in several launch files, or if "
    "the source of one of the nodes has more topics of the type whose names are not known. It is a warning "
    "if the topic is a typo of one that sources of the workspace use with the same type. The same applies if a slash "
    "is missing (`/zed/nodergb/info`) that another remap of the node has (`/zed/node/rgb/image`). Otherwise it is a "
    "hint, because another launch may start the publisher. There is no finding if a node exited before its event loop, "
    "because it may be the publisher.",
    why="The node waits for messages that never arrive. Neither the launcher nor the node reports it.",
    example='<!-- talker publishes chatter -->\n<node pkg="rospy_tutorials" type="listener" name="listener">\n'
    '  <remap from="chatter" to="chater"/>\n</node>',
    instead='<node pkg="rospy_tutorials" type="listener" name="listener">\n'
    '  <remap from="chatter" to="chatter"/>\n</node>',
    references=(
        TOPICS,
        TOPICS_2,
        REMAPPING_DESIGN,
    ),
    settings=(
        "external",
        "nodes",
    ),
    check=_check,
    needs_graph=True,
    every_root=True,
)
