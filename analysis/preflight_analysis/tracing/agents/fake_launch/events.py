"""`launch.events`, `launch.event_handlers` and those of `launch_ros`: what they would do, not when."""

from __future__ import annotations

import collections.abc
from typing import Any

from .base import Action, Event, LaunchDescriptionEntity, Made
from .processes import ExecuteLocal, ExecuteProcess


class BaseEventHandler(Made):
    preflight_entities: list[Any] = []
    preflight_function: Any = None

    def preflight_take(self, given: Any, left: Any) -> None:
        self.matcher, self.handle_once = given.matcher, given.handle_once

    def matches(self, event: Any) -> bool:
        return False

    def handle(self, event: Any, context: Any) -> Any:
        return None

    def _does(self, what: Any) -> None:
        if isinstance(what, LaunchDescriptionEntity):
            self.preflight_entities = [what]
        elif callable(what):
            self.preflight_function = what
        elif isinstance(what, collections.abc.Iterable):
            self.preflight_entities = list(what)
            for entity in self.preflight_entities:
                if not isinstance(entity, LaunchDescriptionEntity):
                    raise TypeError(
                        "expected all items in 'on_event' iterable to be of type 'LaunchDescriptionEntity' "
                        f"but got '{type(entity)}'"
                    )
        elif what is not None:
            self.preflight_entities = [what]


class EventHandler(BaseEventHandler):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(matcher=given.matcher, handle_once=given.handle_once)
        self._does(given.entities)

    @property
    def entities(self) -> Any:
        return self.preflight_entities


class OnActionEventBase(BaseEventHandler):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(**left)
        wanted, matcher = given.target_action_cls or Action, given.action_matcher
        if not (matcher is None or isinstance(matcher, wanted) or callable(matcher)):
            raise TypeError(f"action_matcher must be an '{wanted.__name__}' instance or a callable")
        self.preflight_target = matcher
        self._does(given.on_event)

    def _on(self, given: Any, event: Any, target: Any, left: Any) -> None:
        OnActionEventBase.__init__(
            self, action_matcher=given.target_action, on_event=event, target_action_cls=target, **left
        )


class OnExecutionComplete(OnActionEventBase):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(action_matcher=given.target_action, on_event=given.on_completion, **left)


class OnProcessExit(OnActionEventBase):
    def preflight_take(self, given: Any, left: Any) -> None:
        self._on(given, given.on_exit, ExecuteLocal, left)


class OnProcessStart(OnActionEventBase):
    def preflight_take(self, given: Any, left: Any) -> None:
        self._on(given, given.on_start, ExecuteProcess, left)


class OnProcessIO(OnActionEventBase):
    def preflight_take(self, given: Any, left: Any) -> None:
        self._on(given, given.on_stdout or given.on_stderr or given.on_stdin, ExecuteLocal, left)


class OnIncludeLaunchDescription(EventHandler):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(**{"matcher": None, **left})


class OnShutdown(BaseEventHandler):
    """What it does nobody waits for: it is not told."""

    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(**left)


class OnStateTransition(EventHandler):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(matcher=given.matcher, entities=given.entities, **left)


class _AnyEvent(Event):
    def __init__(self, *args: Any, **kwargs: Any) -> None:
        self.__dict__.update(kwargs)


class ExecutionComplete(_AnyEvent):
    pass


class IncludeLaunchDescriptionEvent(_AnyEvent):
    pass


class ShutdownEvent(_AnyEvent):
    pass


class TimerEvent(_AnyEvent):
    pass


class RunningProcessEvent(_AnyEvent):
    pass


class ProcessExited(RunningProcessEvent):
    pass


class ProcessIO(RunningProcessEvent):
    pass


class ProcessStarted(RunningProcessEvent):
    pass


class ProcessStderr(ProcessIO):
    pass


class ProcessStdin(ProcessIO):
    pass


class ProcessStdout(ProcessIO):
    pass


class ProcessTargetedEvent(_AnyEvent):
    pass


class ShutdownProcess(ProcessTargetedEvent):
    pass


class SignalProcess(ProcessTargetedEvent):
    pass


class ChangeState(_AnyEvent):
    """`preflight_asked` tells which node it is for, by number or by name, and which transition it asks for; what is not
    known of that is left out."""

    def __init__(self, *, lifecycle_node_matcher: Any, transition_id: Any, **kwargs: Any) -> None:
        super().__init__(lifecycle_node_matcher=lifecycle_node_matcher, transition_id=transition_id, **kwargs)
        matcher = lifecycle_node_matcher
        self.preflight_asked: dict[str, Any] = {"transition": transition_id}
        if isinstance(matcher, _Matcher) and matcher.action is not None:
            self.preflight_asked["node"] = str(matcher.action.preflight_id)
        elif isinstance(matcher, _Matcher):
            self.preflight_asked["name"] = matcher.name


class StateTransition(_AnyEvent):
    pass


class _Matcher:
    def __init__(self, action: Any, name: Any) -> None:
        self.action, self.name = action, name

    def __call__(self, *_: Any) -> bool:
        return True


def matches_action(target_action: Any) -> Any:
    return _Matcher(target_action, None) if isinstance(target_action, Action) else matches_anything()


def matches_node_name(node_name: Any) -> Any:
    return _Matcher(None, node_name)


def matches_anything(*args: Any, **kwargs: Any) -> Any:
    """In the place of all other matchers."""
    return lambda *_: True
