"""What calls of rclpy and of the libraries beside it make: endpoints with their QoS, and parameters."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from preflight_analysis.evaluation import names
from preflight_analysis.source.branches import Branches
from preflight_analysis.source.collector import Collector
from preflight_analysis.source.known_params import KnownParams
from preflight_analysis.source.python_frames import Message, has_tree, message_of, note_frames
from preflight_analysis.source.python_libraries import makes_no_ends
from preflight_analysis.source.python_values import UNKNOWN, Class, Imported, Instance, is_plain, known
from preflight_analysis.source.rclcpp_api import LIFECYCLE
from preflight_analysis.tracing.interface import Endpoint, ParamUse, Range, Role

_TYPE = re.compile(r"([A-Za-z]\w*)\.(msg|srv|action)\.(?:_\w+\.)?([A-Za-z]\w*)\Z")
_TF = "tf2_msgs/msg/TFMessage"

_METHODS: Mapping[str, tuple[Role, str, tuple[str, str, str]]] = {
    "create_publisher": ("publisher", "msg", ("msg_type", "topic", "qos_profile")),
    "create_lifecycle_publisher": ("publisher", "msg", ("msg_type", "topic", "qos_profile")),
    "create_subscription": ("subscriber", "msg", ("msg_type", "topic", "qos_profile")),
    "create_service": ("service", "srv", ("srv_type", "srv_name", "qos_profile")),
    "create_client": ("client", "srv", ("srv_type", "srv_name", "qos_profile")),
}
"""Of a node: the role, the kind of its type, and the names of type, name and QoS."""
_QOS_AT = {"create_publisher": 2, "create_lifecycle_publisher": 2, "create_subscription": 3}

_WITH_NODE: Mapping[str, tuple[Role, str, tuple[str, str]]] = {
    "rclpy.ActionServer": ("action_server", "action", ("action_type", "action_name")),
    "rclpy.ActionClient": ("action_client", "action", ("action_type", "action_name")),
    "message_filters.Subscriber": ("subscriber", "msg", ("msg_type", "topic")),
}
"""Objects that are made with a node as their first argument."""
_FIXED: Mapping[str, tuple[tuple[Role, str, str], ...]] = {
    "tf2_ros.TransformBroadcaster": (("publisher", "/tf", _TF),),
    "tf2_ros.StaticTransformBroadcaster": (("publisher", "/tf_static", _TF),),
    "tf2_ros.TransformListener": (("subscriber", "/tf", _TF), ("subscriber", "/tf_static", _TF)),
}
_LIBRARIES = frozenset({"rclpy", "tf2_ros", "message_filters"})
_NODES = ("rclpy.Node", "rclpy.LifecycleNode")
_IS_LIFECYCLE = re.compile(r"\.lifecycle\.|LifecycleNode")
_OVERRIDES = "automatically_declare_parameters_from_overrides"
_MAKES_NODES = re.compile(r"(?:Node|Navigator|Commander|MoveItPy)(?:\.__init__)?\Z")
"""Classes of libraries that are nodes, or have one."""

_DESCRIBING = frozenset(
    f"rcl_interfaces.msg.{name}" for name in ("ParameterDescriptor", "IntegerRange", "FloatingPointRange")
)
_BARE = re.compile(r"\bParameter\.Type\.((?:BOOL|INTEGER|DOUBLE|STRING)(?:_ARRAY)?)\Z")

_RELIABLE = {"reliability": "reliable", "durability": "volatile"}
_PROFILES: Mapping[str, Mapping[str, Any]] = {
    "qos_profile_sensor_data": {"reliability": "best_effort", "durability": "volatile", "depth": 5},
    "qos_profile_system_default": {},
    "qos_profile_services_default": {**_RELIABLE, "depth": 10},
    "qos_profile_parameters": {**_RELIABLE, "depth": 1000},
    "qos_profile_default": {**_RELIABLE, "depth": 10},
}
_POLICIES = {"reliability": ("reliable", "best_effort"), "durability": ("volatile", "transient_local")}
_VALUE_FIELDS = (
    "string_value",
    "double_value",
    "integer_value",
    "bool_value",
    "string_array_value",
    "double_array_value",
    "integer_array_value",
    "bool_array_value",
)


class RclpyCalls:
    """Collects what the calls of one node make. Implements `python_modules.Calls`."""

    def __init__(self, node: str, argv: Sequence[str], params: KnownParams) -> None:
        self._node = node
        self._argv = list(argv)
        self._params = params
        self._defaults: dict[str, Any] = {}
        self._from_overrides = False
        self.collected = Collector()

    def begin(self, branches: Branches) -> None:
        """A node that is made in one branch of a condition may well not be made."""
        self.collected.branches = branches

    def cut_short(self) -> None:
        """There may be more."""
        self.collected.miss()

    def given(self, value: Any) -> None:
        """Who has the node may make something with it."""
        if _has_node(value):
            self.collected.miss()

    def value(self, path: str) -> Any:
        """`sys.argv` and the profiles of QoS are known; everything else is what its name says."""
        if path == "sys.argv":
            return list(self._argv)
        return Imported(path)

    def call(self, path: str, args: Sequence[Any], kwargs: Mapping[str, Any], file: str, line: int) -> Any:
        """Note what the call makes; its value where it has one that is known."""
        name, method = _plain(path), path.rpartition(".")[2]

        def given(index: int, keyword: str) -> Any:
            return known(args[index] if index < len(args) else kwargs.get(keyword, UNKNOWN))

        note_frames(self.collected, path, args, kwargs, file, line)
        if (message := message_of(path, kwargs)) is not None:
            return message
        if path.startswith("rclpy.") and method in _METHODS:
            role, kind, (type_name, end_name, qos_name) = _METHODS[method]
            qos = _qos(given(_QOS_AT[method], qos_name)) if method in _QOS_AT else {}
            type_ = _type(given(0, type_name), kind)
            self.collected.add_endpoint(Endpoint(role, given(1, end_name), type_, None, qos, file, line))
            return Imported(f"rclpy.{method}()")
        if factory := _WITH_NODE.get(name):
            role, kind, (type_name, end_name) = factory
            self.collected.add_endpoint(
                Endpoint(role, given(2, end_name), _type(given(1, type_name), kind), None, {}, file, line)
            )
            return Imported(f"{name}()")
        if fixed := _FIXED.get(name):
            for role, topic, type_ in fixed:
                self.collected.add_endpoint(Endpoint(role, topic, type_, None, {}, file, line))
            return Imported(f"{name}()")
        if has_tree(name):
            return Imported(f"{name}()")
        if name in _DESCRIBING:
            return Instance(Class(name.rpartition(".")[2], {}, ()), _all_known(kwargs))
        if path.startswith("rclpy."):
            return self._of_rclpy(path, given, kwargs, file, line)
        if _MAKES_NODES.search(path):
            self.collected.unknown_node()
            self.collected.miss()
        if name == "os.path.join" and args:
            parts = [*map(known, args)]
            if all(isinstance(part, str) for part in parts):
                return os.path.join(*parts)
        if not makes_no_ends(path) and any(map(_has_node, (*args, *kwargs.values()))):
            self.collected.miss()
        return UNKNOWN

    def _of_rclpy(
        self,
        path: str,
        given: Callable[[int, str], Any],
        kwargs: Mapping[str, Any],
        file: str,
        line: int,
    ) -> Any:
        name, method = _plain(path), path.rpartition(".")[2]
        if method == "declare_parameter":
            return self._declared(given(0, "name"), given(1, "value"), given(2, "descriptor"), file, line)
        if method == "declare_parameters":
            return self._declared_all(given(0, "namespace"), given(1, "parameters"), file, line)
        if method in ("get_parameter", "get_parameter_or", "has_parameter"):
            return self._read(given(0, "name"), method, given(1, "alternative_value"))
        if method == "__init__" or name in ("rclpy.create_node", "rclpy.Node", "rclpy.LifecycleNode"):
            kwargs = _all_known(kwargs)
            self._from_overrides = self._from_overrides or kwargs.get(_OVERRIDES, False) is not False
            if any(kwargs.get(option, False) is not False for option in ("allow_undeclared_parameters", _OVERRIDES)):
                self.collected.use(ParamUse("/", "list", source_file=file, source_line=line))
            if name.startswith("rclpy.create") or _plain(path.removesuffix(".__init__")) in _NODES:
                self._make_node(given(0, "node_name"), kwargs)
                if _IS_LIFECYCLE.search(path):
                    for service, type_ in LIFECYCLE:
                        end = Endpoint("service", service, type_, None, {}, file, line, builtin=True)
                        self.collected.add_endpoint(end)
            return Imported("rclpy.Node()")
        if method in ("trigger_configure", "trigger_activate"):
            self.collected.transition(method.removeprefix("trigger_"))
        if method == "get_parameters_by_prefix":
            self.collected.use(ParamUse("/", "list", source_file=file, source_line=line))
        if method in ("get_name", "get_fully_qualified_name"):
            return self._node.rpartition("/")[2] if method == "get_name" else self._node
        if method == "get_namespace":
            return names.parent(self._node).rstrip("/") or "/"
        if name == "rclpy.QoSProfile":
            return _policies(_all_known(kwargs))
        return Imported(f"{path}()")

    def _make_node(self, name: Any, kwargs: Mapping[str, Any]) -> None:
        if kwargs.get("cli_args") is not None:
            self.collected.unknown_node()  # they may give it another name
            return
        space = kwargs.get("namespace")
        renamed = kwargs.get("use_global_arguments", True) is True
        self.collected.node(name, "" if space is None else space, renamed=renamed)

    def _declared(self, name: Any, default: Any, descriptor: Any, file: str, line: int) -> Any:
        if not isinstance(name, str) or not name:
            self.collected.miss()
            return UNKNOWN
        bare = _bare_type(default)
        has_default = default is not UNKNOWN and default is not None and bare is None
        shown = default if has_default and is_plain(default) else None
        use = ParamUse(f"~{name}", "get", shown, has_default, False, file, line, type=bare)
        described = _described(use, descriptor)
        # What the launch sets is declared by then, with its type.
        self.collected.use(replace(described, dynamic=True) if self._from_overrides else described)
        self._defaults[name] = default if has_default else UNKNOWN
        return _parameter(self._value(name))

    def _declared_all(self, namespace: Any, parameters: Any, file: str, line: int) -> Any:
        prefix = f"{namespace}." if isinstance(namespace, str) and namespace else ""
        if not isinstance(namespace, str) or not isinstance(parameters, (list, tuple)):
            self.collected.miss()
        for each in parameters if isinstance(parameters, (list, tuple)) else ():
            if not isinstance(each, (list, tuple)) or not each or not isinstance(each[0], str):
                self.collected.miss()
            else:
                default = each[1] if len(each) > 1 else UNKNOWN
                self._declared(prefix + each[0], default, each[2] if len(each) > 2 else UNKNOWN, file, line)
        return UNKNOWN

    def _read(self, name: Any, method: str, otherwise: Any) -> Any:
        if not isinstance(name, str):
            return UNKNOWN
        if method == "has_parameter":
            return name in self._defaults or UNKNOWN
        value = self._value(name)
        if method == "get_parameter_or" and known(value) is UNKNOWN:
            return otherwise
        return _parameter(value)

    def _value(self, name: str) -> Any:
        return self._params.later(names.resolve(f"~{name}", self._node), self._defaults.get(name, UNKNOWN))


def _bare_type(value: Any) -> str | None:
    """The type that stands in the place of a default: `Parameter.Type.DOUBLE`."""
    found = _BARE.search(value.path) if isinstance(value, Imported) else None
    return found[1].lower().replace("_", " ") if found else None


def _described(use: ParamUse, descriptor: Any) -> ParamUse:
    """The declaration with what its descriptor says, as far as that is known."""
    about = (
        descriptor.names if isinstance(descriptor, Instance) and descriptor.cls.name == "ParameterDescriptor" else {}
    )
    if not about:
        return use
    found = None
    of_double = use.type == "double" or isinstance(use.default, float)
    ranges = about.get("floating_point_range" if of_double else "integer_range")
    if isinstance(ranges, (list, tuple)) and len(ranges) == 1 and isinstance(ranges[0], Instance):
        bounds = [ranges[0].names.get(field, 0) for field in ("from_value", "to_value", "step")]
        if all(isinstance(bound, (int, float)) for bound in bounds):
            found = Range(*bounds)
    dynamic = about.get("dynamic_typing", False) is not False
    return replace(use, range=found, dynamic=dynamic, read_only=about.get("read_only") is True)


def _parameter(value: Any) -> Instance:
    """An `rclpy.Parameter` with its value, in the ways in which programs ask for it."""
    message = Class("ParameterValue", dict.fromkeys(_VALUE_FIELDS, value), ())
    return Instance(Class("Parameter", {}, ()), {"value": value, "get_parameter_value": message})


def _type(value: Any, kind: str) -> str | None:
    if not isinstance(value, Imported):
        return None
    found = _TYPE.match(value.path)
    return f"{found[1]}/{kind}/{found[3]}" if found and found[2] == kind else None


def _qos(value: Any) -> Mapping[str, Any]:
    """The policies that are known; nothing of a profile that is computed."""
    if isinstance(value, bool):
        return {}
    if isinstance(value, int):
        return {**_RELIABLE, "depth": value}
    if isinstance(value, dict):
        return value
    if isinstance(value, Imported):
        return _PROFILES.get(value.path.rpartition(".")[2], {})
    return {}


def _policies(kwargs: Mapping[str, Any]) -> dict[str, Any]:
    """The arguments of a QoSProfile: `reliability=ReliabilityPolicy.BEST_EFFORT` and their like."""
    found: dict[str, Any] = {}
    for policy, allowed in _POLICIES.items():
        if policy not in kwargs:
            continue
        value = kwargs[policy]
        word = value.path.rpartition(".")[2].lower() if isinstance(value, Imported) else ""
        word = word.removeprefix("rmw_qos_policy_").removeprefix(f"{policy}_")
        found[policy] = word if word in allowed else None
    if isinstance(kwargs.get("depth"), int):
        found["depth"] = kwargs["depth"]
    return {policy: value for policy, value in {**_RELIABLE, **found}.items() if value is not None}


def _all_known(kwargs: Mapping[str, Any]) -> dict[str, Any]:
    return {name: known(value) for name, value in kwargs.items()}


def _plain(path: str) -> str:
    """`rclpy.action.server.ActionServer` is `rclpy.ActionServer`."""
    top, _, rest = path.partition(".")
    return f"{top}.{rest.rpartition('.')[2]}" if top in _LIBRARIES else path


def _has_node(value: Any) -> bool:
    """Whether it is a node, or an object of the program that may have one."""
    if isinstance(value, Message):
        return False
    return isinstance(value, Instance) or (isinstance(value, Imported) and value.path == "rclpy.Node()")
