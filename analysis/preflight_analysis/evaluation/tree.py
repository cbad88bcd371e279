"""What a launch file would start. Plain data; nothing here raises, what went wrong stands in `problems`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from typing import Any, Literal, NamedTuple

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.exact import exact
from preflight_analysis.documents.span import Location, Origin, Span
from preflight_analysis.environment.model import Executable
from preflight_analysis.environment.own_programs import OWN_PROGRAMS
from preflight_analysis.evaluation.commands import CommandResult
from preflight_analysis.evaluation.problems import PackageNotFound, Problem
from preflight_analysis.generation import Generation, ros
from preflight_analysis.incremental.derived import Remembering, derived
from preflight_analysis.launch.model import Action, Substitution, Value
from preflight_analysis.launch.problems import ProblemKind
from preflight_analysis.launch.python_actions import OF_CODE

ParamValue = Any
"""bool, int, float, str, bytes (binfile), list, dict, None or `CommandValue`: what the parameter server would hold."""


@dataclass(frozen=True, slots=True)
class CommandValue:
    """The value of `<param command=...>` that was not run. `reason` says why not, None if it has yet to be."""

    command: str
    reason: str | None = None


@dataclass(frozen=True, slots=True)
class Command:
    """A command that roslaunch would run for the value of a parameter; `origin` ends at the command line."""

    line: str
    param: str
    origin: Origin
    result: CommandResult | None
    """The one that the tree was made with."""
    launch_file: bool = False
    """Whether it is no command of the file's but a run that its evaluation needs: of a Python launch file
    (`evaluation/ros2/python_runs.py`) or of an expression (`evaluation/ros2/expressions.py`)."""

    @property
    def location(self) -> Location:
        """Where the command line is written."""
        return self.origin[-1]


@dataclass(frozen=True, slots=True)
class Unknown:
    """A value that cannot be known here, and why."""

    what: str
    reason: str
    location: Location
    param: str | None = None
    """Of a parameter its full name, which is not set therefore, nor is anything below it; `~name` of a private one of
    the nodes to come."""
    decides: bool = False
    """Whether a program asks for it in a condition: what it did then is one of two things that it may do."""
    covers: tuple[Location, ...] = ()
    """Of a branch that a program takes, as far as is known, where `what` says when: the actions that are made in it."""


@exact("value", "by_launch")
class Param(NamedTuple):
    """One parameter as it would be set. `name` is the full name; `overrides` are the
    earlier settings that it replaced, without those that they replaced."""

    name: str
    value: ParamValue
    origin: Origin
    owner: str | None = None
    """Full name of the node in whose tag it was set, if any."""
    name_location: Location | None = None
    """Where the name is written: the `name` attribute, or the key in a YAML text."""
    overrides: tuple[Param, ...] = ()
    by_launch: ParamValue = None
    """In ROS 2, of a parameter file: what launch reads there, where the node gets another value, which is `value`:
    `1e-3` is a text for launch's YAML and a number for rcl's. None where there is no difference."""

    @property
    def place(self) -> Location:
        """Where its name is written, else what sets it."""
        return self.name_location or self.origin[-1]


class Remap(NamedTuple):
    """`from` and `to` resolved as roslaunch does; `origin` ends at the `<remap>` tag."""

    source: str
    target: str
    origin: Origin
    source_location: Location
    target_location: Location
    inside_node: bool
    replaces: tuple[Remap, ...] = ()
    """Earlier or outer remaps of the same name that this one took the place of, for the same nodes."""


class FileSection(NamedTuple):
    """The parameters of a file for the nodes that `pattern` (`/robot/camera`, `/**`) fits, below its `key`."""

    pattern: str
    key: str
    params: tuple[Param, ...]


class ParamSource(NamedTuple):
    """What gives parameters to a ROS 2 node: a file, or values in the launch file (`path` None). `params` are those
    that reach the node, their names as it declares them (`a.b`). `keys` are those that they stand below, as written
    (`/robot/camera`, `/**`); values of the launch file have the one that launch gives them. `substituted`: the file's
    substitutions are made before the node gets it, so that its text tells no more than what stands in it plainly.
    `pushed`: it is for each node of a scope (`<set_parameter>`), not for this one. `sections` has all of a file that
    cannot be read again, as a run of a launch file wrote it, or its substitutions were made: for a node that gets
    another name, and for those within it. `made_from`: the file that the one at `path` was written from by a run."""

    path: str | None
    params: tuple[Param, ...]
    origin: Origin
    keys: tuple[str, ...] = ()
    substituted: bool = False
    pushed: bool = False
    sections: tuple[FileSection, ...] = ()
    made_from: str | None = None


class Tag:
    """The tag of a node: two are equal if they say the same, wherever that stands. `head` is the place of its head,
    which follows it through edits; `source` is its text in the file where that says all, None for what is made of
    values, or of what is written elsewhere."""

    __slots__ = ("_action", "_head", "source")

    def __init__(self, action: Action, head: Location, source: str | None = None) -> None:
        self._action, self._head, self.source = action, head, source

    @property
    def action(self) -> Action:
        """With its places in the text as it is now."""
        return self._action.moved(by) if (by := self._moved_by) else self._action

    def span_of(self, attribute: str) -> Span | None:
        """Where the value of an attribute is in the text as it is now; None where there is none."""
        value = self._action.value(attribute)
        return value.span.moved(self._moved_by) if value is not None else None

    @property
    def _moved_by(self) -> int:
        return self._head.span.start - self._action.head_span.start

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Tag):
            return NotImplemented
        if self.source is None or other.source is None:
            return self.action == other.action
        return self.source == other.source

    def __hash__(self) -> int:
        return hash(self._action.kind)

    def __repr__(self) -> str:
        return f"Tag({self.action!r})"


class LaunchNode(NamedTuple):
    """One node or test. `kind` as in the contract of `tree --format json`.

    A ROS 2 node that the launch file does not name has a name by its executable and no `named`.
    """

    name: str
    namespace: str
    package: str
    executable: str
    kind: str
    args: str
    remaps: tuple[Remap, ...]
    env: tuple[tuple[str, str], ...]
    origin: Origin
    tag: Tag
    resolved: Executable
    machine: str | None = None
    respawn: bool = False
    respawn_delay: float = 0.0
    required: bool = False
    output: str = "log"
    cwd: str | None = None
    launch_prefix: str | None = None
    clear_params: bool = False
    unknowns: tuple[Unknown, ...] = ()
    """Values of this node that could not be known: it is then not run, and findings about it are less sure."""
    named: bool = True
    name_from_code: bool = False
    """ROS 2: whether the launch file gives it no name, and a run or the source told the one that its own code does."""
    name_inferred: bool = False
    """Whether no run has told it, only the source."""
    container: str | None = None
    container_location: Location | None = None
    """Where a composable node that is loaded names its container; None for one in the container's own tag."""
    plugin: str | None = None
    extra_arguments: tuple[Param, ...] = ()
    """What the container of a composable node is told of it, such as `use_intra_process_comms`."""
    params: tuple[Param, ...] = ()
    """ROS 2: the parameters that it gets, each from the last source that has it. Those of ROS 1 are the tree's."""
    param_sources: tuple[ParamSource, ...] = ()
    """ROS 2: in the order in which they apply."""
    lacks_params: bool = False
    """ROS 2: whether it gets a parameter file that is not known or cannot be read, and that may set anything."""
    within: str | None = None
    """ROS 2, in a graph: the name of the launch file's node in whose process this one is made beside that."""
    deferred: bool = False
    """Whether it is not started at once, but after a timer or an event."""

    @property
    def location(self) -> Location:
        """The node's own tag."""
        return self.origin[-1]

    @property
    def action(self) -> Action:
        """The node's own tag, with its places in the text as it is now."""
        return self.tag.action


