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
from tools import attacks

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
    if not any(each.processes for each in cgroup.places()) and counted(each_backend):
        assert found.outcome.reason == f"it started more than {FEW} processes and was stopped"
    else:
        assert found.outcome.exit_code == 3, found.outcome
        count, _, why = found.outcome.stderr_tail[-1].partition(" ")
        assert why == "Resource temporarily unavailable"
        assert int(count) < FEW


def test_without_a_limit_from_outside_the_supervisor_ends_a_crowd(
    tmp_path: Path, few: None, each_backend: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cgroup, "places", lambda: ())
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
    monkeypatch.setattr(cgroup, "places", lambda: ())
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


@pytest.mark.parametrize("what", attacks.GREED)
def test_without_a_control_group_every_kind_of_memory_counts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, each_backend: str, what: str
) -> None:
    """And the user's instances of inotify."""
    monkeypatch.setattr(cgroup, "places", lambda: ())
    assert attacks.take(tmp_path, what) in attacks.documented()[what][each_backend]


def test_memory_that_processes_share_counts_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sandbox, "MEMORY_BYTES", 100 << 20)
    assert trace(write_node(tmp_path, SHARES.format(before=50, after=0, stay=1))).outcome.exit_code == 4


@pytest.mark.usefixtures("each_backend")
def test_the_node_is_the_first_to_go_when_memory_ends(tmp_path: Path) -> None:
    body = "import sys\nprint(open('/proc/self/oom_score_adj').read(), file=sys.stderr)\n"
    assert trace(write_node(tmp_path, body)).outcome.stderr_tail[-1] == "1000"


@pytest.mark.usefixtures("each_backend")
def test_no_group_is_left_behind(tmp_path: Path) -> None:
    places = cgroup.places()
    trace(write_node(tmp_path, "pass\n"))
    for place in places:
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
    assert found == [cgroup.Place(tmp_path / "user", True, True, 2), cgroup.Place(tmp_path, True, True, 2)]


def test_version_2_in_a_container_never_leaves_what_is_mounted(tmp_path: Path) -> None:
    hand_down(tmp_path, "")
    assert list(cgroup.candidates("0::/\n", CGROUP_2.format(root="/", top=tmp_path))) == []
    hand_down(tmp_path, "pids")
    assert list(cgroup.candidates("0::/../other\n", CGROUP_2.format(root="/", top=tmp_path))) == []
    mounts = CGROUP_2.format(root="/docker/1", top=tmp_path)
    assert list(cgroup.candidates("0::/docker/1\n", mounts)) == [cgroup.Place(tmp_path, True, False, 2)]


def test_version_1_has_a_group_for_each_controller(tmp_path: Path) -> None:
    mounts = (
        f"31 1 0:27 / {tmp_path}/pids rw - cgroup cgroup rw,pids\n"
        f"32 1 0:28 /ci {tmp_path}/memory rw - cgroup cgroup rw,memory\n"
        f"33 1 0:29 / {tmp_path}/cpu rw - cgroup cgroup rw,cpu\n"
    )
    found = list(cgroup.candidates("9:cpu:/\n8:pids:/ci/job\n4:memory:/ci\n0::/\n", mounts))
    assert found == [
        cgroup.Place(tmp_path / "pids/ci/job", True, False, 1),
        cgroup.Place(tmp_path / "memory", False, True, 1),
    ]


def test_a_group_gets_its_limits_before_anything_enters_it(tmp_path: Path) -> None:
    class Kept(Exception):
        pass

    places = [cgroup.Place(tmp_path, True, True, 2), cgroup.Place(tmp_path, False, True, 1)]
    with pytest.raises(Kept), cgroup.groups(places, 7, 9000) as made:
        newer, older = made
        assert [(newer / name).read_text() for name in ("pids.max", "memory.max", "memory.swap.max")] == [
            "7", "9000", "0",
        ]  # fmt: skip
        assert {path.name: path.read_text() for path in older.iterdir()} == {
            "memory.limit_in_bytes": "9000",
            "memory.memsw.limit_in_bytes": "9000",
        }
        line = cgroup.entering(made, ["/bin/sh", "-c", "echo $0 $$", "word"])
        said = subprocess.run(line, capture_output=True, text=True, check=True).stdout.split()
        assert said[0] == "word"
        assert [(folder / "cgroup.procs").read_text().strip() for folder in made] == [said[1]] * 2
        raise Kept


@pytest.mark.parametrize(("name", "text", "so"), [
    ("memory.events", "low 0\noom 1\noom_kill 1\n", True),
    ("memory.events", "low 0\noom 1\noom_kill 0\n", False),
    ("memory.oom_control", "oom_kill_disable 0\nunder_oom 0\noom_kill 2\n", True),
    ("pids.events", "max 3\n", False),
])  # fmt: skip
def test_a_group_says_whether_its_memory_ran_out(tmp_path: Path, name: str, text: str, so: bool) -> None:
    (tmp_path / name).write_text(text)
    assert cgroup.ran_out([tmp_path]) == so


def test_what_cannot_enter_its_group_does_not_run(tmp_path: Path) -> None:
    line = cgroup.entering([tmp_path / "missing"], [sys.executable, "-c", f"open({str(tmp_path / 'ran')!r}, 'w')"])
    assert subprocess.run(line, capture_output=True, check=False).returncode != 0
    assert not (tmp_path / "ran").exists()
