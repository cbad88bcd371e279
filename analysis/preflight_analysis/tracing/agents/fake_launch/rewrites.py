"""What `RewrittenYaml` and `ReplaceString` of `nav2_common` are to replace, and what of it their source file lacks."""

from __future__ import annotations

import importlib
import os
from typing import Any, Iterator, Optional

from ..anything import is_unknown
from .base import LaunchContext, perform_substitutions

_WANTED = {"RewrittenYaml": "param_rewrites", "ReplaceString": "replacements"}
_MARK = "ros__parameters"
_MOST = 20_000


_SOURCE = "# preflight: rewritten from "
"""Before the path of the file that one was made from, in its first line: the host shows what is in it there."""


def tell_source(thing: Any, context: LaunchContext, path: str) -> None:
    """Note in the file of parameters that such a thing has written what it was made from."""
    try:
        inner = _inner(thing)
        while type(inner).__name__ in _WANTED:
            thing, inner = inner, _inner(inner)
        source = _source(thing, context)
        if source is None or source == path or not os.path.isfile(path):
            return
        with open(source, encoding="utf-8") as file:
            first = file.readline().rstrip("\n")
        with open(path, encoding="utf-8") as file:
            text = file.read()
        made = first.startswith(_SOURCE)
        if (made or source.endswith((".yaml", ".yml"))) and not text.startswith(_SOURCE):
            with open(path, "w", encoding="utf-8") as file:
                file.write((first if made else _SOURCE + os.path.abspath(source)) + "\n" + text)
    except Exception:
        return


def _source(thing: Any, context: LaunchContext) -> Optional[str]:
    """The path of the file that is rewritten."""
    if type(thing).__name__ not in _WANTED:
        return None
    source = _attributes(thing).get("source_file")
    path = perform_substitutions(context, source) if source is not None else None
    return None if path is None or is_unknown(path) or not os.path.isfile(path) else path


def _inner(thing: Any) -> Any:
    """What gives the path of the file, if that is one thing alone."""
    source = _attributes(thing).get("source_file")
    return source[0] if isinstance(source, list) and len(source) == 1 else source


def _attributes(thing: Any) -> dict[str, Any]:
    return {name.rpartition("__")[2].lstrip("_"): value for name, value in vars(thing).items()}


def unmatched(thing: Any, context: LaunchContext) -> list[list[str]]:
    """What each is to replace that is not in the file, with the file: `["RewrittenYaml", "use_sim_time", "/a.yaml"]`.

    The real classes, where they are installed, have what they were given in attributes of these names, too. What else
    has that name is the user's own, and may have anything there.
    """
    try:
        return list(_unmatched(thing, context))
    except Exception:
        return []


def _unmatched(thing: Any, context: LaunchContext) -> Iterator[list[str]]:
    wanted = _WANTED.get(type(thing).__name__)
    if wanted is None:
        return
    given = _attributes(thing)
    replaced, condition = given.get(wanted), given.get("condition")
    if not isinstance(replaced, dict) or (condition is not None and not condition.evaluate(context)):
        return
    path = _source(thing, context)
    if path is None:
        return
    with open(path, encoding="utf-8") as file:
        text = file.read()
    keys = _keys(importlib.import_module("yaml").safe_load(text)) if wanted == "param_rewrites" else None
    for name in replaced:
        if not isinstance(name, str) or is_unknown(name):
            continue
        # A path with the mark in it is added where it is not there.
        if name not in text if keys is None else name not in keys and _MARK not in name.split("."):
            yield [type(thing).__name__, name, path]


def _keys(data: Any) -> set[str]:
    """The keys of a file, alone and with those above them."""
    found: set[str] = set()
    below = [("", data)]
    while below and len(found) < _MOST:
        above, value = below.pop()
        for key, inner in value.items() if isinstance(value, dict) else ():
            path = f"{above}.{key}" if above else str(key)
            found.update((str(key), path))
            below.append((path, inner))
    return found
