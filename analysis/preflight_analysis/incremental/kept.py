"""Results for the items of a whole that are taken over from the last time: where one of 500 nodes changed, only what is
said of that one is made again."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable
from typing import Any, Concatenate, ParamSpec, TypeVar

P = ParamSpec("P")
T = TypeVar("T")
V = TypeVar("V")


class Kept:
    """What functions of single items gave, for the next time the whole is made: `Kept(before)` has the results of
    `before`, and no older ones. Used by one thread at a time.

    The functions are pure: they look at their arguments and at nothing else.
    """

    __slots__ = ("_before", "_each_before", "_each_now", "_now")

    def __init__(self, before: Kept | None = None) -> None:
        self._before: dict[Hashable, tuple[tuple[Any, ...], Any]] = before._now if before is not None else {}
        self._now: dict[Hashable, tuple[tuple[Any, ...], Any]] = {}
        self._each_before: dict[Hashable, _Round] = before._each_now if before is not None else {}
        self._each_now: dict[Hashable, _Round] = {}

    def each(
        self,
        function: Callable[Concatenate[T, P], V],
        items: Iterable[T],
        /,
        *shared: P.args,
        **none: P.kwargs,
    ) -> list[V]:
        """`[function(item, *shared) for item in items]`, for many items: those that are the same objects as last time
        are not looked at, if what they share is equal."""
        before = self._each_before.get(function)
        known = before[1] if before is not None and before[0] == shared else {}
        already = self._each_now.get(function)
        now = already[1] if already is not None and already[0] == shared else {}
        results: list[V] = []
        for item in items:
            pair = known.get(id(item))  # the item is held, so nothing else can have its id
            if pair is None:
                pair = item, function(item, *shared, **none)
            now[id(item)] = pair
            results.append(pair[1])
        self._each_now[function] = shared, now
        return results

    def get(self, function: Callable[P, V], key: Hashable, /, *arguments: P.args, **none: P.kwargs) -> V:
        """`function(*arguments)`, or what it gave last time for the same arguments: the same objects, equal scalars, or
        tuples of such. `key` tells the items apart, and is the same each time for what is likely to be the same item;
        nothing else follows from it."""
        name = function, key
        known = self._now.get(name) or self._before.get(name)
        if known is not None and _same(known[0], arguments):
            self._now[name] = known
            result: V = known[1]
            return result
        result = function(*arguments, **none)
        self._now[name] = arguments, result
        return result

    def end(self) -> None:
        """The whole is made: let go of what was not used for it."""
        self._before, self._each_before = {}, {}


def _same(some: tuple[Any, ...], others: tuple[Any, ...]) -> bool:
    # Not equality: who links things by their identity has to find those of today in what was kept.
    for one, other in zip(some, others, strict=True):
        if one is not other:
            kind = type(one)
            if kind is not type(other):
                return False
            if kind is tuple:
                if len(one) != len(other) or not _same(one, other):
                    return False
            elif kind not in _SCALARS or one != other:
                return False
    return True


_SCALARS = frozenset({str, bytes, int, float, bool})
_Round = tuple[tuple[Any, ...], dict[int, tuple[Any, Any]]]
"""What was shared, and for each item by its id the item itself and what was made of it."""
