"""What a launch does after it has gone through its files: event handlers, timers, ends of processes.

launch starts processes when it has executed all that the files say, and tells the handlers of each start in the order
of the starts (`launch.LaunchService`). When anything else happens, nobody knows: it comes after that, and is deferred.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any, NamedTuple

from preflight_analysis.documents.span import Origin
from preflight_analysis.evaluation.ros2.place import Place
from preflight_analysis.launch.model import Action

_Key = tuple[str, Origin, str]
"""An object of a run of a Python launch file, by its number; each include of a file is a run for itself."""

Noted = tuple[Callable[..., None], Place, Any]
"""What the queue was told: a method of it, and what that was called with."""


class Upcoming(NamedTuple):
    """Actions that are executed next."""

    place: Place
    actions: tuple[Action, ...]
    deferred: bool


class _Handler(NamedTuple):
    """A handler of starts. `target` None: any process; `number` is its own."""

    number: _Key | None
    target: _Key | None
    place: Place
    actions: tuple[Action, ...]


class Events:
    """The queue of one launch."""

    def __init__(self) -> None:
        self._deferred = False
        self._started: list[_Key | None] = []
        self._ready: list[Upcoming] = []
        self._later: list[tuple[_Key | None, Place, tuple[Action, ...]]] = []
        self._handlers: list[_Handler] = []
        self._noted: list[Noted] = []

    @property
    def noted(self) -> tuple[Noted, ...]:
        """What it was told so far."""
        return tuple(self._noted)

    def repeat(self, noted: Iterable[Noted]) -> None:
        """Note what another one did."""
        for what, place, told in noted:
            what(self, place, told)

    def started(self, place: Place, action: Action) -> None:
        """A process was started; one of XML or YAML has no number."""
        self._noted.append((Events.started, place, action))
        self._started.append(_key(place, action, "id"))

    def later(self, place: Place, actions: tuple[Action, ...]) -> None:
        """What waits for a timer, or for whatever else."""
        self._noted.append((Events.later, place, actions))
        self._later.append((None, place, actions))

    def register(self, place: Place, action: Action) -> None:
        """`RegisterEventHandler`."""
        self._noted.append((Events.register, place, action))
        number = _key(place, action, "handler")
        if action.value("starts") is None:
            self._later.append((number, place, action.children))
        else:
            # Those that were registered last are asked first.
            self._handlers.insert(0, _Handler(number, _key(place, action, "starts"), place, action.children))

    def unregister(self, place: Place, action: Action) -> None:
        """`UnregisterEventHandler`."""
        self._noted.append((Events.unregister, place, action))
        number = _key(place, action, "handler")
        if number is not None:
            self._later = [each for each in self._later if each[0] != number]
            self._handlers = [each for each in self._handlers if each.number != number]

    def upcoming(self, *, sure: bool) -> Upcoming | None:
        """What comes next, None when all is done. `sure`: all is known of what was executed, so that a process that
        was not started never is."""
        while self._started and not self._ready:
            self._ready = list(self._of(self._started.pop(0)))
        if self._ready:
            return self._ready.pop(0)
        if not self._later and self._handlers and not sure:
            self._later = [(None, handler.place, handler.actions) for handler in self._handlers]
            self._handlers = []
        if not self._later:
            return None
        self._deferred = True
        _, place, actions = self._later.pop(0)
        return Upcoming(place, actions, self._deferred)

    def _of(self, process: _Key | None) -> Iterator[Upcoming]:
        """What the handlers of a start do. An action is executed once only, so a handler counts once."""
        for handler in tuple(self._handlers):
            if handler.target is None or handler.target == process:
                self._handlers.remove(handler)
                yield Upcoming(handler.place, handler.actions, self._deferred)


def _key(place: Place, action: Action, name: str) -> _Key | None:
    value = action.value(name)
    return (place.file, place.chain, value.text) if value is not None and value.text else None
