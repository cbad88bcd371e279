"""The page that tells what launch files and nodes are looked at with, for the command line and for editors."""

from __future__ import annotations

from preflight_analysis.environment.doctor import describe
from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.sandbox import SandboxStatus


def page(environment: Environment, status: SandboxStatus | None) -> str:
    """What there is and what is missing, a line each; `status` is None where the sandbox was not tried."""
    rows = [*describe(environment), *_sandbox(status), ("traces", str(TraceCache().folder))]
    width = max(len(what) for what, _ in rows)
    return "".join(f"{what:<{width}}  {value}\n" for what, value in rows)


def _sandbox(status: SandboxStatus | None) -> list[tuple[str, str]]:
    if status is None:
        return [("sandbox", "not tried: --no-run was given")]
    if not status.works:
        return [("sandbox", f"does not work: {status.reason}")]
    return [("sandbox", f"works: {status.backend}"), *(("sandbox", guarantee) for guarantee in status.guarantees)]
