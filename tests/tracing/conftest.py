"""Nodes in C++, compiled once; and the ways to isolate that work on this machine, for tests that hold with each."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest
from preflight_analysis.tracing import sandbox
from support.build_once import build_once
from support.tracing_harness import known_backends

LIBRARIES = (
    "actionlib",
    "roscpp",
    "rostime",
    "roscpp_serialization",
    "rosconsole",
    "boost_system",
    "boost_thread",
    "pthread",
    "tf",
    "tf2_ros",
    "tf2",
)


@pytest.fixture(scope="session")
def package() -> Path:
    """A package with the nodes of `roscpp_node.cpp` and `roscpp_waits.cpp`."""
    return build_once("packages", lambda folder: _compile(folder / "compiled")) / "compiled"


def _compile(folder: Path) -> None:
    folder.mkdir()
    (folder / "package.xml").write_text('<package format="2"><name>compiled</name></package>')
    for name, source in (("node", "roscpp_node.cpp"), ("waits", "roscpp_waits.cpp")):
        command = ["g++", "-w", str(Path(__file__).parent / source), "-o", str(folder / name)]
        subprocess.run([*command, *(f"-l{library}" for library in LIBRARIES)], check=True)


@pytest.fixture(scope="session")
def node(package: Path) -> Path:
    """The first of them."""
    return package / "node"


@pytest.fixture(params=known_backends())
def each_backend(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    """Has runs isolated by one of them."""
    name: str = request.param
    monkeypatch.setenv(sandbox.CHOICE, name)
    return name


@pytest.fixture(autouse=True)
def first_choice(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Has runs isolated by what is tried first, whatever the user's environment says."""
    if "each_backend" not in request.fixturenames and sandbox.CHOICE in os.environ:
        monkeypatch.delenv(sandbox.CHOICE)
