"""What calls of rclcpp and of the libraries beside it make: endpoints with their QoS, and parameters."""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from preflight_analysis.evaluation import names
from preflight_analysis.source import rclcpp_qos
from preflight_analysis.source.branches import Branches
from preflight_analysis.source.cpp_frames import MESSAGE_FILTERS, WORDS, note_filter, note_frames
from preflight_analysis.source.cpp_operators import converted
from preflight_analysis.source.cpp_values import (
    Argument,
    Call,
    Constant,
    CppType,
    Function,
    Instance,
    Message,
    Place,
    Unmade,
    value_at,
    values,
)
from preflight_analysis.source.known_params import KnownParams
from preflight_analysis.source.parameter_library import Libraries
from preflight_analysis.source.python_values import UNKNOWN
from preflight_analysis.source.rclcpp_api import (
    ADD_ARGUMENT,
    CONSTANTS,
    CONTAINER,
    DECLARE,
    DECLARE_FUNCTIONS,
    FIXED,
    GENERIC,
    HARMLESS,
    IMAGE,
    IMAGES,
    INFO,
    ITSELF,
    LIFECYCLE,
    LOADERS,
    LOADING,
    METHODS,
    MOVE_GROUP,
    NODES,
    TRANSITIONS,
    WITH_NODE,
)
from preflight_analysis.source.rclcpp_objects import (
    NodeObject,
    Options,
    Parameter,
    changed_options,
    first_node,
    given_parameter,
    is_options,
    node_of,
    parameter_message,
    qualified,
)
from preflight_analysis.source.rclcpp_parameters import Parameters
from preflight_analysis.source.rclcpp_qos import Qos
from preflight_analysis.source.rclcpp_types import message_type
from preflight_analysis.tracing.interface import Endpoint, ParamUse, Role

_ARGUMENT = re.compile(r"(?:\w+:)?__(ns|node|name):=(.*)\Z")
_VALUE_OF = re.compile(r"as_\w+\Z|get\Z|get_value\Z")
_TYPE_TEXT = re.compile(r"[A-Za-z]\w*/(?:msg|srv|action)/[A-Za-z]\w*\Z")


