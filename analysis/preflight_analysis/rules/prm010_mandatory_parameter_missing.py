"""PRM010: a node reads a parameter without a default, and nothing sets it."""

from __future__ import annotations

import re
from collections.abc import Iterator

from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.model import Graph, ParamRead
from preflight_analysis.rules.nearest import likeness
from preflight_analysis.rules.parameters import by_namespace, name_place, renamed
from preflight_analysis.rules.places import node_location, related_param_read
from preflight_analysis.rules.problems import include_chain, quoted
from preflight_analysis.rules.rule import Context, Rule
from preflight_analysis.rules.unread_params import unread_params
from preflight_analysis.rules.well_known import is_for_tools
from preflight_analysis.tracing.interface import Interface

_COMPLAINT = re.compile(r"KeyError|param|not set|missing|required|mandatory|not (found|given|specified|defined)", re.I)


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    if graph is None or not graph.param_reads or not context.tree.complete:
        return
    missing = _missing(context, graph)
    if not missing:
        return
    # A parameter that was meant for it and that nobody reads is where to mend it: there PRM001 says it.
    explained = {unread.meant.name for unread in context.once(unread_params) if unread.meant is not None}
    read = {each.name for each in graph.param_reads}
    unread: dict[str, list[Param]] = {}
    private: dict[str, list[Param]] = {}
    for param in graph.tree.params.values():
        if param.name not in read:
            unread.setdefault(param.name.rpartition("/")[2], []).append(param)
            private.setdefault(_namespace(param), []).append(param)
    for node, interface in zip(graph.tree.nodes, graph.interfaces, strict=True):
        optional: list[str] = []
        for lacking in missing.get(id(node), ()):
            died = _last_words(interface, lacking)
            if lacking.name in explained or (died is None and not lacking.use.mandatory):
                continue
            if died is not None:
                leaf = lacking.name.rpartition("/")[2]
                meant = _elsewhere(lacking, unread.get(leaf, ())) or _misspelt(lacking, private.get(node.name, ()))
                yield _finding(rule, context, lacking, meant, died)
            else:
                optional.append(lacking.name)
        if optional:
            one = len(optional) == 1
            names = f"parameter{'' if one else 's'} {quoted(optional)}"
            yield rule.finding(
                f"{node.name} reads {names} without a default, and nothing sets {'it' if one else 'them'}",
                node_location(node),
                severity="hint",
                confidence="possible",
                related=include_chain(node.origin),
            )


def _missing(context: Context, graph: Graph) -> dict[int, list[ParamRead]]:
    """By the id of the node what it reads without a default, or asks for, and nobody sets, each name once.

    A node that asks whether there is such a parameter, or reads it with a default too, may go on without it: of these
    it stands here as not mandatory.
    """
    namespaces: set[str] = set()
    for namespace in context.once(by_namespace):
        above = namespace
        while above and above not in namespaces:
            namespaces.add(above)
            above = above.rpartition("/")[0]
    known = graph.tree.params.keys() | namespaces | {command.param for command in graph.tree.commands}
    known |= {r.name for r in graph.param_reads if r.use.access in ("set", "search")}
    with_default = {(id(r.node), r.name) for r in graph.param_reads if r.use.has_default}
    first: dict[tuple[int, str], ParamRead] = {}
    for read in graph.param_reads:
        key = (id(read.node), read.name)
        asks = read.use.access == "has"
        if read.use.builtin or key in with_default or not (asks or (read.use.access == "get" and read.use.mandatory)):
            continue
        if read.name in known or is_for_tools(read.name) or f"_{read.use.name.strip('~')}:=" in read.node.args:
            continue
        if asks or key not in first:
            first[key] = read
    found: dict[int, list[ParamRead]] = {}
    for (node, _), read in first.items():
        found.setdefault(node, []).append(read)
    return found


def _last_words(interface: Interface, read: ParamRead) -> str | None:
    """The line in which the node, which ended, complains of the parameter: rospy's KeyError, or its own words."""
    if interface.outcome.status not in ("crashed", "exited"):
        return None
    leaf = re.compile(rf"(?<!\w){re.escape(read.name.rpartition('/')[2])}(?!\w)")
    said = (interface.outcome.reason or "", *interface.outcome.stderr_tail)
    found = [line.strip() for line in said if leaf.search(line) and _COMPLAINT.search(line)]
    return found[-1] if found else None


def _elsewhere(read: ParamRead, unread: list[Param] | tuple[Param, ...]) -> Param | None:
    """The only parameter of this name that nobody reads and that stands in a namespace around the one of the read, or
    is private to the node that reads it elsewhere."""
    namespace = read.name.rpartition("/")[0] + "/"
    near = [p for p in unread if namespace.startswith(f"{_namespace(p)}/") or _namespace(p) == read.node.name]
    return near[0] if len(near) == 1 else None


def _misspelt(read: ParamRead, private: list[Param] | tuple[Param, ...]) -> Param | None:
    """The only private parameter of the node that it has not read and that is a typo away."""
    found = [p for p in private if (alike := likeness(p.name, read.name)) is not None and alike[0] == "typo"]
    return found[0] if len(found) == 1 else None


def _namespace(param: Param) -> str:
    return param.name.rpartition("/")[0]


def _finding(rule: Rule, context: Context, read: ParamRead, meant: Param | None, died: str) -> Finding:
    node: LaunchNode = read.node
    reads = "reads parameter '{}' without a default" if read.use.mandatory else "asks for parameter '{}'"
    message = f"{node.name} {reads.format(read.name)}, and nothing sets it; it ended with: {died}"
    if meant is None:
        return rule.finding(
            message,
            node_location(node),
            confidence="likely",
            related=(related_param_read(read), *include_chain(node.origin)),
        )
    return rule.finding(
        f"{message}. '{meant.name}' is set, which no node reads: did you mean '{read.name}' there?",
        name_place(meant),
        confidence="likely",
        related=(related_param_read(read), *include_chain(meant.origin)),
        fixes=renamed(context, meant, read.name),
    )


RULE = Rule(
    id="PRM010",
    name="mandatory-parameter-missing",
    severity="warning",
    what="Reports a parameter that a node reads without giving a default and that the launch does not set. It is a "
    "warning where the node ended because of it, shown at the parameter that was meant if one is set under a like name "
    "or in a namespace around; otherwise a hint, as the node may cope. Where the node goes on, and a parameter that "
    "nobody reads was meant, PRM001 says so.",
    why="rospy raises a KeyError; in C++ the variable keeps whatever it had.",
    example='<param name="rate" value="10"/> <!-- /rate; the node reads /talker/rate -->\n'
    '<node pkg="p" type="talker" name="talker"/>',
    instead='<node pkg="p" type="talker" name="talker">\n  <param name="rate" value="10"/>\n</node>',
    generations=(1,),
    check=_check,
    needs_graph=True,
    every_root=True,
)
