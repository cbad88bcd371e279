"""The run of one node or command: what is heard of it on its way to the host, and whether it is over."""

from __future__ import annotations

import json
import os
import signal
import sys
import threading
import time
from typing import TYPE_CHECKING, Any, Optional

from .process import become, cpu_seconds, queued_seconds
from .process_limits import ProcessLimits

if TYPE_CHECKING:
    from .probe_topics import TopicProbes

MAX_LINE = 64_000
MAX_EVENTS = 20_000
TICK = 0.02
"""Seconds between looks at the clock."""
EVENTS = frozenset(
    (
        "endpoint",
        "frame",
        "loaded",
        "node",
        "param",
        "asked",
        "answered",
        "feed",
        "state",
        "transition",
        "files",
        "wrote",
        "stood-in",
        "lacked",
        "drew",
        "woven",
        "weave-failed",
    )
)


class Run:
    """One node, from exec to the end. Times are seconds of the monotonic clock."""

    def __init__(self, job: dict[str, Any]) -> None:
        self.job = job
        self.process_limits = ProcessLimits(job)
        self.lock = threading.Lock()
        self.sent: set[str] = set()
        self.count = 0
        self.dropped = 0
        self.started = self.active = time.monotonic()
        self.spins = False
        self.idle = False
        self.looped = False
        self.starving = False
        self.ending = False
        self.fed_until = 0.0
        self.initialised = False
        self.woven = False
        self.registered = False
        self.pause_until = 0.0
        self.waits: list[tuple[str, str]] = []
        self.lookups: dict[str, int] = {}
        self.polled = ""
        self.polled_at = 0.0
        self.cpu = 0.0
        self.queued = 0.0
        """Seconds for which the node wanted a processor and got none."""
        self.stretch = 0.0
        """The part of it by which its time is longer."""
        self.pid = -1
        self.screen: Optional[int] = None
        """The process of the node's X server."""
        self.master: Any = None
        self.fake_publisher: Any = None
        self.topic_probes: Optional[TopicProbes] = None

    def emit(self, record: dict[str, Any]) -> bool:
        """One line to the host; repetitions are left out. Whether it was new."""
        line = json.dumps(record, sort_keys=True)
        with self.lock:
            if line in self.sent or self.count >= MAX_EVENTS:
                return False
            self.sent.add(line)
            self.count += 1
            sys.stdout.write(line + "\n")
            sys.stdout.flush()
            return True

    def master_report(self, event: str, **fields: Any) -> None:
        """What the stub master hears. Polling for a service is no activity, or a waiting node would never be quiet."""
        if event == "m-lookup":
            self._lookup(fields["name"])
        self.registered = self.registered or event == "m-endpoint"
        if event == "m-endpoint" and fields["role"] == "service" and fields["name"].endswith("/set_logger_level"):
            self.initialised = True  # the last thing that roscpp and rospy do at their start
        # A parameter that is asked for again and again is none either.
        if self.emit({"own": dict(fields, ev=event)}) and event != "m-lookup":
            self.active = time.monotonic()

    def _lookup(self, service: str) -> None:
        self.lookups[service] = self.lookups.get(service, 0) + 1
        if self.lookups[service] > 2:
            self.polled, self.polled_at = service, time.monotonic()

    def node_line(self, line: bytes) -> None:
        """One line from the event FIFO."""
        try:
            event = json.loads(line)
        except (ValueError, RecursionError):
            event = None
        if not isinstance(event, dict) or event.get("ev") not in EVENTS:
            self.dropped += 1
            return
        self.woven = self.woven or event["ev"] == "woven"
        if event["ev"] == "state":
            self._state(event)
            return
        if event["ev"] == "feed":
            goal, awaited = str(event.get("goal") or "")[:300], event.get("awaited") is True
            self.publish(str(event.get("topic"))[:300], goal, awaited)
            return
        if event["ev"] == "endpoint":
            self._probe_topic(event)
        if self.emit({"node": event}) and event["ev"] in ("endpoint", "param"):
            # Only what is new: a parameter that a loop reads in each turn would keep the node from ever being quiet.
            self.active = time.monotonic()

    def publish(self, topic: str, goal: str = "", awaited: bool = False) -> None:
        """The node gets made-up messages. Most need none, so it is imported only now."""
        if self.master is None:
            return
        if self.fake_publisher is None:
            from . import fake_publisher  # noqa: PLC0415

            self.fake_publisher = fake_publisher.FakePublisher(self.master)
        self.fake_publisher.publish(topic, goal, awaited)

    def _probe_topic(self, endpoint: dict[str, Any]) -> None:
        """Whether somebody at the other end could make a difference."""
        role, topic = endpoint.get("role"), endpoint.get("resolved")
        lazy = (role == "publisher" and endpoint.get("awaits") is True) or (
            role == "subscriber" and endpoint.get("type") == "*"
        )
        if self.topic_probes is not None and lazy and isinstance(topic, str):
            self.topic_probes.add(str(role), topic)

    def _state(self, event: dict[str, Any]) -> None:
        state, now = event.get("state"), time.monotonic()
        alone = not event.get("threads")
        if state == "spin" and alone:
            self.spins = True
        elif state in ("spin", "idle", "looped"):
            self.idle = True
            self.looped = self.looped or (state == "looped" and alone)
            self.starving = event.get("starving") is True
            if self.starving:
                self.active = now  # what it waits for is made up after a while that begins now, not earlier
            self.pause_until = 0.0
        elif state == "busy":
            self.starving = False
        elif state == "ending":
            self.ending = True
        elif state == "fed":
            # Whatever loop it was in, it may leave now: it has to show one again.
            self.idle = self.looped = self.starving = False
            self.active = now
            seconds = event.get("seconds")
            self.fed_until = now + max(0.3, min(float(seconds), 2.0) if isinstance(seconds, (int, float)) else 0.0)
        elif state == "init":
            self.initialised = True
            self.active = now
        elif state == "sleep" and not self.idle and isinstance(event.get("seconds"), (int, float)):
            self.pause_until = now + min(float(event["seconds"]), 60.0)
        elif state in ("wait", "resume"):
            wait = (str(event.get("kind"))[:20], str(event.get("name"))[:300])
            if state == "wait":
                self.emit({"node": event})
                if event.get("main"):
                    self.waits.append(wait)
            elif wait in self.waits:
                self.waits.remove(wait)
                self.active = now

    def _polls(self) -> bool:
        """Whether a node that no hook watches (roscpp) asks for the same missing service over and over."""
        return bool(self.polled) and not self.idle and time.monotonic() - self.polled_at < 1.0

    def blocked_by(self) -> list[tuple[str, str]]:
        """What the node waits for, as far as known."""
        return self.waits[-1:] or ([("service", self.polled)] if self._polls() else [])

    def over(self) -> Optional[str]:
        """Why to stop now: `spinning`, `timed-out`, or None."""
        why = self._over()
        if why == "spinning" and self.topic_probes is not None:
            fed = self.fake_publisher is not None and self.fake_publisher.busy()
            return None if self.topic_probes.busy(self.pid, self.active, fed) else why
        return why

    def _leave_out_queueing(self, now: float) -> None:
        """What a node does must not depend on what else the machine does: while others have the processors it is
        neither quiet, nor is its time running."""
        queued = queued_seconds(self.pid)
        if queued > self.queued:
            more, self.queued = queued - self.queued, queued
            self.active = min(now, self.active + more)
            self.stretch = min(self.job["limits"]["stretch"], self.stretch + more)

    def _over(self) -> Optional[str]:
        now = time.monotonic()
        if self.spins:
            return "spinning"
        self._leave_out_queueing(now)
        if now - self.started > self.job["limits"]["wall"] + self.stretch:
            return "timed-out"
        if self.ending:
            return None
        if self.fake_publisher is not None and self.fake_publisher.busy():
            self.fed_until = max(self.fed_until, now + 0.3)
        if self.waits or now < max(self.pause_until, self.fed_until) or self._polls():
            return None
        quiet = now - max(self.active, self.pause_until)
        if self.starving and quiet < self.job["limits"]["starving"]:
            return None
        if self.idle and quiet > self.job["limits"]["looped" if self.looped else "quiet"]:
            return "spinning"
        # An event loop that no hook knows: up and running, asleep, and nothing new for a good while.
        settled = self.job["limits"]["settled"]
        # Whose client library is none that we know has no sign of when it is up.
        if quiet > (settled if self.initialised else 2 * settled) and (
            self.initialised or (self.registered and not self.woven)
        ):
            used = cpu_seconds(self.pid)
            if used - self.cpu < 0.05:
                return "spinning"
            self.cpu, self.active = used, now
        return None


def start(run: Run, output: Optional[int] = None) -> tuple[int, int]:
    """Start the job's process, its standard output to the pipe `output`. Two pipes: one can be read when a child
    ended, the other has what kept the process from starting."""
    wake_read, wake_write = os.pipe()
    os.set_blocking(wake_write, False)
    failure_read, failure_write = os.pipe()
    signal.set_wakeup_fd(wake_write)
    signal.signal(signal.SIGCHLD, lambda *_: None)
    run.emit({"own": {"ev": "started"}})
    run.pid = os.fork()
    if run.pid == 0:
        become(run.job, failure_write, output)
    os.close(failure_write)
    return wake_read, failure_read


def drain(run: Run, events: int, rest: bytes) -> bytes:
    """What stands in the FIFO, but no more than fits into it at once: a flood must not keep us from the clock."""
    for _ in range(16):
        try:
            rest += os.read(events, 65536)
        except BlockingIOError:
            break
        *lines, rest = rest.split(b"\n")
        for line in lines:
            if len(line) > MAX_LINE or run.count >= MAX_EVENTS:
                run.dropped += 1
            else:
                run.node_line(line)
        # Too long already: its end is let go by, and the line counted once when it comes.
        rest = rest[: MAX_LINE + 1]
    return rest
