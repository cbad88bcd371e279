"""Nodes: names, parameters and ends are as the real ones' (https://docs.ros.org/en/jazzy/p/rclpy/)."""

from __future__ import annotations

import importlib
import math
import re
import weakref
from typing import Any

from . import context as contexts
from .arguments import Arguments
from .callback_groups import MutuallyExclusiveCallbackGroup
from .client import Client
from .clock import ROSClock
from .exceptions import (
    InvalidNamespaceException,
    InvalidNodeNameException,
    InvalidParameterException,
    InvalidParameterTypeException,
    InvalidParameterValueException,
    NotInitializedException,
    ParameterAlreadyDeclaredException,
    ParameterImmutableException,
    ParameterNotDeclaredException,
    ParameterUninitializedException,
)
from .expand_topic_name import validated
from .logging import get_logger
from .parameter import Parameter
from .parameter_service import ParameterService
from .publisher import Publisher
from .qos import (
    LivelinessPolicy,
    QoSProfile,
    ReliabilityPolicy,
    qos_profile_parameter_events,
    qos_profile_parameters,
    qos_profile_rosout_default,
    qos_profile_services_default,
)
from .qos_overriding_options import declare
from .service import Service
from .subscription import Subscription
from .timer import Rate, Timer

HIDDEN_NODE_PREFIX = "_"
NodeNameNonExistentError = type("NodeNameNonExistentError", (Exception,), {})
_NAME = re.compile(r"[A-Za-z_]\w*\Z", re.ASCII)
_SPACE = re.compile(r"/\Z|(/[A-Za-z_]\w*)+\Z", re.ASCII)


