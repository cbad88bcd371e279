from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from support.editor_harness import Harness, create_harness
from support.waiting import until


@contextmanager
def harness(workspace_name: str, *, server_on_path: bool = True) -> Iterator[Harness]:
    # Not tmp_path: browsers make sockets in their home, and the path of a socket has at most 107 characters.
    with tempfile.TemporaryDirectory(prefix="editor-") as folder:
        created = create_harness(Path(folder), workspace_name, server_on_path=server_on_path)
        yield created
        until(lambda: created.processes() == [], why="the editor left processes running")


@pytest.fixture
def trusted_harness() -> Iterator[Harness]:
    """The demo in the folder that docs/neovim.md takes for trusted."""
    with harness("catkin_ws") as created:
        yield created


@pytest.fixture
def untrusted_harness() -> Iterator[Harness]:
    with harness("downloads") as created:
        yield created


@pytest.fixture
def harness_without_server() -> Iterator[Harness]:
    """The command `ros-preflight` is not on PATH, and what it needs cannot be fetched."""
    with harness("catkin_ws", server_on_path=False) as created:
        created.environment.update({"PIP_NO_INDEX": "1", "PIP_CONFIG_FILE": os.devnull})
        yield created