@dataclass(frozen=True, slots=True)
class Include:
    """An `<include>` that was taken. `path` is what `file` resolved to, None when that is unknown."""

    path: str | None
    origin: Origin
    file_location: Location
    args: Mapping[str, str | None]


@dataclass(frozen=True, slots=True)
class Arg:
    """An `<arg>` declaration of some file, in the context of one include chain. `value` None: required and missing."""

    name: str
    value: str | None
    default: str | None
    required: bool
    origin: Origin
    name_location: Location
    value_origin: Origin | None
    """Where the value was given: the declaration itself, the include's `<arg>`, None for the command line."""
    doc: str | None = None


class Use(NamedTuple):
    """A place in a file that stands for something: what hover and go-to-definition answer from.

    `kind` is `arg` (a reference or declaration), `find` (a package), `env`, `include` (a file), `value` (an attribute
    with substitutions), `declaration` (of an argument), `node` (its name), `executable`, `anon`, `dirname`, `eval`.
    `value` is what it came to, None if unknown.
    `target` is the place it leads to. `clear_params` is that attribute where it is true: `value` is the namespace.
    """

    kind: str
    location: Location
    name: str
    value: str | None
    target: Location | None = None
    origin: Origin = ()


Condition = Literal["if", "unless"]


class NotTaken(NamedTuple):
    """A tag that its condition leaves out: with all that is below it, it is never looked into. `condition` is the name
    of the attribute, `place` where its value stands, `value` what that came to, None where it is not known; `origin`
    ends at the tag."""

    tag: Tag
    condition: Condition
    value: str | None
    origin: Origin
    place: Location

    @property
    def action(self) -> Action:
        """The tag, with its places in the text as it is now."""
        return self.tag.action

    @property
    def written(self) -> Value:
        """The condition as written, with its places in the text as it is now."""
        found = self.action.value(self.condition)
        assert found is not None, "a tag is left out by an attribute that it has"
        return found

    @property
    def shown(self) -> str:
        """The condition on one line; of one that only code knows, the code."""
        written, parts = " ".join(self.written.text.split()), self.written.parts
        is_code = len(parts) == 1 and isinstance(parts[0], Substitution) and parts[0].command in OF_CODE
        return written[len("$(") : -1] if is_code else written


