"""TOP003: publisher and subscriber of a topic have different types."""

from collections.abc import Iterator
from itertools import chain

from preflight_analysis.findings.claim import say
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.model import Channel, Connection
from preflight_analysis.model.channels import channels_of, doubts_of_ends
from preflight_analysis.model.context import Context
from preflight_analysis.model.fit import in_short
from preflight_analysis.model.places import Verbs, connection_location, endpoints_of, related_endpoint, subject_of
from preflight_analysis.model.problems import include_chain
from preflight_analysis.rules.further_reading import TOPICS, TOPICS_2
from preflight_analysis.rules.rule import Rule
from preflight_analysis.rules.type_mismatch import OF_MISMATCHES, mismatches

_SAID = "type mismatch on '{name}': {node} {does} {types}"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    yield from mismatches(rule, context, "topics", Verbs("publishes", "subscribes to"))
    for first, second in chain.from_iterable(context.each(_of_one_node, channels_of(context)["topics"])):
        does = "publishes" if first.endpoint.role == "publisher" else "subscribes to"
        types = f"both {first.endpoint.type} and {second.endpoint.type}"
        yield rule.claim(
            say(_SAID, name=first.name, node=first.node.name, does=does, types=types),
            connection_location(second),
            subject=subject_of(first),
            doubts=doubts_of_ends(first, second),
            related=(related_endpoint(first, does), *include_chain(second.node.origin)),
            endpoints=endpoints_of(first, second),
        )


def _of_one_node(channel: Channel) -> tuple[tuple[Connection, Connection], ...]:
    """Ends of the same kind that one node has under the name with two types, which its client library refuses."""
    found: list[tuple[Connection, Connection]] = []
    for ends in (channel.providers, channel.consumers):
        first: dict[int, Connection] = {}
        for end in ends:
            if end.endpoint.type in (None, "*") or end.endpoint.evidence.of_catalogue or end.action is not None:
                continue
            other = first.setdefault(id(end.node), end)
            if in_short(other.endpoint.type or "") != in_short(end.endpoint.type or ""):
                found.append((other, end))
    return tuple(found)


RULE = Rule(
    id="TOP003",
    name="topic-type-mismatch",
    effect="breaks",
    kind="conflict",
    sometimes=("misbehaves", *OF_MISMATCHES),
    what="Checks for a topic whose publisher and subscriber have different types, or different definitions (MD5 "
    "sums) of one type. It also checks for one node that uses a topic with two types.",
    why="The two nodes refuse to connect, with one line in a log. No message arrives.",
    example="<!-- /pose: geometry_msgs/Pose published, geometry_msgs/PoseStamped subscribed -->\n"
    '<remap from="goal" to="/pose"/>',
    instead='<remap from="goal" to="/pose_stamped"/>',
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
