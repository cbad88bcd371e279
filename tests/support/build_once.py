"""Builds what is expensive and the same for all tests of a run, once: whichever process asks first."""

from __future__ import annotations

import fcntl
import os
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path

VARIABLE = "ROS_PREFLIGHT_TEST_RUN"
"""Names the folder of this run. The processes of pytest-xdist inherit it."""


def begin_run() -> Path:
    """Make the folder of a run and name it to all processes of it."""
    folder = Path(tempfile.mkdtemp(prefix="preflight-tests-"))
    os.environ[VARIABLE] = str(folder)
    return folder


def build_once(name: str, make: Callable[[Path], object]) -> Path:
    """The folder of that name, in which `make` was called by one of all processes."""
    folder = Path(os.environ.get(VARIABLE) or begin_run(), name)
    ready = folder.with_name(f"{name}.ready")
    with folder.with_name(f"{name}.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not ready.exists():
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
            make(folder)
            ready.touch()
    return folder
