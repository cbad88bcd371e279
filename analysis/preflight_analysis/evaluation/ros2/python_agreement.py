"""Whether the reading of a Python launch file and its run say the same, and what a run does not tell."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any

from preflight_analysis.evaluation.ros2.unknown_text import is_unknown

_TEMPORARY = re.compile(r"/tmp/[\w-]+")  # noqa: S108 - those of others, in a text
_ORDER = "the order of "
"""What reasons begin with where a run may have the same in another order."""
_NUMBERS = frozenset(("i", "id", "handler", "starts", "node"))
"""Attributes by which an action names another one, or itself, by its number: a run that reads more makes more."""
_FORMS = frozenset(("form", "type"))
"""How a value is to be read."""


def with_places(run: Any, read: Any) -> Any:
    """What a run tells, with the places where texts are written that a reading says are the same."""
    if isinstance(run, str) and isinstance(read, dict) and read.get("x") == run:
        return read
    if isinstance(run, list) and isinstance(read, list) and len(run) == len(read):
        return [with_places(one, other) for one, other in zip(run, read, strict=True)]
    if isinstance(run, dict) and isinstance(read, dict):
        if "v" in run and run.get("v") == read.get("v") and "p" in read:
            return read
        return {name: with_places(each, read.get(name)) for name, each in run.items()}
    return run


def differences(read: dict[str, Any], run: dict[str, Any]) -> Iterator[str]:
    """Where a reading has something known that a run has otherwise."""
    whole = not read["unread"]
    if not whole and (read["guessed"] or any(str(reason).startswith(_ORDER) for _, reason, _ in read["unread"])):
        return  # another branch than that of the run, or another order
    if ("error" in read) != ("error" in run):
        if whole:
            yield f"error: read {read.get('error')} run {run.get('error')}"
        return
    if "error" in run:
        for name in ("type", "message"):
            if whole and read["error"].get(name) != run["error"].get(name):
                yield f"error: read {read['error']} run {run['error']}"
        if whole and _frames(read) != _frames(run):
            yield f"frames: read {read['error']['frames']} run {run['error']['frames']}"
        return
    for name in ("actions", "text", "set", "unset", "env"):
        yield from _differ(name, read.get(name), run.get(name), whole)
    for name in ("guessed", "missed") if whole else ():
        one, other = ([[*each[:-1], each[-1] and each[-1][0]] for each in of[name]] for of in (read, run))
        if sorted(map(repr, one)) != sorted(map(repr, other)):
            yield f"{name}: read {read[name]} run {run[name]}"
    if whole:
        yield from _differ("files", sorted(read["files"].values()), sorted(run["files"].values()), whole)


def _frames(answer: dict[str, Any]) -> list[Any]:
    """Those of the program."""
    return [
        frame[:2]
        for frame in answer["error"]["frames"]
        if not frame[0].startswith("/usr/lib/python") and "/preflight_agents/" not in frame[0]
    ]


def _differ(name: str, read: Any, run: Any, whole: bool) -> Iterator[str]:
    if isinstance(read, dict) and "x" in read and isinstance(run, str):
        read = read["x"]  # of a run nobody knows where it is written
    if isinstance(read, str) and isinstance(run, str):
        read, run = (_TEMPORARY.sub("made", each) for each in (read, run))
    if read == run or (not whole and _is_any(read)):
        return
    if isinstance(read, dict) and isinstance(run, dict):
        names = {*read, *run}
        for key in sorted(names):
            if not whole and (key in _NUMBERS or (key in _FORMS and _is_open(read.get("value")))):
                continue
            if key == "p" and read.get(key) and run.get(key) and read[key][0] != run[key][0]:
                yield f"{name}.p: read {read[key]} run {run[key]}"
            elif key != "p":
                yield from _differ(f"{name}.{key}", read.get(key), run.get(key), whole)
    elif not whole and isinstance(read, list) and any(map(_is_any, read)):
        return
    elif isinstance(read, list) and isinstance(run, list) and len(read) == len(run):
        for index, (one, other) in enumerate(zip(read, run, strict=True)):
            yield from _differ(f"{name}[{index}]", one, other, whole)
    elif whole or not _is_open(read):
        yield f"{name}: read {json.dumps(read)[:150]} run {json.dumps(run)[:150]}"


def _is_any(value: Any) -> bool:
    """Whether it stands for what is not known."""
    if isinstance(value, dict):
        return value.get("s") == "unknown" or value.get("k") == "stand_in" or is_unknown(value.get("x"))
    return is_unknown(value)


def _is_open(value: Any) -> bool:
    """Whether some of it is not known."""
    if isinstance(value, dict):
        return _is_any(value) or any(map(_is_open, value.values()))
    return any(map(_is_open, value)) if isinstance(value, list) else is_unknown(value)
