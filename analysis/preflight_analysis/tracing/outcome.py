"""How a run ended, and why, in words."""

from __future__ import annotations

import re
import signal
from collections.abc import Mapping
from typing import Any

from preflight_analysis.evaluation.ros2.unknown_text import readable
from preflight_analysis.tracing import interior, sandbox
from preflight_analysis.tracing.interface import REASON_COLUMNS, Outcome, telling_line
from preflight_analysis.tracing.recipe import missing_interpreter
from preflight_analysis.tracing.records import CONTROL, NAME, Gathered, checked_text, is_number
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.run import DISK_BYTES, RLIMITS, WALL_SECONDS, WATCHERS, WATCHES, RawRun

TAIL_LINES = 20
TAIL_COLUMNS = 500
_ESCAPES = re.compile(r"\x1b(\[[0-?]*[ -/]*[@-~]|\][^\x07\x1b]*(\x07|\x1b\\)|[@-Z\\-_])")
_OWN_PLACE = re.compile(rf" \({interior.PRIVATE}/[^\s()]*\)")
"""Behind an `ImportError`: where the module is that lacks a name."""
_OWN_FILE = re.compile(rf"{interior.PRIVATE}/(?:[\w.-]+/)*([\w.-]*\w)")
_WAITS = {
    "service": "the service {}",
    "message": "a message on {}",
    "services": "the service {}",
    "call": "the answer of the service {}",
    "calls": "the answer of the service {}",
    "action": "the action server {}",
    "result": "the result of the action {}",
    "transform": "the transform {}",
    "transforms": "the transform {}",
    "parameter": "the parameter {}",
    "poll": "messages on {}",
    "clock": "simulated time on {}",
    "load": "its constructor to return",
}
"""What a node waits for at its end, by the kind that the library told."""
_BY_ENV = re.compile(r"\S*env: ['‘](.+?)(\\r)?['’]: No such file or directory")
_WINDOWS = "; the file has the line ends of Windows"
NOT_LOADED = 127
"""What the loader ends a program with whose libraries are not found."""


def outcome_of(raw: RawRun, found: Gathered, tail: tuple[str, ...], request: TraceRequest) -> Outcome:
    """How a run ended; `tail` is the end of its standard error."""
    if raw.cancelled:
        return Outcome("not-run", reason="the run was cancelled")
    end = found.end
    if raw.out_of_memory and (end is None or end.get("status") == "ended"):
        end = {"status": "heavy"}
    if end is None:
        if raw.killed:
            return Outcome("timed-out", None, None, tail, "the sandbox did not end in time and was killed")
        if not found.endpoints and not found.seen_endpoints and not found.woven:
            said = f": {tail[-1]}" if tail else ""
            return Outcome("not-run", None, None, tail, f"the sandbox could not start the node{said}")
        return Outcome("crashed", None, None, tail, "the node ended the whole sandbox")
    spent = seconds_of(end, "seconds")
    code = end.get("code")
    match end.get("status"):
        case "spinning":
            return Outcome("spinning", seconds=spent)
        case "timed-out":
            return Outcome("timed-out", None, None, tail, _waiting(end, found, request), spent)
        case "crowded":
            reason = f"it started more than {sandbox.PROCESSES} processes and was stopped"
            return Outcome("crashed", None, None, tail, reason, spent)
        case "heavy":
            reason = f"it took more than {sandbox.most_memory() / (1 << 30):.1f} GiB of memory and was stopped"
            return Outcome("crashed", None, None, tail, reason, spent)
        case "full":
            reason = f"it wrote more than {DISK_BYTES >> 20} MiB and was stopped"
            return Outcome("crashed", None, None, tail, reason, spent)
        case "watching":
            reason = f"it watched more than {WATCHES} files and folders, or by more than {WATCHERS} inotify instances"
            return Outcome("crashed", None, None, tail, f"{reason}, and was stopped", spent)
        case "exec-failed":
            return Outcome("crashed", 127, None, tail, f"the executable cannot be started: {_why(end, request)}", spent)
        case "ended" if is_number(code) and 0 < -code < 65:
            return Outcome("crashed", None, _signal(-code), tail, _signal_reason(-code, tail), spent)
        case "ended" if is_number(code) and code == 0:
            return Outcome("exited", 0, None, tail, "the node ended by itself, with exit code 0", spent)
        case "ended" if is_number(code):
            return Outcome("crashed", code, None, tail, _crash_reason(code, tail), spent)
    return Outcome("crashed", None, None, tail, "the node garbled the report of its run", spent)


