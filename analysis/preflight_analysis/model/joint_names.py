"""What the files around a launch call joints, for where the robot description is not known."""

from __future__ import annotations

from preflight_analysis.model.context import Context
from preflight_analysis.model.entry import JOINT, Entry
from preflight_analysis.model.name_index import around
from preflight_analysis.model.nearest import likeness

_ENOUGH = 2
"""Files that have to agree on a name."""


def meant_around(context: Context, joint: str, beside: frozenset[str]) -> tuple[str, int] | None:
    """The name of which that of a joint is a slip, by the files of the packages around, and how many of them have it;
    None where another file has the joint's own, too. `beside` are the joints of the same controller."""
    if not JOINT.fullmatch(joint):
        return None
    known = around(context, "joint", "all")
    if known.get(Entry("joint", joint), 0) > 1:
        return None
    found = [
        (each.text, count)
        for each, count in known.items()
        if count >= _ENOUGH and each.text not in beside and likeness(f"/{joint}", f"/{each.text}") == ("typo", 1)
    ]
    return found[0] if len(found) == 1 else None
