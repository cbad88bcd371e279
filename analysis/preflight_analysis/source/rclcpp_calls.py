"""What calls of rclcpp and of the libraries beside it make: endpoints with their QoS, and parameters."""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from preflight_analysis.evaluation import names
from preflight_analysis.source import rclcpp_qos
from preflight_analysis.source.cpp_operators import converted, initialized
from preflight_analysis.source.cpp_text import ClassText, FileText
from preflight_analysis.source.cpp_values import (
    Argument,
    Class,
    Constant,
    CppType,
    Fluent,
    Function,
    Instance,
    Place,
    Store,
    Unmade,
    value_at,
    values,
)
from preflight_analysis.source.found import Found
from preflight_analysis.source.known_params import KnownParams
from preflight_analysis.source.parameter_library import Libraries
from preflight_analysis.source.python_values import UNKNOWN, is_plain
from preflight_analysis.source.rclcpp_qos import Qos
from preflight_analysis.source.ways import Ways
from preflight_analysis.tracing.interface import Endpoint, ParamUse, Range, Role

LIBRARIES = frozenset(
    {
        "camera_info_manager",
        "class_loader",
        "diagnostic_updater",
        "image_transport",
        "message_filters",
        "pluginlib",
        "rclcpp",
        "rclcpp_action",
        "rclcpp_components",
        "rclcpp_lifecycle",
        "tf2",
        "tf2_ros",
    }
)
"""The packages whose calls are known here."""

_CONTAINER = "rclcpp_components::ComponentManager"
_NODES: Mapping[str, bool] = {
    "rclcpp::Node": False,
    _CONTAINER: False,
    "rclcpp_lifecycle::LifecycleNode": True,
    "nav2_util::LifecycleNode": True,
    "nav2::LifecycleNode": True,
}
"""The classes of nodes, and whether they have a lifecycle."""
_POINTERS = re.compile(r"::(?:(?:Const)?(?:Shared|Weak|Unique)Ptr)\Z")
_TRANSITIONS = ("on_configure", "on_activate")
_HARMLESS = frozenset({"autoware_utils", "bond", "std", *LIBRARIES})
"""Namespaces of libraries that may get a node and declare none of its parameters in a way not known here."""
_LOADERS = frozenset({"pluginlib::ClassLoader"})

_LIFECYCLE = (
    ("~/change_state", "lifecycle_msgs/srv/ChangeState"),
    ("~/get_state", "lifecycle_msgs/srv/GetState"),
    ("~/get_available_states", "lifecycle_msgs/srv/GetAvailableStates"),
    ("~/get_available_transitions", "lifecycle_msgs/srv/GetAvailableTransitions"),
    ("~/get_transition_graph", "lifecycle_msgs/srv/GetAvailableTransitions"),
)
"""The services that every node with a lifecycle offers."""
_LOADING = tuple(
    (f"~/_container/{name}", f"composition_interfaces/srv/{type_}")
    for name, type_ in (("load_node", "LoadNode"), ("unload_node", "UnloadNode"), ("list_nodes", "ListNodes"))
)
"""The services that every container of components offers."""
_TF = "tf2_msgs/msg/TFMessage"
_LISTENS: tuple[tuple[Role, str, str], ...] = (("subscriber", "/tf", _TF), ("subscriber", "/tf_static", _TF))
_FIXED: Mapping[str, tuple[tuple[Role, str, str], ...]] = {
    "tf2_ros::TransformListener": _LISTENS,
    "tf2_ros::TransformBroadcaster": (("publisher", "/tf", _TF),),
    "tf2_ros::StaticTransformBroadcaster": (("publisher", "/tf_static", _TF),),
    "diagnostic_updater::Updater": (("publisher", "/diagnostics", "diagnostic_msgs/msg/DiagnosticArray"),),
    "camera_info_manager::CameraInfoManager": (("service", "~/set_camera_info", "sensor_msgs/srv/SetCameraInfo"),),
}
_IMAGE, _INFO = "sensor_msgs/msg/Image", "sensor_msgs/msg/CameraInfo"

