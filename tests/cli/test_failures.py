"""An error of ours is said, costs no more than its own findings, and the exit code is 3."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import jsonschema
import pytest
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.rules import registry
from preflight_analysis.rules.rule import Rule
from preflight_server.cli.main import main
from preflight_server.mcp.results import summary
from support.sarif_schema import SARIF_SCHEMA

pytestmark = pytest.mark.breaks
SAID = r"rule LCH004 failed on {}: RuntimeError: a bug \(test_failures\.py:\d+\)\. Its findings are missing; please"


def _raise(rule: Rule, context: Context) -> Iterator[Finding]:
    raise RuntimeError("a\nbug")
    yield


@pytest.fixture(autouse=True)
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Two launch files, and a rule that raises."""
    rules = tuple(replace(rule, check=_raise) if rule.id == "LCH004" else rule for rule in registry.all_rules())
    monkeypatch.setattr(registry, "all_rules", lambda: rules)
    monkeypatch.chdir(tmp_path)
    for name in ("a", "b"):
        (tmp_path / f"{name}.launch").write_text('<launch><nod/><param name="x" value="$(arg y)"/></launch>\n')
    return tmp_path


def test_the_other_findings_are_there(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "a.launch", "--no-run", "--fail-on", "never"]) == 3
    done = capsys.readouterr()
    assert "ARG001" in done.out
    assert re.search(SAID.format(r"a\.launch"), done.err)


def test_json(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "--no-run", "--format", "json", "--paths", "relative"]) == 3
    done = capsys.readouterr()
    document = json.loads(done.out)
    assert [(each["rule"], each["file"]) for each in document["failures"]] == [
        ("LCH004", "a.launch"),
        ("LCH004", "b.launch"),
    ]
    assert re.fullmatch(r"RuntimeError: a bug \(test_failures\.py:\d+\)", document["failures"][0]["error"])
    assert re.search(SAID.format(r"a\.launch and 1 more"), done.err)
    assert "rule LCH004 failed on a.launch" in summary("check", document)


def test_sarif(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "a.launch", "--no-run", "--format", "sarif"]) == 3
    log = json.loads(capsys.readouterr().out)
    jsonschema.validate(log, SARIF_SCHEMA)
    (invocation,) = log["runs"][0]["invocations"]
    assert not invocation["executionSuccessful"]
    (note,) = invocation["toolExecutionNotifications"]
    assert note["associatedRule"] == {"id": "LCH004"}
    assert re.search(SAID.format(r"a\.launch"), note["message"]["text"])


@pytest.mark.parametrize(
    ("form", "said"),
    [
        ("junit", r'errors="1".*<testcase classname="a.launch" name="LCH004">\s*<error message="rule LCH004 failed'),
        ("github", r"^::error title=ros-preflight::rule LCH004 failed on a\.launch: RuntimeError: a bug"),
    ],
)
def test_ci(workspace: Path, form: str, said: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "a.launch", "--no-run", "--format", form]) == 3
    assert re.search(said, capsys.readouterr().out, re.DOTALL)


@pytest.mark.parametrize(
    "call",
    [
        ["tree", "a.launch"],
        ["tree", "a.launch", "--format", "json"],
        ["graph", "a.launch"],
        ["snapshot", "a.launch"],
        ["frames", "a.launch"],
        ["explain", "a.launch:1", "a.launch"],
        ["check", "a.launch", "--write-baseline", "known.json"],
    ],
    ids=" ".join,
)
def test_other_verbs(workspace: Path, call: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*call, "--no-run"]) == 3
    assert re.search(SAID.format(r"a\.launch"), capsys.readouterr().err)


def test_an_analysis_that_raises_costs_one_launch(
    workspace: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    run_rules = registry.run_rules

    def broken(context: Context, *args: object, **options: object) -> list[Finding]:
        if context.root.endswith("a.launch"):
            raise KeyError("x")
        return run_rules(context, *args, **options)  # type: ignore[arg-type]

    monkeypatch.setattr("preflight_analysis.workspace.workspace.run_rules", broken)
    assert main(["check", "--no-run"]) == 3
    done = capsys.readouterr()
    assert "b.launch:1" in done.out
    assert "the analysis failed on a.launch: KeyError: 'x' (test_failures.py:" in done.err


def test_any_other_error_has_the_exit_code(
    workspace: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def broken(*_: object) -> None:
        raise KeyError("x")

    monkeypatch.setattr("preflight_server.cli.tree.tree_json", broken)
    assert main(["tree", "a.launch", "--no-run", "--format", "json"]) == 3
    assert "internal error: KeyError: 'x' (test_failures.py:" in capsys.readouterr().err
