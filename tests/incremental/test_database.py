"""What is made again after a change, and what is not."""

from __future__ import annotations

import threading
import weakref
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial
from itertools import count
from typing import Any

import pytest
from preflight_analysis.incremental.database import UNUSED_AFTER, Cancelled, CycleError, Database
from preflight_analysis.incremental.query import Input, Key, Query, query

OUTSIDE: dict[str, str] = {}
PATIENCE = 20.0


@pytest.fixture(autouse=True)
def outside() -> Iterator[None]:
    OUTSIDE.clear()
    OUTSIDE.update(a="1 2", b="3", c="")
    yield


def load(name: str) -> str:
    return OUTSIDE.get(name, "")


TEXT = Input(load)
TYPED = Input(load, durable=False)


@query
def numbers(db: Database, name: str) -> tuple[int, ...]:
    return tuple(map(int, TEXT(db, name).split()))


@query
def total(db: Database, *names: str) -> int:
    return sum(sum(numbers(db, name)) for name in names)


@query
def described(db: Database, *names: str) -> str:
    return f"{total(db, *names)} in all"


@query
def length(db: Database, name: str) -> int | None:
    try:
        return len(numbers(db, name))
    except ValueError:
        return None


@query
def chosen(db: Database, name: str) -> tuple[int, ...]:
    return numbers(db, "a" if TYPED(db, name) else "b")


@query
def forever(db: Database, name: str) -> int:
    return forever(db, name) + 1


class Made:
    """A database, and the queries that it made since it was last asked."""

    def __init__(self) -> None:
        self.made: list[tuple[str, Key]] = []
        self.db = Database(lambda kind, key: self.made.append((kind.name, key)))

    def names(self) -> list[str]:
        names, self.made = [name for name, _ in self.made], []
        return names


def change(db: Database, name: str, text: str, kind: Input[Any, str] = TEXT) -> None:
    with db.writing() as write:
        write.set(kind, text, name)


def test_what_did_not_change_is_not_made_again() -> None:
    it = Made()
    assert described(it.db, "a", "b") == "6 in all"
    assert it.names() == ["described", "total", "numbers", "numbers"]
    assert described(it.db, "a", "b") == "6 in all"
    change(it.db, "c", "7")
    assert described(it.db, "a", "b") == "6 in all"
    assert it.names() == []
    change(it.db, "b", "4")
    assert described(it.db, "a", "b") == "7 in all"
    assert it.names() == ["numbers", "total", "described"]


def test_where_a_value_comes_out_equal_nothing_above_is_made_again() -> None:
    it = Made()
    first = numbers(it.db, "a")
    assert described(it.db, "a", "b") == "6 in all"
    it.names()
    change(it.db, "a", "1  2 ")
    assert described(it.db, "a", "b") == "6 in all"
    assert it.names() == ["numbers"]
    assert numbers(it.db, "a") is first
    change(it.db, "a", "2 1")
    assert described(it.db, "a", "b") == "6 in all"
    assert it.names() == ["numbers", "total"]


def test_only_what_was_read_last_time_counts() -> None:
    it = Made()
    assert chosen(it.db, "c") == (3,)
    change(it.db, "a", "5")
    assert chosen(it.db, "c") == (3,)
    change(it.db, "c", "yes", TYPED)
    assert chosen(it.db, "c") == (5,)
    it.names()
    change(it.db, "b", "9")
    assert chosen(it.db, "c") == (5,)
    assert it.names() == []


def test_an_input_is_loaded_once_and_again_when_told() -> None:
    db = Database()
    assert numbers(db, "a") == (1, 2)
    OUTSIDE["a"] = "7"
    assert numbers(db, "a") == (1, 2)
    with db.writing() as write:
        write.reload(TEXT, "a")
    assert numbers(db, "a") == (7,)
    OUTSIDE["b"] = "8"
    assert numbers(db, "b") == (8,)
    OUTSIDE.update(a="0", b="0")
    outdated = db.outdated(TEXT, [("a",), ("b",), ("c",), ("never read",)])
    assert outdated == [("a",), ("b",)]
    with db.writing() as write:
        for key in outdated:
            write.reload(TEXT, *key)
    assert numbers(db, "a") == numbers(db, "b") == (0,)


