"""What the commands of `<param command="...">` gave, as the evaluation is told. It runs nothing itself."""

from __future__ import annotations

import os
import re
from collections.abc import Hashable, Iterable, Iterator, Mapping
from typing import Literal, Protocol

from preflight_analysis.dataclass import dataclass
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import Input, query

Status = Literal["done", "failed", "missing", "not-run"]


@dataclass(frozen=True, slots=True)
class CommandResult:
    """How a command ended.

    `done`: with exit code 0, and `output` is what it printed. `failed`: roslaunch would stop at it. `missing`: its
    program is not there, which stops roslaunch too. `not-run`: nothing is known of it, or of a robot description only
    a part, which is its `output` (`partial_text.py`).
    """

    status: Status
    output: str = ""
    reason: str = ""
    """For the user, where it is not done: `it ended with exit code 2`."""
    stderr_tail: tuple[str, ...] = ()
    """The last lines that it printed on standard error."""


def named_paths(words: Iterable[str], cwd: str) -> Iterator[str]:
    """The paths that arguments of a command may name: `file`, `name:=file`, `--option=file`, or a word within an
    argument, as for `bash -c`."""
    for word in words:
        candidates = [word, word.partition("=")[2]]
        if any(c.isspace() for c in word):
            candidates += re.split(r"[\s'\";|&<>()]+", word)
        for candidate in candidates:
            if candidate and "\0" not in candidate:
                yield os.path.normpath(os.path.join(cwd, os.path.expanduser(candidate)))


class Reader(Protocol):
    """Reads Python launch files in the place of a run."""

    def reading(self, line: str) -> CommandResult | None:
        """The answer to a request for a run, by reading the file; None where it is not read at all."""

    def texts_before(self, path: str) -> tuple[str, ...]:
        """Texts that an open file had before and that parse, the latest first."""


class Commands(Protocol):
    """The results that are known."""

    def __hash__(self) -> int: ...

    @property
    def edition(self) -> Hashable:
        """Another one where any of the results may be another one."""

    @property
    def placeholder(self) -> str | None:
        """What counts as the result of all commands of ROS 2's `$(command)` where none is run, None for no such."""

    def result(self, line: str) -> CommandResult | None:
        """The result of a command line, None as long as it has none: it has not been run, or runs right now."""

    def answering(self, question: str) -> tuple[str, ...]:
        """The lines of the runs of Python launch files that answer a question in some context, the latest last."""

    @property
    def reader(self) -> Reader | None:
        """What reads Python launch files that were not run; None where nothing does."""

    def snapshot(self) -> Commands:
        """The results as they are now, for another process."""


class NoResults:
    """Nothing was run."""

    edition = 0
    placeholder: str | None = None
    reader: Reader | None = None

    def result(self, line: str) -> CommandResult | None:
        """None."""
        return None

    def answering(self, question: str) -> tuple[str, ...]:
        """None."""
        return ()

    def snapshot(self) -> Commands:
        """The same."""
        return NoResults()


@dataclass(frozen=True, eq=False)
class KnownResults:
    """Results by their lines. `otherwise` is that of all other lines. Implements `Commands`."""

    placeholder: str | None
    results: Mapping[str, CommandResult]
    lines_answering: Mapping[str, tuple[str, ...]]
    otherwise: CommandResult | None
    edition: int = 0
    reader: Reader | None = None

    def result(self, line: str) -> CommandResult | None:
        """The result of a command line."""
        return self.results.get(line, self.otherwise)

    def answering(self, question: str) -> tuple[str, ...]:
        """The lines of the runs that answer a question."""
        return self.lines_answering.get(question, ())

    def snapshot(self) -> Commands:
        """The same."""
        return self


def _edition(commands: Commands) -> Hashable:
    return commands.edition


EDITION = Input(_edition, durable=False)


@query
def result_of(db: Database, commands: Commands, line: str) -> CommandResult | None:
    """The result of a command line, as `Commands.result`."""
    EDITION(db, commands)
    return commands.result(line)


@query
def lines_answering(db: Database, commands: Commands, question: str) -> tuple[str, ...]:
    """The lines of the runs that answer a question."""
    EDITION(db, commands)
    return commands.answering(question)


class QueriedCommands:
    """The same results for queries, which depend on those that they ask for. Implements `Commands`."""

    def __init__(self, db: Database, commands: Commands, reader: Reader | None) -> None:
        self._db = db
        self._commands = commands
        self.reader = reader
        self.placeholder = commands.placeholder

    @property
    def edition(self) -> Hashable:
        """That of the results."""
        return EDITION(self._db, self._commands)

    def result(self, line: str) -> CommandResult | None:
        """The result of a command line."""
        return result_of(self._db, self._commands, line)

    def answering(self, question: str) -> tuple[str, ...]:
        """The lines of the runs that answer a question."""
        return lines_answering(self._db, self._commands, question)

    def snapshot(self) -> Commands:
        """The results as they are now."""
        return self._commands.snapshot()