class Node:
    """A node, which nobody sees."""

    def __init__(
        self,
        node_name: str,
        *,
        context: Any = None,
        cli_args: Any = None,
        namespace: Any = None,
        use_global_arguments: bool = True,
        enable_rosout: bool = True,
        rosout_qos_profile: Any = qos_profile_rosout_default,
        start_parameter_services: bool = True,
        parameter_overrides: Any = None,
        allow_undeclared_parameters: bool = False,
        automatically_declare_parameters_from_overrides: bool = False,
        enable_logger_service: bool = False,
    ) -> None:
        self._context = context or contexts.default
        if not self._context.ok():
            raise NotInitializedException("cannot create node")
        self._parameters: dict[str, Any] = {}
        self._descriptors: dict[str, Any] = {}
        self._made: dict[str, list[Any]] = {}
        self._callbacks: dict[str, list[Any]] = {"pre": [], "on": [], "post": []}
        self._allow_undeclared_parameters = allow_undeclared_parameters
        self.default_callback_group = MutuallyExclusiveCallbackGroup()
        self._executor: Any = None
        self._set_names(node_name, namespace or "", cli_args, use_global_arguments)
        self._logger = get_logger(f"{self.space_}/{self.name_}".strip("/").replace("/", "."))
        self._parameter_event_publisher = self.create_publisher(
            _interfaces("msg").ParameterEvent, "/parameter_events", qos_profile_parameter_events
        )
        self._parameter_overrides = {
            name: Parameter(name, value=value) for name, value in self._arguments.of(self._full_name()).items()
        }
        self._parameter_overrides.update({each.name: each for each in parameter_overrides or ()})
        self._clock = ROSClock()
        if automatically_declare_parameters_from_overrides:
            self.declare_parameters(
                "",
                [(name, each.value, _descriptor()) for name, each in self._parameter_overrides.items()],
                ignore_override=True,
            )
        self._start_time()
        if start_parameter_services:
            self._parameter_service = ParameterService(self)
        if not self.has_parameter("start_type_description_service"):
            self.declare_parameter("start_type_description_service", True, _descriptor(read_only=True))

    def _set_names(self, name: str, space: str, cli_args: Any, use_global: bool) -> None:
        words = [*(["--ros-args"] if cli_args and "--ros-args" not in cli_args else []), *(cli_args or ())]
        self._arguments = Arguments([*words, "--", *(self._context.args if use_global else ())])
        self.name_ = self._arguments.remapped("__node", name, self._arguments.remapped("__name", name, name))
        if not isinstance(name, str) or not _NAME.match(self.name_):
            raise InvalidNodeNameException(str(name), "node name is malformed", 0)
        full = self._arguments.remapped("__ns", name, space) or "/"
        self.space_ = full if full.startswith("/") else f"/{full}"
        if not _SPACE.match(self.space_):
            raise InvalidNamespaceException(self.space_, "namespace is malformed", 0)

    def _start_time(self) -> None:
        if not self.has_parameter("use_sim_time"):
            self.declare_parameter("use_sim_time", False)
        if self.get_parameter("use_sim_time").value is True:
            self._clock.ros_time_is_active = True
            clock = importlib.import_module("rosgraph_msgs.msg").Clock
            profile = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
            self.create_subscription(clock, "/clock", lambda message: None, profile)

    def _full_name(self) -> str:
        return f"{self.space_.rstrip('/')}/{self.name_}"

    # The node itself

    @property
    def context(self) -> Any:
        return self._context

    @property
    def handle(self) -> Any:
        return self

    @property
    def executor(self) -> Any:
        return self._executor() if self._executor is not None else None

    @executor.setter
    def executor(self, new_executor: Any) -> None:
        self._executor = weakref.ref(new_executor) if new_executor is not None else None

    def get_name(self) -> str:
        return self.name_

    def get_namespace(self) -> str:
        return self.space_

    def get_fully_qualified_name(self) -> str:
        return self._full_name()

    def get_clock(self) -> Any:
        return self._clock

    def get_logger(self) -> Any:
        return self._logger

    def destroy_node(self) -> None:
        self._made.clear()

    def add_waitable(self, waitable: Any) -> None:
        pass

    def remove_waitable(self, waitable: Any) -> None:
        pass

    def __enter__(self) -> Any:
        return self

    def __exit__(self, *exception: Any) -> None:
        self.destroy_node()

    # Parameters

    def declare_parameter(
        self, name: str, value: Any = None, descriptor: Any = None, ignore_override: bool = False
    ) -> Any:
        """Declare one, by a value or a type; one of any type, where there is neither."""
        given = (name,) if value is None and descriptor is None else (name, value, descriptor or _descriptor())
        return self.declare_parameters("", [given], ignore_override)[0]

    def declare_parameters(self, namespace: str, parameters: Any, ignore_override: bool = False) -> list[Any]:
        """Declare several: names, values or types, descriptors. Raises what rclpy raises."""
        found = []
        for each in parameters:
            parts = each if isinstance(each, (list, tuple)) else (each,)
            if not 1 <= len(parts) <= 3 or not isinstance(parts[0], str):
                raise TypeError(f"Invalid parameter tuple {parts}")
            name = f"{namespace}.{parts[0]}" if namespace else parts[0]
            if not name:
                raise InvalidParameterException(name)
            value = parts[1] if len(parts) > 1 else None
            descriptor = parts[2] if len(parts) > 2 else _descriptor()
            if len(parts) == 1:
                descriptor.dynamic_typing = True
            if isinstance(value, Parameter.Type):
                if value == Parameter.Type.NOT_SET:
                    raise ValueError(f"Cannot declare parameter {{{name}}} as statically typed of type NOT_SET")
                descriptor.type, value = value.value, None
            elif not descriptor.dynamic_typing:
                kind = Parameter.Type.from_parameter_value(value)
                descriptor.type = kind.value
                if kind == Parameter.Type.NOT_SET:
                    raise ValueError(
                        "Cannot declare a statically typed parameter with default value of type PARAMETER_NOT_SET"
                    )
            if not ignore_override and name in self._parameter_overrides:
                value = self._parameter_overrides[name].value
            found.append((Parameter(name, value=value), descriptor))
        declared = [parameter.name for parameter, _ in found if parameter.name in self._parameters]
        if declared:
            raise ParameterAlreadyDeclaredException(declared)
        for parameter, descriptor in found:
            self._check(parameter, descriptor)
            self._ask([parameter])
            self._parameters[parameter.name], self._descriptors[parameter.name] = parameter, descriptor
        return [self._parameters[parameter.name] for parameter, _ in found]

    def _check(self, parameter: Any, descriptor: Any) -> None:
        kind = parameter.type_
        if not descriptor.dynamic_typing and kind != Parameter.Type.NOT_SET and kind.value != descriptor.type:
            empty = isinstance(parameter.value, (list, tuple)) and not parameter.value
            if not (empty and descriptor.type >= Parameter.Type.BYTE_ARRAY.value):
                raise InvalidParameterTypeException(parameter, Parameter.Type(descriptor.type).name)
        ranges = {"INTEGER": "integer_range", "DOUBLE": "floating_point_range"}.get(kind.name, "")
        for allowed in list(getattr(descriptor, ranges, ()))[:1]:
            low, high, step, value = allowed.from_value, allowed.to_value, allowed.step, parameter.value
            at_an_end = math.isclose(value, low) or math.isclose(value, high)
            if not (low <= value <= high or at_an_end):
                reason = f"Parameter {parameter.name} out of range Min: {low}, Max: {high}, value: {value}"
                raise InvalidParameterValueException(parameter.name, value, reason)
            steps = (value - low) / step if step else 0
            if not at_an_end and not math.isclose(steps, round(steps), abs_tol=1e-9):
                reason = f"The parameter value for {parameter.name} is not a valid step."
                raise InvalidParameterValueException(parameter.name, value, reason)

    def _ask(self, parameters: list[Any]) -> None:
        for callback in self._callbacks["on"]:
            result = callback(parameters)
            if getattr(result, "successful", True) is False:
                raise InvalidParameterValueException(parameters[0].name, parameters[0].value, result.reason)

    def undeclare_parameter(self, name: str) -> None:
        if name not in self._parameters:
            raise ParameterNotDeclaredException(name)
        if self._descriptors[name].read_only:
            raise ParameterImmutableException(name)
        del self._parameters[name], self._descriptors[name]

    def has_parameter(self, name: str) -> bool:
        return name in self._parameters

    def get_parameter_types(self, names: Any) -> list[Any]:
        return [self.get_parameter_type(name) for name in names]

    def get_parameter_type(self, name: str) -> Any:
        if name in self._parameters:
            return self._parameters[name].type_
        if self._allow_undeclared_parameters:
            return Parameter.Type.NOT_SET
        raise ParameterNotDeclaredException(name)

    def get_parameters(self, names: Any) -> list[Any]:
        return [self.get_parameter(name) for name in names]

    def get_parameter(self, name: str) -> Any:
        """Raises where it is not declared, or has to have a value and has none."""
        if name in self._parameters:
            found = self._parameters[name]
            if found.type_ != Parameter.Type.NOT_SET or self._descriptors[name].dynamic_typing:
                return found
            raise ParameterUninitializedException(name)
        if self._allow_undeclared_parameters:
            return Parameter(name, Parameter.Type.NOT_SET, None)
        raise ParameterNotDeclaredException(name)

    def get_parameter_or(self, name: str, alternative_value: Any = None) -> Any:
        found = self._parameters.get(name)
        if found is None or found.type_ == Parameter.Type.NOT_SET:
            return alternative_value or Parameter(name, Parameter.Type.NOT_SET)
        return found

    def get_parameters_by_prefix(self, prefix: str) -> dict[str, Any]:
        start = f"{prefix}." if prefix else ""
        return {name[len(start) :]: each for name, each in self._parameters.items() if name.startswith(start)}

    def set_parameters(self, parameter_list: Any) -> list[Any]:
        return [self.set_parameters_atomically([each]) for each in parameter_list]

    def set_parameters_atomically(self, parameter_list: Any) -> Any:
        result = _interfaces("msg").SetParametersResult
        for each in parameter_list:
            if each.name not in self._parameters and not self._allow_undeclared_parameters:
                raise ParameterNotDeclaredException(each.name)
        try:
            for each in parameter_list:
                described = self._descriptors.get(each.name)
                if described is not None and described.read_only:
                    return result(successful=False, reason=f"Trying to set a read-only parameter: {each.name}.")
                if described is not None:
                    self._check(each, described)
            self._ask(list(parameter_list))
        except (InvalidParameterTypeException, InvalidParameterValueException) as error:
            return result(successful=False, reason=str(error))
        for each in parameter_list:
            self._parameters[each.name] = each
            self._descriptors.setdefault(each.name, _descriptor(dynamic_typing=True))
        for callback in self._callbacks["post"]:
            callback(list(parameter_list))
        return result(successful=True)

    def list_parameters(self, prefixes: Any, depth: int = 0) -> Any:
        result = _interfaces("msg").ListParametersResult()
        result.names = [name for name in self._parameters if not prefixes or name.startswith(tuple(prefixes))]
        return result

    def describe_parameter(self, name: str) -> Any:
        if name not in self._descriptors:
            raise ParameterNotDeclaredException(name)
        return self._descriptors[name]

    def describe_parameters(self, names: Any) -> list[Any]:
        return [self.describe_parameter(name) for name in names]

    def set_descriptor(self, name: str, descriptor: Any, alternative_value: Any = None) -> Any:
        self._descriptors[name] = descriptor
        return self.get_parameter(name).get_parameter_value()

    def add_pre_set_parameters_callback(self, callback: Any) -> None:
        self._callbacks["pre"].insert(0, callback)

    def add_on_set_parameters_callback(self, callback: Any) -> None:
        self._callbacks["on"].insert(0, callback)

    def add_post_set_parameters_callback(self, callback: Any) -> None:
        self._callbacks["post"].insert(0, callback)

    def set_parameters_callback(self, callback: Any) -> None:
        self._callbacks["on"] = [callback]

    def remove_pre_set_parameters_callback(self, callback: Any) -> None:
        self._callbacks["pre"].remove(callback)

    def remove_on_set_parameters_callback(self, callback: Any) -> None:
        self._callbacks["on"].remove(callback)

    def remove_post_set_parameters_callback(self, callback: Any) -> None:
        self._callbacks["post"].remove(callback)

    # Ends

    def resolve_topic_name(self, topic: str, *, only_expand: bool = False) -> str:
        full = validated(topic, self.name_, self.space_)
        for of, source, target in () if only_expand else self._arguments.remaps:
            meant = of in ("", self.name_) and not source.startswith("__")
            if meant and validated(source, self.name_, self.space_) == full:
                return validated(target, self.name_, self.space_)
        return full

    def resolve_service_name(self, service: str, *, only_expand: bool = False) -> str:
        return Node.resolve_topic_name(self, service, only_expand=only_expand)

    def _keep(self, kind: str, made: Any) -> Any:
        self._made.setdefault(kind, []).append(made)
        return made

    def _forget(self, kind: str, made: Any) -> bool:
        found = made in self._made.get(kind, ())
        if found:
            self._made[kind].remove(made)
        return found

    def create_publisher(
        self,
        msg_type: Any,
        topic: str,
        qos_profile: Any,
        *,
        callback_group: Any = None,
        event_callbacks: Any = None,
        qos_overriding_options: Any = None,
        publisher_class: Any = Publisher,
    ) -> Any:
        profile = _profile(qos_profile)
        full = Node.resolve_topic_name(self, topic)
        if qos_overriding_options is not None:
            declare("publisher", self, full, profile, qos_overriding_options)
        return self._keep("publishers", publisher_class(self, _message(msg_type), topic, profile, full))

    def create_subscription(
        self,
        msg_type: Any,
        topic: str,
        callback: Any,
        qos_profile: Any,
        *,
        callback_group: Any = None,
        event_callbacks: Any = None,
        qos_overriding_options: Any = None,
        raw: bool = False,
        content_filter_options: Any = None,
    ) -> Any:
        profile = _profile(qos_profile)
        full = Node.resolve_topic_name(self, topic)
        if qos_overriding_options is not None:
            declare("subscription", self, full, profile, qos_overriding_options)
        return self._keep("subscriptions", Subscription(_message(msg_type), topic, callback, profile, full))

    def create_client(
        self,
        srv_type: Any,
        srv_name: str,
        *,
        qos_profile: Any = qos_profile_services_default,
        callback_group: Any = None,
    ) -> Any:
        full = Node.resolve_topic_name(self, srv_name)
        return self._keep("clients", Client(self._context, srv_type, srv_name, qos_profile, full))

    def create_service(
        self,
        srv_type: Any,
        srv_name: str,
        callback: Any,
        *,
        qos_profile: Any = qos_profile_services_default,
        callback_group: Any = None,
    ) -> Any:
        full = Node.resolve_topic_name(self, srv_name)
        return self._keep("services", Service(srv_type, srv_name, callback, qos_profile, full))

    def create_timer(
        self,
        timer_period_sec: Any,
        callback: Any,
        callback_group: Any = None,
        clock: Any = None,
        autostart: bool = True,
    ) -> Any:
        period = int(float(timer_period_sec) * 1_000_000_000)
        return self._keep("timers", Timer(callback, period, clock or self._clock))

    def create_guard_condition(self, callback: Any, callback_group: Any = None) -> Any:
        return self._keep("guards", importlib.import_module("rclpy.guard_condition").GuardCondition(callback))

    def create_rate(self, frequency: Any, clock: Any = None) -> Any:
        if frequency <= 0:
            raise ValueError("frequency must be > 0")
        return self._keep("rates", Rate(int(1_000_000_000 / frequency), self._context))

    def destroy_publisher(self, publisher: Any) -> bool:
        return self._forget("publishers", publisher)

    def destroy_subscription(self, subscription: Any) -> bool:
        return self._forget("subscriptions", subscription)

    def destroy_client(self, client: Any) -> bool:
        return self._forget("clients", client)

    def destroy_service(self, service: Any) -> bool:
        return self._forget("services", service)

    def destroy_timer(self, timer: Any) -> bool:
        return self._forget("timers", timer)

    def destroy_guard_condition(self, guard: Any) -> bool:
        return self._forget("guards", guard)

    def destroy_rate(self, rate: Any) -> bool:
        return self._forget("rates", rate)

    @property
    def publishers(self) -> Any:
        return iter(self._made.get("publishers", ()))

    @property
    def subscriptions(self) -> Any:
        return iter(self._made.get("subscriptions", ()))

    @property
    def clients(self) -> Any:
        return iter(self._made.get("clients", ()))

    @property
    def services(self) -> Any:
        return iter(self._made.get("services", ()))

    @property
    def timers(self) -> Any:
        return iter(self._made.get("timers", ()))

    # Others: there are none

    def get_node_names(self) -> list[str]:
        return [self.name_]

    def get_fully_qualified_node_names(self) -> list[str]:
        return [self._full_name()]

    def get_node_names_and_namespaces(self) -> list[tuple[str, str]]:
        return [(self.name_, self.space_)]

    def get_node_names_and_namespaces_with_enclaves(self) -> list[tuple[str, str, str]]:
        return [(self.name_, self.space_, "/")]

    def get_topic_names_and_types(self, no_demangle: bool = False) -> list[Any]:
        return []

    def get_service_names_and_types(self) -> list[Any]:
        return []

    def get_publisher_names_and_types_by_node(self, *args: Any, **kwargs: Any) -> list[Any]:
        return []

    def get_subscriber_names_and_types_by_node(self, *args: Any, **kwargs: Any) -> list[Any]:
        return []

    def get_service_names_and_types_by_node(self, *args: Any, **kwargs: Any) -> list[Any]:
        return []

    def get_client_names_and_types_by_node(self, *args: Any, **kwargs: Any) -> list[Any]:
        return []

    def get_publishers_info_by_topic(self, topic_name: str, no_mangle: bool = False) -> list[Any]:
        return []

    def get_subscriptions_info_by_topic(self, topic_name: str, no_mangle: bool = False) -> list[Any]:
        return []

    def count_publishers(self, topic_name: str) -> int:
        return 0

    def count_subscribers(self, topic_name: str) -> int:
        return 0

    def count_clients(self, service_name: str) -> int:
        return 0

    def count_services(self, service_name: str) -> int:
        return 0

    def wait_for_node(self, fully_qualified_node_name: str, timeout: float) -> bool:
        return False


def _interfaces(kind: str) -> Any:
    return importlib.import_module(f"rcl_interfaces.{kind}")


def _descriptor(**fields: Any) -> Any:
    return _interfaces("msg").ParameterDescriptor(**fields)


def _profile(given: Any) -> Any:
    """The profile of an end; the middleware settles what is left to it."""
    if isinstance(given, bool) or not isinstance(given, (int, QoSProfile)):
        if not hasattr(given, "_preflight_name"):
            raise TypeError(f"Expected QoSProfile or int, but received {type(given)!r}")
        given = 10
    if isinstance(given, int) and given < 0:
        raise ValueError("history depth must be greater than or equal to zero")
    found: Any = QoSProfile(depth=given) if isinstance(given, int) else given
    settled = QoSProfile(found.history, found.depth, found.reliability, found.durability)
    vars(settled).update(vars(found))
    return settled


def _message(msg_type: Any) -> Any:
    if not isinstance(msg_type, type) and not hasattr(msg_type, "_preflight_name"):
        raise TypeError(f"{msg_type!r} is no class of messages")
    return msg_type


__all__ = ["LivelinessPolicy", "Node", "qos_profile_parameters"]
