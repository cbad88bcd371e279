"""The parameters of a launch by name: all places that set one, in the order in which they apply, and who reads it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.ros2.param_files import FileParam
from preflight_analysis.evaluation.tree import LaunchTree, Param, Unknown
from preflight_analysis.model.lost_files import LostFile, lost_files
from preflight_analysis.model.nearest import nearest
from preflight_analysis.model.parameters import OF_ALL_NODES
from preflight_analysis.model.refused_files import Refusal, refusals
from preflight_analysis.model.sections import SectionUse, param_files
from preflight_analysis.queries.symbol_at import own_parameter, settings_of
from preflight_analysis.tracing.interface import ParamUse
from preflight_analysis.workspace.workspace import Analysis

_OF_ALL_NODES_OF_ROS_1 = {"/use_sim_time": ParamUse("/use_sim_time", "get", False, has_default=True, builtin=True)}


class NoSuchParameterError(Exception):
    """Nothing sets or reads a parameter of that name. `near` are the names that may be meant."""

    def __init__(self, name: str, near: Sequence[str]) -> None:
        super().__init__(name)
        self.name, self.near = name, tuple(near)


@dataclass(frozen=True, slots=True)
class Unapplied:
    """A value in a section of a parameter file that applies to no node, and where its name stands."""

    use: SectionUse
    param: FileParam
    place: Location


@dataclass(frozen=True, slots=True)
class Parameter:
    """One parameter. `name` is the full one, in ROS 2 `/node:name`. `settings` are the places that set it, the one that
    applies first; `uses` are the calls of nodes, each with the node's name. `unknowns` are what is not known of the
    launch and may set it too; `lost` are the files that its node gets and that have nothing for it,
    `refusals` say why rcl refuses one that it gets."""

    name: str
    settings: tuple[Param, ...]
    uses: tuple[tuple[str, ParamUse], ...]
    unknowns: tuple[Unknown, ...] = ()
    unapplied: tuple[Unapplied, ...] = ()
    lost: tuple[LostFile, ...] = ()
    refusals: tuple[Refusal, ...] = ()

    @property
    def node(self) -> str:
        """In ROS 2 the node that has it; in ROS 1, where the parameter server has all, an empty text."""
        return self.name.rpartition(":")[0]

    @property
    def own(self) -> str:
        """The name as its node declares it; in ROS 1 the full one."""
        return self.name.rpartition(":")[2]

    @property
    def declared(self) -> ParamUse | None:
        """The call that says most of its type and default."""
        return next((use for _, use in self.uses if use.access != "set" and (use.has_default or use.type)), None)


def parameter(analysis: Analysis, name: str) -> Parameter | None:
    """The parameter of a full name; None where nothing sets or reads it."""
    settings: dict[Location, Param] = {}
    # The last one applies.
    for param in reversed([param for full, param in settings_of(analysis.tree) if full == name]):
        settings.setdefault(param.place, param)
    uses = tuple((node, use) for full, node, use in _uses(analysis) if full == name)
    unapplied = tuple(each for full, each in _unapplied(analysis) if full == name)
    if not settings and not uses and not unapplied:
        return None
    unknowns = tuple(dict.fromkeys(_unknowns(analysis.tree, name)))
    owner = name.rpartition(":")[0]
    lost = tuple(each for each in lost_files(analysis.context) if each.getter.name == owner)
    given = (each for each in refusals(analysis.context) if any(node.name == owner for node, _ in each.given))
    return Parameter(name, tuple(settings.values()), uses, unknowns, unapplied, lost, tuple(given))


def parameters(analysis: Analysis, name: str) -> tuple[Parameter, ...]:
    """The parameters that a name may mean: a full one (`/node/name`; in ROS 2 `/node:name`), or its last part, which
    several nodes may have. Raises `NoSuchParameterError`."""
    set_here, unapplied = settings_of(analysis.tree), _unapplied(analysis)
    known = sorted({*(full for full, _ in chain(set_here, unapplied)), *(full for full, _, _ in _uses(analysis))})
    meant = [full for full in known if full == name] or [full for full in known if _may_be(full, name)]
    if not meant:
        near = nearest(_last(name), map(_last, known))
        raise NoSuchParameterError(name, [full for full in known if _last(full) == near])
    return tuple(found for full in meant if (found := parameter(analysis, full)) is not None)


def section(tree: LaunchTree, param: Param) -> str:
    """In ROS 2 the key below which a parameter is given to its node (`/**`): that of its parameter file, or the one
    that launch writes for values of the launch file. An empty text in ROS 1."""
    for node in tree.nodes:
        for source in node.param_sources:
            for each, key in zip(source.params, source.keys, strict=False):
                if each.place == param.place:
                    return key
    return ""


def _unapplied(analysis: Analysis) -> Iterator[tuple[str, Unapplied]]:
    """What sections that apply to no node would set, by the parameters of the nodes that they are meant for; where
    nothing is known of these, of the one that they name."""
    for used in param_files(analysis.context):
        for each in used.sections:
            if each.nodes:
                continue
            owners = [candidate.name for candidate in each.candidates] or [each.section.pattern]
            for param in each.section.params:
                found = Unapplied(each, param, analysis.context.location(used.path, param.name_span))
                yield from ((f"{owner}:{param.name}", found) for owner in owners)


def _uses(analysis: Analysis) -> Iterator[tuple[str, str, ParamUse]]:
    tree, asked = analysis.tree, set()
    for read in analysis.graph.param_reads if analysis.graph is not None else ():
        if read.use.access != "list":
            full = own_parameter(read.node, read.use.name) if tree.ros.own_parameters else read.name
            asked.add((full, read.node.name))
            yield full, read.node.name, read.use
    for node in tree.nodes:
        if node.kind == "process":
            continue
        for name, use in (OF_ALL_NODES if tree.ros.own_parameters else _OF_ALL_NODES_OF_ROS_1).items():
            full = own_parameter(node, name) if tree.ros.own_parameters else name
            if (full, node.name) not in asked:
                yield full, node.name, use


def _unknowns(tree: LaunchTree, name: str) -> Iterator[Unknown]:
    if not tree.ros.own_parameters:
        for each in tree.unknowns:
            of_any = each.param is None and each.what == "<rosparam>"
            if of_any or (each.param is not None and f"{name}/".startswith(f"{each.param.rstrip('/')}/")):
                yield each
        return
    owner = name.rpartition(":")[0]
    for node in tree.nodes:
        if node.name == owner:
            yield from node.unknowns
            if not (node.named or node.name_from_code) and any(
                source.path is not None for source in node.param_sources
            ):
                yield Unknown("sections with the name of the node", "the launch file does not name it", node.location)
            tag = node.action.span
            yield from (
                each
                for each in tree.unknowns
                if each.location.file == node.location.file and tag.start <= each.location.span.start < tag.end
            )


def _may_be(full: str, name: str) -> bool:
    if full.endswith(f"/{name.lstrip('/')}") or full.endswith(f":{name}"):
        return True
    # `/robot/talker/rate` for `/robot/talker:rate`, as ROS 1 writes it.
    node, colon, own = full.rpartition(":")
    return bool(colon) and (f"{node}/{own}".endswith(f"/{name.lstrip('/')}"))


def _last(name: str) -> str:
    return names.leaf(name.rpartition(":")[2])
