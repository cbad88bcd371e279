"""The command as installed, in a home folder with the demo."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from support.editor_harness import Harness, create_harness


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
def harness(tmp_path: Path) -> Harness:
    return create_harness(tmp_path, "workspace", server_on_path=True)


@pytest.fixture
def preflight(harness: Harness) -> Callable[..., Done]:
    def run(*arguments: str | Path, cwd: Path | None = None, environment: dict[str, str] | None = None) -> Done:
        done = subprocess.run(
            [str(harness.server), *map(str, arguments)],
            cwd=cwd or harness.workspace,
            env={**harness.environment, **(environment or {})},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )
        assert "Traceback" not in done.stderr, done.stderr
        return Done(done.returncode, done.stdout, done.stderr)

    return run
