"""Which known name a wrong one was meant to be."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from functools import lru_cache
from typing import Literal

from preflight_analysis.evaluation import names
from preflight_analysis.slips import edits

Likeness = Literal["typo", "words"]
"""`typo`: a slip of the keyboard apart, or the same but for case and underscores. `words`: made of the same words."""

_WORD = re.compile(r"[A-Za-z]+|\d+")
_CAMEL_WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")
_NUMBER = re.compile(r"\d+")
_MIN_PREFIX = 4
_SPLIT = 5
"""Letters of a segment in which a slip may split a word."""
_LONG = 8
_NAMES = 8192
_MOST_WORDS = 0.6
_SEVERAL = 2
"""Words of a name of which the order or a shortened one says something."""


def cutoff(length: int) -> int:
    """How many edits a word of `length` characters may be away and still count as a typo."""
    if length <= 2:
        return 0
    return 1 if length <= 4 else 2 if length <= 8 else 3


def nearest(name: str, candidates: Iterable[str], key: Callable[[str], str] = str) -> str | None:
    """The candidate that `name` is most likely a misspelling of, else the only one of the same words in another order
    (`resolution_fixed`, `fixed_resolution`), in the plural or shortened (`vel_limit`, `velocity_limit`), else the only
    one that is in another namespace, or has one more or less (`/map_server`, `/robot/map_server`); None if all are too
    far. Ties go by alphabet.

    Case, `-` against `_`, and what `key` removes do not count as edits.
    """
    candidates = set(candidates)
    wanted = folded(key(name))
    best: tuple[int, int, str] | None = None
    for candidate in sorted(candidates):
        if candidate == name:
            continue
        other = folded(key(candidate))
        limit = cutoff(max(len(wanted), len(other)))
        if abs(len(wanted) - len(other)) > limit:
            continue
        distance = edits(wanted, other, limit)
        if distance > limit:
            continue
        rank = (distance, edits(name, candidate), candidate)
        if best is None or rank < best:
            best = rank
    return best[2] if best else _only(name, candidates, is_reworded) or _only(name, candidates, _is_elsewhere)


def _only(name: str, candidates: Iterable[str], is_like: Callable[[str, str], bool]) -> str | None:
    found = [each for each in candidates if is_like(name, each)]
    return found[0] if len(found) == 1 else None


def _is_elsewhere(name: str, other: str) -> bool:
    """Whether two graph names have the same last part, and one namespace is another or is missing."""
    parts, others = segments(name), segments(other)
    if name == other or parts[-1] != others[-1] or len(parts) + len(others) == 2:
        return False
    short, long = sorted((parts, others), key=len)
    if len(short) == len(long):
        return sum(a != b for a, b in zip(parts, others, strict=True)) == 1
    rest = iter(long)
    return len(long) == len(short) + 1 and all(part in rest for part in short)


def is_reworded(name: str, other: str) -> bool:
    """Whether names have the same words in another order or in the plural, or, of several, some of them shortened or
    written out."""
    words, others = camel_words(name), camel_words(other)
    if words == others or len(words) != len(others):
        return False
    if sorted(map(_singular, words)) == sorted(map(_singular, others)):
        return True
    return len(words) >= _SEVERAL and _is_shortened(words, others)


def _singular(word: str) -> str:
    return f"{word[:-3]}y" if word.endswith("ies") else word.removesuffix("s")


def _is_shortened(words: tuple[str, ...], others: tuple[str, ...]) -> bool:
    """Whether each word is the beginning of the other one, none of which is a letter or a number."""
    pairs = [(a, b) for a, b in zip(words, others, strict=True) if a != b]
    return all(len(min(a, b, key=len)) > 1 and (a.startswith(b) or b.startswith(a)) for a, b in pairs) and (
        all(a.isalpha() and b.isalpha() for a, b in pairs)
    )


def nearest_class(name: str, candidates: Iterable[str]) -> str | None:
    """Likewise for the name of a C++ class, of which the namespaces may be wrong or missing."""
    return nearest(name, candidates) or nearest(name, candidates, key=lambda each: each.rpartition("::")[2])


def is_slip(name: str, other: str) -> bool:
    """Whether they are one small edit apart, two of long names, and have the same numbers: evidence enough for a change
    that is made for the user, or for calling an unknown name wrong."""
    if numbers_in(name) != numbers_in(other):
        return False
    most = 2 if min(len(name), len(other)) >= _LONG else 1
    return edits(folded(name), folded(other)) <= most


def nearest_slip(name: str, candidates: Iterable[str]) -> str | None:
    """The nearest one, if it is a slip."""
    near = nearest(name, candidates)
    return near if near is not None and is_slip(name, near) else None


def is_slip_of_words(name: str, other: str) -> bool:
    """As `is_slip`, of names that are put together from words: `hsrb_bringup` is no slip of `hero_bringup`, as its word
    is another one."""
    words, others = folded(name).split("_"), folded(other).split("_")
    if len(words) != len(others):
        return is_slip(name, other)
    return all(is_slip(word, one) for word, one in zip(words, others, strict=True))


def did_you_mean(candidate: str | None) -> str:
    """The end of a message that names the candidate; empty without one."""
    return f"; did you mean '{candidate}'?" if candidate else ""


def nearest_typo(name: str, others: Iterable[str]) -> str | None:
    """The graph name that differs by a typo, the nearest one first; ties go by alphabet."""
    found = [(alike[1], each) for each in others if (alike := likeness(name, each)) is not None and alike[0] == "typo"]
    return min(found)[1] if found else None


@lru_cache(maxsize=_NAMES)
def likeness(name: str, other: str) -> tuple[Likeness, int] | None:
    """How alike two graph names are, and their edit distance; None if they are not.

    Names whose numbers differ (`/camera1`, `/camera2`) are never alike, nor are words of fewer than three letters
    that differ (`/joint_x`, `/joint_y`): they were written so on purpose.
    """
    if name == other:
        return None
    mine, theirs = numbers_in(name), numbers_in(other)
    if mine != theirs and mine and theirs:
        return None
    if mine == theirs and _is_typo(name, other):
        return "typo", edits(name, other)
    return ("words", edits(name, other)) if _same_words(name, other) else None


def _is_typo(name: str, other: str) -> bool:
    if squeezed(name) == squeezed(other):
        return True
    parts, others = segments(name), segments(other)
    if len(parts) != len(others):
        return False
    pairs = [(a, b) for a, b in zip(parts, others, strict=True) if a != b]
    words, other_words = words_in("/".join(a for a, _ in pairs)), words_in("/".join(b for _, b in pairs))
    if len(words) != len(other_words):
        # A stray or missing letter may also split a word (`cmd_vell`, `c_md_vel`): judge the segment as a whole.
        one, other_one = map(squeezed, pairs[0])
        return len(pairs) == 1 and min(len(one), len(other_one)) >= _SPLIT and edits(one, other_one, 1) <= 1
    different = [(a, b) for a, b in zip(words, other_words, strict=True) if a != b]
    return len(different) == 1 and all(is_word_typo(a, b) for a, b in different)


@lru_cache(maxsize=_NAMES)
def is_word_typo(word: str, other: str) -> bool:
    """Whether one of two words is the other with a slip, or its beginning."""
    if min(len(word), len(other)) < 3:
        return False
    if min(len(word), len(other)) >= _MIN_PREFIX and (word.startswith(other) or other.startswith(word)):
        return True
    return edits(word, other) <= cutoff(min(len(word), len(other)))


def _same_words(name: str, other: str) -> bool:
    """Equal last segments, one name's words all among the other's, or most words in common."""
    if names.leaf(name) == names.leaf(other):
        return True
    mine, theirs = plain_words(name), plain_words(other)
    return share_enough(len(mine & theirs), len(mine), len(theirs))


def share_enough(common: int, mine: int, theirs: int) -> bool:
    """Whether names of so many words, not numbers, have so many in common that they may speak of the same: all of one
    of them, or most."""
    return common > 0 and (common in (mine, theirs) or common >= _MOST_WORDS * (mine + theirs - common))


def has_all_words(name: str, other: str) -> bool:
    """Whether one of the names has all words of the other. Numbers are none."""
    mine, theirs = plain_words(name), plain_words(other)
    return mine <= theirs or theirs <= mine


def is_word_more(name: str, other: str) -> bool:
    """Whether the names differ in one namespace alone, which has a word more in one of them, and several in both:
    `/robot_base_controller/odom`, `/robot_xl_base_controller/odom`. A word more at the end of a name (`scan_filtered`)
    is mostly another thing."""
    parts, others = segments(name), segments(other)
    pairs = [(a, b) for a, b in zip(parts, others, strict=False) if a != b]
    if len(parts) != len(others) or len(pairs) != 1 or parts[-1] != others[-1]:
        return False
    short, long = sorted((words_in(each) for each in pairs[0]), key=len)
    rest = iter(long)
    return len(short) > 1 and len(long) == len(short) + 1 and all(word in rest for word in short)


def share_words(name: str, other: str) -> bool:
    """Whether a word is in both names. Numbers are none."""
    return not plain_words(name).isdisjoint(plain_words(other))


# Each name is compared with hundreds of others.
@lru_cache(maxsize=_NAMES)
def words_in(name: str) -> tuple[str, ...]:
    """The words and numbers of a name, in lower case."""
    return tuple([w.lower() for w in _WORD.findall(name)])


@lru_cache(maxsize=_NAMES)
def segments(name: str) -> list[str]:
    """What stands between the slashes of a name."""
    return name.strip("/").split("/")


@lru_cache(maxsize=_NAMES)
def plain_words(name: str) -> frozenset[str]:
    """The words of a name without its numbers."""
    return frozenset(w for w in words_in(name) if not w.isdigit())


@lru_cache(maxsize=_NAMES)
def numbers_in(name: str) -> tuple[str, ...]:
    """The numbers in a name. Names that both have some, and not the same, are never alike."""
    return tuple(_NUMBER.findall(name))


def without_numbers(name: str) -> str:
    """The name with the same in the place of each number."""
    return _NUMBER.sub("#", name)


@lru_cache(maxsize=_NAMES)
def camel_words(name: str) -> tuple[str, ...]:
    """The words and numbers of a name, in lower case, of which each may begin with a capital: `maxVel`, `MPCRate`."""
    return tuple([word.lower() for word in _CAMEL_WORD.findall(name)])


def folded(name: str) -> str:
    """The name without case, and with `_` for `-`."""
    return name.lower().replace("-", "_")


@lru_cache(maxsize=_NAMES)
def squeezed(name: str) -> str:
    """The name without case, `_` and `-`."""
    return re.sub(r"[_-]", "", name).lower()
