"""Which arguments a launch file asks for, as far as that shows without evaluating it.

`launch.LaunchDescription.get_launch_arguments_with_include_launch_description_actions`, by which an include checks that
all required arguments are given before anything of the file is executed. It looks into groups and into those includes
whose file is known without any launch configuration.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import field

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.ros2.python_branches import BRANCH
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import Action, LaunchFile

MAX_FILES = 500
PASSED = {"include": "arg", "inline": "arg_passed"}
"""Actions that pass arguments on, with the kind of child that does. An `inline` is a launch description by itself, in
which an `arg` declares one."""
_DEFERRED = ("timer", "ros_timer")
_HOLDING = ("group", "inline", BRANCH, *_DEFERRED)

Included = Callable[[LaunchFile, Action], LaunchFile | None]
"""The file that an include of a launch file leads to without any configuration."""


@dataclass(slots=True)
class Declared:
    """An `<arg>` of the file or of one below it that has no default and is under no condition. `passed` are the names
    that the includes on the way pass, `include` is the `file` of the one that leads to it, None for an argument of the
    file itself."""

    name: str
    location: Location
    include: Location | None
    passed: list[str] = field(default_factory=list)


def required_arguments(launch_file: LaunchFile, included: Included) -> list[Declared]:
    """The arguments in the order in which they are met, each name once: one that has a default where it is met first
    is not required."""
    reader = _Reader(included)
    reader.read(launch_file, _steps_of(launch_file), None)
    ways = {id(includes): includes for _, includes in reader.found if includes}
    passed = {way: [name for include in includes for name in include.passed] for way, includes in ways.items()}
    for declared, includes in reader.found:
        declared.passed = passed.get(id(includes), [])
    return [declared for declared, _ in reader.found]


@dataclass(frozen=True, slots=True)
class _Step:
    """An action that declares an argument, or that others may lie below."""

    action: Action
    has_condition: bool
    passed: tuple[str, ...]
    below: tuple[_Step, ...]

    @property
    def kind(self) -> str:
        """That of the action."""
        return self.action.kind


@derived
def _steps_of(launch_file: LaunchFile) -> tuple[_Step, ...]:
    """A file is gone through once for each file above it: what of it counts is looked for once."""
    return _steps(launch_file.root.children) if launch_file.root is not None else ()


def _steps(actions: Iterable[Action]) -> tuple[_Step, ...]:
    found: list[_Step] = []
    for action in actions:
        if action.kind == "reset":
            break  # launch looks no further
        has_condition = action.kind == BRANCH or any(action.attribute(name) is not None for name in ("if", "unless"))
        if action.kind in _HOLDING:
            below = _steps(action.children) if _is_looked_into(action) else ()
            found.append(_Step(action, has_condition, _passed_names(action), below))
        elif action.kind in ("arg", "include"):
            found.append(_Step(action, has_condition, _passed_names(action), ()))
    return tuple(found)


def _is_looked_into(action: Action) -> bool:
    forwarding = action.value("forwarding") if action.kind == "group" else None
    # Without, launch resets the configurations first.
    return forwarding is None or forwarding.text.lower() not in ("false", "0")


def _passed_names(action: Action) -> tuple[str, ...]:
    """The names of the arguments that an include passes, those that are plain text."""
    values = (child.value("name") for child in action.children if child.kind == PASSED.get(action.kind))
    return tuple(value.text for value in values if value is not None and value.is_literal)


class _Reader:
    def __init__(self, included: Included) -> None:
        self._included = included
        self._names: set[str] = set()
        self._files: list[tuple[str, Location]] = []
        self.found: list[tuple[Declared, list[_Step] | None]] = []

    def read(
        self, file: LaunchFile, steps: Iterable[_Step], includes: list[_Step] | None, *, conditional: bool = False
    ) -> None:
        """As launch goes through them: the list of includes is shared between siblings below an include."""
        for step in steps:
            if step.kind == "arg":
                self._declare(file, step, conditional, includes)
                continue
            below = includes
            if step.kind in PASSED:
                if below is None:
                    below = []
                below.append(step)
            conditional_below = step.has_condition or step.kind in _DEFERRED
            if step.kind != "include":
                self.read(file, step.below, below, conditional=conditional_below)
            elif (found := self._below(file, step.action)) is not None:
                self.read(found, _steps_of(found), below, conditional=conditional_below)
                self._files.pop()

    def _declare(self, file: LaunchFile, step: _Step, conditional: bool, includes: list[_Step] | None) -> None:
        value = step.action.value("name")
        if value is None or value.text in self._names:
            return
        self._names.add(value.text)
        if conditional or step.has_condition or step.action.attribute("default") is not None:
            return
        include = self._files[-1][1] if self._files else None
        self.found.append((Declared(value.text, file.document.location(step.action.head_span), include), includes))

    def _below(self, file: LaunchFile, action: Action) -> LaunchFile | None:
        """The file that an include leads to, which is being read from here on."""
        found = self._included(file, action)
        if found is None or found.root is None or len(self._files) > MAX_FILES:
            return None
        if any(found.path == path for path, _ in self._files):
            return None
        attribute = action.attribute("file")
        span = attribute.value.span if attribute is not None else action.kind_span
        self._files.append((found.path, file.document.location(span)))
        return found
