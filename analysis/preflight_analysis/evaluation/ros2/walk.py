"""The walk over the actions of a launch, in the order in which launch executes them."""

from __future__ import annotations

import os
from collections.abc import Callable, Hashable, Mapping
from functools import partial

from preflight_analysis.catalogue.launches import catalogued_file
from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Origin, Span
from preflight_analysis.environment.launch_extensions import exposed_actions
from preflight_analysis.evaluation.before import Before, Question
from preflight_analysis.evaluation.problems import (
    ArgumentNotAChoice,
    LaunchFileNotRun,
    MalformedPython,
    MalformedXml,
    MalformedYaml,
    NestedTooDeeply,
    NoLaunchElement,
    PythonException,
    UnexpandedEntity,
)
from preflight_analysis.evaluation.resolved import Resolved
from preflight_analysis.evaluation.ros2.context import Changes, Context, NotByPartsError
from preflight_analysis.evaluation.ros2.declared import Declared
from preflight_analysis.evaluation.ros2.entity import Entity, Part
from preflight_analysis.evaluation.ros2.events import Events, Noted
from preflight_analysis.evaluation.ros2.place import Place, PythonRun
from preflight_analysis.evaluation.ros2.python_branches import BRANCH
from preflight_analysis.evaluation.ros2.python_runs import calls_own_code, recorded
from preflight_analysis.evaluation.ros2.state import Added, State
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.types import NotOfTypeError, coerce
from preflight_analysis.evaluation.ros2.written import is_from_yaml
from preflight_analysis.evaluation.tree import Condition, NotTaken, StateChange
from preflight_analysis.launch.configurations import Names, configurations_of, names_in_code
from preflight_analysis.launch.model import Action, ActionAttribute, LaunchFile
from preflight_analysis.launch.problems import BadValue, LanguageProblem, UnknownElement
from preflight_analysis.launch.schema import Tag

