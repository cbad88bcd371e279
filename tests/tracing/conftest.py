"""Nodes in C++, compiled once."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

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
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A package with the nodes of `roscpp_node.cpp` and `roscpp_waits.cpp`."""
    folder = tmp_path_factory.mktemp("packages") / "compiled"
    folder.mkdir()
    (folder / "package.xml").write_text('<package format="2"><name>compiled</name></package>')
    for name, source in (("node", "roscpp_node.cpp"), ("waits", "roscpp_waits.cpp")):
        command = ["g++", "-w", str(Path(__file__).parent / source), "-o", str(folder / name)]
        subprocess.run([*command, *(f"-l{library}" for library in LIBRARIES)], check=True)
    return folder


@pytest.fixture(scope="session")
def node(package: Path) -> Path:
    """The first of them."""
    return package / "node"
