"""What each way to isolate does against the same hostile node, and that the table in docs/security.md says so.

The node tells of each attempt how it ended; what the host has to see is looked at on the host. An attempt that succeeds
does so with something of the run's own, but where the table says otherwise.
"""

from __future__ import annotations

import json
import os
import re
import socket
import subprocess
import sys
import tempfile
import threading
import uuid
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, closing
from pathlib import Path

import pytest
from preflight_analysis.tracing import landlock, run, sandbox, seccomp
from preflight_analysis.tracing.backend import AGENTS, View
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.trace import Tracer
from tracing_desk import environment, known_backends, own, processes_with, request, trace, working_backends, write_node

pytestmark = pytest.mark.ros

SECURITY = Path(__file__).parents[2] / "docs" / "security.md"
CASES = re.compile(r"^\| `([a-z0-9-]+)` \| ([^|]*) \| ([^|]*) \| ([^|]*) \| ([^|]*) \|$", re.MULTILINE)
COLUMNS = ("bubblewrap", "firejail", "landlock")

NODE = r"""
import ctypes, errno, json, os, platform, resource, socket, struct, sys
given = json.loads(sys.argv[1])
libc = ctypes.CDLL(None, use_errno=True)
column = ["x86_64", "aarch64"].index(platform.machine())
found = {}

def attempt(name):
    def run(action):
        try:
            found[name] = "done" if action() is not False else "nothing"
        except OSError as error:
            found[name] = errno.errorcode.get(error.errno, type(error).__name__)
        return action
    return run

def call(numbers, *arguments):
    passed = [ctypes.c_long(a) if isinstance(a, int) else a for a in arguments]
    if libc.syscall(ctypes.c_long(numbers[column]), *passed, *[ctypes.c_long(0)] * (6 - len(passed))) == -1:
        raise OSError(ctypes.get_errno(), "")

def connect(family, kind, address):
    with socket.socket(family, kind) as end:
        end.settimeout(2)
        end.connect(address)

host, key, precious, port = given["host"], given["key"], given["precious"], given["port"]
work = os.path.dirname(precious)

attempt("home-read")(lambda: open(key).read())
attempt("home-listed")(lambda: os.path.basename(os.path.dirname(key)) in os.listdir(given["home"]))
attempt("home-known")(lambda: os.stat(key))
attempt("home-write")(lambda: open(os.path.join(given["home"], given["name"]), "w"))
attempt("host-tmp-read")(lambda: open(given["shared"]).read())
attempt("host-tmp-write")(lambda: open("/tmp/" + given["name"], "w"))
attempt("etc-write")(lambda: open("/etc/" + given["name"], "w"))
attempt("root-write")(lambda: os.mkdir("/" + given["name"]))
def anywhere():
    for place in ("/sys/kernel", "/sys/power", "/proc/sys/kernel", "/proc/sys/vm", "/proc"):
        try:
            names = os.listdir(place)
        except OSError:
            continue
        for name in names:
            try:
                os.close(os.open(os.path.join(place, name), os.O_WRONLY | os.O_NONBLOCK))
            except OSError:
                continue
            return True
    return False
attempt("kernel-switches")(anywhere)
def writable():
    for place, folders, _ in os.walk("/run"):
        try:
            os.mkdir(os.path.join(place, given["name"]))
        except OSError:
            continue
        return not place.startswith("/run/firejail/mnt")
    return False
attempt("run-write")(writable)
attempt("var-tmp-write")(lambda: open("/var/tmp/" + given["name"], "w"))
attempt("shared-memory-write")(lambda: open("/dev/shm/" + given["name"], "w"))
attempt("shadow-read")(lambda: open("/etc/shadow").read(1) != "")
attempt("workspace-read")(lambda: open(precious).read())
attempt("workspace-write")(lambda: open(precious, "w"))
attempt("workspace-truncate")(lambda: os.truncate(precious, 0))
attempt("workspace-unlink")(lambda: os.unlink(precious))
attempt("workspace-rename")(lambda: os.rename(precious, precious + "2"))
attempt("workspace-link")(lambda: os.link(precious, os.environ["HOME"] + "/link"))
attempt("workspace-chmod")(lambda: os.chmod(precious, 0o777))
attempt("workspace-fchmod")(lambda: os.fchmod(os.open(precious, os.O_RDONLY), 0o777))
attempt("workspace-chown")(lambda: os.chown(precious, os.getuid(), os.getgid()))
attempt("workspace-utime")(lambda: os.utime(precious, (1, 1)))
attempt("workspace-xattr")(lambda: os.setxattr(precious, "user.x", b"x"))
attempt("workspace-new")(lambda: os.mkdir(precious + "3"))
attempt("core-pattern")(lambda: open("/proc/sys/kernel/core_pattern", "w"))
attempt("device")(lambda: os.mknod(os.environ["HOME"] + "/disk", 0o60600, os.makedev(8, 0)))

attempt("host-environment")(lambda: open("/proc/%d/environ" % host).read())
attempt("host-memory")(lambda: open("/proc/%d/mem" % host, "rb"))
attempt("host-files")(lambda: os.readlink("/proc/%d/fd/0" % host))
attempt("host-command-line")(lambda: open("/proc/%d/cmdline" % host).read())
attempt("signal-host")(lambda: os.kill(host, 0))
attempt("signal-group")(lambda: os.killpg(given["group"], 0))
attempt("signal-queued")(lambda: call((129, 138), host, 0, ctypes.c_char_p(bytes(128))))
attempt("signal-by-handle")(lambda: call((424, 424), os.pidfd_open(host), 0))
attempt("limit-host")(lambda: resource.prlimit(host, resource.RLIMIT_CORE))
attempt("schedule-host")(lambda: os.sched_setaffinity(host, os.sched_getaffinity(0)))
def owner():
    import fcntl
    fcntl.fcntl(socket.socketpair()[0], 8, host)
attempt("signal-by-socket")(owner)

attempt("loopback-tcp")(lambda: connect(socket.AF_INET, socket.SOCK_STREAM, ("127.0.0.1", port)))
attempt("loopback-tcp6")(lambda: connect(socket.AF_INET6, socket.SOCK_STREAM, ("::ffff:127.0.0.1", port)))
def in_passing():
    with socket.socket() as end:
        end.sendto(b"x", 0x20000000, ("127.0.0.1", port))
attempt("loopback-fast-open")(in_passing)
def datagram():
    with socket.socket(type=socket.SOCK_DGRAM) as end:
        end.sendto(b"x", ("127.0.0.1", port))
attempt("loopback-udp")(datagram)
attempt("network-tcp")(lambda: connect(socket.AF_INET, socket.SOCK_STREAM, ("192.0.2.1", 9)))
attempt("network-raw")(lambda: socket.socket(socket.AF_INET, socket.SOCK_RAW, 1))
def connect_multipath():
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM, 262) as end:
        end.settimeout(2)
        end.connect(("127.0.0.1", port))
attempt("multipath-tcp")(connect_multipath)
attempt("virtual-machine-socket")(lambda: socket.socket(40, socket.SOCK_STREAM))
attempt("unix-socket")(lambda: connect(socket.AF_UNIX, socket.SOCK_STREAM, given["editors"]))
attempt("unix-socket-in-workspace")(lambda: connect(socket.AF_UNIX, socket.SOCK_STREAM, given["workspaces"]))
attempt("abstract-socket")(lambda: connect(socket.AF_UNIX, socket.SOCK_STREAM, given["abstract"]))
def log():
    socket.socketpair(socket.AF_UNIX, socket.SOCK_DGRAM)[0].sendto(b"x", given["log"])
attempt("unix-datagram")(log)

attempt("ptrace")(lambda: call((101, 117), 16, host))
attempt("memory-of-process")(lambda: call((310, 270), host))
attempt("key-ring")(lambda: call((250, 219), 0, -3))
attempt("io-uring")(lambda: call((425, 425), 1))
attempt("user-name-space")(lambda: call((272, 97), 0x10000000))
attempt("mount")(lambda: call((165, 40)))
attempt("kernel-program")(lambda: call((321, 280)))
attempt("terminal-input")(lambda: call((16, 29), 0, 0x5412))
attempt("shared-memory-of-host")(lambda: call((30, 196), given["segment"], 0, 0o10000))
attempt("setuid")(lambda: os.setuid(12345))

text = json.dumps(found)
for start in range(0, len(text), 400):
    print("part", text[start:start + 400], file=sys.stderr)
"""


