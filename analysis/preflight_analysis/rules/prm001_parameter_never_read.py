"""PRM001: a parameter is set and nobody reads it."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import chain

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Doubt, Reason, doubts
from preflight_analysis.findings.finding import Alike, Finding, Related
from preflight_analysis.graph.model import Graph, ParamRead
from preflight_analysis.model.context import Context
from preflight_analysis.model.missing_params import missing_params
from preflight_analysis.model.nearest import nearest_typo
from preflight_analysis.model.parameters import by_namespace, groups_of_params, renamed
from preflight_analysis.model.params_in_sources import is_asked_beside
from preflight_analysis.model.places import known_by_source, related_node, related_param_read
from preflight_analysis.model.problems import include_chain
from preflight_analysis.model.unread_params import Unread, fits, unread_params, would_change
from preflight_analysis.model.well_known import is_for_tools
from preflight_analysis.rules.further_reading import NAMES, PARAMETER_SERVER, ROSLAUNCH_PARAM
from preflight_analysis.rules.rule import Rule
from preflight_analysis.tracing.interface import Interface

_GROUP = 4
"""Parameters of a file that are read one namespace below."""
_PARTLY = ("catalogue", "source")
"""What may tell a node's parameters without telling all, beside a run to the event loop: one that ended early tells too
few."""
_UNUSED = "unused parameter '{name}': not read by {node} {until}, nor by any other node"
_MANY = "unused parameters, not read by {node} {until}, nor by any other node"
_IN_PART = "{count} parameters of this file are not read by {node}, '{first}' among them; it reads them in {where}"
_SET_TOO = "unused parameter '{name}'; {node} reads '{read}', which is set to {value}"
_NOT_READ = (
    "parameter '{name}' is not read by {node}; did you mean '{read}', which it reads and which is not set{default}?"
)
_SEARCHED = "unused parameter '{name}'; did you mean '{read}', for which {node} searches?"
_NOT_SET = "unused parameter '{name}'; {node} reads '{read}', which is not set{default}"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    if context.graph is None:
        return
    unread, by_source = unread_params(context), known_by_source(context)
    # A launch may set thousands that no source reads.
    lost = [each for each in unread if each.meant is None]
    yield from context.each_row(_hint, (lost, [id(each.holder) in by_source for each in lost]), rule)
    for each in unread:
        if each.meant is not None:
            found, meant = _finding(rule, context, context.graph, each, each.meant), each.meant
            died = missing_params(context).get(id(meant.node), ())
            ended = any(lacking.died is not None and lacking.read.name == meant.name for lacking in died)
            yield replace(found, crash_of=meant.node.name) if ended else found
    explained = {each.param.name for each in unread}
    for each in _of_partly_known(context, context.graph, explained):
        explained.add(each.param.name)
        if each.meant is not None:
            partly = each.holder or each.meant.node
            yield _finding(rule, context, context.graph, each, each.meant, doubts(NOT_ANALYSED=partly.name))
    yield from _one_level_too_high(rule, context, context.graph, explained)
    yield from _as_on_the_command_line(rule, context, context.graph, explained)


def _one_level_too_high(rule: Rule, context: Context, graph: Graph, explained: Collection[str]) -> Iterator[Finding]:
    """Files that are loaded among the private parameters of a node that is known in part, and of which it reads most in
    one namespace below: a costmap's without `ns="local_costmap"`."""
    rows = context.each_row(_asked_in_part, (graph.tree.nodes, graph.interfaces, graph.reads_of_nodes))
    if not any(rows):
        return
    read, given = graph.read_names, graph.tree.params
    groups = by_namespace(context)
    for node, asked in zip(graph.tree.nodes, rows, strict=True):
        below = [space for space in asked.own if names.parent(space) == f"{node.name}/"] if asked is not None else []
        if asked is None or not below:
            continue
        files: dict[str, list[Param]] = {}
        for param in groups.get(node.name, ()):
            if param.name not in read and param.name not in explained:
                files.setdefault(param.place.file, []).append(param)
        for file, params in files.items():
            leaves = {names.leaf(param.name) for param in params}
            wanted = {
                space: {names.leaf(name) for name in asked.own[space] if name not in given} & leaves for space in below
            }
            spaces = [space for space, found in wanted.items() if len(found) >= max(_GROUP, len(leaves) / 2)]
            if not spaces or file in context.launch_files:
                continue
            first = min(params, key=lambda param: (param.place.line, param.name))
            where = " or ".join(f"'{names.leaf(space)}'" for space in sorted(spaces))
            yield rule.claim(
                say(_IN_PART, count=len(params), node=node.name, first=names.leaf(first.name), where=where),
                first.origin[-2] if len(first.origin) > 1 else first.place,
                subject=Subject("parameter", first.name),
                kind="unreachable",
                doubts=doubts(NOT_ANALYSED=node.name),
                related=(Related("the first of them", first.place), *include_chain(node.origin)),
            )


