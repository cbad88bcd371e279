"""Call hierarchy over includes, workspace symbols and code lenses, through the real server."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from lsprotocol import types
from support.editor_harness import Harness
from support.lsp_client import Editor, capabilities, editing, from_uri, position

pytestmark = pytest.mark.ros

OUTER = """<launch>
  <!-- 🤖 --><include file="$(find preflight_demo)/launch/inner.launch"><arg name="rate" value="7"/></include>
  <!-- ü --><include file="$(find preflight_demo)/launch/inner.launch" ns="b"><arg name="rate" value="8"/></include>
  <node pkg="preflight_demo" type="listener.py" name="listener"/>
</launch>
"""
INNER = """<launch>
  <arg name="rate"/>
  <node pkg="preflight_demo" type="talker.py" name="talker"/>
</launch>
"""
COMMANDS = {"clientCommands": ["rosPreflight.showReferences", "rosPreflight.selectRoot"]}


@pytest.fixture
def files(harness: Harness) -> tuple[Path, Path]:
    return harness.write("outer.launch", OUTER), harness.write("inner.launch", INNER)


async def titles(editor: Editor, path: Path) -> list[str]:
    return [lens.command.title for lens in await editor.lenses(path) if lens.command is not None]


async def reached(editor: Editor, root: Path) -> None:
    """Wait until the root of the open file is known: why its nodes are not run is said there."""
    await editor.until(lambda: root.as_uri() in editor.published)


async def test_who_includes_a_file_and_what_it_includes(harness: Harness, files: tuple[Path, Path]) -> None:
    outer, inner = files
    async with editing(harness) as editor:
        editor.open(inner, INNER + "<unfinished")
        await reached(editor, outer)
        (item,) = await editor.hierarchy(inner, editor.at(inner, "<launch>"))
        assert (item.name, item.detail, item.kind) == ("inner.launch", "launch", types.SymbolKind.File)
        (call,) = (
            await editor.client.call_hierarchy_incoming_calls_async(types.CallHierarchyIncomingCallsParams(item)) or ()
        )
        assert (from_uri(call.from_.uri), call.from_.detail) == (outer, "launch, rate:=7, rate:=8")
        starts = [
            position(OUTER, OUTER.index(m) + len(m), "utf-16")
            for m in ('🤖 --><include file="', 'ü --><include file="')
        ]
        assert [r.start for r in call.from_ranges] == starts

        called = await editor.client.call_hierarchy_outgoing_calls_async(
            types.CallHierarchyOutgoingCallsParams(call.from_)
        )
        (back,) = called or ()
        assert (from_uri(back.to.uri), [r.start for r in back.from_ranges]) == (inner, starts)
        none = await editor.client.call_hierarchy_outgoing_calls_async(types.CallHierarchyOutgoingCallsParams(item))
        assert not none

        editor.open(outer)
        (item,) = await editor.hierarchy(outer, editor.at(outer, "find preflight_demo", -2))
        assert item.name == "inner.launch"


async def test_nodes_files_and_topics_of_the_workspace(harness: Harness, files: tuple[Path, Path]) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)

        async def found(query: str) -> list[tuple[str, str, types.SymbolKind]]:
            symbols = await editor.client.workspace_symbol_async(types.WorkspaceSymbolParams(query))
            kinds = (s for s in symbols or () if isinstance(s, types.SymbolInformation))
            return [(s.name, from_uri(s.location.uri).name, s.kind) for s in kinds]

        assert ("/chatter", "talker_listener.launch", types.SymbolKind.Event) in await found("chatter")
        assert ("inner.launch", "inner.launch", types.SymbolKind.File) in await found("inlaunch")
        assert ("/b/talker", "inner.launch", types.SymbolKind.Class) in await found("BTALKER")


async def test_lenses_and_their_commands(harness: Harness, files: tuple[Path, Path]) -> None:
    outer, inner = files
    async with editing(harness, settings=COMMANDS) as editor:
        editor.open(inner)
        await reached(editor, outer)
        includers, nodes, root = await editor.lenses(inner)
        assert includers.command is not None
        assert (includers.command.title, includers.command.command) == (
            "included by 2 files",
            "rosPreflight.showReferences",
        )
        assert len((includers.command.arguments or [])[2]) == 2
        assert nodes.command is not None
        assert (nodes.command.title, nodes.command.command) == ("2 of 3 nodes", "")
        assert root.command is not None
        assert (root.command.title, root.command.command) == ("launched by outer.launch", "rosPreflight.selectRoot")
        assert list(root.command.arguments or ()) == [inner.as_uri()]
        assert editor.covered(inner, root.range) == "<launch>"


@pytest.mark.parametrize("settings", [None, {"clientCommands": 7}], ids=["none", "nonsense"])
async def test_lenses_for_a_client_without_our_commands(
    harness: Harness, files: tuple[Path, Path], settings: dict[str, Any] | None
) -> None:
    outer, _ = files
    async with editing(harness, settings=settings) as editor:
        editor.open(outer, OUTER.replace("</launch>", "<node "))
        found = await editor.lenses(outer)
        assert [lens.command.command for lens in found if lens.command] == ["", "", "rosPreflight.askForRoot"]
        assert await titles(editor, outer) == ["not included by any file", "3 nodes", "launched by this file"]


async def test_lenses_are_asked_for_again_when_another_file_changed_them(
    harness: Harness, files: tuple[Path, Path]
) -> None:
    outer, inner = files
    async with editing(harness) as editor:
        editor.open(inner)
        await reached(editor, outer)
        assert (await titles(editor, inner))[1] == "2 of 3 nodes"
        before = editor.lens_refreshes
        outer.write_text(OUTER.replace(' ns="b"', ' ns="b" if="false"'))
        editor.watched(outer)
        await editor.until(lambda: editor.lens_refreshes > before)
        await editor.once(lambda: titles(editor, inner), lambda shown: shown[1] == "1 of 2 nodes")


async def test_no_refresh_for_a_client_that_knows_none(harness: Harness, files: tuple[Path, Path]) -> None:
    outer, inner = files
    async with editing(harness, client=capabilities(refresh=False)) as editor:
        editor.open(inner)
        await reached(editor, outer)
        await editor.lenses(inner)
        outer.write_text(OUTER.replace(' ns="b"', ' ns="b" if="false"'))
        editor.watched(outer)
        await editor.once(lambda: titles(editor, inner), lambda shown: shown[1] == "1 of 2 nodes")
        assert editor.lens_refreshes == 0


async def test_a_file_that_is_not_evaluated_says_so(harness: Harness) -> None:
    path = harness.launch_file.with_name("late.launch.py")
    path.write_text("def generate_launch_description():\n    return nothing\n")
    async with editing(harness) as editor:
        editor.open(path, language="python")
        await editor.having(path, "LCH032")
        found = await editor.once(lambda: titles(editor, path), lambda shown: "NameError" in shown[0])
        assert found[0] == "not evaluated: NameError: name 'nothing' is not defined"
        other = harness.write("other.launch", "<lanch></lanch>")
        editor.open(other)
        assert (await titles(editor, other))[0] == "not evaluated: it has no root element 'launch'"
        editor.change(other, "")
        assert await titles(editor, other) == []


@pytest.mark.silent
async def test_a_file_that_is_evaluated_says_nothing_of_it(harness: Harness) -> None:
    path = harness.launch_file.with_name("good.launch.py")
    path.write_text(
        "from launch import LaunchDescription\n\n\n"
        "def generate_launch_description():\n    return LaunchDescription([])\n"
    )
    async with editing(harness, trusted=True) as editor:
        editor.open(path, language="python")
        await editor.once(
            lambda: titles(editor, path),
            lambda shown: shown == ["not included by any file", "0 nodes", "launched by this file"],
        )


async def test_the_nodes_that_run_are_seen(harness: Harness) -> None:
    scripts = harness.workspace / "scripts"
    (scripts / "slow.py").write_text("#!/usr/bin/env python3\nimport time\nwhile True:\n    time.sleep(0.1)\n")
    (scripts / "slow.py").chmod(0o755)
    path = harness.write(
        "slow.launch", '<launch>\n  <node pkg="preflight_demo" type="slow.py" name="slow"/>\n</launch>\n'
    )
    async with editing(harness, trusted=True) as editor:
        editor.open(path)
        await editor.once(lambda: titles(editor, path), lambda shown: "running in the sandbox: /slow" in shown)
        before = editor.lens_refreshes
        await editor.until(lambda: editor.lens_refreshes > before)
        await editor.having(path, "TRC003")
        await editor.once(lambda: titles(editor, path), lambda shown: len(shown) == 3)
