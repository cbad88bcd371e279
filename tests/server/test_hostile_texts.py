"""What an editor shows of a workspace neither turns text around, nor hides, nor runs a command."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from lsprotocol import types
from markdown_it import MarkdownIt
from preflight_server.lsp.app import PreflightServer
from support.editor_harness import Harness
from support.lsp_client import editing

HOSTILE = "\u202eevil\u2066\x9b31m\u200b"
LINK = "[x](command:evil)"
UNSEEN = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200b\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]")
TEXT = f"""<launch>
  <arg name="a{LINK}{HOSTILE}" default="{LINK}{HOSTILE}" doc="{LINK} {HOSTILE} `{LINK}`"/>
  <node pkg="p{LINK}{HOSTILE}" type="t{LINK}{HOSTILE}" name="n{HOSTILE}" ns="{LINK}">
    <param name="q{LINK}{HOSTILE}" value="v`{LINK}{HOSTILE}"/>
    <remap from="f{LINK}{HOSTILE}" to="g{LINK}{HOSTILE}"/>
    <!-- <topics><topic name="c" type="String" class="{HOSTILE}"/></topics> -->
  </node>
  <node pkg="preflight_demo" type="talker.py" name="n{LINK}"/>
  <include file="$(find p{HOSTILE})/{LINK}.launch"><arg name="b{LINK}{HOSTILE}" value="1"/></include>
  <param name="$(arg a{HOSTILE})" value="$(eval {LINK}{HOSTILE})"/>
  <nod{HOSTILE[-1]}e/>
</launch>
"""
READER = MarkdownIt("gfm-like", {"html": True, "linkify": False})


def _texts(value: Any, key: str = "") -> list[tuple[str, str]]:
    if isinstance(value, str):
        return [(key, value)]
    if isinstance(value, dict):
        return [pair for name, each in value.items() for pair in _texts(each, name)]
    return [pair for each in value for pair in _texts(each, key)] if isinstance(value, list) else []


async def test_what_is_shown_of_a_hostile_launch_file(harness: Harness) -> None:
    path = harness.workspace / "hostile.launch"
    async with editing(harness) as editor:
        editor.open(path, TEXT)
        await editor.until(lambda: editor.diagnostics(path))
        shown: list[tuple[str, str]] = []

        def add(found: Any) -> None:
            shown.extend(_texts(editor.client.protocol._converter.unstructure(found)))

        found = editor.diagnostics(path) or []
        assert len(found) > 5
        add(found)
        lines = TEXT.splitlines()
        for number, line in enumerate(lines):
            for column in range(0, len(line), 3):
                hover = await editor.hover(path, types.Position(number, column))
                add(hover)
                if hover is not None:
                    assert isinstance(hover.contents, types.MarkupContent)
                    html = READER.render(hover.contents.value)
                    assert 'href="command:' not in html
        for diagnostic in found:
            add(await editor.actions(path, diagnostic.range))
        add(await editor.symbols(path))
        add(await editor.hints(path))
        add(await editor.lenses(path))
        keys = {"title", "label", "message", "value", "name", "detail", "contents"}
        seen = {key: text for key, text in shown if key in keys and UNSEEN.search(text)}
        assert seen == {}
        assert any("evil" in text for key, text in shown if key == "message")


class Writer:
    """What a server sends."""

    def __init__(self) -> None:
        self.sent: list[bytes] = []

    def write(self, data: bytes) -> None:
        self.sent.append(data)

    def protocol(self) -> Any:
        """The protocol of a server that writes here."""
        protocol = PreflightServer().protocol
        protocol.writer = self  # type: ignore[assignment]
        return protocol


@pytest.mark.parametrize("key", ["label", "title", "detail", "message", "tooltip"])
def test_texts_are_made_harmless_where_they_leave(key: str) -> None:
    writer = Writer()
    protocol = writer.protocol()
    protocol.notify("rosPreflight/test", {key: "a\u202eb\x1b", "newText": "a\u202eb\x1b", "uri": "file:///\u202e"})
    (data,) = writer.sent
    assert data.count(b"\\u202e") == 2
    assert data.count(b"\\u001b") == 1


def test_the_names_of_files_too(tmp_path: Path) -> None:
    """A path in a message is text as any other; as a URI it is quoted."""
    writer = Writer()
    protocol = writer.protocol()
    message = types.ShowMessageParams(types.MessageType.Info, "/ws/\u202enuhc.launch\n\ud800")
    protocol.notify(types.WINDOW_SHOW_MESSAGE, message)
    assert b"\\u202e" not in writer.sent[0]
    assert b"\\ud800" not in writer.sent[0]
