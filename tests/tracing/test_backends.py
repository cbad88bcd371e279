"""What each way to isolate does against the same hostile node (`attacks.py`), and that docs/security.md says so."""

from __future__ import annotations

import os
import socket
import tempfile
import threading
import uuid
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, closing
from pathlib import Path

import pytest
from preflight_analysis.tracing import landlock, run, sandbox, seccomp
from preflight_analysis.tracing.backend import AGENTS, View
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.trace import Tracer
from support.tracing_harness import (
    environment,
    known_backends,
    own,
    processes_with,
    request,
    trace,
    working_backends,
    write_node,
)
from support.waiting import until
from tools import attacks

pytestmark = pytest.mark.ros

NEWEST = landlock.version()
WORKING = known_backends()
OLDER = [("landlock", version) for version in (1, 3, 5) if version < NEWEST]
"""As if the kernel had an older Landlock: with less of it, the rest must keep the same."""


@pytest.mark.parametrize(("backend", "version"), [*((name, NEWEST) for name in WORKING), *OLDER])
def test_every_attempt_ends_as_the_documentation_says(
    tmp_path: Path, backend: str, version: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(sandbox.CHOICE, backend)
    monkeypatch.setattr(landlock, "version", lambda: version)
    assert attacks.wrong(attacks.attack(tmp_path), backend) == {}


def test_the_same_holds_for_root_and_for_a_user() -> None:
    """In a mount name space with a second procfs, by each backend that works here. Only root can be both."""
    found = attacks.everyone()
    is_root = os.geteuid() == 0
    assert set(found) == (set(attacks.IDENTITIES) if is_root else {"user"})
    cases = {case for case in attacks.documented() if is_root or not case.startswith("second-")}
    for who, backends in found.items():
        for backend in WORKING:
            assert backends[backend].keys() == cases, (who, backend, backends[backend].get(""))
            assert attacks.wrong(backends[backend], backend) == {}, (who, backend)


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
    until(lambda: processes_with(marker) == [])


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
