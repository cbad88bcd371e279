"""A desk for an editor: a home folder with the demo in it, and a record of every start of the sandbox."""

from __future__ import annotations

import os
import shlex
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
LAUNCH_FILE = "launch/talker_listener.launch"


@dataclass(frozen=True)
class Desk:
    """The world of one editor: nothing of the user's own settings or caches reaches it."""

    home: Path
    workspace: Path
    environment: dict[str, str]
    sandbox_record: Path

    @property
    def launch_file(self) -> Path:
        return self.workspace / LAUNCH_FILE

    def sandbox_starts(self) -> int:
        """How often bubblewrap was called since the desk was laid."""
        return len(self.sandbox_record.read_text().splitlines())


def lay_desk(folder: Path, workspace_name: str) -> Desk:
    home, programs = folder / "home", folder / "bin"
    workspace = home / workspace_name
    shutil.copytree(ROOT / "fixtures/ros1/demo", workspace)
    for name in ("tmp", ".config", ".cache", ".local/share", ".local/state"):
        (home / name).mkdir(parents=True, exist_ok=True)

    server = Path(sys.executable).with_name("ros-preflight")
    if not server.exists():
        pytest.fail(f"{server} is missing: the editors are tested with the project installed")
    real_sandbox = shutil.which("bwrap")
    if real_sandbox is None:
        pytest.fail("bwrap is missing: apt-get install bubblewrap")
    record = folder / "sandbox-starts"
    record.touch()
    programs.mkdir()
    recorder = programs / "bwrap"
    recorder.write_text(
        f'#!/bin/sh\necho started >>{shlex.quote(str(record))}\nexec {shlex.quote(real_sandbox)} "$@"\n'
    )
    recorder.chmod(0o755)

    environment = {
        "PATH": f"{programs}:{server.parent}:{os.environ['PATH']}",
        "HOME": str(home),
        "TMPDIR": str(home / "tmp"),
        "XDG_CONFIG_HOME": str(home / ".config"),
        "XDG_CACHE_HOME": str(home / ".cache"),
        "XDG_DATA_HOME": str(home / ".local/share"),
        "XDG_STATE_HOME": str(home / ".local/state"),
        "LANG": "C.UTF-8",
    }
    return Desk(home, workspace, environment, record)
