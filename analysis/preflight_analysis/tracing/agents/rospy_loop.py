"""The event loop of a rospy node, and what it does until it is there."""

from __future__ import annotations

import threading
from typing import Any, Callable

from . import channel, polling
from .rospy_aspects import Advised, before, caller
from .weaving import in_main_thread


def _other_threads() -> int:
    """How many threads the node started itself; rospy's own do not count."""
    own = 0
    for thread in threading.enumerate():
        if thread is threading.main_thread() or isinstance(thread, threading._DummyThread):
            continue
        module = str(getattr(getattr(thread, "_target", None), "__module__", None) or type(thread).__module__)
        if (
            module.partition(".")[0] not in ("rospy", "rosgraph", "roslib", "preflight_agents")
            or module == "rospy.timer"
        ):
            own += 1
    return own


def shuts_down(_arguments: dict[str, Any]) -> None:
    """The node is shut down, by whomever: however long that takes, it is no event loop."""
    channel.send("state", state="ending")


def spins(flush: Callable[[], None], watch: polling.Watch) -> Callable[[Advised], Advised]:
    """The main thread enters its event loop."""

    def report(_arguments: dict[str, Any]) -> None:
        if in_main_thread():
            watch.over()
            flush()
            channel.send("state", state="spin", threads=_other_threads())

    return before(report)


def iterates(flush: Callable[[], None], watch: polling.Watch, loops: bool) -> Callable[[Advised], Advised]:
    """A call that stands in a loop of the main thread: always (`loops`), or if it comes twice from the same place.

    A single `rospy.sleep` may be a pause before more endpoints are made.
    """

    def report(arguments: dict[str, Any]) -> None:
        if "looped" in polling.sent_states or not in_main_thread() or watch.waiting():
            return
        file, line, internal = caller()
        if internal:
            return
        again = (file, line) in polling.iterations
        polling.iterations.add((file, line))
        state = "looped" if again else "idle"
        duration = arguments.get("duration", getattr(arguments.get("self"), "sleep_dur", 0.0))
        seconds = duration.to_sec() if hasattr(duration, "to_sec") else float(duration)
        pause = state == "idle" and not loops
        starving = watch.turned((file, line), seconds, pause)
        if pause:
            flush()
            channel.send("state", state="sleep", seconds=seconds)
        elif state not in polling.sent_states:
            polling.sent_states.add(state)
            flush()
            channel.send("state", state=state, threads=_other_threads(), starving=starving)

    return before(report)


def initialises(watch: polling.Watch) -> Callable[[dict[str, Any]], None]:
    """After `init_node`."""

    def report(_arguments: dict[str, Any]) -> None:
        channel.send("state", state="init")
        if in_main_thread():
            watch.start()

    return report


def publishes(watch: polling.Watch) -> Callable[[Advised], Advised]:
    """The main thread publishes."""

    def report(_arguments: dict[str, Any]) -> None:
        if in_main_thread() and not caller()[2]:
            watch.published()

    return before(report)
