"""LCH035: a lifecycle node that nothing activates (ROS 2)."""

from collections.abc import Iterator

from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.lifecycle import inactive_nodes
from preflight_analysis.model.named_nodes import managed_by
from preflight_analysis.model.places import attribute_location
from preflight_analysis.model.problems import include_chain, quoted
from preflight_analysis.rules.further_reading import LIFECYCLE, LIFECYCLE_MANAGER
from preflight_analysis.rules.rule import Rule
from preflight_analysis.tracing.interface import Interface


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    waiting, managed, graph = inactive_nodes(context), managed_by(context), context.graph
    # A launch of such a node alone is for somebody who activates it by hand.
    beside = len({id(each.node) for each in waiting}) < len(context.tree.nodes)
    known = graph is not None and context.tree.complete and all(map(_is_known, graph.interfaces))
    for node, lacking in waiting:
        who = f"the lifecycle managers manage {quoted(list(managed)[:3])}" if managed else "no lifecycle manager"
        what = "never activated" if lacking == "configure" else "configured, but never activated"
        yield rule.claim(
            say(
                "lifecycle node {node} is {what} by this launch ({who}); it does nothing until it is active",
                node=node.name,
                what=what,
                who=who,
            ),
            attribute_location(context, node, "exec"),
            subject=Subject("node", node.name),
            doubts=doubts(OUTSIDE=not known, INTENDED=not beside),
            related=include_chain(node.origin),
        )


def _is_known(interface: Interface) -> bool:
    """Whether a client of the service by which states are changed would be known."""
    return interface.likely_complete or interface.source == "catalogue"


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
