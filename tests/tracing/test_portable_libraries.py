"""The libraries of a wheel: for older systems than this one, and for another processor."""

from __future__ import annotations

import os
import platform
import re
import subprocess
from pathlib import Path

import pytest
from preflight_analysis.tracing import preload_compile
from preflight_analysis.tracing.preload_compile import MACHINES, RCL, ROSCPP, WATCHED, Watched
from support.build_once import build_once

# Of Ubuntu 16.04, where ROS Kinetic is, and of 22.04, where Humble is.
NEWEST = {
    ROSCPP: {"GLIBC": (2, 23), "GLIBCXX": (3, 4, 21), "CXXABI": (1, 3, 9), "GCC": (4, 2, 0)},
    RCL: {"GLIBC": (2, 35), "GLIBCXX": (3, 4, 30), "CXXABI": (1, 3, 13), "GCC": (12, 0, 0)},
}
pytestmark = pytest.mark.ros

READER = '#include <stdio.h>\nint main(int n, char** words) { return fopen(words[n - 1], "r") == NULL; }\n'


def portable(watched: Watched, machine: str) -> Path:
    """The library as it is made for a wheel."""
    name = watched.prebuilt(machine).name

    def compiled(folder: Path) -> None:
        compiler = preload_compile.compiler(machine)
        assert compiler is not None
        preload_compile.compile_library(compiler, watched, folder / name, portable=True)

    return build_once(f"portable-{name}", compiled) / name


@pytest.mark.parametrize("machine", MACHINES)
@pytest.mark.parametrize("watched", WATCHED, ids=lambda watched: watched.name)
def test_a_library_for_other_machines_needs_old_versions_only(watched: Watched, machine: str) -> None:
    tool = "objdump" if machine == platform.machine() else f"{machine}-linux-gnu-objdump"
    library = portable(watched, machine)
    shown = subprocess.run([tool, "-T", library], capture_output=True, text=True, check=True).stdout
    needed = {(name, tuple(map(int, version.split(".")))) for name, version in re.findall(r"\((\w+)_([\d.]+)\)", shown)}
    assert {name for name, _ in needed} == set(NEWEST[watched])
    assert [(name, version) for name, version in needed if version > NEWEST[watched][name]] == []


@pytest.mark.parametrize("watched", WATCHED, ids=lambda watched: watched.name)
def test_a_program_of_arm64_is_watched(watched: Watched, tmp_path: Path) -> None:
    (tmp_path / "reader.c").write_text(READER)
    (tmp_path / "read.yaml").touch()
    subprocess.run(["aarch64-linux-gnu-gcc", "reader.c", "-o", "reader"], cwd=tmp_path, check=True)
    os.mkfifo(tmp_path / "events")
    events = os.open(tmp_path / "events", os.O_RDWR | os.O_NONBLOCK)
    variables = {"LD_PRELOAD": str(portable(watched, "aarch64")), "PREFLIGHT_EVENTS": str(tmp_path / "events")}
    given = [word for name, value in variables.items() for word in ("-E", f"{name}={value}")]
    done = subprocess.run(
        # The C library is that of the cross compiler.
        ["qemu-aarch64-static", "-L", "/usr/aarch64-linux-gnu", *given, tmp_path / "reader", tmp_path / "read.yaml"],
        capture_output=True,
        check=False,
        timeout=60,
    )
    assert (done.returncode, done.stderr) == (0, b"")
    assert f'{{"ev":"files","paths":["{tmp_path / "read.yaml"}"]}}\n' in os.read(events, 65536).decode()
    os.close(events)