def seconds_of(end: Mapping[str, Any] | None, name: str) -> float:
    """Seconds that the end of a run has by this name; 0 for what cannot be so many."""
    value = end.get(name) if end is not None else None
    return float(value) if isinstance(value, (int, float)) and 0 <= value < 3600 else 0.0


def stderr_tail(data: bytes) -> tuple[str, ...]:
    """The last lines, without terminal escapes, other control characters and what is ours: frames in tracebacks, where
    our modules lie, the marks around what is not known."""
    lines: list[str] = []
    ours = False
    for raw_line in data.decode(errors="replace").split("\n"):
        line = CONTROL.sub("", _ESCAPES.sub("", raw_line.rpartition("\r")[2] or raw_line)).rstrip()
        if line.startswith("  File "):
            ours = f'"{interior.LIBRARY}' in line
        elif not line.startswith("    "):
            ours = False
        if line and not ours:
            lines.append(_OWN_FILE.sub(r"\1", _OWN_PLACE.sub("", readable(line)))[:TAIL_COLUMNS])
    return tuple(lines[-TAIL_LINES:])


def _why(end: Mapping[str, Any], request: TraceRequest) -> str:
    interpreter = missing_interpreter(request.executable)
    if interpreter is None:
        return CONTROL.sub("", str(end.get("why")))[:300]
    name = CONTROL.sub("", interpreter)[:300]
    said = f"there is no '{name}', which its first line names"
    return said + _WINDOWS if interpreter.endswith("\r") else said


def _waiting(end: Mapping[str, Any], found: Gathered, request: TraceRequest) -> str:
    """Why its time was up: what it waits for, and what made-up answers did not help, as far as it is known."""
    waits = end.get("waits")
    limit = f"within {WALL_SECONDS:g} s"
    text = f"it did not reach its event loop {limit}" + ("" if end.get("initialised") else ", nor register as a node")
    given = [*found.answers, *found.fed]
    if isinstance(waits, list) and waits and isinstance(waits[0], list) and len(waits[0]) == 2:
        kind, name = waits[0]
        if isinstance(kind, str) and kind in _WAITS and checked_text(name, NAME):
            text = f"it waits for {_WAITS[kind].format(name)}, and did not reach its event loop {limit}"
    elif seconds_of(end, "cpu") > WALL_SECONDS / 2:
        text = f"it is slow: it was still busy {limit.replace('within', 'after')}"
    elif request.params.get("/use_sim_time") is True and not any("simulated time" in answer for answer in given):
        text += "; it may wait for simulated time: /use_sim_time is set, and nobody tells the time here"
    return text + (f"; before that {'; '.join(given)}" if given else "")


def _signal(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


def _signal_reason(number: int, tail: tuple[str, ...]) -> str:
    if number == signal.SIGXCPU:
        return f"it used more than {RLIMITS['CPU']} s of processor time"
    return f"it was killed by {_signal(number)}" + _reported_by(tail)


def _crash_reason(code: int, tail: tuple[str, ...]) -> str:
    unknown = next(filter(None, map(_BY_ENV.match, tail)), None) if code == NOT_LOADED else None
    if unknown is not None:
        said = f"the executable cannot be started: there is no '{unknown[1]}' on the PATH, which its first line names"
        return said + (_WINDOWS if unknown[2] else "")
    return f"it ended with exit code {code}" + _reported_by(tail)


def _reported_by(tail: tuple[str, ...]) -> str:
    line = telling_line(tail)
    return f": {line[:REASON_COLUMNS]}" if line else ""
