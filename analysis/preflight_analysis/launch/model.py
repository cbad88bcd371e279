"""The one shape of all launch formats: actions whose values are texts with substitutions, each with its span.

ROS 2's own launch frontends do the same (`launch.frontend.Entity`): XML elements and YAML maps become entities
with attributes and children. What an action means is the business of `evaluation/`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any, Concatenate, NamedTuple, ParamSpec, TypeVar

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document, SpannedText
from preflight_analysis.documents.exact import exact
from preflight_analysis.documents.movable import Movable, moved
from preflight_analysis.documents.python_text import is_python
from preflight_analysis.documents.span import Span
from preflight_analysis.incremental.derived import Remembering, derived

P = ParamSpec("P")
T = TypeVar("T")


class Literal(NamedTuple):
    """Text that stands for itself."""

    text: str
    span: Span

    def moved(self, by: int) -> Literal:
        """The same where the text in front of it has become longer by so many characters."""
        return Literal(self.text, self.span.moved(by))


class Substitution(NamedTuple):
    """`$(command arguments)`. `span` covers all of it, `arguments_span` what follows the command's blank.

    In ROS 2, where they nest, `words` are the arguments cut into pieces; in ROS 1 there are none.
    """

    command: str
    command_span: Span
    arguments: str
    arguments_span: Span
    text: str
    span: Span
    words: tuple[tuple[Literal | Substitution, ...], ...] = ()

    def moved(self, by: int) -> Substitution:
        """The same where the text in front of it has become longer by so many characters."""
        command, arguments, whole = (each.moved(by) for each in (self.command_span, self.arguments_span, self.span))
        words = tuple(tuple(part.moved(by) for part in word) for word in self.words)
        return Substitution(self.command, command, self.arguments, arguments, self.text, whole, words)


@exact("value")
class Typed(NamedTuple):
    """What a value that is no text stands for: a bool, int, float, list or None of a YAML file."""

    value: Any


class Value(NamedTuple):
    """A text as written (entities decoded) and its pieces. `problem` says why it could not be cut into pieces, and
    `problem_span` where; `typed` is there if it is no text."""

    text: str
    span: Span
    parts: tuple[Literal | Substitution, ...]
    problem: str | None = None
    problem_span: Span | None = None
    typed: Typed | None = None

    @property
    def substitutions(self) -> Iterator[Substitution]:
        """The pieces that need evaluation."""
        return (p for p in self.parts if isinstance(p, Substitution))

    @property
    def is_literal(self) -> bool:
        """Whether the value means what it says."""
        return "$" not in self.text or not any(True for _ in self.substitutions)

    def moved(self, by: int) -> Value:
        """The same where the text in front of it has become longer by so many characters."""
        problem_span = self.problem_span.moved(by) if self.problem_span is not None else None
        parts = tuple(part.moved(by) for part in self.parts)
        return Value(self.text, self.span.moved(by), parts, self.problem, problem_span, self.typed)


class ActionAttribute(NamedTuple):
    """One named value of an action."""

    name: str
    name_span: Span
    value: Value
    span: Span

    def moved(self, by: int) -> ActionAttribute:
        """The same where the text in front of it has become longer by so many characters."""
        return ActionAttribute(self.name, self.name_span.moved(by), self.value.moved(by), self.span.moved(by))


@dataclass(frozen=True, slots=True)
class Action(Movable):
    """A tag of a launch file. `kind` is its name in the format's own words (`node`, `include`, `arg`, ...).

    `head_span` is what a diagnostic about the whole action underlines (the start tag in XML); `comments` are the
    comments among its children, where annotations may stand; `body` is its character data (`<rosparam>`).
    """

    kind: str
    kind_span: Span
    attributes: tuple[ActionAttribute, ...]
    children: tuple[Action, ...]
    comments: tuple[SpannedText, ...]
    body: Value
    head_span: Span
    span: Span

    def attribute(self, name: str) -> ActionAttribute | None:
        """The attribute of that name."""
        # A plain loop: this is called more than anything else on a keystroke.
        for attribute in self.attributes:
            if attribute.name == name:
                return attribute
        return None

    def value(self, name: str) -> Value | None:
        """The value of the attribute of that name."""
        found = self.attribute(name)
        return found.value if found else None

    def walk(self) -> Iterator[Action]:
        """This action and all below it, in document order."""
        yield self
        for child in self.children:
            yield from child.walk()

    def gather(self, find: Callable[Concatenate[Action, P], Iterable[T]], *shared: P.args, **none: P.kwargs) -> list[T]:
        """What `find(action, *shared)` gives for this action and all below it, in document order. It is a pure function
        of one tag whose results a `Movable` may hold; of the tags right below this one that have only moved they are
        those of before."""
        found = [*find(self, *shared, **none)]
        originals = _original_children(self)
        for child, original in zip(self.children, originals, strict=True):
            if below := _gathered(original, find, shared):
                found += moved(below, child.moved_by)
        return found


@derived
def _original_children(action: Action) -> tuple[Action, ...]:
    return tuple([child.original for child in action.children])


@derived
def _gathered(action: Action, find: Callable[..., Iterable[T]], shared: tuple[Any, ...]) -> tuple[T, ...]:
    return tuple(item for each in action.walk() for item in find(each, *shared))


NODE_KINDS = frozenset({"node", "test", "node_container", "composable_node", "lifecycle_node"})
"""Tags that start a node."""


@dataclass(frozen=True, slots=True)
class LaunchFile(Remembering):
    """A launch file of any format. `root` is None when the file has no `<launch>` to speak of; `extra_roots` are
    the tags of further ones, which no launcher accepts. `partial`: it is a program that was not run, and nothing may
    be concluded from what it has not; `named` are the substitutions and components that are written in it, wherever
    that is."""

    path: str
    generation: int
    root: Action | None
    document: Document
    extra_roots: tuple[Span, ...] = ()
    partial: bool = False
    named: tuple[Substitution, ...] | None = None

    @property
    def is_python(self) -> bool:
        """Whether it is a program in Python."""
        return is_python(self.path, self.document.text)


def action_at(launch_file: LaunchFile, offset: int) -> Action | None:
    """The innermost tag around `offset`; between two tags that touch, the one that begins there."""
    action = launch_file.root
    if action is None or not action.span.contains(offset):
        return None
    while True:
        inside = [c for c in action.children if c.span.contains(offset)]
        if not inside:
            return action
        action = inside[-1]
