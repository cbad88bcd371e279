"""Nodes that try to reach what is the host's: each tells what it got, and each test says what that must be."""

from __future__ import annotations

import os
import re
import socket
import threading
import time
import uuid
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest
from preflight_analysis.tracing import run
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.trace import Tracer
from support.tracing_harness import environment, own, planted_key, processes_with, request, trace, write_node
from support.waiting import until

pytestmark = pytest.mark.ros

TRY = """
import os, socket, sys
def attempt(name, action):
    try:
        result = action()
    except OSError as error:
        result = error.strerror or type(error).__name__
    print(name, result, file=sys.stderr)
"""


def attempts(folder: Path, body: str) -> dict[str, str]:
    """What a node says of each of its attempts."""
    tail = trace(write_node(folder, TRY + body)).outcome.stderr_tail
    return {name: result for name, _, result in (line.partition(" ") for line in tail)}


@pytest.fixture
def planted() -> Iterator[Path]:
    with planted_key() as key:
        yield key


def test_keys_in_the_home_folder_cannot_be_read(tmp_path: Path, planted: Path) -> None:
    done = attempts(
        tmp_path,
        f"""
key = {str(planted)!r}
attempt("directly", lambda: open(key).read())
attempt("by-root-link", lambda: open("/proc/1/root" + key).read())
attempt("by-cwd-link", lambda: open("/proc/self/cwd/../../../../../../.." + key).read())
attempt("listed", lambda: os.path.basename(os.path.dirname(key)) in os.listdir(os.path.expanduser("~")))
os.symlink(key, "/tmp/link")
attempt("by-symlink", lambda: open("/tmp/link").read())
""",
    )
    missing = "No such file or directory"
    assert done.pop("by-root-link") in (missing, "Permission denied")
    assert done == {"directly": missing, "by-cwd-link": missing, "by-symlink": missing, "listed": "False"}


def test_the_workspace_cannot_be_changed(tmp_path: Path) -> None:
    precious = tmp_path / "precious"
    precious.write_text("as it was")
    mode = precious.stat().st_mode
    done = attempts(
        tmp_path,
        f"""
path = {str(precious)!r}
attempt("write", lambda: open(path, "w"))
attempt("append", lambda: os.open(path, os.O_WRONLY | os.O_APPEND))
attempt("unlink", lambda: os.unlink(path))
attempt("rename", lambda: os.rename(path, path + "2"))
attempt("chmod", lambda: os.chmod(path, 0o777))
attempt("utime", lambda: os.utime(path, (1, 1)))
attempt("link", lambda: os.link(path, path + "2"))
attempt("mkdir", lambda: os.mkdir(path + "3"))
attempt("by-descriptor", lambda: os.open("/proc/self/fd/%d" % os.open(path, os.O_RDONLY), os.O_RDWR))
""",
    )
    assert done.pop("link") in ("Read-only file system", "Invalid cross-device link")
    assert set(done.values()) == {"Read-only file system"}
    assert len(done) == 8
    assert (precious.read_text(), precious.stat().st_mode) == ("as it was", mode)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["node.py", "precious"]


def test_a_listener_on_the_hosts_loopback_is_out_of_reach(tmp_path: Path) -> None:
    with closing(socket.create_server(("127.0.0.1", 0))) as tcp, closing(socket.socket(type=socket.SOCK_DGRAM)) as udp:
        udp.bind(("127.0.0.1", 0))
        udp.setblocking(False)
        done = attempts(
            tmp_path,
            f"""
attempt("tcp", lambda: socket.create_connection(("127.0.0.1", {tcp.getsockname()[1]}), 1))
attempt("udp", lambda: socket.socket(type=socket.SOCK_DGRAM).sendto(b"x", ("127.0.0.1", {udp.getsockname()[1]})))
attempt("raw", lambda: socket.socket(socket.AF_INET, socket.SOCK_RAW, 1))
attempt("packet", lambda: socket.socket(17, socket.SOCK_RAW))
attempt("vsock", lambda: socket.socket(40, socket.SOCK_STREAM))
""",
        )
        tcp.setblocking(False)
        with pytest.raises(BlockingIOError):
            tcp.accept()
        with pytest.raises(BlockingIOError):
            udp.recv(1)
    assert done == {
        "tcp": "Connection refused",
        "udp": "1",
        "raw": "Operation not permitted",
        "packet": "Address family not supported by protocol",
        "vsock": "Address family not supported by protocol",
    }


def test_unix_sockets_are_out_of_reach(tmp_path: Path) -> None:
    """An editor's in /tmp, one in the workspace, an abstract one."""
    name = f"preflight-{uuid.uuid4().hex[:8]}"
    editors, workspace, abstract = f"/tmp/{name}.sock", str(tmp_path / "s.sock"), "\0" + name
    listening = [socket.socket(socket.AF_UNIX) for _ in range(3)]
    try:
        for each, address in zip(listening, (editors, workspace, abstract), strict=True):
            each.bind(address)
            each.listen()
            each.setblocking(False)
        done = attempts(
            tmp_path,
            f"""
def connect(address):
    with socket.socket(socket.AF_UNIX) as s:
        s.connect(address)
attempt("editors", lambda: connect({editors!r}))
attempt("workspace", lambda: connect({workspace!r}))
attempt("abstract", lambda: connect({abstract!r}))
""",
        )
        for each in listening:
            with pytest.raises(BlockingIOError):
                each.accept()
    finally:
        for each in listening:
            each.close()
        os.unlink(editors)
    assert done == {
        "editors": "No such file or directory",
        "workspace": "Connection refused",
        "abstract": "Connection refused",
    }


