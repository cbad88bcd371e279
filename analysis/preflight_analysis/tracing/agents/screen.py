"""An X server of the sandbox's own, without a screen: for nodes with windows, which end where there is none."""

from __future__ import annotations

import os
import select
from typing import Callable, Optional

_PATIENCE = 3.0
"""Seconds that it may take to start."""


def start(program: str, limit: Callable[[], None]) -> tuple[int, Optional[str]]:
    """Start `program` (Xvfb), after `limit()` in the new process. Its process id, and its DISPLAY once it is ready."""
    read, write = os.pipe()
    pid = os.fork()
    if pid == 0:
        try:
            os.setsid()
            null = os.open(os.devnull, os.O_RDWR)
            for standard in (0, 1, 2):
                os.dup2(null, standard)
            os.set_inheritable(write, True)
            limit()
            argv = [program, "-displayfd", str(write), "-nolisten", "tcp", "-noreset", "-screen", "0", "1024x768x24"]
            os.execv(program, argv)  # noqa: S606
        finally:
            os._exit(127)
    os.close(write)
    output = b""
    while not output.endswith(b"\n") and select.select([read], [], [], _PATIENCE)[0]:
        data = os.read(read, 64)
        if not data:
            break
        output += data
    os.close(read)
    number = output.decode(errors="replace").strip()
    return pid, f":{number}" if number.isdigit() else None
