"""Helpers for the tests of tracing: an environment, nodes written on the spot, runs."""

from __future__ import annotations

import contextlib
import os
import tempfile
import textwrap
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing import sandbox
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.dependencies import Dependencies
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.node_recipe import make
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.trace import Tracer

from support.build_once import build_once

ROS1_FIXTURES = Path(__file__).parents[2] / "fixtures" / "ros1"
SYSTEM_PYTHON = "/usr/bin/python3"


def environment(*package_path: Path, variables: dict[str, str] | None = None) -> Environment:
    """Debian's ROS 1 with these folders on the package path."""
    paths = tuple(str(p) for p in package_path) or (str(ROS1_FIXTURES),)
    given = {"PATH": "/usr/bin:/bin", "ROS_PACKAGE_PATH": os.pathsep.join(paths), "ROS_DISTRO": "noetic"}
    return Environment(
        1, "noetic", given | (variables or {}), paths, {}, {}, (), ("/usr",), SYSTEM_PYTHON, named_folders=paths
    )


def working_backends() -> list[str]:
    """The ways to isolate that work on this machine. `test_backends.py` says which must be among them."""
    found = []
    with pytest.MonkeyPatch.context() as patch:
        for backend in sandbox.BACKENDS:
            patch.setenv(sandbox.CHOICE, backend.name)
            if sandbox.probe().works:
                found.append(backend.name)
    return found


def known_backends() -> list[str]:
    """The same, asked once for all processes of a test run: each has to collect the same tests."""
    folder = build_once("backends", lambda folder: (folder / "names").write_text("\n".join(working_backends())))
    return (folder / "names").read_text().split()


def write_node(folder: Path, body: str, name: str = "node.py") -> Path:
    """An executable Python script."""
    path = folder / name
    path.write_text("#!/usr/bin/env python3\n" + textwrap.dedent(body))
    path.chmod(0o755)
    return path


def request(executable: Path, node: str = "/node", **more: Any) -> TraceRequest:
    """A request for a node of package `pkg`."""
    return TraceRequest(node, "pkg", str(executable), **more)


def trace(executable: Path, node: str = "/node", *, variables: dict[str, str] | None = None, **more: Any) -> Interface:
    """Run a node that lies in a folder of the package path, without cache."""
    tracer = Tracer(environment(executable.parent, variables=variables), None)
    return tracer.trace(request(executable, node, **more), threading.Event())


def own(interface: Interface) -> set[tuple[str, str, str | None]]:
    """Role, name and type of what the node made itself."""
    return {(e.role, e.name, e.type) for e in interface.endpoints if not e.builtin}


@contextlib.contextmanager
def planted_key() -> Iterator[Path]:
    """A key in a folder of the home folder, which is removed afterwards."""
    folder = Path(tempfile.mkdtemp(prefix=".preflight-planted-", dir=Path.home()))
    key = folder / "id_ed25519"
    key.write_text("PRIVATE KEY")
    yield key
    key.unlink()
    folder.rmdir()


def processes_with(marker: str) -> list[str]:
    """Command lines of running processes that contain `marker`."""
    found = []
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            line = path.read_bytes().replace(b"\0", b" ").decode(errors="replace")
        except OSError:
            continue
        if marker in line:
            found.append(line)
    return found


def hammer_cache(folder: str, script: str, package: str, interface: Interface, rounds: int) -> None:
    """Store and load one entry again and again; for several processes at once (spawned ones import this module)."""
    cache = TraceCache(Path(folder))
    asked = request(Path(script))
    recipe = make(environment(Path(package)), asked)
    for _ in range(rounds):
        assert cache.store(recipe, asked, interface, Dependencies(), started=time.time())
        assert cache.load(recipe, asked) is not None