def test_a_write_that_changes_nothing_is_no_revision() -> None:
    db = Database()
    numbers(db, "a")
    before = db.revision
    with db.writing() as write:
        write.reload(TEXT, "a")
        write.set(TEXT, "1 2", "a", durable=True)
        write.reload(TEXT, "never read")
    assert db.revision == before


def test_what_is_set_goes_back_to_what_is_outside() -> None:
    db = Database()
    change(db, "a", "10")
    assert numbers(db, "a") == (10,)
    change(db, "a", "11")
    assert numbers(db, "a") == (11,)
    with db.writing() as write:
        write.reload(TEXT, "a")
    assert numbers(db, "a") == (1, 2)


def test_an_input_that_begins_to_change_often_is_looked_at_each_time() -> None:
    db = Database()
    assert described(db, "a") == "3 in all"
    change(db, "a", "1 2")
    assert described(db, "a") == "3 in all"
    change(db, "a", "1 2 3")
    assert described(db, "a") == "6 in all"


def test_what_raises_raises_again_until_it_does_not() -> None:
    db = Database()
    change(db, "a", "x")
    for _ in range(2):
        with pytest.raises(ValueError, match="x"):
            described(db, "a", "b")
    assert length(db, "a") is None
    change(db, "b", "5")
    assert length(db, "a") is None
    change(db, "a", "1 1 1")
    assert length(db, "a") == 3
    assert described(db, "a", "b") == "8 in all"


def test_a_query_that_needs_itself_is_an_error() -> None:
    with pytest.raises(CycleError, match="forever"):
        forever(Database(), "a")


def test_what_nobody_asks_for_any_more_is_forgotten() -> None:
    db = Database()
    for number in range(20 * UNUSED_AFTER):
        change(db, "typed", str(number), TYPED)

        @query
        def by_text(db: Database, text: str) -> str:
            return TYPED(db, "typed") + text

        by_text(db, str(number))
    assert len(db.cells) <= 3 * UNUSED_AFTER


def test_what_was_loaded_for_what_nobody_asks_for_is_forgotten_too() -> None:
    db = Database()
    for number in range(20 * UNUSED_AFTER):
        change(db, "typed", str(number), TYPED)
        numbers(db, f"only once {number}")
        assert numbers(db, "a") == (1, 2)
    assert len(db.cells) <= 4 * UNUSED_AFTER
    assert (numbers, ("a",)) in db.cells


def test_what_was_answered_is_forgotten_too() -> None:
    class Value:
        pass

    @query
    def made_for(db: Database, name: str) -> Value:
        db.ask(name)
        return Value()

    db, answers = Database(), Answering(str, [])
    kept, gone = made_for.answered(db, answers, "a"), []
    for number in range(20 * UNUSED_AFTER):
        change(db, "typed", str(number), TYPED)
        gone.append(weakref.ref(made_for.answered(db, answers, f"only once {number}")))
        assert made_for.answered(db, answers, "a") is kept
    assert sum(value() is not None for value in gone) <= 3 * UNUSED_AFTER


def test_what_was_set_is_not_forgotten() -> None:
    db = Database()
    change(db, "b", "8")
    for number in range(4 * UNUSED_AFTER):
        change(db, "typed", str(number), TYPED)
    assert numbers(db, "b") == (8,)


@query(limit=3)
def last_few(db: Database, name: str) -> str:
    return TEXT(db, name)