_METHODS: Mapping[str, tuple[Role, str]] = {
    "create_publisher": ("publisher", "msg"),
    "create_subscription": ("subscriber", "msg"),
    "create_service": ("service", "srv"),
    "create_client": ("client", "srv"),
}
"""Of a node: the role and the kind of its type. The name comes first; topics have their QoS next."""
_GENERIC: Mapping[str, Role] = {"create_generic_publisher": "publisher", "create_generic_subscription": "subscriber"}
_WITH_NODE: Mapping[str, tuple[Role, str]] = {
    "rclcpp::create_publisher": ("publisher", "msg"),
    "rclcpp::create_subscription": ("subscriber", "msg"),
    "rclcpp::create_service": ("service", "srv"),
    "rclcpp::create_client": ("client", "srv"),
    "rclcpp_action::create_server": ("action_server", "action"),
    "rclcpp_action::create_client": ("action_client", "action"),
    "message_filters::Subscriber": ("subscriber", "msg"),
    "autoware_utils::InterProcessPollingSubscriber": ("subscriber", "msg"),
    "nav2_util::SimpleActionServer": ("action_server", "action"),
    "nav2_util::ServiceClient": ("client", "srv"),
}
"""Functions and classes that get a node among their arguments; the name is the first text."""
_IMAGES: Mapping[str, tuple[Role, bool]] = {
    "create_publisher": ("publisher", False),
    "create_subscription": ("subscriber", False),
    "create_camera_publisher": ("publisher", True),
    "create_camera_subscription": ("subscriber", True),
    "advertise": ("publisher", False),
    "subscribe": ("subscriber", False),
    "advertiseCamera": ("publisher", True),
    "subscribeCamera": ("subscriber", True),
}
"""Of image_transport: the role, and whether a camera's info goes with the image."""

_MESSAGE = re.compile(r"(?:::)?([A-Za-z]\w*)::(msg|srv|action)::([A-Za-z]\w*)(?:::|\Z)")
_TYPE_TEXT = re.compile(r"[A-Za-z]\w*/(?:msg|srv|action)/[A-Za-z]\w*\Z")
_HEADER = re.compile(r"([A-Za-z]\w*)/(msg|srv|action)/(?:detail/)?(\w+)\.h(?:pp)?\Z")
_WRAPPERS = frozenset({"shared_ptr", "unique_ptr"})
_DECLARE_FUNCTIONS = frozenset(
    {
        "declare_parameter_if_not_declared",
        "declare_or_get_parameter",
        "get_or_declare_parameter",
        "getOrDeclareParameter",
    }
)
"""Of nav2_util, nav2_ros_common, rclcpp and Autoware: they get the node, then what `declare_parameter` gets."""
_DECLARE = _DECLARE_FUNCTIONS | {"declare_parameter"}
_CONSTANTS = {"bond::msg::Constants::DISABLE_HEARTBEAT_TIMEOUT_PARAM": "bond_disable_heartbeat_timeout"}
_VALUE_OF = re.compile(r"as_\w+\Z|get\Z|get_value\Z")
_ADD_ARGUMENT = "replaceOrAddArgument"
"""Of nav2_util and nav2_ros_common: the arguments of a node in the node's process."""
_ITSELF = frozenset({"shared_from_this", "weak_from_this"})
_OVERRIDES = "automatically_declare_parameters_from_overrides"
_ALL = ("allow_undeclared_parameters", _OVERRIDES)
_ARGUMENT = re.compile(r"(?:\w+:)?__(ns|node|name):=(.*)\Z")


@dataclass(frozen=True, slots=True)
class NodeObject:
    """An object of a node class. `full` is None for the node that the launch file starts, else the full name of a
    further one of its process, UNKNOWN if that is not known."""

    full: Any = None
    below: str = ""
    """The namespace of a sub-node."""
    has_lifecycle: bool = False
    from_overrides: bool = False
    """Whether it declares what the launch sets before its own code does: with any type."""

    def name(self, name: Any) -> Any:
        """The name as the node of the launch file would give it."""
        if not isinstance(name, str) or not name or self.full is UNKNOWN:
            return UNKNOWN
        if name.startswith("/"):
            return name
        if name.startswith("~"):
            return name if self.full is None else names.canonicalize(f"{self.full}/{name[1:]}")
        below = f"{self.below}/{name}" if self.below else name
        return below if self.full is None else names.canonicalize(f"{names.parent(self.full)}/{below}")

    def param(self, name: str) -> Any:
        """The name of a parameter, likewise."""
        return UNKNOWN if self.full is UNKNOWN else f"~{name}" if self.full is None else f"{self.full}/{name}"


@dataclass(frozen=True, slots=True)
class _Options(Fluent):
    """`rclcpp::NodeOptions`: whether the node takes any parameter, and the arguments that it gets of its own."""

    takes_all: bool = False
    from_overrides: bool = False
    arguments: tuple[Any, ...] = ()
    of_process: bool = True
    """Whether the node takes the arguments of its process, too."""


@dataclass(frozen=True, slots=True)
class _Parameter:
    """`rclcpp::Parameter` or its value. `typed`: the value has the type that the parameter has."""

    value: Any
    typed: bool = True
    is_set: bool = True


_UNSET: Any = object()
"""The default of a parameter that is declared without one."""


_RANGES = {"integer": "integer_range", "double": "floating_point_range"}
_TYPE_NAMES = {
    "double": "double",
    "float": "double",
    "int": "integer",
    "int64_t": "integer",
    "std::int64_t": "integer",
    "bool": "bool",
    "std::string": "string",
}
_LIBRARY_TYPES = {
    f"{name}{more}": f"{type_}{' array' if more else ''}"
    for name, type_ in (("bool", "bool"), ("int", "integer"), ("double", "double"), ("string", "string"))
    for more in ("", "_array")
}
"""Of generate_parameter_library, whose types may have a size."""


