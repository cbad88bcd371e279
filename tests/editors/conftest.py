from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from editor_desk import Desk, lay_desk


@contextmanager
def desk(workspace_name: str, *, server_on_path: bool = True) -> Iterator[Desk]:
    # Not tmp_path: browsers make sockets in their home, and the path of a socket has at most 107 characters.
    with tempfile.TemporaryDirectory(prefix="desk-") as folder:
        laid = lay_desk(Path(folder), workspace_name, server_on_path=server_on_path)
        yield laid
        deadline = time.monotonic() + 20
        while laid.processes() and time.monotonic() < deadline:
            time.sleep(0.1)
        assert laid.processes() == [], "the editor left these running"


@pytest.fixture
def trusted_desk() -> Iterator[Desk]:
    """The demo in the folder that docs/neovim.md takes for trusted."""
    with desk("catkin_ws") as laid:
        yield laid


@pytest.fixture
def untrusted_desk() -> Iterator[Desk]:
    with desk("downloads") as laid:
        yield laid


@pytest.fixture
def desk_without_server() -> Iterator[Desk]:
    """The command `ros-preflight` is not on PATH, and what it needs cannot be fetched."""
    with desk("catkin_ws", server_on_path=False) as laid:
        laid.environment.update({"PIP_NO_INDEX": "1", "PIP_CONFIG_FILE": os.devnull})
        yield laid
