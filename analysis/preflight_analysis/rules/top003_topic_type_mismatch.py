"""TOP003: publisher and subscriber of a topic have different types."""

from collections.abc import Iterator
from itertools import chain

from preflight_analysis.findings.claim import say
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.channels import channels_of, doubts_of_ends
from preflight_analysis.model.context import Context
from preflight_analysis.model.fit import double_types
from preflight_analysis.model.places import Verbs, connection_location, endpoints_of, related_endpoint, subject_of
from preflight_analysis.model.problems import include_chain
from preflight_analysis.rules.further_reading import TOPICS, TOPICS_2
from preflight_analysis.rules.rule import Rule
from preflight_analysis.rules.type_mismatch import OF_MISMATCHES, mismatches

_SAID = "type mismatch on '{name}': {node} {does} {types}"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    yield from mismatches(rule, context, "topics", Verbs("publishes", "subscribes to"))
    for double in chain.from_iterable(context.each(double_types, channels_of(context)["topics"])):
        first, second = double.first, double.second
        yield rule.claim(
            say(_SAID, name=first.name, node=first.node.name, does=double.does, types=double.types),
            connection_location(second),
            subject=subject_of(first),
            doubts=doubts_of_ends(first, second),
            related=(related_endpoint(first, double.does), *include_chain(second.node.origin)),
            endpoints=endpoints_of(first, second),
        )


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
