"""What is woven into rclpy: each endpoint and declared parameter is told with the name that the node gave it.

Waits for other nodes are answered as those of rospy are (`mock_replies`), and lifecycle nodes are configured and
activated once they reach their event loop, which is where their topics are made.
"""

from __future__ import annotations

import functools
import inspect
import json
import os
import sys
import threading
import time
import weakref
from types import FrameType, ModuleType
from typing import Any, Callable, Optional

from . import channel, mock_replies
from .variables import EXPECTED, SHARES

_LIBRARIES = frozenset(("rclpy", "preflight_agents", "functools", "tf2_ros", "message_filters", "diagnostic_updater"))
"""Frames in these are not the node's own."""
_OWN_THREADS = ("rclpy", "preflight_agents")
_MAX_DEFAULT = 4_000
_FOREVER = 9_000_000_000
"""Seconds: the "infinite" durations of rmw are longer."""

_LOOKS = (
    "get_node_names",
    "get_node_names_and_namespaces",
    "get_node_names_and_namespaces_with_enclaves",
    "get_fully_qualified_node_names",
    "get_topic_names_and_types",
    "get_service_names_and_types",
    "get_publisher_names_and_types_by_node",
    "get_subscriber_names_and_types_by_node",
    "get_service_names_and_types_by_node",
    "get_client_names_and_types_by_node",
    "count_publishers",
    "count_subscribers",
    "count_clients",
    "count_services",
    "get_publishers_info_by_topic",
    "get_subscriptions_info_by_topic",
    "get_clients_info_by_service",
    "get_servers_info_by_service",
)
"""Methods of a node that tell of others."""

_nodes: list[Any] = []
_OVERRIDES = "automatically_declare_parameters_from_overrides"
_from_overrides: Any = weakref.WeakValueDictionary()
"""The nodes, by their `id`, that declare what the launch sets before their own code does: with any type."""
_there: set[str] = set()
_turns: set[Any] = set()
_polls: dict[Any, int] = {}
_told_states: set[str] = set()


def _quiet(report: Callable[..., None]) -> Callable[..., None]:
    """What we do beside the node must not fail it."""

    @functools.wraps(report)
    def safe(*args: Any, **kwargs: Any) -> None:
        try:
            report(*args, **kwargs)
        except Exception as error:
            channel.send("weave-failed", message=repr(error))

    return safe


def _top(frame: FrameType) -> str:
    return str(frame.f_globals.get("__name__", "")).partition(".")[0]


def _caller() -> tuple[Optional[str], Optional[int], bool]:
    """File and line of the node's own call, and whether rclpy makes it for each node, when that is constructed."""
    frame: Optional[FrameType] = sys._getframe(1)
    internal = False
    while frame is not None and _top(frame) in _LIBRARIES:
        if _top(frame) == "rclpy":
            of_node = frame.f_globals.get("__name__") == "rclpy.node"
            internal = internal or (of_node and frame.f_code.co_name == "__init__")
        frame = frame.f_back
    if frame is None:
        return None, None, internal
    return frame.f_code.co_filename, frame.f_lineno, internal


def _in_main_thread() -> bool:
    return threading.current_thread() is threading.main_thread()


def _wrap(owner: Any, name: str, advice: Callable[[Callable[..., Any]], Callable[..., Any]]) -> None:
    """Put `advice(original)` in the place of a function of a module or class; of what is not there nothing."""
    original = vars(owner).get(name)
    if callable(original):
        setattr(owner, name, functools.wraps(original)(advice(original)))


def _bound(function: Callable[..., Any], args: Any, kwargs: Any) -> dict[str, Any]:
    """The arguments of a call by name, those of `**kwargs` among them."""
    arguments = dict(_signature(function).bind(*args, **kwargs).arguments)
    return {**arguments, **arguments.pop("kwargs", {})}


@functools.lru_cache(maxsize=256)
def _signature(function: Callable[..., Any]) -> inspect.Signature:
    return inspect.signature(function)


# Endpoints


def _type(described: Any) -> Optional[str]:
    """`pkg/msg/Name` of a class that the generators of rosidl made."""
    package, _, rest = str(getattr(described, "__module__", "")).partition(".")
    kind = rest.partition(".")[0]
    return f"{package}/{kind}/{described.__name__}" if kind in ("msg", "srv", "action") else None


