"""QOS001: publisher and subscriber of a topic whose QoS does not fit (ROS 2)."""

from collections.abc import Iterator
from itertools import chain

from preflight_analysis.findings.claim import say
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.channels import OF_ENDS, doubts_of_ends
from preflight_analysis.model.context import Context
from preflight_analysis.model.fit import QosMisfit, qos_misfits
from preflight_analysis.model.places import connection_location, endpoints_of, related_endpoint, subject_of
from preflight_analysis.model.problems import include_chain
from preflight_analysis.rules.further_reading import QOS, QOS_DESIGN
from preflight_analysis.rules.rule import Rule

_MESSAGE = "incompatible QoS on '{name}': {node} publishes {offered}, {other} requests {requested}"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    topics = context.graph.topics.values() if context.graph is not None else ()
    misfits = chain.from_iterable(context.each(qos_misfits, topics))
    yield from context.each(_finding, misfits, rule)


def _finding(misfit: QosMisfit, rule: Rule) -> Finding:
    provider, consumer, _ = misfit
    offered, requested = misfit.sides
    nodes = {"node": provider.node.name, "other": consumer.node.name}
    # The robot moves without what a display shows.
    mild = consumer.endpoint.evidence.assumed or consumer.endpoint.displayed or provider.endpoint.evidence.assumed
    return rule.claim(
        say(_MESSAGE, name=consumer.name, **nodes, offered=offered, requested=requested),
        connection_location(consumer),
        subject=subject_of(consumer),
        effect="misbehaves" if mild else None,
        doubts=doubts_of_ends(consumer, provider, assumed="DEPENDS"),
        related=(related_endpoint(provider, "publishes"), *include_chain(consumer.node.origin)),
        endpoints=endpoints_of(consumer, provider),
    )


RULE = Rule(
    id="QOS001",
    name="incompatible-qos",
    effect="breaks",
    kind="conflict",
    sometimes=("misbehaves", *OF_ENDS),
    what="Checks for a publisher and a subscriber of one topic with incompatible QoS: the subscriber requests more "
    "than the publisher offers. It compares reliability, durability, liveliness and deadline.",
    why="The middleware does not connect them, and no message arrives. At best each side logs a line about "
    "incompatible QoS.",
    example="<!-- the driver publishes /scan as best effort, the filter subscribes to it as reliable -->\n"
    '<node pkg="laser" exec="filter" name="filter"/>',
    instead="subscription = node.create_subscription(LaserScan, 'scan', callback, qos_profile_sensor_data)",
    references=(
        QOS,
        QOS_DESIGN,
    ),
    settings=("nodes",),
    generations=(2,),
    check=_check,
    needs_graph=True,
    every_root=True,
)
