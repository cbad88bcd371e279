"""Reading the attributes of a tag: resolved, required, boolean, number."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from preflight_analysis.documents.document import SpannedText
from preflight_analysis.documents.span import Span
from preflight_analysis.evaluation import values
from preflight_analysis.evaluation.resolved import Resolved
from preflight_analysis.evaluation.ros1.scope import Scope
from preflight_analysis.evaluation.ros1.state import State
from preflight_analysis.evaluation.ros1.substitute import resolve
from preflight_analysis.evaluation.tree import Condition, NotTaken, Tag
from preflight_analysis.launch.model import Action, ActionAttribute
from preflight_analysis.launch.problems import BadValue, ConflictingAttributes, MissingAttribute, UnknownAttribute
from preflight_analysis.launch.schema import one_of
from preflight_analysis.launch.schema_ros1 import TAGS
from preflight_analysis.launch.substitutions import parse_value

T = TypeVar("T")
_CONDITIONS: tuple[Condition, ...] = ("if", "unless")


class Attributes:
    """The attributes of one action in one scope. What is wrong is noted in the state, once, and read as absent."""

    def __init__(self, state: State, scope: Scope, action: Action) -> None:
        self.state, self.scope, self.action = state, scope, action
        self._found: dict[str, Resolved] = {}

    @property
    def unknown(self) -> tuple[str, ...]:
        """The names of those asked for so far that could not be resolved."""
        return tuple(name for name, found in self._found.items() if not found.known)

    @property
    def all_known(self) -> bool:
        """Whether everything asked for so far could be resolved."""
        return not self.unknown

    def get(self, name: str) -> Resolved | None:
        """The resolved value, None where there is no such attribute. It is resolved the first time it is asked for:
        ask in the order in which roslaunch does, so that the first problem noted is the one that it stops at."""
        if name not in self._found and (value := self.action.value(name)) is not None:
            self._found[name] = resolve(self.state, self.scope, value)
        return self._found.get(name)

    def strip(self, name: str) -> None:
        """Read this attribute without the blanks around it, as they are written: those of substitutions stay."""
        value = self.action.value(name)
        text = value.text.strip() if value is not None else ""
        if value is None or text == value.text:
            return
        start = value.span.start + value.text.index(text)
        stripped = parse_value(SpannedText(text, Span(start, start + len(text))))
        self._found[name] = resolve(self.state, self.scope, stripped)

    def text(self, name: str) -> str | None:
        """Its text, with unresolved substitutions in it where it is not known."""
        found = self.get(name)
        return found.text if found else None

    def require(self, *names: str) -> list[Resolved] | None:
        """All of them, or None where one is missing, which is noted: roslaunch stops at the first."""
        results = []
        for name in names:
            found = self.get(name)
            if found is None:
                self.missing(name)
            else:
                results.append(found)
        return results if len(results) == len(names) else None

    def missing(self, name: str) -> None:
        """Note an attribute that roslaunch needs."""
        origin = self.scope.origin(self.action.kind_span)
        self.state.problem(MissingAttribute(self.action.kind, (name,)), origin)

    def convert(self, name: str, default: T, converter: Callable[[str], T]) -> T:
        """The attribute through `converter`, which raises `BadValueError`; `default` where absent, unknown or bad."""
        found = self.get(name)
        if found is None or not found.known:
            return default
        try:
            return converter(found.text)
        except values.BadValueError as error:
            self.bad_value(name, found.text, str(error))
            return default

    def refuse(self, attribute: ActionAttribute) -> None:
        """Note an attribute on which roslaunch stops, where others that it does not know get a warning."""
        kind = self.action.kind
        origin, allowed = self.scope.origin(attribute.name_span), tuple(TAGS[kind].attributes)
        self.state.problem(UnknownAttribute(attribute.name, kind, allowed), origin)

    def chosen(self, name: str, text: str) -> bool:
        """Whether `text` is among the choices that the language has for the attribute; if not, that is noted."""
        choices = TAGS[self.action.kind.lower()].attributes[name].choices
        if text not in choices:
            self.bad_value(name, text, one_of(choices), choices)
            return False
        return True

    def bad_value(self, name: str, value: str, expected: str, choices: tuple[str, ...] = ()) -> None:
        """Note a value that roslaunch refuses."""
        attribute = self.action.attribute(name)
        known = TAGS[self.action.kind.lower()].attributes.get(name)
        span = attribute.value.span if attribute else self.action.kind_span
        choices = choices or (known.choices if known else ())
        self.state.problem(BadValue(self.action.kind, name, value, expected, choices), self.scope.origin(span))


def positive_number(text: str) -> float:
    """A number above zero."""
    number = plain_number(text)
    if number <= 0:
        raise values.BadValueError("a number above 0")
    return number


def plain_number(text: str) -> float:
    """Any number."""
    try:
        return float(text)
    except ValueError:
        raise values.BadValueError("a number") from None


def integer(text: str) -> int:
    """An integer."""
    try:
        return int(text)
    except ValueError:
        raise values.BadValueError("an integer") from None


def applies(state: State, scope: Scope, action: Action) -> bool:
    """Whether the tag is evaluated at all, by its `if` and `unless`. One that is not is never looked into."""
    if action.attribute("if") is None and action.attribute("unless") is None:
        return True
    attributes = Attributes(state, scope, action)
    results = {name: attributes.get(name) for name in _CONDITIONS}
    given = [name for name, found in results.items() if found is not None]
    if len(given) == 2:
        state.problem(ConflictingAttributes(action.kind, tuple(given)), scope.origin(action.kind_span))
        return False
    for name, found in results.items():
        if found is None:
            continue
        if state.is_assumed(scope.location(action.head_span)):
            return True
        if not found.known:
            span = _note_not_taken(state, scope, action, name, None)
            state.unknown(f"<{action.kind} {name}>", "its condition is not known", scope, span)
            return False
        try:
            taken = values.to_bool(found.text) == (name == "if")
        except values.BadValueError as error:
            attributes.bad_value(name, found.text, str(error), TAGS[action.kind.lower()].attributes[name].choices)
            return False
        if not taken:
            _note_not_taken(state, scope, action, name, found.text)
        return taken
    return True


def _note_not_taken(state: State, scope: Scope, action: Action, condition: Condition, value: str | None) -> Span:
    """Where the condition is written."""
    attribute = action.attribute(condition)
    span = attribute.value.span if attribute else action.kind_span
    origin = scope.origin(action.head_span)
    tag = Tag(action, origin[-1], scope.lines.text[slice(*action.span)])
    state.not_taken.append(NotTaken(tag, condition, value, origin, scope.location(span)))
    return span
