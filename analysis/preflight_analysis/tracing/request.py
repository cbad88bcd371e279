"""What to run: one node with all that the launch file gives it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import field, replace
from typing import Any

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation.ros2.param_files import Section
from preflight_analysis.evaluation.ros2.remaps import before_remaps, renames_nodes
from preflight_analysis.evaluation.words import words_of
from preflight_analysis.generation import Generation, ros


@dataclass(frozen=True, slots=True)
class Component:
    """How a composable node of ROS 2 is loaded: the class, and the container that a run starts for it alone."""

    plugin: str
    container: str = ""
    """Absolute path of its program."""
    container_node: str = ""
    """Its full name."""
    container_named: bool = True
    """As `TraceRequest.named`."""
    container_args: tuple[str, ...] = ()
    container_renames: tuple[tuple[str, str], ...] = ()
    """Its remaps of the names and namespaces of nodes: further nodes that the component makes may get them."""
    extra_arguments: tuple[tuple[str, Any], ...] = ()
    """What it is told of this component, such as `use_intra_process_comms`."""


@dataclass(frozen=True, slots=True)
class TraceRequest:
    """A run. `params` is the parameter server of the whole launch by full name, private parameters included; best
    `SharedParams`, as what is asked of them in the cache is then made once."""

    node: str
    """Full name."""
    package: str
    executable: str
    """Absolute path; of a component that of its library."""
    args: tuple[str, ...] = ()
    """The node's own arguments, split as a shell would."""
    remaps: tuple[tuple[str, str], ...] = ()
    """`(from, to)` as roslaunch or launch hands them to the node."""
    params: Mapping[str, Any] = field(default_factory=dict)
    env: tuple[tuple[str, str], ...] = ()
    """What the launch file sets for the node."""
    cwd: str | None = None
    generation: int = 1
    """Of ROS. In ROS 2 `params` are the node's own, by the full name of the node and their own after it."""
    entry_point: str | None = None
    """`module:function` where `executable` is the file of a Python module that is run from its source."""
    named: bool = True
    """Whether the launch file names the node; its own code does otherwise."""
    sections: tuple[tuple[Section, ...], ...] = ()
    """What the node's parameter files and values have for nodes of any name, source by source; of a component those of
    its container. What of it is for a node without a name in the launch file, or for others of the process, is only
    known once a run has told their names."""
    each: tuple[tuple[str, Mapping[str, Any]], ...] = ()
    """ROS 2: the parameters of each node of the process, by its full name, where those are not the same for all."""
    component: Component | None = None
    """Of a composable node, which cannot be run alone. Environment and folder are then those of its container."""
    launch: str | None = field(default=None, compare=False)
    """The launch file with the node's tag: for telling where a trace comes from, it is no part of the run."""

    @property
    def program(self) -> str:
        """What is started: absolute path."""
        return self.component.container if self.component is not None else self.executable

    @property
    def ros(self) -> Generation:
        """What is so in its generation of ROS."""
        return ros(self.generation)

    @property
    def renames(self) -> tuple[tuple[str, str], ...]:
        """ROS 2: the remaps of the names and namespaces of nodes; all others are applied to what the run tells."""
        return tuple(remap for remap in self.remaps if self.ros.remaps_of_nodes and renames_nodes(remap[0]))

    def under(self, name: str) -> TraceRequest | None:
        """The run with what the parameter files have for the full name that the node gave itself; None where that
        makes no difference. As rcl does it, keys count in the order in which they are met first."""
        params = {f"{self.node}/{param}": value for param, value in self._for(name).items()}
        if _is_same(params, self.params):
            return None
        return replace(self, params=params, sections=())

    def beside(self, names: Iterable[str]) -> TraceRequest | None:
        """Likewise for the nodes of these names, which have the arguments of the container's process."""
        each = tuple((name, given) for name in names if (given := self._for(name)))
        return replace(self, sections=(), each=each) if each else None

    def under_each(self, names: tuple[str, ...]) -> TraceRequest | None:
        """Likewise for the nodes of a process that makes several; None where all of them get the same."""
        first = self.node if self.node in names else names[0]
        each = {name: self._for(name) for name in (first, *names)}
        params = {f"{self.node}/{param}": value for param, value in each[first].items()}
        if _is_same(params, self.params) and all(_is_same(given, each[first]) for given in each.values()):
            return None
        return replace(self, params=params, sections=(), each=tuple(each.items()))

    def given_to(self, node: str | None) -> Mapping[str, Any]:
        """The parameters that a node of the process gets in the run, by the names that they have there."""
        own = f"{self.node}/"
        given = {name.removeprefix(own): value for name, value in self.params.items() if name.startswith(own)}
        others = dict(self.each)
        if self.component is None:
            given = dict(others.get(node or "", given))
        elif node in (None, self.node):
            given = {**others.get(self.node, {}), **given}
        elif self.named or node in others:
            given = dict(others.get(node or "", {}))
        return before_remaps(given, self.remaps, node or self.node) if self.ros.own_parameters else given

    def _for(self, name: str) -> dict[str, Any]:
        """What the sources have for the node of this full name."""
        below: dict[str, dict[str, Any]] = {}
        for sections in self.sections:
            for section in sections:
                if section.params and section.fits(name):
                    below.setdefault(section.key, {}).update((param.name, param.value) for param in section.params)
        return {param: value for values in below.values() for param, value in values.items()}


def _is_same(one: Mapping[str, Any], other: Mapping[str, Any]) -> bool:
    return repr(sorted(one.items())) == repr(sorted(other.items()))


def split_args(text: str) -> tuple[str, ...]:
    """A node's arguments as roslaunch hands them over; split at blanks where a quote is left open."""
    return tuple(words_of(text))
