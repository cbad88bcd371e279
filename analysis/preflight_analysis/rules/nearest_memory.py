"""The best candidate for each of many seekers, found again in little time after a few of either have changed.

Comparing all with all takes longer than a keystroke may where there are hundreds. So it is remembered what each seeker
was compared with, and its best few candidates; the next time only candidates that came are looked at. What comes out
is the same as without the memory.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

_KEPT = 8
"""How many candidates of a seeker are remembered: so many may go before it is compared with all again."""

Pool = frozenset[Hashable]
"""Candidates that several seekers have in common."""
_EMPTY: Pool = frozenset()


@dataclass(frozen=True, slots=True)
class Hit:
    """A candidate that will do. No two candidates of a seeker have the same rank; the lowest is the best."""

    rank: tuple[Any, ...]
    candidate: Hashable


@dataclass(frozen=True, slots=True)
class _Kept:
    """The best hits of one seeker, and whether there were more, in these pools."""

    pools: tuple[Pool, ...]
    hits: tuple[Hit, ...]
    more: bool


@dataclass(frozen=True, slots=True, eq=False)
class Search:
    """What a search found, and what is needed to search again after a few of all have changed."""

    pools: Mapping[Hashable, Pool]
    kept: Mapping[Hashable, _Kept]

    @property
    def best(self) -> dict[Hashable, Hit]:
        """The best hits of the seekers that have any."""
        return {seeker: found.hits[0] for seeker, found in self.kept.items() if found.hits}


_NOTHING = Search({}, {})


def search(
    before: Search | None,
    seekers: Mapping[Hashable, Sequence[Hashable]],
    pools: Mapping[Hashable, Collection[Hashable]],
    rate: Callable[[Hashable, Hashable], Hit | None],
) -> Search:
    """Search for the best hits of `seekers`, which are those with the names of their pools. What is found is the same
    whatever search was made `before`.

    `rate(seeker, candidate)` may depend on nothing but the two, and a candidate is always in the same pools.
    """
    known = before or _NOTHING
    now = {name: _shared(frozenset(pool), known.pools.get(name)) for name, pool in pools.items()}
    changes: dict[tuple[int, int], tuple[Pool, Pool]] = {}
    kept: dict[Hashable, _Kept] = {}
    for seeker, names in seekers.items():
        mine = tuple(now.get(name, _EMPTY) for name in names)
        kept[seeker] = _renewed(known.kept.get(seeker), mine, changes, partial(rate, seeker))
    return Search(now, kept)


def _shared(pool: Pool, earlier: Pool | None) -> Pool:
    """The earlier pool if it is equal, so that all who have it see at once that nothing changed."""
    return earlier if earlier is not None and earlier == pool else pool


def _renewed(
    earlier: _Kept | None,
    pools: tuple[Pool, ...],
    changes: dict[tuple[int, int], tuple[Pool, Pool]],
    rate: Callable[[Hashable], Hit | None],
) -> _Kept:
    if earlier is None or len(earlier.pools) != len(pools):
        return _fresh(pools, rate)
    came: set[Hashable] = set()
    went: set[Hashable] = set()
    for old, new in zip(earlier.pools, pools, strict=True):
        if old is not new:
            pair = (id(old), id(new))
            if pair not in changes:
                changes[pair] = (new - old, old - new)
            came |= changes[pair][0]
            went |= changes[pair][1]
    if not came and not went:
        return earlier if earlier.pools == pools else _Kept(pools, earlier.hits, earlier.more)
    hits = [hit for hit in earlier.hits if hit.candidate not in went]
    if earlier.more and not hits:
        return _fresh(pools, rate)
    # Those that are not kept are all worse than the worst that is: what is worse than that is none of the best either.
    worst = hits[-1].rank if earlier.more else None
    found = [hit for hit in map(rate, came) if hit is not None]
    better = [hit for hit in found if worst is None or hit.rank < worst]
    return _cut(pools, [*hits, *better], more=earlier.more or len(better) < len(found))


def _fresh(pools: tuple[Pool, ...], rate: Callable[[Hashable], Hit | None]) -> _Kept:
    hits = [hit for hit in map(rate, _EMPTY.union(*pools)) if hit is not None]
    return _cut(pools, hits, more=False)


def _cut(pools: tuple[Pool, ...], hits: list[Hit], *, more: bool) -> _Kept:
    hits.sort(key=lambda hit: hit.rank)
    return _Kept(pools, tuple(hits[:_KEPT]), more or len(hits) > _KEPT)
