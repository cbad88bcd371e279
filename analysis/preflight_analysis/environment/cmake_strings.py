"""What `string`, `list(GET)` and `get_filename_component` make of texts, as files of builds take pairs such as
`src/node.cpp:node` apart.

https://cmake.org/cmake/help/latest/command/string.html. A regular expression comes from a file that nobody vouches for:
it is followed only where it cannot take long, and all else gives nothing.
"""

from __future__ import annotations

import os
import re
from collections.abc import Sequence

_LONGEST_TEXT = 200
_LONGEST_PATTERN = 100
_MOST_REPEATS = 3
"""So many parts of a pattern that may match any number of characters take at most the cube of the text's length."""
_REPEATED = re.compile(r"[*+?]")
_NOT_FOLLOWED = re.compile(r"\)[*+?]|\(\?|[*+?]{2}|[{}|]|\\[A-Za-z0-9]|\[[^\]]*\[")
"""Repeated groups, choices, and what Python reads otherwise than CMake."""
_GROUP = re.compile(r"\\(\d)")
_GROUPS = 10


def texts_made(name: str, words: Sequence[str]) -> dict[str, str] | None:
    """The variables that a command sets; None for one that is not known here. A text that is not known is empty."""
    match name, words:
        case "string", ["REPLACE", old, new, out, *texts] if old:
            return {out: "".join(texts).replace(old, new)}
        case "string", ["REGEX", "MATCH", pattern, out, *texts]:
            return _matched(pattern, out, "".join(texts))
        case "string", ["REGEX", "REPLACE", pattern, new, out, *texts]:
            return {out: _replaced(pattern, new, "".join(texts))}
        case "string", ["TOLOWER", text, out]:
            return {out: text.lower()}
        case "string", ["TOUPPER", text, out]:
            return {out: text.upper()}
        case "get_filename_component", [out, path, kind, *_]:
            return {out: _part_of_path(path, kind)}
        case _:
            return None


def items_of(words: Sequence[str], values: str) -> dict[str, str]:
    """What `list(GET variable index... out)` sets, of the value of the variable."""
    items, (*indices, out) = values.split(";"), words
    chosen = [int(index) for index in indices if re.fullmatch(r"-?\d{1,4}", index)]
    return {out: ";".join(items[at] for at in chosen if -len(items) <= at < len(items))}


def _compiled(pattern: str, text: str) -> re.Pattern[str] | None:
    is_short = len(pattern) <= _LONGEST_PATTERN and len(text) <= _LONGEST_TEXT
    if not is_short or _NOT_FOLLOWED.search(pattern) or len(_REPEATED.findall(pattern)) > _MOST_REPEATS:
        return None
    try:
        return re.compile(pattern)
    except re.error:
        return None


def _matched(pattern: str, out: str, text: str) -> dict[str, str]:
    compiled = _compiled(pattern, text)
    found = compiled.search(text) if compiled is not None else None
    groups = {f"CMAKE_MATCH_{at}": "" for at in range(_GROUPS)}
    if found is not None:
        groups |= {f"CMAKE_MATCH_{at}": each or "" for at, each in enumerate((found[0], *found.groups()))}
    return {**groups, out: found[0] if found is not None else ""}


def _replaced(pattern: str, new: str, text: str) -> str:
    compiled = _compiled(pattern, text)
    if compiled is None:
        return ""

    def made(found: re.Match[str]) -> str:
        return _GROUP.sub(lambda at: (found[int(at[1])] or "") if int(at[1]) <= len(found.groups()) else "", new)

    return compiled.sub(made, text)


def _part_of_path(path: str, kind: str) -> str:
    folder, name = os.path.split(path)
    match kind:
        case "NAME":
            return name
        case "NAME_WE":
            return name.partition(".")[0]
        case "NAME_WLE":
            return os.path.splitext(name)[0]
        case "DIRECTORY" | "PATH":
            return folder
        case _:
            return ""
