"""Commands of parameters in the sandbox: what they give, what is kept, and what they cannot do."""

from __future__ import annotations

import os
import shlex
import threading
import time
import uuid
from collections.abc import Callable
from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.evaluation.commands import CommandResult
from preflight_analysis.tracing import run, sandbox
from preflight_analysis.tracing.commands import CommandCache, CommandRunner
from tracing_desk import environment, processes_with, write_node
from xacro_desk import lay_robot

pytestmark = pytest.mark.ros


class Desk:
    """A folder to run commands in, and how often the sandbox was started for them."""

    def __init__(self, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        self.folder = folder / "pkg"
        self.folder.mkdir()
        self.cache = CommandCache(folder / "cache")
        self.runner = CommandRunner(environment(self.folder), str(self.folder), self.cache)
        self.starts = 0
        execute = run.execute_command

        def counting(*args: object) -> run.RawRun:
            self.starts += 1
            return execute(*args)  # type: ignore[arg-type]

        monkeypatch.setattr(run, "execute_command", counting)

    def run(self, line: str) -> CommandResult:
        return self.runner.run(line, threading.Event())

    def script(self, body: str) -> str:
        """A Python program; its command line."""
        return shlex.quote(str(write_node(self.folder, body)))

    def file(self, name: str, text: str) -> Path:
        """A file that was there before any run."""
        path = self.folder / name
        path.write_text(text)
        os.utime(path, (0, 0))
        return path


@pytest.fixture
def desk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Desk:
    return Desk(tmp_path, monkeypatch)


def test_what_it_prints_is_the_result(desk: Desk) -> None:
    desk.file("a.txt", "größe\n")
    assert desk.run("cat a.txt") == CommandResult("done", "größe\n")
    assert desk.run("echo 'two  words'") == CommandResult("done", "two  words\n")
    assert desk.run("bash -c 'echo $0' one").output == "one\n"
    assert desk.run("python3 -c 'import sys; sys.stderr.write(\"no\"); print(1)'") == CommandResult("done", "1\n")
    assert desk.run("true") == CommandResult("done", "")


@pytest.mark.usefixtures("each_backend")
def test_what_it_prints_is_the_same_with_each_way_to_isolate(desk: Desk) -> None:
    line = desk.script(
        "import os\nprint(os.environ['HOME'], os.environ['TMPDIR'], 'x' * 50000, os.environ['ROS_HOME'])"
    )
    assert desk.run(line) == CommandResult("done", f"{sandbox.home()} /tmp {'x' * 50000} /tmp/ros_home\n")


def test_a_failure_is_none_where_the_sandbox_refuses_more_than_it_must(desk: Desk, each_backend: str) -> None:
    result = desk.run(desk.script("open('/tmp/here', 'w')"))
    if each_backend == "landlock":
        assert result.status == "not-run"
        expected = "it ended with exit code 1 in the sandbox by landlock, which refuses more than bubblewrap would"
        assert result.reason == expected
    else:
        assert result.status == "done"


def test_all_of_a_long_output_arrives_in_order(desk: Desk) -> None:
    line = desk.script("for n in range(300000): print(n, flush=n % 1000 == 0)")
    assert desk.run(line).output == "".join(f"{n}\n" for n in range(300000))


def test_failures_are_told_with_the_last_lines(desk: Desk) -> None:
    found = desk.run("bash -c 'echo one >&2; echo two >&2; exit 3'")
    assert found == CommandResult("failed", reason="it ended with exit code 3", stderr_tail=("one", "two"))
    assert desk.run("bash -c 'kill -SEGV $$'").reason == "it was killed by SIGSEGV"
    assert desk.run(r"printf '\377'").reason == "what it printed is not UTF-8: invalid start byte"
    assert desk.run("' '").status == "missing"
    assert desk.run("").reason == "it is empty"
    assert desk.run("bash -c 'exit 127'").reason == "it ended with exit code 127"
    garbage = desk.file("garbage", "\x7fELF")
    garbage.chmod(0o755)
    assert desk.run("./garbage") == CommandResult("failed", reason="it cannot be started: Exec format error")


def test_a_missing_program_is_found_without_a_run(desk: Desk) -> None:
    for line in ("xacro robot.xacro", "./make", "/nowhere/xacro", str(desk.file("plain", ""))):
        assert desk.run(line).status == "missing", line
    assert desk.starts == 0


# What is kept


def test_the_same_again_needs_no_run(desk: Desk) -> None:
    desk.file("a.txt", "1")
    line = "cat a.txt"
    first = desk.run(line)
    assert desk.starts == 1
    other = CommandRunner(desk.runner.environment, desk.runner.cwd, CommandCache(desk.cache.folder))
    assert other.run(line, threading.Event()) == first
    assert desk.starts == 1


def test_files_that_arguments_name(desk: Desk) -> None:
    for line in ("cat a.txt", "bash -c 'cat a.txt'", "python3 -c 'import sys' --file=a.txt", "echo file:=a.txt"):
        path = desk.file("a.txt", "1")
        desk.run(line)
        assert desk.runner.lookup(line), line
        desk.file("b.txt", "unrelated")
        assert desk.runner.lookup(line), line
        path.write_text("2")
        assert desk.runner.lookup(line) is None, line


def test_files_that_a_python_program_opens_or_looks_for(desk: Desk) -> None:
    desk.file("part.py", "value = 1\n")
    data = desk.file("data.txt", "1")
    line = desk.script("""
        import part
        print(part.value, open("data.txt").read())
        try:
            print(open("more.txt").read())
        except OSError:
            pass
    """)
    os.utime(desk.folder / "node.py", (0, 0))
    assert desk.run(line).output == "1 1\n"
    assert desk.runner.lookup(line)
    data.write_text("2")
    assert desk.run(line).output == "1 2\n"
    desk.file("more.txt", "3")
    assert desk.run(line).output == "1 2\n3\n"
    desk.file("part.py", "value = 10\n")
    assert desk.run(line).output == "10 2\n3\n"


def test_the_folder_environment_and_packages_name_the_run(desk: Desk, tmp_path: Path) -> None:
    line = "echo 1"
    desk.run(line)
    assert desk.runner.lookup(line)
    assert CommandRunner(desk.runner.environment, "/", desk.cache).lookup(line) is None
    other = environment(desk.folder, variables={"ROS_MODEL": "x"})
    assert CommandRunner(other, desk.runner.cwd, desk.cache).lookup(line) is None
    lay_robot(tmp_path / "more")
    more = detect_environment(None, desk.runner.environment.variables, [str(tmp_path / "more")])
    assert CommandRunner(more, desk.runner.cwd, desk.cache).lookup(line) is None


def test_what_has_no_result_is_not_kept(desk: Desk) -> None:
    for line in ("false", "bash -c 'echo a > a.txt'"):
        desk.run(line)
        assert desk.runner.lookup(line) is None
    cancelled = threading.Event()
    cancelled.set()
    assert desk.runner.run("echo 2", cancelled) == CommandResult("not-run", reason="the run was cancelled")
    assert desk.runner.lookup("echo 2") is None


def test_a_file_saved_during_the_run_is_not_kept(desk: Desk) -> None:
    path = desk.file("a.txt", "1")
    os.utime(path, (time.time() + 60, time.time() + 60))
    assert desk.run("cat a.txt").status == "done"
    assert desk.runner.lookup("cat a.txt") is None


@pytest.mark.parametrize("damage", [b"", b"null", b"\xff" * 100])
def test_a_damaged_entry_is_a_miss(desk: Desk, damage: bytes) -> None:
    desk.run("echo 1")
    (entry,) = desk.cache.folder.glob("*/*/*.json")
    entry.write_bytes(damage)
    assert desk.runner.lookup("echo 1") is None
    assert desk.run("echo 1").output == "1\n"


# xacro


@pytest.fixture
def robot(desk: Desk) -> tuple[Path, str]:
    """The folder of the arm's description, and the command that makes it."""
    lay_robot(desk.folder)
    return desk.folder / "arm/urdf", f"{desk.folder}/xacro/xacro {desk.folder}/arm/urdf/arm.xacro side:=right"


def test_xacro_runs_and_is_kept_until_one_of_its_files_changes(desk: Desk, robot: tuple[Path, str]) -> None:
    urdf, line = robot
    first = desk.run(line)
    assert '<link length="0.25" name="right_thumb"/>' in first.output, first
    assert desk.run(line) == first
    (urdf / "unrelated.xacro").write_text("<robot/>")
    (urdf / "new.xacro").write_text("<robot/>")
    assert desk.run(line) == first
    assert desk.starts == 1
    for name in ("macros.xacro", "sizes.yaml", "arm.xacro"):
        path = urdf / name
        path.write_text(path.read_text().replace("link", "joint").replace("0.25", "0.5").replace("_thumb", "_toe"))
        os.utime(path, (1, 1))
        starts = desk.starts
        assert desk.run(line).output != first.output
        assert desk.starts == starts + 1, name
    assert '<joint length="0.5" name="right_toe"/>' in desk.run(line).output


def test_what_xacro_says_of_a_mistake_names_the_file(desk: Desk, robot: tuple[Path, str]) -> None:
    urdf, line = robot
    (urdf / "macros.xacro").write_text("<robot><link></robot>")
    found = desk.run(line)
    assert (found.status, found.reason) == ("failed", "it ended with exit code 2")
    assert "macros.xacro" in "\n".join(found.stderr_tail)


# What it cannot do


def test_nothing_is_written_to_the_disk(desk: Desk) -> None:
    name = f"preflight-{uuid.uuid4()}"
    inside = [Path.home() / name, Path("/tmp") / name]
    for path in inside:
        assert desk.run(f"bash -c 'echo x > {path}; cat {path}'").output == "x\n"
    found = desk.run(f"bash -c 'echo x > {desk.folder / name}'")
    assert found.status == "not-run"
    assert "it writes files, which the sandbox does not let it" in found.reason
    found = desk.run(desk.script(f"open({str(desk.folder / name)!r}, 'w')"))
    assert f"it writes {desk.folder / name}" in found.reason
    assert not [path for path in (*inside, desk.folder / name) if path.exists()]


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A home folder with a secret in it."""
    folder = tmp_path / "home"
    (folder / ".ssh").mkdir(parents=True)
    (folder / ".ssh/id").write_text("hunter2")
    monkeypatch.setenv("HOME", str(folder))
    sandbox.forget()
    return folder


@pytest.mark.parametrize(
    "line",
    [
        "cat {home}/.ssh/id",
        "bash -c 'cat ~/.ssh/id'",
        "bash -c 'cat {home}/.ssh/*'",
        "cat link",
        "python3 -c 'print(open(\"{home}/.ssh/id\").read())'",
        "bash -c 'cat {home}/.ssh/id; ls -a {home}; true'",
    ],
)
def test_secrets_of_the_home_folder_stay_outside(desk: Desk, home: Path, line: str) -> None:
    (desk.folder / "link").symlink_to(home / ".ssh/id")
    found = desk.run(line.format(home=home))
    assert "hunter2" not in repr(found)
    assert ".ssh" not in found.output
    assert found.status == "done" or "the sandbox hides" in found.reason or "exit code 1" in found.reason


def test_a_home_folder_is_never_bound_back_however_it_is_named(home: Path) -> None:
    assert sandbox.needs_binding([str(home), str(home.parent), f"{home}/.ssh/.."]) == []


def test_files_below_the_home_folder_that_are_named_can_be_read(desk: Desk, home: Path) -> None:
    (home / "robot.urdf").write_text("<robot/>")
    (home / "robots").mkdir()
    (home / "robots/base.urdf").write_text("<base/>")
    assert desk.run(f"cat {home}/robot.urdf") == CommandResult("done", "<robot/>")
    assert desk.run(f"cat {home}/robots/base.urdf") == CommandResult("done", "<base/>")


def test_a_program_that_needs_more_of_the_home_folder_has_not_failed(desk: Desk, home: Path) -> None:
    (home / "lib").mkdir()
    (home / "lib/real").write_text("")
    script = desk.file("tool", f"#!/bin/sh\n. {home}/lib/real\n")
    script.chmod(0o755)
    found = desk.run("./tool")
    assert found.status == "not-run"
    assert found.reason.endswith(f"in the sandbox; it needs {home}/lib/real, which the sandbox hides")


def test_there_is_no_network(desk: Desk) -> None:
    body = "import socket; socket.create_connection(('192.0.2.1', 80), 1)"
    found = desk.run(desk.script(body))
    assert found.status == "not-run"
    assert "it needs a network or a ROS master" in found.reason


def test_it_cannot_take_for_ever(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(run, "COMMAND_SECONDS", 1.0)
    marker = f"preflight-{uuid.uuid4()}"
    began = time.monotonic()
    for line in (f"bash -c 'sleep 600' {marker}", f"bash -c 'sleep 600 & exit' {marker}", "cat /dev/random"):
        found = desk.run(line)
        assert found.status == "not-run", found
        assert found.reason in ("it did not end within 1 s", "it printed more than 8 MiB")
    assert time.monotonic() - began < 60
    wait_for(lambda: processes_with(marker) == [])


@pytest.mark.parametrize("line", ["cat /dev/zero", "yes", "bash -c 'yes | head -c 10000000'"])
def test_it_cannot_print_for_ever(desk: Desk, line: str) -> None:
    assert desk.run(line) == CommandResult("not-run", reason="it printed more than 8 MiB")


def test_a_flood_on_standard_error_is_cut(desk: Desk) -> None:
    found = desk.run("bash -c 'yes no | head -c 3000000 >&2; echo 1; exit 1'")
    assert found.reason == "it ended with exit code 1"
    assert sum(map(len, found.stderr_tail)) < 20_000


def test_what_it_forks_dies_with_it(desk: Desk) -> None:
    marker = f"preflight-{uuid.uuid4()}"
    line = desk.script("""
        import os, signal, sys, time
        for _ in range(50):
            if os.fork() == 0:
                os.setsid()
                os.close(1)
                signal.signal(signal.SIGTERM, signal.SIG_IGN)
                while True:
                    time.sleep(60)
        print("done")
    """)
    assert desk.run(f"{line} {marker}").output == "done\n"
    wait_for(lambda: processes_with(marker) == [])


def test_lies_on_the_supervisors_output(desk: Desk) -> None:
    line = desk.script(r"""
        import glob
        for path in glob.glob("/proc/[0-9]*/fd/1"):
            try:
                with open(path, "wb") as out:
                    out.write(b'{"own": {"ev": "output", "data": "?"}}\n{"own": {"ev": "end", "code": "x"}}\n\xff\n')
            except OSError:
                pass
    """)
    assert desk.run(line).status in ("not-run", "done")
    assert desk.run("bash -c 'kill -9 $PPID; sleep 9'").reason.startswith("the sandbox ended before it did")


def test_cancelling_kills_it(desk: Desk) -> None:
    marker = f"preflight-{uuid.uuid4()}"
    cancel = threading.Event()
    threading.Timer(0.3, cancel.set).start()
    found = desk.runner.run(f"bash -c 'sleep 60' {marker}", cancel)
    assert found == CommandResult("not-run", reason="the run was cancelled")
    wait_for(lambda: processes_with(marker) == [])


def test_without_a_working_sandbox_nothing_runs(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    status = sandbox.SandboxStatus(False, "no permission for namespaces")
    monkeypatch.setattr(sandbox, "probe", lambda: status)
    assert desk.run("echo 1") == CommandResult("not-run", reason="no sandbox: no permission for namespaces")
    assert desk.starts == 0


def wait_for(what: Callable[[], bool]) -> None:
    deadline = time.monotonic() + 60
    while not what() and time.monotonic() < deadline:
        time.sleep(0.02)
    assert what()
