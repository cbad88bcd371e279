"""A desk with the demo for each test of the server."""

from __future__ import annotations

from pathlib import Path

import pytest
from editor_desk import Desk, lay_desk


@pytest.fixture
def desk(tmp_path: Path) -> Desk:
    return lay_desk(tmp_path, "workspace", server_on_path=True)
