"""What is remembered of earlier searches does not show in what is found."""

from __future__ import annotations

import random
from collections.abc import Hashable

from preflight_analysis.model.nearest_memory import NOTHING, Hit, Pools, search

POOLS = 4


def _rate(seeker: Hashable, candidate: Hashable) -> Hit | None:
    """Any fixed function of the two; about half of the candidates will do."""
    assert isinstance(seeker, int)
    assert isinstance(candidate, int)
    distance = (seeker * 7919 + candidate * 104729) % 1009
    return Hit((distance // 50, candidate), candidate) if distance % 2 else None


def _pools(candidates: set[int]) -> dict[Hashable, Pools]:
    """Each candidate is in the pool of its number, and in the one of all."""
    return {candidate: (candidate % POOLS, "all") for candidate in candidates}


def _compared(seekers: dict[Hashable, Pools], candidates: set[int]) -> dict[Hashable, list[Hit]]:
    """Each with each."""
    return {
        seeker: sorted(
            (
                hit
                for candidate, its in _pools(candidates).items()
                if {*its} & {*mine} and (hit := _rate(seeker, candidate)) is not None
            ),
            key=lambda hit: hit.rank,
        )
        for seeker, mine in seekers.items()
    }


def test_what_is_found_is_what_comparing_all_with_all_finds() -> None:
    made = random.Random(4)
    last = NOTHING
    seekers: dict[Hashable, Pools] = {}
    candidates: set[int] = set()
    for _ in range(1500):
        for _ in range(made.choice((0, 1, 1, 1, 3, 20))):
            number = made.randrange(60)
            if made.random() < 0.6:
                candidates ^= {number}
            elif seekers.pop(number, None) is None:
                seekers[number] = ("all",) if number % 3 == 0 else (number % POOLS, (number + 1) % POOLS)
        last = search(last, seekers, _pools(candidates), _rate)
        for seeker, every in _compared(seekers, candidates).items():
            best = last.best[seeker]
            assert [*best.hits] == every[: len(best.hits)]
            assert best.hits or not every
            assert best.more or len(every) == len(best.hits)


def test_only_what_came_is_compared() -> None:
    compared: list[tuple[Hashable, Hashable]] = []

    def rate(seeker: Hashable, candidate: Hashable) -> Hit | None:
        compared.append((seeker, candidate))
        return _rate(seeker, candidate)

    seekers: dict[Hashable, Pools] = dict.fromkeys(range(100), ("all",))
    candidates = set(range(100))
    last = search(NOTHING, seekers, _pools(candidates), rate)
    assert len(compared) == 100 * 100

    compared.clear()
    last = search(last, seekers, _pools(candidates), rate)
    assert not compared

    last = search(last, seekers, _pools(candidates | {100}), rate)
    assert len(compared) == 100

    compared.clear()
    last = search(last, seekers | {100: ("all",)}, _pools(candidates | {100}), rate)
    assert len(compared) == 101
