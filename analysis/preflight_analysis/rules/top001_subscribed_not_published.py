"""TOP001: a node subscribes to what nobody publishes."""

from collections.abc import Iterator

from preflight_analysis.documents.document import Document
from preflight_analysis.findings.claim import Text, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.model import Connection
from preflight_analysis.model.context import Context
from preflight_analysis.model.near_miss import OF_NEAR_MISSES, NearMiss, doubts_of
from preflight_analysis.model.nearest import numbers_in
from preflight_analysis.model.places import Verbs, related_endpoint
from preflight_analysis.model.reach import Seen, of_same_type, seen, unmet
from preflight_analysis.model.remaps_elsewhere import BY_FILES, in_use_around, named_in_files
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
    found, known = unmet(context, "topics"), seen(context, graph)
    in_use = [
        is_used or (pair.likeness == "remap" and named_in_files(context, pair.doubtful))
        for pair, is_used in zip(
            found.near, in_use_around(context, [pair.doubtful for pair in found.near]), strict=True
        )
    ]
    columns = (found.near, in_use, *documents_of(context, found.near))
    yield from context.each_row(_near, columns, rule, known)
    if known.blind:
        return
    for each in found.consumers:
        if id(each) in found.elsewhere:
            yield elsewhere_finding(rule, context, each, _lone_message(known, each), found.elsewhere[id(each)])
    others = [each for each in found.consumers if id(each) not in found.elsewhere]
    same = of_same_type(context)
    yield from context.each_row(_hint, (others, [same.get(id(each)) for each in others]), rule, known)


def _near(
    pair: NearMiss, in_use: bool, consumers: Document | None, providers: Document | None, rule: Rule, known: Seen
) -> Finding:
    why = (*doubts(IN_USE=in_use, OUTSIDE=_shows_another(pair)), *doubts_of(pair, known.lacks, known.likely_complete))
    said = _near_message(known, pair)
    return near_miss_finding(rule, pair, said, _VERBS, fixes(pair, consumers, providers), why)


def _shows_another(pair: NearMiss) -> bool:
    """Whether a display shows what has another number, or one: that of a robot which another launch starts."""
    consumer, provider = pair.consumer, pair.provider
    return consumer.endpoint.displayed and numbers_in(consumer.name) != numbers_in(provider.name)


def _near_message(known: Seen, pair: NearMiss) -> Text:
    at, other = pair.site, pair.other
    said = _SUBSCRIBED if at is pair.consumer else _PUBLISHED
    return say(
        said, name=at.name, node=at.node.name, near=other.name, other=other.node.name, why=pair.why, aside=known.aside
    )


def _lone_message(known: Seen, connection: Connection) -> Text:
    return say(_LONE, name=with_type(connection), node=connection.node.name, aside=known.aside)


def _hint(connection: Connection, lone: Connection | None, rule: Rule, known: Seen) -> Finding:
    said = _lone_message(known, connection)
    if lone is None:
        return lone_finding(rule, connection, said, lacks=known.lacks)
    said = said.followed_by(_FITS, near=lone.name, other=lone.node.name)
    return lone_finding(rule, connection, said, lacks=known.lacks, related=(related_endpoint(lone, _VERBS.provides),))


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
