"""How far a command is, on a terminal only: a line on standard error that is written over."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

from preflight_analysis.findings.printable import printable

_BAR = 20


class Progress:
    """A bar over `total` steps; silent where standard error is no terminal. Call `end` before anything else is
    printed."""

    def __init__(self, total: int) -> None:
        self._total = total
        self._done = 0
        self._what = self._count = ""
        self._running: Sequence[str] = ()
        self._shown = sys.stderr.isatty() and os.environ.get("TERM") != "dumb"

    def step(self, done: int, what: str) -> None:
        """`done` steps are behind us, `what` is next."""
        self._done, self._what, self._count, self._running = done, what, "", ()
        self._write()

    def part(self, done: int, total: int) -> None:
        """Of the nodes of the current step so many were run."""
        self._count = f"{done} of {total} nodes"
        self._write()

    def running(self, names: Sequence[str]) -> None:
        """These nodes are run right now."""
        self._running = names
        self._write()

    def end(self) -> None:
        """Leave the line empty."""
        if self._shown:
            sys.stderr.write("\r\x1b[K")
            sys.stderr.flush()

    def _bar(self) -> str:
        filled = _BAR * self._done // max(self._total, 1)
        return f"[{'#' * filled}{'.' * (_BAR - filled)}] {self._done}/{self._total}"

    def _write(self) -> None:
        if not self._shown:
            return
        running = f"running {', '.join(self._running)}" if self._running else ""
        state = ", ".join(part for part in (self._count, running) if part)
        line = f"{self._bar()} {self._what}" + (f": {state}" if state else "")
        try:
            columns = os.get_terminal_size(sys.stderr.fileno()).columns or 80
        except OSError:
            columns = 80
        sys.stderr.write(f"\r\x1b[K{printable(line)[: columns - 1]}")
        sys.stderr.flush()
