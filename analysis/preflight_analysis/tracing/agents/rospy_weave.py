"""What is woven into which module of rospy."""

from __future__ import annotations

import time
from types import ModuleType
from typing import Any, Callable

import aspectlib  # type: ignore[import-untyped]

from . import channel, mock_replies, polling
from .rospy_aspects import Advised, after, before
from .rospy_endpoints import makes_endpoint
from .rospy_loop import initialises, iterates, publishes, shuts_down, spins
from .rospy_reads import asks_for, polled_parameter, reads_parameter
from .rospy_waits import calls_service, waits


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
        aspectlib.weave(getattr(module, name), makes_endpoint(role, watch), methods=["__init__"], subclasses=False)

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
                function(
                    client, name, polled_parameter(access, client._unspecified, root.names.resolve_name, watch), rospy
                )
            function(client, name, reads_parameter(access, client._unspecified, root.names.resolve_name, watch), rospy)

    function(client, "init_node", after(initialises(watch)), rospy)
    function(client, "spin", spins(flush, watch), rospy)
    function(root.core, "signal_shutdown", before(shuts_down), rospy)

    def there(arguments: dict[str, Any]) -> None:
        mock_replies.taken_to_be_there(root.names.resolve_name(arguments["service"]))

    def first(arguments: dict[str, Any]) -> Any:
        return mock_replies.empty(arguments["topic_type"])

    function(client, "wait_for_message", waits(root, flush, watch, "message", "topic", first), rospy)
    function(services, "wait_for_service", waits(root, flush, watch, "service", "service", there), rospy)
    aspectlib.weave(services.ServiceProxy, calls_service(services.ServiceException), methods=["call"], subclasses=False)
    aspectlib.weave(root.topics.Publisher, publishes(watch), methods=["publish"], subclasses=False)
    aspectlib.weave(root.timer.Rate, iterates(flush, watch, loops=True), methods=["sleep"], subclasses=False)
    # Only the names that nodes use: rospy's own modules call these on every turn.
    function(rospy, "sleep", iterates(flush, watch, loops=False))
    function(rospy, "is_shutdown", iterates(flush, watch, loops=True))
    for name, what in (
        ("get_name", ("name",)),
        ("get_caller_id", ("name",)),
        ("get_namespace", ("namespace",)),
        ("resolve_name", ("name", "remaps")),
        ("remap_name", ("name", "remaps")),
    ):
        function(rospy, name, asks_for(*what))
    root.impl.init.time = _QuickTime()
    channel.send("woven")
