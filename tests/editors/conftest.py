from __future__ import annotations

from pathlib import Path

import pytest
from editor_desk import Desk, lay_desk


@pytest.fixture
def trusted_desk(tmp_path: Path) -> Desk:
    """The demo in the folder that docs/neovim.md takes for trusted."""
    return lay_desk(tmp_path, "catkin_ws")


@pytest.fixture
def untrusted_desk(tmp_path: Path) -> Desk:
    return lay_desk(tmp_path, "downloads")
