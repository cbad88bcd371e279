"""What can go wrong when a launch file is read and evaluated: one class for each kind of problem."""

from __future__ import annotations

from typing import Generic, TypeVar

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location, Origin
from preflight_analysis.launch.problems import OfName, ProblemKind

K_co = TypeVar("K_co", bound=ProblemKind, covariant=True)


@dataclass(frozen=True, slots=True)
class Problem(Generic[K_co]):
    """Something the evaluation met. `fatal` problems are what would stop the launcher; `origin` ends at the place to
    underline."""

    kind: K_co
    origin: Origin
    fatal: bool

    @property
    def location(self) -> Location:
        """The place to underline."""
        return self.origin[-1]


# Forms that several kinds have


@dataclass(frozen=True, slots=True)
class _Message(ProblemKind):
    """A form: a text that something cannot make sense of."""

    message: str


@dataclass(frozen=True, slots=True)
class UnreadablePath(ProblemKind):
    """A form: a file that cannot be read."""

    path: str
    reason: str


@dataclass(frozen=True, slots=True)
class _Expression(ProblemKind):
    """A form: an expression in Python that has no value."""

    expression: str
    message: str


@dataclass(frozen=True, slots=True)
class _OfNames(OfName):
    """A form: a name that is none of those declared."""

    declared: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class _Limit(ProblemKind):
    """A form: there is more of something than `limit`, a phrase."""

    limit: str


# Files


class UnreadableFile(UnreadablePath):
    """The root file cannot be read: it is missing, a folder, or not permitted to be."""

    __slots__ = ()
    leaves_out = True


class NotTextFile(UnreadablePath):
    """The root file is binary, not in UTF-8, or larger than the limit."""

    __slots__ = ()
    leaves_out = True


class MalformedXml(_Message):
    """The text is not well-formed XML, at the place of the cause."""

    __slots__ = ()
    leaves_out = True


class MalformedYaml(_Message):
    """The text is not YAML, at the place where it stops to be."""

    __slots__ = ()
    leaves_out = True


class MalformedPython(_Message):
    """The text is not Python, at the place where it stops to be."""

    __slots__ = ()
    leaves_out = True


class UnexpandedEntity(OfName):
    """An entity that a DOCTYPE defines: never expanded here, so values with it are unknown."""

    __slots__ = ()
    usually_fatal = False


@dataclass(frozen=True, slots=True)
class NoLaunchElement(ProblemKind):
    """The document element is not `<launch>` but `tag`, None in an empty file; `launch` is a second one."""

    leaves_out = True

    tag: str | None


@dataclass(frozen=True, slots=True)
class PythonException(ProblemKind):
    """A Python launch file raised `error` (the name of the class), or its run failed where that is empty. `frames` go
    from the outermost inwards. `absent` is what the function that raises looked for before, and did not find: a path,
    a pattern or a program; empty where that is not so."""

    leaves_out = True

    error: str
    message: str
    frames: tuple[Location, ...] = ()
    absent: str = ""


@dataclass(frozen=True, slots=True)
class PythonImportFailed(ProblemKind):
    """A Python launch file imports what is not there. `stood_in_for`: it was run all the same, and what depends on the
    module is not known."""

    usually_fatal = False

    module: str
    message: str
    stood_in_for: bool = False
    instead: str = ""
    """The module of launch that has the name which was imported from another one of launch."""

    @property
    def leaves_out(self) -> bool:
        """Not where the run went on with a stand-in."""
        return not self.stood_in_for


@dataclass(frozen=True, slots=True)
class LaunchFileNotRun(OfName):
    """A Python launch file, or a function or substitution of it, was not run."""

    leaves_out = True
    usually_fatal = False

    reason: str


# Substitutions


class EvalFailed(_Expression):
    """`$(eval)` raises."""

    __slots__ = ()


class EvalNotAllowed(_Expression):
    """`$(eval)` of what is not evaluated without running code."""

    __slots__ = ()
    usually_fatal = False


