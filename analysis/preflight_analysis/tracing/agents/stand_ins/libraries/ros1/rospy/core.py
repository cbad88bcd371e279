"""The state of the process, and its log (http://wiki.ros.org/rospy/Overview/Logging)."""

from __future__ import annotations

import atexit
import logging
import signal
import sys
from typing import Any, Callable
from urllib.parse import urlparse

from .exceptions import ParameterInvalid
from .names import get_caller_id, get_name

_initialized = False
_shutdown = False
_in_shutdown = False
_hooks: dict[str, list[Callable[..., Any]]] = {"preshutdown": [], "client": [], "shutdown": []}
_once: set[Any] = set()
_level = logging.INFO


def set_initialized(value: bool) -> None:
    global _initialized  # noqa: PLW0603
    _initialized = value


def is_initialized() -> bool:
    return _initialized


def is_shutdown() -> bool:
    return _shutdown


def is_shutdown_requested() -> bool:
    return _in_shutdown


def add_client_shutdown_hook(h: Callable[[], Any]) -> None:
    _hooks["client"].append(h)


def add_preshutdown_hook(h: Callable[[str], Any]) -> None:
    _hooks["preshutdown"].append(h)


def add_shutdown_hook(h: Callable[[str], Any]) -> None:
    _hooks["shutdown"].append(h)


def signal_shutdown(reason: str) -> None:
    """The node is to end."""
    global _shutdown, _in_shutdown  # noqa: PLW0603
    if _in_shutdown:
        return
    _in_shutdown = True
    for kind, arguments in (("preshutdown", (reason,)), ("client", ()), ("shutdown", (reason,))):
        _shutdown = _shutdown or kind == "shutdown"
        for hook in _hooks[kind]:
            try:
                hook(*arguments)
            except Exception as error:
                sys.stderr.write(f"signal_shutdown hook error[{error}]\n")


def register_signals() -> None:
    """Shut down at the usual signals."""

    def handler(number: int, frame: Any) -> None:
        signal_shutdown(f"signal-{number}")
        if number == signal.SIGINT:
            raise KeyboardInterrupt

    signal.signal(signal.SIGTERM, handler)
    signal.signal(signal.SIGINT, handler)


atexit.register(lambda: signal_shutdown("atexit"))


def configure(level: Any) -> None:
    """Log what is at least of this level, one of rospy's powers of two."""
    global _level  # noqa: PLW0603
    _level = {1: 10, 2: 20, 4: 30, 8: 40, 16: 50}.get(level, level)


def _log(level: int, word: str, message: Any, arguments: Any) -> None:
    if level >= _level:
        text = str(message) % arguments if arguments else str(message)
        stream = sys.stderr if level >= logging.WARNING else sys.stdout
        stream.write(f"[{word}] [0.000000]: {text}\n")
        stream.flush()


def _loggers(level: int, word: str) -> tuple[Callable[..., None], ...]:
    """To log always, at most once a period, the same likewise, and once."""

    def log(msg: Any, *args: Any, **kwargs: Any) -> None:
        _log(level, word, msg, args)

    def throttled(period: Any, msg: Any, *args: Any, **kwargs: Any) -> None:
        once(msg, *args)

    def once(msg: Any, *args: Any, **kwargs: Any) -> None:
        frame = sys._getframe(1)
        place = (frame.f_code.co_filename, frame.f_lineno)
        if place not in _once:
            _once.add(place)
            _log(level, word, msg, args)

    return log, throttled, throttled, once


logdebug, logdebug_throttle, logdebug_throttle_identical, logdebug_once = _loggers(logging.DEBUG, "DEBUG")
loginfo, loginfo_throttle, loginfo_throttle_identical, loginfo_once = _loggers(logging.INFO, "INFO")
logwarn, logwarn_throttle, logwarn_throttle_identical, logwarn_once = _loggers(logging.WARNING, "WARN")
logerr, logerr_throttle, logerr_throttle_identical, logerr_once = _loggers(logging.ERROR, "ERROR")
logfatal, logfatal_throttle, logfatal_throttle_identical, logfatal_once = _loggers(logging.CRITICAL, "FATAL")
logout = loginfo
rospydebug, rospyinfo, rospywarn, rospyerr = logdebug, loginfo, logwarn, logerr
logger = logging.getLogger("rospy")


def parse_rosrpc_uri(uri: str) -> tuple[str, int]:
    """Host and port of a service."""
    parsed = urlparse(uri)
    if parsed.scheme != "rosrpc" or parsed.hostname is None or parsed.port is None:
        raise ParameterInvalid(f"ROS service URL is invalid: {uri}")
    return parsed.hostname, parsed.port


def get_node_uri() -> str:
    return "http://127.0.0.1:1/"


def get_ros_root(required: bool = False, env: Any = None) -> Any:
    import os  # noqa: PLC0415

    return (os.environ if env is None else env).get("ROS_ROOT")


__all__ = ["get_caller_id", "get_name"]
