"""What the other launch files of a package call the containers and nodelet managers that they start or load into."""

from __future__ import annotations

from collections import Counter

from preflight_analysis.evaluation import names
from preflight_analysis.model.context import Context
from preflight_analysis.model.name_index import in_package
from preflight_analysis.model.nearest import is_slip

_ENOUGH = 2
"""Files that have to agree on a name."""


def called_elsewhere(context: Context, name: str) -> str | None:
    """The name by which other launch files of the package call what this one calls `name`, as a slip of it; None where
    another file calls it so, too."""
    known: Counter[str] = Counter()
    for each, count in in_package(context, "container").items():
        known[names.leaf(each.text)] += count
    leaf = names.leaf(name)
    if known[leaf] > 1:
        return None
    near = [
        (-count, other) for other, count in known.items() if count >= _ENOUGH and is_slip(leaf, other) and other != leaf
    ]
    return min(near)[1] if near else None
