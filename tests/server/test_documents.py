"""Which documents are looked at, who is told what in which way, and what becomes of it when files change."""

from __future__ import annotations

import asyncio
import random
from pathlib import Path

import pytest
from lsprotocol import types
from support.editor_harness import Harness
from support.lsp_client import Editor, capabilities, editing

pytestmark = pytest.mark.ros

UNDECLARED = '<launch>\n  <param name="p" value="$(arg nothing)"/>\n</launch>\n'
EMPTY = "<launch>\n</launch>\n"


def including(path: Path, *files: Path, text: str = "") -> Path:
    path.write_text(
        "<launch>\n" + "".join(f'  <include file="$(dirname)/{file.name}"/>\n' for file in files) + text + "</launch>\n"
    )
    return path


async def test_an_included_file_is_told_of_and_cleared_with_the_root(harness: Harness) -> None:
    inner = harness.workspace / "inner.launch"
    inner.write_text(UNDECLARED)
    outer = including(harness.workspace / "outer.launch", inner)
    async with editing(harness) as editor:
        editor.open(outer)
        found = await editor.having(inner, "ARG001")
        assert found.range.start.line == 1
        await editor.until(lambda: editor.rules(outer) == [])
        editor.close(outer)
        await editor.until(lambda: editor.rules(inner) == [])


async def test_an_edit_during_the_first_analysis_of_a_file_is_not_lost(harness: Harness) -> None:
    filling = "".join(f'  <param name="p{k}" value="{k}"/>\n' for k in range(1500))
    async with editing(harness) as editor:
        editor.open(harness.launch_file)
        await editor.until(lambda: editor.rules(harness.launch_file) is not None)
        for attempt in range(6):
            path = harness.workspace / f"first_{attempt}.launch"
            path.write_text(EMPTY)
            editor.open(path, f"<launch>\n{filling}</launch>\n")
            await asyncio.sleep(0.03 * attempt)  # each is another stage of the analysis
            editor.change(path, UNDECLARED)
            assert ("nothing", "parameter") in await editor.tokens(path)
            await editor.having(path, "ARG001")


async def test_an_included_file_keeps_its_findings_while_another_root_reports_them(harness: Harness) -> None:
    inner = harness.workspace / "inner.launch"
    inner.write_text(UNDECLARED)
    one = including(harness.workspace / "one.launch", inner)
    two = including(harness.workspace / "two.launch", inner)
    async with editing(harness) as editor:
        editor.open(one)
        await editor.having(inner, "ARG001")
        editor.open(two)
        await editor.until(lambda: editor.rules(two) == [])
        editor.close(one)
        await editor.symbols(two)  # the answer comes when all that was told before is analysed
        assert editor.rules(inner) == ["ARG001"]
        editor.close(two)
        await editor.until(lambda: editor.rules(inner) == [])


async def test_an_included_file_is_judged_where_it_is_included(harness: Harness) -> None:
    inner = harness.workspace / "inner.launch"
    inner.write_text('<launch>\n  <arg name="a"/>\n  <param name="p" value="$(arg a)"/>\n</launch>\n')
    outer = harness.workspace / "outer.launch"
    outer.write_text(f'<launch><include file="$(dirname)/{inner.name}"><arg name="a" value="1"/></include></launch>')
    async with editing(harness) as editor:
        editor.open(inner)
        await editor.until(lambda: editor.rules(inner) == [])
        outer.unlink()
        editor.watched(outer, kind=types.FileChangeType.Deleted)
        await editor.until(lambda: editor.rules(inner) == ["ARG003"])
        editor.open(
            outer, f'<launch><include file="$(dirname)/{inner.name}"><arg name="a" value="1"/></include></launch>'
        )
        await editor.until(lambda: editor.rules(inner) == [])
        editor.close(outer)
        await editor.until(lambda: editor.rules(inner) == ["ARG003"])


