"""Which documents are looked at, who is told what in which way, and what becomes of it when files change."""

from __future__ import annotations

import asyncio
import random
from pathlib import Path

import pytest
from editor_desk import Desk
from lsp_desk import Editor, capabilities, editing
from lsprotocol import types

pytestmark = pytest.mark.ros

UNDECLARED = '<launch>\n  <param name="p" value="$(arg nothing)"/>\n</launch>\n'
EMPTY = "<launch>\n</launch>\n"


def including(path: Path, *files: Path, text: str = "") -> Path:
    path.write_text(
        "<launch>\n" + "".join(f'  <include file="$(dirname)/{file.name}"/>\n' for file in files) + text + "</launch>\n"
    )
    return path


async def test_an_included_file_is_told_of_and_cleared_with_the_root(desk: Desk) -> None:
    inner = desk.workspace / "inner.launch"
    inner.write_text(UNDECLARED)
    outer = including(desk.workspace / "outer.launch", inner)
    async with editing(desk) as editor:
        editor.open(outer)
        found = await editor.having(inner, "ARG001")
        assert found.range.start.line == 1
        await editor.until(lambda: editor.rules(outer) == [])
        editor.close(outer)
        await editor.until(lambda: editor.rules(inner) == [])


async def test_an_edit_during_the_first_analysis_of_a_file_is_not_lost(desk: Desk) -> None:
    filling = "".join(f'  <param name="p{k}" value="{k}"/>\n' for k in range(1500))
    async with editing(desk) as editor:
        editor.open(desk.launch_file)
        await editor.until(lambda: editor.rules(desk.launch_file) is not None)
        for attempt in range(6):
            path = desk.workspace / f"first_{attempt}.launch"
            path.write_text(EMPTY)
            editor.open(path, f"<launch>\n{filling}</launch>\n")
            await asyncio.sleep(0.03 * attempt)
            editor.change(path, UNDECLARED)
            assert ("nothing", "parameter") in await editor.tokens(path)
            await editor.having(path, "ARG001")


async def test_an_included_file_keeps_its_findings_while_another_root_reports_them(desk: Desk) -> None:
    inner = desk.workspace / "inner.launch"
    inner.write_text(UNDECLARED)
    one = including(desk.workspace / "one.launch", inner)
    two = including(desk.workspace / "two.launch", inner)
    async with editing(desk) as editor:
        editor.open(one)
        await editor.having(inner, "ARG001")
        editor.open(two)
        await editor.until(lambda: editor.rules(two) == [])
        editor.close(one)
        await editor.until(lambda: any(p.uri == one.as_uri() for p in editor.history))
        await editor.symbols(two)
        assert editor.rules(inner) == ["ARG001"]
        editor.close(two)
        await editor.until(lambda: editor.rules(inner) == [])


async def test_an_included_file_is_judged_where_it_is_included(desk: Desk) -> None:
    inner = desk.workspace / "inner.launch"
    inner.write_text('<launch>\n  <arg name="a"/>\n  <param name="p" value="$(arg a)"/>\n</launch>\n')
    outer = desk.workspace / "outer.launch"
    outer.write_text(f'<launch><include file="$(dirname)/{inner.name}"><arg name="a" value="1"/></include></launch>')
    async with editing(desk) as editor:
        editor.open(inner)
        await editor.until(lambda: editor.rules(inner) == [])
        outer.unlink()
        editor.watched(outer, kind=types.FileChangeType.Deleted)
        await editor.until(lambda: editor.rules(inner) == ["ARG003"], 20)
        editor.open(
            outer, f'<launch><include file="$(dirname)/{inner.name}"><arg name="a" value="1"/></include></launch>'
        )
        await editor.until(lambda: editor.rules(inner) == [])
        editor.close(outer)
        await editor.until(lambda: editor.rules(inner) == ["ARG003"])


async def test_an_edit_of_an_open_included_file_counts_before_it_is_saved(desk: Desk) -> None:
    inner = desk.workspace / "inner.launch"
    inner.write_text(EMPTY)
    outer = desk.workspace / "outer.launch"
    outer.write_text(f'<launch><include file="$(dirname)/{inner.name}"><arg name="a" value="1"/></include></launch>')
    async with editing(desk) as editor:
        editor.open(outer)
        await editor.having(outer, "ARG004")
        editor.open(inner)
        editor.replace(inner, len("<launch>\n"), len("<launch>\n"), '  <arg name="a"/>\n')
        await editor.without(outer, "ARG004")
        editor.close(inner)
        await editor.having(outer, "ARG004")


