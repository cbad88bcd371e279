"""The command of a parameter instead of a node: run to its end, with what it prints handed to the host.

As roslaunch does it (`subprocess.Popen(...).communicate()`): it is over when it has ended and nobody holds its standard
output any more. What it prints comes in pieces, in order, as `{"ev": "output", "at": ..., "data": base64}`.
"""

from __future__ import annotations

import base64
import os
import select
import time
from typing import Optional

from .process import exit_code, host_is_gone, queued_seconds
from .run import TICK, Run, drain, start

PIECE = 36_000
"""Bytes; in base64 well below the host's limit for a line."""


def watch(run: Run, events: int) -> None:
    """Run the job's command and tell how it ended: `ended`, `exec-failed`, `timed-out`, `too-long`, `crowded`, `heavy`,
    `full`, `watching` or `abandoned`."""
    read, write = os.pipe()
    wake, failure = start(run, write)
    os.close(write)
    limits = run.job["output"]
    started = time.monotonic()
    ended: Optional[int] = None
    status, rest, piece, sent = "", b"", b"", 0
    open_ends = [read, wake]
    while not status:
        ready = select.select([events, *open_ends], [], [], TICK)[0]
        if read in ready:
            data = os.read(read, 65536)
            piece += data
            if not data:
                open_ends.remove(read)
            while len(piece) >= PIECE:
                sent = _send(run, piece[:PIECE], sent)
                piece = piece[PIECE:]
        if wake in ready:
            os.read(wake, 512)
            ended = exit_code(run.pid) if ended is None else ended
        rest = drain(run, events, rest)
        if ended is not None and read not in open_ends:
            status = "ended"
        elif sent + len(piece) > limits["bytes"]:
            status = "too-long"
        elif time.monotonic() - started > limits["wall"] + min(limits["stretch"], queued_seconds(run.pid)):
            status = "timed-out"
        else:
            status = run.process_limits.exceeded() or ("abandoned" if host_is_gone() else "")
    drain(run, events, rest)
    _send(run, piece, sent)
    why = os.read(failure, 1000).decode(errors="replace") if status == "ended" and ended == 127 else ""
    if why:
        status = "exec-failed"
    run.emit({"own": {"ev": "end", "status": status, "code": ended, "why": why, "dropped": run.dropped}})


def _send(run: Run, piece: bytes, sent: int) -> int:
    run.emit({"own": {"ev": "output", "at": sent, "data": base64.b64encode(piece).decode()}})
    return sent + len(piece)
