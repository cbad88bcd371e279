"""What is missing on this machine: no fault of a launch file, however often it shows in one."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location

LackKind = Literal["package", "build", "submodule", "module", "program", "variable", "file"]
"""`package`: neither installed nor in the workspace; `build`: in the workspace and not built; `submodule`: of git, not
checked out; `module`: of Python; `variable`: of the environment; `file`: outside of the workspace and all packages."""

LACK_KINDS: tuple[LackKind, ...] = ("package", "build", "submodule", "module", "program", "variable", "file")
"""In the order in which they are shown: what a package brings along comes after it."""
_WORDS: Mapping[LackKind, tuple[str, str]] = {
    "package": ("package", "packages"),
    "build": ("package that is not built", "packages that are not built"),
    "submodule": ("git submodule that is not checked out", "git submodules that are not checked out"),
    "module": ("Python module", "Python modules"),
    "program": ("program", "programs"),
    "variable": ("environment variable", "environment variables"),
    "file": ("file of the system", "files of the system"),
}
"""One of them and several, in words."""

INSTALL = "apt install"
"""What installs packages of the system, any number of them."""
_PLAIN = re.compile(r"[\w./-]+( --?[a-z-]+| \w[\w./-]*| /[\w./-]*)*", re.ASCII)
"""A command of words in which a shell sees nothing else."""


@dataclass(frozen=True, slots=True)
class Lack:
    """Something that this machine does not have. A finding that can stand for nothing else carries one, and is a hint
    whatever its rule says (`Rule.finding`)."""

    kind: LackKind
    name: str
    remedy: str | None = None
    """The command that provides it, where one is known: plain words only, as it may end in a shell, and names come from
    files that are not ours."""

    def __post_init__(self) -> None:
        if self.remedy is not None and not _PLAIN.fullmatch(self.remedy):
            object.__setattr__(self, "remedy", None)


@dataclass(frozen=True, slots=True)
class Missing:
    """A lack with the places that show it, in order: `count` of them."""

    lack: Lack
    places: tuple[Location, ...]

    @property
    def count(self) -> int:
        """How many places show it."""
        return len(self.places)


def missing(lacks: Iterable[tuple[Lack, Location]]) -> tuple[Missing, ...]:
    """Each lack once, by kind, those that show in most places first."""
    places: dict[Lack, dict[Location, None]] = {}
    for lack, place in lacks:
        places.setdefault(lack, {})[place] = None
    found = [Missing(lack, tuple(at)) for lack, at in places.items()]
    return tuple(sorted(found, key=lambda each: (LACK_KINDS.index(each.lack.kind), -each.count, each.lack.name)))


def commands(found: Iterable[Missing]) -> tuple[str, ...]:
    """What to enter so that it is there, as far as that is known: each command once, with all that it is for."""
    words: dict[str, dict[str, None]] = {}
    for each in found:
        if each.lack.remedy:
            remedy = each.lack.remedy
            command = INSTALL if remedy.startswith(f"{INSTALL} ") else remedy.rpartition(" ")[0]
            words.setdefault(command, {}).update(dict.fromkeys(remedy.removeprefix(f"{command} ").split(" ")))
    return tuple(" ".join((command, *sorted(what))) for command, what in words.items())


def in_words(found: Sequence[Missing], most: int = 20) -> Iterator[str]:
    """A line for each kind: `3 packages: amcl (12), map_server (2), gmapping`; at most so many names."""
    for kind in LACK_KINDS:
        here = [each for each in found if each.lack.kind == kind]
        if here:
            names = [f"{each.lack.name} ({each.count})" if each.count > 1 else each.lack.name for each in here]
            more = f" and {len(names) - most} more" if len(names) > most else ""
            yield f"{len(here)} {_WORDS[kind][len(here) != 1]}: {', '.join(names[:most])}{more}"