def _given(node: Any, name: str) -> str:
    """The name as the node gave it, where the launch file's node would come to the same; else the full one."""
    expected = os.environ.get(EXPECTED, "")
    space, _, base = expected.rpartition("/")
    private = name == "~" or name.startswith("~/")
    in_place = (node.get_namespace().rstrip("/") or "") == space and (not private or node.get_name() == base)
    if name.startswith("/") or (in_place and "{" not in name):
        return name
    channel.send("asked", what="name")
    return _full(node, name)


def _full(node: Any, name: str) -> str:
    expand = sys.modules["rclpy.expand_topic_name"].expand_topic_name  # of those that rclpy.node imports
    return str(expand(name, node.get_name(), node.get_namespace()))


def _full_name(node: Any) -> str:
    return f"{str(node.get_namespace()).rstrip('/')}/{node.get_name()}"


def _qos(profile: Any) -> dict[str, Any]:
    """The policies that are settled; what is left to the middleware is left out."""
    found: dict[str, Any] = {}
    for policy, allowed in (
        ("reliability", ("reliable", "best_effort")),
        ("durability", ("volatile", "transient_local")),
        ("liveliness", ("automatic", "manual_by_topic")),
    ):
        word = str(getattr(getattr(profile, policy, None), "name", "")).lower()
        if word in allowed:
            found[policy] = word
    depth = getattr(profile, "depth", None)
    if isinstance(depth, int) and depth > 0:
        found["depth"] = depth
    for policy, name in (("deadline", "deadline"), ("liveliness_lease_duration", "lease_duration")):
        nanoseconds = getattr(getattr(profile, policy, None), "nanoseconds", 0)
        if isinstance(nanoseconds, int) and 0 < nanoseconds < _FOREVER * 1_000_000_000:
            found[name] = nanoseconds / 1e9
    return found


@_quiet
def _report_endpoint(node: Any, role: str, name: Any, described: Any, profile: Any = None) -> None:
    file, line, internal = _caller()
    channel.send(
        "endpoint",
        role=role,
        name=_given(node, str(name)),
        resolved=_full(node, str(name)),
        node=_full_name(node),
        type=_type(described),
        qos=_qos(profile) if profile is not None else {},
        file=file,
        line=line,
        builtin=internal,
        speculative=mock_replies.speculative(),
    )


def _creates(role: str, type_name: str, name: str, profiled: bool) -> Callable[..., Any]:
    """A method of the node that makes an endpoint."""

    def advice(original: Callable[..., Any]) -> Callable[..., Any]:
        def made(*args: Any, **kwargs: Any) -> Any:
            result = original(*args, **kwargs)
            arguments = _bound(original, args, kwargs)
            profile = getattr(result, "qos_profile", None) if profiled else None
            _report_endpoint(arguments["self"], role, arguments.get(name), arguments.get(type_name), profile)
            return result

        return made

    return advice


def _action(role: str) -> Callable[..., Any]:
    """The constructor of an end of an action."""

    def advice(original: Callable[..., Any]) -> Callable[..., Any]:
        def made(*args: Any, **kwargs: Any) -> None:
            original(*args, **kwargs)
            arguments = _bound(original, args, kwargs)
            name = arguments.get("action_name")
            _report_endpoint(arguments.get("node"), role, name, arguments.get("action_type"))
            if role == "action_client":
                arguments["self"]._preflight_name = name

        return made

    return advice


def _asks(original: Callable[..., Any]) -> Callable[..., Any]:
    """The node looks at its own name: what it does may depend on it."""

    def asked(*args: Any, **kwargs: Any) -> Any:
        if _top(sys._getframe(1)) not in _LIBRARIES:
            channel.send("asked", what="name")
        return original(*args, **kwargs)

    return asked


def _looks(original: Callable[..., Any]) -> Callable[..., Any]:
    """The node looks which nodes, topics or services there are: what it does may depend on it."""

    def looked(*args: Any, **kwargs: Any) -> Any:
        if _top(sys._getframe(1)) not in _LIBRARIES:
            channel.send("asked", what="graph")
        return original(*args, **kwargs)

    return looked


# Parameters


