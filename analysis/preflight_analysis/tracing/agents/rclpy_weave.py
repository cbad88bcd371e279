"""What is woven into which module of rclpy.

Each endpoint (`rclpy_endpoints`) and declared parameter (`rclpy_parameters`) is sent with the name that the node gave
it. Lifecycle nodes (`rclpy_lifecycle`) are configured and activated once they reach their event loop (`rclpy_loop`),
which is where their topics are made; waits for other nodes are answered (`rclpy_waits`).
"""

from __future__ import annotations

import json
import os
from types import ModuleType
from typing import Any, Callable

from . import channel
from .rclpy_endpoints import creates, makes_action
from .rclpy_lifecycle import TRIGGERS, offers_transitions, triggers
from .rclpy_loop import completes, iterates_once, shuts_down, spins
from .rclpy_nodes import LOOKS, asks_own_name, constructed, looks_around
from .rclpy_parameters import declares
from .rclpy_waits import calls, first_message, is_ready, service_of, waits
from .variables import SHARES
from .weaving import wrap


def weave(module: ModuleType, flush: Callable[[], None]) -> None:
    """Weave one of `hooks.RCLPY`, freshly imported. `flush` tells the files opened so far; it is called when the node
    may stop."""
    found: Any = module
    name = module.__name__
    if name == "rclpy":
        wrap(found, "spin", spins(flush))
        wrap(found, "spin_once", iterates_once(flush))
        wrap(found, "spin_until_future_complete", completes(flush))
        for function in ("shutdown", "try_shutdown"):
            wrap(found, function, shuts_down)
        channel.send("woven")
    elif name == "rclpy.node":
        node = found.Node
        wrap(node, "__init__", constructed)
        wrap(node, "declare_parameters", declares)
        for method in ("get_name", "get_namespace", "get_fully_qualified_name", "resolve_topic_name"):
            wrap(node, method, asks_own_name)
        wrap(node, "resolve_service_name", asks_own_name)
        for method in LOOKS:
            wrap(node, method, looks_around)
        wrap(node, "create_publisher", creates("publisher", "msg_type", "topic", True))
        wrap(node, "create_subscription", creates("subscriber", "msg_type", "topic", True))
        wrap(node, "create_service", creates("service", "srv_type", "srv_name", False))
        wrap(node, "create_client", creates("client", "srv_type", "srv_name", False))
    elif name == "rclpy.client":
        ready = found.Client.service_is_ready
        wrap(found.Client, "wait_for_service", waits("service", service_of, ready, flush))
        wrap(found.Client, "service_is_ready", is_ready)
        wrap(found.Client, "call", calls(False, ready))
        wrap(found.Client, "call_async", calls(True, ready))
    elif name == "rclpy.executors":
        wrap(found.Executor, "spin", spins(flush))
        wrap(found.Executor, "spin_until_future_complete", completes(flush))
        for executor in (found.SingleThreadedExecutor, found.MultiThreadedExecutor):
            wrap(executor, "spin_once", iterates_once(flush))
    elif name == "rclpy.timer":
        wrap(found.Rate, "sleep", iterates_once(flush))
    elif name == "rclpy.action.client":
        client = found.ActionClient
        ready = client.server_is_ready
        wrap(client, "__init__", makes_action("action_client"))
        wrap(client, "wait_for_server", waits("action", lambda c: str(c._preflight_name), ready, flush))
    elif name == "rclpy.action.server":
        wrap(found.ActionServer, "__init__", makes_action("action_server"))
    elif name == "rclpy.lifecycle.node":
        mixin = getattr(found, "LifecycleNodeMixin", None) or found.LifecycleMixin
        wrap(mixin, "__init__", offers_transitions)
        for transition in TRIGGERS:
            wrap(mixin, f"trigger_{transition}", triggers(transition))
    elif name == "rclpy.wait_for_message":
        wrap(found, "wait_for_message", first_message(flush))
    elif name == "ament_index_python.packages":
        wrap(found, "get_package_share_directory", _source_packages(found.PackageNotFoundError))


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
