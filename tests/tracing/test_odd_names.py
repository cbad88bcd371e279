"""What is hidden stays hidden whatever its name is; a workspace whose name a sandbox does not take is not run."""

from __future__ import annotations

import socket
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, closing
from pathlib import Path

import pytest
from support.tracing_harness import trace, write_node

pytestmark = pytest.mark.ros

ODD = ("plain", "a blank", "quo'te", 'dou"ble', "[a]", "st*r", "wh?t", "per%0Acent", "ha#sh", "line\nbreak", "-dash")
ODD += (
    "a",
    "com,ma",
    "${HOME}",
    "back\\slash",
    "esc\x1b[31m",
    "right\u202eleft",
    "\udcff",
    "..two",
    "{a,b}",
    "~",
    "!x",
    "a;b&c",
)

NODE = """
import os, socket, sys
reached = []
for place, folders, files in os.walk(os.path.dirname(os.path.abspath(__file__))):
    for name in files + folders:
        path = os.path.join(place, name)
        try:
            with socket.socket(socket.AF_UNIX) as end:
                end.connect(path)
            reached.append(path)
        except (OSError, ValueError):
            pass
        if name == "config":
            try:
                reached.append(open(path).read())
            except OSError:
                pass
print("reached", ascii(reached), file=sys.stderr)
sys.exit(3)
"""


@pytest.fixture
def folder() -> Iterator[Path]:
    """One with a short path, as those of sockets are."""
    with tempfile.TemporaryDirectory(prefix="pf-", dir="/tmp") as made:
        yield Path(made)


@pytest.mark.usefixtures("each_backend")
def test_sockets_and_repositories_with_odd_names_are_hidden(folder: Path) -> None:
    with ExitStack() as at_end:
        for name in ODD:
            (folder / name / ".git").mkdir(parents=True)
            (folder / name / ".git/config").write_text("token")
            end = at_end.enter_context(closing(socket.socket(socket.AF_UNIX)))
            end.bind(str(folder / name / f"s{name}"))
            end.listen()
        outcome = trace(write_node(folder, NODE)).outcome
    assert (outcome.exit_code, outcome.stderr_tail[-1:]) == (3, ("reached []",)), outcome


@pytest.mark.parametrize(
    "name", ["a blank quo'te", "[a] st*r", "per%0Acent,", "line\nbreak", "-dash", "\udcff", "..two"]
)
def test_a_workspace_with_an_odd_name(folder: Path, each_backend: str, name: str) -> None:
    workspace = folder / name
    (workspace / ".git").mkdir(parents=True)
    (workspace / ".git/config").write_text("token")
    outcome = trace(write_node(workspace, NODE, f"{name}.py")).outcome
    if each_backend == "firejail" and outcome.status == "not-run":
        assert "is an invalid filename" in str(outcome.reason)
    else:
        assert (outcome.exit_code, outcome.stderr_tail[-1:]) == (3, ("reached []",)), outcome
