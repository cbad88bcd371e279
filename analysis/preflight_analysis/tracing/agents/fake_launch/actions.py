"""The other ones of `launch.actions`. `preflight_serialize` says what the host gets of each."""

from __future__ import annotations

import collections.abc
import importlib
from typing import Any

from .base import (
    Action,
    LaunchContext,
    Substitution,
    ensure_argument_type,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from .events import OnActionEventBase, OnProcessStart


class GroupAction(Action):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(**left)
        self.__actions = given.actions
        self.__scoped, self.__forwarding = given.scoped, given.forwarding
        self.__kept = dict(given.launch_configurations or {})

    def get_sub_entities(self) -> list[Any]:
        self.__actions = entities = list(self.__actions)
        return entities

    def preflight_serialize(self, t: Any) -> None:
        t.attribute("scoped", bool(self.__scoped))
        t.attribute("forwarding", bool(self.__forwarding))
        for name, value in self.__kept.items():
            t.child("keep", name=normalize_to_list_of_substitutions(name), value=value)
        t.entities(self.get_sub_entities())


class Log(Action):
    """Of a Rolling newer than Kilted, where what logs at a level is one."""


class LogInfo(Log):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(msg=given.msg, **{"level": "INFO", **left})


class TimerAction(Action):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(**left)
        types = (str, Substitution, collections.abc.Iterable, float, int)
        ensure_argument_type(given.period, types, "period", "TimerAction")
        ensure_argument_type(given.actions, collections.abc.Iterable, "actions", "TimerAction")
        self.__period, self.__actions = given.period, given.actions

    @property
    def period(self) -> Any:
        return self.__period

    @property
    def actions(self) -> Any:
        return self.__actions

    def cancel(self) -> None:
        return None

    def preflight_serialize(self, t: Any) -> None:
        period = self.__period
        t.attribute("period", str(period) if isinstance(period, (int, float)) else period)
        t.entities(self.__actions)


class EmitEvent(Action):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(**left)
        self.__event = given.event

    @property
    def event(self) -> Any:
        return self.__event

    def preflight_serialize(self, t: Any) -> None:
        t.attribute("event", type(self.__event).__name__)
        for name, value in getattr(self.__event, "preflight_asked", {}).items():
            t.attribute(name, value)


class Shutdown(EmitEvent):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(event=None, **left)
        self.__reason = given.reason

    def preflight_serialize(self, t: Any) -> None:
        t.attribute("reason", self.__reason)


class RegisterEventHandler(Action):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(**left)
        self.__event_handler = given.event_handler

    @property
    def event_handler(self) -> Any:
        return self.__event_handler

    def preflight_serialize(self, t: Any) -> None:
        handler = self.__event_handler
        t.attribute("event", type(handler).__name__)
        t.attribute("handler", str(handler.preflight_id))
        if isinstance(handler, OnProcessStart) and not callable(handler.preflight_target):
            # The number of the process, nothing for all of them.
            target = handler.preflight_target
            t.attribute("starts", "" if target is None else str(target.preflight_id))
        for entity in getattr(handler, "preflight_entities", ()):
            t.entities([entity])
        if isinstance(handler, OnActionEventBase) and handler.preflight_function is not None:
            t.child("function")


class UnregisterEventHandler(Action):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(**left)
        self.__event_handler = given.event_handler

    @property
    def event_handler(self) -> Any:
        return self.__event_handler

    def preflight_serialize(self, t: Any) -> None:
        t.attribute("handler", str(self.__event_handler.preflight_id))


class OpaqueFunction(Action):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(**left)
        if not callable(given.function):
            raise TypeError(f"OpaqueFunction expected a callable for 'function' but got '{given.function}'")
        self.__function = given.function
        self.__args, self.__kwargs = list(given.args or ()), dict(given.kwargs or {})

    def execute(self, context: LaunchContext) -> Any:
        return self.__function(context, *self.__args, **self.__kwargs)


class ForLoop(Action):
    """Calls its function with 0, 1, ... up to a length. Of a launch newer than 3.7, as `ForEach`."""

    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(**left)
        self.name = given.name
        self.__length, self.__function = normalize_to_list_of_substitutions(given.length), given.function

    def execute(self, context: LaunchContext) -> Any:
        length = int(perform_substitutions(context, self.__length))
        return [entity for i in range(length) for entity in self.__function(i) or ()]


class ForEach(Action):
    """Calls its function with each of the sets of values of a text: `{name: 'a', id: 1};{name: 'b', id: 2}`."""

    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(**left)
        self.__values, self.__function = normalize_to_list_of_substitutions(given.input_values), given.function

    def execute(self, context: LaunchContext) -> Any:
        yaml = importlib.import_module("yaml")  # only an interpreter with ROS must have it
        sets = [yaml.safe_load(each) for each in perform_substitutions(context, self.__values).strip("; ").split(";")]
        return [entity for each in sets if each for entity in self.__function(**each) or ()]


class OpaqueCoroutine(Action):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(**left)

    def preflight_serialize(self, t: Any) -> None:
        """What it does is not told."""