def _plain(value: Any) -> Any:
    """A default value in JSON's types."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    return repr(value)


def _default(value: Any) -> tuple[Any, bool]:
    """What a parameter is declared with, and whether that is a value: a bare type is none."""
    if value is None or type(value).__name__ == "Type":
        return None, False
    plain = _plain(value)
    return (plain if len(json.dumps(plain)) < _MAX_DEFAULT else None), True


def _described(given: Any, descriptor: Any, *, of_any_type: bool) -> dict[str, Any]:
    """The type that a parameter is declared with, by its default or as such, and what its descriptor allows."""
    if given is None or of_any_type or getattr(descriptor, "dynamic_typing", False) is True:
        return {"dynamic": True, "read_only": bool(getattr(descriptor, "read_only", False))}
    kinds = sys.modules["rclpy.parameter"].Parameter.Type  # of those that rclpy.node imports
    kind = given if isinstance(given, kinds) else kinds.from_parameter_value(given)
    constraints = {
        "type": kind.name.lower().replace("_", " "),
        "read_only": bool(getattr(descriptor, "read_only", False)),
    }
    # rclpy looks at the range of the parameter's own type alone.
    ranges = getattr(
        descriptor, {"integer": "integer_range", "double": "floating_point_range"}.get(constraints["type"], ""), ()
    )
    for each in list(ranges)[:1]:
        constraints["range"] = [each.from_value, each.to_value, each.step]
    return constraints


@_quiet
def _report_params(arguments: dict[str, Any]) -> None:
    file, line, internal = _caller()
    of_any_type = _from_overrides.get(id(arguments.get("self"))) is not None
    namespace = arguments.get("namespace")
    prefix = f"{namespace}." if namespace else ""
    for each in arguments.get("parameters") or ():
        described = each if isinstance(each, (list, tuple)) else (each,)
        given = described[1] if len(described) > 1 else None
        default, has_default = _default(given)
        channel.send(
            "param",
            access="get",
            name=f"~{prefix}{described[0]}",
            default=default,
            has_default=has_default and not internal,
            optional=True,
            **_described(given, described[2] if len(described) > 2 else None, of_any_type=of_any_type),
            node=_full_name(arguments["self"]),
            file=None if internal else file,
            line=None if internal else line,
            builtin=internal,
        )


def _declares(original: Callable[..., Any]) -> Callable[..., Any]:
    def declared(*args: Any, **kwargs: Any) -> Any:
        # A list that the node may hand over as a generator.
        arguments = _bound(original, args, kwargs)
        if "parameters" in arguments:
            arguments["parameters"] = list(arguments["parameters"])
        _report_params(arguments)
        return original(**arguments)

    return declared


def _constructed(original: Callable[..., Any]) -> Callable[..., Any]:
    """A node is made: it may take parameters that it does not declare."""

    @_quiet
    def report(node: Any, arguments: dict[str, Any]) -> None:
        _nodes.append(node)
        name = str(node.get_name())
        channel.send(
            "node",
            name=name,
            given=str(arguments.get("node_name")),
            space=str(arguments.get("namespace") or ""),
            full=_full_name(node),
            renamed=name == os.environ.get(EXPECTED, "").rpartition("/")[2],
        )
        if any(arguments.get(option) for option in ("allow_undeclared_parameters", _OVERRIDES)):
            channel.send("param", access="list", name="/", optional=True, node=_full_name(node))
        channel.send("state", state="init")

    @_quiet
    def begin(args: Any, kwargs: Any) -> None:
        arguments = _bound(original, args, kwargs)
        if arguments.get(_OVERRIDES):
            _from_overrides[id(arguments["self"])] = arguments["self"]

    def made(*args: Any, **kwargs: Any) -> None:
        begin(args, kwargs)
        original(*args, **kwargs)
        arguments = _bound(original, args, kwargs)
        report(arguments["self"], arguments)

    return made


# The event loop


def _other_threads() -> int:
    """How many threads the node started itself."""
    own = 0
    for thread in threading.enumerate():
        if thread is threading.main_thread() or isinstance(thread, threading._DummyThread):
            continue
        module = str(getattr(getattr(thread, "_target", None), "__module__", None) or type(thread).__module__)
        own += module.partition(".")[0] not in _OWN_THREADS
    return own


def _activate() -> None:
    """Have lifecycle nodes do what a manager would ask of them."""
    waiting, _nodes[:] = list(_nodes), []
    for node in waiting:
        if hasattr(node, "trigger_configure") and hasattr(node, "trigger_activate"):
            for transition in ("configure", "activate"):
                if getattr(getattr(node, f"trigger_{transition}")(), "name", "SUCCESS") != "SUCCESS":
                    # What it would have made is not known.
                    channel.send("answered", kind="transition", name=transition)
                    break


def _spins(flush: Callable[[], None]) -> Callable[..., Any]:
    """The main thread enters its event loop."""

    @_quiet
    def report() -> None:
        _activate()
        if _in_main_thread():
            flush()
            channel.send("state", state="spin", threads=_other_threads())

    def advice(original: Callable[..., Any]) -> Callable[..., Any]:
        def spin(*args: Any, **kwargs: Any) -> Any:
            report()
            return original(*args, **kwargs)

        return spin

    return advice


def _iterates_once(flush: Callable[[], None]) -> Callable[..., Any]:
    """A call that stands in a loop of the main thread."""

    @_quiet
    def report() -> None:
        frame: Optional[FrameType] = sys._getframe(3)  # who calls `turn`
        while frame is not None and _top(frame) in ("preflight_agents", "functools"):
            frame = frame.f_back
        if frame is None or _top(frame) == "rclpy" or not _in_main_thread():
            return
        place = (frame.f_code.co_filename, frame.f_lineno)
        state = "looped" if place in _turns else "idle"
        _turns.add(place)
        if state not in _told_states:
            _told_states.add(state)
            _activate()
            flush()
            channel.send("state", state=state, threads=_other_threads())

    def advice(original: Callable[..., Any]) -> Callable[..., Any]:
        def turn(*args: Any, **kwargs: Any) -> Any:
            report()
            return original(*args, **kwargs)

        return turn

    return advice


def _completes(flush: Callable[[], None]) -> Callable[..., Any]:
    """`spin_until_future_complete`: an event loop where nobody ever completes the future."""
    spins = _spins(flush)

    def advice(original: Callable[..., Any]) -> Callable[..., Any]:
        spin = spins(original)

        def until(*args: Any, **kwargs: Any) -> Any:
            future = _bound(original, args, kwargs).get("future")
            done = getattr(future, "done", None)
            return original(*args, **kwargs) if done is not None and done() else spin(*args, **kwargs)

        return until

    return advice


def _ends(original: Callable[..., Any]) -> Callable[..., Any]:
    """The client library is shut down: however long that takes, it is no event loop."""

    def ending(*args: Any, **kwargs: Any) -> Any:
        channel.send("state", state="ending")
        return original(*args, **kwargs)

    return ending


# Waits


@_quiet
def _report_wait(state: str, kind: str, name: str, flush: Callable[[], None]) -> None:
    file, line, _ = _caller()
    channel.send("state", state=state, kind=kind, name=name, file=file, line=line, main=_in_main_thread())
    if state == "wait":
        flush()


def _waits(
    kind: str, name_of: Callable[[Any], str], ready: Callable[[Any], bool], flush: Callable[[], None]
) -> Callable[..., Any]:
    """`wait_for_service` and `wait_for_server`: after a while they are told that it is there."""

    def advice(original: Callable[..., Any]) -> Callable[..., Any]:
        def wait(*args: Any, **kwargs: Any) -> bool:
            arguments = _bound(original, args, kwargs)
            client, seconds = arguments["self"], arguments.get("timeout_sec")
            name = name_of(client)
            _report_wait("wait", kind, name, flush)
            try:
                limit = mock_replies.grace() if seconds is None else min(float(seconds), mock_replies.grace())
                end = time.monotonic() + limit
                while not (there := ready(client)) and time.monotonic() < end and _is_up(client):
                    time.sleep(0.01)
                if not there:
                    _there.add(name)
                    mock_replies.made_up(kind, name)
                return True
            finally:
                _report_wait("resume", kind, name, flush)

        return wait

    return advice


def _service_of(client: Any) -> str:
    """The name of a client's service; Humble has only the one that was given."""
    return str(getattr(client, "service_name", None) or getattr(client, "srv_name", ""))


