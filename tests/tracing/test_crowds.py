"""Too many processes and too much memory.

Every node here is bounded by itself too: it stops after some dozen processes, all asleep, whether or not a limit holds.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest
from preflight_analysis.tracing import cgroup, sandbox
from support.tracing_harness import trace, write_node

pytestmark = pytest.mark.ros

FEW = 24
MANY = 60

CROWD = f"""
import os, sys, time
count = 0
try:
    while count < {MANY}:
        if os.fork() == 0:
            time.sleep(5)
            os._exit(0)
        count += 1
except OSError as error:
    print(count, error.strerror, file=sys.stderr)
    sys.exit(3)
time.sleep(4)
sys.exit(4)
"""


@pytest.fixture
def few(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sandbox, "PROCESSES", FEW)


def counted(backend: str) -> bool:
    """Whether RLIMIT_NPROC does not bind: not root, and only as far as processes are counted apart from the user's."""
    return os.getuid() == 0 or backend != "bubblewrap"


def test_the_number_of_processes_is_bounded(tmp_path: Path, few: None, each_backend: str) -> None:
    """By whatever there is on this machine; with a control group or RLIMIT_NPROC the node sees its forks fail."""
    found = trace(write_node(tmp_path, CROWD))
    if cgroup.place() is None and counted(each_backend):
        assert found.outcome.reason == f"it started more than {FEW} processes and was stopped"
    else:
        assert found.outcome.exit_code == 3, found.outcome
        count, _, why = found.outcome.stderr_tail[-1].partition(" ")
        assert why == "Resource temporarily unavailable"
        assert int(count) < FEW


def test_without_a_limit_from_outside_the_supervisor_ends_a_crowd(
    tmp_path: Path, few: None, each_backend: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cgroup, "place", lambda: None)
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    body = CROWD.replace("os.fork() == 0", "os.fork() == 0 and os.setsid() is None")
    began = time.monotonic()
    found = trace(write_node(tmp_path, body))
    if counted(each_backend):
        expected = f"it started more than {FEW} processes and was stopped"
        assert (found.outcome.status, found.outcome.reason) == ("crashed", expected)
        assert time.monotonic() - began < 30
    else:
        assert found.outcome.exit_code == 3, "RLIMIT_NPROC came first"


def test_threads_count_too(tmp_path: Path, few: None, each_backend: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cgroup, "place", lambda: None)
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    body = f"""
    import threading, time
    for _ in range({MANY}):
        threading.Thread(target=time.sleep, args=(4,), daemon=True).start()
    time.sleep(4)
    """
    outcome = trace(write_node(tmp_path, body)).outcome
    if counted(each_backend):
        assert outcome.reason == f"it started more than {FEW} processes and was stopped"
    else:
        assert "can't start new thread" in outcome.stderr_tail[-1]


SHARES = """
import os, sys, time
block = b"x" * ({before} << 20)
for _ in range(3):
    if os.fork() == 0:
        block = b"y" * ({after} << 20) if {after} else block
        time.sleep({stay})
        os._exit(0)
time.sleep({stay})
sys.exit(4)
"""


@pytest.mark.usefixtures("each_backend")
def test_memory_of_all_processes_together_is_bounded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Three of 50 MB each, none of them too large by itself."""
    monkeypatch.setattr(sandbox, "MEMORY_BYTES", 100 << 20)
    began = time.monotonic()
    outcome = trace(write_node(tmp_path, SHARES.format(before=0, after=50, stay=4))).outcome
    assert (outcome.status, outcome.reason) == ("crashed", "it took more than 0.1 GiB of memory and was stopped")
    assert time.monotonic() - began < 30


def test_memory_that_processes_share_counts_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sandbox, "MEMORY_BYTES", 100 << 20)
    assert trace(write_node(tmp_path, SHARES.format(before=50, after=0, stay=1))).outcome.exit_code == 4


@pytest.mark.usefixtures("each_backend")
def test_the_node_is_the_first_to_go_when_memory_ends(tmp_path: Path) -> None:
    body = "import sys\nprint(open('/proc/self/oom_score_adj').read(), file=sys.stderr)\n"
    assert trace(write_node(tmp_path, body)).outcome.stderr_tail[-1] == "1000"


@pytest.mark.usefixtures("each_backend")
def test_no_group_is_left_behind(tmp_path: Path) -> None:
    place = cgroup.place()
    trace(write_node(tmp_path, "pass\n"))
    if place is not None:
        assert list(place.folder.glob(f"ros-preflight-{os.getpid()}-*")) == []


CGROUP_2 = """25 1 0:22 / /proc rw - proc proc rw
30 1 0:26 {root} {top} rw,nosuid - cgroup2 cgroup2 rw,nsdelegate
"""


def hand_down(folder: Path, controllers: str) -> None:
    folder.mkdir(exist_ok=True)
    (folder / "cgroup.subtree_control").write_text(controllers)


def test_version_2_takes_the_nearest_group_that_hands_the_controller_down(tmp_path: Path) -> None:
    hand_down(tmp_path, "cpu memory pids")
    hand_down(tmp_path / "user", "memory pids")
    hand_down(tmp_path / "user/session", "")
    mounts = CGROUP_2.format(root="/", top=tmp_path)
    found = list(cgroup.candidates("0::/user/session\n", mounts))
    assert found == [cgroup.Place(tmp_path / "user", True), cgroup.Place(tmp_path, True)]


def test_version_2_in_a_container_never_leaves_what_is_mounted(tmp_path: Path) -> None:
    hand_down(tmp_path, "")
    assert list(cgroup.candidates("0::/\n", CGROUP_2.format(root="/", top=tmp_path))) == []
    hand_down(tmp_path, "pids")
    assert list(cgroup.candidates("0::/../other\n", CGROUP_2.format(root="/", top=tmp_path))) == []
    mounts = CGROUP_2.format(root="/docker/1", top=tmp_path)
    assert list(cgroup.candidates("0::/docker/1\n", mounts)) == [cgroup.Place(tmp_path, False)]


def test_version_1_is_the_group_of_the_pids_controller(tmp_path: Path) -> None:
    mounts = f"31 1 0:27 / {tmp_path} rw - cgroup cgroup rw,pids\n"
    found = list(cgroup.candidates("8:pids:/ci/job\n4:memory:/ci\n0::/\n", mounts))
    assert found == [cgroup.Place(tmp_path / "ci/job", False)]


def test_a_group_gets_its_limits_before_anything_enters_it(tmp_path: Path) -> None:
    class Kept(Exception):
        pass

    with pytest.raises(Kept), cgroup.group(cgroup.Place(tmp_path, memory=True), 7, 9000) as folder:
        assert (folder / "pids.max").read_text() == "7"
        assert (folder / "memory.max").read_text() == "9000"
        line = cgroup.entering(folder, ["/bin/sh", "-c", "echo $0 $$", "word"])
        said = subprocess.run(line, capture_output=True, text=True, check=True).stdout.split()
        assert said == ["word", (folder / "cgroup.procs").read_text().strip()]
        raise Kept


def test_what_cannot_enter_its_group_does_not_run(tmp_path: Path) -> None:
    line = cgroup.entering(tmp_path / "missing", [sys.executable, "-c", f"open({str(tmp_path / 'ran')!r}, 'w')"])
    assert subprocess.run(line, capture_output=True, check=False).returncode != 0
    assert not (tmp_path / "ran").exists()
