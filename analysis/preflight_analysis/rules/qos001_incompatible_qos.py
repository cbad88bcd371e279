"""QOS001: publisher and subscriber of a topic whose QoS does not fit (ROS 2)."""

from collections.abc import Iterator
from itertools import chain

from preflight_analysis.findings.claim import say
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.model import Channel, Connection
from preflight_analysis.graph.qos import incompatible
from preflight_analysis.model.channels import OF_ENDS, doubts_of_ends
from preflight_analysis.model.context import Context
from preflight_analysis.model.places import connection_location, endpoints_of, related_endpoint, subject_of
from preflight_analysis.model.problems import include_chain
from preflight_analysis.rules.further_reading import QOS, QOS_DESIGN
from preflight_analysis.rules.rule import Rule

_MESSAGE = "incompatible QoS on '{name}': {node} publishes {offered}, {other} requests {requested}"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    if context.graph is not None:
        yield from chain.from_iterable(context.each(_of_topic, context.graph.topics.values(), rule))


def _of_topic(channel: Channel, rule: Rule) -> tuple[Finding, ...]:
    # A topic that all nodes share has as many pairs as nodes squared, and few settings.
    alike: dict[str, list[Connection]] = {}
    for provider in channel.providers if channel.consumers else ():
        alike.setdefault(_settings(provider), []).append(provider)
    problems: dict[tuple[str, str], tuple[str, str] | None] = {}
    found: list[Finding] = []
    for consumer in channel.consumers if channel.providers else ():
        asked = _settings(consumer)
        for offered, providers in alike.items():
            pair = offered, asked
            if pair not in problems:
                problems[pair] = _problem(providers[0], consumer)
            problem = problems[pair]
            if problem is not None:
                found += (_finding(rule, channel, provider, consumer, problem) for provider in providers)
    return tuple(found)


def _finding(
    rule: Rule, channel: Channel, provider: Connection, consumer: Connection, problem: tuple[str, str]
) -> Finding:
    offered, requested = problem
    nodes = {"node": provider.node.name, "other": consumer.node.name}
    # The robot moves without what a display shows.
    mild = consumer.endpoint.evidence.assumed or consumer.endpoint.displayed or provider.endpoint.evidence.assumed
    return rule.claim(
        say(_MESSAGE, name=channel.name, **nodes, offered=offered, requested=requested),
        connection_location(consumer),
        subject=subject_of(consumer),
        effect="misbehaves" if mild else None,
        doubts=doubts_of_ends(consumer, provider, assumed="DEPENDS"),
        related=(related_endpoint(provider, "publishes"), *include_chain(consumer.node.origin)),
        endpoints=endpoints_of(consumer, provider),
    )


def _settings(connection: Connection) -> str:
    return repr(sorted(connection.endpoint.qos.items()))


def _problem(provider: Connection, consumer: Connection) -> tuple[str, str] | None:
    """What the publisher offers, and what the subscription requests; None where they are compatible."""
    policy = incompatible(provider.endpoint, consumer.endpoint)
    if policy is None:
        return None
    name = policy.name.replace("_", " ")
    if isinstance(policy.requested, str):
        kind = "" if policy.name == "reliability" else f" {name}"
        return f"{_said(str(policy.offered))}{kind}", f"{_said(policy.requested)}{kind}"
    offered = f"no {name}" if policy.offered is None else f"{name} {policy.offered} s"
    return offered, f"{name} {policy.requested} s"


def _said(value: str) -> str:
    return value.replace("_", " ")


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