class RclcppCalls:
    """Collects what the calls of one node make. Implements `cpp_values.Calls`."""

    words = frozenset(
        f"{' '.join((*_METHODS, *_GENERIC, *_IMAGES, *_DECLARE))} create_server declare_parameters get_parameter "
        "get_parameters get_parameter_or get_parameter_types Subscriber SubscriberFilter ImageTransport Node "
        "TransformListener TransformBroadcaster StaticTransformBroadcaster Updater CameraInfoManager LifecycleNode "
        "SimpleActionServer ServiceClient InterProcessPollingSubscriber ClassLoader ParamListener "
        "wait_for_message".split()
    )
    includes: Sequence[str] = ()
    """What the files of the program include."""

    def __init__(
        self, node: str, params: KnownParams, has_type: Callable[[str, str, str], bool], libraries: Libraries
    ) -> None:
        self._node = node
        self._params = params
        self._has_type = has_type
        self._libraries = libraries
        self._structs: dict[str, Instance] = {}
        self._is_aside = False
        self._not_reached: list[ParamUse] = []
        self._declared: dict[str, Any] = {"~use_sim_time": False}
        self.found = Found()

    def begin(self, ways: Ways) -> None:
        """What the walk tries out makes a node only perhaps."""
        self.found.ways = ways

    def aside(self, is_aside: bool) -> bool:
        """A parameter of another mode of the node is no misspelt one: that it has such a name is noted."""
        self._is_aside = is_aside
        return True

    def finish(self) -> None:
        """Add the parameters that are declared only where the node does not come with what the launch file sets."""
        declared = {use.name for use in self.found.params}
        for use in self._not_reached:
            if use.name not in declared:
                self.found.use(use)

    def cut_short(self) -> None:
        """There may be more declarations of parameters, and more nodes."""
        self.found.unknown_node()
        self.found.use(ParamUse("/", "list"))

    def takes(self, owner: Any, name: str, types: Sequence[CppType], args: Sequence[Argument]) -> bool:
        """What declares parameters in the way of a library, and what gives the node itself."""
        if name in _DECLARE_FUNCTIONS or name == _ADD_ARGUMENT:
            return True
        return name in _ITSELF and not args and _node_of(owner) is not None

    def notice(
        self, owner: Instance, name: str, types: Sequence[CppType], args: Sequence[Argument], place: Place
    ) -> None:
        """What a class has in the place of a method of rclcpp makes the same end; here is where it is asked for."""
        node = _node_of(owner)
        role, kind = _METHODS.get(name, ("publisher", ""))
        if node is not None and kind and (type_ := self._first(types, kind)) is not None:
            self._end(role, node.name(value_at(args, 0)), type_, _qos(args[1:]) if kind == "msg" else {}, place)

    # Objects.

    def named(self, name: str) -> Any:
        """Profiles and policies of QoS, and the types of parameters."""
        if name in _CONSTANTS:
            return _CONSTANTS[name]
        leaf = name.rpartition("::")[2]
        if leaf.startswith("PARAMETER_"):
            return Constant(leaf)
        found = rclcpp_qos.named(name)
        return UNKNOWN if found is None else found

    def called_later(self, instance: Instance) -> Sequence[str]:
        """What a lifecycle node does before it works: somebody is taken to activate it."""
        node = _node_of(instance)
        return _TRANSITIONS if node is not None and node.has_lifecycle else ()

    def make(self, type_: CppType, args: Sequence[Argument], place: Place) -> Any:
        """An object of a library's class, and what its constructor makes."""
        name = _qualified(type_)
        given = values(args)
        if name in _NODES:
            node = self._new_node(given, place, has_lifecycle=_NODES[name])
            if name == _CONTAINER:
                self._services(_LOADING, node, place)
            return node
        if (qos := rclcpp_qos.make(name, given)) is not None:
            return qos
        if (message := _message(name)) is not None:
            return message
        match name:
            case "rclcpp::NodeOptions":
                return next((v for v in given if isinstance(v, _Options)), _Options())
            case "rclcpp::ParameterValue" | "rclcpp::Parameter" if args:
                return _parameter(args[-1], None)
            case "image_transport::TransportHints":
                return self._hints(given, place)
            case "image_transport::SubscriberFilter":
                self._image("subscriber", False, args, place)
        if name.endswith("::ParamListener") and self._listener(name, given):
            return Unmade(type_)
        if name in _LOADERS:
            self._any_parameter(place)  # what it loads declares its own
        elif ends := _FIXED.get(name):
            for role, topic, kind in ends:
                self._end(role, _first_node(given).name(topic), kind, {}, place)
            if name == "diagnostic_updater::Updater":
                self._declare(_first_node(given), "diagnostic_updater.period", 1.0, True, place)
                self._declare(_first_node(given), "diagnostic_updater.use_fqn", False, True, place)
        elif name in _WITH_NODE:
            self._with_node(name, type_.args, args, place)
        else:
            self._unknown_library(name, given, place)
            if name.endswith("Node") and any(isinstance(value, str) or _is_options(value) for value in given):
                self._any_parameter(place)  # of a package that is not there in source form
                self.found.unknown_node()
                return NodeObject()
        return Unmade(type_)

    def _new_node(self, given: Sequence[Any], place: Place, *, has_lifecycle: bool) -> NodeObject:
        options = next((v for v in given if isinstance(v, _Options)), _Options())
        node = self._named_node(given, options, has_lifecycle=has_lifecycle)
        node = replace(node, from_overrides=options.from_overrides)
        if not self._is_aside:
            self._make_node(given, options, node)
        if has_lifecycle:
            self._services(_LIFECYCLE, node, place)
        if options.takes_all:
            self._any_parameter(place)
        return node

    def _services(self, services: Sequence[tuple[str, str]], node: NodeObject, place: Place) -> None:
        """The services that a node of the class has by itself."""
        for service, kind in services if not self._is_aside else ():
            self.found.end(
                Endpoint("service", node.name(service), kind, None, {}, place.file, place.line, builtin=True)
            )

    def _make_node(self, given: Sequence[Any], options: _Options, node: NodeObject) -> None:
        if node.full is not None:
            self.found.node(node.full.rpartition("/")[2] if isinstance(node.full, str) else UNKNOWN, renamed=False)
            return
        texts = [value for value in given if isinstance(value, str)]
        if len(texts) != sum(not _is_options(value) and value is not UNKNOWN for value in given) or len(texts) > 2:
            self.found.unknown_node()  # another constructor is meant
            return
        space = given[1] if len(given) > 1 and isinstance(given[1], str) else ""
        # Options that are not known may have arguments of their own.
        renamed = options.of_process and all(isinstance(value, (str, _Options)) for value in given)
        self.found.node(given[0] if given else UNKNOWN, space, renamed=renamed)

    def _named_node(self, given: Sequence[Any], options: _Options, *, has_lifecycle: bool) -> NodeObject:
        """The node, and whether its options give it another name than the launch file's."""
        given_to = [each for before, each in itertools.pairwise(("", *options.arguments)) if before != "-p"]
        if not all(isinstance(argument, str) for argument in given_to):
            return NodeObject(UNKNOWN, has_lifecycle=has_lifecycle)
        found = [match for argument in given_to if (match := _ARGUMENT.match(argument)) is not None]
        if not found:
            return NodeObject(has_lifecycle=has_lifecycle)
        space, name = names.parent(self._node), given[0] if given and isinstance(given[0], str) else UNKNOWN
        for match in found:
            if match[1] == "ns":
                space = match[2]
            else:
                name = match[2]
        full = f"/{space}/{name}" if isinstance(name, str) else UNKNOWN
        return NodeObject(names.canonicalize(full) if isinstance(full, str) else full, has_lifecycle=has_lifecycle)

    def _hints(self, given: Sequence[Any], place: Place) -> Any:
        texts = [value for value in given if isinstance(value, str)]
        default, param = (*texts, *("raw", "image_transport")[len(texts) :])[:2]
        found = self._declare(_first_node(given), param, default, True, place)
        return found if isinstance(found, str) else "raw"

    def _unknown_library(self, name: str, given: Sequence[Any], place: Place) -> None:
        """A library of which nothing is known may declare parameters of a node that it is given."""
        if name.partition("::")[0] not in _HARMLESS and any(_node_of(value) is not None for value in given):
            self._any_parameter(place)

    # Calls.

    def function(
        self, name: str, types: Sequence[CppType], args: Sequence[Argument], place: Place, store: Store
    ) -> Any:
        """Note what a free function makes; its value where it has one that is known."""
        name = name.removeprefix("::")
        space, _, leaf = name.rpartition("::")
        if (message := _message(name)) is not None:
            return message
        if name in _WITH_NODE:
            self._with_node(name, types, args, place)
            return UNKNOWN
        if space == "image_transport" and leaf in _IMAGES:
            role, with_info = _IMAGES[leaf]
            self._image(role, with_info, args, place)
            return UNKNOWN
        if leaf in _DECLARE_FUNCTIONS:
            at = next((i for i, arg in enumerate(args[:2]) if _node_of(arg.value) is not None), 0)
            return self._declare_call(_first_node(values(args)), types, args[at + 1 :], place)
        if leaf == _ADD_ARGUMENT:
            known, option, new = value_at(args, 0), value_at(args, 1), value_at(args, 3)
            store(args[0], [*known, option, new] if isinstance(known, list) else UNKNOWN)
            return UNKNOWN
        if name == "rclcpp::wait_for_message":
            text = next((v for v in values(args) if isinstance(v, str)), UNKNOWN)
            message = value_at(args, 0)
            type_ = self._type(message.type, "msg") if isinstance(message, Unmade) else None
            self._end("subscriber", _first_node(values(args)).name(text), type_ or self._first(types, "msg"), {}, place)
            return UNKNOWN
        if name == "rclcpp::init_and_remove_ros_arguments":
            return value_at(args, 1)
        known = name in _NODES or name in _FIXED or name.startswith(("rclcpp::", "image_transport::"))
        if known or rclcpp_qos.make(name, ()) is not None:
            return self.make(CppType(name, tuple(types)), args, place)
        self._unknown_library(name, values(args), place)
        return UNKNOWN

    def method(
        self,
        owner: Any,
        name: str,
        types: Sequence[CppType],
        args: Sequence[Argument],
        place: Place,
        store: Store,
    ) -> Any:
        """Note what a method makes; its value where it has one that is known."""
        if isinstance(owner, Qos):
            return rclcpp_qos.changed(owner, name, values(args))
        if isinstance(owner, _Options) and name == "arguments" and not args:
            return list(owner.arguments)
        if isinstance(owner, _Options):
            return _changed(owner, name, args)
        if isinstance(owner, _Parameter):
            if _VALUE_OF.match(name):
                return converted(owner.value, types[0] if types else None)
            if name == "get_type" and not owner.is_set:
                return Constant("PARAMETER_NOT_SET")
            return owner if name == "get_parameter_value" else UNKNOWN
        node = _node_of(owner)
        if node is not None:
            return self._of_node(owner, node, name, types, args, place, store)
        if isinstance(owner, Unmade):
            return self._of_made(owner, name, args, place)
        return UNKNOWN

    def _of_made(self, owner: Unmade, name: str, args: Sequence[Argument], place: Place) -> Any:
        kind = _qualified(owner.type)
        if name == "get_params" and kind in self._structs:
            return self._structs[kind]
        if kind == "image_transport::ImageTransport" and name in _IMAGES:
            role, with_info = _IMAGES[name]
            self._image(role, with_info, args, place)
        elif kind == "image_transport::SubscriberFilter" and name == "subscribe":
            self._image("subscriber", False, args, place)
        elif kind == "image_transport::TransportHints" and name == "getTransport":
            return UNKNOWN
        elif kind == "message_filters::Subscriber" and name == "subscribe":
            self._with_node(kind, owner.type.args, args, place)
        else:
            self._unknown_library(kind, values(args), place)
        return UNKNOWN

    def _of_node(
        self,
        owner: Any,
        node: NodeObject,
        name: str,
        types: Sequence[CppType],
        args: Sequence[Argument],
        place: Place,
        store: Store,
    ) -> Any:
        first = value_at(args, 0)
        if name in _METHODS:
            role, kind = _METHODS[name]
            type_ = self._first(types, kind) or (self._heard(args) if role == "subscriber" else None)
            self._end(role, node.name(first), type_, _qos(args[1:]) if kind == "msg" else {}, place)
            return Unmade(CppType("rclcpp::Publisher")) if role == "publisher" else UNKNOWN
        if name in _GENERIC:
            type_text = value_at(args, 1)
            known = type_text if isinstance(type_text, str) and _TYPE_TEXT.match(type_text) else None
            self._end(_GENERIC[name], node.name(first), known, rclcpp_qos.of(value_at(args, 2)), place)
            return UNKNOWN
        if name in _DECLARE:
            return self._declare_call(node, types, args, place)
        match name:
            case "declare_parameters":
                self._declare_all(node, types, args, place)
            case "get_parameter" | "get_parameter_or":
                return self._read(node, name, types, args, place, store)
            case "list_parameters":
                self._any_parameter(place)
            case "has_parameter":
                return True if isinstance(first, str) and node.param(first) in self._declared else UNKNOWN
            case "get_name":
                return UNKNOWN if node.full is UNKNOWN else (node.full or self._node).rpartition("/")[2]
            case "get_fully_qualified_name":
                return node.full or self._node
            case "get_namespace" | "get_effective_namespace":
                space = names.parent(node.full or self._node) if node.full is not UNKNOWN else UNKNOWN
                return (space.rstrip("/") or "/") if isinstance(space, str) else UNKNOWN
            case "resolve_topic_name" | "resolve_service_name" | "resolve_topic_or_service_name":
                return node.name(first)
            case "create_sub_node":
                below = first if isinstance(first, str) else ""
                return NodeObject(node.full if below else UNKNOWN, f"{node.below}/{below}".strip("/"))
            case _ if name in _ITSELF or name == "lock":
                return owner
            case _ if name.startswith("get_node_") and name.endswith("_interface"):
                return owner
        return UNKNOWN

    def _with_node(self, name: str, types: Sequence[CppType], args: Sequence[Argument], place: Place) -> None:
        """An end of a function or class that gets the node as an argument."""
        role, kind = _WITH_NODE[name]
        at = next((i for i, arg in enumerate(args) if isinstance(arg.value, str)), None)
        if at is None:
            return  # made without a name, or of one that is not known
        qos = _qos(args[at + 1 :]) if kind == "msg" else {}
        self._end(role, _first_node(values(args)).name(args[at].value), self._first(types, kind), qos, place)

    def _image(self, role: Role, with_info: bool, args: Sequence[Argument], place: Place) -> None:
        """By the transport that is known: each has a topic of its own below the image's."""
        given = values(args)
        texts = [value for value in given if isinstance(value, str)]
        if not texts:
            return
        node, topic = _first_node(given), texts[0]
        qos = next((rclcpp_qos.of(v) for v in given if isinstance(v, Qos)), {})
        transport = texts[1] if len(texts) > 1 else "raw"
        if role == "subscriber" and transport != "raw":
            kind = "sensor_msgs/msg/CompressedImage" if transport == "compressed" else None
            self._end(role, node.name(f"{topic}/{transport}"), kind, qos, place)
        else:
            self._end(role, node.name(topic), _IMAGE, qos, place)
        if with_info:
            info = f"{topic.rpartition('/')[0]}/camera_info" if "/" in topic else "camera_info"
            self._end(role, node.name(info), _INFO, qos, place)

    # Parameters.

    def _listener(self, name: str, given: Sequence[Any]) -> bool:
        """The parameters of a class that generate_parameter_library makes. False if its file is not there."""
        library = self._libraries(name.rpartition("::")[0], self.includes)
        if library is None:
            return False
        node = _first_node(given)
        prefix = next((value.rstrip(".") + "." for value in given if isinstance(value, str) and value), "")
        struct = self._structs[name] = _struct()
        for param in library.params:
            place = Place(param.file, param.line)
            default = _of_type(param.default, param.type)
            type_ = _LIBRARY_TYPES.get(re.sub(r"_fixed_\d+\Z", "", param.type))
            about = ParamUse("", "get", type=type_, read_only=param.read_only, range=param.range)
            value = self._declare(node, prefix + param.name, default, param.has_default, place, about=about)
            *groups, leaf = param.name.split(".")
            inner = struct
            for group in groups:
                inner = inner.names.setdefault(group, _struct())
            inner.names[leaf] = UNKNOWN if value is _UNSET else value
        if not library.complete:
            self._any_parameter(Place(library.params[0].file if library.params else "", 1))
        return True

    def _declare_call(self, node: NodeObject, types: Sequence[CppType], args: Sequence[Argument], place: Place) -> Any:
        name = value_at(args, 0)
        if not isinstance(name, str) or not name:
            self._any_parameter(place)
            return UNKNOWN
        type_ = types[0] if types else None
        has_default = len(args) > 1 and not isinstance(args[1].value, Constant) and not _is_descriptor(args[1].value)
        default = _parameter(args[1], type_) if has_default else _Parameter(UNKNOWN)
        about = _described(args, type_)
        found = self._declare(node, name, default.value, has_default, place, typed=default.typed, about=about)
        of_value = len(args) > 1 and isinstance(args[1].value, (_Parameter, Constant))
        if of_value and type_ is None:
            return _of(found)
        return UNKNOWN if found is _UNSET else converted(found, type_)

    def _declare_all(self, node: NodeObject, types: Sequence[CppType], args: Sequence[Argument], place: Place) -> None:
        space, given = value_at(args, 0), value_at(args, 1)
        pairs = list(given.items()) if isinstance(given, dict) else given
        if not isinstance(space, str) or not isinstance(pairs, list):
            self._any_parameter(place)
            return
        for pair in pairs:
            if not isinstance(pair, (list, tuple)) or not pair or not isinstance(pair[0], str):
                self._any_parameter(place)
                continue
            name = f"{space}.{pair[0]}" if space else pair[0]
            value = pair[1] if len(pair) > 1 else UNKNOWN
            value = value[0] if isinstance(value, list) and len(value) == 2 and isinstance(value[1], Unmade) else value
            default = _parameter(Argument(value), types[0] if types else None)
            self._declare(node, name, default.value, True, place)

    def _declare(
        self,
        node: NodeObject,
        name: str,
        default: Any,
        has_default: bool,
        place: Place,
        *,
        typed: bool = True,
        about: ParamUse | None = None,
    ) -> Any:
        """Note a declaration; the value that the parameter has then. `about` has what its descriptor says."""
        full = node.param(name)
        if full is UNKNOWN:
            self._any_parameter(place)  # it may be the node that the launch file starts
            return UNKNOWN
        known = default if has_default and typed and is_plain(default) else None
        use = replace(
            about or ParamUse("", "get"),
            name=full,
            default=known,
            has_default=has_default,
            source_file=place.file,
            source_line=place.line,
        )
        if node.from_overrides:
            use = replace(use, dynamic=True)
        if self._is_aside:
            self._not_reached.append(use)
            return UNKNOWN
        self.found.use(use)
        self._declared[full] = default if has_default else _UNSET
        return self._value(full)

    def _read(
        self,
        node: NodeObject,
        name: str,
        types: Sequence[CppType],
        args: Sequence[Argument],
        place: Place,
        store: Store,
    ) -> Any:
        """`get_parameter("x")`, which gives it, or `get_parameter("x", variable)`, which tells whether it is there."""
        param, into = value_at(args, 0), args[1] if len(args) > 1 else None
        or_else = name == "get_parameter_or"
        full = node.param(param) if isinstance(param, str) and param else UNKNOWN
        found: Any = UNKNOWN
        if isinstance(full, str):
            found = self._value(full)
            if full not in self._declared:
                self.found.use(ParamUse(full, "get", None, False, False, place.file, place.line))
        if or_else and (found is UNKNOWN or found is _UNSET):
            found = value_at(args, len(args) - 1)
        if into is None or (or_else and len(args) == 2):
            return found if or_else else _of(found)
        if found is _UNSET:
            return False
        if isinstance(into.value, float):
            found = converted(found, CppType("double"))
        of_parameter = isinstance(into.value, _Parameter) or (
            isinstance(into.value, Unmade) and _qualified(into.value.type) == "rclcpp::Parameter"
        )
        store(into, _of(found) if of_parameter else found)
        return True if full in self._declared else UNKNOWN

    def _value(self, full: str) -> Any:
        """What the launch sets, else what was declared."""
        found = self._params.look(names.resolve(full, self._node))
        default = self._declared.get(full, UNKNOWN)
        if found is UNKNOWN:
            return default
        return converted(found, CppType("double")) if isinstance(default, float) else found

    def _any_parameter(self, place: Place) -> None:
        """The node takes parameters of any name, or of names that the text does not tell."""
        self.found.use(ParamUse("/", "list", source_file=place.file, source_line=place.line))

    # Names and types.

    def _end(self, role: Role, name: Any, type_: str | None, qos: Mapping[str, Any], place: Place) -> None:
        if not self._is_aside:
            self.found.end(Endpoint(role, name, type_, None, qos, place.file, place.line))

    def _first(self, types: Sequence[CppType], kind: str) -> str | None:
        return self._type(types[0], kind) if types else None

    def _heard(self, args: Sequence[Argument]) -> str | None:
        """What the callback among the arguments takes."""
        callback = next((v for v in values(args[1:]) if isinstance(v, Function)), None)
        first = callback.parameters[0] if callback is not None and callback.parameters else None
        return self._type(first, "msg") if first is not None else None

    def _type(self, type_: CppType, kind: str) -> str | None:
        """`pkg/msg/Name` of a class that messages, services or actions are made of."""
        name = _POINTERS.sub("", type_.name.removeprefix("::"))
        leaf = name.rpartition("::")[2]
        if leaf in _WRAPPERS and type_.args:
            return self._type(type_.args[0], kind)
        if leaf == "TypeAdapter" and len(type_.args) == 2:
            return self._type(type_.args[1], kind)
        found = _MESSAGE.match(name)
        if found is not None:
            return f"{found[1]}/{kind}/{found[3]}" if found[2] == kind else None
        if type_.file is None or "::" in name.removeprefix(f"{kind}::"):
            return None
        # Its namespace is used or around; the header that has it tells which.
        header = _header(leaf)
        for includes in (type_.file.includes, self.includes):
            matches = (_HEADER.match(include) for include in includes)
            packages = {m[1] for m in matches if m is not None and m[2] == kind and m[3] == header}
            if packages:
                return f"{packages.pop()}/{kind}/{leaf}" if len(packages) == 1 else None
        used = dict.fromkeys(path[0] for path in type_.file.namespaces if path)
        having = [package for package in used if self._has_type(package, kind, leaf)]
        return f"{having[0]}/{kind}/{leaf}" if len(having) == 1 else None


