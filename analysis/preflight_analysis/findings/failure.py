"""What a part of ours that broke has to say: its findings are missing, and whoever reads the others has to know."""

from __future__ import annotations

import os
import traceback
from collections.abc import Sequence
from typing import Any

from preflight_analysis.dataclass import dataclass
from preflight_analysis.findings.clipping import clipped


def error_line(error: BaseException) -> str:
    """An exception in one line, with the place where it was raised."""
    frames = traceback.extract_tb(error.__traceback__)
    at = f" ({os.path.basename(frames[-1].filename)}:{frames[-1].lineno})" if frames else ""
    said = " ".join(str(error).split())
    return clipped(f"{type(error).__name__}{': ' if said else ''}{said}{at}")


@dataclass(frozen=True, slots=True)
class Failure:
    """An exception of ours. `rule` is the id of the rule that raised, None where a whole analysis did; `file` the
    launch file that was looked at, `error` the exception in one line with the place of our code."""

    rule: str | None
    file: str
    error: str

    @classmethod
    def of(cls, error: BaseException, file: str, rule: str | None = None) -> Failure:
        """That of an exception that was caught."""
        return cls(rule, file, error_line(error))

    def message(self, file: str) -> str:
        """For a reader to whom the launch file is shown as `file`."""
        what = f"rule {self.rule}" if self.rule is not None else "the analysis"
        return f"{what} failed on {file}: {self.error}. Its findings are missing; please report this."


def failures_json(failures: Sequence[Failure]) -> list[dict[str, Any]]:
    """As JSON has them: `rule` is null where a whole analysis failed."""
    return [{"rule": each.rule, "file": each.file, "error": each.error} for each in failures]
