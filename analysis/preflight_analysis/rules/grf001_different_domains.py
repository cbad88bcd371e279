"""GRF001: two nodes have ends of one name and cannot reach each other."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import chain

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.domains import MIDDLEWARE, Difference, Domain, differences, domain_of, processes_of
from preflight_analysis.graph.model import Channel, Connection
from preflight_analysis.rules.channels import channels_of
from preflight_analysis.rules.further_reading import DOMAINS, MASTER
from preflight_analysis.rules.further_reading import MIDDLEWARE as ABOUT_MIDDLEWARE
from preflight_analysis.rules.places import endpoints_of, related_endpoint
from preflight_analysis.rules.problems import include_chain
from preflight_analysis.rules.rule import Context, Rule

_BRIDGES = ("domain_bridge", "zenoh", "multimaster", "master_sync", "foreign_relay")
"""In the package, executable or arguments of what carries messages from one domain or master to another."""

_Pair = tuple[Connection, Connection, Difference]
"""A consumer, a provider, and what keeps them apart."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    if graph is None or not graph.tree.complete:
        return
    nodes, processes = graph.tree.nodes, processes_of(graph.tree)
    domains = context.kept.each(domain_of, processes, context.environment.variables, graph.tree.generation)
    if len(set(domains)) < 2 or any(map(_is_bridge, nodes)):
        return
    by_node = {id(node): domain for node, domain in zip(nodes, domains, strict=True)}
    by_process = {id(node): process for node, process in zip(nodes, processes, strict=True)}
    found: dict[tuple[int, int], list[_Pair]] = {}
    for channel in chain.from_iterable(channels_of(context).values()):
        for pair in _apart(channel, by_node):
            found.setdefault((id(pair[0].node), id(pair[1].node)), []).append(pair)
    for pairs in found.values():
        consumer, provider, _ = pairs[0]
        setter, other = consumer, provider
        place = _setting(context, by_process[id(consumer.node)], pairs[0][2].variable)
        if place is None:
            place = _setting(context, by_process[id(provider.node)], pairs[0][2].variable)
            setter, other = (provider, consumer) if place is not None else (consumer, provider)
        yield rule.finding(
            _message(pairs),
            place or setter.node.location,
            confidence="possible" if consumer.endpoint.uncertain or provider.endpoint.uncertain else "likely",
            related=(
                related_endpoint(other, "offers" if other is provider else "uses"),
                *include_chain(setter.node.origin),
            ),
            endpoints=endpoints_of(*chain.from_iterable(pair[:2] for pair in pairs)),
        )


def _is_bridge(node: LaunchNode) -> bool:
    return any(word in text for word in _BRIDGES for text in (node.package, node.executable, node.args))


def _apart(channel: Channel, domains: Mapping[int, Domain | None]) -> Iterator[_Pair]:
    """Each consumer that can reach no provider, with the first one."""
    if channel.external or not channel.providers:
        return
    for consumer in channel.consumers:
        mine = domains[id(consumer.node)]
        if mine is None or consumer.action is not None or consumer.endpoint.builtin:
            continue
        kept_apart = []
        for provider in channel.providers:
            theirs = domains[id(provider.node)]
            between = differences(theirs, mine) if theirs is not None else ()
            kept_apart.append(next((each for each in between if each.separates), None))
        if kept_apart[0] is not None and None not in kept_apart:
            yield consumer, channel.providers[0], kept_apart[0]


def _setting(context: Context, process: LaunchNode | None, variable: str) -> Location | None:
    """The value of the variable in a node's own tag, if it is there."""
    for child in process.action.children if process is not None else ():
        name, value = child.value("name"), child.value("value")
        if process is not None and child.kind == "env" and name is not None and name.text == variable and value:
            return context.location(process.location.file, value.span)
    return None


def _message(pairs: list[_Pair]) -> str:
    consumer, provider, difference = pairs[0]
    more = f" and {len(pairs) - 1} more" if len(pairs) > 1 else ""
    fact = f"{'are' if more else 'is'} not shared{' reliably' if difference.variable == MIDDLEWARE else ''}"
    return (
        f"'{consumer.name}'{more} {fact}: {provider.node.name} has {difference.variable} {difference.one}, "
        f"{consumer.node.name} has {difference.other}"
    )


RULE = Rule(
    id="GRF001",
    name="different-domains",
    severity="warning",
    what="Checks for a subscriber or client whose only publishers or servers have another `ROS_DOMAIN_ID`, "
    "`RMW_IMPLEMENTATION` or `ROS_MASTER_URI`. Two middlewares are compared if both are set. There is one finding for "
    "two nodes, at the setting. There is no finding if the launch starts a bridge of domains or masters, or if a part "
    "of the launch is unresolved. Discovery ranges are not compared, because nodes on one host still find each other.",
    why="Each node finds only nodes of its own domain, or of its own master. The names are equal, and no message "
    "arrives.",
    example='<node pkg="laser" exec="driver" name="laser">\n  <env name="ROS_DOMAIN_ID" value="5"/>\n</node>\n'
    '<node pkg="mapping" exec="mapper" name="mapper"/>',
    instead='<set_env name="ROS_DOMAIN_ID" value="5"/>\n<node pkg="laser" exec="driver" name="laser"/>\n'
    '<node pkg="mapping" exec="mapper" name="mapper"/>',
    references=(DOMAINS, ABOUT_MIDDLEWARE, MASTER),
    settings=("external", "nodes"),
    check=_check,
    needs_graph=True,
    every_root=True,
)
