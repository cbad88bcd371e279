"""Inputs, and queries that make values from them, each made again only when something that it read has changed.

The algorithm is that of salsa (https://salsa-rs.github.io/salsa/reference/algorithm.html), on which rust-analyzer and
ty are built: every change of inputs makes a new revision; a query's value is remembered with what it read; it is valid
as long as none of that has changed; and where it is made again and comes to an equal value, nothing that read it is
made again.

- An **input** (`Input`) comes from outside: the text of a file, a listing, settings. It is loaded when it is first
  read, and changes only within `Database.writing`.
- A **query** (`query`) is a plain function of a database and of plain, hashable keys. It reads inputs and other queries
  and nothing else. What it returns is never changed, and equal values must mean the same: Python's `1 == True`, so
  whoever holds values of several types has to compare those, too.

Threads may read at the same time. A write waits until they have left, and makes them leave: what they ask next raises
`Cancelled`. So a reader sees one revision from beginning to end. A single question asked outside of `reading` begins
again by itself.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Container, Hashable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from typing import Any, Concatenate, Generic, ParamSpec, TypeVar, cast

P = ParamSpec("P")
V = TypeVar("V")
Key = tuple[Hashable, ...]

UNUSED_AFTER = 64
"""Revisions after which a query's value that nobody asked for is forgotten, if it depends on what changes often."""
_NONE: Any = object()
_ALWAYS = 1 << 62
"""Later than any revision: an input that was loaded is right until it is written."""


class Cancelled(BaseException):
    """Somebody wants to write: leave `Database.reading`, and ask again. No `Exception`: only the asker handles it."""


class CycleError(RuntimeError):
    """A query needs its own value."""


class Input(Generic[P, V]):
    """A kind of input. `load` reads the one of a key from outside, when it is first asked for; equal values are one.

    `durable`: it seldom changes. What depends on such inputs alone is not looked through on each change of others.
    """

    def __init__(self, load: Callable[P, V], *, durable: bool = True) -> None:
        self.load = load
        self.durable = durable
        self.name = load.__name__

    def __call__(self, db: Database, /, *key: P.args, **none: P.kwargs) -> V:
        """The value as it is in this revision."""
        _refuse(none)
        return cast(V, db.read(self, key))

    def __repr__(self) -> str:
        return f"Input({self.name})"


class Query(Generic[P, V]):
    """A derived value, made by `function`."""

    def __init__(self, function: Callable[Concatenate[Database, P], V]) -> None:
        self.function = function
        self.name = function.__name__
        self.__doc__ = function.__doc__

    def __call__(self, db: Database, /, *key: P.args, **none: P.kwargs) -> V:
        """The value as it is in this revision. Raises what the function raises; that is not remembered."""
        _refuse(none)
        return cast(V, db.read(self, key))

    def __repr__(self) -> str:
        return f"Query({self.name})"


def query(function: Callable[Concatenate[Database, P], V]) -> Query[P, V]:
    """Make a function a query."""
    return Query(function)


def _refuse(keywords: Mapping[str, object]) -> None:
    if keywords:
        raise TypeError("a key is given by places: names are no part of it")


class _Cell:
    """One value: of an input, or of a query with the cells that it read, in the order in which it did."""

    __slots__ = ("changed_at", "claimed", "depends_on", "durable", "key", "kind", "value", "verified_at")

    def __init__(self, kind: Input[Any, Any] | Query[Any, Any], key: Key) -> None:
        self.kind = kind
        self.key = key
        self.value: Any = _NONE
        self.changed_at = 0
        """The revision in which the value became what it is."""
        self.verified_at = 0
        """The last revision in which it was known to be right."""
        self.depends_on: tuple[_Cell, ...] = ()
        self.durable = True
        self.claimed = False
        """Whether some thread makes it now."""


class _Thread(threading.local):
    """What one thread is at."""

    def __init__(self) -> None:
        self.readings = 0
        self.claims = 0
        self.running: set[_Cell] = set()
        self.reads: list[dict[_Cell, None]] = []


