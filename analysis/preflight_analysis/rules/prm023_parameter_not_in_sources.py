"""PRM023: a parameter whose name is in no source of the workspace, which has one of a similar name."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable, Iterator

from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.meanings import namespace_of
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.model.context import Context
from preflight_analysis.model.param_matching import reports_params
from preflight_analysis.model.parameters import around_each, groups_of_params, namespaces_around, renamed
from preflight_analysis.model.params_in_sources import Asked, meant_in_one_file, meant_in_sources
from preflight_analysis.model.places import related_node
from preflight_analysis.model.problems import include_chain, replacement
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
    nodes = frozenset([node.name for node in graph.tree.nodes])
    reported: set[object] = set()
    packages = context.each(_of_workspace, graph.tree.nodes, context.environment)
    others = context.each(_others_speak, graph.interfaces, context.tree.ros.ament)
    for node, interface, package, is_said in zip(graph.tree.nodes, graph.interfaces, packages, others, strict=True):
        if package is None or is_said:
            continue
        params = node.params if context.tree.ros.ament else _params_of(context, node.name, nodes)
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
        shares = tuple(sorted({package.share for package in packages if package is not None}))
        pairs = zip(groups_of_params(context), around_each(context), strict=True) if shares else ()
        loose = [group for group, around in pairs if nodes.isdisjoint(around)]
        yield from _beside_nodes(rule, context, shares, loose)


def _beside_nodes(
    rule: Rule, context: Context, shares: tuple[str, ...], loose: Iterable[tuple[Param, ...]]
) -> Iterator[Finding]:
    """Of files of parameters that are loaded in a namespace, where the nodes of the launch ask for most of them."""
    nodes = {node.name for node in context.tree.nodes}
    read = context.graph.read_names if context.graph is not None else frozenset()
    for group in loose:
        namespace = namespace_of(group[0])
        by_file: dict[str, list[Param]] = {}
        for param in group:
            if param.name not in nodes:
                by_file.setdefault(param.place.file, []).append(param)
        for params in by_file.values():
            if len(params) < _LEAST or all(param.name in read for param in params):
                continue
            leaves = {names.leaf(param.name): param for param in params}
            found = meant_in_one_file(context.disk.db, context.environment, shares, tuple(sorted(leaves)))
            for leaf, asked in found.items():
                if leaves[leaf].name not in read and f"{namespace}/{asked.name}" not in context.tree.params:
                    yield _finding(rule, context, None, leaves[leaf], asked)


def _params_of(context: Context, node: str, nodes: Collection[str]) -> tuple[Param, ...]:
    """ROS 1: what is set below the name of a node, and of no other one within."""
    found: list[Param] = []
    for group in namespaces_around(context).get(node, ()):
        space = namespace_of(group[0])
        while space not in nodes:
            space = space.rpartition("/")[0]
        found += group if space == node else ()
    return tuple(found)


def _of_workspace(node: LaunchNode, environment: Environment) -> Package | None:
    """The package of the node's program, of a nodelet that of its class, if that is in the workspace."""
    name = node.package
    if node.package == "nodelet":
        words = [word for word in split_args(node.args) if not word.startswith("-")]
        name = words[1].partition("/")[0] if len(words) > 1 else ""
    package = environment.packages.get(name)
    return None if package is None or environment.is_installed(package) else package


def _others_speak(interface: Interface, ament: bool) -> bool:
    """Whether the parameters of the node are known, so that PRM001 or PRM013 says which of them it does not read."""
    lists = any(use.access == "list" for use in interface.params)
    if not ament:
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