_CONDITIONS: tuple[Condition, ...] = ("if", "unless")
MAX_DEPTH = 150
"""Of groups and includes within each other."""
MAX_INCLUDES = 2_000
MAX_DEPTH_OF_PARTS = 24
"""Of includes within each other; what is deeper is evaluated where it is, as Python's stack has an end."""
_MALFORMED = {".yaml": MalformedYaml, ".yml": MalformedYaml}
_UNREAD = frozenset({"event_handler", "opaque", "timer"})
"""Actions of which the text of a Python file does not tell what is in them."""
_CHANGES_STATES = frozenset({"emit_event", "event_handler", "lifecycle_transition"})
"""Those that may ask a lifecycle node for a transition."""
_SURE_UNRUN = (MalformedPython, LaunchFileNotRun, ArgumentNotAChoice, NestedTooDeeply)
"""What can be said of a Python launch file that was not run."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchAction(Entity):
    """A kind of action: what launch files may say of it, and what it does."""

    evaluate: Callable[[Walk, Performer, Action], None] | None
    """What it does when it is executed; None: nothing that changes what is started, now or later."""
    offered: int = 0
    """Its place among those that are offered while typing, the lowest first."""
    starts_process: bool = False
    """Whether handlers of process starts are told of it."""
    configures: bool = False
    """Whether there may be other launch configurations after it."""
    is_part: bool = False
    """Whether what it adds is remembered for itself."""


@dataclass(frozen=True, slots=True, eq=False)
class Ros2Language:
    """All that is declared, by kind."""

    actions: Mapping[str, LaunchAction]
    parts: Mapping[str, Part]
    tags: Mapping[str, Tag]
    """The tags of XML and YAML files, complete with the actions that they may hold."""
    check: Callable[[LaunchFile], tuple[LanguageProblem, ...]]
    """At what of an XML or YAML file launch stops while it reads it."""


@dataclass(frozen=True, slots=True, eq=False)
class Record:
    """What a part of a launch comes to: an include, or what starts nodes."""

    added: Added
    changes: Changes
    events: tuple[Noted, ...]
    names: Names | None
    recorded: Mapping[str, LaunchFile]
    missing_below: tuple[Declared, ...]


class Walk:
    """One launch, or a part of it by itself."""

    def __init__(self, state: State, context: Context, language: Ros2Language) -> None:
        self.state, self.context, self.language = state, context, language
        self.events = Events()
        self.deferred = False
        """Whether what is executed now waits for a timer or another event."""
        self.names: list[Names | None] = [Names()]
        """For each file that is being evaluated the configurations that it and those below it have to do with; None
        where that cannot be told."""
        self.recorded: dict[str, LaunchFile] = {}
        """Python launch files as their last run told them."""
        self.missing_below: list[Declared] = []
        """Required arguments that an include further down does not pass, as the check of one above it saw."""
        self._depth = 0
        self._exhausted = False

    def file(self, place: Place, launch_file: LaunchFile) -> None:
        """Execute one launch file."""
        state, document = self.state, launch_file.document
        state.visited.setdefault(place.file)
        self._note_names(launch_file)
        for problem in document.problems:
            other = MalformedPython if place.is_python else MalformedXml
            kind = _MALFORMED.get(os.path.splitext(place.file)[1], other)
            state.problem(kind(problem.message), place.origin(problem.span))
        for name, span in document.entities:
            state.problem(UnexpandedEntity(name), place.origin(span))
            state.note_unknown(f"&{name};", "entities of a DOCTYPE are not expanded", place.location(span))
        if not place.is_python and catalogued_file(place.file) is None:
            for found in self.language.check(launch_file):
                if not self._is_extension(place, found):
                    state.problem(found.kind, place.origin(found.span))
        if launch_file.root is None:
            span = document.root.tag_span if document.root is not None else Span(0, min(1, len(document.text)))
            tag = document.root.tag if document.root is not None else None
            state.problem(NoLaunchElement(tag), place.origin(span))
            return
        before = len(state.problems)
        self.actions(place, launch_file.root.children)
        if place.partial:
            # What is written in a program need not be what it does.
            state.problems[before:] = (
                problem
                for problem in state.problems[before:]
                if problem.location.file != place.file or isinstance(problem.kind, _SURE_UNRUN)
            )

    def as_run(self, launch_file: LaunchFile, chain: Origin) -> tuple[LaunchFile, PythonRun | None]:
        """A Python launch file as its run tells it; any other is itself."""
        if not launch_file.is_python:
            return launch_file, None
        found, run = recorded(self.state, self.context, launch_file, chain)
        self.recorded[launch_file.path] = found
        return found, run

    def actions(self, place: Place, actions: tuple[Action, ...]) -> None:
        """Execute actions one after the other."""
        performer = Performer(self.state, self.context, place)
        for action in actions:
            known = self.language.actions.get(action.kind)
            if known is None or known.evaluate is None:
                if known is None and action.kind not in self.language.parts and place.is_python:
                    at = place.location(action.head_span)
                    self.state.note_unknown(action.kind, "what it does is not known", at)
                continue
            if place.partial and action.kind in _UNREAD:
                self.any_change(place)
            if self.applies(performer, action):
                error = action.value("error")
                if error is not None:
                    name, _, message = error.text.partition(": ")
                    self.raised(performer, action, name, message)
                elif known.is_part and (key := self._key(place, action)) is not None:
                    self._part(key, performer, action, known)
                else:
                    self._execute(performer, action, known)
            elif any(below.kind == "include" for below in action.walk()):
                self.names[-1] = None  # what it would include may have to do with any argument

    def _execute(self, performer: Performer, action: Action, known: LaunchAction) -> None:
        assert known.evaluate is not None
        place, before = performer.place, len(self.state.nodes)
        known.evaluate(self, performer, action)
        if known.starts_process and len(self.state.nodes) > before:
            self.events.started(place, action)
        if place.is_python:
            self._on_exit(place, action)

    # Parts, which are remembered

    def _key(self, place: Place, action: Action) -> Hashable | None:
        """All that a part depends on beside what it asks for and reads; None for what is evaluated where it is: what
        is not written by itself, and what is too deep for Python's stack."""
        if not self.state.by_parts or place.partial or len(place.chain) > MAX_DEPTH_OF_PARTS:
            return None
        written = place.written(action)
        if written is None:
            return None
        lines, source = place.lines.lines_of(written), place.lines.text[slice(*written)]
        size = len(action.attributes), len(action.children)
        where = self.state.within, place.file, place.chain, self._depth, self.deferred
        return where, action.kind, size, source, written.start - lines[0].start, lines

    def _part(self, key: Hashable, performer: Performer, action: Action, known: LaunchAction) -> None:
        """As `_execute`: what the action added is added again, where it is the same and would be answered alike."""
        make = partial(self._alone, performer.place, action, known)
        record = self.state.files.db.part_answered(key, make, self._look)
        if record is None:
            self._execute(performer, action, known)
            return
        self.state.absorb(record.added, MAX_INCLUDES)
        self.context.change(record.changes)
        self.events.repeat(record.events)
        self._add_names(record.names)
        self.recorded.update(record.recorded)
        self.missing_below += record.missing_below

    def _alone(
        self, place: Place, action: Action, known: LaunchAction
    ) -> tuple[Record | None, Mapping[Question, object]]:
        """What an action adds, and what it asked for of what is before it; None where that has offsets in this text."""
        before = Before(self._look)
        part = Walk(self.state.part(before), self.context.part(before), self.language)
        part.deferred, part._depth = self.deferred, self._depth
        part._execute(Performer(part.state, part.context, place), action, known)
        (names,) = part.names
        record = Record(
            part.state.added(),
            part.context.changes(),
            part.events.noted,
            names,
            part.recorded,
            tuple(part.missing_below),
        )
        return record, before.answers

    def _look(self, question: Question) -> object:
        return self.state.look(question) if question[0] in State.QUESTIONS else self.context.look(question)

    def inside(self, place: Place, actions: tuple[Action, ...]) -> None:
        """Execute actions that another one holds, for which `too_deep` has been asked."""
        self._depth += 1
        self.actions(place, actions)
        self._depth -= 1

    def file_below(self, place: Place, launch_file: LaunchFile) -> Names | None:
        """Execute a file that another one includes; the configurations that it has to do with, if that can be told."""
        self._depth += 1
        self.names.append(Names())
        self.file(place, launch_file)
        below = self.names.pop()
        self._depth -= 1
        self._add_names(below)
        return below

    def _add_names(self, below: Names | None) -> None:
        above = self.names[-1]
        self.names[-1] = None if below is None or above is None else above | below

    def too_deep(self, place: Place, action: Action) -> bool:
        """Whether an action may not hold others or include a file, as there are too many already, which is noted."""
        if self._depth <= MAX_DEPTH and self.state.include_count <= MAX_INCLUDES:
            return False
        if self.state.by_parts:
            raise NotByPartsError
        if not self._exhausted:
            self._exhausted = True
            limit = f"{MAX_DEPTH} levels" if self._depth > MAX_DEPTH else f"{MAX_INCLUDES} includes"
            self.state.problem(NestedTooDeeply(limit), place.origin(action.kind_span))
            at = place.location(action.kind_span)
            self.state.note_unknown(f"<{action.kind}>", f"there are more than {limit}", at)
        return True

    def any_change(self, place: Place) -> None:
        """Note that code may ask lifecycle nodes for transitions that are not known."""
        within = place.chain if catalogued_file(place.file) is not None else ()
        self.state.state_changes.append(StateChange(None, None, None, within))

    def raised(self, performer: Performer, action: Action, error: str, message: str) -> None:
        """Note an exception that launch raises at an action."""
        self.state.problem(PythonException(error, message), performer.place.origin(action.head_span))

    def applies(self, performer: Performer, action: Action) -> bool:
        """Whether an action is executed, by its `if` and `unless` (`launch.conditions`)."""
        for name in _CONDITIONS:
            attribute = action.attribute(name)
            if attribute is not None:
                return self._condition(performer, action, attribute, name)
        return True

    def _condition(self, performer: Performer, action: Action, attribute: ActionAttribute, name: Condition) -> bool:
        """Whether a condition is as it has to be; it is not where it is not known or none."""
        of_branch = action.kind == BRANCH  # that its condition is not known is noted where it stands
        result = Resolved(attribute.value.text, known=False) if of_branch else performer.value(attribute.value)
        span = attribute.value.span
        if performer.state.is_assumed(performer.place.location(action.head_span)):
            return True
        if not result.known:
            at = performer.place.location(span)
            if not of_branch:
                performer.state.note_unknown(f"<{action.kind} {attribute.name}>", "its condition is not known", at)
            if self.may_configure(action):
                performer.context.cannot_follow(at)
            if any(below.kind in _CHANGES_STATES for below in action.walk()):
                self.any_change(performer.place)
            _note_not_taken(performer, action, attribute, name, None)
            return False
        word = result.text.strip().lower()
        if word in ("true", "1", "false", "0"):
            taken = (word in ("true", "1")) == (name == "if")
            if not taken:
                _note_not_taken(performer, action, attribute, name, result.text)
            return taken
        bad = BadValue(action.kind, attribute.name, result.text, "true, false, 1 or 0", ("true", "false"))
        performer.state.problem(bad, performer.place.origin(span))
        return False

    def may_configure(self, action: Action) -> bool:
        """Whether there may be other launch configurations after an action, or after what is below a branch."""
        known = self.language.actions.get(action.kind)
        if action.kind == BRANCH:
            return any(map(self.may_configure, action.children))
        return known is not None and known.configures

    def _note_names(self, launch_file: LaunchFile) -> None:
        found = configurations_of(launch_file)
        partial = found.computed or launch_file.root is None or bool(launch_file.document.problems)
        in_code = names_in_code(launch_file) if calls_own_code(launch_file) else frozenset()
        told = not (partial or launch_file.partial or in_code is None)
        self._add_names(Names(found.declared | found.used, in_code or frozenset()) if told else None)

    def _is_extension(self, place: Place, found: LanguageProblem) -> bool:
        """Whether it is a tag that a package defines; what that does is not known."""
        if not isinstance(found.kind, UnknownElement):
            return False
        tag, parent = found.kind.tag, self.language.tags[found.kind.parent]
        package = (
            exposed_actions(self.state.files, self.state.environment).get(tag) if "node" in parent.children else None
        )
        if package is not None:
            self.state.note_unknown(
                f"<{tag}>", f"what this tag of package '{package}' starts", place.origin(found.span)[-1]
            )
        return package is not None

    def _on_exit(self, place: Place, action: Action) -> None:
        for child in action.children:
            if child.kind == "on_exit":
                self.events.later(place, child.children)


def _note_not_taken(
    performer: Performer, action: Action, attribute: ActionAttribute, condition: Condition, value: str | None
) -> None:
    place = performer.place
    at = place.location(attribute.value.span)
    performer.state.not_taken.append(NotTaken(place.tag(action), condition, value, place.origin(action.head_span), at))


def only_read(walk: Walk, performer: Performer, action: Action) -> None:
    """Actions that start nothing and set nothing that a node sees; their values are read all the same."""
    for attribute in action.attributes:
        if attribute.name not in ("if", "unless"):
            performer.value(attribute.value)


def is_set(action: Action, name: str, *, default: bool) -> bool:
    """A boolean attribute; a text that may have substitutions counts as true, as it does for launch."""
    value = action.value(name)
    if value is None:
        return default
    if value.typed is not None:
        return bool(value.typed.value)
    if is_from_yaml(action):
        return bool(value.text)
    try:
        return bool(coerce(value.text, "bool", or_text=True))
    except NotOfTypeError:
        return default
