"""Those of `launch_ros.actions` that hold for the nodes after them and do more than keep what they are given."""

from __future__ import annotations

from typing import Any

from .actions import TimerAction
from .base import Action, normalize_to_list_of_substitutions
from .ros_parameters import normalize_parameter_dict


class PushROSNamespace(Action):
    pass


class ROSTimer(TimerAction):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(period=given.period, actions=given.actions, **left)


class SetParameter(Action):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(**left)
        names = normalize_to_list_of_substitutions(given.name)
        self.__params = normalize_parameter_dict({tuple(names): given.value})

    @property
    def name(self) -> Any:
        return next(iter(self.__params))

    @property
    def value(self) -> Any:
        return next(iter(self.__params.values()))

    def preflight_serialize(self, t: Any) -> None:
        for name, value in self.__params.items():
            t.attribute("name", list(name))
            t.parameter(list(name), value)


class SetUseSimTime(Action):
    preflight_flags = ("value",)
