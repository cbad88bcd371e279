"""What can be wrong with a launch file in any context: tags, attributes, and how values are written.

`ProblemKind` and the forms that several kinds share stand here, too, as `evaluation.problems` is above this.
"""

from __future__ import annotations

from typing import ClassVar

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Span


class ProblemKind:
    """What is wrong. Where, and whether the launcher stops there, is said by the `LanguageProblem` or `Problem`.

    The rule that reports a kind names its class: each has exactly one rule. Kinds with the same fields are subclasses
    of one form, as each dataclass costs every start half a millisecond.
    """

    __slots__ = ()

    usually_fatal: ClassVar[bool] = True
    """Whether the launcher stops there where nothing else is said."""

    @property
    def leaves_out(self) -> bool:
        """Whether something of the file is not evaluated for it."""
        return False

    @property
    def subject(self) -> object:
        """What two problems of one kind at one place have to differ in for both to be said."""
        return None


@dataclass(frozen=True, slots=True)
class OfName(ProblemKind):
    """A form: something about `name`."""

    name: str

    @property
    def subject(self) -> object:
        """The name."""
        return self.name


@dataclass(frozen=True, slots=True)
class LanguageProblem:
    """As an `evaluation.problems.Problem`, for what does not depend on any context."""

    kind: ProblemKind
    span: Span

    def moved(self, by: int) -> LanguageProblem:
        """The same where the text in front of it has become longer by so many characters."""
        return LanguageProblem(self.kind, self.span.moved(by))


@dataclass(frozen=True, slots=True)
class UnknownElement(ProblemKind):
    """A tag that its parent does not have. roslaunch prints a warning and skips it, launch stops."""

    tag: str
    parent: str
    allowed: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class IgnoredChild(ProblemKind):
    """`<include>` takes only `arg` and `env`; roslaunch drops the rest with a warning."""

    tag: str
    parent: str


@dataclass(frozen=True, slots=True)
class UnknownAttribute(OfName):
    """An attribute that its tag does not have. roslaunch prints a warning and goes on, launch stops."""

    tag: str
    allowed: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class _Attributes(ProblemKind):
    """A form: something about several attributes of a tag."""

    tag: str
    names: tuple[str, ...]


class MissingAttribute(_Attributes):
    """A tag has none of the attributes `names`, of which it needs one."""

    __slots__ = ()

    @property
    def subject(self) -> object:
        """The names."""
        return self.names


class ConflictingAttributes(_Attributes):
    """A tag has all of the attributes `names`, of which it can have one."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class BadValue(ProblemKind):
    """A value that an attribute cannot have. `expected` is a phrase, `choices` are values that it can have, if they can
    be listed."""

    tag: str
    attribute: str
    value: str
    expected: str
    choices: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class BadSubstitution(ProblemKind):
    """A substitution that has no value. Where it is no command of the language, `command` is what stands there, and
    `commands` are those that there are."""

    text: str
    message: str
    command: str = ""
    commands: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class SubstitutionAsText(ProblemKind):
    """What looks like a substitution and is text to roslaunch. `meant` is how that is written."""

    usually_fatal = False

    text: str
    meant: str


@dataclass(frozen=True, slots=True)
class StrayText(ProblemKind):
    """Text between the tags in `tag`, which roslaunch does not look at. `text` is its first line."""

    usually_fatal = False

    text: str
    tag: str
