"""One run of a node or command in the sandbox, seen from outside: a process, two pipes, a clock.

What comes out of the pipes was written by code that is not ours and may be anything; here it is only bounded and cut
into JSON objects, `observation` checks what they say. The way out of a run that does not end is one signal to one
process: nothing is forked for it, so that a machine out of processes does not keep us from it.
"""

from __future__ import annotations

import contextlib
import json
import os
import selectors
import subprocess
import threading
import time
from collections.abc import Mapping
from dataclasses import field
from typing import IO, Any, NamedTuple

from preflight_analysis.dataclass import dataclass
from preflight_analysis.tracing import backend, cgroup, interior, sandbox
from preflight_analysis.tracing import recipe as recipes
from preflight_analysis.tracing.backend import AGENTS, Agents, Visible
from preflight_analysis.tracing.parameter_server import encode_params

WALL_SECONDS = 5.0
"""From exec to the end, at most, but for the time in which it waits for a processor that others have."""
STRETCH_SECONDS = 5.0
"""How much of that time there may be."""
QUIET_SECONDS = 0.3
"""A loop with sleeps counts as the event loop after so long without a new endpoint or parameter call."""
LOOPED_SECONDS = 0.1
"""The same once a whole turn of the loop has been seen."""
SETTLED_SECONDS = 0.75
"""The same for a node that is up and asleep in a way that no hook knows."""
STARVING_SECONDS = 1.0
"""How long a loop that may be waiting for messages is given to get some: see `agents/polling.py`."""
OUTER_SECONDS = 5.0
"""When the whole sandbox is killed from outside, after the end of the time it has; the supervisor inside should have
ended long before."""
COMMAND_SECONDS = 10.0
"""What the command of a parameter may take, but for the time in which it waits for a processor that others have."""
COMMAND_STRETCH_SECONDS = 30.0
"""How much of that time there may be."""
COMMAND_BYTES = 8 << 20
"""What it may print."""

MAX_LINE = 128_000
MAX_RECORDS = 25_000
MAX_BYTES = 16 << 20
STDERR_BYTES = 64_000
"""How much of the end of standard error is kept."""

RLIMITS = {
    "AS": 4 << 30,
    "CPU": 20,
    "FSIZE": 64 << 20,
    "NOFILE": 1024,
    "CORE": 0,
}
_PROCESSES_SHARED = 8192
"""Before Linux 5.14 the limit counts all of the user's processes, not only those of the sandbox."""

DISK_BYTES = 256 << 20
"""What a run may write where that goes to the disk."""
WATCHERS, WATCHES = 32, 2000
"""How many instances of inotify a run may have, and how much it may watch with them: the user has some 128 and, with
older kernels, 8,192."""

_LEASH_SECONDS = 8.0
"""How long a run that is let go may take to end."""
_POLL = 0.05
_START_SECONDS = 2.0
"""How long a cancelled run may take to start. bubblewrap killed while it sets up its name spaces leaves their first
process behind, waiting for it; so the kill waits for the supervisor's first word, some 20 ms."""


@dataclass(slots=True)
class RawRun:
    """What came out: JSON objects in order, the end of standard error, and how it ended if not by itself."""

    records: list[dict[str, Any]] = field(default_factory=list)
    stderr: bytes = b""
    dropped: int = 0
    cancelled: bool = False
    killed: bool = False
    """The outer clock ran out."""
    out_of_memory: bool = False
    """The kernel ended a process for the memory that the run had in all."""
    started: float = 0.0
    """Seconds since the epoch."""
    moved: Mapping[str, str] = field(default_factory=dict)
    """Which of the folders inside this run had elsewhere: see `backend.Isolated`."""


class Inside(NamedTuple):
    """What a run has around it: what of the host is `visible`, the Python 3.8 or later that the supervisor runs in, and
    our code for it. `cancel` ends it."""

    visible: Visible
    interpreter: str
    cancel: threading.Event
    agents: Agents = AGENTS


def execute(recipe: recipes.Recipe, params: Mapping[str, Any], inside: Inside, screen: str | None = None) -> RawRun:
    """Run a node; `screen` is an X server for its windows. Raises `OSError` if the sandbox cannot be started."""
    job = {
        "screen": screen,
        "params": encode_params(params),
        "limits": {
            "wall": WALL_SECONDS,
            "stretch": STRETCH_SECONDS,
            "quiet": QUIET_SECONDS,
            "looped": LOOPED_SECONDS,
            "settled": SETTLED_SECONDS,
            "starving": STARVING_SECONDS,
        },
    }
    return _execute(recipe, job, WALL_SECONDS + STRETCH_SECONDS, inside)


def execute_command(recipe: recipes.Recipe, inside: Inside) -> RawRun:
    """Run a command to its end; what it prints is among the records. Otherwise as `execute`."""
    job = {"output": {"wall": COMMAND_SECONDS, "stretch": COMMAND_STRETCH_SECONDS, "bytes": COMMAND_BYTES}}
    seconds = COMMAND_SECONDS + COMMAND_STRETCH_SECONDS
    return _execute(recipe, job, seconds, inside)


def compile_agents(interpreter: str, visible: Visible, agents: Agents) -> RawRun:
    """Have our own code compiled: one record a module. Raises `OSError` as `execute`."""
    return _execute(None, {}, COMMAND_SECONDS, Inside(visible, interpreter, threading.Event(), agents))


