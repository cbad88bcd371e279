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
)


@pytest.fixture(scope="session")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A package with the node of `roscpp_node.cpp`."""
    folder = tmp_path_factory.mktemp("packages") / "compiled"
    folder.mkdir()
    (folder / "package.xml").write_text('<package format="2"><name>compiled</name></package>')
    source = Path(__file__).parent / "roscpp_node.cpp"
    command = ["g++", "-w", str(source), "-o", str(folder / "node"), *(f"-l{name}" for name in LIBRARIES)]
    subprocess.run(command, check=True)
    return folder


@pytest.fixture(scope="session")
def node(package: Path) -> Path:
    """The node itself."""
    return package / "node"
