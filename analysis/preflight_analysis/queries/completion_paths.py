"""What is in a folder that a value names."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator

from preflight_analysis.environment.model import Environment
from preflight_analysis.environment.walk import is_folder
from preflight_analysis.queries.completion_items import Item

_STARTS_IN_PACKAGE = re.compile(r"\$\(find(?:-pkg-share)? +([^\s()]+) *\)(.*)\Z", re.DOTALL)


def listed(environment: Environment, written: str, folder: str, suffixes: tuple[str, ...]) -> Iterator[Item]:
    """The folders and the files with one of the suffixes (with none of them: all files) in `folder`.

    `written` is the folder as the value has it: `$(find pkg)/...` is also looked for in the spaces that catkin made,
    where generated files are, as roslaunch does.
    """
    found: dict[str, Item] = {}
    in_package = _STARTS_IN_PACKAGE.match(written)
    others = [f"{space}/share/{in_package[1]}{in_package[2]}" for space in environment.devel_spaces if in_package]
    for place in (folder, *others):
        for name, is_a_folder in _entries(place):
            if is_a_folder:
                found.setdefault(name, Item("folder", f"{name}/", f"{name}/"))
            elif not suffixes or name.endswith(suffixes):
                found.setdefault(name, Item("file", name, name))
    yield from sorted(found.values(), key=lambda item: (item.kind == "folder", item.label))


def _entries(folder: str) -> Iterator[tuple[str, bool]]:
    """The names in a folder that are not hidden, and whether each is a folder; none where it cannot be read."""
    try:
        with os.scandir(folder) as entries:
            yield from ((e.name, is_folder(e)) for e in entries if not e.name.startswith("."))
    except (OSError, ValueError):
        return