def test_of_a_query_with_a_limit_those_stay_that_were_asked_for_last() -> None:
    it = Made()
    for name in ("a", "b", "c", "a", "d", "a"):
        last_few(it.db, name)
    it.names()
    assert [last_few(it.db, name) for name in "acd"] == ["1 2", "", ""]
    assert it.names() == []
    last_few(it.db, "b")
    assert it.names() == ["last_few"]


@query
def grown(db: Database, name: str) -> tuple[str, ...]:
    return (*(db.previous or ()), TEXT(db, name))


def test_a_query_may_look_at_what_it_gave_before() -> None:
    db = Database()
    assert grown(db, "a") == ("1 2",)
    change(db, "a", "new")
    assert grown(db, "a") == ("1 2", "new")
    assert grown(db, "b") == ("3",)


@query
def translated(db: Database, name: str) -> str:
    return " ".join(str(db.ask(word)) for word in TEXT(db, name).split())


@query
def lengths(db: Database, name: str) -> tuple[int, ...]:
    """Of the files that a file names; each is a part of its own."""
    return tuple(db.part(word, partial(_length, db, word)) for word in TEXT(db, name).split())


def _length(db: Database, name: str) -> int:
    MADE.append(name)
    return len(numbers(db, name))


MADE: list[str] = []


def test_parts_are_made_again_where_what_they_read_has_changed() -> None:
    db = Database()
    change(db, "list", "a b")
    assert lengths(db, "list") == (2, 1)
    MADE.clear()
    change(db, "list", "b a a c")
    assert lengths(db, "list") == (1, 2, 2, 0)
    assert MADE == ["c"]
    change(db, "a", "1 2 3")
    assert lengths(db, "list") == (1, 3, 3, 0)
    assert MADE == ["c", "a"], "and the second time it is there"
    change(db, "list", "b")
    change(db, "list", "a b")
    assert lengths(db, "list") == (3, 1), "what was no part for a while is not asked for in between"
    change(db, "b", "7 7")
    assert lengths(db, "list") == (3, 2)


@query
def sayings(db: Database, name: str) -> tuple[str, ...]:
    """A word after the other: capitals are what is meant from then on, other words are parts that may ask for it."""
    meant, said = "", []
    for word in TEXT(db, name).split():
        if word.isupper():
            meant = word
        else:
            said.append(db.part_answered(word, partial(_saying, db, word, meant), {"meant": meant}.get))
    return tuple(said)


def _saying(db: Database, name: str, meant: str) -> tuple[str, Mapping[str, str]]:
    MADE.append(name)
    text = TEXT(db, name)
    inside = db.part((name, text), lambda: text.upper())
    if "?" not in text:
        return inside, {}
    return f"{inside} {meant}{TEXT(db, meant)}", {"meant": meant}


def test_parts_are_made_again_where_they_would_be_answered_otherwise() -> None:
    db = Database()
    change(db, "a", "what is ?")
    change(db, "b", "nothing")
    change(db, "list", "X a b")
    assert sayings(db, "list") == ("WHAT IS ? X", "NOTHING")
    MADE.clear()
    change(db, "list", "Y a b")
    assert sayings(db, "list") == ("WHAT IS ? Y", "NOTHING"), "b has not asked"
    change(db, "list", "X a b Y a b")
    assert sayings(db, "list") == ("WHAT IS ? X", "NOTHING", "WHAT IS ? Y", "NOTHING")
    assert MADE == ["a"]


def test_what_parts_were_made_of_is_not_forgotten() -> None:
    db = Database()
    change(db, "list", "X a")
    change(db, "a", "what is ?")
    sayings(db, "list")
    change(db, "list", "Y a")
    for number in range(3 * UNUSED_AFTER):
        assert sayings(db, "list") == ("WHAT IS ? Y",)
        change(db, "other", f"{number}")
        TEXT(db, f"unused {number}")
    OUTSIDE["X"] = ", the letter"
    with db.writing() as write:
        write.reload(TEXT, "X")
    change(db, "list", "X a")
    assert sayings(db, "list") == ("WHAT IS ? X, the letter",)


