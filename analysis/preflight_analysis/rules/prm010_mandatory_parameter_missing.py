"""PRM010: a node reads a parameter without a default, and nothing sets it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.meanings import namespace_of
from preflight_analysis.evaluation.problems import (
    BadYaml,
    ParameterFileNotFound,
    UnreadableParameterFile,
    WithheldFile,
)
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.model import Graph, ParamRead
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.model.missing_params import missing_params
from preflight_analysis.model.name_index import around
from preflight_analysis.model.nearest import likeness, nearest
from preflight_analysis.model.parameters import grouped, renamed
from preflight_analysis.model.places import related_param_read
from preflight_analysis.model.problems import include_chain, problems_of, quoted
from preflight_analysis.model.unread_params import unread_params
from preflight_analysis.rules.further_reading import PARAMETER_SERVER, PARAMETERS
from preflight_analysis.rules.rule import Rule
from preflight_analysis.tracing.interface import Interface, ParamUse

_UNREAD = (ParameterFileNotFound, UnreadableParameterFile, WithheldFile, BadYaml)
_NOT_SET = "parameter {names} is not set; {node} reads it without a default"
_NONE_SET = "parameters {names} are not set; {node} reads them without a default"
_BY_TYPE = "required parameter {names} is not set; {node} declares it by type only, and rclcpp throws an exception"
_ALL_BY_TYPE = (
    "required parameters {names} are not set; {node} declares them by type only, and rclcpp throws an exception"
)
_REFUSED = "required parameter '{name}' is not set; {node} declares it without a default and exits ({quoted})"
_MISSING = "required parameter '{name}' is not set; {node} {reads} and exits: {quoted}{nearby}"
_MEANT = "unused parameter '{unused}'; did you mean '{name}'? {node} {reads} and exits: {quoted}"
_WITH_ZEROS = ("dashing", "eloquent", "foxy")
"""Distributions in which a parameter that is declared by its type alone begins with a zero of it."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    if graph is not None and graph.tree.ros.own_parameters:
        yield from _of_ros2(rule, context, graph)
        return
    missing = missing_params(context)
    if graph is None or not missing:
        return
    # A parameter that was meant for it and that nobody reads is where to mend it: there PRM001 says it.
    explained = {unread.meant.name for unread in unread_params(context) if unread.meant is not None}
    for node in graph.tree.nodes:
        optional: list[str] = []
        for each in missing.get(id(node), ()):
            lacking, died = each.read, each.died
            if lacking.name in explained or (died is None and not lacking.use.mandatory):
                continue
            if died is not None:
                unread = _never_read(context)
                leaf = names.leaf(lacking.name)
                meant = _elsewhere(lacking, unread.by_leaf.get(leaf, ()))
                meant = meant or _misspelt(lacking, unread.by_namespace.get(node.name, ()))
                yield replace(_finding(rule, context, lacking, meant, died), crash_of=node.name)
            else:
                optional.append(lacking.name)
        if optional:
            yield context.one(_hint, node.name, rule, node, tuple(optional))


def _hint(rule: Rule, node: LaunchNode, params: tuple[str, ...]) -> Finding:
    return rule.claim(
        say(_NOT_SET if len(params) == 1 else _NONE_SET, names=quoted(params), node=node.name),
        node.location,
        subject=Subject("parameter", params[0]),
        effect="misbehaves",
        doubts=doubts(OTHER_LAUNCH=True),
        related=include_chain(node.origin),
    )


def _of_ros2(rule: Rule, context: Context, graph: Graph) -> Iterator[Finding]:
    """Nodes that ended for a parameter that has to be set. Of a name that was meant for it PRM013 says more."""
    refusals = context.each(_refusals, graph.interfaces)
    yield from _of_sources(rule, context, graph)
    for node, uses in zip(graph.tree.nodes, refusals, strict=True):
        given = {f"~{param.name}" for param in node.params} if uses else ()
        for use in uses:
            if use.name in given:
                continue
            found = rule.claim(
                say(_REFUSED, name=use.name[1:], node=node.name, quoted=use.refused),
                node.location,
                subject=Subject("parameter", use.name[1:]),
                related=include_chain(node.origin),
            )
            yield replace(found, crash_of=node.name)


def _of_sources(rule: Rule, context: Context, graph: Graph) -> Iterator[Finding]:
    """Nodes whose source declares, whatever the launch sets, a parameter by its type alone. Nothing is said where not
    all that they get is known."""
    needed = context.each(_needed, graph.interfaces)
    if not any(needed) or context.environment.distro in _WITH_ZEROS:
        return
    if any(each.fatal for each in graph.tree.problems) or any(problems_of(context, *_UNREAD)):
        return
    unknown = {each.location.file for each in graph.tree.unknowns}
    for node, interface, uses in zip(graph.tree.nodes, graph.interfaces, needed, strict=True):
        given = {f"~{param.name}" for param in node.params} if uses else set[str]()
        names_missing = sorted({use.name for use in uses} - given)
        if not names_missing or node.unknowns or "--" in node.args or unknown.intersection(p.file for p in node.origin):
            continue
        declared = {use.name for use in interface.params}
        if any(nearest(name, names_missing) for name in given - declared):
            continue  # PRM013 says it at the name that was meant for it
        named = [name[1:] for name in names_missing]
        yield rule.claim(
            say(_BY_TYPE if len(named) == 1 else _ALL_BY_TYPE, names=quoted(named), node=node.name),
            node.location,
            subject=Subject("parameter", named[0]),
            doubts=doubts(LIBRARY=True, FROM_SOURCE=True),
            related=include_chain(node.origin),
        )


