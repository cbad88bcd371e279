"""Robot descriptions that are known in part: packages that xacro was to include of are not installed here.

`tracing/agents/partial_xacro.py` makes them, with comments at the top that name the packages.
"""

from __future__ import annotations

import re

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation.tree import CommandValue

_REACH = 4000
"""Characters at the start of a text among which the comments are: xacro's own, which names a file, is before them."""
_LACKS = re.compile(r"<!-- incomplete for ros-preflight without (.*?) -->")
_INEXACT = re.compile(r"<!-- values unknown to ros-preflight without (.*?) -->")
_CATALOGUED = re.compile(r"<!-- from the catalogue of ros-preflight for (\w+), (.*?) -->")


@dataclass(frozen=True, slots=True)
class Catalogued:
    """The packages of which the catalogue gave the structure, as their distribution `distro` has them."""

    distro: str
    packages: tuple[str, ...]

    def __str__(self) -> str:
        """As a message shows it."""
        return f"{', '.join(self.packages)} of {self.distro}"


def named(lacks: tuple[str, ...]) -> str:
    """What is missing, for the user."""
    what = f"package '{lacks[0]}' is" if len(lacks) == 1 else f"packages {', '.join(lacks)} are"
    return f"{what} not installed here"


def lacks_of(text: str) -> tuple[str, ...]:
    """The packages without which links, joints or the like are not known; none for a text of which these are."""
    return _packages(_LACKS, text)


def catalogued_of(text: str) -> Catalogued | None:
    """What the text has from the catalogue."""
    found = _CATALOGUED.search(text, 0, _REACH) if _is_xml(text) else None
    return Catalogued(found[1], tuple(found[2].split(", "))) if found is not None else None


def missing_of(text: str) -> tuple[str, ...]:
    """All packages that the text was to be made of and that are not here."""
    catalogued = catalogued_of(text)
    names = (*(catalogued.packages if catalogued else ()), *lacks_of(text), *_packages(_INEXACT, text))
    return tuple(dict.fromkeys(names))


def is_whole(value: object) -> bool:
    """Whether the value of a parameter is what the node gets: known, and not in part or in structure alone."""
    return not isinstance(value, CommandValue) and not (isinstance(value, str) and missing_of(value))


def _packages(comment: re.Pattern[str], text: str) -> tuple[str, ...]:
    found = comment.search(text, 0, _REACH) if _is_xml(text) else None
    return tuple(found[1].split(", ")) if found is not None else ()


def _is_xml(text: str) -> bool:
    return text[:_REACH].lstrip()[:1] == "<"
