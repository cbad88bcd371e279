"""TOP006: the same nodes in two namespaces meet on one topic, as its name is absolute."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.claim import say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.graph.model import Channel, Connection
from preflight_analysis.model.channels import OF_ENDS, doubts_of_ends
from preflight_analysis.model.context import Context
from preflight_analysis.model.places import connection_location, endpoints_of, related_endpoint, subject_of
from preflight_analysis.model.problems import include_chain, rename
from preflight_analysis.model.well_known import is_transform, may_dangle
from preflight_analysis.rules.further_reading import NAMES, TOPIC_NAMES
from preflight_analysis.rules.rule import Rule

_Kind = tuple[str, str]
"""Package and executable of a node."""
_SAID = "'{name}' is outside of the namespaces of both robots: {node} receives from {theirs} and {mine}"
_Pair = tuple[Connection, Connection]
_SHARED = (
    "visualization_msgs/",
    "diagnostic_msgs/",
    "rosgraph_msgs/",
    "std_msgs/Header",
    "sensor_msgs/JointState",
    "sensor_msgs/msg/JointState",
)
"""Types whose messages say whose they are."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for channel in context.graph.topics.values() if context.graph is not None else ():
        if len(channel.providers) < 2 or len(channel.consumers) < 2 or channel.external or is_transform(channel.name):
            continue
        providers, consumers = _twins(channel, channel.providers), _twins(channel, channel.consumers)
        for kind, (mine, theirs) in providers.items():
            # Who says something on a topic and hears it there too talks to its like.
            hearing = (
                None
                if kind in consumers
                else next((pair for pair in consumers.values() if _same(pair, mine, theirs)), None)
            )
            if hearing is not None:
                yield _finding(rule, context, channel, (mine, theirs), hearing)
                break


def _twins(channel: Channel, connections: tuple[Connection, ...]) -> dict[_Kind, _Pair]:
    """Nodes that are started in two namespaces, of which none is in the other, while the topic is in neither."""
    first: dict[_Kind, Connection] = {}
    found: dict[_Kind, _Pair] = {}
    for connection in connections:
        namespace, kind = connection.node.namespace, (connection.node.package, connection.node.executable)
        known = may_dangle(channel.name, connection.endpoint) or (connection.endpoint.type or "").startswith(_SHARED)
        if namespace == "/" or known or connection.action is not None or channel.name.startswith(namespace):
            continue
        other = first.setdefault(kind, connection)
        apart = not namespace.startswith(other.node.namespace) and not other.node.namespace.startswith(namespace)
        if apart and kind not in found:
            found[kind] = other, connection
    return found


def _same(pair: _Pair, mine: Connection, theirs: Connection) -> bool:
    """Whether these are of the same two robots."""
    return {connection.node.namespace for connection in pair} == {mine.node.namespace, theirs.node.namespace}


def _finding(rule: Rule, context: Context, channel: Channel, saying: _Pair, hearing: _Pair) -> Finding:
    mine, theirs = saying
    listener = next(connection for connection in hearing if connection.node.namespace == mine.node.namespace)
    connections = (*saying, *hearing)
    # A name like `/fleet/poses` that the code itself has is rather meant so than `/cmd_vel`.
    meant = channel.name.count("/") > 1 and not any(connection.remap for connection in connections)
    related = [
        related_endpoint(mine, "publishes"),
        *(related_endpoint(connection, "subscribes") for connection in hearing),
    ]
    nodes = {"node": listener.node.name, "theirs": theirs.node.name, "mine": mine.node.name}
    return rule.claim(
        say(_SAID, name=channel.name, **nodes),
        connection_location(theirs),
        subject=subject_of(theirs),
        doubts=(*doubts(INTENDED=meant), *doubts_of_ends(*connections)),
        related=(*related, *include_chain(theirs.node.origin)),
        fixes=_fixes(context, theirs),
        endpoints=endpoints_of(*connections),
    )


def _fixes(context: Context, connection: Connection) -> tuple[Fix, ...]:
    """The target of the remap without its slash."""
    if connection.remap is None or not connection.remap.target.startswith("/"):
        return ()
    return rename(
        context, connection.remap.target_location, connection.remap.target, connection.remap.target.lstrip("/")
    )


RULE = Rule(
    id="TOP006",
    name="shared-by-robots",
    effect="misbehaves",
    kind="conflict",
    always=(Reason.UNSEEN,),
    sometimes=(Reason.INTENDED, *OF_ENDS),
    what="Checks for a topic outside of the namespaces of two robots that each robot publishes and subscribes to "
    "with different nodes. Two robots are the same executables in two namespaces.",
    why="A namespace separates robots only while names are relative. With an absolute name the commands of one "
    "robot move the other as well.",
    example='<group>\n  <push_ros_namespace namespace="robot1"/>\n'
    '  <node pkg="base" exec="driver"><remap from="cmd_vel" to="/cmd_vel"/></node>\n</group>',
    instead='<group>\n  <push_ros_namespace namespace="robot1"/>\n  <node pkg="base" exec="driver"/>\n</group>',
    references=(
        NAMES,
        TOPIC_NAMES,
    ),
    settings=(
        "external",
        "nodes",
    ),
    check=_check,
    needs_graph=True,
    every_root=True,
)
