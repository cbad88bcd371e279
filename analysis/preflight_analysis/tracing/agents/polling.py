"""Answers a node that polls: `while self.scan is None: rate.sleep()`, and the like.

No call tells that such a node waits. A thread looks whether its main thread goes on sleeping, without publishing and
without anything new, while it subscribes to topics that nobody publishes, asks for a parameter that is not set, or
simulated time has not begun. Then it gets messages, the parameter, the time. A node whose loop is its work goes on as
before, and nothing is found after it.
"""

from __future__ import annotations

import threading
import time
from typing import Any, Optional

from . import channel, mock_replies

QUIET = 0.25
"""Seconds without an endpoint or parameter call before a node counts as stalled."""
TICK = 0.05
FEEDS = 20
FEED_SECONDS = 0.01
"""Each topic gets so many messages, so far apart: some nodes collect a few."""
MAX_PERIOD = 1.5


class Watch:
    """What the main thread does, as the hooks tell it."""

    def __init__(self, rospy: Any) -> None:
        self.rospy = rospy
        self._active = time.monotonic()
        self._pause_until = 0.0
        self._turned = False
        self._period = 0.0
        self._published = 0
        self._seen: dict[Any, int] = {}
        self._working = False
        self._announced = False
        self._waits = 0
        self._over = False
        self._topics: dict[int, Any] = {}
        self._fed: set[int] = set()
        self._polled: dict[Any, int] = {}
        self._missing: set[str] = set()
        self.given: set[str] = set()
        """Parameters that are taken to be set."""
        self.defaults: dict[str, Any] = {}
        """What the node takes for those that are not."""
        self._clock = False
        _watches.append(self)

    # what the hooks tell

    def something_new(self) -> None:
        """An endpoint was made or a parameter asked for the first time."""
        self._active = time.monotonic()

    def subscribed(self, subscriber: Any) -> None:
        """The node made a subscriber of its own."""
        # Not the subscriber: a node need not keep it, and gets messages all the same.
        self._topics[id(subscriber.impl)] = subscriber.impl

    def published(self) -> None:
        """The main thread publishes: its loop does something."""
        self._published += 1
        self._working = self._working or self._turned
        if self._announced:
            self._announced = False
            channel.send("state", state="busy")

    def turned(self, place: Any, seconds: float, pause: bool) -> bool:
        """The main thread sleeps in a loop, or once (`pause`). Whether it may be waiting: then it will be answered."""
        before = self._seen.get(place, 0)
        self._seen[place] = self._published
        self._working = self._published > before
        self._period = seconds
        if pause:
            self._pause_until = time.monotonic() + (0.0 if self.without_time() else seconds)
        else:
            self._turned = True
        self._announced = self._starving()
        return self._announced

    def asked(self, parameter: str, *site: Any) -> None:
        """The main thread asked for a parameter that is not set."""
        key = (parameter, *site)
        self._polled[key] = self._polled.get(key, 0) + 1
        if self._polled[key] > 1 and parameter not in self.given:
            self._missing.add(parameter)

    def waits(self, change: int) -> None:
        """The main thread enters (1) or leaves (-1) a call that is answered in another way."""
        self._waits += change
        self._active = time.monotonic()

    def waiting(self) -> bool:
        """Whether the main thread is in such a call."""
        return self._waits > 0

    def over(self) -> None:
        """The main thread has reached its event loop."""
        self._over = True

    # what is made of it

    def without_time(self) -> bool:
        """Whether time is simulated and has not begun."""
        return (
            not self._clock and not self.rospy.rostime.is_wallclock() and self.rospy.rostime.get_rostime().to_sec() == 0
        )

    def _starved(self) -> list[Any]:
        return [
            impl
            for impl in list(self._topics.values())
            if id(impl) not in self._fed and impl.callbacks and not impl.get_num_connections()
        ]

    def _starving(self) -> bool:
        return not self._working and bool(self._starved() or self._missing or self.without_time())

    def start(self) -> None:
        """Watch the calling thread, the main one, from now on."""
        self.something_new()
        threading.Thread(target=self._run, args=(threading.current_thread(),), daemon=True).start()

    def _run(self, main: Any) -> None:
        try:
            self._look_on(main)
        except Exception as error:
            channel.send("weave-failed", message=repr(error))

    def _look_on(self, main: Any) -> None:
        clock = time.pthread_getcpuclockid(main.ident)
        began: Optional[float] = None
        used = switches = 0.0
        while main.is_alive() and not self._over:
            time.sleep(TICK)
            now = time.monotonic()
            since = max(self._active, self._pause_until)
            if self._waits or now < since or not self._starving():
                began = None
            elif began is None or began < since:
                began, used, switches = now, time.clock_gettime(clock), _switches(main)
            elif now - since >= QUIET and now - began >= 2 * TICK:
                if time.clock_gettime(clock) - used > 0.3 * (now - began):
                    began = None  # it computes or loads something
                elif self._turned or _switches(main) - switches >= 2:
                    self._answer()
                    began = None

    def _answer(self) -> None:
        """One kind of thing at a time: the more is made up, the less it says."""
        starved: list[Any] = []
        self._active = time.monotonic()
        if self.without_time():
            self._clock = True
            mock_replies.made_up("clock", "/clock")
            threading.Thread(target=self._tick, daemon=True).start()
        elif self._missing:
            for parameter in sorted(self._missing):
                mock_replies.made_up("parameter", parameter)
            self.given |= self._missing
            self._missing.clear()
        else:
            starved = self._starved()
            for impl in starved:
                self._fed.add(id(impl))
                mock_replies.made_up("poll", impl.resolved_name)
        mock_replies.everywhere()
        forget_iterations()
        self._turned = self._announced = False
        channel.send("state", state="fed", seconds=min(self._period, MAX_PERIOD))
        for impl in starved:
            threading.Thread(target=_feed, args=(impl,), daemon=True).start()

    def _tick(self) -> None:
        while True:
            self.rospy.rostime._set_rostime(self.rospy.rostime.Time.from_sec(time.time()))
            time.sleep(0.01)


_watches: list[Watch] = []


def watch() -> Watch:
    """The one of this process, once rospy is there."""
    return _watches[-1]


sent_states: set[str] = set()
iterations: set[Any] = set()
"""Of the main thread's loop: what was told of it, and the places that it has come to."""


def forget_iterations() -> None:
    """After an answer the loop that was seen may be over; another one is told of anew."""
    sent_states.clear()
    iterations.clear()


def _feed(impl: Any) -> None:
    for number in range(FEEDS):
        for callback, more in list(impl.callbacks or ()):
            message = mock_replies.empty(impl.data_class, yes=number % 2 == 1)
            message._connection_header = {"topic": impl.resolved_name, "callerid": "/", "type": impl.type}
            try:
                callback(message) if more is None else callback(message, more)
            except Exception:  # what a callback does to a made-up message is not the node's fault
                pass
        time.sleep(FEED_SECONDS)


def _switches(thread: Any) -> int:
    """How often a thread went to sleep."""
    with open(f"/proc/self/task/{thread.native_id}/status") as status:
        return next((int(line.split()[1]) for line in status if line.startswith("voluntary_ctxt")), 0)
