"""The other ones of `launch.actions`. `preflight_serialize` says what the host gets of each."""

from __future__ import annotations

import collections.abc
import importlib
from typing import Any, Iterable, Optional

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
    def __init__(
        self,
        actions: Iterable[Any],
        *,
        scoped: bool = True,
        forwarding: bool = True,
        launch_configurations: Optional[dict[Any, Any]] = None,
        **left_over_kwargs: Any,
    ) -> None:
        super().__init__(**left_over_kwargs)
        self.__actions = actions
        self.__scoped, self.__forwarding = scoped, forwarding
        self.__kept = dict(launch_configurations or {})

    def get_sub_entities(self) -> list[Any]:
        self.__actions = list(self.__actions)
        return self.__actions

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "group"
        t.attribute("scoped", bool(self.__scoped))
        t.attribute("forwarding", bool(self.__forwarding))
        for name, value in self.__kept.items():
            t.child("keep", name=normalize_to_list_of_substitutions(name), value=value)
        t.entities(self.get_sub_entities())


class Log(Action):
    """Of a Rolling newer than Kilted, where what logs at a level is one."""

    def __init__(self, *, msg: Any, level: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__msg = normalize_to_list_of_substitutions(msg)
        self.__level = normalize_to_list_of_substitutions(level)

    @property
    def msg(self) -> list[Substitution]:
        return self.__msg

    @property
    def level(self) -> list[Substitution]:
        return self.__level

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "log"
        t.attribute("message", self.__msg)
        t.attribute("level", self.__level)


class LogInfo(Log):
    def __init__(self, *, msg: Any, **kwargs: Any) -> None:
        super().__init__(msg=msg, **{"level": "INFO", **kwargs})


class LogDebug(LogInfo):
    pass


class LogWarning(LogInfo):
    pass


class LogError(LogInfo):
    pass


class TimerAction(Action):
    def __init__(self, *, period: Any, actions: Iterable[Any], cancel_on_shutdown: Any = True, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        types = (str, Substitution, collections.abc.Iterable, float, int)
        ensure_argument_type(period, types, "period", "TimerAction")
        ensure_argument_type(actions, collections.abc.Iterable, "actions", "TimerAction")
        self.__period, self.__actions = period, actions

    @property
    def period(self) -> Any:
        return self.__period

    @property
    def actions(self) -> Any:
        return self.__actions

    def cancel(self) -> None:
        return None

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "timer"
        period = self.__period
        t.attribute("period", str(period) if isinstance(period, (int, float)) else period)
        t.entities(self.__actions)


class EmitEvent(Action):
    def __init__(self, *, event: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__event = event

    @property
    def event(self) -> Any:
        return self.__event

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "emit_event"
        t.attribute("event", type(self.__event).__name__)
        for name, value in getattr(self.__event, "preflight_asked", {}).items():
            t.attribute(name, value)


class Shutdown(EmitEvent):
    def __init__(self, *, reason: Any = "reason not given", **kwargs: Any) -> None:
        super().__init__(event=None, **kwargs)
        self.__reason = reason

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "shutdown"
        t.attribute("reason", self.__reason)


class RegisterEventHandler(Action):
    def __init__(self, event_handler: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__event_handler = event_handler

    @property
    def event_handler(self) -> Any:
        return self.__event_handler

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "event_handler"
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
    def __init__(self, event_handler: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__event_handler = event_handler

    @property
    def event_handler(self) -> Any:
        return self.__event_handler

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "unregister_event_handler"
        t.attribute("handler", str(self.__event_handler.preflight_id))


class OpaqueFunction(Action):
    def __init__(
        self,
        *,
        function: Any,
        args: Optional[Iterable[Any]] = None,
        kwargs: Optional[dict[str, Any]] = None,
        **left_over_kwargs: Any,
    ) -> None:
        super().__init__(**left_over_kwargs)
        if not callable(function):
            raise TypeError(f"OpaqueFunction expected a callable for 'function' but got '{function}'")
        self.__function = function
        self.__args, self.__kwargs = list(args or ()), dict(kwargs or {})

    def execute(self, context: LaunchContext) -> Any:
        return self.__function(context, *self.__args, **self.__kwargs)

    def preflight_serialize(self, t: Any) -> None:
        t.opaque()


class ForLoop(Action):
    """Calls its function with 0, 1, ... up to a length. Of a launch newer than 3.7, as `ForEach`."""

    def __init__(self, length: Any, *, function: Any, name: Optional[str] = None, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name = name
        self.__length, self.__function = normalize_to_list_of_substitutions(length), function

    def execute(self, context: LaunchContext) -> Any:
        length = int(perform_substitutions(context, self.__length))
        return [entity for i in range(length) for entity in self.__function(i) or ()]

    def preflight_serialize(self, t: Any) -> None:
        t.opaque()


class ForEach(Action):
    """Calls its function with each of the sets of values of a text: `{name: 'a', id: 1};{name: 'b', id: 2}`."""

    def __init__(self, input_values: Any, *, function: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__values, self.__function = normalize_to_list_of_substitutions(input_values), function

    def execute(self, context: LaunchContext) -> Any:
        yaml = importlib.import_module("yaml")  # only an interpreter with ROS must have it
        sets = [yaml.safe_load(each) for each in perform_substitutions(context, self.__values).strip("; ").split(";")]
        return [entity for each in sets if each for entity in self.__function(**each) or ()]

    def preflight_serialize(self, t: Any) -> None:
        t.opaque()


class OpaqueCoroutine(Action):
    def __init__(
        self, *, coroutine: Any, args: Any = None, kwargs: Any = None, ignore_context: bool = False, **left: Any
    ) -> None:
        super().__init__(**left)

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "opaque_coroutine"
