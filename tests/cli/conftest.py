"""The command as installed, at a desk with the demo."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from editor_desk import Desk, lay_desk


@dataclass(frozen=True)
class Done:
    code: int
    out: str
    err: str

    @property
    def json(self) -> Any:
        """Standard output as the one JSON document that it must be."""
        assert self.out == json.dumps(json.loads(self.out), sort_keys=True, indent=2, ensure_ascii=False) + "\n"
        return json.loads(self.out)


@pytest.fixture
def desk(tmp_path: Path) -> Desk:
    return lay_desk(tmp_path, "workspace", server_on_path=True)


@pytest.fixture
def preflight(desk: Desk) -> Callable[..., Done]:
    def run(*arguments: str | Path, cwd: Path | None = None, environment: dict[str, str] | None = None) -> Done:
        done = subprocess.run(
            [str(desk.server), *map(str, arguments)],
            cwd=cwd or desk.workspace,
            env={**desk.environment, **(environment or {})},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )
        assert "Traceback" not in done.stderr, done.stderr
        return Done(done.returncode, done.stdout, done.stderr)

    return run
