"""Those of `launch_ros.actions` that hold for the nodes after them."""

from __future__ import annotations

from typing import Any

from .actions import TimerAction
from .base import Action, normalize_to_list_of_substitutions
from .ros_parameters import normalize_parameter_dict


class PushROSNamespace(Action):
    def __init__(self, namespace: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__namespace = normalize_to_list_of_substitutions(namespace)

    @property
    def namespace(self) -> Any:
        return self.__namespace

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "push_ros_namespace"
        t.attribute("namespace", self.__namespace)


class ROSTimer(TimerAction):
    def __init__(self, *, period: Any, actions: Any, **kwargs: Any) -> None:
        super().__init__(period=period, actions=actions, **kwargs)


class SetParameter(Action):
    def __init__(self, name: Any, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        names = normalize_to_list_of_substitutions(name)
        self.__params = normalize_parameter_dict({tuple(names): value})

    @property
    def name(self) -> Any:
        return next(iter(self.__params))

    @property
    def value(self) -> Any:
        return next(iter(self.__params.values()))

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "set_parameter"
        for name, value in self.__params.items():
            t.attribute("name", list(name))
            t.parameter(list(name), value)


class SetParametersFromFile(Action):
    def __init__(self, filename: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._input_file = normalize_to_list_of_substitutions(filename)

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "set_parameters_from_file"
        t.attribute("filename", self._input_file)


class SetRemap(Action):
    def __init__(self, src: Any, dst: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__src = normalize_to_list_of_substitutions(src)
        self.__dst = normalize_to_list_of_substitutions(dst)

    @property
    def src(self) -> Any:
        return self.__src

    @property
    def dst(self) -> Any:
        return self.__dst

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "set_remap"
        t.attribute("from", self.__src)
        t.attribute("to", self.__dst)


class SetUseSimTime(Action):
    def __init__(self, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__value = value

    @property
    def value(self) -> Any:
        return self.__value

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "set_use_sim_time"
        t.attribute("value", self.__value if isinstance(self.__value, bool) else t.parts(self.__value))


class SetROSLogDir(Action):
    def __init__(self, new_log_dir: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__log_dir = normalize_to_list_of_substitutions(new_log_dir)

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "set_ros_log_dir"
        t.attribute("new_log_dir", self.__log_dir)


class RosTimer(ROSTimer):
    pass
