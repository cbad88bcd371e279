"""Signature help, semantic tokens, folding, links and inlay hints through the real server, in broken files as well."""

from __future__ import annotations

from pathlib import Path

import pytest
from lsprotocol import types
from support.editor_harness import Harness
from support.lsp_client import ENCODINGS, Editor, capabilities, editing, position

pytestmark = pytest.mark.ros

INNER = """<launch>
  <arg name="rate" default="1" doc="In Hz"/>
  <arg name="näme"/>
  <param name="🤖" value="$(arg näme) $(arg rate)"/>
</launch>
"""
OUTER = """<launch>
  <!-- two
       lines -->
  <arg name="dir" default="launch"/>
  <include file="$(find preflight_demo)/$(arg dir)/inner.launch">
    <arg name="näme" value="🤖é"/>
  </include>
</launch>
"""
BROKEN = OUTER.replace("  </include>\n", '    <arg name="rate" value="$(eval 2 * 3)\n')


@pytest.fixture
def outer(harness: Harness) -> Path:
    harness.write("inner.launch", INNER)
    return harness.write("outer.launch", OUTER)


@pytest.fixture
def inner(outer: Path) -> Path:
    return outer.with_name("inner.launch")


async def shown(editor: Editor, path: Path, range_: types.Range | None = None) -> list[str]:
    """The hints, each behind what is before it on its line."""
    found = []
    for hint in await editor.hints(path, range_):
        line = types.Range(types.Position(hint.position.line, 0), hint.position)
        found.append(f"{editor.covered(path, line).strip()} {hint.label}")
    return found


@pytest.mark.parametrize("text", [OUTER, BROKEN])
async def test_signature_of_an_include(harness: Harness, outer: Path, text: str) -> None:
    async with editing(harness) as editor:
        editor.open(outer, text)
        found = await editor.signature(outer, editor.at(outer, "🤖é", 1))
        assert found is not None
        (signature,) = found.signatures
        assert signature.label == "inner.launch(näme, rate:=1)"
        parameters = signature.parameters or ()
        assert [p.label for p in parameters] == [(13, 17), (19, 26)]
        assert isinstance(parameters[1].documentation, types.MarkupContent)
        assert parameters[1].documentation.value == "In Hz"
        assert found.active_parameter == 0
        between = await editor.signature(outer, editor.at(outer, '    <arg name="näme"', 2))
        assert between is not None and between.active_parameter == 2, "none of the two"
        assert await editor.signature(outer, editor.at(outer, "<arg")) is None


@pytest.mark.parametrize("encoding", ENCODINGS)
async def test_semantic_tokens(harness: Harness, outer: Path, inner: Path, encoding: str) -> None:
    async with editing(harness, client=capabilities(encoding=encoding)) as editor:
        editor.open(inner)
        value = [
            ("$(", "operator"),
            ("arg", "keyword"),
            ("näme", "parameter"),
            (")", "operator"),
            ("$(", "operator"),
            ("arg", "keyword"),
            ("rate", "parameter"),
            (")", "operator"),
        ]
        assert await editor.tokens(inner) == value
        start = types.Range(types.Position(0, 0), types.Position(1, 0))
        assert await editor.tokens(inner, start) == []

        editor.open(outer, BROKEN)
        found = await editor.tokens(outer)
        assert ("preflight_demo", "namespace") in found
        assert found[-5:] == [
            ("eval", "keyword"),
            ("2", "number"),
            ("*", "operator"),
            ("3", "number"),
            (")", "operator"),
        ]


async def test_folding(harness: Harness, outer: Path) -> None:
    async with editing(harness) as editor:
        editor.open(outer)
        folds = [(f.start_line, f.end_line, f.kind) for f in await editor.folds(outer)]
        assert folds == [(0, 6, None), (1, 2, "comment"), (4, 5, None)]
        editor.change(outer, BROKEN)
        folds = [(f.start_line, f.end_line, f.kind) for f in await editor.folds(outer)]
        assert folds == [(0, 6, None), (1, 2, "comment"), (4, 6, None)]


@pytest.mark.parametrize("text", [OUTER, BROKEN])
async def test_document_links(harness: Harness, outer: Path, inner: Path, text: str) -> None:
    async with editing(harness) as editor:
        editor.open(outer, text)
        (link,) = await editor.links(outer)
        assert editor.covered(outer, link.range) == "$(find preflight_demo)/$(arg dir)/inner.launch"
        assert link.target == inner.as_uri()
        assert link.tooltip == str(inner)


@pytest.mark.parametrize("encoding", ENCODINGS)
async def test_inlay_hints(harness: Harness, outer: Path, inner: Path, encoding: str) -> None:
    async with editing(harness, client=capabilities(encoding=encoding)) as editor:
        editor.open(outer)
        (hint,) = await shown(editor, outer)
        assert hint.startswith('<include file="$(find preflight_demo)/$(arg dir)/inner.launch" = …/')
        assert hint.endswith("/launch/inner.launch")
        editor.open(inner)
        value = '<param name="🤖" value="$(arg näme) $(arg rate)"'
        await editor.once(lambda: shown(editor, inner), lambda hints: hints == [f"{value} = 🤖é 1"])
        top = types.Range(types.Position(0, 0), types.Position(2, 0))
        assert await shown(editor, inner, top) == []
        editor.change(outer, BROKEN)
        assert (await shown(editor, outer))[-1] == '<arg name="rate" value="$(eval 2 * 3) = 6'
        await editor.once(lambda: shown(editor, inner), lambda hints: hints == [f"{value} = 🤖é 6"])


async def test_hints_are_asked_for_again_when_another_file_changed_them(
    harness: Harness, outer: Path, inner: Path
) -> None:
    async with editing(harness) as editor:
        editor.open(inner)
        editor.open(outer)
        value = '<param name="🤖" value="$(arg näme) $(arg rate)"'
        await editor.once(lambda: shown(editor, inner), lambda hints: hints == [f"{value} = 🤖é 1"])
        before = editor.hint_refreshes
        editor.change(outer, OUTER.replace("🤖é", "other"))
        await editor.until(lambda: editor.hint_refreshes > before)
        await editor.once(lambda: shown(editor, inner), lambda hints: hints == [f"{value} = other 1"])


async def test_hints_can_be_switched_off_and_on(harness: Harness, outer: Path) -> None:
    async with editing(harness, settings={"inlayHints": False}) as editor:
        editor.open(outer)
        assert await editor.hints(outer) == []
        for on in (True, False):
            before = editor.hint_refreshes
            editor.client.set_configuration({"rosPreflight": {"inlayHints": on}})
            editor.client.workspace_did_change_configuration(types.DidChangeConfigurationParams({}))
            await editor.until(lambda before=before: editor.hint_refreshes > before)  # type: ignore[misc]
            await editor.once(lambda: editor.hints(outer), lambda hints, on=on: bool(hints) == on)


async def test_an_empty_file_has_none_of_it(harness: Harness, outer: Path) -> None:
    async with editing(harness) as editor:
        editor.open(outer, "")
        assert await editor.signature(outer, position("", 0, editor.encoding)) is None
        assert await editor.tokens(outer) == []
        assert await editor.folds(outer) == []
        assert await editor.links(outer) == []
        assert await editor.hints(outer) == []
