"""The aspects woven into rospy: each endpoint and parameter call is told with the name that the node gave it."""

from __future__ import annotations

import inspect
import json
import sys
import threading
import time
from types import FrameType, ModuleType
from typing import Any, Callable, Optional

import aspectlib  # type: ignore[import-untyped]

from . import channel, mock_replies, polling, tf_frames
from .weaving import in_main_thread, quiet

Advised = Callable[..., Any]

_LIBRARIES = frozenset(
    (
        "rospy",
        "aspectlib",
        "preflight_agents",
        "functools",
        "message_filters",
        "actionlib",
        "tf",
        "tf2_ros",
        "dynamic_reconfigure",
        "ddynamic_reconfigure_python",
        "image_transport",
        "rosparam",
        "diagnostic_updater",
    )
)
"""Frames in these are not the node's own."""
_BUILTINS = frozenset(("/rosout", "~get_loggers", "~set_logger_level", "/clock"))
_MAX_DEFAULT = 4_000
_MAX_SITES = 2_000

_reported: set[tuple[Any, ...]] = set()


def _top(frame: FrameType) -> str:
    return str(frame.f_globals.get("__name__", "")).partition(".")[0]


def caller() -> tuple[Optional[str], Optional[int], bool]:
    """File and line of the node's own call, and whether rospy itself made the call."""
    frame: Optional[FrameType] = sys._getframe(1)
    while frame is not None and _top(frame) in ("preflight_agents", "aspectlib", "functools"):
        frame = frame.f_back
    internal = frame is not None and _top(frame) == "rospy"
    while frame is not None and _top(frame) in _LIBRARIES:
        frame = frame.f_back
    if frame is None:
        return None, None, internal
    return frame.f_code.co_filename, frame.f_lineno, internal


def _before(report: Callable[..., None]) -> Callable[[Advised], Advised]:
    """Aspect: `report(bound arguments)` before the call."""
    report = quiet(report)

    def aspect(cutpoint: Advised) -> Advised:
        signature = inspect.signature(cutpoint)

        def advised(*args: Any, **kwargs: Any) -> Any:
            try:
                arguments = signature.bind(*args, **kwargs).arguments
            except TypeError:
                return cutpoint(*args, **kwargs)
            report(arguments)
            return cutpoint(*args, **kwargs)

        return advised

    return aspect


def _after(report: Callable[..., None]) -> Callable[[Advised], Advised]:
    """Aspect: `report(bound arguments)` after the call returned."""
    report = quiet(report)

    def aspect(cutpoint: Advised) -> Advised:
        signature = inspect.signature(cutpoint)

        def advised(*args: Any, **kwargs: Any) -> Any:
            result = cutpoint(*args, **kwargs)
            report(signature.bind(*args, **kwargs).arguments)
            return result

        return advised

    return aspect


def _endpoint(role: str, watch: polling.Watch) -> Callable[[Advised], Advised]:
    def report(arguments: dict[str, Any]) -> None:
        made, given = arguments["self"], str(arguments["name"])
        described = arguments.get("data_class", arguments.get("service_class"))
        file, line, internal = caller()
        qos: dict[str, Any] = {}
        if role == "publisher":
            qos["latch"] = bool(arguments.get("latch", False))
        if role in ("publisher", "subscriber"):
            size = arguments.get("queue_size")
            qos["queue_size"] = size if isinstance(size, int) else None
        channel.send(
            "endpoint",
            role=role,
            name=given,
            resolved=made.resolved_name,
            type=getattr(described, "_type", None),
            md5=getattr(described, "_md5sum", None),
            qos=qos,
            file=file,
            line=line,
            builtin=internal and given in _BUILTINS,
            speculative=mock_replies.speculative(),
            awaits=arguments.get("subscriber_listener") is not None,
        )
        if role == "publisher":
            tf_frames.watch(made)
        watch.something_new()
        if role == "subscriber" and not internal:
            watch.subscribed(made)

    return _after(report)


def _default(value: object) -> object:
    try:
        return value if len(json.dumps(value)) <= _MAX_DEFAULT else repr(value)[:_MAX_DEFAULT]
    except (TypeError, ValueError, RecursionError):
        return repr(value)[:_MAX_DEFAULT]