def test_signals_reach_only_the_sandbox(tmp_path: Path) -> None:
    """Towards the host with signal 0, which only asks."""
    done = attempts(
        tmp_path,
        f"""
import signal
attempt("host", lambda: os.kill({os.getpid()}, 0))
attempt("group", lambda: os.killpg({os.getpgrp()}, 0))
attempt("init", lambda: os.kill(1, signal.SIGKILL))
attempt("all", lambda: len([p for p in os.listdir("/proc") if p.isdigit()]))
""",
    )
    # The kernel lets no signal from inside end the first process of a name space: 1, the supervisor, the node.
    assert done == {"host": "No such process", "group": "No such process", "init": "None", "all": "3"}


def test_the_first_process_cannot_be_changed(tmp_path: Path) -> None:
    """It ends the sandbox when the host goes, which its memory could be made to forget."""
    done = attempts(
        tmp_path,
        """
attempt("listed", lambda: os.listdir("/proc/1"))
attempt("memory", lambda: open("/proc/1/mem", "r+b"))
attempt("thread", lambda: open("/proc/1/task/1/mem", "r+b"))
attempt("made", lambda: open("/proc/1/x", "w"))
""",
    )
    missing = "No such file or directory"
    made = done.pop("made")
    assert made in ("Read-only file system", "Permission denied")
    assert done == {"listed": "[]", "memory": missing, "thread": missing}


def test_killing_everything_leaves_nothing(tmp_path: Path) -> None:
    body = "import os, signal\nos.kill(-1, signal.SIGKILL)\nos.kill(os.getpid(), signal.SIGKILL)\n"
    marker = f"preflight-{uuid.uuid4()}"
    outcome = trace(write_node(tmp_path, body), args=(marker,)).outcome
    assert outcome.status == "not-run", outcome
    until(lambda: processes_with(marker) == [])


@pytest.mark.usefixtures("each_backend")
def test_no_descriptor_of_the_hosts_is_inherited(tmp_path: Path) -> None:
    secret = tmp_path / "secret"
    secret.write_text("x")
    with secret.open() as kept:
        os.set_inheritable(kept.fileno(), True)
        listed = """
attempt("open", lambda: sorted(os.readlink("/proc/self/fd/%s" % n) for n in os.listdir("/proc/self/fd")
    if os.path.lexists("/proc/self/fd/%s" % n)))
"""
        found = attempts(tmp_path, listed)["open"]
    assert set(re.sub(r"[0-9]+", "N", found).strip("[]").split(", ")) <= {"'/dev/null'", "'pipe:[N]'"}, found


