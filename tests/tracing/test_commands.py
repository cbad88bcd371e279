"""Commands of parameters in the sandbox: what they give, what is kept, and what they cannot do."""

from __future__ import annotations

import os
import shlex
import threading
import time
import uuid
from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.evaluation.commands import CommandResult
from preflight_analysis.tracing import interior, run, sandbox
from preflight_analysis.tracing.commands import CommandCache, CommandRunner
from support.tracing_harness import environment, processes_with, write_node
from support.waiting import until
from support.xacro_package import create_robot

pytestmark = pytest.mark.ros


class Harness:
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
def harness(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Harness:
    return Harness(tmp_path, monkeypatch)


def test_what_it_prints_is_the_result(harness: Harness) -> None:
    harness.file("a.txt", "größe\n")
    assert harness.run("cat a.txt") == CommandResult("done", "größe\n")
    assert harness.run("echo 'two  words'") == CommandResult("done", "two  words\n")
    assert harness.run("bash -c 'echo $0' one").output == "one\n"
    assert harness.run("python3 -c 'import sys; sys.stderr.write(\"no\"); print(1)'") == CommandResult("done", "1\n")
    assert harness.run("true") == CommandResult("done", "")


@pytest.mark.usefixtures("each_backend")
def test_what_it_prints_is_the_same_with_each_way_to_isolate(harness: Harness) -> None:
    line = harness.script(
        "import os\nprint(os.environ['HOME'], os.environ['TMPDIR'], 'x' * 50000, os.environ['ROS_HOME'])"
    )
    assert harness.run(line) == CommandResult("done", f"{interior.home()} /tmp {'x' * 50000} /tmp/ros_home\n")


def test_a_failure_is_none_where_the_sandbox_refuses_more_than_it_must(harness: Harness, each_backend: str) -> None:
    result = harness.run(harness.script("open('/tmp/here', 'w')"))
    if each_backend == "landlock":
        assert result.status == "not-run"
        expected = "it ended with exit code 1 in the sandbox by landlock, which refuses more than bubblewrap would"
        assert result.reason == expected
    else:
        assert result.status == "done"


def test_all_of_a_long_output_arrives_in_order(harness: Harness) -> None:
    line = harness.script("for n in range(300000): print(n, flush=n % 1000 == 0)")
    assert harness.run(line).output == "".join(f"{n}\n" for n in range(300000))


def test_failures_are_told_with_the_last_lines(harness: Harness) -> None:
    found = harness.run("bash -c 'echo one >&2; echo two >&2; exit 3'")
    assert found == CommandResult("failed", reason="it ended with exit code 3", stderr_tail=("one", "two"))
    assert harness.run("bash -c 'kill -SEGV $$'").reason == "it was killed by SIGSEGV"
    assert harness.run(r"printf '\377'").reason == "what it printed is not UTF-8: invalid start byte"
    assert harness.run("' '").status == "missing"
    assert harness.run("").reason == "it is empty"
    assert harness.run("bash -c 'exit 127'").reason == "it ended with exit code 127"
    garbage = harness.file("garbage", "\x7fELF")
    garbage.chmod(0o755)
    assert harness.run("./garbage") == CommandResult("failed", reason="it cannot be started: Exec format error")


def test_a_missing_program_is_found_without_a_run(harness: Harness) -> None:
    for line in ("xacro.py robot.xacro", "./make", "/nowhere/xacro", str(harness.file("plain", ""))):
        assert harness.run(line).status == "missing", line
    assert harness.starts == 0


# What is kept


def test_the_same_again_needs_no_run(harness: Harness) -> None:
    harness.file("a.txt", "1")
    line = "cat a.txt"
    first = harness.run(line)
    assert harness.starts == 1
    other = CommandRunner(harness.runner.environment, harness.runner.cwd, CommandCache(harness.cache.folder))
    assert other.run(line, threading.Event()) == first
    assert harness.starts == 1


def test_files_that_arguments_name(harness: Harness) -> None:
    for line in ("cat a.txt", "bash -c 'cat a.txt'", "python3 -c 'import sys' --file=a.txt", "echo file:=a.txt"):
        path = harness.file("a.txt", "1")
        harness.run(line)
        assert harness.runner.lookup(line), line
        harness.file("b.txt", "unrelated")
        assert harness.runner.lookup(line), line
        path.write_text("2")
        assert harness.runner.lookup(line) is None, line


def test_files_that_a_python_program_opens_or_looks_for(harness: Harness) -> None:
    harness.file("part.py", "value = 1\n")
    data = harness.file("data.txt", "1")
    line = harness.script("""
        import part
        print(part.value, open("data.txt").read())
        try:
            print(open("more.txt").read())
        except OSError:
            pass
    """)
    os.utime(harness.folder / "node.py", (0, 0))
    assert harness.run(line).output == "1 1\n"
    assert harness.runner.lookup(line)
    data.write_text("2")
    assert harness.run(line).output == "1 2\n"
    harness.file("more.txt", "3")
    assert harness.run(line).output == "1 2\n3\n"
    harness.file("part.py", "value = 10\n")
    assert harness.run(line).output == "10 2\n3\n"


def test_the_folder_environment_and_packages_name_the_run(harness: Harness, tmp_path: Path) -> None:
    line = "echo 1"
    harness.run(line)
    assert harness.runner.lookup(line)
    assert CommandRunner(harness.runner.environment, "/", harness.cache).lookup(line) is None
    other = environment(harness.folder, variables={"ROS_MODEL": "x"})
    assert CommandRunner(other, harness.runner.cwd, harness.cache).lookup(line) is None
    create_robot(tmp_path / "more")
    more = detect_environment(None, harness.runner.environment.variables, [str(tmp_path / "more")])
    assert CommandRunner(more, harness.runner.cwd, harness.cache).lookup(line) is None


def test_what_has_no_result_is_not_kept(harness: Harness) -> None:
    for line in ("false", "bash -c 'echo a > a.txt'"):
        harness.run(line)
        assert harness.runner.lookup(line) is None
    cancelled = threading.Event()
    cancelled.set()
    assert harness.runner.run("echo 2", cancelled) == CommandResult("not-run", reason="the run was cancelled")
    assert harness.runner.lookup("echo 2") is None


def test_a_file_saved_during_the_run_is_not_kept(harness: Harness) -> None:
    path = harness.file("a.txt", "1")
    os.utime(path, (time.time() + 60, time.time() + 60))
    assert harness.run("cat a.txt").status == "done"
    assert harness.runner.lookup("cat a.txt") is None


@pytest.mark.parametrize("damage", [b"", b"null", b"\xff" * 100])
def test_a_damaged_entry_is_a_miss(harness: Harness, damage: bytes) -> None:
    harness.run("echo 1")
    (entry,) = harness.cache.folder.glob("*/*/*.json")
    entry.write_bytes(damage)
    assert harness.runner.lookup("echo 1") is None
    assert harness.run("echo 1").output == "1\n"


# xacro


@pytest.fixture
def robot(harness: Harness) -> tuple[Path, str]:
    """The folder of the arm's description, and the command that makes it."""
    create_robot(harness.folder)
    return harness.folder / "arm/urdf", f"{harness.folder}/xacro/xacro {harness.folder}/arm/urdf/arm.xacro side:=right"


def test_xacro_runs_and_is_kept_until_one_of_its_files_changes(harness: Harness, robot: tuple[Path, str]) -> None:
    urdf, line = robot
    first = harness.run(line)
    assert '<link length="0.25" name="right_thumb"/>' in first.output, first
    assert harness.run(line) == first
    (urdf / "unrelated.xacro").write_text("<robot/>")
    (urdf / "new.xacro").write_text("<robot/>")
    assert harness.run(line) == first
    assert harness.starts == 1
    for name in ("macros.xacro", "sizes.yaml", "arm.xacro"):
        path = urdf / name
        path.write_text(path.read_text().replace("link", "joint").replace("0.25", "0.5").replace("_thumb", "_toe"))
        os.utime(path, (1, 1))
        starts = harness.starts
        assert harness.run(line).output != first.output
        assert harness.starts == starts + 1, name
    assert '<joint length="0.5" name="right_toe"/>' in harness.run(line).output


def test_what_xacro_says_of_a_mistake_names_the_file(harness: Harness, robot: tuple[Path, str]) -> None:
    urdf, line = robot
    (urdf / "macros.xacro").write_text("<robot><link></robot>")
    found = harness.run(line)
    assert (found.status, found.reason) == ("failed", "it ended with exit code 2")
    assert "macros.xacro" in "\n".join(found.stderr_tail)


# What it cannot do


def test_nothing_is_written_to_the_disk(harness: Harness) -> None:
    name = f"preflight-{uuid.uuid4()}"
    inside = [Path.home() / name, Path("/tmp") / name]
    for path in inside:
        assert harness.run(f"bash -c 'echo x > {path}; cat {path}'").output == "x\n"
    found = harness.run(f"bash -c 'echo x > {harness.folder / name}'")
    assert found.status == "not-run"
    assert "it writes files, which the sandbox does not let it" in found.reason
    found = harness.run(harness.script(f"open({str(harness.folder / name)!r}, 'w')"))
    assert f"it writes {harness.folder / name}" in found.reason
    assert not [path for path in (*inside, harness.folder / name) if path.exists()]


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
def test_secrets_of_the_home_folder_stay_outside(harness: Harness, home: Path, line: str) -> None:
    (harness.folder / "link").symlink_to(home / ".ssh/id")
    found = harness.run(line.format(home=home))
    assert "hunter2" not in repr(found)
    assert ".ssh" not in found.output
    assert found.status == "done" or "the sandbox hides" in found.reason or "exit code 1" in found.reason


def test_a_home_folder_is_never_bound_back_however_it_is_named(home: Path) -> None:
    assert interior.needs_binding([str(home), str(home.parent), f"{home}/.ssh/.."]) == []


def test_files_below_the_home_folder_that_are_named_can_be_read(harness: Harness, home: Path) -> None:
    (home / "robot.urdf").write_text("<robot/>")
    (home / "robots").mkdir()
    (home / "robots/base.urdf").write_text("<base/>")
    assert harness.run(f"cat {home}/robot.urdf") == CommandResult("done", "<robot/>")
    assert harness.run(f"cat {home}/robots/base.urdf") == CommandResult("done", "<base/>")


def test_a_program_that_needs_more_of_the_home_folder_has_not_failed(harness: Harness, home: Path) -> None:
    (home / "lib").mkdir()
    (home / "lib/real").write_text("")
    script = harness.file("tool", f"#!/bin/sh\n. {home}/lib/real\n")
    script.chmod(0o755)
    found = harness.run("./tool")
    assert found.status == "not-run"
    assert found.reason.endswith(f"in the sandbox; it needs {home}/lib/real, which the sandbox hides")


def test_there_is_no_network(harness: Harness) -> None:
    body = "import socket; socket.create_connection(('192.0.2.1', 80), 1)"
    found = harness.run(harness.script(body))
    assert found.status == "not-run"
    assert "it needs a network or a ROS master" in found.reason


def test_it_cannot_take_for_ever(harness: Harness, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(run, "COMMAND_SECONDS", 1.0)
    marker = f"preflight-{uuid.uuid4()}"
    began = time.monotonic()
    for line in (f"bash -c 'sleep 600' {marker}", f"bash -c 'sleep 600 & exit' {marker}", "cat /dev/random"):
        found = harness.run(line)
        assert found.status == "not-run", found
        assert found.reason in ("it did not end within 1 s", "it printed more than 8 MiB")
    assert time.monotonic() - began < 60
    until(lambda: processes_with(marker) == [])


@pytest.mark.parametrize("line", ["cat /dev/zero", "yes", "bash -c 'yes | head -c 10000000'"])
def test_it_cannot_print_for_ever(harness: Harness, line: str) -> None:
    assert harness.run(line) == CommandResult("not-run", reason="it printed more than 8 MiB")


def test_a_flood_on_standard_error_is_cut(harness: Harness) -> None:
    found = harness.run("bash -c 'yes no | head -c 3000000 >&2; echo 1; exit 1'")
    assert found.reason == "it ended with exit code 1"
    assert sum(map(len, found.stderr_tail)) < 20_000


def test_what_it_forks_dies_with_it(harness: Harness) -> None:
    marker = f"preflight-{uuid.uuid4()}"
    line = harness.script("""
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
    assert harness.run(f"{line} {marker}").output == "done\n"
    until(lambda: processes_with(marker) == [])


def test_lies_on_the_supervisors_output(harness: Harness) -> None:
    line = harness.script(r"""
        import glob
        for path in glob.glob("/proc/[0-9]*/fd/1"):
            try:
                with open(path, "wb") as out:
                    out.write(b'{"own": {"ev": "output", "data": "?"}}\n{"own": {"ev": "end", "code": "x"}}\n\xff\n')
            except OSError:
                pass
    """)
    assert harness.run(line).status in ("not-run", "done")
    assert harness.run("bash -c 'kill -9 $PPID; sleep 9'").reason.startswith("the sandbox ended before it did")


def test_cancelling_kills_it(harness: Harness) -> None:
    marker = f"preflight-{uuid.uuid4()}"
    cancel = threading.Event()
    threading.Thread(target=lambda: until(lambda: processes_with(marker)) and cancel.set()).start()
    found = harness.runner.run(f"bash -c 'sleep 60; :' {marker}", cancel)
    assert found == CommandResult("not-run", reason="the run was cancelled")
    until(lambda: processes_with(marker) == [])


def test_without_a_working_sandbox_nothing_runs(harness: Harness, monkeypatch: pytest.MonkeyPatch) -> None:
    status = sandbox.SandboxStatus(False, "no permission for namespaces")
    monkeypatch.setattr(sandbox, "probe", lambda: status)
    assert harness.run("echo 1") == CommandResult("not-run", reason="no sandbox: no permission for namespaces")
    assert harness.starts == 0


@pytest.mark.usefixtures("each_backend")
def test_a_text_of_an_editor_counts_in_the_place_of_a_file_where_the_sandbox_can_do_that(harness: Harness) -> None:
    path = harness.file("a.txt", "saved\n")
    line = harness.script("print(open('a.txt').read(), end='')")
    assert harness.run(line).output == "saved\n"
    typed = harness.runner.over({str(path): "typed\n"})
    expected = "typed\n" if sandbox.probe().replaces else "saved\n"
    assert typed.run(line, threading.Event()).output == expected
    assert harness.run(line).output == "saved\n"
    assert path.read_text() == "saved\n"


def test_what_was_run_with_a_typed_text_is_known_once_that_is_saved(harness: Harness) -> None:
    path = harness.file("a.txt", "saved\n")
    line = harness.script("print(open('a.txt').read(), end='')")
    typed = harness.runner.over({str(path): "typed\n"})
    assert typed.lookup(line) is None
    assert typed.run(line, threading.Event()).output == "typed\n"
    assert harness.runner.lookup(line) is None
    path.write_text("typed\n")
    assert harness.runner.lookup(line) == CommandResult("done", "typed\n")
    assert harness.runner.over({str(path): "typed\n"}).lookup(line) == CommandResult("done", "typed\n")
    assert harness.starts == 1


def test_a_typed_text_shows_nothing_that_the_sandbox_hides(harness: Harness, tmp_path: Path) -> None:
    hidden, link = tmp_path / "hidden.txt", harness.folder / "link.txt"
    hidden.write_text("saved\n")
    link.symlink_to(harness.file("a.txt", "saved\n"))
    typed = harness.runner.over({str(hidden): "typed\n", str(link): "by the link\n", str(tmp_path / "gone"): "new\n"})
    line = harness.script(
        f"import os\nprint(os.path.exists({str(hidden)!r}), os.path.exists({str(tmp_path / 'gone')!r}))"
        "\nprint(open('a.txt').read(), open('link.txt').read())"
    )
    assert typed.run(line, threading.Event()).output == "False False\nby the link\n by the link\n\n"
