"""What the files around a launch file call what this one calls otherwise."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from collections.abc import Set as AbstractSet

from preflight_analysis.evaluation import names
from preflight_analysis.model.context import Context
from preflight_analysis.model.entry import JOINT
from preflight_analysis.model.name_index import around, in_package
from preflight_analysis.model.nearest import likeness

_ENOUGH = 2
"""Files that have to agree on a name."""


def joint_around(context: Context, joint: str, beside: AbstractSet[str]) -> tuple[str, int] | None:
    """The joint that was meant, and how many files name it. `beside` are the joints of the same controller."""
    if not JOINT.fullmatch(joint):
        return None
    return _meant(joint, {each.text: count for each, count in around(context, "joint", "all").items()}, beside)


def container_of_package(context: Context, name: str) -> str | None:
    """The container or nodelet manager that was meant, by its last name."""
    known = Counter[str]()
    for each, count in in_package(context, "container").items():
        known[names.leaf(each.text)] += count
    meant = _meant(names.leaf(name), known)
    return meant[0] if meant is not None else None


def section_around(context: Context, name: str) -> tuple[str, int] | None:
    """The key at the top of a parameter file that was meant, and how many files have it."""
    return _meant(name, {each.text: count for each, count in around(context, "section", "yaml").items()})


def _meant(name: str, known: Mapping[str, int], beside: AbstractSet[str] = frozenset()) -> tuple[str, int] | None:
    """The only name that several files have and that `name` is a slip of; None where another file has `name`, too."""
    if known.get(name, 0) > 1:
        return None
    found = [
        (other, count)
        for other, count in known.items()
        if count >= _ENOUGH and other not in beside and likeness(f"/{name}", f"/{other}") == ("typo", 1)
    ]
    return found[0] if len(found) == 1 else None
