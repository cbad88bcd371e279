"""What is remembered of earlier searches does not show in what is found."""

from __future__ import annotations

import random
from collections.abc import Hashable

from preflight_analysis.rules.nearest_memory import Hit, Search, search

POOLS = 4


def _rate(seeker: Hashable, candidate: Hashable) -> Hit | None:
    """Any fixed function of the two; about half of the candidates will do."""
    assert isinstance(seeker, int)
    assert isinstance(candidate, int)
    distance = (seeker * 7919 + candidate * 104729) % 1009
    return Hit((distance // 50, candidate), candidate) if distance % 2 else None


def _pools(candidates: set[int]) -> dict[Hashable, list[Hashable]]:
    """Each candidate is in the pool of its number, and in the one of all."""
    pools: dict[Hashable, list[Hashable]] = {number: [] for number in range(POOLS)}
    for candidate in candidates:
        pools[candidate % POOLS].append(candidate)
    return pools | {"all": list(candidates)}


def _compared(seekers: dict[Hashable, tuple[Hashable, ...]], candidates: set[int]) -> dict[Hashable, Hit]:
    """Each with each."""
    pools, found = _pools(candidates), {}
    for seeker, names in seekers.items():
        mine = {candidate for name in names for candidate in pools[name]}
        hits = [hit for hit in (_rate(seeker, candidate) for candidate in mine) if hit is not None]
        if hits:
            found[seeker] = min(hits, key=lambda hit: hit.rank)
    return found


def test_what_is_found_is_what_comparing_all_with_all_finds() -> None:
    made = random.Random(4)
    last: Search | None = None
    seekers: dict[Hashable, tuple[Hashable, ...]] = {}
    candidates: set[int] = set()
    for _ in range(1500):
        for _ in range(made.choice((0, 1, 1, 1, 3, 20))):
            number = made.randrange(60)
            if made.random() < 0.6:
                candidates ^= {number}
            elif seekers.pop(number, None) is None:
                seekers[number] = ("all",) if number % 3 == 0 else (number % POOLS, (number + 1) % POOLS)
        last = search(last, seekers, _pools(candidates), _rate)
        assert last.best == _compared(seekers, candidates)


def test_only_what_came_is_compared() -> None:
    compared: list[tuple[Hashable, Hashable]] = []

    def rate(seeker: Hashable, candidate: Hashable) -> Hit | None:
        compared.append((seeker, candidate))
        return _rate(seeker, candidate)

    seekers: dict[Hashable, tuple[Hashable, ...]] = dict.fromkeys(range(100), ("all",))
    candidates = set(range(100))
    last = search(None, seekers, _pools(candidates), rate)
    assert len(compared) == 100 * 100

    compared.clear()
    last = search(last, seekers, _pools(candidates), rate)
    assert not compared

    last = search(last, seekers, _pools(candidates | {100}), rate)
    assert len(compared) == 100

    compared.clear()
    last = search(last, seekers | {100: ("all",)}, _pools(candidates | {100}), rate)
    assert len(compared) == 101
