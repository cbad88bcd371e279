"""The node's side of the event channel: JSON lines into the FIFO that the supervisor named in the environment."""

from __future__ import annotations

import json
import os
import threading

VARIABLE = "PREFLIGHT_EVENTS"
MAX_LINE = 32_000
"""Bytes; longer events are left out, the supervisor would drop them anyway."""

PATH = os.environ.get(VARIABLE, "")
"""The FIFO."""
_lock = threading.Lock()


def send(event: str, **fields: object) -> None:
    """Write one event. Never raises: without a listener the node goes on unwatched.

    The FIFO is opened anew each time. A descriptor kept open could be closed by the node (daemons close them all) and
    its number reused for a file of the node's.
    """
    try:
        line = json.dumps(dict(fields, ev=event), default=repr).encode() + b"\n"
        if not PATH or len(line) > MAX_LINE:
            return
        with _lock:
            descriptor = os.open(PATH, os.O_WRONLY | os.O_CLOEXEC)
            try:
                while line:
                    line = line[os.write(descriptor, line) :]
            finally:
                os.close(descriptor)
    except (OSError, ValueError, RecursionError):
        pass