@pytest.fixture
def planted() -> Iterator[Path]:
    """A folder in the home folder, with a key in it, that a test may plant there and has to remove."""
    folder = Path(tempfile.mkdtemp(prefix=".preflight-test-", dir=Path.home()))
    key = folder / "id_ed25519"
    key.write_text("PRIVATE KEY")
    yield key
    key.unlink()
    folder.rmdir()


def documented() -> dict[str, dict[str, set[str]]]:
    """The table of docs/security.md: what each attempt may come to, by backend."""
    rows = CASES.findall(SECURITY.read_text())
    return {row[0]: {name: set(cell.split(", ")) for name, cell in zip(COLUMNS, row[2:], strict=True)} for row in rows}


NEWEST = landlock.version()
WORKING = known_backends()
OLDER = [("landlock", version) for version in (1, 3, 5) if version < NEWEST]
"""As if the kernel had an older Landlock: with less of it, the rest must keep the same."""


@pytest.mark.parametrize(("backend", "version"), [*((name, NEWEST) for name in WORKING), *OLDER])
def test_every_attempt_ends_as_the_documentation_says(
    tmp_path: Path, planted: Path, backend: str, version: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(sandbox.CHOICE, backend)
    monkeypatch.setattr(landlock, "version", lambda: version)
    name = f"preflight-{uuid.uuid4().hex[:10]}"
    precious = tmp_path / "precious"
    precious.write_text("as it was")
    before = precious.stat()
    with ExitStack() as at_end:
        shared = at_end.enter_context(tempfile.NamedTemporaryFile(prefix="preflight-", dir="/tmp"))
        shared.write(b"x")
        shared.flush()
        tcp = at_end.enter_context(closing(socket.create_server(("127.0.0.1", 0))))
        port = tcp.getsockname()[1]
        udp = at_end.enter_context(closing(socket.socket(type=socket.SOCK_DGRAM)))
        udp.bind(("127.0.0.1", port))
        sockets = {"editors": f"/tmp/{name}.sock", "workspaces": str(tmp_path / "s"), "abstract": "\0" + name}
        streams = [at_end.enter_context(closing(socket.socket(socket.AF_UNIX))) for _ in sockets]
        for stream, address in zip(streams, sockets.values(), strict=True):
            stream.bind(address)
            stream.listen()
        at_end.callback(os.unlink, sockets["editors"])
        log = at_end.enter_context(closing(socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)))
        log.bind(f"/tmp/{name}.log")
        at_end.callback(os.unlink, f"/tmp/{name}.log")
        host = subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE, start_new_session=True)
        at_end.callback(host.wait)
        at_end.callback(host.kill)
        assert host.stdin is not None
        at_end.callback(host.stdin.close)
        given = {
            **sockets,
            "log": f"/tmp/{name}.log",
            "host": host.pid,
            "group": host.pid,
            "key": str(planted),
            "home": str(Path.home()),
            "name": name,
            "shared": shared.name,
            "precious": str(precious),
            "port": port,
            "segment": 0,
        }
        outcome = trace(write_node(tmp_path, NODE), args=(json.dumps(given),)).outcome
        assert outcome.exit_code == 0, outcome
        for listener in (tcp, *streams):
            listener.setblocking(False)
            with pytest.raises(BlockingIOError):
                listener.accept()
        for receiver in (udp, log):
            receiver.setblocking(False)
            with pytest.raises(BlockingIOError):
                receiver.recv(1)
        assert host.poll() is None
    assert precious.read_text() == "as it was"
    after = precious.stat()
    assert (after.st_mode, after.st_uid, after.st_mtime, after.st_nlink, after.st_ctime) == (
        before.st_mode,
        before.st_uid,
        before.st_mtime,
        before.st_nlink,
        before.st_ctime,
    )
    assert sorted(path.name for path in tmp_path.iterdir()) == ["node.py", "precious", "s"]
    places = (Path.home(), Path("/tmp"), Path("/etc"), Path("/var/tmp"), Path("/dev/shm"), Path("/"))
    assert not [place for place in places if (place / name).exists()]
    said = [line.partition(" ")[2] for line in outcome.stderr_tail if line.startswith("part ")]
    found = json.loads("".join(said))
    table = documented()
    assert list(found) == list(table)
    wrong = {case: ended for case, ended in found.items() if ended not in table[case][backend]}
    assert wrong == {}


