"""A home folder with the demo for each test of the server."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.editor_harness import Harness, create_harness


@pytest.fixture
def harness(tmp_path: Path) -> Harness:
    return create_harness(tmp_path, "workspace", server_on_path=True)
