"""Whatever happens to a database, its answers are those of one that has remembered nothing."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from random import Random

from hypothesis import given, settings
from hypothesis import strategies as st
from preflight_analysis.incremental.database import Cancelled, Database
from preflight_analysis.incremental.query import Input, query

DISK: dict[str, str] = {}
NAMES = "abcdefgh"


def load(name: str) -> str:
    return DISK.get(name, "")


FILE = Input(load)


@query
def words(db: Database, name: str) -> tuple[str, ...]:
    """Words of a file: a digit is itself, a letter what the file of that name has, `!` an error, `?` ends it."""
    return tuple(FILE(db, name).split())


@query
def value(db: Database, name: str, depth: int) -> int:
    result = 0
    for word in words(db, name):
        if word == "!":
            raise ValueError(name)
        if word == "?":
            break
        if word.isdigit():
            result += int(word)
        elif depth < 4:
            result = (2 * result + value(db, word, depth + 1)) % 1000
    return result


@query
def sign(db: Database, name: str) -> bool:
    return value(db, name, 0) > 10


@query
def report(db: Database) -> tuple[object, ...]:
    result: list[object] = []
    for name in NAMES:
        try:
            result.append(sign(db, name) and value(db, name, 0) % 3)
        except ValueError as error:
            result.append(str(error))
    return tuple(result)


@query(limit=3)
def asked(db: Database, name: str) -> tuple[object, ...]:
    """For each word of a file what the asker answers, and what its file gives; a `?` ends the questions."""
    result: list[object] = []
    for word in words(db, name):
        if word == "?":
            break
        result += (db.ask(word), value_or_error(db, word))
    return tuple(result)


class Memory:
    """What a program that goes on in other files has: a number, and the last file but one. What it does not know by
    itself yet is asked for, and so is each answer."""

    def __init__(self, outside: Callable[[str], object] | None = None) -> None:
        self._outside, self.own, self.answers = outside, dict[str, object](), dict[str, object]()

    def look(self, question: str) -> object:
        if question in self.own or self._outside is None:
            return self.own.get(question)
        if question not in self.answers:
            self.answers[question] = self._outside(question)
        return self.answers[question]


Said = tuple[tuple[object, ...], dict[str, object]]


@query
def program(db: Database, name: str) -> tuple[object, ...]:
    """What a file says, whose parts are the files that it names: a digit is the number from now on, `!` says it."""
    return _program(db, name, (name,), Memory())[0]


def _program(db: Database, name: str, chain: tuple[str, ...], memory: Memory) -> Said:
    said: list[object] = []
    for word in words(db, name):
        if word == "!":
            said.append(memory.look("number"))
        elif word == "?":
            said.append((name, memory.look("last")))
        elif word.isdigit():
            memory.own["number"] = word
        elif len(chain) < 5:
            below = (*chain, word)
            more, changed = db.part_answered(below, partial(_part, db, word, below, memory.look), memory.look)
            said += more
            memory.own.update(changed)
            memory.own["last"] = word
    return tuple(said), memory.own


def _part(
    db: Database, name: str, chain: tuple[str, ...], look: Callable[[str], object]
) -> tuple[Said, Mapping[str, object]]:
    memory = Memory(look)
    return _program(db, name, chain, memory), memory.answers


@query
def discussed(db: Database, asker: str, name: str) -> tuple[object, ...]:
    """What a file asks of another one, by how often that has it; the other's first word decides whether at all."""
    if words(db, asker)[:1] == ("5",):
        return ()
    return asked.answered(db, Counts(FILE(db, asker)), name)


@query
def discussions(db: Database) -> tuple[object, ...]:
    return tuple(discussed(db, asker, name) for name in "abc" for asker in "cdef")


class Counts:
    """Answers how often something is in a text."""

    def __init__(self, text: str) -> None:
        self.number = hash(text)
        self.look = text.count

    def alike(self, number: int, questions: Iterable[object]) -> bool:
        return number == self.number


TEXTS = st.lists(st.sampled_from([*NAMES, "1", "5", "20", "!", "?"]), max_size=5).map(" ".join)
STEPS = st.lists(
    st.tuples(
        st.sampled_from(["open", "open", "close", "disk", "read", "read one", "ask", "program", "discuss"]),
        st.sampled_from(NAMES),
        TEXTS,
    ),
    max_size=100,
)


def step(db: Database, what: str, name: str, text: str) -> None:
    if what == "open":
        with db.writing() as write:
            write.set(FILE, text, name)
    elif what == "close":
        with db.writing() as write:
            write.reload(FILE, name)
    elif what == "disk":
        DISK[name] = text
        with db.writing() as write:
            for kind, key in list(db.cells):
                if kind is FILE:
                    write.reload(FILE, *key)
    elif what == "read":
        report(db)
    elif what == "read one":
        value_or_error(db, name)


def value_or_error(db: Database, name: str) -> object:
    try:
        return value(db, name, 0)
    except ValueError as error:
        return str(error)


def fresh(db: Database) -> Database:
    """A database with the same inputs, and nothing else."""
    again = Database()
    with again.writing() as write:
        for (kind, key), cell in db.cells.items():
            if kind is FILE:
                write.set(FILE, cell.value, *key)
    return again


@settings(max_examples=300, deadline=None)
@given(STEPS)
def test_after_any_steps(steps: list[tuple[str, str, str]]) -> None:
    DISK.clear()
    db = Database()
    for what, name, text in steps:
        step(db, what, name, text)
        if what == "ask":
            assert asked.answered(db, Counts(text), name) == asked.answered(fresh(db), Counts(text), name)
        if what == "program":
            assert program(db, name) == program(fresh(db), name)
        if what == "discuss":
            assert discussions(db) == discussions(fresh(db))
        if what.startswith("read"):
            again = fresh(db)
            assert report(db) == report(again)
            assert [value_or_error(db, name) for name in NAMES] == [value_or_error(again, name) for name in NAMES]
    assert report(db) == report(fresh(db))


def test_after_many_steps_in_threads() -> None:
    """Readers in threads while there are writes: each sees one revision, and at the end all is as if made anew."""
    DISK.clear()
    random = Random(7)
    db, ended = Database(), threading.Event()

    def reader() -> int:
        rounds = 0
        while not ended.is_set():
            try:
                with db.reading():
                    first, before = report(db), discussions(db)
                    assert [value_or_error(db, name) for name in NAMES] == [value_or_error(db, n) for n in NAMES]
                    assert (report(db), discussions(db)) == (first, before)
                    rounds += 1
            except Cancelled:
                pass
        return rounds

    with ThreadPoolExecutor(3) as pool:
        readers = [pool.submit(reader) for _ in range(3)]
        for _ in range(1_500):
            text = " ".join(random.choices([*NAMES, "1", "5", "20", "!"], k=random.randrange(5)))
            step(db, random.choice(["open", "close", "disk"]), random.choice(NAMES), text)
            if random.random() < 0.1:
                assert (report(db), discussions(db)) == (report(again := fresh(db)), discussions(again))
        ended.set()
        rounds = [each.result(30) for each in readers]
    assert all(rounds)
    assert (report(db), discussions(db)) == (report(again := fresh(db)), discussions(again))
