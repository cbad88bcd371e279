"""What `launch.LaunchContext` holds while a launch is evaluated: configurations, environment, pushed ROS settings.

Includes do not scope any of it, groups do. `push` copies as launch does, one level deep: the lists of remaps and of
parameters are the same ones afterwards if they were there before, so a group can add to what is around it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from copy import copy
from dataclasses import dataclass, field
from typing import Any

from preflight_analysis.documents.span import LineIndex, Location, Origin, Span
from preflight_analysis.evaluation.resolved import Resolved
from preflight_analysis.evaluation.tree import Tag
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.python_classes import PythonClasses
from preflight_analysis.launch.python_source import PythonSource
from preflight_analysis.launch.read import PYTHON_SUFFIX, YAML_SUFFIXES

_SAID_ELSEWHERE = re.compile(r"\*[\w-]|!")
"""In YAML: an alias, or a tag, which a directive may define."""


@dataclass(frozen=True, slots=True)
class Configuration:
    """A launch configuration: its text, not known where something that it depends on is missing, and who set it
    (None: the command line)."""

    value: Resolved
    origin: Origin | None


@dataclass(frozen=True, slots=True)
class PushedRemap:
    """A rule of `<set_remap>`."""

    source: Resolved
    target: Resolved
    origin: Origin


@dataclass(frozen=True, slots=True)
class PushedParam:
    """A parameter of `<set_parameter>`, or the file of `<set_parameters_from_file>`, whose `name` is None."""

    name: str | None
    value: object
    origin: Origin


@dataclass(slots=True)
class Scope:
    """What `push_configurations` saves and `pop_configurations` brings back."""

    configurations: dict[str, Configuration] = field(default_factory=dict)
    namespace: Resolved | None = None
    remaps: list[PushedRemap] | None = None
    params: list[PushedParam] | None = None
    not_followed: Location | None = None
    """The first include, or whatever else, that could not be evaluated: it may set any configuration."""

    def copy(self) -> Scope:
        """As launch copies it."""
        return Scope(dict(self.configurations), self.namespace, self.remaps, self.params, self.not_followed)


@dataclass(frozen=True, slots=True, eq=False)
class PythonRun:
    """A run of a Python launch file: its text, the variables that differ from those of the launch, and which of its
    functions and substitutions were called, with what was configured then (`evaluation/ros2/python_runs.py`)."""

    file: str
    text: str
    variables: Mapping[str, str]
    calls: tuple[Mapping[str, Any], ...]
    source: PythonSource
    files: Mapping[str, str] = field(default_factory=dict)
    """Texts that earlier runs wrote and that the configurations name."""
    given: Mapping[str, str] = field(default_factory=dict)
    """The variables of the user's environment that the text names: the sandbox hands on no others."""
    packages: Mapping[str, str] = field(default_factory=dict)
    """The folders of packages that are others for the launch than for most."""
    replaced: bool = False
    """Whether the text is another one by now, and this the last run that went well: nothing is asked for it again."""


def _copied(variables: Mapping[str, str]) -> dict[str, str]:
    """A copy that tells whoever notes which ones are read what the first one does."""
    return copy(variables) if isinstance(variables, dict) else dict(variables)


class Context:
    """The state of one launch."""

    def __init__(self, environment: Mapping[str, str], python: PythonClasses) -> None:
        self.python = python
        """What the answers of runs are read by."""
        self.scope = Scope()
        self.initial_environment = environment
        self._at_first = dict(environment)
        self.environment = _copied(environment)
        """What processes and substitutions see: launch scopes it by a stack of its own."""
        self.round: dict[str, str] = {}
        """What the variables of the loops around are in this round."""
        self.launch_file = ""
        """The launch file that was included last: that of `$(dirname)`, also after the include."""
        self._scopes: list[Scope] = []
        self._environments: list[dict[str, str]] = []
        self.declared: dict[tuple[str, str], Location] = {}
        """Where each file declares or sets a configuration, by file and name: the latest place."""

    def push_configurations(self) -> None:
        """Begin a scope of configurations."""
        self._scopes.append(self.scope.copy())

    def pop_configurations(self) -> None:
        """End it; IndexError where none was begun."""
        self.scope = self._scopes.pop()

    def push_environment(self) -> None:
        """Begin a scope of variables."""
        self._environments.append(copy(self.environment))

    def pop_environment(self) -> None:
        """End it; IndexError where none was begun."""
        self.environment = self._environments.pop()

    def reset_configurations(self) -> None:
        """Forget all that was configured."""
        self.scope = Scope()

    def reset_environment(self) -> None:
        """The variables are the first ones again."""
        self.environment = _copied(self.initial_environment)

    def changed_variables(self) -> dict[str, str]:
        """The variables that are set, or others than at first."""
        first = self._at_first
        return {} if self.environment == first else {k: v for k, v in self.environment.items() if first.get(k) != v}

    def get(self, name: str) -> Configuration | None:
        """A launch configuration."""
        if name == "ros_namespace" and self.scope.namespace is not None:
            return Configuration(self.scope.namespace, None)
        return self.scope.configurations.get(name)

    def cannot_follow(self, at: Location) -> None:
        """From here on there may be configurations that nobody knows of."""
        self.scope.not_followed = self.scope.not_followed or at

    def set(self, name: str, value: Resolved, origin: Origin | None) -> None:
        """Set a launch configuration."""
        self.scope.configurations[name] = Configuration(value, origin)


@dataclass(frozen=True, slots=True)
class Place:
    """The launch file that is evaluated, and the include tags that led to it, outermost first."""

    file: str
    lines: LineIndex
    """Those of the file."""
    chain: Origin
    run: PythonRun | None = None
    """Where the file is a Python program: the run that told its actions."""
    partial: bool = False
    """Whether it is one that was not run: only what is written out is known of it."""

    def location(self, span: Span) -> Location:
        """A place in the file."""
        return self.lines.location(self.file, span)

    def origin(self, span: Span) -> Origin:
        """The origin of a place in the file."""
        return (*self.chain, self.location(span))

    def tag(self, action: Action) -> Tag:
        """The tag of a node."""
        written = self.written(action)
        source = self.lines.text[slice(*written)] if written is not None else None
        return Tag(action, self.location(action.head_span), source)

    def written(self, action: Action) -> Span | None:
        """The text that says all of an action. None where there is no such text: in Python there are variables, in
        YAML aliases and tags."""
        if self.file.endswith(PYTHON_SUFFIX):
            return None
        if not self.file.endswith(YAML_SUFFIXES):
            return action.span
        start = min((action.span.start, *(comment.span.start for comment in action.comments)))
        is_all = _SAID_ELSEWHERE.search(self.lines.text, start, action.span.end) is None
        return Span(start, action.span.end) if is_all else None