async def test_files_that_include_each_other_are_both_told(desk: Desk) -> None:
    one, two = desk.workspace / "one.launch", desk.workspace / "two.launch"
    including(one, two)
    including(two, one)
    async with editing(desk) as editor:
        editor.open(one)
        editor.open(two)
        await editor.until(lambda: any("LCH015" in (editor.rules(p) or ()) for p in (one, two)))


async def test_other_xml_is_left_alone(desk: Desk) -> None:
    other, launch = desk.workspace / "robot.xml", desk.workspace / "robot_launch.xml"
    async with editing(desk) as editor:
        editor.open(other, "<robot><link nam='x'></robot>", "xml")
        editor.open(launch, "<?xml version='1.0'?>\n<!-- a --><launch><nod/></launch>", "xml")
        await editor.having(launch, "LCH004")
        assert await editor.hover(other, types.Position(0, 2)) is None
        assert await editor.symbols(other) == []
        assert editor.rules(other) is None
        editor.change(launch, "<robot/>")
        await editor.until(lambda: editor.published[launch.as_uri()].diagnostics == ())


@pytest.mark.parametrize("uri", ["untitled:Untitled-1", "git:/w/a.launch?%7B%7D", "vscode-notebook-cell:/a#x", "x"])
async def test_documents_that_are_no_files_do_no_harm(desk: Desk, uri: str) -> None:
    async with editing(desk) as editor:
        document = types.TextDocumentItem(uri, "roslaunch", 1, "<launch><nod/></launch>")
        editor.client.text_document_did_open(types.DidOpenTextDocumentParams(document))
        identifier = types.TextDocumentIdentifier(uri)
        assert (
            await editor.client.text_document_hover_async(types.HoverParams(identifier, types.Position(0, 10))) is None
        )
        change = types.TextDocumentContentChangeWholeDocument("<launch>")
        editor.client.text_document_did_change(
            types.DidChangeTextDocumentParams(types.VersionedTextDocumentIdentifier(2, uri), [change])
        )
        editor.client.text_document_did_save(types.DidSaveTextDocumentParams(identifier))
        editor.client.text_document_did_close(types.DidCloseTextDocumentParams(identifier))
        editor.open(desk.launch_file)
        await editor.having(desk.launch_file, "TRC004")
        assert uri not in editor.published


async def test_requests_for_files_that_are_not_open_are_answered_with_nothing(desk: Desk) -> None:
    async with editing(desk) as editor:
        assert await editor.hover(desk.launch_file, types.Position(0, 0)) is None
        assert await editor.definition(desk.launch_file, types.Position(0, 0)) == []
        assert await editor.symbols(desk.launch_file) == []


async def test_positions_past_the_end_are_answered(desk: Desk) -> None:
    async with editing(desk) as editor:
        editor.open(desk.launch_file)
        for where in (types.Position(0, 999), types.Position(999, 0), types.Position(2**31 - 1, 2**31 - 1)):
            await editor.hover(desk.launch_file, where)
            assert await editor.definition(desk.launch_file, where) == []


async def test_a_client_that_pulls_is_told_once(desk: Desk) -> None:
    inner = desk.workspace / "inner.launch"
    inner.write_text(UNDECLARED)
    outer = including(desk.workspace / "outer.launch", inner, text="  <nod/>\n")
    async with editing(desk, client=capabilities(pull=True)) as editor:
        assert editor.result is not None
        provider = editor.result.capabilities.diagnostic_provider
        assert provider is not None
        assert provider.inter_file_dependencies
        editor.open(outer)
        assert [d.code for d in await editor.pull(outer)] == ["LCH004"]
        await editor.having(inner, "ARG001")
        assert outer.as_uri() not in editor.published, "an open file is pulled, not published"
        editor.open(inner)
        assert [d.code for d in await editor.pull(inner)] == ["ARG001"]
        await editor.until(lambda: editor.published[inner.as_uri()].diagnostics == ())


async def test_a_client_that_pulls_is_asked_again_when_runs_have_ended(desk: Desk) -> None:
    async with editing(desk, trusted=True, client=capabilities(pull=True)) as editor:
        editor.open(desk.launch_file)
        assert "TOP001" not in [d.code for d in await editor.pull(desk.launch_file)]
        await editor.until(lambda: editor.refreshes)
        assert "TOP001" in [d.code for d in await editor.pull(desk.launch_file)]