def _qos(args: Sequence[Argument]) -> Mapping[str, Any]:
    """What the arguments after the name ask for: a depth stands first, a profile may stand elsewhere."""
    given = values(args)
    profile = next((value for value in given if isinstance(value, Qos)), None)
    return rclcpp_qos.of(profile if profile is not None else value_at(args, 0))


def _qualified(type_: CppType) -> str:
    """The name of a type with the namespace that is used where it stands, for those of nodes."""
    name = _POINTERS.sub("", type_.name.removeprefix("::"))
    if "::" not in name and type_.file is not None:
        for space in type_.file.namespaces:
            if (full := "::".join((*space, name))) in _NODES:
                return full
    return name


def _node_of(value: Any) -> NodeObject | None:
    """The node that a value is or points to, None if it is none."""
    if isinstance(value, NodeObject):
        return value
    if isinstance(value, Instance):
        return next((base for base in value.bases if isinstance(base, NodeObject)), None)
    if isinstance(value, Unmade):
        name = _qualified(value.type)
        if name in _NODES or name.startswith("rclcpp::node_interfaces::Node"):
            return NodeObject()
    return None


def _first_node(given: Sequence[Any]) -> NodeObject:
    """The node among the arguments; the one that is started where none can be told."""
    return next((node for value in given if (node := _node_of(value)) is not None), NodeObject())