def _as_on_the_command_line(
    rule: Rule, context: Context, graph: Graph, explained: Collection[str]
) -> Iterator[Finding]:
    """Parameters of a node whose names begin as private ones do among its arguments, be the node known or not."""
    begun = chain.from_iterable(context.each(_with_underscore, groups_of_params(context)))
    odd = [param for param in begun if param.name not in explained]
    if not odd:
        return
    nodes, read = {node.name for node in graph.tree.nodes}, graph.read_names
    for param in odd:
        above, _, leaf = param.name.rpartition("/")
        if above in nodes and param.name not in read and leaf[:1] == "_" and leaf[1:2].isalpha():
            yield rule.claim(
                f"parameter '{leaf}' begins with '_', which is the form of a node's arguments ('{leaf}:=...'); did you "
                f"mean '{leaf[1:]}'?",
                param.place,
                subject=Subject("parameter", param.name),
                kind="invalid",
                doubts=doubts(LIBRARY=True),
                candidates=(leaf[1:],),
                related=include_chain(param.origin),
                fixes=renamed(context, param, f"{above}/{leaf[1:]}"),
            )


def _with_underscore(params: tuple[Param, ...]) -> tuple[Param, ...]:
    return tuple([param for param in params if "/_" in param.name])


def _hint(unread: Unread, in_source: bool, rule: Rule) -> Finding:
    param, holder = unread.param, unread.holder
    who = holder.name if holder is not None else "any node"
    until = "in its source" if in_source else "before its event loop"
    return rule.claim(
        say(_UNUSED, name=param.name, node=who, until=until),
        param.place,
        subject=Subject("parameter", param.name),
        kind="unused",
        doubts=doubts(NO_DIFFERENCE=True, NOT_ANALYSED=holder.name if holder is not None else True),
        related=(*((related_node(holder),) if holder is not None else ()), *include_chain(param.origin)),
        alike=Alike(say(_MANY, node=who, until=until), param.name),
    )


def _of_partly_known(context: Context, graph: Graph, explained: Collection[str]) -> Iterator[Unread]:
    """Parameters of nodes that only the catalogue or the source knows, and that maybe not in full, which are a slip of
    one in the same namespace that nothing sets. So are, where the source says so, those that the node reads by this
    very name elsewhere alone, where nothing sets it: `mode` instead of `~mode`."""
    rows = context.each_row(_asked_in_part, (graph.tree.nodes, graph.interfaces, graph.reads_of_nodes))
    if not any(rows):
        return
    read, given = graph.read_names, graph.tree.params
    groups = by_namespace(context)
    for node, asked in zip(graph.tree.nodes, rows, strict=True):
        if asked is None:
            continue
        for namespace in {*asked.own, node.name} if asked.astray else asked.own:
            for param in groups.get(namespace, ()):
                if param.name in read or param.name in explained or is_for_tools(param.name):
                    continue
                wanted = {name: each for name, each in asked.own.get(namespace, {}).items() if name not in given}
                near = nearest_typo(param.name, wanted)
                if near is not None and fits(param.value, wanted[near]) and not _are_opposite(param.name, near):
                    yield Unread(param, node, wanted[near])
                elif near is None and namespace == node.name:
                    alike = asked.astray.get(names.leaf(param.name), ())
                    found = [each for each in alike if each.name not in given and fits(param.value, each)]
                    if len(found) == 1:
                        yield Unread(param, node, found[0])
    yield from _beside_nodes(context, rows, read | set(explained))


def _beside_nodes(context: Context, rows: Iterable[_Asked | None], explained: Collection[str]) -> Iterator[Unread]:
    """Parameters that a tag sets beside the nodes, where one of these reads its private one of that name, which nothing
    sets, and of each other one something is known, too: `mode` instead of `~mode`."""
    graph = context.graph
    if graph is None or any(interface.source == "none" for interface in graph.interfaces):
        return
    given = graph.tree.params
    wanted: dict[str, list[ParamRead]] = {}
    for node, asked in zip(graph.tree.nodes, rows, strict=True):
        for name, each in asked.own.get(node.name, {}).items() if asked is not None and asked.of_itself else ():
            if each.use.access == "get":
                wanted.setdefault(names.leaf(name), []).append(each)
    # By the namespace in which they are set and the node that reads them.
    found: dict[tuple[str, str], list[Unread]] = {}
    counts: dict[str, int] = {}
    for param in graph.tree.all_params if wanted else ():
        if param.owner is not None or param.name_location is None or param.place.file not in context.launch_files:
            continue
        namespace, _, leaf = param.name.rpartition("/")
        counts[namespace] = counts.get(namespace, 0) + 1
        all_reads = wanted.get(leaf, [])
        reads = [each for each in all_reads if each.name not in given] or all_reads
        if len(reads) == 1 and param.name not in explained and not is_for_tools(param.name):
            found.setdefault((namespace, reads[0].node.name), []).append(Unread(param, None, reads[0]))
    nodes = {node.name for node in graph.tree.nodes}
    homes = names.with_namespaces(nodes)
    for (namespace, node_name), unread in found.items():
        beside = namespace in ("", names.parent(node_name).rstrip("/"))
        # A group of parameters in a namespace that nobody is in is that of a node of another name.
        alone = namespace not in ("", *homes) and nodes.isdisjoint(names.with_namespaces((namespace,)))
        group = alone and len(unread) > 1 and len(unread) == counts[namespace]
        for lost in unread if beside or group else ():
            # A group says enough even where its values are the defaults.
            read = lost.meant
            if read is None or not fits(lost.param.value, read):
                continue
            if read.name in given:
                # Set twice, and once where nobody looks: of a name that says enough.
                differs = given[read.name].value != lost.param.value
                if beside and differs and names.leaf(read.name).count("_"):
                    yield lost
            elif group or would_change(lost.param, read):
                yield lost


