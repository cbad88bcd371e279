"""What calls of roscpp and of the libraries beside it make: endpoints and parameter uses."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from preflight_analysis.evaluation import names
from preflight_analysis.source.branches import Branches
from preflight_analysis.source.collector import is_name
from preflight_analysis.source.config_params import Config
from preflight_analysis.source.cpp_frames import MESSAGE_FILTERS, WORDS, note_filter, note_frames
from preflight_analysis.source.cpp_values import (
    Argument,
    Call,
    CppType,
    Instance,
    Place,
    Unmade,
    value_at,
    values,
)
from preflight_analysis.source.known_params import KnownParams
from preflight_analysis.source.python_values import UNKNOWN
from preflight_analysis.source.roscpp_api import (
    ACTIONS,
    ANY_MESSAGE,
    AT_HANDLE,
    FIXED,
    FREE_PARAMS,
    HANDLE,
    HARMLESS,
    IMAGE,
    INFO,
    LOADER,
    MARKERS,
    NODELET_HANDLES,
    PARAMS,
)
from preflight_analysis.source.roscpp_objects import (
    Handle,
    Loaded,
    Made,
    Options,
    first_text,
    handle_of,
    is_handle,
    private_name,
)
from preflight_analysis.source.roscpp_parameters import Parameters
from preflight_analysis.source.roscpp_types import MessageTypes
from preflight_analysis.tracing.interface import Endpoint, Role

_MAX_NODELETS = 20


class RoscppCalls(Parameters):
    """Collects what the calls of one node make. Implements `cpp_values.Calls`."""

    words = frozenset(
        f"NodeHandle getNodeHandle getMTNodeHandle getPrivateNodeHandle getMTPrivateNodeHandle {' '.join(PARAMS)} "
        "advertise advertiseCamera advertiseService subscribe subscribeCamera serviceClient createClient call "
        "waitForService waitForMessage ImageTransport SubscriberFilter Subscriber RealtimePublisher Loader "
        "TransformListener TransformBroadcaster StaticTransformBroadcaster Updater Server CameraInfoManager "
        "SimpleActionServer SimpleActionClient ActionServer ActionClient InteractiveMarkerServer "
        f"{WORDS}".split()
    ) - {"get", "set", "has"} | {"ros"}

    def __init__(
        self,
        node: str,
        remaps: Mapping[str, str],
        params: KnownParams,
        has_type: Callable[[str, str, str], bool],
        config: Config,
    ) -> None:
        super().__init__(node, remaps, params)
        self._types = MessageTypes(has_type)
        self._config = config
        self.nodelets: list[Loaded] = []
        """The nodelets that the program loads into its own process."""
        self.loaded: Loaded | None = None
        """The one of them whose calls are collected."""

    def include(self, files: Sequence[str]) -> None:
        """What the files of the program include, by which the types that they name are found."""
        self._types.includes = files

    def cut_short(self) -> None:
        """There may be more."""
        self.collected.miss()

    def notice(self, *_: object) -> None:
        """Nothing: the method is gone through."""

    def begin(self, branches: Branches) -> None:
        """What is made in one branch of a condition may well not be made."""
        self.collected.branches = branches

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
        if name in MESSAGE_FILTERS:
            note_filter(self.collected, args, place.file, place.line)
        handle = next((v for v in given if isinstance(v, (Handle, Unmade)) and is_handle(v)), None)
        known = handle_of(handle)
        if name == HANDLE:
            return self._new_handle(given)
        if name in ("ros::M_string", "nodelet::M_string"):
            return {}
        if name in ("ros::V_string", "nodelet::V_string"):
            return []
        if endpoints := FIXED.get(name):
            for role, topic, kind in endpoints:
                self._endpoint(role, topic, kind, place)
        elif fixed := AT_HANDLE.get(name):
            space, endpoints = fixed
            within = known if handle is not None else Handle(space)
            for role, topic, kind in endpoints:
                self._endpoint(role, within.name(topic), kind, place)
            self._configured(type_, within)
        elif action := ACTIONS.get(name):
            self._endpoint(action, known.name(first_text(given)), self._types.argument(type_, 0), place)
        elif name == "image_transport::TransportHints":
            return self._hints(given, known, place)
        elif name == "interactive_markers::InteractiveMarkerServer":
            base = value_at(args, 0)
            for role, topic, kind in MARKERS:
                self._endpoint(role, f"{base}/{topic}" if isinstance(base, str) else UNKNOWN, kind, place)
        elif name == "nodelet::Loader" and value_at(args, 0) is not False:
            for service, kind in LOADER:
                self._endpoint("service", (known if handle is not None else Handle("~")).name(service), kind, place)
        elif name in ("message_filters::Subscriber", "image_transport::SubscriberFilter"):
            made = Made(type_, known)
            self._filter(made, given, place)
            return made
        elif name == "realtime_tools::RealtimePublisher" and args:
            self._endpoint("publisher", known.name(first_text(given)), self._types.argument(type_, 0), place)
        elif name == "pluginlib::ClassLoader":
            self.collected.miss()  # what it loads makes its own
        else:
            self._given_away(name, given)
        return Made(type_, known) if name.startswith("image_transport::") else Unmade(type_)

    def _configured(self, type_: CppType, handle: Handle) -> None:
        """The parameters of a dynamic_reconfigure server."""
        config = type_.args[0] if type_.name.endswith("dynamic_reconfigure::Server") and type_.args else None
        kind = self._types.of(config) if config is not None else None
        if kind is None or not kind.endswith("Config"):
            return
        package, _, name = kind.removesuffix("Config").partition("/")
        for param in self._config(package, name):
            self._param("get", handle.name(param.name), param.default, True, Place(param.file, param.line))

    def _new_handle(self, given: Sequence[Any]) -> Handle:
        parent = Handle("")
        if given and is_handle(given[0]):
            parent = handle_of(given[0])
            given = given[1:]
        if not given or isinstance(given[0], (dict, list)):
            return parent
        space = given[0]
        if not isinstance(space, str):
            return Handle(UNKNOWN)
        if space.startswith("~"):
            return Handle(private_name(space))
        return Handle(parent.name(space)) if space else parent

    def _hints(self, given: Sequence[Any], handle: Handle, place: Place) -> Any:
        default = given[0] if given and isinstance(given[0], str) else "raw"
        within = handle if any(is_handle(v) for v in given) else Handle("~")
        found = self._param("get", within.name("image_transport"), default, True, place)
        return found if isinstance(found, str) else "raw"

    def _filter(self, made: Made, given: Sequence[Any], place: Place) -> None:
        if made.type.name == "image_transport::SubscriberFilter":
            transport = next((v for v in given if isinstance(v, Made)), None)
            if transport is not None:
                self._image("subscriber", transport.handle.name(first_text(given)), given, place)
        elif given:
            handle = handle_of(next((v for v in given if is_handle(v)), None))
            self._endpoint("subscriber", handle.name(first_text(given)), self._types.argument(made.type, 0), place)

    def _given_away(self, name: str, given: Sequence[Any]) -> None:
        """What is done with a handle by a library of which nothing is known is not known either."""
        if name.partition("::")[0] not in HARMLESS and any(is_handle(value) for value in given):
            self.collected.miss()

    # Calls.

    def function(self, call: Call) -> Any:
        """Note what a free function makes; its value where it has one that is known."""
        full = call.name.removeprefix("::")
        first = value_at(call.args, 0)
        space, _, leaf = full.rpartition("::")
        match full:
            case "ros::this_node::getName":
                return self._node
            case "ros::this_node::getNamespace":
                return names.parent(self._node).rstrip("/") or "/"
            case "ros::names::clean" if isinstance(first, str):
                return names.canonicalize(first)
            case "ros::names::append" if isinstance(first, str):
                second = value_at(call.args, 1)
                return names.canonicalize(f"{first}/{second}") if isinstance(second, str) else UNKNOWN
            case "ros::names::remap":
                found = self._resolved(first)
                return found if found in self._remaps.values() else first
            case "ros::removeROSArgs" if isinstance(value_at(call.args, 1), list):
                call.store(call.args[-1], list(call.args[1].value))
                return UNKNOWN
            case "ros::names::resolve":
                last = value_at(call.args, len(call.args) - 1)
                asked = last if isinstance(last, str) else first
                return self._resolved(asked)
            case "ros::topic::waitForMessage":
                handle = handle_of(next((v for v in values(call.args) if is_handle(v)), None))
                self._endpoint("subscriber", handle.name(first), self._types.first(call.types), call.place)
                return UNKNOWN
            case "ros::service::waitForService" | "ros::service::exists":
                if leaf == "waitForService":
                    self.collected.await_service(
                        Endpoint("client", first, None, None, {}, call.place.file, call.place.line)
                    )
                return UNKNOWN
            case "ros::service::call":
                self._endpoint("client", first, self._types.service_of(value_at(call.args, 1)), call.place)
                return UNKNOWN
            case "ros::service::createClient":
                self._endpoint("client", first, self._types.first(call.types), call.place)
                return UNKNOWN
        if space == "ros::param" and leaf in FREE_PARAMS:
            return self._param_call(PARAMS[leaf], Handle(""), leaf == "param", call)
        if space in ("ros::AdvertiseOptions", "ros::SubscribeOptions", "ros::AdvertiseServiceOptions"):
            return Options(first, self._types.first(call.types))
        known = full in FIXED or full in AT_HANDLE or full in ACTIONS or full == HANDLE
        if known or full.startswith(("image_transport::", "message_filters::")):
            return self.make(CppType(full, tuple(call.types)), call.args, call.place)
        self._given_away(full, values(call.args))
        return UNKNOWN

    def method(self, owner: Any, call: Call) -> Any:
        """Note what a method makes; its value where it has one that is known."""
        note_frames(self.collected, owner, call)
        if isinstance(owner, Instance):
            space = NODELET_HANDLES.get(call.name)
            if space is not None:
                return Handle(self._private() if space == "~" else space)
            return self._node if call.name == "getName" else UNKNOWN
        if is_handle(owner):
            return self._of_handle(handle_of(owner), call)
        if isinstance(owner, Made):
            return self._of_made(owner, call)
        if isinstance(owner, Unmade) and owner.type.name == "nodelet::Loader" and call.name == "load":
            loaded, plugin, remaps = (value_at(call.args, index) for index in range(3))
            if isinstance(loaded, str) and isinstance(plugin, str) and len(self.nodelets) < _MAX_NODELETS:
                self.nodelets.append(Loaded(loaded, plugin, self._remaps_of(remaps)))
        if isinstance(owner, Unmade) and call.name == "advertise" and owner.type.name in ANY_MESSAGE:
            handle = value_at(call.args, 0)
            topic = handle_of(handle).name(value_at(call.args, 1)) if is_handle(handle) else UNKNOWN
            self._endpoint("publisher", topic, None, call.place)
        if (
            isinstance(owner, Unmade)
            and owner.type.name == "urdf::Model"
            and call.name in ("initParam", "initParamWithNodeHandle")
        ):
            first = value_at(call.args, 0)
            self._param("get", first if is_name(first) else UNKNOWN, UNKNOWN, False, call.place)
        elif isinstance(owner, Unmade) and owner.type.name not in ANY_MESSAGE:
            self._given_away(owner.type.name, values(call.args))
        return UNKNOWN

    def _of_handle(self, handle: Handle, call: Call) -> Any:
        first = value_at(call.args, 0)
        topic = handle.name(first)
        match call.name:
            case "advertise":
                if isinstance(first, Options):
                    self._endpoint("publisher", handle.name(first.name), first.type, call.place)
                else:
                    self._endpoint("publisher", topic, self._types.first(call.types), call.place, _qos(call.args))
            case "subscribe":
                if isinstance(first, Options):
                    self._endpoint("subscriber", handle.name(first.name), first.type, call.place)
                else:
                    self._endpoint(
                        "subscriber",
                        topic,
                        self._types.first(call.types) or self._types.of_callback(call.args),
                        call.place,
                    )
            case "advertiseService":
                if isinstance(first, Options):
                    self._endpoint("service", handle.name(first.name), first.type, call.place)
                else:
                    self._endpoint("service", topic, self._types.of_service_callback(call.types, call.args), call.place)
            case "serviceClient":
                self._endpoint("client", topic, self._types.first(call.types[:1]), call.place)
            case "getNamespace" | "getUnresolvedNamespace":
                return self._resolved(handle.space)
            case "resolveName":
                return self._resolved(topic)
            case _ if call.name in PARAMS and call.name not in ("get", "has", "set", "search", "del", "getCached"):
                return self._param_call(PARAMS[call.name], handle, call.name == "param", call)
        return Unmade(CppType("ros::Publisher")) if call.name == "advertise" else UNKNOWN

    def _of_made(self, owner: Made, call: Call) -> Any:
        given = values(call.args)
        if owner.type.name in ("message_filters::Subscriber", "image_transport::SubscriberFilter"):
            if call.name == "subscribe":
                self._filter(owner, given, call.place)
        elif owner.type.name == "image_transport::ImageTransport":
            topic = owner.handle.name(value_at(call.args, 0))
            if call.name in ("advertise", "advertiseCamera"):
                self._endpoint("publisher", topic, IMAGE, call.place, _qos(call.args))
            elif call.name in ("subscribe", "subscribeCamera"):
                self._image("subscriber", topic, given[1:], call.place)
            if call.name in ("advertiseCamera", "subscribeCamera") and isinstance(topic, str):
                info = "camera_info" if "/" not in topic else f"{topic.rpartition('/')[0]}/camera_info"
                if topic.startswith("~") and "/" not in topic:
                    info = "~camera_info"
                self._endpoint("publisher" if call.name == "advertiseCamera" else "subscriber", info, INFO, call.place)
        return UNKNOWN

    def _image(self, role: Role, topic: Any, given: Sequence[Any], place: Place) -> None:
        """By the transport that is known: each has a topic of its own below the image's."""
        transport = next((v for v in reversed(given) if isinstance(v, str) and v != topic), None)
        if transport is None:
            transport = self._hints((), Handle(""), place)
        if transport == "compressed" and isinstance(topic, str):
            self._endpoint(role, f"{topic}/compressed", "sensor_msgs/CompressedImage", place)
        elif transport not in ("theora", "compressedDepth"):
            self._endpoint(role, topic, IMAGE, place)

    # Names.

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

    def _endpoint(
        self, role: Role, name: Any, type_: str | None, place: Place, qos: Mapping[str, Any] | None = None
    ) -> None:
        if self.loaded is not None and is_name(name):
            name = self.loaded.remaps.get(names.resolve(name, self._node), name)
        self.collected.add_endpoint(Endpoint(role, name, type_, None, qos or {}, place.file, place.line))


def _qos(args: Sequence[Argument]) -> Mapping[str, Any]:
    found: dict[str, Any] = {}
    size, latch = value_at(args, 1), value_at(args, len(args) - 1)
    if isinstance(size, int) and not isinstance(size, bool):
        found["queue_size"] = size
    if len(args) > 2 and latch is True:
        found["latch"] = True
    return found
