"""Waits of a node of rclpy for others, which are answered as those of rospy are (`mock_replies`)."""

from __future__ import annotations

import sys
import time
from typing import Any, Callable

from . import channel, mock_replies
from .rclpy_names import caller
from .weaving import bound_arguments, in_main_thread, quiet

_there: set[str] = set()
_polls: dict[Any, int] = {}


@quiet
def _report_wait(state: str, kind: str, name: str, flush: Callable[[], None]) -> None:
    file, line, _ = caller()
    channel.send("state", state=state, kind=kind, name=name, file=file, line=line, main=in_main_thread())
    if state == "wait":
        flush()


def waits(
    kind: str, name_of: Callable[[Any], str], ready: Callable[[Any], bool], flush: Callable[[], None]
) -> Callable[..., Any]:
    """`wait_for_service` and `wait_for_server`: after a while they are told that it is there."""

    def advice(original: Callable[..., Any]) -> Callable[..., Any]:
        def wait(*args: Any, **kwargs: Any) -> bool:
            arguments = bound_arguments(original, args, kwargs)
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


def service_of(client: Any) -> str:
    """The name of a client's service; Humble has only the one that was given."""
    return str(getattr(client, "service_name", None) or getattr(client, "srv_name", ""))


def _is_up(client: Any) -> bool:
    """Whether the client library was not shut down meanwhile."""
    context = getattr(client, "context", None)
    return context is None or bool(context.ok())


def is_ready(original: Callable[..., Any]) -> Callable[..., Any]:
    """`service_is_ready`: who asks again and again from one place waits."""

    def asked(client: Any) -> bool:
        if original(client):
            return True
        file, line, _ = caller()
        key = (service_of(client), file, line)
        _polls[key] = _polls.get(key, 0) + 1
        if _polls[key] > 3:
            if service_of(client) not in _there:
                _there.add(service_of(client))
                mock_replies.made_up("services", service_of(client))
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


def calls(later: bool, ready: Callable[[Any], bool]) -> Callable[..., Any]:
    """A call of a service that was taken to be there."""

    def advice(original: Callable[..., Any]) -> Callable[..., Any]:
        def call(self: Any, *args: Any, **kwargs: Any) -> Any:
            # A plain call has no end without somebody who answers.
            if ready(self) or (later and service_of(self) not in _there):
                return original(self, *args, **kwargs)
            mock_replies.made_up("call", service_of(self))
            response = _response(self.srv_type)
            if not later:
                return response
            future = sys.modules["rclpy.task"].Future()  # of those that rclpy.client imports
            future.set_result(response)
            return future

        return call

    return advice


def first_message(flush: Callable[[], None]) -> Callable[..., Any]:
    """`wait_for_message`: after a while it gets one of zeros."""

    def advice(original: Callable[..., Any]) -> Callable[..., Any]:
        def wait(*args: Any, **kwargs: Any) -> Any:
            arguments = bound_arguments(original, args, kwargs)
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
