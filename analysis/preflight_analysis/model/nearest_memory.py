"""The best candidates for each of many seekers, found again in little time after a few of either have changed.

Comparing all with all takes longer than a keystroke may where there are hundreds. So the best few candidates of each
seeker are remembered; the next time only candidates that came are looked at, by those who share a pool with them. What
comes out is the same as without the memory.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Iterable, Mapping
from functools import cached_property, partial
from typing import Any

from preflight_analysis.dataclass import dataclass

_KEPT = 8
"""How many candidates of a seeker are remembered: so many may go before it is compared with all again."""

Pools = tuple[Hashable, ...]
"""Names of groups: seekers are compared with those candidates that are in one of theirs."""


@dataclass(frozen=True, slots=True)
class Hit:
    """A candidate that will do. No two candidates of a seeker have the same rank; the lowest is the best."""

    rank: tuple[Any, ...]
    candidate: Any


@dataclass(frozen=True, slots=True)
class Best:
    """The best hits of one seeker, the best first, and whether there may be more."""

    hits: tuple[Hit, ...]
    more: bool


@dataclass(frozen=True, slots=True, eq=False)
class Search:
    """What a search found for each seeker, and among which candidates."""

    best: Mapping[Hashable, Best]
    candidates: Mapping[Hashable, Pools]


NOTHING = Search({}, {})


def search(
    before: Search,
    seekers: Mapping[Hashable, Pools],
    candidates: Mapping[Hashable, Pools],
    rate: Callable[[Any, Any], Hit | None],
) -> Search:
    """Search for the best hits of `seekers` among `candidates`, both with their pools. What is found is the same
    whatever search was made `before`.

    `rate(seeker, candidate)` may depend on nothing but the two, and each of them is always in the same pools.
    """
    came = _Pooled({each: pools for each, pools in candidates.items() if each not in before.candidates})
    went = _Pooled({each: before.candidates[each] for each in before.candidates.keys() - candidates.keys()})
    everybody = _Pooled(candidates)
    best: dict[Hashable, Best] = {}
    for seeker, pools in seekers.items():
        known = before.best.get(seeker)
        if known is not None and ((new := came.of(pools)) | (old := went.of(pools))):
            known = _renewed(known, new, old, partial(rate, seeker))
        best[seeker] = known or _cut(map(partial(rate, seeker), everybody.of(pools)), more=False)
    return Search(best, candidates)


class _Pooled:
    """Candidates by their pools."""

    def __init__(self, candidates: Mapping[Hashable, Pools]) -> None:
        self._candidates = candidates
        self._found: dict[Pools, frozenset[Hashable]] = {}

    def of(self, pools: Pools) -> frozenset[Hashable]:
        """Those that are in any of these."""
        if not self._candidates:
            return _NOBODY
        if pools not in self._found:
            self._found[pools] = _NOBODY.union(*(self._by_pool.get(pool, ()) for pool in pools))
        return self._found[pools]

    @cached_property
    def _by_pool(self) -> Mapping[Hashable, Collection[Hashable]]:
        by_pool: dict[Hashable, list[Hashable]] = {}
        for candidate, pools in self._candidates.items():
            for pool in pools:
                by_pool.setdefault(pool, []).append(candidate)
        return by_pool


_NOBODY: frozenset[Hashable] = frozenset()


def _renewed(
    earlier: Best,
    came: Collection[Hashable],
    went: Collection[Hashable],
    rate: Callable[[Hashable], Hit | None],
) -> Best | None:
    """The best hits where these candidates came and went; None where they have to be looked for among all."""
    hits = [hit for hit in earlier.hits if hit.candidate not in went]
    if earlier.more and not hits:
        return None
    # Those that are not kept are all worse than the worst that is: what is worse than that is none of the best either.
    worst = hits[-1].rank if earlier.more else None
    found = [hit for hit in map(rate, came) if hit is not None]
    better = [hit for hit in found if worst is None or hit.rank < worst]
    if not better and len(hits) == len(earlier.hits) and (earlier.more or not found):
        return earlier
    return _cut([*hits, *better], more=earlier.more or len(better) < len(found))


def _cut(hits: Iterable[Hit | None], *, more: bool) -> Best:
    found = sorted((hit for hit in hits if hit is not None), key=lambda hit: hit.rank)
    return Best(tuple(found[:_KEPT]), more or len(found) > _KEPT)