class Answering:
    """Answers by a function; what it is asked is noted."""

    numbers = count()

    def __init__(self, look: Callable[[Any], object], asked: list[Any]) -> None:
        self.number = next(self.numbers)
        self._look = look
        self._asked = asked

    def look(self, question: Any) -> object:
        self._asked.append(question)
        return self._look(question)

    def alike(self, number: int, questions: Iterable[Any]) -> bool:
        return number == self.number


def test_who_has_answered_before_is_not_asked_again() -> None:
    db, asked = Database(), list[Any]()
    answers = Answering(str, asked)
    assert translated.answered(db, answers, "a") == translated.answered(db, answers, "a") == "1 2"
    assert asked == ["1", "2"]
    assert translated.answered(db, Answering(str, asked), "a") == "1 2"
    assert asked == ["1", "2"] * 2


def test_answers_are_part_of_what_is_remembered() -> None:
    it = Made()
    asked: list[Any] = []

    def answer(words: dict[str, object]) -> Answering:
        return Answering(lambda question: words.get(question, "?"), asked)

    one, two = {"1": "one", "2": "two", "3": "no matter"}, {"1": "eins", "2": "zwei"}
    for words, expected in ((one, "one two"), (two, "eins zwei"), (one | {"3": "three"}, "one two")):
        assert translated.answered(it.db, answer(words), "a") == expected
    assert it.names() == ["translated", "translated"]
    asked.clear()
    change(it.db, "a", "2 3")
    assert translated.answered(it.db, answer(one), "a") == "two no matter"
    assert translated.answered(it.db, answer(one | {"1": "other"}), "a") == "two no matter"
    assert "1" in asked, "what it was made of last time tells which of what is remembered may be right"
    assert translated.answered(it.db, answer({"2": True}), "a") == "True ?"
    assert translated.answered(it.db, answer({"2": 1}), "a") == "1 ?"


def test_equal_values_for_other_answers_are_one_object() -> None:
    db = Database()

    @query
    def how_many(db: Database) -> tuple[str, int]:
        return "long", len(db.ask("word"))

    first, second, third = (
        how_many.answered(db, Answering(lambda _, word=word: word, [])) for word in ("a", "b", "cc")
    )
    assert first is second
    assert third == ("long", 2)


def test_parts_are_taken_over_where_other_answers_are_given() -> None:
    db = Database()
    change(db, "list", "a b")
    change(db, "a", "plain")
    change(db, "b", "what is ?")

    @query
    def said(db: Database) -> tuple[str, ...]:
        meant = db.ask("meant")
        words = TEXT(db, "list").split()
        look = {"meant": meant}.get
        return tuple(db.part_answered(word, partial(_saying, db, word, meant), look) for word in words)

    MADE.clear()
    for word, made in (("X", ["a", "b"]), ("Y", ["b"]), ("Z", ["b"])):
        assert said.answered(db, Answering(lambda _, word=word: word, [])) == ("PLAIN", f"WHAT IS ? {word}")
        assert made == MADE
        MADE.clear()


def test_who_makes_a_part_again_sees_what_it_was() -> None:
    db = Database()
    seen: list[object] = []

    @query
    def noted(db: Database) -> str:
        meant = TEXT(db, "a")

        def make() -> tuple[str, Mapping[str, str]]:
            db.part("inside", lambda: "inside")
            seen.append(db.previous_part)
            return meant.upper(), {"meant": meant}

        return db.part_answered("key", make, {"meant": meant}.get)

    for text in ("one", "two", "one", "three"):
        change(db, "a", text)
        assert noted(db) == text.upper()
    assert seen == [None, "ONE", "ONE"]


