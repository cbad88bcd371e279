"""A second `/proc` on the host, as chroots have one: it would be a way out to all of the host's processes."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from preflight_analysis.tracing import mounts
from support.tracing_harness import working_backends

pytestmark = pytest.mark.ros

PROGRAM = """
import json, subprocess, sys
from pathlib import Path
sys.path.insert(0, {tests!r})
from preflight_analysis.tracing import sandbox
from support.tracing_harness import trace, write_node
workspace, outside = map(Path, sys.argv[1:3])
places = [workspace / "chroot/proc", outside / "proc 2", workspace / "chroot/sys", workspace / "chroot/sys/kernel"]
for place, kind in zip(places, ("proc", "proc", "sysfs", "proc")):
    place.mkdir(parents=True, exist_ok=True)
    subprocess.run(["mount", "-t", kind, kind, place], check=True)
node = '''
import json, os, sys
seen = {{}}
for place in sys.argv[1:5]:
    try:
        seen[place] = [name for name in os.listdir(place) if name.isdigit() or name in ("self", "kernel")]
    except OSError as error:
        seen[place] = []
print("seen " + json.dumps(seen), file=sys.stderr)
print("own " + str(os.path.exists("/proc/self/status")), file=sys.stderr)
'''
assert all(any(place.iterdir()) for place in places)
print(json.dumps(trace(write_node(workspace, node), args=tuple(map(str, places))).outcome.stderr_tail))
"""


@pytest.mark.parametrize("backend", working_backends())
def test_a_second_proc_is_hidden(tmp_path: Path, backend: str) -> None:
    """In the workspace, which is shown, and where nothing else hides it."""
    outside = Path("/opt") / f"ros-preflight-{os.getpid()}-{backend}"
    workspace = tmp_path / "workspace"
    workspace.mkdir()
    # In a mount name space of its own, so that nothing of it is left behind.
    done = subprocess.run(
        ["unshare", "--mount", "--propagation", "private", sys.executable, "-c",
         PROGRAM.format(tests=str(Path(__file__).parents[1])), workspace, outside],
        capture_output=True, text=True, env={**os.environ, "ROS_PREFLIGHT_SANDBOX": backend}, check=False,
    )  # fmt: skip
    for place in (outside / "proc 2", outside):
        if place.exists():
            place.rmdir()
    assert done.returncode == 0, done.stderr
    told = dict(line.split(" ", 1) for line in json.loads(done.stdout) if line.startswith(("seen ", "own ")))
    assert told.get("own") == "True", done.stdout
    seen = json.loads(told["seen"])
    assert len(seen) == 4
    assert [place for place, names in seen.items() if names] == []


def test_what_the_kernel_says_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As proc(5) has it: any number of optional fields, and characters of names as octal numbers."""
    for name in ("a b/within", "home/w/proc", "c"):
        (tmp_path / name).mkdir(parents=True)
    table = tmp_path / "mountinfo"
    table.write_text(
        "1 0 0:1 / /proc rw - proc proc rw\n"
        "2 0 0:2 / /sys/fs/cgroup/cpu rw shared:3 - cgroup cgroup rw\n"
        f"3 0 0:3 / {tmp_path}/a\\040b rw shared:1 master:2 - proc proc rw\n"
        f"4 0 0:4 / {tmp_path}/home/w/proc rw - cgroup2 none rw\n"
        f"5 0 0:5 / {tmp_path}/c rw - ext4 /dev/vda rw\n"
        f"6 0 0:6 / {tmp_path}/gone rw - proc proc rw\n"
        f"7 0 0:7 / {tmp_path}/a\\040b/within rw - cgroup cgroup rw\n"
    )
    monkeypatch.setattr(mounts, "_TABLE", table)
    monkeypatch.setattr(mounts, "_DEVICES", tmp_path / "sys")
    home = f"{tmp_path}/home"
    assert mounts.leading_out([], [home]) == [f"{tmp_path}/a b"]
    (tmp_path / "link").symlink_to(f"{home}/w")
    assert mounts.leading_out([f"{tmp_path}/link"], [home]) == [f"{tmp_path}/a b", f"{tmp_path}/link/proc"]


def test_what_names_the_machine_is_hidden_wherever_it_lies(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As sysfs has it: a class has links to its devices, each in a folder of that class below what it is part of."""
    devices = tmp_path / "sys"
    for kind, place in (("net", "pci0/net/eth0"), ("net", "virtual/net/lo"), ("dmi", "virtual/dmi/id")):
        (devices / "devices" / place).mkdir(parents=True)
        (devices / "class" / kind).mkdir(parents=True, exist_ok=True)
        (devices / "class" / kind / Path(place).name).symlink_to(devices / "devices" / place)
    monkeypatch.setattr(mounts, "_DEVICES", devices)
    monkeypatch.setattr(mounts, "_TABLE", Path(os.devnull))
    hidden = ["class/dmi", "class/net", "devices/pci0/net", "devices/virtual/dmi", "devices/virtual/net"]
    assert mounts.leading_out([], []) == [f"{devices}/{path}" for path in hidden]