def _of(found: Any) -> _Parameter:
    """The parameter that has a value, or none."""
    return _Parameter(UNKNOWN, is_set=False) if found is _UNSET else _Parameter(found)


def _parameter(argument: Argument, type_: CppType | None) -> _Parameter:
    """The value of a parameter as an argument gives it.

    Of a whole number in a variable the type is not known: what is written `double x = 1;` elsewhere is one too.
    """
    value = argument.value
    if isinstance(value, _Parameter):
        return _Parameter(converted(value.value, type_), value.typed)
    if type_ is None:
        whole = isinstance(value, int) and not isinstance(value, bool)
        return _Parameter(value, not (whole and argument.reference is not None))
    if isinstance(value, list) and type_.args:
        return _Parameter([converted(each, type_.args[0]) for each in value])
    return _Parameter(initialized(value, type_))


def _is_options(value: Any) -> bool:
    return isinstance(value, _Options) or (isinstance(value, Unmade) and value.type.name == "rclcpp::NodeOptions")


def _is_descriptor(value: Any) -> bool:
    return isinstance(value, Instance) and value.cls.text.name == "ParameterDescriptor"


def _struct(name: str = "Params") -> Instance:
    """A struct whose fields are known and nothing else of it."""
    return Instance(Class(ClassText(name, (), (), (), (), FileText(""), 0), {}))


