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
from collections.abc import Callable, Container, Hashable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from itertools import chain
from operator import attrgetter
from typing import Any, TypeVar, cast

from preflight_analysis.incremental.cells import (
    NONE,
    Asked,
    AsLastTime,
    Cell,
    Making,
    NotAsked,
    Part,
    Parts,
    ThreadState,
    are_same,
    read_down_to,
    same,
    would_answer,
)
from preflight_analysis.incremental.query import Answers, Input, Key, Query

V = TypeVar("V")

UNUSED_AFTER = 64
"""Revisions after which what nobody asked for is forgotten, with all that it was made from."""
_MORE = 1.25
_MANY = 2_000
"""With so many more than there were, or a quarter more, it is looked what that is."""
MOST_ANSWERS = 12
"""For how many sets of answers the value of one query and key is remembered, the latest."""
MOST_ANSWERS_OF_PART = 2
"""The same for parts of a value: as it is, and as it was before something was tried."""
_durable = attrgetter("durable")
_ALWAYS = 1 << 62
"""Later than any revision: an input that was loaded is right until it is written."""


class Cancelled(BaseException):
    """Somebody wants to write: leave `Database.reading`, and ask again. No `Exception`: only the asker handles it."""


class CycleError(RuntimeError):
    """A query needs its own value."""


def _beside(kind: Query[Any, Any], key: Key, others: Sequence[Cell]) -> Cell:
    """A cell for other answers, which takes over parts of the last value."""
    cell = Cell(kind, key)
    if others:
        cell.parts = others[-1].parts
    return cell


def _no_answer(question: Hashable) -> object:
    raise RuntimeError("there is nobody to answer")


class Write:
    """The changes that one `Database.writing` makes."""

    def __init__(self, db: Database) -> None:
        self._db = db
        self.changed = False
        self.durable_changed = False

    def set(self, kind: Input[Any, V], value: V, *key: Hashable, durable: bool = False) -> None:
        """Give an input a value other than what `load` would."""
        self._put(kind, key, value, durable)
        self._db.cells[kind, key].is_set = True

    def get(self, kind: Input[Any, V], *key: Hashable) -> V:
        """The value of an input so far."""
        cell = self._db.cells.get((kind, key))
        return cast(V, kind.load(*key) if cell is None or cell.value is NONE else cell.value)

    def reload(self, kind: Input[Any, Any], *key: Hashable) -> None:
        """Take what `load` gives now. Nothing happens where nobody has read it."""
        if (kind, key) in self._db.cells:
            self._put(kind, key, kind.load(*key), kind.durable)
            self._db.cells[kind, key].is_set = False

    def _put(self, kind: Input[Any, Any], key: Key, value: object, durable: bool) -> None:
        db = self._db
        cell = db.cells.get((kind, key))
        if cell is None:
            cell = db._new_cell(kind, key)
            cell.durable = durable
        same = cell.value is not NONE and cell.value == value
        if same and cell.durable == durable:
            return
        self.changed = True
        self.durable_changed |= cell.durable or durable
        cell.durable, cell.verified_at = durable, _ALWAYS
        if not same:
            cell.value, cell.changed_at = value, db.revision + 1


