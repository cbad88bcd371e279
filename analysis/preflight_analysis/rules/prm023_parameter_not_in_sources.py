"""PRM023: a parameter whose name is in no source of the workspace, which has one of a similar name."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterator, Mapping

from preflight_analysis.environment.model import Package
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.graph.model import Graph
from preflight_analysis.model.context import Context
from preflight_analysis.model.parameters import grouped, namespace_of, renamed
from preflight_analysis.model.params_in_sources import Asked, meant_in_one_file, meant_in_sources
from preflight_analysis.model.places import related_node
from preflight_analysis.model.problems import include_chain, replacement
from preflight_analysis.model.unread_params import reports_params
from preflight_analysis.model.well_known import is_for_tools, is_of_planning
from preflight_analysis.rules.further_reading import PARAMETER_SERVER, PARAMETERS
from preflight_analysis.rules.rule import Rule
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.request import split_args

MESSAGE = "parameter '{}' is in no source of the workspace; did you mean '{}', which {} reads?"
_LEAST = 4
"""Parameters that stand together beside the nodes, of which most are those of one source."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    if graph is None:
        return
    by_node = _below_nodes(context, graph)
    reported: set[object] = set()
    for node, interface in zip(graph.tree.nodes, graph.interfaces, strict=True):
        package = _of_workspace(context, node)
        if package is None or _others_speak(context, interface):
            continue
        params = node.params if context.tree.ros.ament else by_node.get(node.name, ())
        taken = {use.name.strip("~/") for use in interface.params}
        given = {_below(node, param) for param in params}
        found: dict[str, list[tuple[Param, Asked]]] = {}
        for param in params:
            name = _below(node, param)
            if name in taken or is_for_tools(param.name) or is_of_planning(name) or param.place in reported:
                continue
            asked = meant_in_sources(context.disk.db, context.environment, package.share, name)
            if asked is not None and (meant := _renamed(name, asked)) not in given:
                found.setdefault(meant, []).append((param, asked))
        # Two that are like one are no slips of it.
        for param, asked in (alike[0] for alike in found.values() if len(alike) == 1):
            reported.add(param.place)
            yield _finding(rule, context, node, param, asked)
    if not context.tree.ros.ament:
        yield from _beside_nodes(rule, context, graph, by_node)


def _beside_nodes(
    rule: Rule, context: Context, graph: Graph, by_node: Mapping[str, Collection[Param]]
) -> Iterator[Finding]:
    """Of files of parameters that are loaded in a namespace, where the nodes of the launch ask for most of them."""
    nodes = {node.name for node in graph.tree.nodes}
    packages = filter(None, (_of_workspace(context, node) for node in graph.tree.nodes))
    shares = tuple(sorted({package.share for package in packages}))
    read = {each.name for each in graph.param_reads}
    owned = {id(param) for params in by_node.values() for param in params}
    loose = [param for param in context.tree.all_params if id(param) not in owned and param.name not in nodes]
    for namespace, group in grouped(loose).items() if shares else ():
        by_file: dict[str, list[Param]] = {}
        for param in group:
            by_file.setdefault(param.place.file, []).append(param)
        for params in by_file.values():
            if len(params) < _LEAST or all(param.name in read for param in params):
                continue
            leaves = {names.leaf(param.name): param for param in params}
            found = meant_in_one_file(context.disk.db, context.environment, shares, tuple(sorted(leaves)))
            for leaf, asked in found.items():
                if leaves[leaf].name not in read and f"{namespace}/{asked.name}" not in graph.tree.params:
                    yield _finding(rule, context, None, leaves[leaf], asked)


def _below_nodes(context: Context, graph: Graph) -> Mapping[str, tuple[Param, ...]]:
    """ROS 1: the parameters below the name of each node."""
    nodes, found = {node.name for node in graph.tree.nodes}, dict[str, tuple[Param, ...]]()
    groups = context.grouped(namespace_of, "params in sources", context.tree.all_params)
    for namespace, params in groups.items() if not context.tree.ros.ament else ():
        home = namespace
        while home and home not in nodes:
            home = home.rpartition("/")[0]
        if home:
            found[home] = (*found.get(home, ()), *params)
    return found


def _of_workspace(context: Context, node: LaunchNode) -> Package | None:
    """The package of the node's program, of a nodelet that of its class, if that is in the workspace."""
    name = node.package
    if node.package == "nodelet":
        words = [word for word in split_args(node.args) if not word.startswith("-")]
        name = words[1].partition("/")[0] if len(words) > 1 else ""
    package, environment = context.environment.packages.get(name), context.environment
    return None if package is None or environment.is_installed(package) else package


def _others_speak(context: Context, interface: Interface) -> bool:
    """Whether the parameters of the node are known, so that PRM001 or PRM013 says which of them it does not read."""
    lists = any(use.access == "list" for use in interface.params)
    if not context.tree.ros.ament:
        return interface.tells_all("parameters")
    return interface.source != "none" and not lists and bool(interface.params or reports_params(interface))


def _below(node: LaunchNode, param: Param) -> str:
    return param.name.removeprefix(f"{node.name}/")


def _renamed(name: str, asked: Asked) -> str:
    """The name with the last part of what is asked for."""
    cut = max(name.rfind("/"), name.rfind(".")) + 1
    return name[:cut] + asked.name


def _finding(rule: Rule, context: Context, node: LaunchNode | None, param: Param, asked: Asked) -> Finding:
    return rule.claim(
        MESSAGE.format(_last(param.name), asked.name, os.path.basename(asked.path)),
        param.place,
        subject=Subject("parameter", param.name),
        candidates=(asked.name,),
        related=(*((related_node(node),) if node is not None else ()), *include_chain(param.origin)),
        fixes=_fixes(context, param, asked),
    )


def _last(name: str) -> str:
    return name.replace(".", "/").rpartition("/")[2]


def _fixes(context: Context, param: Param, asked: Asked) -> tuple[Fix, ...]:
    new = _renamed(param.name, asked)
    if not context.tree.ros.ament:
        return renamed(context, param, new)
    location = param.name_location
    if location is None or context.text(location) != _last(param.name):
        return ()
    return replacement(context, location, asked.name, f"Rename '{_last(param.name)}' to '{asked.name}'")


RULE = Rule(
    id="PRM023",
    name="parameter-not-in-sources",
    effect="no-effect",
    kind="near",
    always=(Reason.NOT_ANALYSED,),
    sometimes=(Reason.NOT_GIVEN,),
    what="Checks for a parameter of a node of the workspace whose name is in no source of the workspace, while the "
    "node's package reads one of a similar name that is not set. Parameters that PRM001 and PRM013 know are not "
    "checked.",
    why="The node uses its default, and no tool reports that the value of the launch file is unused.",
    example='<!-- the node reads ~subscribe_laserScan -->\n<param name="subscribe_scan" value="true"/>',
    instead='<param name="subscribe_laserScan" value="true"/>',
    references=(PARAMETER_SERVER, PARAMETERS),
    settings=("nodes",),
    check=_check,
    needs_graph=True,
    every_root=True,
)