async def test_an_edit_of_an_open_included_file_counts_before_it_is_saved(harness: Harness) -> None:
    inner = harness.workspace / "inner.launch"
    inner.write_text(EMPTY)
    outer = harness.workspace / "outer.launch"
    outer.write_text(f'<launch><include file="$(dirname)/{inner.name}"><arg name="a" value="1"/></include></launch>')
    async with editing(harness) as editor:
        editor.open(outer)
        await editor.having(outer, "ARG004")
        editor.open(inner)
        editor.replace(inner, len("<launch>\n"), len("<launch>\n"), '  <arg name="a"/>\n')
        await editor.without(outer, "ARG004")
        editor.close(inner)
        await editor.having(outer, "ARG004")


async def test_files_that_include_each_other_are_both_told(harness: Harness) -> None:
    one, two = harness.workspace / "one.launch", harness.workspace / "two.launch"
    including(one, two)
    including(two, one)
    async with editing(harness) as editor:
        editor.open(one)
        editor.open(two)
        await editor.until(lambda: any("LCH015" in (editor.rules(p) or ()) for p in (one, two)))


async def test_other_xml_is_left_alone(harness: Harness) -> None:
    other, launch = harness.workspace / "robot.xml", harness.workspace / "robot_launch.xml"
    async with editing(harness) as editor:
        editor.open(other, "<robot><link nam='x'></robot>", "xml")
        editor.open(launch, "<?xml version='1.0'?>\n<!-- a --><launch><nod/></launch>", "xml")
        await editor.having(launch, "LCH004")
        assert await editor.hover(other, types.Position(0, 2)) is None
        assert await editor.symbols(other) == []
        assert editor.rules(other) is None
        editor.change(launch, "<robot/>")
        await editor.until(lambda: editor.published[launch.as_uri()].diagnostics == ())


@pytest.mark.parametrize("uri", ["untitled:Untitled-1", "git:/w/a.launch?%7B%7D", "vscode-notebook-cell:/a#x", "x"])
async def test_documents_that_are_no_files_do_no_harm(harness: Harness, uri: str) -> None:
    async with editing(harness) as editor:
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
        editor.open(harness.launch_file)
        await editor.having(harness.launch_file, "TRC004")
        assert uri not in editor.published


async def test_requests_for_files_that_are_not_open_are_answered_with_nothing(harness: Harness) -> None:
    async with editing(harness) as editor:
        assert await editor.hover(harness.launch_file, types.Position(0, 0)) is None
        assert await editor.definition(harness.launch_file, types.Position(0, 0)) == []
        assert await editor.symbols(harness.launch_file) == []


async def test_positions_past_the_end_are_answered(harness: Harness) -> None:
    async with editing(harness) as editor:
        editor.open(harness.launch_file)
        for where in (types.Position(0, 999), types.Position(999, 0), types.Position(2**31 - 1, 2**31 - 1)):
            await editor.hover(harness.launch_file, where)
            assert await editor.definition(harness.launch_file, where) == []


async def test_a_client_that_pulls_is_told_once(harness: Harness) -> None:
    inner = harness.workspace / "inner.launch"
    inner.write_text(UNDECLARED)
    outer = including(harness.workspace / "outer.launch", inner, text="  <nod/>\n")
    async with editing(harness, client=capabilities(pull=True)) as editor:
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


async def test_a_client_that_pulls_is_asked_again_when_runs_have_ended(harness: Harness) -> None:
    async with editing(harness, trusted=True, client=capabilities(pull=True)) as editor:
        editor.open(harness.launch_file)
        assert "TOP001" not in [d.code for d in await editor.pull(harness.launch_file)]
        await editor.until(lambda: editor.refreshes)
        await editor.once(lambda: editor.pull(harness.launch_file), lambda found: "TOP001" in [d.code for d in found])


async def test_a_client_that_pulls_but_cannot_be_asked_again_is_published_to(harness: Harness) -> None:
    async with editing(harness, trusted=True, client=capabilities(pull=True, refresh=False)) as editor:
        assert editor.result is not None
        assert editor.result.capabilities.diagnostic_provider is None
        editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)


