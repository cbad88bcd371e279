"""The command as installed, run to its end."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass(frozen=True)
class Done:
    """How it ended and what it said."""

    code: int
    out: str
    err: str

    @property
    def json(self) -> Any:
        """Standard output as the one JSON document that it must be."""
        assert self.out == json.dumps(json.loads(self.out), sort_keys=True, indent=2, ensure_ascii=False) + "\n"
        return json.loads(self.out)


def run_command(
    command: Path,
    *arguments: str | Path,
    environment: Mapping[str, str],
    cwd: Path | None = None,
    typed: str = "",
    seconds: float = 60,
) -> Done:
    """Run it with these arguments, `typed` on its standard input. A traceback is a failure."""
    done = subprocess.run(
        [str(command), *map(str, arguments)],
        env=environment,
        cwd=cwd,
        input=typed,
        capture_output=True,
        text=True,
        timeout=seconds,
        check=False,
    )
    assert "Traceback" not in done.stderr, done.stderr
    return Done(done.returncode, done.stdout, done.stderr)
