"""The command as installed, in a home folder with the demo."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from support.command import Done, run_command
from support.editor_harness import Harness, create_harness


@pytest.fixture
def harness(tmp_path: Path) -> Harness:
    return create_harness(tmp_path, "workspace", server_on_path=True)


@pytest.fixture
def preflight(harness: Harness) -> Callable[..., Done]:
    def run(
        *arguments: str | Path, cwd: Path | None = None, environment: dict[str, str] | None = None, typed: str = ""
    ) -> Done:
        variables = {**harness.environment, **(environment or {})}
        return run_command(harness.server, *arguments, environment=variables, cwd=cwd or harness.workspace, typed=typed)

    return run
