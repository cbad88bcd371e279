"""The parameters of a launch by name: all places that set one, in the order in which they apply, and who reads it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchTree, Param
from preflight_analysis.queries.symbol_at import own_parameter, settings_of
from preflight_analysis.rules.nearest import nearest
from preflight_analysis.tracing.interface import ParamUse
from preflight_analysis.workspace.workspace import Analysis


class NoSuchParameterError(Exception):
    """Nothing sets or reads a parameter of that name. `near` are the names that may be meant."""

    def __init__(self, name: str, near: Sequence[str]) -> None:
        super().__init__(name)
        self.name, self.near = name, tuple(near)


@dataclass(frozen=True, slots=True)
class Parameter:
    """One parameter. `name` is the full one, in ROS 2 `/node:name`. `settings` are the places that set it, the one that
    applies first; `uses` are the calls of nodes, each with the node's name."""

    name: str
    settings: tuple[Param, ...]
    uses: tuple[tuple[str, ParamUse], ...]

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
    return Parameter(name, tuple(settings.values()), uses) if settings or uses else None


def parameters(analysis: Analysis, name: str) -> tuple[Parameter, ...]:
    """The parameters that a name may mean: a full one (`/node/name`; in ROS 2 `/node:name`), or its last part, which
    several nodes may have. Raises `NoSuchParameterError`."""
    known = sorted({*(full for full, _ in settings_of(analysis.tree)), *(full for full, _, _ in _uses(analysis))})
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


def _uses(analysis: Analysis) -> Iterator[tuple[str, str, ParamUse]]:
    for read in analysis.graph.param_reads if analysis.graph is not None else ():
        full = own_parameter(read.node, read.use.name) if analysis.tree.ros.own_parameters else read.name
        yield full, read.node.name, read.use


def _may_be(full: str, name: str) -> bool:
    if full.endswith(f"/{name.lstrip('/')}") or full.endswith(f":{name}"):
        return True
    # `/robot/talker/rate` for `/robot/talker:rate`, as ROS 1 writes it.
    node, colon, own = full.rpartition(":")
    return bool(colon) and (f"{node}/{own}".endswith(f"/{name.lstrip('/')}"))


def _last(name: str) -> str:
    return names.leaf(name.rpartition(":")[2])
