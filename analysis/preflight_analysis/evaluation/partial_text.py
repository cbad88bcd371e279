"""Robot descriptions that are known in part: xacro left out what it includes of packages that are not installed here.

`tracing/agents/partial_xacro.py` makes them, with a comment at the top that names the packages.
"""

from __future__ import annotations

import re

from preflight_analysis.evaluation.tree import CommandValue

_REACH = 4000
"""Characters at the start of a text among which the comment is: xacro's own, which names a file, is before it."""
_COMMENT = re.compile(r"<!-- incomplete for ros-preflight without (.*?) -->")


def named(lacks: tuple[str, ...]) -> str:
    """What is missing, for the user."""
    what = f"package '{lacks[0]}' is" if len(lacks) == 1 else f"packages {', '.join(lacks)} are"
    return f"{what} not installed here"


def lacks_of(text: str) -> tuple[str, ...]:
    """What a text lacks; nothing for one that is whole."""
    found = _COMMENT.search(text, 0, _REACH) if text[:_REACH].lstrip()[:1] == "<" else None
    return tuple(found[1].split(", ")) if found is not None else ()


def is_whole(value: object) -> bool:
    """Whether the value of a parameter is known, and that not in part."""
    return not isinstance(value, CommandValue) and not (isinstance(value, str) and lacks_of(value))