DEFAULT_MACHINE_TIMEOUT = 10.0
"""In seconds, for the process on another machine to register."""


@dataclass(frozen=True, slots=True)
class Machine:
    """A `<machine>` declaration."""

    name: str
    address: str
    env_loader: str | None
    user: str | None
    timeout: float | None
    origin: Origin
    ssh_port: int = 22
    password: str | None = None
    assignable: bool = True

    @property
    def settings(self) -> tuple[object, ...]:
        """What has to be the same where a machine is declared twice."""
        timeout = self.timeout or DEFAULT_MACHINE_TIMEOUT
        login = (self.user or "", self.password or "", self.ssh_port)
        return self.name, self.address, self.env_loader or "", *login, timeout, self.assignable


@dataclass(frozen=True, slots=True)
class Edited:
    """A Python launch file that stands as its last good run told it. `span` is what was edited since, `wrong` where it
    is said why the text as it is has no run that went well."""

    span: Span
    wrong: frozenset[Span]

    def replaces(self, span: Span) -> bool:
        """Whether what is said of a place was said of another text."""
        return span not in self.wrong and span.start <= self.span.end and self.span.start <= span.end


class StateChange(NamedTuple):
    """A transition that the launch asks a lifecycle node for: `configure`, `activate`, ..., "" for one that ends it,
    None where it is not known. The node is that of the full name `node`, or what the action of a Python launch file
    made that has the number at the end of `made_by`, after the file and what leads to that; where both are None, it may
    be any below the includes of `within`: a launch file of a package that is not here knows no nodes but its own."""

    transition: str | None
    node: str | None
    made_by: tuple[str, Origin, str] | None
    within: Origin = ()

    def may_be_for(self, node: LaunchNode) -> bool:
        """Whether it is for a node."""
        if self.made_by is not None:
            number = node.action.value("id")
            return number is not None and (node.location.file, node.origin[:-1], number.text) == self.made_by
        return self.node in (None, node.name) and node.origin[: len(self.within)] == self.within


