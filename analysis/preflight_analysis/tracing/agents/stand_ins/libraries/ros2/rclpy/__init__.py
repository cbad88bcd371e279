"""rclpy (https://docs.ros.org/en/jazzy/p/rclpy/): names and parameters are real, nothing is sent and nobody called."""

from __future__ import annotations

import importlib
from typing import Any

from . import context as _contexts
from . import logging, task
from .context import Context
from .parameter import Parameter
from .utilities import get_default_context, get_rmw_implementation_identifier, ok
from .utilities import shutdown as _shutdown
from .utilities import try_shutdown as _try_shutdown

__all__ = [
    "Context",
    "Parameter",
    "create_node",
    "get_default_context",
    "get_global_executor",
    "get_rmw_implementation_identifier",
    "init",
    "logging",
    "ok",
    "shutdown",
    "spin",
    "spin_once",
    "spin_until_future_complete",
    "task",
    "try_shutdown",
]
_executor: Any = None


def init(*, args: Any = None, context: Any = None, domain_id: Any = None, signal_handler_options: Any = None) -> Any:
    """Begin."""
    found = context or _contexts.default
    found.init(args, domain_id=domain_id)
    return found


def get_global_executor() -> Any:
    global _executor  # noqa: PLW0603
    _executor = _executor or importlib.import_module("rclpy.executors").SingleThreadedExecutor()
    return _executor


def shutdown(*, context: Any = None, uninstall_handlers: Any = None) -> None:
    _shutdown(context=context)


def try_shutdown(*, context: Any = None, uninstall_handlers: Any = None) -> None:
    _try_shutdown(context=context)


def create_node(node_name: str, **kwargs: Any) -> Any:
    return importlib.import_module("rclpy.node").Node(node_name, **kwargs)


def spin_once(node: Any, *, executor: Any = None, timeout_sec: Any = None) -> None:
    (executor or get_global_executor()).spin_once(timeout_sec)


def spin(node: Any, executor: Any = None) -> None:
    found = executor or get_global_executor()
    found.add_node(node)
    found.spin()


def spin_until_future_complete(node: Any, future: Any, executor: Any = None, timeout_sec: Any = None) -> None:
    (executor or get_global_executor()).spin_until_future_complete(future, timeout_sec)


def __getattr__(name: str) -> Any:
    if name.startswith("__"):
        raise AttributeError(name)
    try:
        return importlib.import_module(f"rclpy.{name}")
    except ImportError:
        return importlib.import_module("preflight_agents.anything").Anything(f"rclpy.{name}")