def _needed(interface: Interface) -> tuple[ParamUse, ...]:
    if interface.source != "source":
        return ()
    needed = (use for use in interface.params if use.mandatory and use.name.startswith("~"))
    return tuple(use for use in needed if "condition" not in use.evidence.doubts)


def _refusals(interface: Interface) -> tuple[ParamUse, ...]:
    return tuple(use for use in interface.params if use.refused is not None and use.mandatory)


@dataclass(frozen=True, slots=True)
class _NeverRead:
    """The parameters that no node reads."""

    by_leaf: Mapping[str, list[Param]]
    by_namespace: Mapping[str, list[Param]]


@derived
def _never_read(context: Context) -> _NeverRead:
    read = context.graph.read_names if context.graph is not None else ()
    unread = [param for param in context.tree.all_params if param.name not in read]
    by_leaf: dict[str, list[Param]] = {}
    for param in unread:
        by_leaf.setdefault(names.leaf(param.name), []).append(param)
    return _NeverRead(by_leaf, grouped(unread))


def _elsewhere(read: ParamRead, unread: Iterable[Param]) -> Param | None:
    """The only parameter of this name that nobody reads and that stands in a namespace around the one of the read, or
    is private to the node that reads it elsewhere."""
    namespace = read.name.rpartition("/")[0] + "/"
    near = [p for p in unread if namespace.startswith(f"{namespace_of(p)}/") or namespace_of(p) == read.node.name]
    return near[0] if len(near) == 1 else None


def _misspelt(read: ParamRead, private: Iterable[Param]) -> Param | None:
    """The only private parameter of the node that it has not read and that is a typo away."""
    found = [p for p in private if (alike := likeness(p.name, read.name)) is not None and alike[0] == "typo"]
    return found[0] if len(found) == 1 else None


def _finding(rule: Rule, context: Context, read: ParamRead, meant: Param | None, died: str) -> Finding:
    node: LaunchNode = read.node
    reads = "reads it without a default" if read.use.mandatory else "reads it"
    if meant is None:
        leaf, known = names.leaf(read.name), around(context, "parameter") if not read.use.name.startswith("~") else {}
        setters = sum(count for each, count in known.items() if (each.text, each.role) == (leaf, "set"))
        files = f"{setters} launch files nearby set" if setters > 1 else "a launch file nearby sets"
        nearby = f"; {files} a parameter of that name" if setters else ""
        return rule.claim(
            say(_MISSING, name=read.name, node=node.name, reads=reads, quoted=died, nearby=nearby),
            node.location,
            subject=Subject("parameter", read.name),
            doubts=doubts(UNSEEN=True, IN_USE=setters > 0),
            related=(related_param_read(read), *include_chain(node.origin)),
        )
    return rule.claim(
        say(_MEANT, unused=meant.name, name=read.name, node=node.name, reads=reads, quoted=died),
        meant.place,
        subject=Subject("parameter", read.name),
        kind="near",
        doubts=doubts(UNSEEN=True),
        candidates=(read.name,),
        related=(related_param_read(read), *include_chain(meant.origin)),
        fixes=renamed(context, meant, read.name),
    )


RULE = Rule(
    id="PRM010",
    name="mandatory-parameter-missing",
    effect="stops-node",
    kind="absent",
    sometimes=(
        "misbehaves",
        Reason.OTHER_LAUNCH,
        Reason.UNSEEN,
        Reason.IN_USE,
        Reason.LIBRARY,
        Reason.FROM_SOURCE,
    ),
    what="Checks for a parameter that a node reads without a default and that the launch does not set. If an unused "
    "parameter was meant for it, the finding is there.",
    why="rospy raises a KeyError; in roscpp the variable keeps its old value. rclcpp throws an exception for a "
    "parameter that is declared by type only and has no value. Most nodes exit then.",
    example='<param name="rate" value="10"/> <!-- /rate; the node reads /talker/rate -->\n'
    '<node pkg="p" type="talker" name="talker"/>',
    instead='<node pkg="p" type="talker" name="talker">\n  <param name="rate" value="10"/>\n</node>',
    references=(
        PARAMETER_SERVER,
        PARAMETERS,
    ),
    settings=("nodes",),
    check=_check,
    needs_graph=True,
    every_root=True,
)
