"""What conditions leave out, in an editor: looked at while nobody types."""

from __future__ import annotations

import pytest
from support.editor_harness import Harness
from support.lsp_client import editing

pytestmark = pytest.mark.ros

TEXT = """<launch>
  <arg name="sim" default="false"/>
  <include if="$(arg sim)" file="/none.launch"/>
  <param name="a" value="1"/>
</launch>
"""


async def test_it_is_said_stays_through_edits_and_goes_with_its_cause(harness: Harness) -> None:
    path = harness.workspace / "sim.launch"
    path.write_text(TEXT)
    async with editing(harness) as editor:
        editor.open(path)
        found = await editor.having(path, "LCH013")
        assert found.message == "included file '/none.launch' does not exist (if sim:=true)"
        editor.change(path, TEXT.replace("<launch>\n", "<launch>\n\n\n"))
        found = await editor.having(path, "LCH013")
        assert editor.covered(path, found.range) == "/none.launch"
        editor.change(path, TEXT.replace("/none.launch", str(harness.launch_file)))
        await editor.without(path, "LCH013")


async def test_what_is_not_saved_counts_in_what_only_a_condition_includes(harness: Harness) -> None:
    path, inner = harness.workspace / "sim.launch", harness.workspace / "inner.launch"
    path.write_text(TEXT.replace("/none.launch", str(inner)))
    inner.write_text("<launch/>\n")
    async with editing(harness) as editor:
        editor.open(path)
        editor.open(inner)
        editor.change(inner, '<launch>\n  <arg name="b"/>\n  <param name="b" value="$(arg b)"/>\n</launch>\n')
        assert "(if sim:=true)" in (await editor.having(path, "ARG002")).message
        editor.change(inner, "<launch/>\n")
        await editor.without(path, "ARG002")