@pytest.mark.usefixtures("each_backend")
def test_a_stopped_supervisor_is_ended_from_outside(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(run, "WALL_SECONDS", 3.0)
    monkeypatch.setattr(run, "OUTER_SECONDS", 0.5)
    body = "import os, signal, time\nos.kill(os.getppid(), signal.SIGSTOP)\ntime.sleep(60)\n"
    began = time.monotonic()
    outcome = trace(write_node(tmp_path, body)).outcome
    assert (outcome.status, outcome.reason) == ("timed-out", "the sandbox did not end in time and was killed")
    assert time.monotonic() - began < 30


def test_setuid_programs_and_capabilities_give_nothing(tmp_path: Path) -> None:
    done = attempts(
        tmp_path,
        """
status = dict(line.split(":", 1) for line in open("/proc/self/status"))
for name in ("CapPrm", "CapEff", "CapBnd", "CapAmb"):
    print(name, int(status[name], 16), file=sys.stderr)
print("NoNewPrivs", status["NoNewPrivs"].strip(), file=sys.stderr)
print("Seccomp", status["Seccomp"].strip(), file=sys.stderr)
attempt("setuid", lambda: os.setuid(12345))
attempt("chroot", lambda: os.chroot("/tmp"))
attempt("mknod", lambda: os.mknod("/tmp/disk", 0o60600, os.makedev(8, 0)))
attempt("nice", lambda: os.nice(-5))
""",
    )
    assert [done.pop(name) for name in ("CapPrm", "CapEff", "CapBnd", "CapAmb")] == ["0"] * 4
    assert (done.pop("NoNewPrivs"), done.pop("Seccomp")) == ("1", "2")
    assert done.pop("setuid") in ("Invalid argument", "Operation not permitted")
    assert done.pop("nice") in ("Operation not permitted", "Permission denied")
    assert done == {"chroot": "Operation not permitted", "mknod": "Operation not permitted"}


def test_the_kernels_switches_cannot_be_set(tmp_path: Path) -> None:
    done = attempts(
        tmp_path,
        """
paths = ["/proc/sys/kernel/core_pattern", "/proc/sysrq-trigger", "/proc/self/oom_score_adj", "/dev/mem", "/dev/kmsg"]
for path in paths:
    attempt(path, lambda: os.write(os.open(path, os.O_WRONLY), b"-1000"))
attempt("sys", lambda: [f for f in ("/sys/power/state", "/sys/kernel/uevent_helper") if os.access(f, os.W_OK)])
attempt("devices", lambda: sorted(n for n in os.listdir("/dev") if n.startswith(("sd", "nvme", "vd", "kvm", "input"))))
""",
    )
    assert "5" not in done.values(), done
    assert (done["sys"], done["devices"]) == ("[]", "[]")


def test_a_full_disk_stays_in_the_sandbox(tmp_path: Path) -> None:
    """No more than 200 MB are tried; each file system inside ends at 64."""
    done = attempts(
        tmp_path,
        """
def fill(folder):
    written = 0
    try:
        for part in range(8):
            with open(folder + "/big%d" % part, "wb", 0) as file:
                for _ in range(12):
                    written += file.write(bytes(1 << 20))
    except OSError as error:
        return "%d %s" % (written >> 20 > 64, error.strerror)
    return "unbounded"
attempt("tmp", lambda: fill("/tmp"))
attempt("home", lambda: fill(os.path.expanduser("~")))
""",
    )
    assert done == {"tmp": "0 No space left on device", "home": "0 No space left on device"}


@pytest.mark.usefixtures("each_backend")
def test_a_node_that_hides_its_files_in_lies_does_not_block_the_host(tmp_path: Path) -> None:
    """Files that never end, that block when opened, that are not there; reported as read, so that the cache looks."""
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "loop").symlink_to(tmp_path / "loop")
    paths = ["/dev/zero", "/dev/random", str(tmp_path / "pipe"), str(tmp_path / "loop"), "/proc/kmsg", "/" + "x" * 4000]
    script = write_node(
        tmp_path,
        f"""
        import json, os, rospy
        from std_msgs.msg import String
        rospy.init_node("n")
        rospy.Publisher("news", String, queue_size=1)
        with open(os.environ["PREFLIGHT_EVENTS"], "w") as events:
            events.write(json.dumps({{"ev": "files", "paths": {paths!r}}}) + "\\n")
        rospy.spin()
        """,
    )
    tracer = Tracer(environment(tmp_path), TraceCache(tmp_path / "cache"))
    began = time.monotonic()
    found = [tracer.trace(request(script), threading.Event()) for _ in range(2)]
    assert [own(each) for each in found] == [{("publisher", "news", "std_msgs/String")}] * 2
    assert time.monotonic() - began < 60


@pytest.mark.usefixtures("each_backend")
def test_numbers_and_text_that_break_writers_are_survived(tmp_path: Path) -> None:
    script = write_node(
        tmp_path,
        r"""
        import os, rospy
        from std_msgs.msg import String
        rospy.init_node("n")
        rospy.Publisher("news", String, queue_size=1)
        events = os.open(os.environ["PREFLIGHT_EVENTS"], os.O_WRONLY)
        for line in (
            b'{"ev": "endpoint", "role": "publisher", "name": "a\\ud800b"}',
            b'{"ev": "endpoint", "role": "publisher", "name": "ok", "type": "\\udfff", "line": 1e999}',
            b'{"ev": "endpoint", "role": "publisher", "name": "where", "line": 3, "file": "/\\ud800"}',
            b'{"ev": "endpoint", "role": "publisher", "name": "\\u009b2J"}',
            b'{"ev": "endpoint", "role": "publisher", "name": "nan", "line": NaN, "queue_size": -Infinity}',
            b'{"ev": "state", "state": "sleep", "seconds": NaN}',
            b'{"ev": "state", "state": "sleep", "seconds": -1e308}',
            b'{"ev": "param", "access": "get", "name": "' + b"9" * 3000 + b'"}',
            b'{"ev": "files", "paths": {"a": 1}}',
            b'{"ev": "files", "paths": ["/\\ud800"]}',
            b'{"ev": "wrote", "path": ["x"]}',
            b'{"ev": 5}',
            b'{"ev": "endpoint", "n": ' + b"9" * 6000 + b'}',
        ):
            os.write(events, line + b"\n")
        rospy.spin()
        """,
    )
    tracer = Tracer(environment(tmp_path), TraceCache(tmp_path / "cache"))
    for _ in range(2):
        found = tracer.trace(request(script), threading.Event())
        assert ("publisher", "news", "std_msgs/String") in own(found)
        assert found.outcome.status == "spinning"
        named = {e.name: e for e in found.endpoints if not e.builtin}
        assert {"ok", "nan", "where"} <= named.keys()
        assert (named["ok"].type, named["where"].source_file) == (None, None)
        assert [name for name in named if "\ud800" in name or "\x9b" in name] == []
