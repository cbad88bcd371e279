"""The page that tells what launch files and nodes are looked at with, for the command line and for editors."""

from __future__ import annotations

from collections.abc import Sequence

from preflight_analysis.environment.doctor import describe
from preflight_analysis.environment.model import Environment
from preflight_analysis.findings.lack import Missing, commands, in_words
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.sandbox import SandboxStatus


def page(environment: Environment, status: SandboxStatus | None, missing: Sequence[Missing] = ()) -> str:
    """What there is and what is missing, a line each; `status` is None where the sandbox was not tried. `missing` is
    what launch files need and this machine does not have."""
    rows = [*describe(environment), *_sandbox(status), ("traces", str(TraceCache().folder))]
    rows += [("missing", line) for line in in_words(missing, most=len(missing))]
    rows += [("install with", command) for command in commands(missing)]
    width = max(len(what) for what, _ in rows)
    return "".join(f"{what:<{width}}  {value}\n" for what, value in rows)


def _sandbox(status: SandboxStatus | None) -> list[tuple[str, str]]:
    if status is None:
        return [("sandbox", "not tried: --no-run was given")]
    if not status.works:
        return [("sandbox", f"does not work: {status.reason}")]
    return [("sandbox", f"works: {status.backend}"), *(("sandbox", guarantee) for guarantee in status.guarantees)]