def test_the_run_has_its_master_whatever_the_host_listens_on(tmp_path: Path, each_backend: str) -> None:
    """The port of a real master may be taken, and several runs have theirs at once."""
    script = write_node(
        tmp_path,
        """
        import rospy, threading
        from std_msgs.msg import String
        from std_srvs.srv import Empty, EmptyResponse
        rospy.init_node("n")
        rospy.Service("reset", Empty, lambda request: EmptyResponse())
        heard = threading.Event()
        rospy.Subscriber("news", String, lambda message: heard.set())
        news = rospy.Publisher("news", String, queue_size=1)
        rospy.ServiceProxy("reset", Empty)()
        while not heard.wait(0.02):
            news.publish("x")
        rospy.Publisher("heard", String, queue_size=1)
        rospy.spin()
        """,
    )
    with ExitStack() as at_end:
        try:
            taken = at_end.enter_context(closing(socket.create_server(("127.0.0.1", 11311))))
        except OSError:
            taken = None  # by a real one, perhaps
        with ThreadPoolExecutor(2) as pool:
            found = list(pool.map(trace, [script, script]))
        if taken is not None:
            taken.setblocking(False)
            with pytest.raises(BlockingIOError):
                taken.accept()
    for each in found:
        assert each.outcome.status == "spinning", each.outcome
        assert ("publisher", "heard", "std_msgs/String") in own(each)