def _polled(
    access: str, unspecified: object, resolve: Callable[[str], str], watch: polling.Watch
) -> Callable[[Advised], Advised]:
    """A parameter that the main thread asks for again and again until it is set."""

    def aspect(cutpoint: Advised) -> Advised:
        def advised(param_name: Any, default: Any = unspecified) -> Any:
            more = () if default is unspecified else (default,)
            try:
                result = cutpoint(param_name, *more)
            except KeyError:
                if not polled(param_name):
                    raise
                return plausible(param_name)
            if default is not unspecified and default is not None:
                watch.defaults[resolve(str(param_name))] = default
            if (result is False if access == "has" else result is None and default is None) and polled(param_name):
                return True if access == "has" else plausible(param_name)
            return result

        return advised

    def plausible(name: Any) -> Any:
        """What the node itself takes elsewhere, or what can be a rate, a size and a yes."""
        return watch.defaults.get(resolve(str(name)), 1)

    def polled(name: Any) -> bool:
        """Whether a parameter that is not set is to be taken as set."""
        full = resolve(str(name))
        if in_main_thread() and full not in watch.given:
            watch.asked(full, *caller())
        return full in watch.given

    return aspect


def _parameter(
    access: str, unspecified: object, resolve: Callable[[str], str], watch: polling.Watch
) -> Callable[[Advised], Advised]:
    def report(arguments: dict[str, Any]) -> None:
        file, line, internal = caller()
        name = str(arguments.get("param_name", "/"))
        site = (access, name, file, line)
        if site in _reported or len(_reported) > _MAX_SITES:
            return
        _reported.add(site)
        watch.something_new()
        default = arguments.get("default", unspecified)
        channel.send(
            "param",
            access=access,
            name=name,
            resolved=name if access in ("search", "list") else resolve(name),
            default=None if default is unspecified else _default(default),
            has_default=default is not unspecified,
            file=file,
            line=line,
            builtin=internal,
        )

    return _before(report)


def _asked(*what: str) -> Callable[[Advised], Advised]:
    """The node looks at its own name, namespace or remaps: what it does may depend on them."""

    def report(_arguments: dict[str, Any]) -> None:
        if what not in _reported and not caller()[2]:
            _reported.add(what)
            for one in what:
                channel.send("asked", what=one)

    return _before(report)


def _other_threads() -> int:
    """How many threads the node started itself; rospy's own do not count."""
    own = 0
    for thread in threading.enumerate():
        if thread is threading.main_thread() or isinstance(thread, threading._DummyThread):
            continue
        module = str(getattr(getattr(thread, "_target", None), "__module__", None) or type(thread).__module__)
        if (
            module.partition(".")[0] not in ("rospy", "rosgraph", "roslib", "preflight_agents")
            or module == "rospy.timer"
        ):
            own += 1
    return own


def _ends(_arguments: dict[str, Any]) -> None:
    """The node is shut down, by whomever: however long that takes, it is no event loop."""
    channel.send("state", state="ending")


def _spin(flush: Callable[[], None], watch: polling.Watch) -> Callable[[Advised], Advised]:
    """The main thread enters its event loop."""

    def report(_arguments: dict[str, Any]) -> None:
        if in_main_thread():
            watch.over()
            flush()
            channel.send("state", state="spin", threads=_other_threads())

    return _before(report)


def _iteration(flush: Callable[[], None], watch: polling.Watch, loops: bool) -> Callable[[Advised], Advised]:
    """A call that stands in a loop of the main thread: always (`loops`), or if it comes twice from the same place.

    A single `rospy.sleep` may be a pause before more endpoints are made.
    """

    def report(arguments: dict[str, Any]) -> None:
        if "looped" in polling.told_states or not in_main_thread() or watch.waiting():
            return
        file, line, internal = caller()
        if internal:
            return
        again = (file, line) in polling.iterations
        polling.iterations.add((file, line))
        state = "looped" if again else "idle"
        duration = arguments.get("duration", getattr(arguments.get("self"), "sleep_dur", 0.0))
        seconds = duration.to_sec() if hasattr(duration, "to_sec") else float(duration)
        pause = state == "idle" and not loops
        starving = watch.turned((file, line), seconds, pause)
        if pause:
            flush()
            channel.send("state", state="sleep", seconds=seconds)
        elif state not in polling.told_states:
            polling.told_states.add(state)
            flush()
            channel.send("state", state=state, threads=_other_threads(), starving=starving)

    return _before(report)


def _wait(
    rospy: Any,
    flush: Callable[[], None],
    watch: polling.Watch,
    kind: str,
    argument: str,
    answer: Callable[[dict[str, Any]], Any],
) -> Callable[[Advised], Advised]:
    """The node blocks until somebody else is there; if nobody comes, `answer(bound arguments)` is returned."""

    @quiet
    def report(state: str, name: str) -> None:
        file, line, _ = caller()
        channel.send("state", state=state, kind=kind, name=name, file=file, line=line, main=in_main_thread())
        if in_main_thread():
            watch.waits(1 if state == "wait" else -1)
        if state == "wait":
            flush()

    def aspect(cutpoint: Advised) -> Advised:
        signature = inspect.signature(cutpoint)

        def advised(*args: Any, **kwargs: Any) -> Any:
            try:
                bound = signature.bind(*args, **kwargs)
                name = str(bound.arguments[argument])
            except TypeError:
                return cutpoint(*args, **kwargs)
            report("wait", name)
            try:
                by_itself, result = mock_replies.limited(
                    cutpoint, bound, rospy.ROSInterruptException, rospy.ROSException
                )
                if by_itself:
                    return result
                mock_replies.made_up(kind, name)
                return answer(bound.arguments)
            finally:
                report("resume", name)

        return advised

    return aspect


