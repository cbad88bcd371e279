"""ACT003: two nodes offer one action."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.claim import say
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.channels import OF_ENDS, doubts_of_ends
from preflight_analysis.model.context import Context
from preflight_analysis.model.places import connection_location, endpoints_of, related_endpoint, subject_of
from preflight_analysis.model.problems import include_chain
from preflight_analysis.rules.further_reading import ACTIONLIB, ACTIONS
from preflight_analysis.rules.rule import Rule

_SAID = "action '{name}' has {number} servers ({node}{more}): each executes every goal"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    if context.graph is None:
        return
    for channel in context.graph.actions.values():
        servers = list({c.node.name: c for c in channel.providers}.values())
        if len(servers) < 2:
            continue
        # A remap that brings them together is the place to change; else the later of the nodes.
        servers.sort(key=lambda c: c.is_placed)
        more = "".join(f" and {each.node.name}" for each in servers[1:])
        yield rule.claim(
            say(_SAID, name=channel.name, number=len(servers), node=servers[0].node.name, more=more),
            connection_location(servers[-1]),
            subject=subject_of(servers[0]),
            doubts=doubts_of_ends(*servers, assumed="DEPENDS"),
            related=(*(related_endpoint(c, "serves") for c in servers[:-1]), *include_chain(servers[-1].node.origin)),
            endpoints=endpoints_of(*servers),
        )


RULE = Rule(
    id="ACT003",
    name="action-offered-twice",
    effect="misbehaves",
    kind="duplicate",
    sometimes=OF_ENDS,
    what="Checks for an action that two nodes of the launch serve under one name.",
    why="A goal is a message on a topic (ROS 1) or a request that each server of the name receives (ROS 2). Both "
    "servers execute each goal, and the client takes the first result.",
    example='<node pkg="base" type="dock" name="left"/> <!-- both offer /dock -->\n'
    '<node pkg="base" type="dock" name="right"/>',
    instead='<node pkg="base" type="dock" name="left" ns="left"/>\n'
    '<node pkg="base" type="dock" name="right" ns="right"/>',
    references=(
        ACTIONLIB,
        ACTIONS,
    ),
    settings=("nodes",),
    check=_check,
    needs_graph=True,
    every_root=True,
)