async def test_a_new_package_is_found_when_its_manifest_appears(harness: Harness) -> None:
    workspace = harness.home / "catkin_ws"
    (workspace / "src").mkdir(parents=True)
    path = workspace / "a.launch"
    async with editing(harness, folder=workspace) as editor:
        editor.open(path, '<launch>\n  <param name="p" value="$(find new_one)"/>\n</launch>\n')
        await editor.having(path, "PKG001")
        await editor.until(lambda: types.WORKSPACE_DID_CHANGE_WATCHED_FILES in editor.registered)
        manifest = workspace / "src/new_one/package.xml"
        manifest.parent.mkdir()
        manifest.write_text("<package format='2'><name>new_one</name></package>")
        editor.watched(manifest, kind=types.FileChangeType.Created)
        await editor.without(path, "PKG001")


async def test_a_new_executable_is_found_when_it_appears(harness: Harness) -> None:
    path = harness.workspace / "a.launch"
    async with editing(harness) as editor:
        editor.open(path, '<launch>\n  <node pkg="preflight_demo" type="new.py" name="n"/>\n</launch>\n')
        await editor.having(path, "PKG002")
        script = harness.launch_file.parents[1] / "scripts/new.py"
        script.write_text("#!/usr/bin/env python3\n")
        script.chmod(0o755)
        editor.watched(script, kind=types.FileChangeType.Created)
        await editor.without(path, "PKG002")


async def test_a_file_changed_on_disk_counts(harness: Harness) -> None:
    inner = harness.workspace / "inner.launch"
    inner.write_text(EMPTY)
    outer = including(harness.workspace / "outer.launch", inner)
    async with editing(harness) as editor:
        editor.open(outer)
        await editor.until(lambda: editor.rules(outer) == [])
        inner.write_text(UNDECLARED)
        editor.watched(inner)
        await editor.having(inner, "ARG001")


async def test_rapid_edits_end_where_a_fresh_server_starts(harness: Harness) -> None:
    """Hundreds of edits at random places, many of which break the file, without waiting in between."""
    chance = random.Random(7)
    pieces = ["<", ">", "\n", "\r\n", '"', "$(arg x)", "größe", "𝒳", '<arg name="x" default="1"/>', "\f", "/", " "]
    path = harness.launch_file
    async with editing(harness, client=capabilities(encoding="utf-16")) as editor:
        editor.open(path)
        for step in range(300):
            text = editor.texts[path]
            start = chance.randrange(len(text) + 1)
            end = min(len(text), start + chance.choice((0, 0, 0, 1, 5)))
            start -= text[start - 1 : start + 1] == "\r\n"
            end += text[end - 1 : end + 1] == "\r\n"
            editor.replace(path, start, end, chance.choice(pieces))
            if step % 50 == 0:
                await asyncio.sleep(0.02)  # so that some of the states in between are analysed, whichever they are
        text = editor.texts[path]
        await editor.until(lambda: editor.diagnostics(path) is not None)
        async with editing(harness) as fresh:
            fresh.open(path, text)
            await fresh.until(
                lambda: fresh.diagnostics(path) is not None and _comparable(fresh, path) == _comparable(editor, path)
            )


async def test_rapid_edits_back_to_a_good_file(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        text = editor.open(harness.launch_file)
        for index in range(len(text) - 1, 20, -7):
            editor.replace(harness.launch_file, index, index + 1, "")
        editor.change(harness.launch_file, text)
        found = await editor.misspelling(harness.launch_file)
        assert editor.covered(harness.launch_file, found.range) == "chater"


def _comparable(editor: Editor, path: Path) -> list[tuple[object, types.Range, str]]:
    return [(d.code, d.range, d.message) for d in editor.diagnostics(path) or ()]


async def test_a_file_without_a_folder_finds_the_workspace_around_it(harness: Harness) -> None:
    async with editing(harness, trusted=True, without_folder=True) as editor:
        editor.open(harness.launch_file)
        found = await editor.misspelling(harness.launch_file)
        assert "chatter" in found.message
        await editor.until(lambda: editor.rules(harness.launch_file) == ["TOP001"])