class Write:
    """The changes that one `Database.writing` makes."""

    def __init__(self, db: Database) -> None:
        self._db = db
        self.changed = False
        self.durable_changed = False

    def set(self, kind: Input[Any, V], value: V, *key: Hashable, durable: bool = False) -> None:
        """Give an input a value other than what `load` would."""
        self._put(kind, key, value, durable)

    def reload(self, kind: Input[Any, Any], *key: Hashable) -> None:
        """Take what `load` gives now. Nothing happens where nobody has read it."""
        if (kind, key) in self._db.cells:
            self._put(kind, key, kind.load(*key), kind.durable)

    def _put(self, kind: Input[Any, Any], key: Key, value: object, durable: bool) -> None:
        db = self._db
        cell = db.cells.get((kind, key))
        if cell is None:
            cell = db.cells[kind, key] = _Cell(kind, key)
            cell.durable = durable
        same = cell.value is not _NONE and cell.value == value
        if same and cell.durable == durable:
            return
        self.changed = True
        self.durable_changed |= cell.durable or durable
        cell.durable, cell.verified_at = durable, _ALWAYS
        if not same:
            cell.value, cell.changed_at = value, db.revision + 1


def _read_down_to(cells: Iterable[_Cell], kinds: Container[object]) -> Iterator[tuple[object, Key, object]]:
    left, seen = list(cells), set[_Cell]()
    while left:
        cell = left.pop()
        if cell in seen:
            continue
        seen.add(cell)
        if cell.kind in kinds:
            yield cell.kind, cell.key, cell.value
        else:
            left.extend(cell.depends_on)


