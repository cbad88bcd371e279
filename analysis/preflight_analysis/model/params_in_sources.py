"""The parameters that the sources of a workspace ask for by name, whatever is known of the nodes.

Only texts are read: who asks, and when, is not followed. So a name counts as unknown where no text in quotes has it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from preflight_analysis.environment.model import Environment
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.model.name_index import named_in, own_folders, sources_in
from preflight_analysis.model.names_of_programs import COMPUTED, parts_of, words_in
from preflight_analysis.model.nearest import camel_words, is_reworded, likeness, numbers_in

_SHORTEST = 4
"""Letters of a name that can be a slip of another one."""
_ENOUGH = 2
"""Words that two names have in common where one of them has one more."""


class Asked(NamedTuple):
    """A parameter that a source asks for: the part before its name, empty where there is none, `*` where the text goes
    on from another one (`prefix + ".name"`), its name, and the file."""

    above: str
    name: str
    path: str


class _Index(NamedTuple):
    asked: frozenset[Asked]
    words: frozenset[str]
    """All parts of names that stand in quotes."""
    made: frozenset[str]
    """Names that are put together at run time, with `*` for what is computed: `corrections.*.position`."""


@query
def meant_in_sources(db: Database, environment: Environment, share: str, name: str) -> Asked | None:
    """What the sources of a package of the workspace ask for that a parameter of one of its nodes is a slip of, if the
    parameter's own name is in no source of the workspace. `name` is the one below the node's."""
    above, leaf = parts_of(name)
    own = _in_folder(db, share)
    if own is None or not _is_telling(leaf) or leaf in own.words or may_be_made(db, share, name):
        return None
    near = _by_name(_alike(own.asked, above, leaf))
    if not near and not above:
        return None
    others = _in_workspace(db, environment)
    if not near:
        # A plugin of another package reads it.
        near = _by_name(each for index in others for each in _alike(index.asked, above, leaf) if each.above == above)
    if len(near) != 1 or not others or any(leaf in index.words for index in others):
        return None
    return next(iter(near.values()))


@query
def may_be_made(db: Database, share: str, name: str) -> bool:
    """Whether a source of a package that asks for parameters puts names together of which this may be one: their
    beginning or end is that of `name`."""
    index = _in_folder(db, share)
    return index is not None and _is_made(index, name)


def _is_made(index: _Index, name: str) -> bool:
    plain = name.replace("/", ".")
    return any(_fits(made, plain) for made in index.made)


def _fits(made: str, name: str) -> bool:
    parts = (re.escape(part) for part in made.replace("/", ".").strip("~.").split(COMPUTED))
    return re.fullmatch(r"(?:.*\.)?" + r"[\w.]+".join(parts), name) is not None


@query
def is_asked_beside(db: Database, environment: Environment, share: str, leaf: str) -> bool:
    """Whether a source in another package of the workspace asks for a parameter of that name."""
    found = (_in_folder(db, each) for each in own_folders(db, environment) if each != share)
    return any(each.name == leaf for index in found if index is not None for each in index.asked)


@query
def meant_in_one_file(
    db: Database, environment: Environment, shares: tuple[str, ...], names: tuple[str, ...]
) -> Mapping[str, Asked]:
    """Of parameters that stand together, beside the nodes, those that are a slip of one that a source in one of these
    packages asks for, which asks for most of the others, too."""
    by_file: dict[str, set[Asked]] = {}
    for share in shares:
        index = _in_folder(db, share)
        for each in index.asked if index is not None else ():
            by_file.setdefault(each.path, set()).add(each)
    found: dict[str, Asked] = {}
    for _, asked in sorted(by_file.items()):
        known = {each.name for each in asked}
        rest = [name for name in names if name not in known]
        if len(names) - len(rest) < max(3, len(names) / 2):
            continue
        for name in rest:
            near = _by_name(each for each in _alike(asked, "", name) if each.name not in names)
            if not _is_telling(name) or len(near) != 1:
                continue
            indexes = _in_workspace(db, environment)
            if indexes and not any(name in index.words or _is_made(index, name) for index in indexes):
                found.setdefault(name, next(iter(near.values())))
    return found


def _by_name(asked: Iterable[Asked]) -> dict[str, Asked]:
    """The first of each name, whatever the order."""
    return {each.name: each for each in sorted(asked, reverse=True)}


def _is_telling(leaf: str) -> bool:
    return len(leaf) >= _SHORTEST and not leaf.startswith("_")


def _alike(asked: Iterable[Asked], above: str, leaf: str) -> Iterator[Asked]:
    for each in asked:
        if each.above not in (above, COMPUTED):
            continue
        alike = likeness(leaf, each.name)
        typo = alike is not None and alike[0] == "typo" and not _are_opposite(leaf, each.name)
        if typo or _is_one_word_apart(leaf, each.name) or is_reworded(leaf, each.name):
            yield each


def _is_one_word_apart(name: str, other: str) -> bool:
    if numbers_in(name) != numbers_in(other):
        return False
    short, long = sorted((_words(name), _words(other)), key=len)
    rest = iter(long)
    return len(short) >= _ENOUGH and len(long) == len(short) + 1 and all(word in rest for word in short)


def _words(name: str) -> list[str]:
    return [word for word in camel_words(name) if not word.isdigit()]


def _are_opposite(name: str, other: str) -> bool:
    """Whether one has `min` where the other has `max`."""
    return name.lower().replace("min", "max") == other.lower().replace("min", "max")


@query
def _in_workspace(db: Database, environment: Environment) -> tuple[_Index, ...]:
    """Of each package; none where there are too many, or one is too large."""
    found = [_in_folder(db, share) for share in own_folders(db, environment)]
    return () if None in found else tuple(each for each in found if each is not None)


@query
def _in_folder(db: Database, folder: str) -> _Index | None:
    paths = sources_in(db, folder)
    if paths is None:
        return None
    asked = ((entry, path) for path in paths for entry in named_in(db, path, "parameter"))
    return _Index(
        frozenset(Asked(entry.of, entry.text, path) for entry, path in asked if entry.role == "asked"),
        frozenset(word for path in paths for entry in named_in(db, path, "name") for word in words_in(entry.text)),
        frozenset(entry.text for path in paths for entry in named_in(db, path, "made")),
    )
