"""The endpoints that a rospy node makes: each is sent with the name that the node gave it."""

from __future__ import annotations

from typing import Any, Callable

from . import channel, mock_replies, polling, tf_frames
from .rospy_aspects import Advised, after, caller

_BUILTINS = frozenset(("/rosout", "~get_loggers", "~set_logger_level", "/clock"))


def makes_endpoint(role: str, watch: polling.Watch) -> Callable[[Advised], Advised]:
    """A constructor of a publisher, subscriber, service or client."""

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

    return after(report)