def _initialised(watch: polling.Watch) -> Callable[[dict[str, Any]], None]:
    def report(_arguments: dict[str, Any]) -> None:
        channel.send("state", state="init")
        if in_main_thread():
            watch.start()

    return report


def _publishes(watch: polling.Watch) -> Callable[[Advised], Advised]:
    """The main thread publishes."""

    def report(_arguments: dict[str, Any]) -> None:
        if in_main_thread() and not caller()[2]:
            watch.published()

    return _before(report)


def _call(refused: Any) -> Callable[[Advised], Advised]:
    """A call of a service that nobody offers."""

    def aspect(cutpoint: Advised) -> Advised:
        def advised(self: Any, *args: Any, **kwargs: Any) -> Any:
            try:
                return cutpoint(self, *args, **kwargs)
            except refused as error:
                service = self.resolved_name
                if not str(error).endswith("unavailable") or not mock_replies.call_is_answered(service, *caller()):
                    raise
                return mock_replies.empty(self.response_class)

        return advised

    return aspect


class _QuickTime:
    """`time` for rospy's start, which looks for its registration only every 0.1 s."""

    def __getattr__(self, name: str) -> Any:
        return getattr(time, name)

    @staticmethod
    def sleep(seconds: float) -> None:
        time.sleep(min(seconds, 0.001))


def weave(rospy: ModuleType, flush: Callable[[], None]) -> None:
    """Weave rospy, freshly imported. `flush` tells the files opened so far; it is called when the node may stop."""

    def function(module: Any, name: str, aspect: Callable[[Advised], Advised], *aliases: Any) -> None:
        original = getattr(module, name)
        aspectlib.patch_module_function(module, original, aspect, force_name=name)
        for alias in aliases:
            if getattr(alias, name, None) is original:
                setattr(alias, name, getattr(module, name))

    root: Any = rospy
    watch = polling.Watch(root)
    services = root.impl.tcpros_service
    for module, name, role in (
        (root.topics, "Publisher", "publisher"),
        (root.topics, "Subscriber", "subscriber"),
        (services, "Service", "service"),
        (services, "ServiceProxy", "client"),
    ):
        aspectlib.weave(getattr(module, name), _endpoint(role, watch), methods=["__init__"], subclasses=False)

    client = root.client
    for name, access in (
        ("get_param", "get"),
        ("get_param_cached", "get"),
        ("has_param", "has"),
        ("set_param", "set"),
        ("delete_param", "delete"),
        ("search_param", "search"),
        ("get_param_names", "list"),
    ):
        if hasattr(client, name):
            if access in ("get", "has"):
                function(client, name, _polled(access, client._unspecified, root.names.resolve_name, watch), rospy)
            function(client, name, _parameter(access, client._unspecified, root.names.resolve_name, watch), rospy)

    function(client, "init_node", _after(_initialised(watch)), rospy)
    function(client, "spin", _spin(flush, watch), rospy)
    function(root.core, "signal_shutdown", _before(_ends), rospy)

    def there(arguments: dict[str, Any]) -> None:
        mock_replies.taken_to_be_there(root.names.resolve_name(arguments["service"]))

    def first(arguments: dict[str, Any]) -> Any:
        return mock_replies.empty(arguments["topic_type"])

    function(client, "wait_for_message", _wait(root, flush, watch, "message", "topic", first), rospy)
    function(services, "wait_for_service", _wait(root, flush, watch, "service", "service", there), rospy)
    aspectlib.weave(services.ServiceProxy, _call(services.ServiceException), methods=["call"], subclasses=False)
    aspectlib.weave(root.topics.Publisher, _publishes(watch), methods=["publish"], subclasses=False)
    aspectlib.weave(root.timer.Rate, _iteration(flush, watch, loops=True), methods=["sleep"], subclasses=False)
    # Only the names that nodes use: rospy's own modules call these on every turn.
    function(rospy, "sleep", _iteration(flush, watch, loops=False))
    function(rospy, "is_shutdown", _iteration(flush, watch, loops=True))
    for name, what in (
        ("get_name", ("name",)),
        ("get_caller_id", ("name",)),
        ("get_namespace", ("namespace",)),
        ("resolve_name", ("name", "remaps")),
        ("remap_name", ("name", "remaps")),
    ):
        function(rospy, name, _asked(*what))
    root.impl.init.time = _QuickTime()
    channel.send("woven")
