"""A home folder for an editor or the command, with the demo in it, and a record of every start of the sandbox."""

from __future__ import annotations

import os
import shlex
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
LAUNCH_FILE = "talker_listener.launch"


@dataclass(frozen=True)
class Harness:
    """What one editor works in: nothing of the user's own settings or caches reaches it."""

    home: Path
    workspace: Path
    launch_file: Path
    server: Path
    environment: dict[str, str]
    sandbox_record: Path

    def write(self, name: str, text: str) -> Path:
        """A launch file beside the demo's."""
        path = self.launch_file.with_name(name)
        path.write_text(text)
        return path

    def sandbox_starts(self) -> int:
        """How often bubblewrap was called since the harness was created."""
        return len(self.sandbox_record.read_text().splitlines())

    def processes(self) -> list[str]:
        """The command lines of what was started with this home and still runs."""
        running = []
        for process in Path("/proc").glob("[0-9]*"):
            try:
                environment = (process / "environ").read_bytes().split(b"\0")
                command = (process / "cmdline").read_text(errors="replace").replace("\0", " ").strip()
            except OSError:  # ended meanwhile, or not ours to read
                continue
            if f"HOME={self.home}".encode() in environment:
                running.append(f"{process.name} {command}")
        return running


def create_harness(folder: Path, workspace_name: str, *, server_on_path: bool) -> Harness:
    home, programs = folder / "home", folder / "bin"
    workspace = home / workspace_name
    shutil.copytree(ROOT / "fixtures/ros1/demo", workspace)
    (launch_file,) = workspace.rglob(LAUNCH_FILE)
    for name in ("tmp", ".config", ".cache", ".local/share", ".local/state"):
        (home / name).mkdir(parents=True)

    server = Path(sys.executable).with_name("ros-preflight")
    if not server.exists():
        pytest.fail(f"{server} is missing: the editors are tested with the project installed")
    programs.mkdir()
    if server_on_path:
        (programs / server.name).symlink_to(server)
    record = folder / "sandbox-starts"
    record.touch()
    create_sandbox_recorder(programs, record)

    others = [entry for entry in os.environ["PATH"].split(":") if not Path(entry, server.name).exists()]
    path = ":".join([str(programs), *others])
    # VS Code asks a login shell for the environment of its extensions, which then starts from /etc/profile.
    (home / ".profile").write_text(f"export PATH={shlex.quote(path)}\n")
    environment = {
        "PATH": path,
        "SHELL": "/bin/sh",
        "HOME": str(home),
        "TMPDIR": str(home / "tmp"),
        "XDG_CONFIG_HOME": str(home / ".config"),
        "XDG_CACHE_HOME": str(home / ".cache"),
        "XDG_DATA_HOME": str(home / ".local/share"),
        "XDG_STATE_HOME": str(home / ".local/state"),
        "LANG": "C.UTF-8",
    }
    return Harness(home, workspace, launch_file, server, environment, record)


def create_sandbox_recorder(folder: Path, record: Path) -> None:
    """Put a `bwrap` into `folder` that leaves a line in `record` and goes on as the real one."""
    real = shutil.which("bwrap")
    if real is None:
        pytest.fail("bwrap is missing: apt-get install bubblewrap")
    recorder = folder / "bwrap"
    recorder.write_text(f'#!/bin/sh\necho started >>{shlex.quote(str(record))}\nexec {shlex.quote(real)} "$@"\n')
    recorder.chmod(0o755)
