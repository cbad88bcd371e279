"""PRM007: a parameter under a name that no node of the launch has."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping

from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.meanings import namespace_of
from preflight_analysis.evaluation.tree import Param
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import Action, LaunchFile
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import nearest, numbers_in
from preflight_analysis.model.places import related_node
from preflight_analysis.model.problems import include_chain, rename
from preflight_analysis.model.well_known import is_for_tools
from preflight_analysis.rules.further_reading import NAMES, PARAMETER_SERVER
from preflight_analysis.rules.rule import Rule

_FAR = 2000
"""How far above a parameter the YAML key of its dictionary is looked for."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    tree = context.tree
    if not tree.nodes:
        return
    outside = [*filter(None, context.each(_outside, tree.all_params))]
    if not outside:
        return
    homeless = _homeless(context, outside)
    if not homeless:
        return
    homes = context.one(_homes, "", tuple([node.name for node in tree.nodes]))
    for prefix, params in homeless.items():
        parent, _, leaf = prefix.rpartition("/")
        near = _near(leaf, homes.get(parent, ()))
        if near is None:
            if not tree.complete or not _is_alone(context, prefix, params):
                continue
            place = params[0].place
            yield rule.claim(
                f"'{prefix}' is neither a node nor a namespace of this launch ({_what(params)})",
                place,
                subject=Subject("name", prefix),
                kind="absent",
                doubts=doubts(OTHER_LAUNCH=True),
                related=include_chain(params[0].origin),
            )
            continue
        if leaf in _left_out(context) or leaf in _words_of_arguments(context):
            continue  # the section of a node that a condition leaves out, or of a controller that a spawner is given
        meant = f"{parent}/{near}"
        if meant in _known(context):
            continue  # what that node reads is known: whether it misses this parameter is for PRM001 to say
        places = [_prefix_place(context, param, leaf) for param in params]
        related = [related_node(n) for n in tree.nodes if n.name == meant][-1:]
        yield rule.claim(
            f"'{prefix}' is not a node of this launch ({_what(params)}); did you mean '{meant}'?",
            places[0],
            subject=Subject("name", prefix),
            doubts=doubts(NOT_ANALYSED=meant),
            candidates=(meant,),
            related=(*related, *include_chain(params[0].origin)),
            fixes=_fixes(context, places, leaf, near),
        )


@derived
def _left_out(context: Context) -> frozenset[str]:
    """The names that nodes have in the launch files, and none in the launch: conditions leave these out."""
    written = {name for launch_file in context.launch_files.values() for name in _names_of_nodes(launch_file)}
    return frozenset(written - {names.leaf(node.name) for node in context.tree.nodes})


@derived
def _words_of_arguments(context: Context) -> frozenset[str]:
    return frozenset(word for node in context.tree.nodes for word in node.args.split())


@derived
def _names_of_nodes(launch_file: LaunchFile) -> tuple[str, ...]:
    return tuple(launch_file.root.gather(_name_of_node)) if launch_file.root is not None else ()


def _name_of_node(action: Action) -> tuple[str, ...]:
    name = action.value("name") if action.kind == "node" else None
    return (name.text,) if name is not None else ()


def _homes(nodes: tuple[str, ...]) -> Mapping[str, set[str]]:
    """For each namespace the names in it, of nodes and of namespaces with nodes."""
    found: dict[str, set[str]] = {}
    for name in nodes:
        parent, _, leaf = name.rpartition("/")
        while leaf and leaf not in found.setdefault(parent, set()):
            found[parent].add(leaf)
            parent, _, leaf = parent.rpartition("/")
    return found


def _outside(param: Param) -> Param | None:
    """The parameter itself, if it is below no node in whose tag it is set, and not for tools."""
    inside = param.owner is not None and param.name.startswith(param.owner)
    return None if inside or is_for_tools(param.name) else param


def _homeless(context: Context, params: Iterable[Param]) -> dict[str, list[Param]]:
    """The parameters that are neither read nor below a node or in its namespace, by the part of the name at fault."""
    namespaces = context.grouped(namespace_of, "outside", params)
    nodes = frozenset([node.name for node in context.tree.nodes])
    homes = frozenset(names.with_namespaces(nodes))
    prefixes = zip(namespaces, context.each(_at_fault, tuple(namespaces), nodes, homes), strict=True)
    at_fault = {namespace: prefix for namespace, prefix in prefixes if prefix is not None}
    found: dict[str, list[Param]] = {}
    for param in params if at_fault else ():
        prefix = at_fault.get(namespace_of(param))
        if prefix is not None and param.name not in _read(context):
            found.setdefault(prefix, []).append(param)
    return found


