"""Programs that come along with the analysis, for where those of ROS are not installed."""

from __future__ import annotations

import re

OWN_PROGRAMS = frozenset({"xacro"})
"""By the names that launch files call them."""


def own_program(text: str, find: str, package: str) -> str | None:
    """A command line that begins with `$(find package)/program`, of a package that is not here, as it calls our own
    program, which has the name of its package. None for anything else: `xacro.py` of before Noetic reads files that the
    xacro of today refuses."""
    if package not in OWN_PROGRAMS:
        return None
    program = re.compile(rf"\s*{re.escape(find)}/{package}(?=[\s'\"]|$)")
    found, count = program.subn(package, text, count=1) if program.match(text) else (text, 0)
    return found if count else None