class RclcppCalls(Parameters):
    """Collects what the calls of one node make. Implements `cpp_values.Calls`."""

    words = frozenset(
        f"{' '.join((*METHODS, *GENERIC, *IMAGES, *DECLARE))} create_server declare_parameters get_parameter "
        "get_parameters get_parameter_or get_parameter_types Subscriber SubscriberFilter ImageTransport Node "
        "TransformListener TransformBroadcaster StaticTransformBroadcaster Updater CameraInfoManager LifecycleNode "
        "SimpleActionServer ServiceClient InterProcessPollingSubscriber ClassLoader ParamListener MoveGroupInterface "
        f"wait_for_message {WORDS}".split()
    )

    def __init__(
        self, node: str, params: KnownParams, has_type: Callable[[str, str, str], bool], libraries: Libraries
    ) -> None:
        super().__init__(node, params, libraries)
        self._has_type = has_type

    def begin(self, branches: Branches) -> None:
        """A node that is made in one branch of a condition may well not be made."""
        self.collected.branches = branches

    def cut_short(self) -> None:
        """There may be more declarations of parameters, and more nodes."""
        self.collected.unknown_node()
        self.collected.use(ParamUse("/", "list"))
        self.collected.miss()

    def takes(self, owner: Any, call: Call) -> bool:
        """What declares parameters in the way of a library, and what gives the node itself."""
        if call.name in DECLARE_FUNCTIONS or call.name == ADD_ARGUMENT:
            return True
        return call.name in ITSELF and not call.args and node_of(owner) is not None

    def notice(self, owner: Instance, call: Call) -> None:
        """What a class has in the place of a method of rclcpp makes the same end; here is where it is asked for."""
        node = node_of(owner)
        role, kind = METHODS.get(call.name, ("publisher", ""))
        if node is not None and kind and (type_ := self._first(call.types, kind)) is not None:
            self._endpoint(
                role, node.name(value_at(call.args, 0)), type_, _qos(call.args[1:]) if kind == "msg" else {}, call.place
            )

    # Objects.

    def named(self, name: str) -> Any:
        """Profiles and policies of QoS, and the types of parameters."""
        if name in CONSTANTS:
            return CONSTANTS[name]
        leaf = name.rpartition("::")[2]
        if leaf.startswith("PARAMETER_"):
            return Constant(leaf)
        found = rclcpp_qos.named(name)
        return UNKNOWN if found is None else found

    def called_later(self, instance: Instance) -> Sequence[str]:
        """What a lifecycle node does before it works: somebody is taken to activate it."""
        node = node_of(instance)
        return TRANSITIONS if node is not None and node.has_lifecycle else ()

    def make(self, type_: CppType, args: Sequence[Argument], place: Place) -> Any:
        """An object of a library's class, and what its constructor makes."""
        name = qualified(type_)
        given = values(args)
        if name in NODES:
            node = self._new_node(given, place, has_lifecycle=NODES[name])
            if name == CONTAINER:
                self._services(LOADING, node, place)
            return node
        if (qos := rclcpp_qos.make(name, given)) is not None:
            return qos
        if (message := parameter_message(name)) is not None:
            return message
        match name:
            case "rclcpp::NodeOptions":
                return next((v for v in given if isinstance(v, Options)), Options())
            case "rclcpp::ParameterValue" | "rclcpp::Parameter" if args:
                return given_parameter(args[-1], None)
            case "image_transport::TransportHints":
                return self._hints(given, place)
            case "image_transport::SubscriberFilter":
                self._image("subscriber", False, args, place)
        if name.rpartition("::")[2] == "ParamListener" and self._listener(name, given):
            return Unmade(type_)
        if name in MESSAGE_FILTERS:
            note_filter(self.collected, args, place.file, place.line)
        if name in LOADERS:
            self._any_parameter(place)  # what it loads declares its own
            self.collected.miss()
        elif name == MOVE_GROUP and isinstance(value_at(args, 1), Unmade):
            self.collected.miss()  # options, which may have a namespace
        elif endpoints := FIXED.get(name):
            for role, topic, kind in endpoints:
                self._endpoint(role, first_node(given).name(topic), kind, {}, place)
            if name == MOVE_GROUP:
                self._any_parameter(place)  # of the robot model, the kinematics and the pipelines
            if name == "diagnostic_updater::Updater":
                self._declare(first_node(given), "diagnostic_updater.period", Parameter(1.0), place)
                self._declare(first_node(given), "diagnostic_updater.use_fqn", Parameter(False), place)
        elif name in WITH_NODE:
            self._with_node(name, type_.args, args, place)
        else:
            self._unknown_library(name, given, place)
            if name.endswith("Node") and any(isinstance(value, str) or is_options(value) for value in given):
                self._any_parameter(place)  # of a package that is not there in source form
                self.collected.miss()
                self.collected.unknown_node()
                return NodeObject()
        return Unmade(type_)

    def _new_node(self, given: Sequence[Any], place: Place, *, has_lifecycle: bool) -> NodeObject:
        options = next((v for v in given if isinstance(v, Options)), Options())
        node = self._named_node(given, options, has_lifecycle=has_lifecycle)
        node = replace(node, from_overrides=options.from_overrides)
        if not self._in_dead_code:
            self._make_node(given, options, node)
        if has_lifecycle:
            self._services(LIFECYCLE, node, place)
        if options.takes_all:
            self._any_parameter(place)
        return node

    def _services(self, services: Sequence[tuple[str, str]], node: NodeObject, place: Place) -> None:
        """The services that a node of the class has by itself."""
        for service, kind in services if not self._in_dead_code else ():
            self.collected.add_endpoint(
                Endpoint("service", node.name(service), kind, None, {}, place.file, place.line, builtin=True)
            )

    def _make_node(self, given: Sequence[Any], options: Options, node: NodeObject) -> None:
        if node.full is not None:
            self.collected.node(node.full.rpartition("/")[2] if isinstance(node.full, str) else UNKNOWN, renamed=False)
            return
        texts = [value for value in given if isinstance(value, str)]
        if len(texts) != sum(not is_options(value) and value is not UNKNOWN for value in given) or len(texts) > 2:
            self.collected.unknown_node()  # another constructor is meant
            return
        space = given[1] if len(given) > 1 and isinstance(given[1], str) else ""
        # Options that are not known may have arguments of their own.
        renamed = options.of_process and all(isinstance(value, (str, Options)) for value in given)
        self.collected.node(given[0] if given else UNKNOWN, space, renamed=renamed)

    def _named_node(self, given: Sequence[Any], options: Options, *, has_lifecycle: bool) -> NodeObject:
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
        found = self._declare(first_node(given), param, Parameter(default), place)
        return found if isinstance(found, str) else "raw"

    def _unknown_library(self, name: str, given: Sequence[Any], place: Place) -> None:
        """A library of which nothing is known may declare parameters of a node that it is given."""
        if name.partition("::")[0] not in HARMLESS and any(node_of(value) is not None for value in given):
            self._any_parameter(place)
            self.collected.miss()

    # Calls.

    def function(self, call: Call) -> Any:
        """Note what a free function makes; its value where it has one that is known."""
        full = call.name.removeprefix("::")
        space, _, leaf = full.rpartition("::")
        if (message := parameter_message(full)) is not None:
            return message
        if full in WITH_NODE:
            self._with_node(full, call.types, call.args, call.place)
            return UNKNOWN
        if space == "image_transport" and leaf in IMAGES:
            role, with_info = IMAGES[leaf]
            self._image(role, with_info, call.args, call.place)
            return UNKNOWN
        if leaf in DECLARE_FUNCTIONS:
            if isinstance(value_at(call.args, 0), str):
                return UNKNOWN  # a method of a node, which declared it
            at = next((i for i, arg in enumerate(call.args[:2]) if node_of(arg.value) is not None), 0)
            return self._declare_call(first_node(values(call.args)), call.types, call.args[at + 1 :], call.place)
        if leaf == ADD_ARGUMENT:
            known, option, new = value_at(call.args, 0), value_at(call.args, 1), value_at(call.args, 3)
            call.store(call.args[0], [*known, option, new] if isinstance(known, list) else UNKNOWN)
            return UNKNOWN
        if full == "rclcpp::wait_for_message":
            text = next((v for v in values(call.args) if isinstance(v, str)), UNKNOWN)
            message = value_at(call.args, 0)
            type_ = self._type(message.type, "msg") if isinstance(message, (Message, Unmade)) else None
            self._endpoint(
                "subscriber",
                first_node(values(call.args)).name(text),
                type_ or self._first(call.types, "msg"),
                {},
                call.place,
            )
            return UNKNOWN
        if full == "rclcpp::init_and_remove_ros_arguments":
            return value_at(call.args, 1)
        known = full in NODES or full in FIXED or full.startswith(("rclcpp::", "image_transport::"))
        if known or rclcpp_qos.make(full, ()) is not None:
            return self.make(CppType(full, tuple(call.types)), call.args, call.place)
        self._unknown_library(full, values(call.args), call.place)
        return UNKNOWN

    def method(self, owner: Any, call: Call) -> Any:
        """Note what a method makes; its value where it has one that is known."""
        if not self._in_dead_code:
            note_frames(self.collected, owner, call)
        if isinstance(owner, Qos):
            return rclcpp_qos.changed(owner, call.name, values(call.args))
        if isinstance(owner, Options) and call.name == "arguments" and not call.args:
            return list(owner.arguments)
        if isinstance(owner, Options):
            return changed_options(owner, call.name, call.args)
        if isinstance(owner, Parameter):
            if _VALUE_OF.match(call.name):
                return converted(owner.value, call.types[0] if call.types else None)
            if call.name == "get_type" and not owner.is_set:
                return Constant("PARAMETER_NOT_SET")
            return owner if call.name == "get_parameter_value" else UNKNOWN
        node = node_of(owner)
        if node is not None:
            return self._of_node(owner, node, call)
        if isinstance(owner, Unmade):
            return self._of_made(owner, call)
        return UNKNOWN

    def _of_made(self, owner: Unmade, call: Call) -> Any:
        kind = qualified(owner.type)
        if call.name == "get_params" and kind in self._structs:
            return self._structs[kind]
        if is_options(owner) and call.name == "arguments" and not call.args:
            return []  # those that name the process's own node
        if kind == "image_transport::ImageTransport" and call.name in IMAGES:
            role, with_info = IMAGES[call.name]
            self._image(role, with_info, call.args, call.place)
        elif kind == "image_transport::SubscriberFilter" and call.name == "subscribe":
            self._image("subscriber", False, call.args, call.place)
        elif kind == "image_transport::TransportHints" and call.name == "getTransport":
            return UNKNOWN
        elif kind == "message_filters::Subscriber" and call.name == "subscribe":
            self._with_node(kind, owner.type.args, call.args, call.place)
        else:
            self._unknown_library(kind, values(call.args), call.place)
        return UNKNOWN

    def _of_node(self, owner: Any, node: NodeObject, call: Call) -> Any:
        first = value_at(call.args, 0)
        if call.name in METHODS:
            role, kind = METHODS[call.name]
            type_ = self._first(call.types, kind) or (self._heard(call.args) if role == "subscriber" else None)
            self._endpoint(role, node.name(first), type_, _qos(call.args[1:]) if kind == "msg" else {}, call.place)
            return Unmade(CppType("rclcpp::Publisher")) if role == "publisher" else UNKNOWN
        if call.name in GENERIC:
            type_text = value_at(call.args, 1)
            known = type_text if isinstance(type_text, str) and _TYPE_TEXT.match(type_text) else None
            self._endpoint(
                GENERIC[call.name], node.name(first), known, rclcpp_qos.of(value_at(call.args, 2)), call.place
            )
            return UNKNOWN
        if call.name in DECLARE:
            return self._declare_call(node, call.types, call.args, call.place)
        match call.name:
            case "declare_parameters":
                self._declare_all(node, call)
            case "get_parameter" | "get_parameter_or":
                return self._read(node, call)
            case "configure" | "activate" if node.has_lifecycle and not self._in_dead_code:
                self.collected.transition(call.name)
            case "trigger_transition" if node.has_lifecycle and not self._in_dead_code:
                self.collected.transition("configure", "activate")  # which, a number says
            case "list_parameters":
                self._any_parameter(call.place)
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
            case _ if call.name in ITSELF or call.name == "lock":
                return owner
            case _ if call.name.startswith("get_node_") and call.name.endswith("_interface"):
                return owner
        return UNKNOWN

    def _with_node(self, name: str, types: Sequence[CppType], args: Sequence[Argument], place: Place) -> None:
        """An end of a function or class that gets the node as an argument."""
        role, kind = WITH_NODE[name]
        at = next((i for i, arg in enumerate(args) if isinstance(arg.value, str)), None)
        if at is None:
            self.collected.miss()
            return  # made without a name, or of one that is not known
        qos = _qos(args[at + 1 :]) if kind == "msg" else {}
        self._endpoint(role, first_node(values(args)).name(args[at].value), self._first(types, kind), qos, place)

    def _image(self, role: Role, with_info: bool, args: Sequence[Argument], place: Place) -> None:
        """By the transport that is known: each has a topic of its own below the image's."""
        given = values(args)
        texts = [value for value in given if isinstance(value, str)]
        if not texts:
            self.collected.miss()
            return
        node, topic = first_node(given), texts[0]
        qos = next((rclcpp_qos.of(v) for v in given if isinstance(v, Qos)), {})
        transport = texts[1] if len(texts) > 1 else "raw"
        if role == "subscriber" and transport != "raw":
            kind = "sensor_msgs/msg/CompressedImage" if transport == "compressed" else None
            self._endpoint(role, node.name(f"{topic}/{transport}"), kind, qos, place)
        else:
            self._endpoint(role, node.name(topic), IMAGE, qos, place)
        if with_info:
            info = f"{topic.rpartition('/')[0]}/camera_info" if "/" in topic else "camera_info"
            self._endpoint(role, node.name(info), INFO, qos, place)

    # Endpoints.

    def _endpoint(self, role: Role, name: Any, type_: str | None, qos: Mapping[str, Any], place: Place) -> None:
        if not self._in_dead_code:
            self.collected.add_endpoint(Endpoint(role, name, type_, None, qos, place.file, place.line))

    def _first(self, types: Sequence[CppType], kind: str) -> str | None:
        return self._type(types[0], kind) if types else None

    def _heard(self, args: Sequence[Argument]) -> str | None:
        """What the callback among the arguments takes."""
        callback = next((v for v in values(args[1:]) if isinstance(v, Function)), None)
        first = callback.parameters[0] if callback is not None and callback.parameters else None
        return self._type(first, "msg") if first is not None else None

    def _type(self, type_: CppType, kind: str) -> str | None:
        return message_type(type_, kind, self.includes, self._has_type)


def _qos(args: Sequence[Argument]) -> Mapping[str, Any]:
    """What the arguments after the name ask for: a depth stands first, a profile may stand elsewhere."""
    given = values(args)
    profile = next((value for value in given if isinstance(value, Qos)), None)
    return rclcpp_qos.of(profile if profile is not None else value_at(args, 0))
