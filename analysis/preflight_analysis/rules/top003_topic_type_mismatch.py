"""TOP003: publisher and subscriber of a topic have different types."""

from collections.abc import Iterator
from itertools import chain

from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.model import Channel, Connection
from preflight_analysis.rules.channels import channels_of
from preflight_analysis.rules.further_reading import TOPICS, TOPICS_2
from preflight_analysis.rules.places import Verbs, connection_location, endpoints_of, related_endpoint
from preflight_analysis.rules.problems import include_chain
from preflight_analysis.rules.rule import Context, Rule
from preflight_analysis.rules.type_mismatch import in_short, mismatches


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    yield from mismatches(rule, context, "topics", Verbs("publishes", "subscribes to"))
    for first, second in chain.from_iterable(context.kept.each(_of_one_node, channels_of(context)["topics"])):
        does = "publishes" if first.endpoint.role == "publisher" else "subscribes to"
        yield rule.finding(
            f"type mismatch on '{first.name}': {first.node.name} {does} both {first.endpoint.type} and "
            f"{second.endpoint.type}",
            connection_location(second),
            severity="info" if first.endpoint.assumed or second.endpoint.assumed else None,
            confidence="possible" if first.endpoint.assumed or second.endpoint.assumed else "likely",
            related=(related_endpoint(first, does), *include_chain(second.node.origin)),
            endpoints=endpoints_of(first, second),
        )


def _of_one_node(channel: Channel) -> tuple[tuple[Connection, Connection], ...]:
    """Ends of the same kind that one node has under the name with two types, which its client library refuses."""
    found: list[tuple[Connection, Connection]] = []
    for ends in (channel.providers, channel.consumers):
        first: dict[int, Connection] = {}
        for end in ends:
            if end.endpoint.type in (None, "*") or end.endpoint.catalogued or end.action is not None:
                continue
            other = first.setdefault(id(end.node), end)
            if in_short(other.endpoint.type or "") != in_short(end.endpoint.type or ""):
                found.append((other, end))
    return tuple(found)


RULE = Rule(
    id="TOP003",
    name="topic-type-mismatch",
    severity="error",
    what="Checks for a topic whose publisher and subscriber have different types, or different definitions (MD5 "
    "sums) of one type. `*` matches any type. It also checks for one node that uses a topic with two types. The "
    "finding is a warning if the subscriber is a display in the configuration of RViz. Where a parameter decides the "
    "type, such as `enable_stamped_cmd_vel` of Nav2, the finding names it.",
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
