"""Looks at a running system again and again, and says what is new."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Protocol

from preflight_analysis.dataclass import dataclass
from preflight_analysis.environment.model import Environment
from preflight_analysis.generation import ros
from preflight_analysis.live.compare import compare
from preflight_analysis.live.model import CannotObserveError, Comparison, Expected, Issue, Observation
from preflight_analysis.live.model import State as Status
from preflight_analysis.live.observe_ros1 import Ros1Observer
from preflight_analysis.live.observe_ros2 import Ros2Observer

LOOK_SECONDS = 3.0
"""What a look may take at least: a system that answers is seen however little time there is to wait for it."""


class Observer(Protocol):
    """Shows a running system."""

    @property
    def place(self) -> str:
        """What is observed, for people."""

    def observe(self, within: float = math.inf) -> Observation:
        """The system as it is now, asked for so many seconds at most. Raises `CannotObserveError`."""

    def close(self) -> None:
        """Leave nothing running."""


@dataclass(frozen=True, slots=True)
class Waiting:
    """The system cannot be asked; it is waited for unless `final`."""

    reason: str
    final: bool = False


@dataclass(frozen=True, slots=True)
class Attached:
    """The system answers, for the first time or after it could not be asked; `again`: another run of it."""

    place: str
    again: bool = False


@dataclass(frozen=True, slots=True)
class State:
    """How the system compares. Of the comparison's issues those are left that have lasted."""

    comparison: Comparison


Event = Waiting | Attached | State


def observer(generation: int, environment: Environment) -> Observer:
    """What shows the system that the environment's variables lead to."""
    if ros(generation).has_master:
        return Ros1Observer(environment.variables.get("ROS_MASTER_URI"))
    return Ros2Observer(environment)


class Watcher:
    """`expected` is asked at each look: it may change. An issue is told once it has lasted `settle` seconds, as nodes
    take a moment to start, and those that are started again are away for one; as long as nodes turn up that were not
    there before, others may follow, and what is missing has to last from then on. `allow_extra`: what is extra does not
    count."""

    def __init__(
        self,
        observer: Observer,
        expected: Callable[[], Expected],
        *,
        settle: float = 0.0,
        allow_extra: bool = False,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._observer = observer
        self._expected = expected
        self._settle = settle
        self._allow_extra = allow_extra
        self._clock = clock
        self._since: dict[Issue, float] = {}
        self._nodes: set[str] = set()
        self._grown = 0.0
        self._reported: Event | None = None
        self._run: str | None = None
        self._was_there = False

    def look(self, within: float = math.inf) -> list[Event]:
        """What is new since the last look. It takes so many seconds at most."""
        try:
            live = self._observer.observe(within)
        except CannotObserveError as error:
            self._since.clear()
            return self._new(Waiting(str(error), error.final))
        events: list[Event] = []
        # roslaunch gives the run its id a moment after the master has started; one that ends may lack it again.
        lost, known = isinstance(self._reported, Waiting), live.run is not None
        other = live.run != self._run if known else lost
        restarted = self._run is not None and other
        if not self._was_there or lost or restarted:
            events.append(Attached(self._observer.place, restarted))
            self._reported = None
            self._nodes.clear()
        self._was_there = True
        if known or restarted:
            self._run = live.run
        found = compare(self._expected(), live)
        if self._allow_extra:
            issues = (replace(i, counts=False) if i.kind == "extra" else i for i in found.issues)
            found = replace(found, issues=tuple(issues))
        now = self._clock()
        self._since = {issue: self._since.get(issue, now) for issue in found.issues}
        if not self._nodes.issuperset(live.nodes):
            self._nodes.update(live.nodes)
            self._grown = now
        lasting = tuple(issue for issue in found.issues if self._has_lasted(issue, now))
        shown = replace(found, issues=lasting)
        missing = {issue for issue in found.issues if issue.kind == "missing"}
        if not missing <= set(lasting):
            shown = _still_starting(shown)
        return [*events, *self._new(State(shown))]

    def _has_lasted(self, issue: Issue, now: float) -> bool:
        since = self._since[issue]
        return now - (max(since, self._grown) if issue.kind == "missing" else since) >= self._settle

    def _new(self, event: Event) -> list[Event]:
        if event == self._reported:
            return []
        self._reported = event
        return [event]


def _still_starting(found: Comparison) -> Comparison:
    """The comparison in which what is not there is called missing only where an issue that has lasted says so."""
    known = {issue.name or issue.node for issue in found.issues if issue.kind == "missing"}

    def states(of: Mapping[str, Status]) -> dict[str, Status]:
        return {name: "unsure" if state == "missing" and name not in known else state for name, state in of.items()}

    return replace(
        found,
        nodes=states(found.nodes),
        topics=states(found.topics),
        services=states(found.services),
        actions=states(found.actions),
    )