class UnsetVariable(OfName):
    """`$(env)` of an environment variable that is not set."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class AssumedVariable(OfName):
    """A Python launch file asks for an environment variable of ROS that is not set, and got a likely value."""

    usually_fatal = False

    value: str


class PackageNotFound(OfName):
    """`$(find)` of a package that is not there."""

    __slots__ = ()


class ValueTooLong(_Limit):
    """A value that substitutions make is not kept, as it is so long."""

    __slots__ = ()
    usually_fatal = False


class WithheldVariable(OfName):
    """A variable that is set and whose value is a secret, which is not read."""

    __slots__ = ()
    usually_fatal = False


# Arguments


@dataclass(frozen=True, slots=True)
class UndeclaredArgument(_OfNames):
    """`$(arg)` of what is not declared before. In ROS 2 something that could not be evaluated may have set it, which is
    `not_followed`: then it need not be fatal."""

    not_followed: Location | None = None


@dataclass(frozen=True, slots=True)
class UnsetParameter(OfName):
    """`$(param)` of what no `<set_parameter>` before sets; something that could not be evaluated may have."""

    not_followed: Location | None = None


@dataclass(frozen=True, slots=True)
class MissingArgument(OfName):
    """An include of `file` has no value for an argument that is required there; it has those of `passed`."""

    file: str
    passed: tuple[str, ...]


class ArgumentNeeded(OfName):
    """The root file needs `name:=value` on the command line."""

    __slots__ = ()


class UnknownLaunchArgument(_OfNames):
    """`name:=value` on the command line, which nothing asks for."""

    __slots__ = ()
    usually_fatal = False


@dataclass(frozen=True, slots=True)
class UnknownIncludeArgument(_OfNames):
    """An include passes what `file` does not declare. roslaunch stops with 'unused args', launch takes it."""

    file: str


@dataclass(frozen=True, slots=True)
class ArgumentNotAChoice(OfName):
    """The value of an argument is none of its choices. `declared` is where it has them."""

    value: str
    choices: tuple[str, ...]
    declared: Location


@dataclass(frozen=True, slots=True)
class RedeclaredArgument(OfName):
    """An argument is declared twice in a file or, where it is `passed`, passed twice in an include."""

    first: Location
    passed: bool


class FixedArgument(OfName):
    """An include passes a value for an argument that the file fixes with `value=`."""

    __slots__ = ()


class IncludeArgumentWithoutValue(OfName):
    """An `<arg>` in an `<include>` without a value."""

    __slots__ = ()


# Includes and what parameters are read from


class IncludeNotFound(UnreadablePath):
    """An included file is not there."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class IncludeNotCatalogued(ProblemKind):
    """An included file of a package that is not here, `below` its share folder, is not among those that the catalogue
    of `distro` has of it."""

    usually_fatal = False
    distro: str
    package: str
    below: str


class LaunchedFileNotFound(UnreadablePath):
    """A file is not there that a process launches with `ros2 launch`."""

    __slots__ = ()
    usually_fatal = False


class UnreadableInclude(UnreadablePath):
    """An included file is binary, too large, a folder, not permitted to be read, or no launch file of
    the generation of ROS that includes it."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class IncludeCycle(ProblemKind):
    """A file includes itself, by way of the files of `chain`."""

    path: str
    chain: tuple[str, ...]


class NestedTooDeeply(_Limit):
    """Groups and includes are not evaluated any further, as they go so deep or are so many."""

    __slots__ = ()
    leaves_out = True
    usually_fatal = False


class WithheldFile(UnreadablePath):
    """A file is there and not read: a secret, or out of reach of a workspace that is not trusted."""

    __slots__ = ()
    usually_fatal = False


class ParameterFileNotFound(UnreadablePath):
    """A `textfile`, `binfile` or parameter file is not there."""

    __slots__ = ()


class UnreadableParameterFile(UnreadablePath):
    """A `textfile`, `binfile` or parameter file is there and cannot be read."""

    __slots__ = ()


class BadYaml(_Message):
    """What should be parameters is no YAML, or YAML of something else."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class NothingToReplace(OfName):
    """What `by` (`RewrittenYaml`, `ReplaceString`) is to replace is not in the file at `path`."""

    usually_fatal = False

    by: str
    path: str


@dataclass(frozen=True, slots=True)
class YamlKeyTwice(OfName):
    """A key stands twice in one dictionary. `second` is the later one, which counts."""

    usually_fatal = False

    second: Location


class MalformedCommand(_Message):
    """A command line that cannot be split into words."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class CommandFailed(ProblemKind):
    """A command was run and had no success. `stderr` has its last lines."""

    reason: str
    stderr: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class CommandMissing(ProblemKind):
    """The program of a command line is not there."""

    command: str


@dataclass(frozen=True, slots=True)
class CommandNotRun(ProblemKind):
    """A command that was not run."""

    usually_fatal = False

    reason: str


# Nodes and machines


@dataclass(frozen=True, slots=True)
class InvalidName(OfName):
    """A name that ROS does not allow, `what` it is of: a node, an argument, ..."""

    what: str
    reason: str


@dataclass(frozen=True, slots=True)
class DuplicateNode(OfName):
    """A second node of one name. `first` is the other, None where that is roslaunch's own. Fatal in ROS 1."""

    first: Location | None


class UndefinedMachine(_OfNames):
    """A node on a machine that is not declared."""

    __slots__ = ()