def _message(name: str) -> Instance | None:
    """A message that describes a parameter."""
    space, _, name = name.rpartition("::")
    if space != "rcl_interfaces::msg" or name not in ("ParameterDescriptor", "IntegerRange", "FloatingPointRange"):
        return None
    made = _struct(name)
    if name == "ParameterDescriptor":
        made.names.update((field, []) for field in _RANGES.values())
    return made


def _described(args: Sequence[Argument], type_: CppType | None) -> ParamUse:
    """What a declaration says of the parameter beyond its default: a type without one, and a descriptor."""
    use = ParamUse("", "get")
    given = value_at(args, 1)
    if isinstance(given, Constant) and given.name.startswith("PARAMETER_") and given.name != "PARAMETER_NOT_SET":
        use = replace(use, type=given.name.removeprefix("PARAMETER_").lower().replace("_", " "))
    elif type_ is not None and (len(args) < 2 or _is_descriptor(given)):
        use = replace(use, type=_TYPE_NAMES.get(type_.name))
    about: Mapping[str, Any] = next((arg.value.names for arg in args if _is_descriptor(arg.value)), {})
    # Only the range of the parameter's own type counts, which is not known here: that of both is none.
    ranges = [each for name in _RANGES.values() if isinstance(about.get(name), list) for each in about[name]]
    found = None
    if len(ranges) == 1 and isinstance(ranges[0], Instance):
        ends = [ranges[0].names.get(field, 0) for field in ("from_value", "to_value", "step")]
        found = Range(*ends) if all(isinstance(end, (int, float)) for end in ends) else None
    dynamic = about.get("dynamic_typing", False) is not False
    return replace(use, dynamic=dynamic, read_only=about.get("read_only") is True, range=found)


def _of_type(value: Any, type_: str) -> Any:
    """A default of a YAML file as the parameter has it, which is of the type `type_` (`double_array_fixed_3`)."""
    kind = CppType(type_.partition("_")[0])
    return [converted(each, kind) for each in value] if isinstance(value, list) else converted(value, kind)


def _changed(options: _Options, name: str, args: Sequence[Argument]) -> Any:
    """Options of a node after a call of one of their methods."""
    first = value_at(args, 0)
    if not args:
        return UNKNOWN
    if name in _ALL:
        wanted = first is not False
        from_overrides = wanted if name == _OVERRIDES else options.from_overrides
        return replace(options, takes_all=options.takes_all or wanted, from_overrides=from_overrides)
    if name == "arguments":
        given = tuple(first) if isinstance(first, list) else (UNKNOWN,)
        return replace(options, arguments=given)
    if name == "use_global_arguments":
        return replace(options, of_process=first is True)
    return options


def _header(name: str) -> str:
    """The file of a message's header, as rosidl makes it of its name."""
    parts = re.sub(r"(.)([A-Z][a-z]+)", r"\1_\2", name)
    return re.sub(r"([a-z0-9])([A-Z])", r"\1_\2", parts).lower()