def _execute(recipe: recipes.Recipe | None, job: Mapping[str, Any], seconds: float, inside: Inside) -> RawRun:
    visible, interpreter, cancel, agents = inside
    start = (
        f"import sys; sys.path.insert(0, {interior.LIBRARY!r}); from preflight_agents.supervisor import main; main()"
    )
    argv = [interpreter, "-I", "-S", "-c", start]
    with sandbox.prepared(argv, visible, agents) as prepared, os.fdopen(os.memfd_create("job"), "w+b") as handed:
        what = _process(recipe, prepared) if recipe is not None else {"compile": True}
        handed.write(json.dumps({**_sandbox(prepared), **what, **job}).encode())
        handed.seek(0)
        raw = RawRun(started=time.time(), moved=prepared.isolated.moved)
        process = subprocess.Popen(
            prepared.command,
            stdin=handed,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            env={},
            cwd="/",
            start_new_session=True,
            pass_fds=prepared.isolated.descriptors,
        )
        try:
            _read(process, raw, cancel, time.monotonic() + seconds + OUTER_SECONDS)
        finally:
            raw.stderr = moved_back(raw.stderr, raw.moved)
            _end(process, prepared.isolated.leash)
            process.wait()
            raw.out_of_memory = cgroup.ran_out(prepared.groups)
            for pipe in (process.stdout, process.stderr):
                if pipe is not None:
                    pipe.close()
    return raw


def _sandbox(start: sandbox.Start) -> dict[str, Any]:
    """What the supervisor has to know of where it is."""
    isolated = start.isolated
    return {
        "root": backend.place(interior.PRIVATE, isolated.moved),
        "temporary": backend.place("/tmp", isolated.moved),  # noqa: S108
        "most_processes": sandbox.PROCESSES if start.counting else None,
        "most_memory": sandbox.most_memory(),
        "most_disk": DISK_BYTES,
        "most_watchers": WATCHERS,
        "most_watches": WATCHES,
        "written": isolated.written,
        "alone": isolated.alone,
        "filter": isolated.filter.hex(),
    }


def _process(recipe: recipes.Recipe, start: sandbox.Start) -> dict[str, Any]:
    """How the supervisor starts it, with what is ours inside where this run has it."""

    def place(path: str) -> str:
        return backend.place(path, start.isolated.moved)

    env = dict(recipe.env)
    for name in recipes.OURS:
        if name in env:
            env[name] = place(env[name])
    entries = env["PYTHONPATH"].split(os.pathsep)
    env["PYTHONPATH"] = os.pathsep.join(place(entry) if entry == interior.SITE else entry for entry in entries)
    log = "__log:=" + recipes.LOG_FOLDER

    def moved(word: str) -> str:
        if word in recipe.files:
            return place(word)
        return log[:7] + place(word[7:]) if word.startswith(log) else word

    own_count = start.isolated.own_users and _own_process_count()
    return {
        "argv": [moved(word) for word in recipe.argv],
        "env": env,
        "cwd": place(recipe.cwd) if recipe.cwd == recipes.ROS_HOME else recipe.cwd,
        "folders": [place(folder) for folder in (recipes.ROS_HOME, recipes.LOG_FOLDER, interior.home())],
        "files": {place(path): text for path, text in recipe.files.items()},
        "rlimits": RLIMITS | {"NPROC": sandbox.PROCESSES if own_count else _PROCESSES_SHARED},
    }


def _end(process: subprocess.Popen[bytes], leash: IO[bytes] | None) -> None:
    if leash is not None:
        leash.close()
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(_LEASH_SECONDS)
    process.kill()


def _own_process_count() -> bool:
    release = os.uname().release.split(".")
    try:
        return (int(release[0]), int(release[1].split("-")[0])) >= (5, 14)
    except (IndexError, ValueError):
        return False


def _read(process: subprocess.Popen[bytes], raw: RawRun, cancel: threading.Event, deadline: float) -> None:
    assert process.stdout is not None
    assert process.stderr is not None
    rest, total = b"", 0
    with selectors.DefaultSelector() as selector:
        for pipe in (process.stdout, process.stderr):
            os.set_blocking(pipe.fileno(), False)
            selector.register(pipe, selectors.EVENT_READ)
        while selector.get_map():
            if cancel.is_set() and not raw.cancelled:
                raw.cancelled = True
                deadline = time.monotonic() + _START_SECONDS
            if raw.cancelled and raw.records:
                return
            if time.monotonic() > deadline:
                raw.killed = not raw.cancelled
                return
            for key, _ in selector.select(_POLL):
                data = os.read(key.fd, 65536)
                if not data:
                    selector.unregister(key.fileobj)
                elif key.fileobj is process.stderr:
                    raw.stderr = (raw.stderr + data)[-STDERR_BYTES:]
                else:
                    total += len(data)
                    if total > MAX_BYTES:
                        raw.dropped += 1
                        continue
                    *lines, rest = (rest + data).split(b"\n")
                    for line in lines:
                        _take(moved_back(line, raw.moved), raw)
                    # Too long already: its end is let go by, and the line counted once when it comes.
                    rest = rest[: MAX_LINE + 1]


def moved_back(said: bytes, moved: Mapping[str, str]) -> bytes:
    """With the names of what is ours inside that all runs have: what it was called in this one means nothing later."""
    for inside, elsewhere in moved.items():
        said = said.replace(elsewhere.encode(), inside.encode())
    return said


def _take(line: bytes, raw: RawRun) -> None:
    if len(line) > MAX_LINE or len(raw.records) >= MAX_RECORDS:
        raw.dropped += 1
        return
    try:
        record = json.loads(line)
    except (ValueError, RecursionError):
        record = None
    if isinstance(record, dict):
        raw.records.append(record)
    else:
        raw.dropped += 1