@dataclass(frozen=True, slots=True)
class _Asked:
    """What a node asks for that is known in part."""

    own: Mapping[str, Mapping[str, ParamRead]]
    """Below its own name, by namespace and name."""
    astray: Mapping[str, Sequence[ParamRead]]
    """Elsewhere, as its source says, by the last part of the name."""
    of_itself: bool
    """Whether the node's own source or run says so."""


def _asked_in_part(node: LaunchNode, interface: Interface, reads: Iterable[ParamRead]) -> _Asked | None:
    """None of a node of which all is known, or nothing, or that may ask for any."""
    spun = interface.source == "trace" and interface.outcome.status == "spinning"
    if not (spun or interface.source in _PARTLY) or interface.tells_all("parameters"):
        return None
    if any(use.access == "list" for use in interface.params):
        return None
    own: dict[str, dict[str, ParamRead]] = {}
    astray: dict[str, list[ParamRead]] = {}
    for each in reads:
        namespace, _, leaf = each.name.rpartition("/")
        if each.name.startswith(f"{node.name}/"):
            own.setdefault(namespace, {})[each.name] = each
        elif interface.source == "source" and each.use.access == "get":
            astray.setdefault(leaf, []).append(each)
    return _Asked(own, astray, interface.source != "catalogue")


def _are_opposite(name: str, other: str) -> bool:
    """Whether one has `min` where the other has `max`."""
    return name.lower().replace("min", "max") == other.lower().replace("min", "max")


def _finding(
    rule: Rule,
    context: Context,
    graph: Graph,
    unread: Unread,
    read: ParamRead,
    partly: tuple[Doubt, ...] = (),
) -> Finding:
    param, holder = unread.param, unread.holder
    namespace, name = param.name.rpartition("/")[0], read.name
    if read.use.access == "search":
        name = f"{namespace}/{read.name.rpartition('/')[2]}"
    set_too = graph.tree.params.get(read.name)
    if set_too is not None:
        template = _SET_TOO
    elif holder is not None:
        template = _NOT_READ
    else:
        template = _SEARCHED if read.use.access == "search" else _NOT_SET
    who = holder if template is _NOT_READ and holder is not None else read.node
    by_source = id(read.node) in known_by_source(context)
    value = repr(set_too.value) if set_too is not None else ""
    return rule.claim(
        say(template, name=param.name, node=who.name, read=name, value=value, default=_default(read)),
        param.place,
        subject=Subject("parameter", param.name),
        doubts=(
            *partly,
            *doubts(
                SHARED=not unread.alone,
                IN_USE=unread.alone and _may_be_read(context, unread, read),
                NOT_ANALYSED=not partly and holder is None and not (graph.complete and unread.alone),
                FROM_SOURCE=by_source,
                LATER="" if by_source else read.node.name,
            ),
        ),
        candidates=(name,),
        related=(related_param_read(read), *include_chain(param.origin)),
        fixes=renamed(context, param, name) if unread.alone and set_too is None else (),
    )


def _may_be_read(context: Context, unread: Unread, read: ParamRead) -> bool:
    """Whether a parameter that is of no node may be that of a program or a plugin in another package than the node's
    that reads it elsewhere, as its source asks for one of that name."""
    package = context.environment.packages.get(read.node.package or "")
    if unread.holder is not None or package is None:
        return False
    return is_asked_beside(context.disk.db, context.environment, package.share, names.leaf(unread.param.name))


def _default(read: ParamRead) -> str:
    if read.use.has_default:
        return f" (default {read.use.default!r})"
    return " and has no default" if read.use.mandatory else ""


RULE = Rule(
    id="PRM001",
    name="parameter-never-read",
    effect="no-effect",
    kind="near",
    sometimes=(
        Reason.NO_DIFFERENCE,
        Reason.SHARED,
        Reason.LATER,
        Reason.IN_USE,
        Reason.NOT_ANALYSED,
        Reason.FROM_SOURCE,
        Reason.LIBRARY,
    ),
    what="Checks for a parameter that no node reads. The finding names the unset parameter that was meant: one of a "
    "similar name, or of the same name in another namespace.",
    why="The node uses its default, and no tool reports that the value of the launch file is unused.",
    example='<!-- the node reads ~publish_objects -->\n<param name="publish_obejcts" value="false"/>',
    instead='<param name="publish_objects" value="false"/>',
    references=(
        PARAMETER_SERVER,
        ROSLAUNCH_PARAM,
        NAMES,
    ),
    settings=("nodes",),
    generations=(1,),
    check=_check,
    needs_graph=True,
    in_branches=True,
    every_root=True,
)
