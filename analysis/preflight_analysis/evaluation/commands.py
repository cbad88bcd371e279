"""What the commands of `<param command="...">` gave, as the evaluation is told. It runs nothing itself."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Protocol

Status = Literal["done", "failed", "missing", "not-run"]


@dataclass(frozen=True, slots=True)
class CommandResult:
    """How a command ended.

    `done`: with exit code 0, and `output` is what it printed. `failed`: roslaunch would stop at it. `missing`: its
    program is not there, which stops roslaunch too. `not-run`: nothing is known of it.
    """

    status: Status
    output: str = ""
    reason: str = ""
    """For the user, where it is not done: `it ended with exit code 2`."""
    stderr_tail: tuple[str, ...] = ()
    """The last lines that it printed on standard error."""


class Commands(Protocol):
    """The results that are known."""

    @property
    def placeholder(self) -> str | None:
        """What counts as the result of all commands of ROS 2's `$(command)` where none is run, None for no such."""

    def result(self, line: str) -> CommandResult | None:
        """The result of a command line, None as long as it has none: it has not been run, or runs right now."""

    def last_good(self, series: str) -> str | None:
        """Of the runs of a Python launch file with one text or another the last that went well: its line."""


class NoResults:
    """Nothing was run."""

    placeholder: str | None = None

    def result(self, line: str) -> CommandResult | None:
        """None."""
        return None

    def last_good(self, series: str) -> str | None:
        """None."""
        return None
