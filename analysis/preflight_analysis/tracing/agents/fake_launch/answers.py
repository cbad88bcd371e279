"""Which answers a launch file gets to what is not known, and which it gets in the next run if it raises.

A launch file that raises after a condition that nobody here can know may have taken a branch that no robot takes:
the last one is answered in the other way, then the one before it, and so on, as in a search through a tree of
answers. Each try is a run of its own, in the same process: the program is executed anew with its arguments. What a
function of the file does is searched apart from what came before it.
"""

from __future__ import annotations

import os
import sys
from typing import Any, Optional

from ..process import own_seconds

MAX_TRIES = 10
MAX_SECONDS = 5.0
"""By `own_seconds`, after which no further try is begun."""
MAX_SECONDS_OF_TRY = 2.0
"""Likewise, more than the first run took."""
MAX_SECONDS_OF_ALL = 9.0
"""Likewise: they end before the run's own limit."""
MAX_ANSWERS = 2000
_VARIABLE = "PREFLIGHT_ANSWERS"
_ALL_SET = "+"
_OWN_MISTAKES = ("NameError", "SyntaxError", "IndentationError", "TabError", "ImportError", "ModuleNotFoundError")
"""What no answer is to blame for."""


_getpid = os.getpid


class Answers:
    """Of one run. Those that an earlier run has settled come first."""

    def __init__(self) -> None:
        self._settled: list[tuple[bool, bool]] = []
        """The answer, and whether the other one has been tried."""
        self._given: list[tuple[bool, Any]] = []
        """The answer, and the place that asks."""
        self._variables: dict[str, bool] = {}
        """Those that are not set, and whether they count as set."""
        self._part = 0
        self._tries = 0
        self._started = own_seconds(_getpid())
        self._took = 0.0
        """The first run."""
        self._all_set = False
        self._first = -1
        """The file that has what the first run told."""

    def begin(self) -> bool:
        """Take over from the run before this one what it has settled; whether there is one."""
        said = os.environ.pop(_VARIABLE, None)
        if said is None:
            return False
        tries, started, took, first, settled = said.split(":")
        self._tries, self._started, self._took, self._first = int(tries), float(started), float(took), int(first)
        self._all_set = settled.endswith(_ALL_SET)
        self._settled = [(each in "yY", each in "NY") for each in settled.rstrip(_ALL_SET)]
        return True

    def begin_part(self) -> None:
        """What was asked until now went well: what is made there keeps its answers."""
        self._part = len(self._given)

    def choose(self, frame: Any, answer: bool) -> bool:
        """The answer to something that is not known; `answer` is the usual one."""
        count = len(self._given)
        if count < len(self._settled):
            answer = self._settled[count][0]
        if count < MAX_ANSWERS:
            self._given.append((answer, (frame.f_code, frame.f_lasti)))
        return answer

    def is_set(self, variable: str, frame: Any) -> bool:
        """Whether a variable, or launch configuration, that is not set counts as set: the same whoever asks."""
        if variable not in self._variables:
            self._variables[variable] = self.choose(frame, self._all_set)
        return self._variables[variable]

    def may_try(self, error: dict[str, Any]) -> bool:
        """Whether a run that ended with an error may end in another way with other answers."""
        is_own = error.get("type") in _OWN_MISTAKES and not error.get("elsewhere")
        return len(self._given) > self._part and not is_own

    def first(self, text: str) -> str:
        """What the first run told; `text` is what this one does."""
        if not self._tries:
            return text
        os.lseek(self._first, 0, os.SEEK_SET)
        with open(self._first, encoding="utf-8", closefd=False) as file:
            return file.read()

    def seconds_left(self) -> float:
        """By `own_seconds`, what a try that begins now has: one that imports much takes as long as the first run."""
        return min(MAX_SECONDS_OF_TRY + self._took, MAX_SECONDS_OF_ALL - self._passed())

    def try_again(self, environment: dict[str, str], text: str) -> None:
        """Execute the program anew with the next answers, and, where all that have been tried raise, with all variables
        set. `text` is what this run tells. Comes back where there is nothing more to try; raises what `os` does."""
        words = getattr(sys, "orig_argv", None)  # an older Python does not have it
        if not words or not hasattr(os, "memfd_create"):
            return
        settled = None if self._all_set else self._next()
        if settled is None and (self._all_set or len(self._variables) < 2):
            return
        if not self._tries:
            if self._passed() > MAX_SECONDS:
                return
            self._took = self._passed()
            self._first = os.memfd_create("first")
            with open(self._first, "w", encoding="utf-8", closefd=False) as file:
                file.write(text)
        os.set_inheritable(self._first, True)
        path = "".join("nyNY"[answer + 2 * both] for answer, both in settled or self._before(self._part))
        path += _ALL_SET if settled is None else ""
        said = f"{self._tries + 1}:{self._started}:{self._took}:{self._first}:{path}"
        os.execve(sys.executable, [sys.executable, *words[1:]], {**environment, _VARIABLE: said})  # noqa: S606

    def _next(self) -> Optional[list[tuple[bool, bool]]]:
        """The answers of the next run; None where there is none. Of a place that asks often the last one counts."""
        if self._tries >= MAX_TRIES or self._passed() > MAX_SECONDS:
            return None
        places: set[Any] = set()
        for at in range(len(self._given) - 1, self._part - 1, -1):
            answer, place = self._given[at]
            if place not in places and not (at < len(self._settled) and self._settled[at][1]):
                return [*self._before(at), (not answer, True)]
            places.add(place)
        return None

    def _passed(self) -> float:
        return own_seconds(_getpid()) - self._started

    def _before(self, end: int) -> list[tuple[bool, bool]]:
        tried = [both for _, both in self._settled]
        return [(answer, at < len(tried) and tried[at]) for at, (answer, _) in enumerate(self._given[:end])]
