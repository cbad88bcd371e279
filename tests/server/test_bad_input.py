"""Whatever a file holds, there is a clear finding, soon, and the server goes on."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from lsprotocol import types
from support.editor_harness import Harness
from support.lsp_client import Editor, editing

LAUGHS = (
    """<?xml version="1.0"?>
<!DOCTYPE launch [
 <!ENTITY a "ha">
"""
    + "".join(
        f' <!ENTITY {name} "{10 * f"&{before};"}">\n' for before, name in zip("abcdefghi", "bcdefghij", strict=True)
    )
    + """]>
<launch><param name="x" value="&j;"/></launch>
"""
)
BIG = "<launch>\n" + '  <param name="p" value="v"/>\n' * 180_000 + "</launch>\n"
MANY_NODES = (
    "<launch>\n"
    + "".join(f'  <node pkg="preflight_demo" type="talker.py" name="n{n}"/>\n' for n in range(300))
    + "</launch>\n"
)


async def finding(editor: Editor, path: Path, text: str, rule: str) -> types.Diagnostic:
    """The finding; and the server still answers for another file after it."""
    editor.open(path, text)
    found = await editor.having(path, rule)
    await editor.hover(path, types.Position(0, 0))
    assert [m.message for m in editor.client.messages] == [], "no message box"
    return found


@pytest.mark.parametrize(
    ("text", "rule", "words"),
    [
        ("", "LCH003", "launch"),
        (" \n\f\n", "LCH001", ""),
        ("<", "LCH001", ""),
        ("<launch>", "LCH001", "launch"),
        ('<launch><node pkg="a" type="b" name="', "LCH001", ""),
        ("<launch/>trailing", "LCH001", ""),
        ("<robot/>", "LCH003", "robot"),
        ("\x7fELF\0\0\0\x01", "LCH002", "not a text file"),
        (BIG, "LCH002", "MB"),
        (LAUGHS, "LCH018", "j"),
        ("<launch>" + "<group>" * 5000, "LCH001", ""),
    ],
    ids=["empty", "blank", "lone", "unclosed", "attribute", "trailing", "robot", "binary", "5MB", "laughs", "deep"],
)
async def test_bad_text(harness: Harness, text: str, rule: str, words: str) -> None:
    async with editing(harness, trusted=True) as editor:
        found = await finding(editor, harness.workspace / "bad.launch", text, rule)
        assert words in found.message
        # It can be typed in all the same.
        path = harness.workspace / "bad.launch"
        editor.change(path, "<launch/>\n")
        await editor.until(lambda: editor.rules(path) == [])


def _folder(path: Path) -> None:
    path.mkdir()


def _binary(path: Path) -> None:
    path.write_bytes(b"\x89PNG\r\n\x1a\n\0\0\xff")


def _large(path: Path) -> None:
    path.write_bytes(b"<launch/>" + b" " * (5 << 20))


@pytest.mark.parametrize("make", [_folder, os.mkfifo, _binary, _large])
async def test_an_include_that_cannot_be_read(harness: Harness, make: object) -> None:
    assert callable(make)
    inner = harness.workspace / "inner.launch"
    make(inner)
    text = f'<launch>\n  <include file="{inner}"/>\n</launch>\n'
    async with editing(harness) as editor:
        found = await finding(editor, harness.workspace / "outer.launch", text, "LCH014")
        assert "inner.launch" in found.message


async def test_a_launch_file_whose_name_is_no_utf8(harness: Harness) -> None:
    path = Path(os.fsdecode(os.fsencode(harness.workspace / "gr") + b"\xf6\xdfe.launch"))
    outer = harness.workspace / "outer.launch"
    async with editing(harness) as editor:
        editor.open(outer, '<launch>\n  <include file="no.launch"/>\n</launch>\n')
        await editor.having(outer, "LCH013")
        editor.open(path, "<launch>\n")
        assert (await editor.having(path, "LCH001")).code == "LCH001"


async def test_an_include_that_is_malformed_is_reported_in_its_own_file(harness: Harness) -> None:
    inner = harness.workspace / "inner.launch"
    inner.write_text('<launch>\n  <node pkg="a"</launch>')
    async with editing(harness) as editor:
        editor.open(harness.workspace / "outer.launch", f'<launch>\n  <include file="{inner}"/>\n</launch>\n')
        found = await editor.having(inner, "LCH001")
        assert found.range.start.line == 1


async def test_an_include_that_is_not_there(harness: Harness) -> None:
    async with editing(harness) as editor:
        text = '<launch>\n  <include file="$(find preflight_demo)/launch/talker_listner.launch"/>\n</launch>\n'
        found = await finding(editor, harness.workspace / "outer.launch", text, "LCH013")
        assert "talker_listner.launch" in found.message


async def test_a_circle_of_includes(harness: Harness) -> None:
    one, two = harness.workspace / "one.launch", harness.workspace / "two.launch"
    two.write_text(f'<launch>\n  <include file="{one}"/>\n</launch>\n')
    text = f'<launch>\n  <include file="{two}"/>\n</launch>\n'
    async with editing(harness) as editor:
        editor.open(one, text)
        found = await editor.until(
            lambda: next((d for p in (one, two) for d in editor.diagnostics(p) or () if d.code == "LCH015"), None)
        )
        assert "one.launch" in found.message


async def test_requests_on_a_file_of_many_nodes(harness: Harness) -> None:
    async with editing(harness) as editor:
        path = harness.workspace / "many.launch"
        editor.open(path, MANY_NODES)
        await editor.having(path, "TRC004")
        assert len(await editor.symbols(path)) == 300


async def test_malformed_messages_do_not_stop_the_server(harness: Harness) -> None:
    async with editing(harness) as editor:
        writer = editor.client.protocol.writer
        assert writer is not None
        for body in (
            b'{"jsonrpc": "2.0", "method": "rosPreflight/workspaceTrust", "params": ["nonsense"]}',
            b'{"jsonrpc": "2.0", "method": "rosPreflight/workspaceTrust"}',
            b'{"jsonrpc": "2.0", "method": "rosPreflight/unknown", "params": null}',
            b'{"jsonrpc": "2.0", "method": "textDocument/didChange", "params": {"nonsense": 1}}',
            b'{"jsonrpc": "2.0", "method": "workspace/didChangeConfiguration", "params": {"settings": 7}}',
            b"no JSON at all",
            b'{"jsonrpc": "2.0", "id": [], "method": "textDocument/hover", "params": null}',
            b'{"jsonrpc": "2.0", "id": {}, "result": null}',
            b"[" * 100_000,
            b"\xff\xfe",
        ):
            writer.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
        writer.write(b"Content-Length: abc\r\n\r\n{}\r\nContent-Length: -1\r\n\r\n{}")
        editor.open(harness.launch_file)
        await editor.having(harness.launch_file, "TRC004")
        assert [m.message for m in editor.client.messages] == []
