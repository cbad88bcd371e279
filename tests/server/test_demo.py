"""The whole way: from opening the demo's launch file to a finding about two real nodes, and its fix."""

from __future__ import annotations

import pytest
from lsprotocol import types
from support.editor_harness import Harness
from support.lsp_client import ENCODINGS, capabilities, editing
from support.waiting import until

pytestmark = pytest.mark.ros


async def test_the_missing_letter_is_found_and_mended(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        found = await editor.misspelling(harness.launch_file)
        assert found.severity == types.DiagnosticSeverity.Warning
        assert found.source == "ros-preflight"
        assert "'/chatter'" in found.message
        assert "/talker" in found.message
        assert editor.covered(harness.launch_file, found.range) == "chater"
        assert found.related_information
        assert found.related_information[0].location.uri == harness.launch_file.as_uri()

        actions = await editor.fixes(harness.launch_file, found.range)
        assert [(a.title, a.kind, a.is_preferred) for a in actions] == [
            ("Replace 'chater' with 'chatter'", types.CodeActionKind.QuickFix, True)
        ]
        assert [(d.code, d.range) for d in actions[0].diagnostics or ()] == [("TOP001", found.range)]
        editor.apply(actions[0].edit)
        assert '<remap from="chatter" to="chatter"/>' in editor.texts[harness.launch_file]
        # The mended remap now says what would be so without it.
        await editor.until(lambda: editor.rules(harness.launch_file) == ["LCH024"])
    until(lambda: harness.processes() == [])


async def test_a_remap_needs_no_new_run(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        text = editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
        runs = harness.sandbox_starts()
        at = text.index("chater")
        for _ in range(3):
            editor.replace(harness.launch_file, at, at + 6, "chatter")
            await editor.without(harness.launch_file, "TOP001")
            editor.replace(harness.launch_file, at, at + 7, "chater")
            await editor.misspelling(harness.launch_file)
        assert harness.sandbox_starts() == runs


async def test_a_parameter_that_is_read_runs_that_node_again_and_no_other(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        text = editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
        before, starts = set(editor.runs), harness.sandbox_starts()
        at = text.index('<param name="rate"')
        editor.replace(harness.launch_file, at, at, '<param name="never_read" value="1"/>')
        await editor.having(harness.launch_file, "PRM001")
        at = editor.texts[harness.launch_file].index('value="5"') + len('value="')
        editor.replace(harness.launch_file, at, at + 1, "7")
        ended = await editor.until(
            lambda: next((v for t, v in editor.runs.items() if t not in before and v[-1]["kind"] == "end"), None), 60
        )
        assert ended[-1]["message"] == "1 node"
        assert harness.sandbox_starts() == starts + 1


async def test_findings_stay_while_other_text_is_typed(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
        editor.history.clear()
        for letter in "<!-- a word -->":
            editor.replace(harness.launch_file, len("<launch>\n"), len("<launch>\n"), letter)
            version = editor.versions[harness.launch_file]
            await editor.until(lambda version=version: editor.history and editor.history[-1].version == version)
        broken = [p for p in editor.history if "TOP001" not in {str(d.code) for d in p.diagnostics}]
        assert broken == []


async def test_progress_is_shown_while_nodes_run(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
        await editor.until(lambda: any(v["kind"] == "end" for values in editor.runs.values() for v in values))
        (values,) = editor.runs.values()
        kinds = [v["kind"] for v in values]
        assert kinds[0] == "begin"
        assert kinds[-1] == "end"
        assert values[0]["cancellable"] is True


async def test_a_second_server_needs_no_run(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
    runs = harness.sandbox_starts()
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
        assert editor.runs == {}
    assert harness.sandbox_starts() - runs <= 1, "only the probe of the sandbox"


@pytest.mark.parametrize("encoding", ENCODINGS)
async def test_columns_behind_other_scripts(harness: Harness, encoding: str) -> None:
    async with editing(harness, trusted=True, client=capabilities(encoding=encoding)) as editor:
        assert editor.result is not None
        assert editor.result.capabilities.position_encoding == encoding
        text = harness.launch_file.read_text().replace("<remap from=", "<!-- größe 漢字 𝒳 --><remap from=")
        editor.open(harness.launch_file, text)
        found = await editor.misspelling(harness.launch_file)
        assert editor.covered(harness.launch_file, found.range) == "chater"
        actions = await editor.fixes(harness.launch_file, found.range)
        editor.apply(actions[0].edit)
        assert '𝒳 --><remap from="chatter" to="chatter"/>' in editor.texts[harness.launch_file]
        # The mended remap now says what would be so without it.
        await editor.until(lambda: editor.rules(harness.launch_file) == ["LCH024"])


async def test_a_client_that_names_no_encoding_gets_utf_16(harness: Harness) -> None:
    async with editing(harness, trusted=True, client=capabilities(encoding=None)) as editor:
        text = harness.launch_file.read_text().replace("<remap from=", "<!-- 𝒳 --><remap from=")
        editor.open(harness.launch_file, text)
        found = await editor.misspelling(harness.launch_file)
        assert editor.covered(harness.launch_file, found.range) == "chater"
