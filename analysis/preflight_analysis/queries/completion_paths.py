"""What is in a folder that a value names."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator

from preflight_analysis.environment.walk import is_folder
from preflight_analysis.model.context import Context
from preflight_analysis.model.installation import installation, installed_below
from preflight_analysis.queries.completion_items import Item

_STARTS_IN_PACKAGE = re.compile(r"\$\(find(-pkg-share)? +([^\s()]+) *\)(.*)\Z", re.DOTALL)


def listed(context: Context, written: str, folder: str, suffixes: tuple[str, ...]) -> Iterator[Item]:
    """The folders and the files with one of the suffixes (with none of them: all files) in `folder`.

    `written` is the folder as the value has it: `$(find pkg)/...` is also looked for in the spaces that catkin made,
    where generated files are, as roslaunch does. In `$(find-pkg-share pkg)/...` is what the build installs there, and
    of a file that it does not install it is said.
    """
    found: dict[str, Item] = {}
    in_package = _STARTS_IN_PACKAGE.match(written)
    package = context.environment.packages.get(in_package[2]) if in_package and in_package[1] else None
    name_of = f"{in_package[2]}{in_package[3]}" if in_package else ""
    others = [f"{space}/share/{name_of}" for space in context.environment.devel_spaces if in_package]
    entries = [entry for place in (folder, *others) for entry in _entries(place)]
    if in_package is not None and package is not None:
        entries += installed_below(context, package, in_package[3].strip("/"))
    for name, is_a_folder in entries:
        if is_a_folder:
            found.setdefault(name, Item("folder", f"{name}/", f"{name}/"))
        elif (not suffixes or name.endswith(suffixes)) and name not in found:
            known = installation(context, os.path.join(folder, name)) if package is not None else None
            found[name] = Item("file", name, name, detail="not installed" if known and known.problem else "")
    yield from sorted(found.values(), key=lambda item: (item.kind == "folder", item.label))


def _entries(folder: str) -> Iterator[tuple[str, bool]]:
    """The names in a folder that are not hidden, and whether each is a folder; none where it cannot be read."""
    try:
        with os.scandir(folder) as entries:
            yield from ((e.name, is_folder(e)) for e in entries if not e.name.startswith("."))
    except (OSError, ValueError):
        return