async def test_a_client_that_pulls_but_cannot_be_asked_again_is_published_to(desk: Desk) -> None:
    async with editing(desk, trusted=True, client=capabilities(pull=True, refresh=False)) as editor:
        assert editor.result is not None
        assert editor.result.capabilities.diagnostic_provider is None
        editor.open(desk.launch_file)
        await editor.having(desk.launch_file, "TOP001")


async def test_a_new_package_is_found_when_its_manifest_appears(desk: Desk) -> None:
    workspace = desk.home / "catkin_ws"
    (workspace / "src").mkdir(parents=True)
    path = workspace / "a.launch"
    async with editing(desk, folder=workspace) as editor:
        editor.open(path, '<launch>\n  <param name="p" value="$(find new_one)"/>\n</launch>\n')
        await editor.having(path, "PKG001")
        await editor.until(lambda: types.WORKSPACE_DID_CHANGE_WATCHED_FILES in editor.registered)
        manifest = workspace / "src/new_one/package.xml"
        manifest.parent.mkdir()
        manifest.write_text("<package format='2'><name>new_one</name></package>")
        editor.watched(manifest, kind=types.FileChangeType.Created)
        await editor.without(path, "PKG001")


async def test_a_new_executable_is_found_when_it_appears(desk: Desk) -> None:
    path = desk.workspace / "a.launch"
    async with editing(desk) as editor:
        editor.open(path, '<launch>\n  <node pkg="preflight_demo" type="new.py" name="n"/>\n</launch>\n')
        await editor.having(path, "PKG002")
        script = desk.launch_file.parents[1] / "scripts/new.py"
        script.write_text("#!/usr/bin/env python3\n")
        script.chmod(0o755)
        editor.watched(script, kind=types.FileChangeType.Created)
        await editor.without(path, "PKG002")


async def test_a_file_changed_on_disk_counts(desk: Desk) -> None:
    inner = desk.workspace / "inner.launch"
    inner.write_text(EMPTY)
    outer = including(desk.workspace / "outer.launch", inner)
    async with editing(desk) as editor:
        editor.open(outer)
        await editor.until(lambda: editor.rules(outer) == [])
        inner.write_text(UNDECLARED)
        editor.watched(inner)
        await editor.having(inner, "ARG001")


async def test_rapid_edits_end_where_a_fresh_server_starts(desk: Desk) -> None:
    """Hundreds of edits at random places, many of which break the file, without waiting in between."""
    chance = random.Random(7)
    pieces = ["<", ">", "\n", "\r\n", '"', "$(arg x)", "größe", "𝒳", '<arg name="x" default="1"/>', "\f", "/", " "]
    path = desk.launch_file
    async with editing(desk, client=capabilities(encoding="utf-16")) as editor:
        editor.open(path)
        for step in range(300):
            text = editor.texts[path]
            start = chance.randrange(len(text) + 1)
            end = min(len(text), start + chance.choice((0, 0, 0, 1, 5)))
            start -= text[start - 1 : start + 1] == "\r\n"
            end += text[end - 1 : end + 1] == "\r\n"
            editor.replace(path, start, end, chance.choice(pieces))
            if step % 50 == 0:
                await asyncio.sleep(0.02)
        text = editor.texts[path]
        await editor.until(lambda: editor.diagnostics(path) is not None)
        edited = editor.diagnostics(path)
        await _agrees(desk, path, text, edited)


async def test_rapid_edits_back_to_a_good_file(desk: Desk) -> None:
    async with editing(desk, trusted=True) as editor:
        text = editor.open(desk.launch_file)
        for index in range(len(text) - 1, 20, -7):
            editor.replace(desk.launch_file, index, index + 1, "")
        editor.change(desk.launch_file, text)
        found = await editor.having(desk.launch_file, "TOP001")
        assert editor.covered(desk.launch_file, found.range) == "chater"


async def _agrees(desk: Desk, path: Path, text: str, expected: list[types.Diagnostic] | None) -> None:
    async with editing(desk) as fresh:
        fresh.open(path, text)
        await fresh.until(lambda: fresh.diagnostics(path) is not None)
        assert _comparable(fresh, path) == [(d.code, d.range, d.message) for d in expected or ()]


def _comparable(editor: Editor, path: Path) -> list[tuple[object, types.Range, str]]:
    return [(d.code, d.range, d.message) for d in editor.diagnostics(path) or ()]


async def test_a_file_without_a_folder_finds_the_workspace_around_it(desk: Desk) -> None:
    async with editing(desk, trusted=True, without_folder=True) as editor:
        editor.open(desk.launch_file)
        found = await editor.having(desk.launch_file, "TOP001")
        assert "chatter" in found.message
        assert editor.rules(desk.launch_file) == ["TOP001"]
