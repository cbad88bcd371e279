"""Made-up answers for a node that waits for somebody who is not in the sandbox.

A wait first gets the time that somebody in the sandbox needs to answer (the node itself may). Then it is told that what
it waits for is there, and given the emptiest value of the right type. What is found from then on is told as
speculative: in the whole process if its main thread was answered, else in the thread that was.
"""

from __future__ import annotations

import threading
from typing import Any, Callable

from . import channel

GRACE = 0.3
"""Seconds that the first wait has to end by itself."""
LATER_GRACE = 0.1
"""The same once one was answered: nobody is there."""

_all = threading.Event()
_thread = threading.local()
_services: set[str] = set()
_refused: set[tuple[Any, ...]] = set()


def speculative() -> bool:
    """Whether what the calling thread does now comes after a made-up answer."""
    return _all.is_set() or getattr(_thread, "answered", False)


def grace() -> float:
    """How long a wait may go on."""
    return LATER_GRACE if speculative() else GRACE


def made_up(kind: str, name: str) -> None:
    """The calling thread is about to get a made-up answer."""
    _thread.answered = True
    if threading.current_thread() is threading.main_thread():
        _all.set()
    channel.send("answered", kind=kind, name=name)


def everywhere() -> None:
    """What the whole process does from now on comes after a made-up answer."""
    _all.set()


def taken_to_be_there(service: str) -> None:
    """A wait for this service was answered: calls will be, too."""
    _services.add(service)


def call_is_answered(service: str, *site: Any) -> bool:
    """Whether a call of a service that nobody offers gets an answer: if the node waited for it, or calls it again from
    the same place. The first refusal is what it would get on the robot before the other node is up."""
    if service not in _services:
        if (service, *site) not in _refused:
            _refused.add((service, *site))
            return False
        made_up("calls", service)
    return True


def empty(described: Any, yes: bool = True) -> Any:
    """A message of zeros. A yes or no is a yes: a service that fails and a system that is not ready lead nowhere."""
    message = described()
    for field, kind in zip(message.__slots__, getattr(message, "_slot_types", ())):
        if kind == "bool" and yes:
            setattr(message, field, True)
    return message


def limited(call: Callable[..., Any], arguments: Any, interrupted: Any, timed_out: Any) -> tuple[bool, Any]:
    """Call with a timeout of at most the grace: whether it ended by itself, and what it gave. What else it raises is
    the node's."""
    given = arguments.arguments.get("timeout")
    seconds = given.to_sec() if hasattr(given, "to_sec") else given
    if seconds is None or seconds > grace():
        arguments.arguments["timeout"] = grace()
    try:
        return True, call(*arguments.args, **arguments.kwargs)
    except interrupted:
        raise
    except timed_out:
        return False, None
