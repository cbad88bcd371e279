"""What the command imports before it does anything: that is most of the time that it takes to start."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from preflight_analysis.tracing import sandbox
from preflight_analysis.tracing.interface import Interface, Outcome
from preflight_analysis.tracing.kept_traces import KeptTraces
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.sandbox import SandboxStatus
from preflight_server.cli.main import main

DEMO = Path(__file__).parents[2] / "fixtures/ros1/demo"
HEAVY = (
    "preflight_analysis.evaluation",
    "preflight_analysis.rules",
    "yaml",
    "lxml",
    "pygls",
    "platformdirs",
    "hashlib",
)

ONLY_FOR_RUNS = {
    f"preflight_analysis.tracing.{name}" for name in ("sandbox", "run", "trace", "commands", "observation")
}
ONLY_FOR_WORKSPACES = {
    "preflight_analysis.workspace.index_store",
    "preflight_analysis.environment.cmake",
    "preflight_analysis.environment.setup_py",
    "preflight_analysis.findings.sarif",
    "preflight_analysis.findings.junit",
    "pygls",
    "aspectlib",
}


def imported(*arguments: str) -> set[str]:
    """The modules that are imported when the command ends."""
    program = (
        "import runpy, sys\n"
        "try:\n    runpy.run_module('preflight_server', run_name='__main__')\n"
        "except SystemExit:\n    print('', *sys.modules, sep='\\n', file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", program, *arguments], capture_output=True, text=True, check=True)
    return set(done.stderr.split("\n"))


@pytest.mark.parametrize("option", ["--version", "--help"])
def test_version_and_help_import_none_of_the_analysis(option: str) -> None:
    modules = imported(option)
    assert "preflight_server.cli.main" in modules
    assert not modules.intersection(HEAVY)


def test_a_verb_imports_what_it_needs() -> None:
    modules = imported("rules", "TOP001")
    assert "preflight_analysis.rules.registry" in modules
    assert not modules.intersection({"preflight_server.cli.check", "pygls"})


def test_a_check_that_runs_nothing_imports_nothing_that_runs() -> None:
    modules = imported("check", "--no-run", str(DEMO / "launch/talker_listener.launch"), "--package-path", str(DEMO))
    assert {"preflight_analysis.tracing.kept_traces", "preflight_analysis.rules.registry"} <= modules
    assert not modules.intersection(ONLY_FOR_RUNS | ONLY_FOR_WORKSPACES)


def test_the_sandbox_is_not_tried_where_every_trace_is_known(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    asked: list[str] = []

    def lookup(self: KeptTraces, request: TraceRequest) -> Interface | None:
        return Interface("trace", Outcome("spinning")) if request.node in known else None

    def probe() -> SandboxStatus:
        asked.append("probe")
        return SandboxStatus(False, "there is no sandbox")

    monkeypatch.setattr(KeptTraces, "lookup", lookup)
    monkeypatch.setattr(sandbox, "probe", probe)
    arguments = ["check", str(DEMO / "launch/talker_listener.launch"), "--package-path", str(DEMO)]
    known = {"/talker", "/listener"}
    main(arguments)
    assert (asked, "2 nodes: 2 run" in capsys.readouterr().out) == ([], True)
    known = {"/talker"}
    main(arguments)
    assert (asked, "2 nodes: 1 run, 1 " in capsys.readouterr().out) == (["probe"], True)
