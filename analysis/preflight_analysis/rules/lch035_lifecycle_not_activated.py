"""LCH035: a lifecycle node that nothing activates (ROS 2)."""

from collections.abc import Iterator

from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.lifecycle import inactive_nodes
from preflight_analysis.model.places import attribute_location
from preflight_analysis.model.problems import include_chain
from preflight_analysis.rules.further_reading import LIFECYCLE, LIFECYCLE_MANAGER
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for each in inactive_nodes(context):
        yield rule.claim(
            say("lifecycle node {node} {reason}", node=each.node.name, reason=each.reason),
            attribute_location(context, each.node, "exec"),
            subject=Subject("node", each.node.name),
            doubts=each.doubts,
            related=include_chain(each.node.origin),
        )


RULE = Rule(
    id="LCH035",
    name="lifecycle-not-activated",
    effect="misbehaves",
    kind="unreachable",
    sometimes=(Reason.OUTSIDE, Reason.INTENDED),
    what="Checks for a lifecycle node that no `lifecycle_manager` of the launch has in its `node_names`. Neither its "
    "own code, nor an event of the launch, nor `ros2 lifecycle set` activates it.",
    why="A lifecycle node starts unconfigured. It publishes nothing and serves only its state changes until another "
    "node configures and activates it.",
    example='<node pkg="nav2_map_server" exec="map_server" name="map_server"/>',
    instead='<node pkg="nav2_map_server" exec="map_server" name="map_server"/>\n'
    '<node pkg="nav2_lifecycle_manager" exec="lifecycle_manager" name="lifecycle_manager_map">\n'
    '  <param name="autostart" value="true"/>\n  <param name="node_names" value="[map_server]"/>\n</node>',
    references=(
        LIFECYCLE,
        LIFECYCLE_MANAGER,
    ),
    settings=("nodes",),
    generations=(2,),
    check=_check,
    every_root=True,
)
