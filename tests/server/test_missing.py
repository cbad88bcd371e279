"""What is missing on this machine is told once, and is no fault of a launch file."""

from __future__ import annotations

import pytest
from lsprotocol import types
from support.editor_harness import Harness
from support.lsp_client import editing

pytestmark = pytest.mark.ros

TEXT = """<launch>
  <node pkg="slam_toolbox" type="a" name="a"/>
  <node pkg="slam_toolbox" type="b" name="b"/>
  <param name="robot" value="$(env ROBOT_THAT_NOBODY_HAS)"/>
</launch>
"""
LINES = ["1 package: slam_toolbox (2)", "1 environment variable: ROBOT_THAT_NOBODY_HAS"]


async def test_what_is_missing_is_in_the_status_and_on_the_doctors_page(harness: Harness) -> None:
    harness.launch_file.write_text(TEXT)
    async with editing(harness, settings={"status": True}) as editor:
        editor.open(harness.launch_file)
        await editor.until(lambda: editor.statuses and list(editor.statuses[-1].missing.lines) == LINES)
        found = await editor.having(harness.launch_file, "PKG001")
        assert found.severity == types.DiagnosticSeverity.Hint
        await editor.until(lambda: (editor.rules(harness.launch_file) or []).count("PKG001") == 1)
        text = await editor.doctor()
        assert all(line in text for line in LINES)
        editor.change(harness.launch_file, "<launch/>\n")
        await editor.until(lambda: list(editor.statuses[-1].missing.lines) == [])