class Database:
    """All that is remembered. Thread-safe. `on_execute`, for tests and benchmarks, is called with each query that is
    made."""

    def __init__(self, on_execute: Callable[[Query[Any, Any], Key], None] | None = None) -> None:
        self.cells: dict[tuple[Input[Any, Any] | Query[Any, Any], Key], Cell] = {}
        self.revision = 1
        self._on_execute = on_execute
        self._forgot_at = 1
        self._remained = 0
        """How much there was after something was forgotten."""
        self._durable_changed_at = 1
        self._condition = threading.Condition()
        self._answered: dict[tuple[object, Key], list[Cell]] = {}
        """The cells of queries that ask, the one that was asked for last at the end."""
        self._keys_of_input: dict[object, dict[Key, None]] = {}
        """The keys of the cells of each input."""
        self._latest: dict[object, dict[Cell, None]] = {}
        """Of queries with a limit the cells that were asked for last, in that order."""
        self._readers = 0
        self._writers = 0
        """Those that write, or wait until they can."""
        self._writing = False
        self._thread = ThreadState()

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

    def in_one_revision(self, work: Callable[[], V]) -> V:
        """What `work` gives within `reading`; it begins again where somebody writes meanwhile."""
        if self.is_reading:
            return work()
        while True:
            with suppress(Cancelled), self.reading():
                return work()

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
                self._forget_unused()
            with self._condition:
                self._writing = False
                self._writers -= 1
                self._condition.notify_all()

    def interrupt(self) -> None:
        """Make readers leave, as a write does, and change nothing."""
        with self.writing():
            pass

    def leave_if_cancelled(self) -> None:
        """For what takes long between two questions: raises `Cancelled` within `reading`, where somebody writes."""
        if self._thread.readings and self._writers:
            raise Cancelled

    @property
    def is_reading(self) -> bool:
        """Whether this thread is within `reading`, or a query."""
        return self._thread.readings > 0

    @contextmanager
    def observing(self) -> Iterator[Callable[[Container[object]], Iterator[tuple[object, Key, object]]]]:
        """Within `reading`, not within a query: gives a function that tells what was read since, down to the kinds of
        inputs and queries that it is given, with their values. What these were made from is left out, and so are
        inputs of other kinds."""
        reads: dict[Cell, None] = {}
        self._thread.reads.append(reads)
        try:
            yield lambda kinds: read_down_to(reads, kinds)
        finally:
            self._thread.reads.pop()

    def outdated(self, kind: Input[Any, Any], keys: Iterable[Key] | None = None) -> list[Key]:
        """Those of the keys (None: of all) whose input was loaded, and would be another one now."""
        if keys is None:
            keys = self._keys_of_input.get(kind, {}).copy()
        return [key for key in keys if self.is_outdated(kind, *key)]

    def is_outdated(self, kind: Input[Any, Any], *key: Hashable) -> bool:
        """Whether an input was loaded, and would be another one now."""
        cell = self.cells.get((kind, key))
        return cell is not None and cell.value is not NONE and bool(cell.value != kind.load(*key))

    def read(self, kind: Input[Any, Any] | Query[Any, Any], key: Key) -> object:
        """The value of an input or query. Raises `CycleError`, and what the query raises; within `reading` also
        `Cancelled`, else it begins again."""
        thread = self._thread
        if not thread.readings:
            known = self.cells.get((kind, key))
            if known is not None and known.verified_at >= self.revision and kind.limit is None:
                known.used_at = self.revision
                return known.value
            while True:
                with suppress(Cancelled), self.reading():
                    return self.read(kind, key)
        if self._writers:
            raise Cancelled
        cell = self.cells.get((kind, key))
        if cell is None:
            cell = self._new_cell(kind, key)
        if thread.reads:
            thread.reads[-1][cell] = None
        cell.used_at = self.revision
        if cell.verified_at < self.revision:
            self._bring_up_to_date(cell)
        if isinstance(kind, Query) and kind.limit is not None:
            self._used(cell, kind.limit)
        return cell.value

    def _new_cell(self, kind: Input[Any, Any] | Query[Any, Any], key: Key) -> Cell:
        """That of another thread where one was faster."""
        if isinstance(kind, Input):
            self._keys_of_input.setdefault(kind, {})[key] = None
        return self.cells.setdefault((kind, key), Cell(kind, key))

    def _drop(self, name: tuple[Input[Any, Any] | Query[Any, Any], Key]) -> None:
        kind, key = name
        self.cells.pop(name, None)
        self._keys_of_input.get(kind, {}).pop(key, None)

    def last(self, kind: Query[Any, Any], key: Key) -> object:
        """As `Query.last`."""
        cell = self.cells.get((kind, key))
        return None if cell is None or cell.value is NONE else cell.value

    def read_answered(self, kind: Query[Any, Any], keys: Sequence[Key], answers: Answers) -> list[object]:
        """As `Query.answered_each`."""
        if not self._thread.readings:
            return self.in_one_revision(lambda: self.read_answered(kind, keys, answers))
        return [self._answered_value(kind, key, answers) for key in keys]

    def _answered_value(self, kind: Query[Any, Any], key: Key, answers: Answers) -> object:
        if self._writers:
            raise Cancelled
        cells = self._answered.get((kind, key))
        if cells and self._stands(cell := cells[-1]) and would_answer(answers, cell):
            self._note_read(cell)  # so it is with nearly all of them
        else:
            cell = self._answered_cell(kind, key, answers)
        if kind.limit is not None:
            self._used(cell, kind.limit)
        return cell.value

    def _answered_cell(self, kind: Query[Any, Any], key: Key, answers: Answers) -> Cell:
        cells = self._answered.setdefault((kind, key), [])
        cell = next((each for each in cells[::-1] if would_answer(answers, each)), None) or _beside(kind, key, cells)
        if self._make_for(answers, cell) and not would_answer(answers, cell):
            # Somebody asked for it at the same time, and answered otherwise what the function asks now.
            cell = _beside(kind, key, cells)
            self._make_for(answers, cell)
        if not cells or cells[-1] is not cell:
            with self._condition:
                if cells and cells[-1].value == cell.value:
                    cell.value = cells[-1].value  # who goes by the identity of values takes over more
                if cell in cells:
                    cells.remove(cell)
                cells.append(cell)
                for old in cells[:-MOST_ANSWERS]:
                    self._latest.get(kind, {}).pop(old, None)
                del cells[:-MOST_ANSWERS]
        return cell

    def _make_for(self, answers: Answers, cell: Cell) -> bool:
        """Note that the cell is read, and bring it up to date; whether there was anything to do for that."""
        self._note_read(cell)
        if self._stands(cell):
            return False
        self._bring_up_to_date_for(answers, cell)
        return True

    def _note_read(self, cell: Cell) -> None:
        if self._thread.reads:
            self._thread.reads[-1][cell] = None
        cell.used_at = self.revision

    def _stands(self, cell: Cell) -> bool:
        """Whether it is right as long as what seldom changes has not."""
        return cell.durable and cell.verified_at >= self._durable_changed_at

    def ask(self, question: Hashable) -> Any:
        """For the function of a query that is asked for by `answered`: what its asker answers."""
        asked, making = self._thread.asked, self._thread.making
        if asked is None or not making or making[-1].cell is not asked.cell:
            raise RuntimeError("there is nobody to answer")
        if question not in asked.answers:
            asked.answers[question] = asked.by.look(question)
        return asked.answers[question]

    @property
    def previous(self) -> Any:
        """For the function of a query: the value that it gave for this key the last time, None if that is not known.
        Parts of it may be taken over; what comes out must not depend on it."""
        value = self._thread.making[-1].cell.value
        return None if value is NONE else value

    @property
    def previous_part(self) -> Any:
        """As `previous`, for what makes a part."""
        known = self._thread.making[-1].known[-1]
        return known[0].value if known else None

    @property
    def is_making(self) -> bool:
        """Whether this thread is within a query."""
        return bool(self._thread.making)

    def part(self, key: Hashable, make: Callable[[], V]) -> V:
        """For the function of a query: a part of its value, which is that of the last time for the same key, if nothing
        that was read for it has changed. `make` may depend on the key and on what it reads, and on nothing else. Parts
        may have parts."""
        return self.part_answered(key, lambda: (make(), {}), _no_answer)

    def part_answered(
        self, key: Hashable, make: Callable[[], tuple[V, Mapping[Any, object]]], look: Callable[[Any], object]
    ) -> V:
        """As `part`, where `make` also depends on the answers to questions, which it gives with the value. `look` tells
        what they are now.

        No query of its own (`Query.answered`): what a part adds depends on those before it, which only the walk that is
        under way can answer, and where it is wrong it is evaluated in its place.
        """
        making = self._thread.making[-1]
        known = (*making.parts[-1].get(key, ()), *making.cell.parts.get(key, ()))
        if known:
            key = known[0].key  # one object for all of them: keys hold much of a text
        part = next((each for each in known if self._is_right(each, look)), None) or self._made(key, known, make)
        part.verified_at = self.revision
        making.parts[-1].update(part.parts)
        making.parts[-1][key] = (part, *(each for each in known if each is not part))[:MOST_ANSWERS_OF_PART]
        self._thread.reads[-1].update(dict.fromkeys(part.depends_on))
        return cast(V, part.value)

    def _made(
        self, key: Hashable, known: tuple[Part, ...], make: Callable[[], tuple[object, Mapping[Any, object]]]
    ) -> Part:
        making = self._thread.making[-1]
        reads: dict[Cell, None] = {}
        parts: Parts = {}
        self._thread.reads.append(reads)
        making.parts.append(parts)
        making.known.append(known)
        try:
            value, answers = make()
        finally:
            self._thread.reads.pop()
            making.parts.pop()
            making.known.pop()
        part = Part(key, value, answers, tuple(reads), parts)
        part.durable = all(map(_durable, reads))
        return part

    def _is_right(self, part: Part, look: Callable[[Any], object]) -> bool:
        """Whether a part would come to the same again."""
        if not all(same(look(question), answer) for question, answer in part.answers.items()):
            return False
        if part.durable and part.verified_at >= self._durable_changed_at:
            return True
        if not all(self._is_unchanged(each, part.verified_at) for each in part.depends_on):
            return False
        part.durable = all(map(_durable, part.depends_on))
        return True

    def _is_unchanged(self, cell: Cell, since: int) -> bool:
        """Whether a cell has the value of this revision, and had it then."""
        if cell.verified_at < self.revision:
            try:
                if cell.answered_by is None:
                    self._bring_up_to_date(cell)
                else:
                    self._bring_up_to_date_for(AsLastTime(cell.answered_by, cell.answers), cell)
            except (Exception, NotAsked):
                return False  # who asks for it in earnest shall see that
        return cell.changed_at <= since

    def forget(self, handle: Hashable) -> None:
        """Let go of all that has this among its keys."""
        for name in [name for name in list(self.cells) if handle in name[1]]:
            self._drop(name)
        for asking in [name for name in list(self._answered) if handle in name[1]]:
            self._answered.pop(asking, None)
        with self._condition:
            for latest in self._latest.values():
                for cell in [cell for cell in latest if handle in cell.key]:
                    del latest[cell]

    def _used(self, cell: Cell, limit: int) -> None:
        latest = self._latest.setdefault(cell.kind, {})
        if cell in latest and 2 * len(latest) < limit:
            return  # who is used after that comes to the end in time
        with self._condition:
            latest.pop(cell, None)
            latest[cell] = None
            if len(latest) > limit:
                oldest = next(iter(latest))
                del latest[oldest]
                name = oldest.kind, oldest.key
                if self.cells.get(name) is oldest:
                    del self.cells[name]
                elif oldest in (answered := self._answered.get(name, [])):
                    answered.remove(oldest)
                    if not answered:
                        del self._answered[name]

    # How a value comes up to date

    def _bring_up_to_date_for(self, answers: Answers, cell: Cell) -> None:
        """The same for a cell whose function asks."""
        thread = self._thread
        before, thread.asked = thread.asked, Asked(cell, answers, {})
        try:
            self._bring_up_to_date(cell)
        finally:
            thread.asked = before

    def _bring_up_to_date(self, cell: Cell) -> None:
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

    def _load(self, cell: Cell, kind: Input[Any, Any]) -> None:
        value = kind.load(*cell.key)
        with self._condition:
            if cell.value is NONE:
                cell.value, cell.durable = value, kind.durable
                cell.changed_at, cell.verified_at = self.revision, _ALWAYS

    def _is_valid(self, cell: Cell) -> bool:
        """Whether nothing that the query read has changed since it was last known to be right."""
        since = cell.verified_at
        if not since:
            return False
        if not (cell.durable and since >= self._durable_changed_at):
            for each in cell.depends_on:
                # Looked at here, without a lock: most of thousands depend on what seldom changes.
                is_durable = each.durable and each.verified_at >= self._durable_changed_at
                if each.changed_at > since if is_durable else not self._is_unchanged(each, since):
                    return False
            cell.durable = all(map(_durable, cell.depends_on))
        cell.verified_at = self.revision
        return True

    def _execute(self, cell: Cell, kind: Query[Any, Any]) -> None:
        reads: dict[Cell, None] = {}
        thread = self._thread
        parts: Parts = {}
        thread.reads.append(reads)
        thread.making.append(Making(cell, [parts], []))
        if self._on_execute is not None:
            self._on_execute(kind, cell.key)
        try:
            value = kind.function(self, *cell.key)
        except Exception:
            with self._condition:
                if cell.verified_at < self.revision:
                    cell.depends_on, cell.value, cell.verified_at = tuple(reads), NONE, 0
                    cell.durable = all(map(_durable, reads))
            raise
        finally:
            thread.reads.pop()
            thread.making.pop()
        asked = thread.asked if thread.asked is not None and thread.asked.cell is cell else None
        same = cell.value is not NONE and cell.value == value
        # Whoever else has read it may answer otherwise what the function asks now.
        same = same and (asked is None or are_same(cell.answers, asked.answers))
        with self._condition:
            if cell.verified_at >= self.revision:
                return  # another thread was faster
            if asked is not None:
                cell.answers, cell.answered_by = asked.answers, asked.by.number
            if not same:
                cell.value, cell.changed_at = value, self.revision
            cell.depends_on, cell.verified_at, cell.parts = tuple(reads), self.revision, parts
            cell.durable = all(map(_durable, reads))

    def _forget_unused(self) -> None:
        """Let go of what nobody asked for in a long time, where there is a lot more than there was last time."""
        enough = min(_MORE * self._remained, self._remained + _MANY)
        if self.revision < self._forgot_at + UNUSED_AFTER or len(self.cells) + len(self._answered) < enough:
            return
        cells = list(self.cells.items())
        old = self.revision - UNUSED_AFTER
        latest = {cell for cells in self._latest.values() for cell in cells}
        asking = [cell for cells in self._answered.values() for cell in cells]
        pending = [cell for _, cell in cells if cell.used_at >= old or cell.is_set or cell in latest]
        pending += (cell for cell in asking if cell.used_at >= old or cell in latest)
        used = set(pending)
        while pending:
            cell = pending.pop()
            parts = (part for known in cell.parts.values() for part in known)
            for each in chain(cell.depends_on, *(part.depends_on for part in parts)):
                if each not in used:
                    used.add(each)
                    pending.append(each)
        for name, cell in cells:
            if cell not in used:
                self._drop(name)
        for asking_name, answered in list(self._answered.items()):
            answered[:] = [cell for cell in answered if cell in used]
            if not answered:
                self._answered.pop(asking_name, None)
        self._forgot_at, self._remained = self.revision, len(self.cells) + len(self._answered)
