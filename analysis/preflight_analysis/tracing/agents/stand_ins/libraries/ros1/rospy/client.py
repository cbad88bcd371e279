"""The functions of a node: start, parameters, waits, event loop (http://wiki.ros.org/rospy/Overview)."""

from __future__ import annotations

import importlib
import os
import sys
import time
from typing import Any

from . import core, impl, msproxy, names, rostime, topics
from .exceptions import ROSException, ROSInitException, ROSInterruptException
from .impl.tcpros_service import Service

DEBUG, INFO, WARN, ERROR, FATAL = 1, 2, 4, 8, 16


class _Unspecified:
    """No default is given: None may be one."""


_unspecified = _Unspecified()
_arguments: Any = None


def myargv(argv: Any = None) -> list[str]:
    """The command line without remaps."""
    return [word for word in (sys.argv if argv is None else argv) if names.REMAP not in word]


def load_command_line_node_params(argv: Any) -> dict[str, Any]:
    """The parameters `_x:=1` of a command line."""
    pairs = (word.partition(names.REMAP) for word in argv if names.REMAP in word)
    return {
        source[1:]: _parsed(target)
        for source, _, target in pairs
        if source[:1] == "_" and source[:2] != "__" and target
    }


def _parsed(text: str) -> Any:
    try:
        return importlib.import_module("yaml").safe_load(text)
    except Exception:
        return text


def on_shutdown(h: Any) -> None:
    core.add_client_shutdown_hook(h)


def spin() -> None:
    """Wait for the end."""
    if not core.is_initialized():
        raise ROSInitException("client code must call rospy.init_node() first")
    try:
        while not core.is_shutdown():
            rostime.wallsleep(0.5)
    except KeyboardInterrupt:
        core.signal_shutdown("keyboard interrupt")


def init_node(
    name: str,
    argv: Any = None,
    anonymous: bool = False,
    log_level: Any = None,
    disable_rostime: bool = False,
    disable_rosout: bool = False,
    disable_signals: bool = False,
    xmlrpc_port: int = 0,
    tcpros_port: int = 0,
) -> None:
    """Start the node: once, or again with the same arguments."""
    global _arguments  # noqa: PLW0603
    if argv is None:
        argv = sys.argv
    else:
        names.reload_mappings(argv)
    if not name:
        raise ValueError("name must not be empty")
    if names.SEP in name:
        raise ValueError("namespaces are not allowed in node names")
    given = (name, argv, anonymous, log_level, disable_rostime, disable_signals)
    if _arguments:
        if _arguments != given:
            raise ROSException(f"rospy.init_node() has already been called with different arguments: {_arguments}")
        return
    _arguments = given
    if not disable_signals:
        core.register_signals()
    mappings = names.get_mappings()
    if "__name" in mappings:
        name, anonymous = mappings["__name"], False
    if anonymous:
        name = f"{name}_{os.getpid()}_{int(time.time() * 1000)}"
    full = names.canonicalize_name(names.get_namespace() + name)
    names.initialize_mappings(full)
    names._set_caller_id(full)
    topics.tell_master()
    for key, value in load_command_line_node_params(argv).items():
        set_param(names.PRIV_NAME + key, value)
    core.set_initialized(True)
    core.configure(INFO if log_level is None else log_level)
    if not disable_rosout:
        impl.rosout.init_rosout()
    if not disable_rostime:
        impl.simtime.init_simtime()
    rostime.set_rostime_initialized(True)
    logger = importlib.import_module("roscpp.srv")
    Service("~get_loggers", logger.GetLoggers, lambda request: None)
    Service("~set_logger_level", logger.SetLoggerLevel, lambda request: None)


def get_master(env: Any = os.environ) -> Any:
    return msproxy.MasterProxy()


def get_published_topics(namespace: str = "/") -> Any:
    code, message, value = msproxy.call("getPublishedTopics", namespace)
    if code != 1:
        raise ROSException(f"unable to get published topics: {message}")
    return value


def wait_for_message(topic: str, topic_type: Any, timeout: Any = None) -> Any:
    """The first message on a topic. Raises `ROSException` when the time is over."""
    got: list[Any] = []
    subscriber = topics.Subscriber(topic, topic_type, got.append)
    try:
        seconds = timeout.to_sec() if hasattr(timeout, "to_sec") else timeout
        end = None if seconds is None else time.time() + seconds
        while not core.is_shutdown() and not got:
            rostime.wallsleep(0.01)
            if end is not None and time.time() >= end:
                raise ROSException(f"timeout exceeded while waiting for message on topic {topic}")
    finally:
        subscriber.unregister()
    if core.is_shutdown():
        raise ROSInterruptException("rospy shutdown")
    return got[0]


# Parameters


def get_param(param_name: str, default: Any = _unspecified) -> Any:
    """The value, or the default. Raises `KeyError` without either."""
    try:
        return get_master()[param_name]
    except KeyError:
        if default is _unspecified:
            raise
        return default


def get_param_cached(param_name: str, default: Any = _unspecified) -> Any:
    return get_param(param_name, default)


def get_param_names() -> list[str]:
    return list(get_master())


def set_param(param_name: str, param_value: Any) -> None:
    get_master()[param_name] = param_value


def search_param(param_name: str) -> Any:
    return get_master().search_param(param_name)


def delete_param(param_name: str) -> None:
    del get_master()[param_name]


def has_param(param_name: str) -> bool:
    return param_name in get_master()