@dataclass(frozen=True, slots=True)
class LaunchTree(Remembering):
    """What the launcher would start from `file`. `inputs` maps every file that was read (launch files, YAML, ...)
    to the digest of its content, "" for a file that was looked for and is not there: an unchanged map means an
    unchanged tree."""

    file: str
    generation: int
    args: Mapping[str, Arg]
    nodes: tuple[LaunchNode, ...]
    params: Mapping[str, Param]
    clear_params: tuple[str, ...]
    includes: tuple[Include, ...]
    machines: Mapping[str, Machine]
    uses: tuple[Use, ...]
    problems: tuple[Problem[ProblemKind], ...]
    unknowns: tuple[Unknown, ...]
    files: tuple[str, ...]
    """The root and every included file that was evaluated, in order of first appearance."""
    inputs: Mapping[str, str] = field(default_factory=dict)
    commands: tuple[Command, ...] = ()
    """In the order in which roslaunch would run them."""
    not_taken: tuple[NotTaken, ...] = ()
    """The tags that are left out, in the order in which they were met."""
    edited: Mapping[str, Edited] = field(default_factory=dict)
    """Python launch files whose text has no good run yet."""
    nodes_before: tuple[int, ...] = ()
    """ROS 2: for each include how many nodes came before it. A line of a Python launch file may include several
    times."""
    simulated: tuple[LaunchNode, ...] = ()
    """ROS 2: controller managers that the launch does not start, but the simulator, for the robots that are spawned in
    it."""
    written: frozenset[str] = frozenset()
    """The paths of the files that Python launch files write."""
    file_params: Mapping[str, tuple[Param, ...]] = field(default_factory=dict)
    """What files have that parameters or arguments of a node name, by the full name of the node; `known_files.py`."""
    state_changes: tuple[StateChange, ...] = ()
    """ROS 2: what its events ask lifecycle nodes for."""

    @property
    def ros(self) -> Generation:
        """What is so in its generation of ROS."""
        return ros(self.generation)

    @property
    def lacking(self) -> tuple[str, ...]:
        """The arguments without a value: it cannot be launched without them."""
        return tuple(name for name, arg in self.args.items() if arg.value is None)

    @property
    def all_params(self) -> tuple[Param, ...]:
        """The parameters of all nodes and namespaces; the same object each time."""
        return _all_params(self)

    @property
    def nodes_and_simulated(self) -> tuple[LaunchNode, ...]:
        """What the launcher starts, then what the simulator makes; the same object each time."""
        return _nodes_and_simulated(self)

    @property
    def complete(self) -> bool:
        """Whether all that the launcher would start is here: no error cut something off and nothing is unknown."""
        return not self.unknowns and not any(p.fatal and not self._is_stood_in_for(p) for p in self.problems)

    def _is_stood_in_for(self, problem: Problem[ProblemKind]) -> bool:
        if isinstance(problem.kind, PackageNotFound) and problem.kind.name in OWN_PROGRAMS:
            return True
        edited = self.edited.get(problem.location.file)
        return edited is not None and problem.location.span in edited.wrong


def nothing_launched(file: str, generation: int) -> LaunchTree:
    """The tree of a file that is no launch file."""
    return LaunchTree(file, generation, {}, (), {}, (), (), {}, (), (), (), ())


@derived
def _nodes_and_simulated(tree: LaunchTree) -> tuple[LaunchNode, ...]:
    return (*tree.nodes, *tree.simulated) if tree.simulated else tree.nodes


@derived
def _all_params(tree: LaunchTree) -> tuple[Param, ...]:
    return tuple(tree.params.values())