def _is_up(client: Any) -> bool:
    """Whether the client library was not shut down meanwhile."""
    context = getattr(client, "context", None)
    return context is None or bool(context.ok())


def _is_ready(original: Callable[..., Any]) -> Callable[..., Any]:
    """`service_is_ready`: who asks again and again from one place waits."""

    def asked(client: Any) -> bool:
        if original(client):
            return True
        file, line, _ = _caller()
        key = (_service_of(client), file, line)
        _polls[key] = _polls.get(key, 0) + 1
        if _polls[key] > 3:
            if _service_of(client) not in _there:
                _there.add(_service_of(client))
                mock_replies.made_up("services", _service_of(client))
            return True
        return False

    return asked


def _response(described: Any) -> Any:
    """An answer of zeros, but yes to each yes or no: a service that fails leads nowhere."""
    response = described.Response()
    for field, kind in described.Response.get_fields_and_field_types().items():
        if kind == "boolean":
            setattr(response, field, True)
    return response


def _calls(later: bool, ready: Callable[[Any], bool]) -> Callable[..., Any]:
    """A call of a service that was taken to be there."""

    def advice(original: Callable[..., Any]) -> Callable[..., Any]:
        def call(self: Any, *args: Any, **kwargs: Any) -> Any:
            # A plain call has no end without somebody who answers.
            if ready(self) or (later and _service_of(self) not in _there):
                return original(self, *args, **kwargs)
            mock_replies.made_up("call", _service_of(self))
            response = _response(self.srv_type)
            if not later:
                return response
            future = sys.modules["rclpy.task"].Future()  # of those that rclpy.client imports
            future.set_result(response)
            return future

        return call

    return advice


