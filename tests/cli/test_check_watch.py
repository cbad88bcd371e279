"""`check --watch`: once more at each change, until it is interrupted."""

from __future__ import annotations

import signal
import subprocess
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from preflight_server.cli.again import seen
from support.editor_harness import Harness
from support.waiting import until

pytestmark = pytest.mark.ros


class Watching:
    """The running command, with what it has said so far."""

    def __init__(self, process: subprocess.Popen[bytes], out: Path, err: Path) -> None:
        self.process, self._out, self._err = process, out, err

    @property
    def out(self) -> str:
        return self._out.read_text()

    @property
    def err(self) -> str:
        return self._err.read_text()

    def rounds(self, number: int) -> None:
        until(lambda: self.err.count("waiting for changes") >= number, why=self.err)

    def interrupt(self) -> int:
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(30)


@contextmanager
def watching(harness: Harness, folder: Path, *arguments: str) -> Iterator[Watching]:
    out, err = folder / "out.log", folder / "err.log"
    with out.open("wb") as to, err.open("wb") as errors:
        process = subprocess.Popen(
            [harness.server, "check", "--watch", "--no-run", *arguments],
            cwd=harness.workspace,
            env=harness.environment,
            stdin=subprocess.DEVNULL,
            stdout=to,
            stderr=errors,
        )
        try:
            yield Watching(process, out, err)
        finally:
            process.kill()
            process.wait()


def test_a_change_is_checked(harness: Harness, tmp_path: Path) -> None:
    with watching(harness, tmp_path, "launch/talker_listener.launch", "--fail-on", "hint") as command:
        command.rounds(1)
        assert "'/chater'" in command.out
        text = harness.launch_file.read_text()
        harness.launch_file.write_text(text.replace("chater", "chatter2"))
        command.rounds(2)
        assert "changed: launch/talker_listener.launch" in command.err
        assert "'/chatter2'" in command.out
        assert command.interrupt() == 1, "the last round's"


def test_a_new_file_is_checked_and_one_that_goes_is_no_end(harness: Harness, tmp_path: Path) -> None:
    with watching(harness, tmp_path) as command:
        command.rounds(1)
        new = harness.workspace / "launch" / "new.launch"
        new.write_text("<launch><nonsense/></launch>")
        command.rounds(2)
        assert "new.launch:1:10" in command.out
        for each in new.parent.iterdir():
            each.unlink()
        command.rounds(3)
        assert "there are no launch files" in command.err
        assert command.interrupt() == 0, "its package is checked"


def test_what_is_looked_at(tmp_path: Path) -> None:
    for name in ("a.launch", "src/b.yaml", "build/c.yaml", ".git/d.yaml", "out.log", "script"):
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.touch()
    outside = tmp_path / "build" / "c.yaml"
    names = {str(Path(path).relative_to(tmp_path)) for path in seen([str(tmp_path)], [])}
    assert names == {"a.launch", "src/b.yaml", "script"}
    assert str(outside) in seen([str(tmp_path)], [str(outside), "/nothing/here"])


def test_it_writes_no_baseline(harness: Harness, preflight: Callable[..., Any]) -> None:
    done = preflight("check", "--watch", "--write-baseline", "x.json")
    assert (done.code, (harness.workspace / "x.json").exists()) == (2, False)
