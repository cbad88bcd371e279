"""Whether the reading of a Python launch file says what its run says."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.ros2.python_runs import parse_request
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.tracing.agents.anything import is_unknown
from preflight_analysis.tracing.reading.answers import answer

_TEMPORARY = re.compile(r"/tmp/(?:tmp\w+|preflight-\w+-\d+)")


def assert_readings_agree(tree: LaunchTree, environment: Environment, disk: Disk) -> None:
    """Of all runs that a tree is made of: what is known of their readings is what the runs tell."""
    for command in tree.commands:
        request = parse_request(command.line) if command.launch_file else None
        if request is None or command.result is None or command.result.status != "done":
            continue
        read, run = answer(environment, disk, request), _answer(command.result.output)
        found = list(differences(read, run)) if read is not None and run is not None else []
        assert not found, (found, request["text"], request["calls"])


def _answer(output: str) -> dict[str, Any] | None:
    try:
        found = json.loads(output)
    except ValueError:
        return None  # of a hostile file
    return found if isinstance(found, dict) and ("actions" in found or "text" in found or "error" in found) else None


def differences(read: dict[str, Any], run: dict[str, Any]) -> Iterator[str]:
    """Where a reading has something known that a run has otherwise."""
    whole = not read["unread"]
    if not whole and read["guessed"]:
        return  # another branch than that of the run
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
    if isinstance(read, str) and isinstance(run, str):
        read, run = (_TEMPORARY.sub("/tmp/made", each) for each in (read, run))
    if read == run or (not whole and _is_open(read)):
        return
    if isinstance(read, dict) and isinstance(run, dict):
        names = {*read, *run}
        for key in sorted(names):
            if not whole and key == "i":
                continue
            if key == "p" and read.get(key) and run.get(key) and read[key][0] != run[key][0]:
                yield f"{name}.p: read {read[key]} run {run[key]}"
            elif key != "p":
                yield from _differ(f"{name}.{key}", read.get(key), run.get(key), whole)
    elif isinstance(read, list) and isinstance(run, list) and len(read) == len(run):
        for index, (one, other) in enumerate(zip(read, run, strict=True)):
            yield from _differ(f"{name}[{index}]", one, other, whole)
    else:
        yield f"{name}: read {json.dumps(read)[:150]} run {json.dumps(run)[:150]}"


def _is_open(value: Any) -> bool:
    """Whether some of it is not known."""
    if isinstance(value, dict):
        return value.get("s") == "unknown" or value.get("k") == "stand_in" or any(map(_is_open, value.values()))
    return any(map(_is_open, value)) if isinstance(value, list) else is_unknown(value)
