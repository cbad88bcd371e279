"""What `launch.LaunchContext` holds while a launch is evaluated: configurations, environment, pushed ROS settings.

Includes do not scope any of it, groups do. `push` copies as launch does, one level deep: the lists of remaps and of
parameters are the same ones afterwards if they were there before, so a group can add to what is around it.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from copy import copy
from dataclasses import field
from typing import Any, NamedTuple, cast

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.exact import exact
from preflight_analysis.documents.span import Location, Origin
from preflight_analysis.environment.variables import copied
from preflight_analysis.evaluation.before import Before, Question
from preflight_analysis.evaluation.resolved import Resolved


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


@exact("value")
class PushedParam(NamedTuple):
    """A parameter of `<set_parameter>`, or the file of `<set_parameters_from_file>`, whose `name` is None."""

    name: str | None
    value: object
    origin: Origin


@dataclass(slots=True)
class _Scope:
    """What `push_configurations` saves and `pop_configurations` brings back."""

    configurations: dict[str, Configuration] = field(default_factory=dict)
    namespace: Resolved | None = None
    remaps: list[PushedRemap] | None = None
    params: list[PushedParam] | None = None
    not_followed: Location | None = None

    def copy(self) -> _Scope:
        """As launch copies it."""
        return _Scope(dict(self.configurations), self.namespace, self.remaps, self.params, self.not_followed)


class NotByPartsError(Exception):
    """Something depends on the whole launch before it: no part of that can be evaluated by itself."""


class _Done(NamedTuple):
    """Something that was done in a context. `into`: the list that it was added to."""

    operation: Callable[..., None]
    arguments: tuple[Any, ...]
    into: list[Any] | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Changes:
    """What a part of a launch does in its context, to be done again."""

    done: tuple[_Done, ...]
    variables: tuple[_Done, ...]
    declared: Mapping[tuple[str, str], Location]
    launch_file: str | None


class Context:
    """The state of one launch, or of a part of it by itself: that begins with what is `before` it and notes what it
    reads of that."""

    def __init__(self, environment: Mapping[str, str]) -> None:
        self.initial_environment = environment
        self.round: dict[str, str] = {}
        """What the variables of the loops around are in this round."""
        self._at_first = dict(environment)
        self._environment = copied(environment)
        self._scope = _Scope()
        self._launch_file = ""
        self._is_in_another_file = False
        self._declared: dict[tuple[str, str], Location] = {}
        self._scopes: list[tuple[_Scope, int]] = []
        """Those around, and how much had been done when each was left."""
        self._environments: list[tuple[dict[str, str], int]] = []
        self._done: list[_Done] = []
        self._variables_done: list[_Done] = []
        self._before: Before | None = None
        self._configured_before: Mapping[str, Configuration] = {}

    # Parts

    def part(self, before: Before) -> Context:
        """The context of a part that comes next. This one is not changed, and must not be before that has ended."""
        part = Context.__new__(Context)
        part.initial_environment, part._at_first = self.initial_environment, self._at_first
        scope = self._scope.copy()
        scope.remaps = [*scope.remaps] if scope.remaps is not None else None
        scope.params = [*scope.params] if scope.params is not None else None
        part._scope, part._environment, part._launch_file = scope, copy(self._environment), self._launch_file
        part._is_in_another_file = False
        part.round, part._declared, part._scopes, part._environments = {}, {}, [], []
        part._done, part._variables_done = [], []
        part._before, part._configured_before = before, self._scope.configurations
        return part

    def changes(self) -> Changes:
        """What this part has done. Raises `NotByPartsError` where a scope that it began goes on after it."""
        if self._scopes or self._environments:
            raise NotByPartsError
        launch_file = self._launch_file if self._is_in_another_file else None
        return Changes(tuple(self._done), tuple(self._variables_done), self._declared, launch_file)

    def change(self, changes: Changes) -> None:
        """Do what a part has done."""
        for done in changes.done:
            self._do(done.operation, *done.arguments)
        for done in changes.variables:
            self._do_to_variables(done.operation, *done.arguments)
        self._declared.update(changes.declared)
        if changes.launch_file is not None:
            self.launch_file = changes.launch_file

    def look(self, question: Question) -> object:
        """What is answered to those that come after this."""
        kind, *arguments = question
        found: object = _ANSWERS[cast(str, kind)](self, *arguments)
        return found

    def _ask(self, *question: Hashable) -> Any:
        return self._before.ask(*question) if self._before is not None else None

    # Scopes

    def push_configurations(self) -> None:
        """Begin a scope of configurations."""
        self._scopes.append((self._scope.copy(), len(self._done)))

    def pop_configurations(self) -> None:
        """End it; IndexError where none was begun."""
        if not self._scopes and self._before is not None:
            raise NotByPartsError
        self._scope, mark = self._scopes.pop()
        lists = self._scope.remaps, self._scope.params
        # What was added to a list from outside of the scope stays there.
        self._done[mark:] = [e for e in self._done[mark:] if e.into is not None and any(e.into is li for li in lists)]

    def push_environment(self) -> None:
        """Begin a scope of variables."""
        self._environments.append((copy(self._environment), len(self._variables_done)))

    def pop_environment(self) -> None:
        """End it; IndexError where none was begun."""
        if not self._environments and self._before is not None:
            raise NotByPartsError
        self._environment, mark = self._environments.pop()
        del self._variables_done[mark:]

    # Configurations

    def get(self, name: str) -> Configuration | None:
        """A launch configuration."""
        if name == "ros_namespace" and self.namespace is not None:
            return Configuration(self.namespace, None)
        found = self._scope.configurations.get(name)
        if found is self._configured_before.get(name):
            self._ask("configuration", name)
        return found

    @property
    def names(self) -> tuple[str, ...]:
        """Those of all launch configurations, sorted."""
        self._ask("names")
        return tuple(sorted(self._scope.configurations))

    @property
    def configurations(self) -> Mapping[str, Configuration]:
        """All launch configurations."""
        self._ask("configurations")
        return self._scope.configurations

    def set(self, name: str, value: Resolved, origin: Origin | None) -> None:
        """Set a launch configuration."""
        self._do(Context._set, name, Configuration(value, origin))

    def unset(self, name: str) -> None:
        """Forget a launch configuration."""
        self._do(Context._unset, name)

    def reset_configurations(self) -> None:
        """Forget all that was configured."""
        self._do(Context._reset)

    @property
    def not_followed(self) -> Location | None:
        """The first include, or whatever else, that could not be evaluated: it may set any configuration."""
        self._ask("not followed")
        return self._scope.not_followed

    def cannot_follow(self, at: Location) -> None:
        """From here on there may be configurations that nobody knows of."""
        self._do(Context._cannot_follow, at)

    def declared(self, file: str, name: str) -> Location | None:
        """Where a file declares or sets a configuration: the latest place."""
        found = self._declared.get((file, name))
        return found if found is not None else self._ask("declared", file, name)

    def declare(self, name: str, at: Location) -> None:
        """Its file declares or sets a configuration here."""
        self._declared[at.file, name] = at

    # What nodes get

    @property
    def namespace(self) -> Resolved | None:
        """The one that was pushed."""
        self._ask("namespace")
        return self._scope.namespace

    def push_namespace(self, namespace: Resolved) -> None:
        """Nodes of the scope come below it from now on."""
        self._do(Context._push_namespace, namespace)

    @property
    def remaps(self) -> tuple[PushedRemap, ...]:
        """Those that were pushed."""
        self._ask("remaps")
        return tuple(self._scope.remaps or ())

    def push_remap(self, remap: PushedRemap) -> None:
        """Nodes of the scope have it from now on."""
        self._ask("has remaps")
        self._do(Context._push_remap, remap)

    @property
    def params(self) -> tuple[PushedParam, ...]:
        """Those that were pushed."""
        self._ask("params")
        return tuple(self._scope.params or ())

    def push_param(self, param: PushedParam) -> None:
        """Nodes of the scope have it from now on."""
        self._ask("has params")
        self._do(Context._push_param, param)

    # Variables: what processes and substitutions see. launch scopes them by a stack of their own.

    def variable(self, name: str) -> str | None:
        """An environment variable."""
        self._ask("variable", name)
        return self._environment.get(name)

    def set_variable(self, name: str, value: str) -> None:
        """Set it until the scope ends."""
        self._do_to_variables(Context._set_variable, name, value)

    def unset_variable(self, name: str) -> None:
        """Remove it until the scope ends."""
        self._do_to_variables(Context._unset_variable, name)

    def reset_environment(self) -> None:
        """The variables are the first ones again."""
        self._do_to_variables(Context._reset_environment)

    def changed_variables(self) -> dict[str, str]:
        """The variables that are set, or others than at first."""
        self._ask("changed variables")
        now, first = self._environment, self._at_first
        return {} if now == first else {k: v for k, v in now.items() if first.get(k) != v}

    # What is around

    @property
    def launch_file(self) -> str:
        """The launch file that was included last: that of `$(dirname)`, also after the include."""
        if not self._is_in_another_file:
            self._ask("launch file")
        return self._launch_file

    @launch_file.setter
    def launch_file(self, path: str) -> None:
        self._launch_file, self._is_in_another_file = path, True

    def of_round(self, name: str) -> str | None:
        """A variable of the loops around."""
        found: str | None = self.round.get(name)
        return found if found is not None else self._ask("round", name)

    # What is done, and noted to be done again

    def _do(self, operation: Callable[..., None], *arguments: Any) -> None:
        operation(self, *arguments)
        into: list[Any] | None = None
        if operation in (Context._push_remap, Context._push_param):
            into = self._scope.remaps if operation is Context._push_remap else self._scope.params
        self._done.append(_Done(operation, arguments, into))

    def _do_to_variables(self, operation: Callable[..., None], *arguments: Any) -> None:
        operation(self, *arguments)
        self._variables_done.append(_Done(operation, arguments))

    def _set(self, name: str, configuration: Configuration) -> None:
        self._scope.configurations[name] = configuration

    def _unset(self, name: str) -> None:
        self._scope.configurations.pop(name, None)

    def _reset(self) -> None:
        self._scope = _Scope()

    def _cannot_follow(self, at: Location) -> None:
        self._scope.not_followed = self._scope.not_followed or at

    def _push_namespace(self, namespace: Resolved) -> None:
        self._scope.namespace = namespace

    def _push_remap(self, remap: PushedRemap) -> None:
        if self._scope.remaps is None:
            self._scope.remaps = []
        self._scope.remaps.append(remap)

    def _push_param(self, param: PushedParam) -> None:
        if self._scope.params is None:
            self._scope.params = []
        self._scope.params.append(param)

    def _set_variable(self, name: str, value: str) -> None:
        self._environment[name] = value

    def _unset_variable(self, name: str) -> None:
        self._environment.pop(name, None)

    def _reset_environment(self) -> None:
        self._environment = copied(self.initial_environment)


_ANSWERS: Mapping[str, Callable[..., object]] = {
    "configuration": Context.get,
    "names": lambda context: context.names,
    "configurations": lambda context: dict(context.configurations),
    "not followed": lambda context: context.not_followed,
    "declared": Context.declared,
    "namespace": lambda context: context.namespace,
    "remaps": lambda context: context.remaps,
    "has remaps": lambda context: context._ask("has remaps") or context._scope.remaps is not None,
    "params": lambda context: context.params,
    "has params": lambda context: context._ask("has params") or context._scope.params is not None,
    "variable": Context.variable,
    "changed variables": Context.changed_variables,
    "launch file": lambda context: context.launch_file,
    "round": Context.of_round,
}
