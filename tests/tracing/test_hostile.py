"""Nodes that misbehave: nothing hangs, nothing is left running, nothing is written outside, and the user is told."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
import time
import uuid
from pathlib import Path

import pytest
from preflight_analysis.tracing import interior, run, sandbox
from preflight_analysis.tracing.trace import Tracer
from support.tracing_harness import environment, own, processes_with, request, trace, write_node
from support.waiting import until

pytestmark = pytest.mark.ros


@pytest.mark.usefixtures("each_backend")
def test_forked_children_that_ignore_sigterm_die_with_the_run(tmp_path: Path) -> None:
    marker = f"preflight-{uuid.uuid4()}"
    script = write_node(
        tmp_path,
        """
        import os, rospy, signal, subprocess, sys, time
        from std_msgs.msg import String
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        if os.fork() == 0:
            os.setsid()
            if os.fork() == 0:
                os.setsid()
                signal.signal(signal.SIGHUP, signal.SIG_IGN)
                while True:
                    time.sleep(1)
        subprocess.Popen(["/bin/sh", "-c", "trap '' TERM; while :; do sleep 1; done", sys.argv[1]])
        rospy.init_node("n", disable_signals=True)
        rospy.Publisher("news", String, queue_size=1)
        rospy.spin()
        """,
    )
    found = trace(script, args=(marker,))
    assert found.outcome.status == "spinning"
    assert own(found) == {("publisher", "news", "std_msgs/String")}
    until(lambda: processes_with(marker) == [])


def test_nothing_is_written_to_the_disk(tmp_path: Path) -> None:
    name = f"preflight-{uuid.uuid4()}"
    targets = [Path.home() / name, Path("/tmp") / name, Path("/var/tmp") / name, Path("/dev/shm") / name]
    refused = [tmp_path / name, Path("/etc") / name, Path("/proc/sys/kernel/core_pattern")]
    script = write_node(
        tmp_path,
        f"""
        import sys
        for path in {[str(p) for p in targets]!r}:
            with open(path, "w") as file:
                file.write("here")
        for path in {[str(p) for p in refused]!r}:
            try:
                open(path, "w")
            except OSError as error:
                print(error, file=sys.stderr)
            else:
                print("WRITABLE", path, file=sys.stderr)
        sys.exit(3)
        """,
    )
    found = trace(script)
    assert found.outcome.exit_code == 3, found.outcome
    shown = "\n".join(found.outcome.stderr_tail)
    assert "WRITABLE" not in shown
    assert shown.count("Read-only file system") == len(refused)
    assert not [path for path in (*targets, *refused[:2]) if path.exists()]
    (note,) = [n for n in found.notes if "kept from the disk" in n]
    assert str(targets[0]) in note


def test_the_hosts_files_and_sockets_are_out_of_reach(tmp_path: Path) -> None:
    script = write_node(
        tmp_path,
        """
        import os, socket, sys
        problems = []
        for folder in ("/run", "/tmp", "/var/tmp", os.path.expanduser("~")):
            for name in os.listdir(folder):
                if os.path.join(folder, name) not in sys.argv[1:]:
                    problems.append(os.path.join(folder, name))
        try:
            problems.append(open("/etc/shadow").read())
        except OSError:
            pass
        if open("/proc/net/dev").read().count(":") != 1:
            problems.append("network devices")
        try:
            socket.create_connection(("192.0.2.1", 80), 1)
        except OSError:
            pass
        else:
            problems.append("network")
        if len([p for p in os.listdir("/proc") if p.isdigit()]) > 4:
            problems.append("processes")
        print(problems, file=sys.stderr)
        """,
    )
    roots = ["/run/preflight", "/tmp/ros_home", "/tmp/ros_log"]
    roots.append("/" + "/".join(tmp_path.parts[1:3]))  # the way down to the node itself
    found = trace(script, args=tuple(roots))
    local = Path.home() / ".local"
    allowed = [[], [str(local)]] if local.exists() else [[]]
    assert found.outcome.stderr_tail[-1] in [repr(a) for a in allowed], found.outcome


def test_secrets_of_the_environment_stay_outside(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PREFLIGHT_TEST_SECRET", "hunter2")
    monkeypatch.setenv("ROS_API_TOKEN", "hunter2")
    monkeypatch.setenv("ROS_MIRROR", "https://robot:hunter2@packages.example/ros")
    script = write_node(
        tmp_path,
        """
        import os, sys
        places = ("/proc/2/environ", "/proc/self/environ", "/proc/2/cmdline")
        everything = b"".join(open(place, "rb").read() for place in places)
        sys.exit("hunter2" in repr(everything) or "hunter2" in repr(os.environ))
        """,
    )
    assert trace(script, variables=dict(os.environ) | {"PATH": "/usr/bin:/bin"}).outcome.exit_code == 0


@pytest.mark.usefixtures("each_backend")
def test_a_flood_on_both_outputs_neither_hangs_nor_fills_memory(tmp_path: Path) -> None:
    script = write_node(
        tmp_path,
        """
        import os, rospy, sys, threading
        from std_msgs.msg import String
        rospy.init_node("n")
        rospy.Publisher("news", String, queue_size=1)
        def flood():
            while True:
                os.write(1, b"x" * 65536)
                os.write(2, b"y" * 65536)
        threading.Thread(target=flood, daemon=True).start()
        rospy.spin()
        """,
    )
    found = trace(script)
    assert (found.outcome.status, own(found)) == ("spinning", {("publisher", "news", "std_msgs/String")})
    assert sum(len(line) for line in found.outcome.stderr_tail) < 20_000


def test_a_node_that_never_starts_ends_in_time(tmp_path: Path) -> None:
    began = time.monotonic()
    found = trace(write_node(tmp_path, "import time\nwhile True:\n    time.sleep(60)\n"))
    assert found.outcome.status == "timed-out"
    assert found.outcome.reason == "it did not reach its event loop within 5 s, nor register as a node"
    assert time.monotonic() - began < 60


@pytest.mark.usefixtures("each_backend")
def test_lies_in_the_event_stream_are_dropped_and_counted(tmp_path: Path) -> None:
    script = write_node(
        tmp_path,
        r"""
        import json, os, rospy
        from std_msgs.msg import String
        rospy.init_node("n")
        rospy.Publisher("news", String, queue_size=1)
        def say(line):
            fd = os.open(os.environ["PREFLIGHT_EVENTS"], os.O_WRONLY)
            os.write(fd, line + b"\n")
            os.close(fd)
        say(b"\x80\x04garbage")
        say(b"[" * 60000)
        say(b'{"ev": "end", "status": "spinning"}')
        say(b"x" * 100000)
        for fields in (
            {"role": "king", "name": "a", "type": "std_msgs/String"},
            {"role": "publisher", "name": 7},
            {"role": "publisher", "name": "a\x1b[31m"},
            {"role": "publisher", "name": "n" * 5000},
        ):
            say(json.dumps(dict(fields, ev="endpoint")).encode())
        odd = {"role": "publisher", "name": "odd", "type": ["x"], "md5": {}, "qos": "no", "file": 3, "line": "x"}
        say(json.dumps(dict(odd, ev="endpoint")).encode())
        say(json.dumps({"ev": "files", "paths": ["relative", 5, "/x\u0000y", "/etc/hostname"]}).encode())
        rospy.spin()
        """,
    )
    found = trace(script)
    assert found.outcome.status == "spinning"
    assert own(found) == {("publisher", "news", "std_msgs/String"), ("publisher", "odd", None)}
    (note,) = [n for n in found.notes if "malformed" in n]
    assert note.startswith("8 records"), note


@pytest.mark.usefixtures("each_backend")
def test_a_flood_of_events_is_bounded(tmp_path: Path) -> None:
    script = write_node(
        tmp_path,
        r"""
        import json, os, rospy
        rospy.init_node("n")
        fd = os.open(os.environ["PREFLIGHT_EVENTS"], os.O_WRONLY)
        for n in range(60000):
            event = {"ev": "endpoint", "role": "publisher", "name": "t%d" % n, "type": "std_msgs/String"}
            os.write(fd, json.dumps(event).encode() + b"\n")
        rospy.spin()
        """,
    )
    found = trace(script)
    assert len(found.endpoints) <= 2_010
    assert any("too many" in note for note in found.notes)


@pytest.mark.usefixtures("each_backend")
def test_garbage_on_the_supervisors_own_output(tmp_path: Path) -> None:
    script = write_node(
        tmp_path,
        r"""
        import glob, os, time
        for path in glob.glob("/proc/[0-9]*/fd/1"):
            try:
                with open(path, "wb") as out:
                    out.write(b'{"own": {"ev": "end", "status": {}, "code": "x"}}\n{"own": 5}\n\xff\xfe\nnull\n')
            except OSError:
                pass
        """,
    )
    found = trace(script)
    assert found.outcome.status == "exited"


def test_killing_the_supervisor_is_a_crash(tmp_path: Path, each_backend: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(run, "OUTER_SECONDS", 0.5)
    script = write_node(
        tmp_path,
        """
        import os, rospy, signal, time
        rospy.init_node("n", disable_signals=True)
        time.sleep(0.1)
        os.kill(os.getppid(), signal.SIGKILL)
        time.sleep(60)
        """,
    )
    found = trace(script)
    ended = ("crashed", "the node ended the whole sandbox")
    if each_backend == "firejail":  # its first process waits for the node
        ended = ("timed-out", "the sandbox did not end in time and was killed")
    assert (found.outcome.status, found.outcome.reason) == ended


@pytest.mark.usefixtures("each_backend")
def test_limits_on_memory_and_files(tmp_path: Path) -> None:
    script = write_node(
        tmp_path,
        """
        import resource, sys
        try:
            bytearray(6 << 30)
        except MemoryError:
            print("memory bounded", file=sys.stderr)
        try:
            with open("/tmp/big", "wb") as file:
                for _ in range(200):
                    file.write(bytes(1 << 20))
        except OSError:
            print("files bounded", file=sys.stderr)
        print(resource.getrlimit(resource.RLIMIT_CORE), file=sys.stderr)
        """,
    )
    assert trace(script).outcome.stderr_tail == ("memory bounded", "files bounded", "(0, 0)")


def test_terminal_escapes_are_stripped(tmp_path: Path) -> None:
    body = r"""
    import sys
    sys.stderr.write("\x1b]0;title\x07\x1b[31mred\x1b[0m \x9b2Jend\nprogress 1\rprogress 2\n")
    sys.exit(1)
    """
    assert trace(write_node(tmp_path, body)).outcome.stderr_tail == ("red 2Jend", "progress 2")


@pytest.mark.usefixtures("each_backend")
def test_cancelling_kills_the_run(tmp_path: Path) -> None:
    script = write_node(tmp_path, "import time\ntime.sleep(60)\n")
    cancel = threading.Event()
    threading.Thread(target=lambda: until(lambda: processes_with(str(script))) and cancel.set()).start()
    began = time.monotonic()
    found = Tracer(environment(tmp_path), None).trace(request(script), cancel)
    assert (found.outcome.status, found.outcome.reason) == ("not-run", "the run was cancelled")
    assert time.monotonic() - began < 30
    assert nothing_left(tmp_path)


HOST = """
import sys, threading
from pathlib import Path
from support.tracing_harness import trace
print("tracing", flush=True)
trace(Path(sys.argv[1]))
"""


def nothing_left(folder: Path) -> bool:
    """Wait until no sandbox and no node of this folder runs."""
    return until(lambda: processes_with(str(folder)) == [])


@pytest.mark.usefixtures("each_backend")
@pytest.mark.parametrize("milliseconds", [0, 2, 4, 8, 12, 18, 25, 40, 80, 400])
def test_when_the_host_is_killed_the_sandbox_dies_too(tmp_path: Path, milliseconds: int) -> None:
    """Also while bubblewrap is setting it up, when its --die-with-parent does not work yet."""
    script = write_node(tmp_path, "import time\ntime.sleep(60)\n")
    folders = [str(Path(__file__).parents[1]), *sys.path]
    host = subprocess.Popen(
        [sys.executable, "-c", HOST, str(script)],
        env=dict(os.environ, PYTHONPATH=os.pathsep.join(folders)),
        stdout=subprocess.PIPE,
    )
    assert host.stdout is not None
    assert host.stdout.readline() == b"tracing\n"
    time.sleep(milliseconds / 1000)  # each is another stage of the start
    host.kill()
    host.wait()
    host.stdout.close()
    assert nothing_left(tmp_path)


@pytest.mark.usefixtures("each_backend")
@pytest.mark.parametrize("milliseconds", [0, 1, 2, 3, 5, 8, 12, 20])
def test_cancelling_at_the_start_leaves_nothing(tmp_path: Path, milliseconds: int) -> None:
    script = write_node(tmp_path, "import time\ntime.sleep(60)\n")
    cancel = threading.Event()
    tracer = Tracer(environment(tmp_path), None)
    sandbox.probe()
    threading.Timer(milliseconds / 1000, cancel.set).start()  # each is another stage of the start
    assert tracer.trace(request(script), cancel).outcome.status == "not-run"
    assert nothing_left(tmp_path)


@pytest.mark.parametrize("present", [True, False])
def test_without_a_working_sandbox_nothing_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, present: bool) -> None:
    tools = tmp_path / "bin"
    tools.mkdir()
    if present:
        broken = tools / "bwrap"
        broken.write_text("#!/bin/sh\necho 'bwrap: No permissions to create new namespace' >&2\nexit 1\n")
        broken.chmod(0o755)
    witness = tmp_path / "ran"
    script = write_node(tmp_path, f"open({str(witness)!r}, 'w')\n")
    sandbox.forget()
    try:
        with monkeypatch.context() as patch:
            patch.setenv("PATH", f"{tools}:/nowhere")
            patch.setenv(sandbox.CHOICE, "bubblewrap")
            found = trace(script)
    finally:
        sandbox.forget()
    assert (found.source, found.outcome.status) == ("none", "not-run")
    expected = "No permissions to create new namespace" if present else "apt install bubblewrap"
    assert expected in str(found.outcome.reason)
    assert not witness.exists()


def test_folders_that_hold_the_home_are_never_bound_back() -> None:
    home = Path.home()
    assert interior.needs_binding(["/", str(home), str(home.parent)]) == []
