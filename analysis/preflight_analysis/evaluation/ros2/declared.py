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
from preflight_analysis.launch.model import Action, LaunchFile

MAX_FILES = 500
PASSED = {"include": "arg", "inline": "arg_passed"}
"""Actions that pass arguments on, with the kind of child that does. An `inline` is a launch description by itself, in
which an `arg` declares one."""

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
    if launch_file.root is not None:
        reader.read(launch_file, launch_file.root.children, None)
    ways = {id(includes): includes for _, includes in reader.found if includes}
    passed = {way: [name for include in includes for name in passed_names(include)] for way, includes in ways.items()}
    for declared, includes in reader.found:
        declared.passed = passed.get(id(includes), [])
    return [declared for declared, _ in reader.found]


def passed_names(include: Action) -> list[str]:
    """The names of the arguments that an include passes, those that are plain text."""
    values = (child.value("name") for child in include.children if child.kind == PASSED[include.kind])
    return [value.text for value in values if value is not None and value.is_literal]


class _Reader:
    def __init__(self, included: Included) -> None:
        self._included = included
        self._names: set[str] = set()
        self._files: list[tuple[str, Location]] = []
        self.found: list[tuple[Declared, list[Action] | None]] = []

    def read(
        self, file: LaunchFile, actions: Iterable[Action], includes: list[Action] | None, *, conditional: bool = False
    ) -> None:
        """As launch goes through them: the list of includes is shared between siblings below an include."""
        for action in actions:
            if action.kind == "arg":
                self._declare(file, action, conditional, includes)
            if action.kind == "reset":
                return
            below = includes
            if action.kind in PASSED:
                if below is None:
                    below = []
                below.append(action)
            has_condition = action.attribute("if") is not None or action.attribute("unless") is not None
            deferred = action.kind in ("timer", "ros_timer")
            for inner_file, inner in self._sub(file, action):
                self.read(inner_file, inner, below, conditional=has_condition or deferred)
                if action.kind == "include":
                    self._files.pop()

    def _declare(self, file: LaunchFile, action: Action, conditional: bool, includes: list[Action] | None) -> None:
        value = action.value("name")
        if value is None or value.text in self._names:
            return
        self._names.add(value.text)
        if conditional or any(action.attribute(name) is not None for name in ("default", "if", "unless")):
            return
        include = self._files[-1][1] if self._files else None
        self.found.append((Declared(value.text, file.document.location(action.head_span), include), includes))

    def _sub(self, file: LaunchFile, action: Action) -> list[tuple[LaunchFile, tuple[Action, ...]]]:
        if action.kind == "group":
            forwarding = action.value("forwarding")
            if forwarding is not None and forwarding.text.lower() in ("false", "0"):
                return []  # launch resets the configurations first, and looks no further
            return [(file, action.children)]
        if action.kind in ("timer", "ros_timer", "inline"):
            return [(file, action.children)]
        if action.kind == "include":
            found = self._included(file, action)
            if found is None or found.root is None or len(self._files) > MAX_FILES:
                return []
            if any(found.path == path for path, _ in self._files):
                return []
            attribute = action.attribute("file")
            span = attribute.value.span if attribute is not None else action.kind_span
            self._files.append((found.path, file.document.location(span)))
            return [(found, found.root.children)]
        return []
