"""The parameters that the sources of a workspace ask for by name, whatever is known of the nodes.

Only texts are read: who asks, and when, is not followed. So a name counts as unknown where no text in quotes has it.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.environment.model import Environment
from preflight_analysis.environment.package_files import files_in
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.model.nearest import is_reworded, likeness, numbers_in

_PROGRAMS = (".py", ".cpp", ".cc", ".cxx", ".hpp", ".h")
_OTHERS = (".cfg", ".l", ".rs", ".js", ".yaml")
"""Files that may name parameters, too. Of YAML these are the declarations of generate_parameter_library."""
_SCRIPTS = ("bin", "nodes", "scripts", "src")
"""Folders in which files without a suffix are programs."""
_MOST = 600
"""Source files of one package that are read; of more nothing is said."""
_MOST_PACKAGES = 60
_SHORTEST = 4
"""Letters of a name that can be a slip of another one."""
_ENOUGH = 2
"""Words that two names have in common where one of them has one more."""

_WRITTEN = re.compile(r"""["']([~/\w.]*\w)["']""")
_ASKED = re.compile(
    r"\b(?:param(?:::\w+)?|getParam\w*|get_param\w*|searchParam|(?:declare|get)_(?:or_\w+_)?parameter\w*"
    r"|(?:declare|get)Parameter\w*)\s*(?:<[^();]*>\s*)?\(\s*(?:[\w.:>()-]+\s*,\s*)?(?:[\w.:>()-]+\s*\+\s*)?"
    r"""["']([~/\w.]*\w)["']"""
)
_CPP_COMMENT = re.compile(r"^[ \t]*//[^\n]*|/\*.*?\*/", re.MULTILINE | re.DOTALL)
_PYTHON_COMMENT = re.compile(r"^[ \t]*#[^\n]*", re.MULTILINE)
_MACRO = re.compile(r"\b[A-Z][A-Z0-9_]{2,}\(([^()\"]*)\)")
"""What a macro is given may become a text."""
_KEY = re.compile(r"^\s*([A-Za-z]\w*)\s*:", re.MULTILINE)
_ANY = "*"
_COMPUTED = "*"
"""A part of a name that a program computes."""
_TERM = (
    r"""(?:(?:std::string|str)\(\s*"[^"\n]*"\s*\)|[bfru]{0,2}"[^"\n]*"|[bfru]{0,2}'[^'\n]*'"""
    r"""|[\w.:>\[\]-]+(?:\([^()"']*\))?)"""
)
_SUM = re.compile(rf"(?<![\w.:>\]\"'-]){_TERM}(?:\s*\+=?\s*{_TERM})+")
"""`"corrections." + role + ".position"`, `name += "_width"`."""
_TERMS = re.compile(_TERM)
_FORMAT = re.compile(r"\{[^{}\n]*\}|%[sd]")
"""What stands for a part in `f"initial_positions.{joint}"`, `"{}.rate"`, `"%s.rate"`."""
_TEXT = re.compile(r"""["']([^"'\n]*)["']""")
_MADE = re.compile(r"[\w./~*]+")
_ASKS = re.compile(r"param", re.IGNORECASE)
_PART = re.compile(r"[/.]")
_WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+")


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
    above, leaf = _parts(name)
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
    parts = (re.escape(part) for part in made.replace("/", ".").strip("~.").split(_COMPUTED))
    return re.fullmatch(r"(?:.*\.)?" + r"[\w.]+".join(parts), name) is not None


@query
def is_asked_beside(db: Database, environment: Environment, share: str, leaf: str) -> bool:
    """Whether a source in another package of the workspace asks for a parameter of that name."""
    shares = sorted({each.share for each in environment.own_packages} - {share})
    found = (_in_folder(db, each) for each in shares[:_MOST_PACKAGES])
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
        if each.above not in (above, _ANY):
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
    return [word.lower() for word in _WORD.findall(name)]


def _are_opposite(name: str, other: str) -> bool:
    """Whether one has `min` where the other has `max`."""
    return name.lower().replace("min", "max") == other.lower().replace("min", "max")


@query
def _in_workspace(db: Database, environment: Environment) -> tuple[_Index, ...]:
    """Of each package; none where there are too many, or one is too large."""
    shares = {each.share for each in environment.own_packages}
    found = [_in_folder(db, share) for share in sorted(shares)] if len(shares) <= _MOST_PACKAGES else []
    return () if None in found else tuple(each for each in found if each is not None)


@query
def _in_folder(db: Database, folder: str) -> _Index | None:
    paths = [path for path in files_in(Disk(db), folder, deep=True) if _may_ask(path)]
    if len(paths) > _MOST:
        return None
    files = [_in_file(db, path) for path in paths]
    return _Index(
        frozenset[Asked]().union(*(each.asked for each in files)),
        frozenset[str]().union(*(each.words for each in files)),
        frozenset[str]().union(*(each.made for each in files)),
    )


def _may_ask(path: str) -> bool:
    if path.endswith((*_PROGRAMS, *_OTHERS)):
        return True
    folder, name = os.path.split(path)
    return "." not in name and os.path.basename(folder) in _SCRIPTS


@query
def _in_file(db: Database, path: str) -> _Index:
    document = Disk(db).text(path)
    text = document.text if isinstance(document, Document) else ""
    if path.endswith(".yaml"):
        keys = frozenset(_KEY.findall(text)) if "default_value" in text else frozenset[str]()
        return _Index(frozenset(), keys, frozenset())
    asked = set()
    for name in _ASKED.findall(_without_comments(text, path)):
        above, leaf = _parts(name)
        asked.add(Asked(_ANY if not above and name[0] in "./" else above, leaf, path))
    words = {part for written in _WRITTEN.findall(text) for part in _PART.split(written.strip("~/."))}
    words.update(word for given in _MACRO.findall(text) for word in re.findall(r"\w+", given))
    made = frozenset(_made(_without_comments(text, path))) if _ASKS.search(text) else frozenset[str]()
    return _Index(frozenset(asked), frozenset(words), made)


def _made(text: str) -> Iterator[str]:
    """The names that a text puts together of which enough is known to tell them from others."""
    sums = ("".join(map(_part, _TERMS.findall(found[0]))) for found in _SUM.finditer(text))
    for name in (*sums, *(_FORMAT.sub(_COMPUTED, each) for each in _TEXT.findall(text))):
        known = name.replace(_COMPUTED, "")
        if _COMPUTED in name and _MADE.fullmatch(name) and sum(map(str.isalpha, known)) >= _SHORTEST:
            yield re.sub(r"\*+", _COMPUTED, name)


def _part(term: str) -> str:
    """What a term of a sum adds to a name."""
    found = _TEXT.search(term)
    return _FORMAT.sub(_COMPUTED, found[1]) if found is not None else _COMPUTED


def _without_comments(text: str, path: str) -> str:
    """What is commented out asks for nothing."""
    return (_PYTHON_COMMENT if path.endswith(".py") else _CPP_COMMENT).sub("", text)


def _parts(name: str) -> tuple[str, str]:
    parts = _PART.split(name.strip("~/."))
    return parts[-2] if len(parts) > 1 else "", parts[-1]
