"""What nodes do that cannot be run: from runs of their executable elsewhere, from annotations."""

from __future__ import annotations

import pytest
from editor_desk import Desk
from lsp_desk import editing
from lsprotocol import types

pytestmark = pytest.mark.ros

OTHER = """<launch>
  <node pkg="preflight_demo" type="talker.py" name="lone"/>
</launch>
"""


async def test_what_an_executable_did_elsewhere_is_shown_where_it_cannot_be_run(desk: Desk) -> None:
    async with editing(desk, trusted=True) as editor:
        editor.open(desk.launch_file)
        await editor.having(desk.launch_file, "TOP001")
    starts = desk.sandbox_starts()
    other = desk.launch_file.with_name("other.launch")
    other.write_text(OTHER)
    async with editing(desk) as editor:
        for text in (OTHER, OTHER.replace("</launch>", "  <node pkg=")):
            if other in editor.texts:
                editor.change(other, text)
            else:
                editor.open(other, text)
                await editor.having(other, "TRC004")
            hover = await editor.hover(other, editor.at(other, 'name="lone"'))
            assert hover is not None
            assert isinstance(hover.contents, types.MarkupContent)
            shown = hover.contents.value
            assert "from a run of the same executable elsewhere, that of `/talker` in `" in shown
            assert f"{desk.launch_file.name}`; not run: the workspace is not trusted" in shown
            assert "- `/chatter` `std_msgs/String`, seen elsewhere" in shown
        assert desk.sandbox_starts() == starts, "nothing was run to know it"