def _first_message(flush: Callable[[], None]) -> Callable[..., Any]:
    """`wait_for_message`: after a while it gets one of zeros."""

    def advice(original: Callable[..., Any]) -> Callable[..., Any]:
        def wait(*args: Any, **kwargs: Any) -> Any:
            arguments = _bound(original, args, kwargs)
            seconds = arguments.get("time_to_wait", -1)
            name = str(arguments["topic"])
            _report_wait("wait", "message", name, flush)
            try:
                limit = mock_replies.grace()
                arguments["time_to_wait"] = min(seconds, limit) if seconds >= 0 else limit
                by_itself, message = original(**arguments)
                if by_itself:
                    return by_itself, message
                mock_replies.made_up("message", name)
                return True, arguments["msg_type"]()
            finally:
                _report_wait("resume", "message", name, flush)

        return wait

    return advice


# Packages that were not built


def _source_packages(not_found: Any) -> Callable[..., Any]:
    """`get_package_share_directory`: of a package that is there as source only, the folder of the source."""

    def advice(original: Callable[..., Any]) -> Callable[..., Any]:
        def share(package_name: str, *args: Any, **kwargs: Any) -> Any:
            try:
                return original(package_name, *args, **kwargs)
            except not_found:
                found = json.loads(os.environ.get(SHARES, "{}")).get(package_name)
                if found is None:
                    raise
                return found

        return share

    return advice


def weave(module: ModuleType, flush: Callable[[], None]) -> None:
    """Weave one of `hooks.RCLPY`, freshly imported. `flush` tells the files opened so far; it is called when the node
    may stop."""
    found: Any = module
    name = module.__name__
    if name == "rclpy":
        _wrap(found, "spin", _spins(flush))
        _wrap(found, "spin_once", _iterates_once(flush))
        _wrap(found, "spin_until_future_complete", _completes(flush))
        for function in ("shutdown", "try_shutdown"):
            _wrap(found, function, _ends)
        channel.send("woven")
    elif name == "rclpy.node":
        node = found.Node
        _wrap(node, "__init__", _constructed)
        _wrap(node, "declare_parameters", _declares)
        for method in ("get_name", "get_namespace", "get_fully_qualified_name", "resolve_topic_name"):
            _wrap(node, method, _asks)
        _wrap(node, "resolve_service_name", _asks)
        for method in _LOOKS:
            _wrap(node, method, _looks)
        _wrap(node, "create_publisher", _creates("publisher", "msg_type", "topic", True))
        _wrap(node, "create_subscription", _creates("subscriber", "msg_type", "topic", True))
        _wrap(node, "create_service", _creates("service", "srv_type", "srv_name", False))
        _wrap(node, "create_client", _creates("client", "srv_type", "srv_name", False))
    elif name == "rclpy.client":
        ready = found.Client.service_is_ready
        _wrap(found.Client, "wait_for_service", _waits("service", _service_of, ready, flush))
        _wrap(found.Client, "service_is_ready", _is_ready)
        _wrap(found.Client, "call", _calls(False, ready))
        _wrap(found.Client, "call_async", _calls(True, ready))
    elif name == "rclpy.executors":
        _wrap(found.Executor, "spin", _spins(flush))
        _wrap(found.Executor, "spin_until_future_complete", _completes(flush))
        for executor in (found.SingleThreadedExecutor, found.MultiThreadedExecutor):
            _wrap(executor, "spin_once", _iterates_once(flush))
    elif name == "rclpy.timer":
        _wrap(found.Rate, "sleep", _iterates_once(flush))
    elif name == "rclpy.action.client":
        client = found.ActionClient
        ready = client.server_is_ready
        _wrap(client, "__init__", _action("action_client"))
        _wrap(client, "wait_for_server", _waits("action", lambda c: str(c._preflight_name), ready, flush))
    elif name == "rclpy.action.server":
        _wrap(found.ActionServer, "__init__", _action("action_server"))
    elif name == "rclpy.wait_for_message":
        _wrap(found, "wait_for_message", _first_message(flush))
    elif name == "ament_index_python.packages":
        _wrap(found, "get_package_share_directory", _source_packages(found.PackageNotFoundError))
