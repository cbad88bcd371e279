"""`launch.actions` and `launch.launch_description_sources`. `preflight_serialize` says what the host gets of each."""

from __future__ import annotations

import collections.abc
import importlib
import os
from typing import Any, Iterable, Optional

from .base import (
    Action,
    LaunchContext,
    LaunchDescription,
    Made,
    Substitution,
    ensure_argument_type,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from .events import OnActionEventBase, OnProcessStart


class LaunchDescriptionSource(Made):
    kind = ""

    def __init__(
        self,
        launch_description: Optional[LaunchDescription] = None,
        location: Any = "<string>",
        method: str = "unspecified mechanism from a script",
    ) -> None:
        self.preflight_description = launch_description
        self.preflight_location = normalize_to_list_of_substitutions(location)
        self.__method = method

    def try_get_launch_description_without_context(self) -> Any:
        return self.preflight_description

    def get_launch_description(self, context: LaunchContext) -> Any:
        if self.preflight_description is None:
            location = perform_substitutions(context, self.preflight_location)
            self.preflight_description = self._get_launch_description(location)
        return self.preflight_description

    def _get_launch_description(self, location: str) -> Any:
        """A description with nothing but the include of that file."""
        return LaunchDescription([IncludeLaunchDescription(AnyLaunchDescriptionSource(location))])

    @property
    def location(self) -> str:
        return " + ".join(sub.describe() for sub in self.preflight_location)

    @property
    def method(self) -> str:
        return self.__method


class AnyLaunchDescriptionSource(LaunchDescriptionSource):
    def __init__(self, launch_file_path: Any) -> None:
        super().__init__(None, launch_file_path, "interpreted launch file")


class FrontendLaunchDescriptionSource(LaunchDescriptionSource):
    def __init__(
        self, launch_file_path: Any, *, method: str = "interpreted frontend launch file", parser: Any = None
    ) -> None:
        super().__init__(None, launch_file_path, method)


class PythonLaunchDescriptionSource(LaunchDescriptionSource):
    kind = "python"

    def __init__(self, launch_file_path: Any) -> None:
        super().__init__(None, launch_file_path, "interpreted python launch file")


class XMLLaunchDescriptionSource(FrontendLaunchDescriptionSource):
    kind = "xml"

    def __init__(self, launch_file_path: Any) -> None:
        super().__init__(launch_file_path, method="interpreted XML launch file")


class YAMLLaunchDescriptionSource(FrontendLaunchDescriptionSource):
    kind = "yaml"

    def __init__(self, launch_file_path: Any) -> None:
        super().__init__(launch_file_path, method="interpreted YAML launch file")


class DeclareLaunchArgument(Action):
    def __init__(
        self,
        name: str,
        *,
        default_value: Any = None,
        description: Optional[str] = None,
        choices: Optional[Iterable[str]] = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.__name = name
        self.__default_value = None if default_value is None else normalize_to_list_of_substitutions(default_value)
        self.__choices = None if choices is None else list(choices)
        self.__description = description or "no description given"
        self.preflight_doc = description
        self._conditionally_included = False
        if self.__choices is not None:
            if not self.__choices:
                raise RuntimeError("Provided choices arg is empty. Use None to ignore the choice list.")
            literal = default_value is not None and not isinstance(default_value, (Substitution, list))
            if literal and default_value not in self.__choices:
                raise RuntimeError(
                    f'Provided default_value "{default_value}" is not in provided choices "{self.__choices}".'
                )

    @property
    def name(self) -> str:
        return self.__name

    @property
    def default_value(self) -> Optional[list[Substitution]]:
        return self.__default_value

    @property
    def description(self) -> str:
        return self.__description

    @property
    def choices(self) -> Optional[list[str]]:
        return self.__choices

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "arg"
        t.attribute("name", self.__name)
        t.attribute("default", self.__default_value)
        t.attribute("description", self.preflight_doc)
        for choice in self.__choices or ():
            t.child("choice", value=str(choice))


class _Set(Action):
    """Sets something by name; `preflight_kind` is its tag."""

    preflight_kind = ""

    def __init__(self, name: Any, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__name = normalize_to_list_of_substitutions(name)
        self.__value = normalize_to_list_of_substitutions(value)

    @property
    def name(self) -> list[Substitution]:
        return self.__name

    @property
    def value(self) -> list[Substitution]:
        return self.__value

    def preflight_serialize(self, t: Any) -> None:
        t.kind = self.preflight_kind
        t.attribute("name", self.__name)
        t.attribute("value", self.__value)


class _Unset(Action):
    """Takes something away by name; `preflight_kind` is its tag."""

    preflight_kind = ""

    def __init__(self, name: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__name = normalize_to_list_of_substitutions(name)

    @property
    def name(self) -> list[Substitution]:
        return self.__name

    def preflight_serialize(self, t: Any) -> None:
        t.kind = self.preflight_kind
        t.attribute("name", self.__name)


class SetLaunchConfiguration(_Set):
    preflight_kind = "let"


class UnsetLaunchConfiguration(_Unset):
    preflight_kind = "unlet"


class SetEnvironmentVariable(_Set):
    preflight_kind = "set_env"


class UnsetEnvironmentVariable(_Unset):
    preflight_kind = "unset_env"


class AppendEnvironmentVariable(Action):
    def __init__(self, name: Any, value: Any, prepend: Any = False, separator: Any = os.pathsep, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__name = normalize_to_list_of_substitutions(name)
        self.__value = normalize_to_list_of_substitutions(value)
        self.__prepend, self.__separator = prepend, normalize_to_list_of_substitutions(separator)

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "append_env"
        t.attribute("name", self.__name)
        t.attribute("value", self.__value)
        t.attribute("prepend", self.__prepend if isinstance(self.__prepend, bool) else t.parts(self.__prepend))
        t.attribute("separator", self.__separator)


class _Plain(Action):
    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)


class PushEnvironment(_Plain):
    def preflight_serialize(self, t: Any) -> None:
        t.kind = "push_env"


class PopEnvironment(_Plain):
    def preflight_serialize(self, t: Any) -> None:
        t.kind = "pop_env"


class ResetEnvironment(_Plain):
    def preflight_serialize(self, t: Any) -> None:
        t.kind = "reset_env"


class PushLaunchConfigurations(_Plain):
    def preflight_serialize(self, t: Any) -> None:
        t.kind = "push_configurations"


class PopLaunchConfigurations(_Plain):
    def preflight_serialize(self, t: Any) -> None:
        t.kind = "pop_configurations"


class ResetLaunchConfigurations(Action):
    def __init__(self, launch_configurations: Optional[dict[Any, Any]] = None, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__kept = dict(launch_configurations or {})

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "reset"
        for name, value in self.__kept.items():
            t.child("keep", name=normalize_to_list_of_substitutions(name), value=value)


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


class IncludeLaunchDescription(Action):
    def __init__(self, launch_description_source: Any, *, launch_arguments: Any = None, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        if not isinstance(launch_description_source, LaunchDescriptionSource):
            launch_description_source = AnyLaunchDescriptionSource(launch_description_source)
        self.__source = launch_description_source
        self.__arguments = () if launch_arguments is None else tuple(launch_arguments)

    @property
    def launch_description_source(self) -> Any:
        return self.__source

    @property
    def launch_arguments(self) -> Any:
        return self.__arguments

    def preflight_serialize(self, t: Any) -> None:
        description = self.__source.preflight_description
        t.kind = "include" if description is None else "inline"
        if description is None:
            t.attribute("file", self.__source.preflight_location)
            t.attribute("source", self.__source.kind or None)
        for pair in self.__arguments:
            name, value = pair
            t.child("arg" if description is None else "arg_passed", name=name, value=value)
        if description is not None:
            t.entities(description.entities)


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
