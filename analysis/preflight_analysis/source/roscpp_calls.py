"""What calls of roscpp and of the libraries beside it make: endpoints and parameter uses."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from preflight_analysis.evaluation import names
from preflight_analysis.source.collector import Collector, is_name
from preflight_analysis.source.config_params import Config
from preflight_analysis.source.cpp_operators import initialized
from preflight_analysis.source.cpp_values import (
    Argument,
    CppType,
    Function,
    Instance,
    Place,
    Store,
    Unmade,
    value_at,
    values,
)
from preflight_analysis.source.known_params import KnownParams
from preflight_analysis.source.python_values import UNKNOWN, is_plain
from preflight_analysis.tracing.interface import Endpoint, ParamUse, Role

LIBRARIES = frozenset(
    {
        "actionlib",
        "camera_info_manager",
        "diagnostic_updater",
        "dynamic_reconfigure",
        "image_transport",
        "interactive_markers",
        "message_filters",
        "nodelet",
        "pluginlib",
        "realtime_tools",
        "ros",
        "tf",
        "tf2",
        "tf2_ros",
        "topic_tools",
        "urdf",
    }
)
"""The packages whose calls are known here."""

_TF = "tf2_msgs/TFMessage"
_IMAGE, _INFO = "sensor_msgs/Image", "sensor_msgs/CameraInfo"
_LISTENS: tuple[tuple[Role, str, str], ...] = (("subscriber", "/tf", _TF), ("subscriber", "/tf_static", _TF))
_HANDLE = "ros::NodeHandle"

_FIXED: Mapping[str, tuple[tuple[Role, str, str], ...]] = {
    "tf::TransformListener": _LISTENS,
    "tf2_ros::TransformListener": _LISTENS,
    "tf::TransformBroadcaster": (("publisher", "/tf", _TF),),
    "tf2_ros::TransformBroadcaster": (("publisher", "/tf", _TF),),
    "tf2_ros::StaticTransformBroadcaster": (("publisher", "/tf_static", _TF),),
    "diagnostic_updater::Updater": (("publisher", "/diagnostics", "diagnostic_msgs/DiagnosticArray"),),
}
_AT_HANDLE: Mapping[str, tuple[str, tuple[tuple[Role, str, str], ...]]] = {
    "dynamic_reconfigure::Server": (
        "~",
        (
            ("service", "set_parameters", "dynamic_reconfigure/Reconfigure"),
            ("publisher", "parameter_descriptions", "dynamic_reconfigure/ConfigDescription"),
            ("publisher", "parameter_updates", "dynamic_reconfigure/Config"),
        ),
    ),
    "camera_info_manager::CameraInfoManager": (
        "",
        (("service", "set_camera_info", "sensor_msgs/SetCameraInfo"),),
    ),
}
"""The namespace where no handle is given, and what is made in that of the handle."""

_ACTIONS: Mapping[str, Role] = {
    "actionlib::SimpleActionServer": "action_server",
    "actionlib::ActionServer": "action_server",
    "actionlib::SimpleActionClient": "action_client",
    "actionlib::ActionClient": "action_client",
}
_MARKERS: tuple[tuple[Role, str, str], ...] = (
    ("publisher", "update", "visualization_msgs/InteractiveMarkerUpdate"),
    ("publisher", "update_full", "visualization_msgs/InteractiveMarkerInit"),
    ("subscriber", "feedback", "visualization_msgs/InteractiveMarkerFeedback"),
)
_LOADER = (
    ("load_nodelet", "nodelet/NodeletLoad"),
    ("unload_nodelet", "nodelet/NodeletUnload"),
    ("list", "nodelet/NodeletList"),
)
_NODELET_HANDLES = {
    "getNodeHandle": "",
    "getMTNodeHandle": "",
    "getPrivateNodeHandle": "~",
    "getMTPrivateNodeHandle": "~",
}
_PARAMS = {
    "param": "get",
    "getParam": "get",
    "getParamCached": "get",
    "hasParam": "has",
    "searchParam": "search",
    "setParam": "set",
    "deleteParam": "delete",
    "get": "get",
    "getCached": "get",
    "has": "has",
    "search": "search",
    "set": "set",
    "del": "delete",
}
_FREE_PARAMS = frozenset({"param", "get", "getCached", "has", "search", "set", "del"})
_WRAPPERS = frozenset({"shared_ptr", "MessageEvent", "ServiceEvent", "Ptr", "ConstPtr"})
_SUFFIX = re.compile(r"(?<=\w)(?:ConstPtr|Ptr|ConstWeakPtr|_)\Z")
_HALF = re.compile(r"::(?:Request|Response)\Z|(?<=\w)(?:Request|Response)\Z")
_TYPE = re.compile(r"(?:::)?([A-Za-z]\w*)::([A-Za-z]\w*)\Z")
_HEADER = re.compile(r"([A-Za-z]\w*)/([A-Za-z]\w*)\.h\Z")
_ANY_MESSAGE = frozenset({"topic_tools::ShapeShifter", "ShapeShifter"})
_MAX_NODELETS = 20
_NO_PACKAGES = frozenset({"std", "boost", "ros", "Eigen", "cv", "tf", "tf2"})


@dataclass(frozen=True, slots=True)
class Handle:
    """A `ros::NodeHandle` by its namespace as the node gave it, UNKNOWN if that is not known."""

    space: Any

    def name(self, name: Any) -> Any:
        """What the node calls `name` in the namespace of the handle."""
        if not isinstance(name, str) or not name:
            return UNKNOWN
        if name.startswith("~"):
            return _private(name)
        if not isinstance(self.space, str):
            return name if name.startswith("/") else UNKNOWN
        return names.canonicalize(names.join(self.space, name))


@dataclass(frozen=True, slots=True)
class _Made:
    """An object of a library: its type and the handle that it works with."""

    type: CppType
    handle: Handle


@dataclass(frozen=True, slots=True)
class _Options:
    """`ros::AdvertiseOptions` and the like."""

    name: Any
    type: str | None


@dataclass(frozen=True, slots=True)
class Loaded:
    """A nodelet that a program loads: `plugin` is `package/Type`, `remaps` maps resolved names to resolved names."""

    name: str
    plugin: str
    remaps: Mapping[str, str]


class RoscppCalls:
    """Collects what the calls of one node make. Implements `cpp_values.Calls`."""

    words = frozenset(
        f"NodeHandle getNodeHandle getMTNodeHandle getPrivateNodeHandle getMTPrivateNodeHandle {' '.join(_PARAMS)} "
        "advertise advertiseCamera advertiseService subscribe subscribeCamera serviceClient createClient call "
        "waitForService waitForMessage ImageTransport SubscriberFilter Subscriber RealtimePublisher Loader "
        "TransformListener TransformBroadcaster StaticTransformBroadcaster Updater Server CameraInfoManager "
        "SimpleActionServer SimpleActionClient ActionServer ActionClient InteractiveMarkerServer".split()
    ) - {"get", "set", "has"} | {"ros"}
    includes: Sequence[str] = ()
    """What the files of the program include."""

    def __init__(
        self,
        node: str,
        remaps: Mapping[str, str],
        params: KnownParams,
        has_type: Callable[[str, str, str], bool],
        config: Config,
    ) -> None:
        self._node = node
        self._remaps = remaps
        self._params = params
        self._has_type = has_type
        self._config = config
        self.collected = Collector()
        self.nodelets: list[Loaded] = []
        """The nodelets that the program loads into its own process."""
        self.loaded: Loaded | None = None
        """The one of them whose calls are collected."""

    def cut_short(self) -> None:
        """Nothing: what is found is never taken for all."""

    def notice(self, *_: object) -> None:
        """Nothing: the method is gone through."""

    def begin(self, _: object) -> None:
        """Nothing: all branches count alike."""

    def dead_code(self, _: bool) -> bool:
        """No."""
        return False

    def takes(self, *_: object) -> bool:
        """No."""
        return False

    # Objects.

    def named(self, _: str) -> Any:
        """Nothing: no name of roscpp decides what a node makes."""
        return UNKNOWN

    def called_later(self, _: Instance) -> Sequence[str]:
        """None: a nodelet's `onInit` is what its walk starts with."""
        return ()

    def make(self, type_: CppType, args: Sequence[Argument], place: Place) -> Any:
        """An object of a library's class, and what its constructor makes."""
        name = type_.name.removeprefix("::")
        given = values(args)
        handle = next((v for v in given if isinstance(v, (Handle, Unmade)) and _is_handle(v)), None)
        known = _handle(handle)
        if name == _HANDLE:
            return self._new_handle(given)
        if name in ("ros::M_string", "nodelet::M_string"):
            return {}
        if name in ("ros::V_string", "nodelet::V_string"):
            return []
        if endpoints := _FIXED.get(name):
            for role, topic, kind in endpoints:
                self._endpoint(role, topic, kind, place)
        elif fixed := _AT_HANDLE.get(name):
            space, endpoints = fixed
            within = known if handle is not None else Handle(space)
            for role, topic, kind in endpoints:
                self._endpoint(role, within.name(topic), kind, place)
            self._configured(type_, within)
        elif action := _ACTIONS.get(name):
            self._endpoint(action, known.name(_first_text(given)), self._argument_type(type_, 0), place)
        elif name == "image_transport::TransportHints":
            return self._hints(given, known, place)
        elif name == "interactive_markers::InteractiveMarkerServer":
            base = value_at(args, 0)
            for role, topic, kind in _MARKERS:
                self._endpoint(role, f"{base}/{topic}" if isinstance(base, str) else UNKNOWN, kind, place)
        elif name == "nodelet::Loader" and value_at(args, 0) is not False:
            for service, kind in _LOADER:
                self._endpoint("service", (known if handle is not None else Handle("~")).name(service), kind, place)
        elif name in ("message_filters::Subscriber", "image_transport::SubscriberFilter"):
            made = _Made(type_, known)
            self._filter(made, given, place)
            return made
        elif name == "realtime_tools::RealtimePublisher" and args:
            self._endpoint("publisher", known.name(_first_text(given)), self._argument_type(type_, 0), place)
        return _Made(type_, known) if name.startswith("image_transport::") else Unmade(type_)

    def _configured(self, type_: CppType, handle: Handle) -> None:
        """The parameters of a dynamic_reconfigure server."""
        config = type_.args[0] if type_.name.endswith("dynamic_reconfigure::Server") and type_.args else None
        kind = self._type(config) if config is not None else None
        if kind is None or not kind.endswith("Config"):
            return
        package, _, name = kind.removesuffix("Config").partition("/")
        for param in self._config(package, name):
            self._param("get", handle.name(param.name), param.default, True, Place(param.file, param.line))

    def _new_handle(self, given: Sequence[Any]) -> Handle:
        parent = Handle("")
        if given and _is_handle(given[0]):
            parent = _handle(given[0])
            given = given[1:]
        if not given or isinstance(given[0], (dict, list)):
            return parent
        space = given[0]
        if not isinstance(space, str):
            return Handle(UNKNOWN)
        if space.startswith("~"):
            return Handle(_private(space))
        return Handle(parent.name(space)) if space else parent

    def _hints(self, given: Sequence[Any], handle: Handle, place: Place) -> Any:
        default = given[0] if given and isinstance(given[0], str) else "raw"
        within = handle if any(_is_handle(v) for v in given) else Handle("~")
        found = self._param("get", within.name("image_transport"), default, True, place)
        return found if isinstance(found, str) else "raw"

    def _filter(self, made: _Made, given: Sequence[Any], place: Place) -> None:
        if made.type.name == "image_transport::SubscriberFilter":
            transport = next((v for v in given if isinstance(v, _Made)), None)
            if transport is not None:
                self._image("subscriber", transport.handle.name(_first_text(given)), given, place)
        elif given:
            handle = _handle(next((v for v in given if _is_handle(v)), None))
            self._endpoint("subscriber", handle.name(_first_text(given)), self._argument_type(made.type, 0), place)

    # Calls.

    def function(
        self, name: str, types: Sequence[CppType], args: Sequence[Argument], place: Place, store: Store
    ) -> Any:
        """Note what a free function makes; its value where it has one that is known."""
        name = name.removeprefix("::")
        first = value_at(args, 0)
        space, _, leaf = name.rpartition("::")
        match name:
            case "ros::this_node::getName":
                return self._node
            case "ros::this_node::getNamespace":
                return names.parent(self._node).rstrip("/") or "/"
            case "ros::names::clean" if isinstance(first, str):
                return names.canonicalize(first)
            case "ros::names::append" if isinstance(first, str):
                second = value_at(args, 1)
                return names.canonicalize(f"{first}/{second}") if isinstance(second, str) else UNKNOWN
            case "ros::names::remap":
                found = self._resolved(first)
                return found if found in self._remaps.values() else first
            case "ros::removeROSArgs" if isinstance(value_at(args, 1), list):
                store(args[-1], list(args[1].value))
                return UNKNOWN
            case "ros::names::resolve":
                last = value_at(args, len(args) - 1)
                asked = last if isinstance(last, str) else first
                return self._resolved(asked)
            case "ros::topic::waitForMessage":
                handle = _handle(next((v for v in values(args) if _is_handle(v)), None))
                self._endpoint("subscriber", handle.name(first), self._message(types), place)
                return UNKNOWN
            case "ros::service::waitForService" | "ros::service::exists":
                if leaf == "waitForService":
                    self.collected.await_service(Endpoint("client", first, None, None, {}, place.file, place.line))
                return UNKNOWN
            case "ros::service::call":
                self._endpoint("client", first, self._service_of(value_at(args, 1)), place)
                return UNKNOWN
            case "ros::service::createClient":
                self._endpoint("client", first, self._message(types), place)
                return UNKNOWN
        if space == "ros::param" and leaf in _FREE_PARAMS:
            return self._param_call(_PARAMS[leaf], Handle(""), leaf == "param", types, args, place, store)
        if space in ("ros::AdvertiseOptions", "ros::SubscribeOptions", "ros::AdvertiseServiceOptions"):
            return _Options(first, self._message(types))
        known = name in _FIXED or name in _AT_HANDLE or name in _ACTIONS or name == _HANDLE
        if known or name.startswith(("image_transport::", "message_filters::")):
            return self.make(CppType(name, tuple(types)), args, place)
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
        if isinstance(owner, Instance):
            space = _NODELET_HANDLES.get(name)
            if space is not None:
                return Handle(self._private() if space == "~" else space)
            return self._node if name == "getName" else UNKNOWN
        if _is_handle(owner):
            return self._of_handle(_handle(owner), name, types, args, place, store)
        if isinstance(owner, _Made):
            return self._of_made(owner, name, args, place)
        if isinstance(owner, Unmade) and owner.type.name == "nodelet::Loader" and name == "load":
            loaded, plugin, remaps = (value_at(args, index) for index in range(3))
            if isinstance(loaded, str) and isinstance(plugin, str) and len(self.nodelets) < _MAX_NODELETS:
                self.nodelets.append(Loaded(loaded, plugin, self._remaps_of(remaps)))
        if isinstance(owner, Unmade) and name == "advertise" and owner.type.name in _ANY_MESSAGE:
            handle = value_at(args, 0)
            topic = _handle(handle).name(value_at(args, 1)) if _is_handle(handle) else UNKNOWN
            self._endpoint("publisher", topic, None, place)
        if (
            isinstance(owner, Unmade)
            and owner.type.name == "urdf::Model"
            and name in ("initParam", "initParamWithNodeHandle")
        ):
            first = value_at(args, 0)
            self._param("get", first if is_name(first) else UNKNOWN, UNKNOWN, False, place)
        return UNKNOWN

    def _of_handle(
        self,
        handle: Handle,
        name: str,
        types: Sequence[CppType],
        args: Sequence[Argument],
        place: Place,
        store: Store,
    ) -> Any:
        first = value_at(args, 0)
        topic = handle.name(first)
        match name:
            case "advertise":
                if isinstance(first, _Options):
                    self._endpoint("publisher", handle.name(first.name), first.type, place)
                else:
                    self._endpoint("publisher", topic, self._message(types), place, _qos(args))
            case "subscribe":
                if isinstance(first, _Options):
                    self._endpoint("subscriber", handle.name(first.name), first.type, place)
                else:
                    self._endpoint("subscriber", topic, self._message(types) or self._heard(args), place)
            case "advertiseService":
                if isinstance(first, _Options):
                    self._endpoint("service", handle.name(first.name), first.type, place)
                else:
                    self._endpoint("service", topic, self._served(types, args), place)
            case "serviceClient":
                self._endpoint("client", topic, self._message(types[:1]), place)
            case "getNamespace" | "getUnresolvedNamespace":
                return self._resolved(handle.space)
            case "resolveName":
                return self._resolved(topic)
            case _ if name in _PARAMS and name not in ("get", "has", "set", "search", "del", "getCached"):
                return self._param_call(_PARAMS[name], handle, name == "param", types, args, place, store)
        return Unmade(CppType("ros::Publisher")) if name == "advertise" else UNKNOWN

    def _of_made(self, owner: _Made, name: str, args: Sequence[Argument], place: Place) -> Any:
        given = values(args)
        if owner.type.name in ("message_filters::Subscriber", "image_transport::SubscriberFilter"):
            if name == "subscribe":
                self._filter(owner, given, place)
        elif owner.type.name == "image_transport::ImageTransport":
            topic = owner.handle.name(value_at(args, 0))
            if name in ("advertise", "advertiseCamera"):
                self._endpoint("publisher", topic, _IMAGE, place, _qos(args))
            elif name in ("subscribe", "subscribeCamera"):
                self._image("subscriber", topic, given[1:], place)
            if name in ("advertiseCamera", "subscribeCamera") and isinstance(topic, str):
                info = "camera_info" if "/" not in topic else f"{topic.rpartition('/')[0]}/camera_info"
                if topic.startswith("~") and "/" not in topic:
                    info = "~camera_info"
                self._endpoint("publisher" if name == "advertiseCamera" else "subscriber", info, _INFO, place)
        return UNKNOWN

    def _image(self, role: Role, topic: Any, given: Sequence[Any], place: Place) -> None:
        """By the transport that is known: each has a topic of its own below the image's."""
        transport = next((v for v in reversed(given) if isinstance(v, str) and v != topic), None)
        if transport is None:
            transport = self._hints((), Handle(""), place)
        if transport == "compressed" and isinstance(topic, str):
            self._endpoint(role, f"{topic}/compressed", "sensor_msgs/CompressedImage", place)
        elif transport not in ("theora", "compressedDepth"):
            self._endpoint(role, topic, _IMAGE, place)

    # Parameters.

    def _param_call(
        self,
        access: str,
        handle: Handle,
        has_default: bool,
        types: Sequence[CppType],
        args: Sequence[Argument],
        place: Place,
        store: Store,
    ) -> Any:
        name = handle.name(value_at(args, 0))
        if access == "search":
            return self._search(handle, args, place, store)
        if access != "get":
            return self._param(access, name, UNKNOWN, False, place)
        into = args[1] if len(args) > (2 if has_default else 1) else None
        default = value_at(args, len(args) - 1) if has_default and len(args) > 1 else UNKNOWN
        default = initialized(default, types[0] if types else None)
        found = self._param("get", name, default, has_default, place)
        if into is None:
            return found
        if has_default or found is not UNKNOWN:
            store(into, found)
        # Another node may set it; what the variable had is then what it starts with.
        return True if found is not UNKNOWN and not has_default else UNKNOWN

    def _search(self, handle: Handle, args: Sequence[Argument], place: Place, store: Store) -> Any:
        """The parameter of that name in the handle's namespace or the nearest one around it."""
        name, into = value_at(args, 0), args[-1] if len(args) > 1 else None
        self._param("search", handle.name(name), UNKNOWN, False, place)
        space = self._resolved(handle.space)
        found: Any = UNKNOWN
        while is_name(name) and isinstance(space, str) and found is UNKNOWN:
            full = names.canonicalize(f"{space}/{name}")
            found = full if self._params.look(full) is not UNKNOWN else UNKNOWN
            if space == "/":
                break
            space = names.parent(space).rstrip("/") or "/"
        if into is not None:
            store(into, found)
        return UNKNOWN if found is UNKNOWN else True

    def _param(self, access: str, name: Any, default: Any, has_default: bool, place: Place) -> Any:
        """Note a use; the value that it gives. Nothing is mandatory: what is not there leaves the node's own value."""
        if not is_name(name):
            return default
        known = default if is_plain(default) else None
        self.collected.use(ParamUse(name, access, known, has_default, False, place.file, place.line))
        if access not in ("get", "has"):
            return UNKNOWN
        found = self._params.look(names.resolve(name, self._node, self._remaps))
        if access == "has":
            return UNKNOWN if found is UNKNOWN else True
        return default if found is UNKNOWN else found

    # Names and types.

    def _private(self) -> str:
        """The private namespace of a nodelet, which may have another name than the node."""
        if self.loaded is None:
            return "~"
        full = names.resolve(self.loaded.name, self._node)
        return "~" if full == self._node else full

    def _remaps_of(self, given: Any) -> Mapping[str, str]:
        pairs = given.items() if isinstance(given, dict) else ()
        known = {k: v for k, v in pairs if is_name(k) and is_name(v)}
        return {names.resolve(k, self._node): names.resolve(v, self._node) for k, v in known.items()}

    def _resolved(self, name: Any) -> Any:
        known = isinstance(name, str) and names.is_legal(name)
        return names.canonicalize(names.resolve(name, self._node, self._remaps)) if known else UNKNOWN

    def _endpoint(
        self, role: Role, name: Any, type_: str | None, place: Place, qos: Mapping[str, Any] | None = None
    ) -> None:
        if self.loaded is not None and is_name(name):
            name = self.loaded.remaps.get(names.resolve(name, self._node), name)
        self.collected.add_endpoint(Endpoint(role, name, type_, None, qos or {}, place.file, place.line))

    def _message(self, types: Sequence[CppType]) -> str | None:
        return self._type(types[0]) if types else None

    def _argument_type(self, type_: CppType, index: int) -> str | None:
        return self._type(type_.args[index]) if len(type_.args) > index else None

    def _heard(self, args: Sequence[Argument]) -> str | None:
        """What the callback among the arguments takes."""
        callback = next((v for v in values(args[1:]) if isinstance(v, (Function, Unmade))), None)
        if isinstance(callback, Function):
            first = callback.parameters[0] if callback.parameters else None
            return self._type(first) if first is not None else None
        return None

    def _served(self, types: Sequence[CppType], args: Sequence[Argument]) -> str | None:
        """The service of a callback by the type of its request."""
        request = types[0] if types else None
        callback = next((v for v in values(args[1:]) if isinstance(v, Function)), None)
        if request is None and callback is not None and callback.parameters:
            request = callback.parameters[0]
        return self._half(request) if request is not None else None

    def _half(self, type_: CppType) -> str | None:
        if type_.name.rpartition("::")[2] in _WRAPPERS and type_.args:
            type_ = type_.args[0]
        return self._type(CppType(_HALF.sub("", type_.name), type_.args, type_.file))

    def _service_of(self, value: Any) -> str | None:
        return self._half(value.type) if isinstance(value, Unmade) else None

    def _type(self, type_: CppType) -> str | None:
        """`pkg/Name` of a class that messages, services or actions are made of."""
        name = type_.name.removeprefix("::")
        space, _, last = name.rpartition("::")
        if space in ("boost", "std", "ros") and last in _WRAPPERS:
            return self._type(type_.args[0]) if type_.args else None
        if last in _WRAPPERS:
            name = space
        name = _SUFFIX.sub("", name)
        if name in _ANY_MESSAGE:
            return "*"
        if name == "pcl::PointCloud":
            return "sensor_msgs/PointCloud2"
        found = _TYPE.match(name)
        if found is not None:
            return f"{found[1]}/{found[2]}" if found[1] not in _NO_PACKAGES else None
        if "::" in name or type_.file is None:
            return None
        # Its namespace is used or around; the header that has it tells which.
        for includes in (type_.file.includes, self.includes):
            headers = (_HEADER.match(include) for include in includes)
            packages = {header[1] for header in headers if header is not None and header[2] == name}
            if packages:
                return f"{packages.pop()}/{name}" if len(packages) == 1 else None
        used = dict.fromkeys(path[0] for path in type_.file.namespaces if len(path) == 1)
        having = [p for p in used if any(self._has_type(p, kind, name) for kind in ("msg", "srv", "action"))]
        return f"{having[0]}/{name}" if len(having) == 1 else None


def _private(name: str) -> str:
    return "~" + names.canonicalize(name[1:].lstrip("/")) if len(name) > 1 else "~"


def _is_handle(value: Any) -> bool:
    return isinstance(value, Handle) or (isinstance(value, Unmade) and value.type.name == _HANDLE)


def _handle(value: Any) -> Handle:
    """The handle that is given; where none is the node's own."""
    return value if isinstance(value, Handle) else Handle("" if value is None else UNKNOWN)


def _first_text(given: Sequence[Any]) -> Any:
    """The name among the arguments: the first, or the one after a handle."""
    for value in given[:2]:
        if not _is_handle(value) and not isinstance(value, _Made):
            return value
    return UNKNOWN


def _qos(args: Sequence[Argument]) -> Mapping[str, Any]:
    found: dict[str, Any] = {}
    size, latch = value_at(args, 1), value_at(args, len(args) - 1)
    if isinstance(size, int) and not isinstance(size, bool):
        found["queue_size"] = size
    if len(args) > 2 and latch is True:
        found["latch"] = True
    return found
