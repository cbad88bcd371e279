"""The nodes of rclpy in a process: how they are made, and whether they look at themselves and others."""

from __future__ import annotations

import os
import sys
import weakref
from typing import Any, Callable

from . import channel
from .rclpy_lifecycle import not_asked
from .rclpy_names import LIBRARIES, full_name, top_package
from .variables import EXPECTED
from .weaving import bound_arguments, quiet

LOOKS = (
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

_OVERRIDES = "automatically_declare_parameters_from_overrides"
from_overrides: Any = weakref.WeakValueDictionary()
"""The nodes, by their `id`, that declare what the launch sets before their own code does: with any type."""


def constructed(original: Callable[..., Any]) -> Callable[..., Any]:
    """A node is made: it may take parameters that it does not declare."""

    @quiet
    def report(node: Any, arguments: dict[str, Any]) -> None:
        not_asked.append(node)
        name = str(node.get_name())
        channel.send(
            "node",
            name=name,
            given=str(arguments.get("node_name")),
            space=str(arguments.get("namespace") or ""),
            full=full_name(node),
            renamed=name == os.environ.get(EXPECTED, "").rpartition("/")[2],
        )
        if any(arguments.get(option) for option in ("allow_undeclared_parameters", _OVERRIDES)):
            channel.send("param", access="list", name="/", optional=True, node=full_name(node))
        channel.send("state", state="init")

    @quiet
    def begin(args: Any, kwargs: Any) -> None:
        arguments = bound_arguments(original, args, kwargs)
        if arguments.get(_OVERRIDES):
            from_overrides[id(arguments["self"])] = arguments["self"]

    def made(*args: Any, **kwargs: Any) -> None:
        begin(args, kwargs)
        original(*args, **kwargs)
        arguments = bound_arguments(original, args, kwargs)
        report(arguments["self"], arguments)

    return made


def asks_own_name(original: Callable[..., Any]) -> Callable[..., Any]:
    """The node looks at its own name: what it does may depend on it."""

    def asked(*args: Any, **kwargs: Any) -> Any:
        if top_package(sys._getframe(1)) not in LIBRARIES:
            channel.send("asked", what="name")
        return original(*args, **kwargs)

    return asked


def looks_around(original: Callable[..., Any]) -> Callable[..., Any]:
    """The node looks which nodes, topics or services there are: what it does may depend on it."""

    def looked(*args: Any, **kwargs: Any) -> Any:
        if top_package(sys._getframe(1)) not in LIBRARIES:
            channel.send("asked", what="graph")
        return original(*args, **kwargs)

    return looked
