"""A lock over all processes of the user: one waits for what another server or command is just finding out."""

from __future__ import annotations

import contextlib
import fcntl
import os
import threading
import time
from collections.abc import Iterator
from pathlib import Path

from preflight_analysis.tracing.cache_folder import make_private

_POLL = 0.05


@contextlib.contextmanager
def file_lock(path: Path, cancel: threading.Event, seconds: float) -> Iterator[None]:
    """Keep the others that name this file out of their blocks.

    It is only meant to save work: after `seconds`, once `cancel` is set, and where files cannot be locked, nobody is
    kept out. A process that dies in its block leaves the file behind, but not locked.
    """
    deadline = time.monotonic() + seconds
    held: int | None = None
    with contextlib.suppress(OSError):
        make_private(path.parent)
        while held is None:
            try:
                held = _locked(path)
            except BlockingIOError:
                if cancel.wait(_POLL) or time.monotonic() > deadline:
                    break
    try:
        yield
    finally:
        if held is not None:
            with contextlib.suppress(OSError):
                path.unlink()
            os.close(held)


def _locked(path: Path) -> int | None:
    """The file, locked; None if it was removed before it was. Raises `BlockingIOError` if another one has it."""
    descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC | os.O_NOFOLLOW, 0o600)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        if os.path.samestat(os.fstat(descriptor), os.stat(path)):
            return descriptor
    except FileNotFoundError:
        pass
    except OSError:
        os.close(descriptor)
        raise
    os.close(descriptor)
    return None
