"""Those of many names that are like one, without comparing each with each: what is alike has a key in common."""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Iterator, Mapping
from functools import cached_property, lru_cache
from itertools import chain
from typing import Any, Generic, TypeVar

from preflight_analysis.evaluation import names
from preflight_analysis.model.nearest import (
    is_word_typo,
    numbers_in,
    plain_words,
    segments,
    share_enough,
    squeezed,
    words_in,
)
from preflight_analysis.slips import edits

T = TypeVar("T")
_NAMES = 8192
_ENDS = ((5, 9, 2), (9, 13, 4), (13, 21, 6), (21, 999, 10))
"""From how many letters to how many, how many at the beginning or at the end are those of a name with one slip. Two
names that are a letter apart in length have one of the rows in common."""


class Names(Generic[T]):
    """Names with what each stands for, by what others may be like them."""

    def __init__(self, items: Iterable[tuple[str, T]]) -> None:
        self._by_key: dict[Hashable, list[tuple[str, T]]] = {}
        self._items = [*items]
        for item in self._items:
            name = item[0]
            for key in (*typo_keys(name), *_leaf_keys(name), ("n", name), *_level_keys(name)):
                self._by_key.setdefault(key, []).append(item)

    @cached_property
    def _sizes(self) -> list[int]:
        """Of how many words each is."""
        return [len(plain_words(name)) for name, _ in self._items]

    @cached_property
    def _by_word(self) -> Mapping[Hashable, list[int]]:
        found: dict[Hashable, list[int]] = {}
        for at, (name, _) in enumerate(self._items):
            numbers = numbers_in(name)
            for word in plain_words(name):
                for key in ((word, numbers), word):
                    found.setdefault(key, []).append(at)
        return found

    def typos(self, name: str) -> Iterator[tuple[str, T]]:
        """Those that may be a typo away, with their names; some more than once."""
        words, letters = words_in(name), squeezed(name)
        for key in typo_keys(name):
            for found in self._by_key.get(key, ()):
                if key[0] == "w":
                    is_slip = is_word_typo(words[key[1]], words_in(found[0])[key[1]])
                else:
                    is_slip = edits(letters, squeezed(found[0]), 1) <= 1
                if is_slip:
                    yield found

    def close(self, name: str) -> Iterator[T]:
        """Those that may be a typo away, or have one namespace more or less."""
        levels = (("v", name), *(("n", short) for _, short in _level_keys(name)))
        return (item for _, item in chain(self.typos(name), self._having(levels)))

    def alike(self, name: str) -> Iterator[tuple[str, T]]:
        """Those that are others and have the same last part or enough words in common, with their names, where not both
        have numbers that differ: `nearest.likeness`, but for typos. Some more than once."""
        numbers, words, common = numbers_in(name), plain_words(name), Counter[int]()
        for word in words:
            keys: tuple[Hashable, ...] = ((word, numbers), (word, ())) if numbers else (word,)
            for key in keys:
                common.update(self._by_word.get(key, ()))
        mine, sizes = len(words), self._sizes
        enough = {size: _enough(mine, size) for size in {*sizes}}
        of_words = (self._items[at] for at, count in common.items() if count >= enough[sizes[at]])
        return chain(self.ending_alike(name), (found for found in of_words if found[0] != name))

    def ending_alike(self, name: str) -> Iterator[tuple[str, T]]:
        """Those of them that have the same last part."""
        leaf, numbers = names.leaf(name), numbers_in(name)
        own = (("l", leaf, numbers), ("l", leaf, ())) if numbers else (("l", leaf),)
        return (found for found in self._having(own) if found[0] != name)

    def named(self, name: str) -> Iterator[T]:
        """Those of that very name."""
        return (item for _, item in self._by_key.get(("n", name), ()))

    def _having(self, keys: Iterable[Hashable]) -> Iterator[tuple[str, T]]:
        for key in keys:
            yield from self._by_key.get(key, ())


@lru_cache(maxsize=_NAMES)
def _enough(mine: int, theirs: int) -> int:
    """How many words names of so many words have in common at least to speak of the same."""
    return next((count for count in range(1, min(mine, theirs) + 1) if share_enough(count, mine, theirs)), mine + 1)


@lru_cache(maxsize=_NAMES)
def typo_keys(name: str) -> tuple[tuple[Any, ...], ...]:
    """Names of which one is a typo of the other, as `nearest.likeness` has it, have one of these in common: but for
    dashes all letters, all words but one, or all segments but one and the beginning or the end of that."""
    words, parts = words_in(name), segments(name)
    found: list[tuple[Any, ...]] = [("=", squeezed(name))]
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