def test_what_is_made_of_a_question_that_nobody_answers_is_no_value() -> None:
    db = Database()
    change(db, "a", "1")
    answers = Answering({"1": "one", "2": "two"}.__getitem__, [])

    @query
    def forgiving(db: Database) -> str:
        try:
            return str(db.ask(TEXT(db, "a")))
        except Exception:
            return "nobody knows"

    @query
    def asking(db: Database) -> str:
        return forgiving.answered(db, answers)

    assert asking(db) == "one"
    change(db, "a", "2")
    assert asking(db) == "two"


def test_many_are_asked_for_at_once() -> None:
    it, asked = Made(), list[Any]()
    answers = Answering(str, asked)
    assert translated.answered_each(it.db, answers, [("a",), ("b",), ("a",)]) == ["1 2", "3", "1 2"]
    change(it.db, "b", "4")
    it.names()
    assert translated.answered_each(it.db, answers, [("a",), ("b",)]) == ["1 2", "4"]
    assert it.names() == ["translated"]


@query(limit=2)
def translated_few(db: Database, name: str) -> str:
    return "".join(db.ask(part) for part in TEXT(db, name))


def test_of_answered_values_those_stay_that_were_asked_for_last() -> None:
    it = Made()
    answers = Answering(str, [])
    for name in "abca":
        translated_few.answered(it.db, answers, name)
    it.names()
    translated_few.answered_each(it.db, answers, [("c",), ("a",)])
    assert it.names() == []
    translated_few.answered(it.db, answers, "b")
    assert it.names() == ["translated_few"]


def test_who_does_not_answer_is_not_asked() -> None:
    @query
    def asks(db: Database) -> str:
        return translated(db, "a")

    db = Database()
    with pytest.raises(RuntimeError, match="nobody"):
        translated(db, "a")
    with pytest.raises(RuntimeError, match="nobody"):
        asks.answered(db, Answering(str, []))


@query
def dialogue(db: Database, name: str) -> str:
    """The words of a file in its language, which a file says, too."""
    language = numbers(db, TEXT(db, f"{name}'s language"))
    return translated.answered(db, Answering(lambda word: language[int(word)], []), name)


@query
def loud_dialogue(db: Database, name: str) -> str:
    return dialogue(db, name) + "!"


def test_a_query_may_answer() -> None:
    OUTSIDE.update({"a's language": "german", "german": "0 11 22 33", "b's language": "german"})
    it = Made()
    assert loud_dialogue(it.db, "a") == "11 22!"
    assert it.names() == ["loud_dialogue", "dialogue", "numbers", "translated"]
    change(it.db, "german", "0 11 22 44")
    assert loud_dialogue(it.db, "a") == "11 22!"
    assert it.names() == ["numbers", "dialogue"], "the answers are what they were"
    change(it.db, "german", "0 1 2 3")
    assert loud_dialogue(it.db, "a") == "1 2!"
    change(it.db, "a", "2  1")
    assert loud_dialogue(it.db, "a") == "2 1!"
    change(it.db, "a", "1 3")
    assert loud_dialogue(it.db, "a") == "1 3!", "it asks what it did not ask before"
    it.names()
    change(it.db, "a", "1   3")
    assert loud_dialogue(it.db, "a") == "1 3!"
    assert it.names() == ["translated"], "it comes to the same"


def test_what_another_one_answered_is_no_answer_of_mine() -> None:
    OUTSIDE.update(mine="1 7", yours="1 1", a="0")

    @query
    def highest(db: Database) -> int:
        return max(db.ask(place) for place in numbers(db, "a"))

    @query
    def highest_of(db: Database, name: str) -> int:
        return highest.answered(db, Answering(numbers(db, name).__getitem__, []))

    db = Database()
    assert highest_of(db, "mine") == highest_of(db, "yours") == 1
    change(db, "a", "0 1")
    change(db, "yours", "1 1 1")
    assert highest_of(db, "yours") == 1, "no other value than before, but it was asked more"
    assert highest_of(db, "mine") == 7