def _at_fault(namespace: str, nodes: frozenset[str], homes: frozenset[str]) -> str | None:
    """The first part of the namespace in which no node and no namespace of nodes is, None if it leads to one. `homes`
    are the names of nodes with their namespaces."""
    prefix = ""
    for part in namespace.split("/")[1:]:
        prefix = f"{prefix}/{part}"
        if prefix in nodes:
            break
        if prefix not in homes:
            return prefix
    return None


def _near(leaf: str, others: Iterable[str]) -> str | None:
    """The name that is a typo away. Names that differ by a plural or a number were written so."""
    near = nearest(leaf, others)
    if near is None or near.rstrip("s") == leaf.rstrip("s") or numbers_in(near) != numbers_in(leaf):
        return None
    return near


def _is_alone(context: Context, prefix: str, params: list[Param]) -> bool:
    """Whether `<param>` tags set the parameters by that name, and nothing else in the launch speaks of it.

    Files of parameters are full of names that are no nodes' (controllers, planners, sensors), and so are dictionaries
    whose name is in the arguments of a node or has a `type`. An anonymous name is LCH022's.
    """
    tree, leaf = context.tree, names.leaf(prefix)
    if f"{prefix}/type" in tree.params or leaf.startswith("robot_description"):
        return False
    if not all(f"{leaf}/" in _written(context, param) for param in params):
        return False
    if any(leaf in node.args or node.name.startswith(f"{prefix}_ANON") for node in tree.nodes):
        return False
    return not any(leaf in param.value for param in tree.all_params if isinstance(param.value, (str, list)))


def _written(context: Context, param: Param) -> str:
    """The parameter's name as it stands in the `name` of a tag."""
    return context.text(param.name_location) if param.name_location is not None else ""


def _what(params: list[Param]) -> str:
    more = f" and {len(params) - 1} more" if len(params) > 1 else ""
    return f"parameter '{params[0].name}'{more}"


def _prefix_place(context: Context, param: Param, leaf: str) -> Location:
    """Where the name at fault is written: with the parameter's own, or as a key above it in YAML."""
    place = param.place
    document = context.documents.get(place.file)
    if document is None or leaf in document.text[place.span.start : place.span.end]:
        return place
    above = document.text[max(0, place.span.start - _FAR) : place.span.start]
    keys = list(re.finditer(rf"(?<![\w/]){re.escape(leaf)}(?=[\"']?[ \t]*:)", above))
    if not keys:
        return place
    start = place.span.start - len(above) + keys[-1].start()
    return context.location(place.file, Span(start, start + len(leaf)))


def _fixes(context: Context, places: list[Location], leaf: str, near: str) -> tuple[Fix, ...]:
    """The name corrected wherever it is written, each place once."""
    distinct = list(dict.fromkeys(places))
    found = [fix for place in distinct for fix in rename(context, place, leaf, near)]
    if len(found) < len(distinct):
        return ()
    return (Fix(found[0].title, tuple(edit for fix in found for edit in fix.edits), True),)


@derived
def _read(context: Context) -> frozenset[str]:
    graph = context.graph
    return graph.read_names if graph is not None else frozenset()


@derived
def _known(context: Context) -> frozenset[str]:
    """The nodes of which it is known what they read."""
    graph = context.graph
    if graph is None:
        return frozenset()
    pairs = zip(graph.tree.nodes, graph.interfaces, strict=True)
    return frozenset(node.name for node, interface in pairs if interface.tells_all("parameters"))


RULE = Rule(
    id="PRM007",
    name="parameter-without-node",
    effect="no-effect",
    kind="near",
    sometimes=(Reason.NOT_ANALYSED, Reason.OTHER_LAUNCH),
    what="Checks for a parameter below a name that is neither a node nor a namespace of a node. Launch files without "
    "nodes, and parameters at the top, are not checked.",
    why="The intended node uses its default, and no tool reports it.",
    example='<param name="/talkr/rate" value="10"/>\n<node pkg="chat" type="talker" name="talker"/>',
    instead='<param name="/talker/rate" value="10"/>\n<node pkg="chat" type="talker" name="talker"/>',
    references=(
        PARAMETER_SERVER,
        NAMES,
    ),
    generations=(1,),
    check=_check,
    every_root=True,
)
