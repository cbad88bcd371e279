"""TOP001: a node subscribes to what nobody publishes."""

from collections.abc import Iterator

from preflight_analysis.documents.document import Document
from preflight_analysis.findings.claim import Text, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.model import Connection
from preflight_analysis.model.channels import not_all_known
from preflight_analysis.model.context import Context
from preflight_analysis.model.dangling import by_type, dangling_consumers, dangling_topic_providers, lone_of_type
from preflight_analysis.model.idle_remaps import meant_endpoints
from preflight_analysis.model.near_miss import OF_NEAR_MISSES, NearMiss, doubts_of, not_analysed
from preflight_analysis.model.near_miss_search import topic_near_misses
from preflight_analysis.model.nearest import numbers_in
from preflight_analysis.model.places import Verbs, related_endpoint, subject_of
from preflight_analysis.model.remaps_elsewhere import BY_FILES, in_use_around, used_elsewhere
from preflight_analysis.rules.further_reading import REMAPPING_DESIGN, TOPICS, TOPICS_2
from preflight_analysis.rules.near_miss_fixes import documents_of, fixes
from preflight_analysis.rules.remaps_elsewhere import elsewhere_finding
from preflight_analysis.rules.rule import Rule
from preflight_analysis.rules.unmatched import lone_finding, near_miss_finding, with_type

_VERBS = Verbs("publishes", "subscribes to")
_SUBSCRIBED = (
    "'{name}' has no publisher (subscriber: {node}); did you mean '{near}', published by {other} ({why}{aside})?"
)
_PUBLISHED = (
    "'{name}', published by {node}: did you mean '{near}'? {other} subscribes to it, and it has no publisher "
    "({why}{aside})"
)
_LONE = "{name} has no publisher in this launch (subscriber: {node}){aside}"
_FITS = "; '{near}', published by {other}, has the same type and no subscriber"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    if graph is None:
        return
    # Where a remap that has no effect was meant for the end, TOP004 says so, with the better fix.
    remapped = meant_endpoints(context)
    pairs = topic_near_misses(context)
    near = [pair for pair in pairs if remapped.isdisjoint((id(pair.consumer), id(pair.provider)))]
    unknown, lacks = not_analysed(graph), not_all_known(graph)
    in_use = in_use_around(context, [pair.consumer for pair in near])
    columns = (near, in_use, *documents_of(context, near))
    yield from context.each_row(_near, columns, rule, unknown, lacks, graph.likely_complete)
    if graph.blind:
        return
    explained = {id(pair.consumer) for pair in near} | remapped
    others = [each for each in dangling_consumers(context, "topics") if id(each) not in explained]
    if len(graph.tree.nodes) == 1:
        # RViz alone shows what another launch publishes.
        others = [each for each in others if not each.endpoint.displayed]
    if others:
        elsewhere = used_elsewhere(context)
        for each in others:
            if id(each) in elsewhere:
                yield elsewhere_finding(rule, context, each, _lone_message(unknown, each), elsewhere[id(each)])
        others = [each for each in others if id(each) not in elsewhere]
        dangling = by_type(context, "topics", dangling_topic_providers(context))
        # Of what a display might show instead its type says nothing.
        of_types = [() if each.endpoint.displayed else dangling.get(each.endpoint.type, ()) for each in others]
        lone = context.each_row(lone_of_type, (others, of_types))
        yield from context.each_row(_hint, (others, lone), rule, unknown, lacks)


def _near(
    pair: NearMiss,
    in_use: bool,
    consumers: Document | None,
    providers: Document | None,
    rule: Rule,
    unknown: str,
    lacks: str | bool,
    likely_complete: bool,
) -> Finding:
    why = (*doubts(IN_USE=in_use, OUTSIDE=_shows_another(pair)), *doubts_of(pair, lacks, likely_complete))
    said = _near_message(unknown, pair)
    return near_miss_finding(rule, pair, said, subject_of(pair.site), _VERBS, fixes(pair, consumers, providers), why)


def _shows_another(pair: NearMiss) -> bool:
    """Whether a display shows what has another number, or one: that of a robot which another launch starts."""
    consumer, provider = pair.consumer, pair.provider
    return consumer.endpoint.displayed and numbers_in(consumer.name) != numbers_in(provider.name)


def _near_message(unknown: str, pair: NearMiss) -> Text:
    at, other = pair.site, pair.other
    said = _SUBSCRIBED if at is pair.consumer else _PUBLISHED
    return say(
        said, name=at.name, node=at.node.name, near=other.name, other=other.node.name, why=pair.why, aside=unknown
    )


def _lone_message(unknown: str, connection: Connection) -> Text:
    return say(_LONE, name=with_type(connection), node=connection.node.name, aside=unknown)


def _hint(connection: Connection, lone: Connection | None, rule: Rule, unknown: str, lacks: str | bool) -> Finding:
    said = _lone_message(unknown, connection)
    if lone is None:
        return lone_finding(rule, connection, said, lacks=lacks)
    said = said.followed_by(_FITS, near=lone.name, other=lone.node.name)
    return lone_finding(rule, connection, said, lacks=lacks, related=(related_endpoint(lone, _VERBS.provides),))


RULE = Rule(
    id="TOP001",
    name="subscribed-not-published",
    effect="breaks",
    kind="absent",
    always=(Reason.UNSEEN,),
    sometimes=(Reason.OTHER_LAUNCH, Reason.IN_USE, *BY_FILES, *OF_NEAR_MISSES),
    what="Checks for a subscriber whose topic has no publisher in the launch. The finding names a topic of a similar "
    "name, or one that differs by a slash or a namespace. There is none if a node exited before its event loop.",
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