def test_all_of_a_handle_is_forgotten_at_once() -> None:
    handle = object()

    @query
    def of_handle(db: Database, handle: object, name: str) -> str:
        return TEXT(db, name)

    db = Database()
    of_handle(db, handle, "a")
    of_handle.answered(db, Answering(str, []), handle, "b")
    of_handle(db, object(), "a")
    db.forget(handle)
    assert not any(handle in key for _, key in db.cells)
    assert len([key for kind, key in db.cells if kind is of_handle]) == 1


def test_keys_are_given_by_their_places() -> None:
    with pytest.raises(TypeError, match="by places"):
        numbers(Database(), name="a")
    with pytest.raises(TypeError, match="by places"):
        TEXT(Database(), name="a")


def test_a_query_cannot_write() -> None:
    @query
    def writes(db: Database) -> None:
        with db.writing():
            pass

    with pytest.raises(RuntimeError, match="cannot change inputs"):
        writes(Database())


def test_a_write_makes_readers_leave_and_readers_see_one_revision() -> None:
    db = Database()
    inside, go_on = threading.Event(), threading.Event()
    seen: list[object] = []

    @query
    def slow(db: Database, name: str) -> tuple[int, ...]:
        inside.set()
        assert go_on.wait(PATIENCE)
        return numbers(db, name)

    def read() -> None:
        try:
            with db.reading():
                slow(db, "a")
        except Cancelled:
            seen.append("cancelled")
        seen.append(slow(db, "a"))

    def write() -> None:
        change(db, "a", "9")

    reader, writer = threading.Thread(target=read), threading.Thread(target=write)
    reader.start()
    assert inside.wait(PATIENCE)
    writer.start()
    while not db._writers:
        pass
    assert writer.is_alive()
    go_on.set()
    for each in (reader, writer):
        each.join(PATIENCE)
    assert seen == ["cancelled", (9,)]


def test_a_question_outside_of_reading_begins_again() -> None:
    db = Database()
    writers: list[threading.Thread] = []

    @query
    def interrupted(db: Database, name: str) -> tuple[int, ...]:
        if not writers:
            writers.append(threading.Thread(target=change, args=(db, "a", "9")))
            writers[0].start()
            while not db._writers:
                pass
        return numbers(db, name)

    assert interrupted(db, "a") == (9,)
    writers[0].join(PATIENCE)


def test_threads_that_want_the_same_wait_for_the_one_that_makes_it() -> None:
    it = Made()
    began, go_on = threading.Event(), threading.Event()

    @query
    def slow(db: Database) -> int:
        began.set()
        assert go_on.wait(PATIENCE)
        return total(db, "a", "b")

    answers: list[int] = []
    threads = [threading.Thread(target=lambda: answers.append(slow(it.db))) for _ in range(4)]
    for thread in threads:
        thread.start()
    assert began.wait(PATIENCE)
    go_on.set()
    for thread in threads:
        thread.join(PATIENCE)
    assert answers == [6] * 4
    assert it.names().count("slow") == 1


def test_two_threads_that_need_what_the_other_makes_do_not_wait_for_ever() -> None:
    db = Database()
    both = threading.Barrier(2)
    queries: dict[str, Query[[str], int]] = {}

    def crossing(db: Database, other: str) -> int:
        both.wait(PATIENCE) if not both.broken else None
        both.abort()
        return (queries[other](db, "") if other else 0) + 1

    def make(name: str) -> None:
        queries[name] = Query(crossing)

    make("left"), make("right")
    answers: list[int] = []

    def ask(mine: str, other: str) -> None:
        try:
            answers.append(queries[mine](db, other))
        except threading.BrokenBarrierError:
            answers.append(queries[mine](db, other))

    threads = [threading.Thread(target=ask, args=pair) for pair in (("left", "right"), ("right", "left"))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(PATIENCE)
    assert answers == [2, 2]