class Database:
    """All that is remembered. Thread-safe. `on_execute`, for tests and benchmarks, is called with each query that is
    made."""

    def __init__(self, on_execute: Callable[[Query[Any, Any], Key], None] | None = None) -> None:
        self.cells: dict[tuple[Input[Any, Any] | Query[Any, Any], Key], _Cell] = {}
        self.revision = 1
        self._on_execute = on_execute
        self._durable_changed_at = 1
        self._condition = threading.Condition()
        self._readers = 0
        self._writers = 0
        """Those that write, or wait until they can."""
        self._writing = False
        self._thread = _Thread()

    # Who reads and who writes

    @contextmanager
    def reading(self) -> Iterator[int]:
        """One revision, whose number is given: nothing changes meanwhile, but queries may raise `Cancelled`."""
        thread = self._thread
        if not thread.readings:
            with self._condition:
                self._condition.wait_for(lambda: not self._writers)
                self._readers += 1
        thread.readings += 1
        try:
            yield self.revision
        finally:
            thread.readings -= 1
            if not thread.readings:
                with self._condition:
                    self._readers -= 1
                    self._condition.notify_all()

    @contextmanager
    def writing(self) -> Iterator[Write]:
        """Change inputs: readers are cancelled, and waited for. No query may be asked meanwhile."""
        if self._thread.readings:
            raise RuntimeError("a query cannot change inputs")
        with self._condition:
            self._writers += 1
            self._condition.wait_for(lambda: not self._readers and not self._writing)
            self._writing = True
        write = Write(self)
        try:
            yield write
        finally:
            if write.changed:
                self.revision += 1
                if write.durable_changed:
                    self._durable_changed_at = self.revision
                if self.revision % UNUSED_AFTER == 0:
                    self._forget()
            with self._condition:
                self._writing = False
                self._writers -= 1
                self._condition.notify_all()

    @property
    def is_reading(self) -> bool:
        """Whether this thread is within `reading`, or a query."""
        return self._thread.readings > 0

    @contextmanager
    def observing(self) -> Iterator[Callable[[Container[object]], Iterator[tuple[object, Key, object]]]]:
        """Within `reading`, not within a query: gives a function that tells what was read since, down to the kinds of
        inputs and queries that it is given, with their values. What these were made from is left out, and so are
        inputs of other kinds."""
        reads: dict[_Cell, None] = {}
        self._thread.reads.append(reads)
        try:
            yield lambda kinds: _read_down_to(reads, kinds)
        finally:
            self._thread.reads.pop()

    def outdated(self, kind: Input[Any, Any], keys: Iterable[Key]) -> list[Key]:
        """Those of the keys whose input was loaded, and would be another one now."""
        cells = ((key, self.cells.get((kind, key))) for key in keys)
        return [
            key for key, cell in cells if cell is not None and cell.value is not _NONE and cell.value != kind.load(*key)
        ]

    def read(self, kind: Input[Any, Any] | Query[Any, Any], key: Key) -> object:
        """The value of an input or query. Raises `CycleError`, and what the query raises; within `reading` also
        `Cancelled`, else it begins again."""
        thread = self._thread
        if not thread.readings:
            known = self.cells.get((kind, key))
            if known is not None and known.verified_at >= self.revision:
                return known.value
            while True:
                with suppress(Cancelled), self.reading():
                    return self.read(kind, key)
        if self._writers:
            raise Cancelled
        cell = self.cells.get((kind, key))
        if cell is None:
            cell = self.cells.setdefault((kind, key), _Cell(kind, key))
        if thread.reads:
            thread.reads[-1][cell] = None
        if cell.verified_at < self.revision:
            self._bring_up_to_date(cell)
        return cell.value

    # How a value comes up to date

    def _bring_up_to_date(self, cell: _Cell) -> None:
        """Make the cell's value that of this revision."""
        thread = self._thread
        if cell in thread.running:
            raise CycleError(f"{cell.kind.name}{cell.key} needs its own value")
        with self._condition:
            # Who has claims of his own does not wait, lest two wait for each other: the work is done twice then.
            while cell.claimed and not thread.claims and not self._writers:
                self._condition.wait()
            if cell.verified_at >= self.revision:
                return
            mine, cell.claimed = not cell.claimed, True
            thread.claims += mine
        thread.running.add(cell)
        try:
            if isinstance(cell.kind, Input):
                self._load(cell, cell.kind)
            elif not self._is_valid(cell):
                self._execute(cell, cell.kind)
        finally:
            thread.running.discard(cell)
            if mine:
                with self._condition:
                    cell.claimed = False
                    thread.claims -= 1
                    self._condition.notify_all()

    def _load(self, cell: _Cell, kind: Input[Any, Any]) -> None:
        value = kind.load(*cell.key)
        with self._condition:
            if cell.value is _NONE:
                cell.value, cell.durable = value, kind.durable
                cell.changed_at, cell.verified_at = self.revision, _ALWAYS

    def _is_valid(self, cell: _Cell) -> bool:
        """Whether nothing that the query read has changed since it was last known to be right."""
        since = cell.verified_at
        if not since:
            return False
        if not (cell.durable and since >= self._durable_changed_at):
            for each in cell.depends_on:
                if each.verified_at < self.revision:
                    try:
                        self._bring_up_to_date(each)
                    except Exception:
                        return False  # who asks for it in earnest shall see that
                if each.changed_at > since:
                    return False
            cell.durable = all(each.durable for each in cell.depends_on)
        cell.verified_at = self.revision
        return True

    def _execute(self, cell: _Cell, kind: Query[Any, Any]) -> None:
        reads: dict[_Cell, None] = {}
        self._thread.reads.append(reads)
        if self._on_execute is not None:
            self._on_execute(kind, cell.key)
        try:
            value = kind.function(self, *cell.key)
        except Exception:
            cell.depends_on, cell.value, cell.verified_at = tuple(reads), _NONE, 0
            cell.durable = all(each.durable for each in reads)
            raise
        finally:
            self._thread.reads.pop()
        same = cell.value is not _NONE and cell.value == value
        with self._condition:
            if not same:
                cell.value, cell.changed_at = value, self.revision
            cell.depends_on, cell.verified_at = tuple(reads), self.revision
            cell.durable = all(each.durable for each in reads)

    def _forget(self) -> None:
        """Let go of what was not asked for in a long time. A cell stays in the memory of those that read it."""
        old = self.revision - UNUSED_AFTER
        for name, cell in list(self.cells.items()):
            if isinstance(cell.kind, Query) and cell.verified_at < old and not cell.durable:
                del self.cells[name]
