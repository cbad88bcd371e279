"""The event loop of a node of rclpy: once its main thread is there, all that it makes by itself is made."""

from __future__ import annotations

import sys
import threading
from types import FrameType
from typing import Any, Callable, Optional

from . import channel
from .rclpy_lifecycle import activate
from .rclpy_names import top_package
from .weaving import bound_arguments, in_main_thread, quiet

_OWN_THREADS = ("rclpy", "preflight_agents")
_iterations: set[Any] = set()
_sent_states: set[str] = set()


def _other_threads() -> int:
    """How many threads the node started itself."""
    own = 0
    for thread in threading.enumerate():
        if thread is threading.main_thread() or isinstance(thread, threading._DummyThread):
            continue
        module = str(getattr(getattr(thread, "_target", None), "__module__", None) or type(thread).__module__)
        own += module.partition(".")[0] not in _OWN_THREADS
    return own


def spins(flush: Callable[[], None]) -> Callable[..., Any]:
    """The main thread enters its event loop."""

    @quiet
    def report() -> None:
        activate()
        if in_main_thread():
            flush()
            channel.send("state", state="spin", threads=_other_threads())

    def advice(original: Callable[..., Any]) -> Callable[..., Any]:
        def spin(*args: Any, **kwargs: Any) -> Any:
            report()
            return original(*args, **kwargs)

        return spin

    return advice


def iterates_once(flush: Callable[[], None]) -> Callable[..., Any]:
    """A call that stands in a loop of the main thread."""

    @quiet
    def report() -> None:
        frame: Optional[FrameType] = sys._getframe(3)  # who calls `iteration`
        while frame is not None and top_package(frame) in ("preflight_agents", "functools"):
            frame = frame.f_back
        if frame is None or top_package(frame) == "rclpy" or not in_main_thread():
            return
        place = (frame.f_code.co_filename, frame.f_lineno)
        state = "looped" if place in _iterations else "idle"
        _iterations.add(place)
        if state not in _sent_states:
            _sent_states.add(state)
            activate()
            flush()
            channel.send("state", state=state, threads=_other_threads())

    def advice(original: Callable[..., Any]) -> Callable[..., Any]:
        def iteration(*args: Any, **kwargs: Any) -> Any:
            report()
            return original(*args, **kwargs)

        return iteration

    return advice


def completes(flush: Callable[[], None]) -> Callable[..., Any]:
    """`spin_until_future_complete`: an event loop where nobody ever completes the future."""
    woven = spins(flush)

    def advice(original: Callable[..., Any]) -> Callable[..., Any]:
        spin = woven(original)

        def until(*args: Any, **kwargs: Any) -> Any:
            future = bound_arguments(original, args, kwargs).get("future")
            done = getattr(future, "done", None)
            return original(*args, **kwargs) if done is not None and done() else spin(*args, **kwargs)

        return until

    return advice


def shuts_down(original: Callable[..., Any]) -> Callable[..., Any]:
    """The client library is shut down: however long that takes, it is no event loop."""

    def ending(*args: Any, **kwargs: Any) -> Any:
        channel.send("state", state="ending")
        return original(*args, **kwargs)

    return ending