@pytest.mark.parametrize("backend", [name for name in WORKING if name != "bubblewrap"])
def test_too_much_on_the_disk_ends_the_run(tmp_path: Path, backend: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """In files with a name and in those that have none any more. With bubblewrap the file systems end first."""
    monkeypatch.setenv(sandbox.CHOICE, backend)
    monkeypatch.setattr(run, "DISK_BYTES", 20 << 20)
    body = """
    import os, sys, tempfile, time
    kept = []
    for number in range(9):
        kept.append(tempfile.TemporaryFile() if number % 2 else open(os.path.expanduser("~/%d" % number), "wb"))
        kept[-1].write(bytes(8 << 20))
        kept[-1].flush()
    time.sleep(60)
    """
    outcome = trace(write_node(tmp_path, body)).outcome
    assert outcome.status == "crashed", outcome
    assert str(outcome.reason).startswith("it wrote more than ")
    assert list(Path(tempfile.gettempdir()).glob(f"ros-preflight-{os.getpid()}-*")) == []


def test_a_crash_that_the_sandbox_may_have_caused_is_marked_and_not_kept(tmp_path: Path, each_backend: str) -> None:
    package = tmp_path / "pkg"
    package.mkdir()
    script = write_node(package, "import multiprocessing\nmultiprocessing.Lock()\nraise SystemExit(3)\n")
    os.utime(script, (0, 0))
    tracer = Tracer(environment(package), TraceCache(tmp_path / "cache"))
    found = [tracer.trace(request(script), threading.Event()) for _ in range(2)]
    marked = [any("refuses" in note for note in each.notes) for each in found]
    if each_backend == "landlock":
        assert (marked, [each.cached for each in found]) == ([True, True], [False, False])
    else:
        assert (marked, [each.cached for each in found]) == ([False, False], [False, True])
        assert found[0].outcome.exit_code == 3


def test_the_choice_is_the_users(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in working_backends():
        monkeypatch.setenv(sandbox.CHOICE, name)
        assert sandbox.probe().backend == name
    monkeypatch.setenv(sandbox.CHOICE, "auto")
    assert sandbox.probe().backend == working_backends()[0]
    monkeypatch.setenv(sandbox.CHOICE, "none")
    status = sandbox.probe()
    assert not status.works
    assert (
        str(status.reason) == "ROS_PREFLIGHT_SANDBOX is 'none', which is none of auto, bubblewrap, firejail, landlock"
    )


def test_what_is_missing_gives_way_to_the_next(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """And where there is none at all, nothing runs and every reason is told."""
    script = write_node(tmp_path, "import sys\nsys.exit(3)\n")
    monkeypatch.setenv("PATH", "/nowhere")
    sandbox.forget()
    try:
        without_programs = sandbox.probe()
        assert without_programs.backend == ("landlock" if "landlock" in WORKING else None)
        assert trace(script).outcome.exit_code == (3 if "landlock" in WORKING else None)
        monkeypatch.setattr(landlock, "version", lambda: 0)
        sandbox.forget()
        outcome = trace(script).outcome
    finally:
        sandbox.forget()
    assert outcome.status == "not-run"
    for part in ("apt install bubblewrap", "apt install firejail", "the kernel has no Landlock"):
        assert part in str(outcome.reason)


def test_every_backend_works_here_or_says_why(monkeypatch: pytest.MonkeyPatch) -> None:
    """Landlock needs nothing but the kernel; the others may be forbidden, and then there is a sentence."""
    assert ("landlock" in WORKING) == (NEWEST > 0 and seccomp.this_machine() is not None)
    for backend in sandbox.BACKENDS:
        monkeypatch.setenv(sandbox.CHOICE, backend.name)
        status = sandbox.probe()
        assert status.works == (backend.name in WORKING)
        assert bool(status.reason) != status.works


def test_an_older_kernel_is_as_safe_with_daemons(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without signals that end at the domain, those that daemonise are ended one by one."""
    monkeypatch.setenv(sandbox.CHOICE, "landlock")
    monkeypatch.setattr(landlock, "version", lambda: min(NEWEST, 1))
    marker = f"preflight-{uuid.uuid4()}"
    body = """
    import os, signal, sys, time
    for _ in range(5):
        if os.fork() == 0:
            os.setsid()
            signal.signal(signal.SIGTERM, signal.SIG_IGN)
            if os.fork() == 0:
                time.sleep(60)
            os._exit(0)
    os.wait()
    sys.exit(3)
    """
    found = trace(write_node(tmp_path, body), args=(marker,))
    assert found.outcome.exit_code == (3 if NEWEST else None)
    assert processes_with(marker) == []


def test_what_may_be_read_is_all_but_what_is_hidden(tmp_path: Path) -> None:
    secret = "/etc/passwd"
    view = View(("/tmp", "/var/tmp", "/run"), (secret,), (str(tmp_path),), "/root", AGENTS)
    listed, _ = landlock.readable(view)

    def allowed(path: str) -> bool:
        return any(path == each or path.startswith(each + "/") for each in listed)

    assert allowed("/usr/bin/python3")
    assert allowed(str(tmp_path / "x"))
    assert allowed("/etc/hostname")
    assert not any(allowed(path) for path in (secret, "/tmp/x", "/var/tmp/x", "/run/x", "/dev/mem"))
    assert "/" not in listed
