"""Files that several launch files name for the same argument or parameter, and of which most are not there: a node
writes them, as a planner does its plans."""

from __future__ import annotations

import os

from preflight_analysis.documents.span import Location
from preflight_analysis.launch.model import action_at
from preflight_analysis.model.context import Context
from preflight_analysis.model.name_index import around

_ENOUGH = 2
"""Other files that are not there: one may be the same mistake."""


def others_in_vain(context: Context, location: Location, path: str) -> int:
    """How many other files, each of another package, the launch files around name for the same argument or parameter
    that are not there either, while their folders are; 0 where that is no pattern."""
    launch_file = context.launch_files.get(location.file)
    action = action_at(launch_file, location.span.start) if launch_file is not None else None
    named = action.value("name") if action is not None else None
    if named is None or not context.disk.exists(os.path.dirname(path)):
        return 0
    missing, there = set[str](), set[str]()
    for each in around(context, "given"):
        package = context.environment.packages.get(each.type)
        if each.of != named.text or package is None:
            continue
        other = os.path.normpath(os.path.join(package.share, each.text))
        if other == path or os.path.dirname(other) == os.path.dirname(path):
            continue
        if context.disk.exists(other):
            there.add(other)
        elif context.disk.exists(os.path.dirname(other)):
            missing.add(package.share)
    return len(missing) if len(missing) >= max(_ENOUGH, 2 * len(there)) else 0
