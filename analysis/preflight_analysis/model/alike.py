"""Those of many names that are like one, without comparing each with each: what is alike has a key in common."""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Iterator
from functools import lru_cache
from typing import Generic, TypeVar

from preflight_analysis.evaluation import names
from preflight_analysis.model.nearest import numbers_in, plain_words, segments, share_enough, squeezed, words_in

T = TypeVar("T")
_NAMES = 8192
_ENDS = ((5, 9, 2), (9, 13, 4), (13, 21, 6), (21, 999, 10))
"""From how many letters to how many, how many at the beginning or at the end are those of a name with one slip. Two
names that are a letter apart in length have one of the rows in common."""


class Names(Generic[T]):
    """Names with what each stands for, by what others may be like them."""

    def __init__(self, items: Iterable[tuple[str, T]]) -> None:
        self._by_key: dict[Hashable, list[tuple[str, T]]] = {}
        self._by_word: dict[Hashable, list[int]] = {}
        self._items = [*items]
        self._sizes = [len(plain_words(name)) for name, _ in self._items]
        for at, (name, _) in enumerate(self._items):
            for key in (*typo_keys(name), *_leaf_keys(name), ("n", name), *_level_keys(name)):
                self._by_key.setdefault(key, []).append(self._items[at])
            numbers = numbers_in(name)
            for word in plain_words(name):
                for key in ((word, numbers), word):
                    self._by_word.setdefault(key, []).append(at)

    def typos(self, name: str) -> dict[str, T]:
        """Those that may be a typo away, by their names."""
        return dict(self._having(typo_keys(name)))

    def alike(self, name: str) -> dict[str, T]:
        """Those that may be like it by any evidence of `nearest.likeness`, or have one namespace more or less."""
        numbers = numbers_in(name)
        leaf = names.leaf(name)
        own = (("l", leaf, numbers), ("l", leaf, ())) if numbers else (("l", leaf),)
        levels = (("v", name), *(("n", short) for _, short in _level_keys(name)))
        found = dict(self._having((*typo_keys(name), *own, *levels)))
        found.update(self._items[at] for at in self._of_words(name, numbers))
        return found

    def named(self, name: str) -> Iterator[T]:
        """Those of that very name."""
        return (item for _, item in self._by_key.get(("n", name), ()))

    def _having(self, keys: Iterable[Hashable]) -> Iterator[tuple[str, T]]:
        for key in keys:
            yield from self._by_key.get(key, ())

    def _of_words(self, name: str, numbers: tuple[str, ...]) -> Iterator[int]:
        words, common = plain_words(name), Counter[int]()
        for word in words:
            keys: tuple[Hashable, ...] = ((word, numbers), (word, ())) if numbers else (word,)
            for key in keys:
                common.update(self._by_word.get(key, ()))
        mine, sizes = len(words), self._sizes
        return (at for at, count in common.items() if share_enough(count, mine, sizes[at]))


@lru_cache(maxsize=_NAMES)
def typo_keys(name: str) -> tuple[Hashable, ...]:
    """Names of which one is a typo of the other, as `nearest.likeness` has it, have one of these in common: but for
    dashes all letters, all words but one, or all segments but one and the beginning or the end of that."""
    words, parts = words_in(name), segments(name)
    found: list[Hashable] = [("=", squeezed(name))]
    found += [("w", at, words[:at], words[at + 1 :]) for at in range(len(words))]
    for at, part in enumerate(parts):
        plain, rest = squeezed(part), (at, *parts[:at], "", *parts[at + 1 :])
        for least, most, ends in _ENDS:
            if least <= len(plain) <= most:
                found += [("p", plain[:ends], rest), ("s", plain[-ends:], rest)]
    return tuple(found)


@lru_cache(maxsize=_NAMES)
def _leaf_keys(name: str) -> tuple[Hashable, ...]:
    leaf = names.leaf(name)
    return ("l", leaf), ("l", leaf, numbers_in(name))


@lru_cache(maxsize=_NAMES)
def _level_keys(name: str) -> tuple[tuple[str, str], ...]:
    """The name without one of its namespaces."""
    parts = name.split("/")
    return tuple(("v", "/".join((*parts[:at], *parts[at + 1 :]))) for at in range(1, len(parts)))
