"""Nothing is executed without trust, or without a sandbox, and the user sees why."""

from __future__ import annotations

import asyncio
from pathlib import Path

import pytest
from lsprotocol import types
from support.editor_harness import Harness
from support.lsp_client import editing

pytestmark = pytest.mark.ros


def children(pid: int) -> list[str]:
    """The command lines of all processes below `pid`."""
    parents = {}
    for status in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = status.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        parents[int(status.parent.name)] = int(fields[1])
    below = {pid}
    while more := {child for child, parent in parents.items() if parent in below} - below:
        below |= more
    commands = []
    for each in below - {pid}:
        try:
            commands.append(Path(f"/proc/{each}/cmdline").read_text().replace("\0", " "))
        except OSError:
            continue
    return commands


async def test_without_trust_nothing_is_executed_and_the_reason_is_shown(harness: Harness) -> None:
    async with editing(harness) as editor:
        editor.open(harness.launch_file)
        found = await editor.having(harness.launch_file, "TRC004")
        assert found.severity == types.DiagnosticSeverity.Information
        assert "not trusted" in found.message
        for _ in range(10):
            assert children(editor.pid) == []
            await asyncio.sleep(0.1)  # nothing tells that no process will come
        await editor.until(lambda: editor.rules(harness.launch_file) == ["TOP001", "TRC004"])
        from_source = await editor.misspelling(harness.launch_file)
        assert from_source.severity == types.DiagnosticSeverity.Warning
        assert editor.runs == {}
    assert harness.sandbox_starts() == 0


async def test_static_findings_need_no_trust(harness: Harness) -> None:
    async with editing(harness) as editor:
        text = harness.launch_file.read_text().replace('value="5"', 'value="$(arg speed)"')
        editor.open(harness.launch_file, text)
        found = await editor.having(harness.launch_file, "ARG001")
        assert "speed" in found.message
        assert editor.covered(harness.launch_file, found.range).strip("$()").endswith("speed")
        assert found.severity == types.DiagnosticSeverity.Error


async def test_trust_that_is_granted_later_starts_the_runs(harness: Harness) -> None:
    async with editing(harness) as editor:
        editor.open(harness.launch_file)
        await editor.having(harness.launch_file, "TRC004")
        editor.trust()
        await editor.misspelling(harness.launch_file)
        await editor.without(harness.launch_file, "TRC004")


async def test_trust_that_is_withdrawn_takes_back_what_runs_told(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        assert "(possible)" not in (await editor.misspelling(harness.launch_file)).message
        editor.trust(False)
        await editor.having(harness.launch_file, "TRC004")

        def only_by_source() -> bool:
            found = editor.diagnostics(harness.launch_file) or ()
            return any(each.code == "TOP001" and "(possible)" in each.message for each in found)

        await editor.until(only_by_source)


@pytest.mark.parametrize("value", ["true", 1, None])
async def test_only_true_is_trust(harness: Harness, value: object) -> None:
    async with editing(harness, settings={"workspaceTrusted": value}) as editor:
        editor.open(harness.launch_file)
        found = await editor.having(harness.launch_file, "TRC004")
        assert "not trusted" in found.message
    assert harness.sandbox_starts() == 0


async def test_where_no_sandbox_works_nothing_runs_and_the_reason_is_shown(harness: Harness) -> None:
    broken = harness.home / "broken"
    broken.mkdir()
    (broken / "bwrap").write_text("#!/bin/sh\necho no permission for namespaces >&2\nexit 1\n")
    (broken / "bwrap").chmod(0o755)
    variables = {"PATH": f"{broken}:{harness.environment['PATH']}", "ROS_PREFLIGHT_SANDBOX": "bubblewrap"}
    async with editing(harness, trusted=True, environment=variables) as editor:
        editor.open(harness.launch_file)
        found = await editor.having(harness.launch_file, "TRC004")
        assert "no permission for namespaces" in found.message
        found = await editor.misspelling(harness.launch_file)
        assert found.severity == types.DiagnosticSeverity.Warning
    assert harness.sandbox_starts() == 0


async def test_running_can_be_switched_off_and_on_in_the_settings(harness: Harness) -> None:
    async with editing(harness, trusted=True, settings={"runNodes": False}) as editor:
        editor.open(harness.launch_file)
        found = await editor.having(harness.launch_file, "TRC004")
        assert "rosPreflight.runNodes" in found.message
        assert harness.sandbox_starts() == 0
        editor.client.set_configuration({"runNodes": True}, section="rosPreflight")
        editor.client.workspace_did_change_configuration(types.DidChangeConfigurationParams(None))
        await editor.misspelling(harness.launch_file)
