"""What the files around a launch call joints, for where the robot description is not known."""

from __future__ import annotations

import re

from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import likeness
from preflight_analysis.model.written_elsewhere import around

_NAMES = (re.compile(r"(?<!\w)([A-Za-z]\w*_(?:joint|wheel|caster)\w*|(?:joint|wheel|caster)_\w+)(?!\w)"),)
_FILES = (".yaml", ".xacro", ".urdf", ".srdf", ".launch", ".xml", ".py", ".cpp", ".world", ".sdf")
_ENOUGH = 2
"""Files that have to agree on a name."""


def meant_around(context: Context, joint: str, beside: frozenset[str]) -> tuple[str, int] | None:
    """The name of which that of a joint is a slip, by the files of the packages around, and how many of them have it;
    None where another file has the joint's own, too. `beside` are the joints of the same controller."""
    if not any(each.fullmatch(joint) for each in _NAMES):
        return None
    known = around(context, _NAMES, _FILES)
    if known.get(joint, 0) > 1:
        return None
    found = [
        (each, count)
        for each, count in known.items()
        if count >= _ENOUGH and each not in beside and likeness(f"/{joint}", f"/{each}") == ("typo", 1)
    ]
    return found[0] if len(found) == 1 else None
