"""What is taken over from the last time, and what is not."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from preflight_analysis.incremental.kept import Kept

CALLS: list[tuple[object, ...]] = []


def described(*parts: object) -> str:
    CALLS.append(parts)
    return " ".join(map(str, parts))


def round_of(before: Kept | None, items: dict[str, object]) -> tuple[Kept, list[str], list[tuple[object, ...]]]:
    CALLS.clear()
    kept = Kept(before)
    texts = [kept.get(described, key, key, value) for key, value in items.items()]
    kept.end()
    return kept, texts, list(CALLS)


def test_only_what_changed_is_made_again() -> None:
    first, texts, made = round_of(None, {"a": 1, "b": 2})
    assert texts == ["a 1", "b 2"] and len(made) == 2
    second, texts, made = round_of(first, {"a": 1, "b": 3, "c": 4})
    assert texts == ["a 1", "b 3", "c 4"] and made == [("b", 3), ("c", 4)]
    _, texts, made = round_of(second, {"b": 3, "a": 1})
    assert texts == ["b 3", "a 1"] and made == []


def test_nothing_older_than_the_last_time_is_taken() -> None:
    first, _, _ = round_of(None, {"a": 1})
    second, _, _ = round_of(first, {})
    assert round_of(second, {"a": 1})[2] == [("a", 1)]


def test_two_items_of_one_key_are_two() -> None:
    kept = Kept()
    assert [kept.get(described, "same", value) for value in (1, 2, 1)] == ["1", "2", "1"]


def test_functions_are_apart() -> None:
    kept = Kept()
    assert kept.get(described, "a", 1) == "1"
    assert kept.get(len, "a", "text") == 4


def test_of_many_items_only_other_objects_are_looked_at() -> None:
    items: list[object] = [["a"], ["b"], ["c"]]
    CALLS.clear()
    first = Kept()
    assert first.each(described, items, 1) == ("['a'] 1", "['b'] 1", "['c'] 1")
    items[1] = ["d"]
    second = Kept(first)
    assert second.each(described, items, 1) == ("['a'] 1", "['d'] 1", "['c'] 1")
    assert len(CALLS) == 4
    items.insert(1, ["e"])
    third = Kept(second)
    assert third.each(described, items, 1) == ("['a'] 1", "['e'] 1", "['d'] 1", "['c'] 1")
    assert len(CALLS) == 5
    assert Kept(third).each(described, items, 2) == ("['a'] 2", "['e'] 2", "['d'] 2", "['c'] 2")
    assert len(CALLS) == 9


@given(st.lists(st.lists(st.integers(0, 7), max_size=9), max_size=5))
def test_many_items_in_any_order_have_their_own_results(rounds: list[list[int]]) -> None:
    pool = [[number] for number in range(8)]
    kept = Kept()
    for numbers in rounds:
        kept = Kept(kept)
        found = kept.each(described, [pool[number] for number in numbers])
        assert found == tuple(f"[{number}]" for number in numbers)
        assert kept.each(len, found) == (3,) * len(numbers)


@given(st.lists(st.lists(st.tuples(st.integers(0, 3), st.integers(0, 3)), max_size=9), max_size=5))
def test_rows_in_any_order_have_their_own_results(rounds: list[list[tuple[int, int]]]) -> None:
    pool = [[number] for number in range(4)]
    kept = Kept()
    for pairs in rounds:
        kept = Kept(kept)
        found = kept.each_row(described, ([pool[one] for one, _ in pairs], [pool[other] for _, other in pairs]), 0)
        assert found == tuple(f"[{one}] [{other}] 0" for one, other in pairs)
        assert kept.each_row(max, (found, tuple(reversed(found)))) == tuple(map(max, found, reversed(found)))


def test_of_rows_only_those_are_looked_at_in_which_one_is_another_object() -> None:
    items, others = [["a"], ["b"], ["c"]], [["d"], ["e"], ["f"]]
    CALLS.clear()
    first = Kept()
    first.each_row(described, (items, others))
    others[2] = ["g"]
    second = Kept(first)
    assert second.each_row(described, (items, others)) == ("['a'] ['d']", "['b'] ['e']", "['c'] ['g']")
    assert CALLS[3:] == [(["c"], ["g"])]
    Kept(second).each_row(described, (items[1:], others[1:]))
    assert len(CALLS) == 4
    with pytest.raises(ValueError, match="same length"):
        second.each_row(described, (items, others[1:]))


def first(item: list[int]) -> int:
    return item[0]


def larger(one: list[int], other: list[int]) -> list[int]:
    return max(one, other)


ROUNDS = st.lists(st.lists(st.integers(0, 7), max_size=9), max_size=6)
OF_ONE_LENGTH = st.integers(1, 9).flatmap(
    lambda length: st.lists(st.lists(st.integers(0, 7), min_size=length, max_size=length), max_size=6)
)


@given(ROUNDS)
def test_several_functions_of_one_tuple_have_their_own_results(rounds: list[list[int]]) -> None:
    pool = [[number] for number in range(8)]
    kept = Kept()
    for numbers in rounds:
        kept = Kept(kept)
        items = tuple(pool[number] for number in numbers)
        assert kept.each(first, items) == kept.each(first, items) == (*numbers,)
        assert kept.each(described, items) == tuple(f"[{number}]" for number in numbers)
        backwards = tuple(reversed(items))
        assert kept.each_row(larger, (items, backwards)) == (*map(max, items, backwards),)
        kept.end()


def parity(item: list[int]) -> int:
    return item[0] % 3


@given(st.one_of(ROUNDS, OF_ONE_LENGTH))
def test_groups_are_those_of_all_items(rounds: list[list[int]]) -> None:
    pool = [[number] for number in range(8)]
    kept, before = Kept(), dict[int, tuple[list[int], ...]]()
    for numbers in rounds:
        kept = Kept(kept)
        found = kept.grouped(parity, "", [pool[number] for number in numbers])
        assert found == {
            key: tuple(pool[number] for number in numbers if number % 3 == key) for key in {n % 3 for n in numbers}
        }
        assert list(found) == list(dict.fromkeys(number % 3 for number in numbers))
        assert all(found[key] is before[key] for key in found if found[key] == before.get(key))
        before = found


def divisors(item: list[int]) -> tuple[int, ...]:
    return tuple(number for number in (2, 3, 5) if item[0] % number == 0)


@given(st.one_of(ROUNDS, OF_ONE_LENGTH))
def test_an_index_is_that_of_all_keys(rounds: list[list[int]]) -> None:
    pool = [[number] for number in range(8)]
    kept, before = Kept(), dict[int, tuple[list[int], ...]]()
    for numbers in rounds:
        kept = Kept(kept)
        found = kept.indexed(divisors, "", [pool[number] for number in numbers])
        keys = {key for number in numbers for key in divisors(pool[number])}
        assert found == {key: tuple(pool[number] for number in numbers if number % key == 0) for key in keys}
        firsts = [next(at for at, number in enumerate(numbers) if number % key == 0) for key in found]
        assert firsts == sorted(firsts)
        assert all(found[key] is before[key] for key in found if found[key] == before.get(key))
        before = found


def test_what_is_patched_gets_what_it_was() -> None:
    asked: list[object] = []

    def total(before: tuple[tuple[object, ...], int] | None, numbers: tuple[int, ...]) -> int:
        asked.append(before)
        return sum(numbers)

    first = Kept()
    assert first.patched(total, "", (1, 2)) == 3
    second = Kept(first)
    assert second.patched(total, "", (1, 2)) == 3
    assert Kept(second).patched(total, "", (1, 5)) == 6
    assert asked == [None, (((1, 2),), 3)]
    with pytest.raises(TypeError, match="by their places"):
        second.patched(total, "", numbers=())


def test_equal_objects_are_not_the_same() -> None:
    item, alike = ["a"], ["a"]
    first = Kept()
    assert first.get(id, "a", item) == id(item)
    assert first.get(id, "a", alike) == id(alike)
    assert first.get(len, "pair", (item, "x", 1)) == 3
    CALLS.clear()
    first.get(described, "pair", (item, "x", 1), None)
    first.get(described, "pair", (item, "".join(["x"]), 1), None)
    assert len(CALLS) == 1
    first.get(described, "pair", (item, "x", True), None)
    first.get(described, "pair", (alike, "x", True), None)
    first.get(described, "pair", (alike, "x"), None)
    assert len(CALLS) == 4


def test_arguments_with_names_are_refused() -> None:
    with pytest.raises(TypeError, match="by their places"):
        Kept().get(int, "a", "10", base=2)
    with pytest.raises(TypeError, match="by their places"):
        Kept().each(int, ["10"], base=2)
