"""SRV003: two nodes offer one service."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from preflight_analysis.documents.span import Location
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.model import Connection
from preflight_analysis.model.channels import OF_ENDS, doubts_of_ends
from preflight_analysis.model.context import Context
from preflight_analysis.model.places import connection_location, endpoints_of, related_endpoint
from preflight_analysis.model.problems import include_chain, quoted
from preflight_analysis.rules.further_reading import MASTER, SERVICES, SERVICES_2
from preflight_analysis.rules.rule import Rule
from preflight_analysis.tracing.nodelets import manager_of

_SAID = "{services} {number} servers ({node}{more}): {happens}"
_BOTH_ANSWER = "each executes every request, and the client takes the first answer"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    if context.graph is None:
        return
    # Two nodes of a kind share all their services: one finding for all that stand at one place.
    found: dict[tuple[Location, tuple[str, ...]], list[tuple[str, list[Connection]]]] = {}
    for channel in context.graph.services.values():
        servers = list(
            {c.node.name: c for c in channel.providers if not c.endpoint.builtin and c.action is None}.values()
        )
        if len(servers) > 1:
            # A remap that brings them together is the place to change; else the later of the nodes.
            servers.sort(key=lambda c: c.is_placed)
            key = (connection_location(servers[-1]), tuple(c.node.name for c in servers))
            found.setdefault(key, []).append((channel.name, servers))
    for (location, nodes), offered in found.items():
        names, servers = [name for name, _ in offered], offered[0][1]
        services = f"service {quoted(names)} has" if len(names) == 1 else f"services {quoted(names)} have"
        more = "".join(f" and {node}" for node in nodes[1:])
        number, happens = len(nodes), _what_happens(context, servers)
        yield rule.claim(
            say(_SAID, services=services, number=number, node=nodes[0], more=more, happens=happens),
            location,
            subject=Subject("service", names[0]),
            doubts=doubts_of_ends(*servers),
            related=(*(related_endpoint(c, "serves") for c in servers[:-1]), *include_chain(servers[-1].node.origin)),
            endpoints=endpoints_of(*(c for _, connections in offered for c in connections)),
        )


def _what_happens(context: Context, servers: Sequence[Connection]) -> str:
    if context.tree.ros.all_servers_answer:
        return _BOTH_ANSWER
    managers = {manager_of(server.node) for server in servers}
    if len(managers) == 1 and (manager := managers.pop()) is not None:
        return f"their manager {manager} accepts only the first"
    return "only the last to register receives calls"


RULE = Rule(
    id="SRV003",
    name="service-offered-twice",
    effect="misbehaves",
    kind="duplicate",
    sometimes=OF_ENDS,
    what="Checks for a service that two nodes of the launch serve under one name.",
    why="The master of ROS 1 knows one server for a service. The node that registers last replaces the other, and "
    "the order differs from start to start. Two nodelets of one manager are one node, which refuses the second "
    "server. In ROS 2 each server receives each request and executes it. The client takes the first answer.",
    example='<node pkg="base" type="driver" name="left"/> <!-- both offer /reset -->\n'
    '<node pkg="base" type="driver" name="right"/>',
    instead='<node pkg="base" type="driver" name="left" ns="left"/>\n'
    '<node pkg="base" type="driver" name="right" ns="right"/>',
    references=(
        SERVICES,
        MASTER,
        SERVICES_2,
    ),
    settings=("nodes",),
    check=_check,
    needs_graph=True,
    every_root=True,
)
