"""LCH044: a parameter or argument names a node that the launch does not start."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.model.context import Context
from preflight_analysis.model.named_nodes import missing_nodes
from preflight_analysis.model.nearest import did_you_mean
from preflight_analysis.model.problems import include_chain, rename
from preflight_analysis.rules.further_reading import LIFECYCLE_MANAGER
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    complete = context.tree.complete
    for named, near in missing_nodes(context).each:
        if near is None and not complete:
            continue
        node, location, written = named.node, named.location(context), str(named.meant.value)
        new = None
        if near is not None:
            below = f"{named.name[: len(named.name) - len(written)]}" if not written.startswith("/") else ""
            new = near.removeprefix(below) if near.startswith(below) else near
        yield rule.claim(
            say(
                "'{name}' is not a node of this launch; {node} waits for it{near}",
                name=named.name,
                node=node.name,
                near=did_you_mean(near),
            ),
            location,
            subject=Subject("node", named.name),
            kind="absent" if near is None else "near",
            doubts=doubts(OUTSIDE=near is None, NOT_ANALYSED=not complete),
            candidates=(near,),
            related=(Related(f"{node.name}", node.location), *include_chain(named.origin)),
            fixes=rename(context, location, written, new) if new is not None else (),
        )


RULE = Rule(
    id="LCH044",
    name="named-node-not-found",
    effect="misbehaves",
    kind="near",
    sometimes=(Reason.OUTSIDE, Reason.NOT_ANALYSED),
    what="Checks for the name of a node, in a parameter or argument, that no node of the launch has. An example is "
    "`node_names` of a `lifecycle_manager`.",
    why="The node that has the name waits for the services of the other one. A lifecycle manager activates none of its "
    "nodes then.",
    example='<node pkg="nav2_map_server" exec="map_server" name="map_server"/>\n'
    '<node pkg="nav2_lifecycle_manager" exec="lifecycle_manager" name="lifecycle_manager_map">\n'
    '  <param name="node_names" value="[map_sever]"/>\n</node>',
    instead='<param name="node_names" value="[map_server]"/>',
    references=(LIFECYCLE_MANAGER,),
    settings=("knowledge",),
    check=_check,
    every_root=True,
)
