"""The tree of nodes, the status and the requests that look after the runs, through the protocol."""

from __future__ import annotations

import itertools
from typing import Any

import pytest
from support.editor_harness import Harness
from support.lsp_client import Editor, editing

pytestmark = pytest.mark.ros


async def ask(editor: Editor, method: str, params: Any) -> Any:
    return await editor.client.protocol.send_request_async(f"rosPreflight/{method}", params)


async def tree_of(editor: Editor, harness: Harness) -> Any:
    return await ask(editor, "tree", {"uri": harness.launch_file.as_uri()})


async def test_the_tree_has_the_nodes_with_what_is_wrong(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
        tree = await tree_of(editor, harness)
        assert tree.root.uri == harness.launch_file.as_uri()
        assert list(tree.files) == [harness.launch_file.as_uri()]
        talker, listener = tree.items
        assert (talker.kind, talker.label, talker.detail, talker.name, talker.file) == (
            "node",
            "talker",
            "preflight_demo/talker.py",
            "/talker",
            0,
        )
        assert [(c.kind, c.label, c.detail) for c in talker.children] == [("param", "rate", "5")]
        assert [(c.kind, c.label) for c in listener.children] == [("remap", "chatter → chater")]
        assert (talker.severity, talker.findings) == (None, 0)
        assert (listener.severity, listener.findings) == (2, 1)
        assert listener.location.range.start.line == 5


async def test_the_tree_of_a_file_that_does_not_parse(harness: Harness) -> None:
    async with editing(harness) as editor:
        text = harness.launch_file.read_text().replace("</launch>", '<node name="half')
        editor.open(harness.launch_file, text)
        tree = await tree_of(editor, harness)
        assert [item.name for item in tree.items][:2] == ["/talker", "/listener"]


async def test_there_is_no_tree_of_what_is_no_launch_file(harness: Harness) -> None:
    async with editing(harness) as editor:
        assert await ask(editor, "tree", {"uri": "file:///nowhere.launch"}) is None
        assert await ask(editor, "tree", {"uri": 5}) is None


async def test_the_status_is_told_to_those_who_ask(harness: Harness) -> None:
    async with editing(harness, settings={"status": True}) as editor:
        editor.open(harness.launch_file)
        await editor.having(harness.launch_file, "TRC004")
        await editor.until(lambda: any(s.notRun and s.notRun.kind == "untrusted" for s in editor.statuses))
        await editor.until(lambda: any(s.state == "indexing" for s in editor.statuses))
        editor.trust()
        await editor.until(lambda: any((s.state, s.done, s.total) == ("tracing", 1, 2) for s in editor.statuses))
        await editor.until(lambda: editor.statuses[-1].state == "idle" and editor.statuses[-1].notRun is None)
        assert editor.analysed > 0


async def test_the_status_is_not_told_to_others(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
        assert (editor.statuses, editor.analysed) == ([], 0)


async def test_nodes_are_run_anew(harness: Harness) -> None:
    async with editing(harness, trusted=True, settings={"status": True}) as editor:
        uri = harness.launch_file.as_uri()
        editor.open(harness.launch_file)
        await editor.until(lambda: batches(editor) == 1)
        starts = harness.sandbox_starts()
        where = editor.at(harness.launch_file, '<param name="rate"')
        position = {"line": where.line, "character": where.character}
        for done, (asked, nodes) in enumerate(
            [
                ({"position": position}, ["/talker"]),
                ({"node": "/listener"}, ["/listener"]),
                ({}, ["/talker", "/listener"]),
            ]
        ):
            answer = await ask(editor, "trace", {"uri": uri, **asked})
            assert (list(answer.nodes), answer.message) == (nodes, None)
            starts += len(nodes)
            await editor.until(lambda ended=done + 2: batches(editor) == ended)
            assert harness.sandbox_starts() == starts
        answer = await ask(editor, "trace", {"uri": uri, "position": {"line": 0, "character": 0}})
        assert (list(answer.nodes), answer.message) == ([], "no node starts on this line")


def batches(editor: Editor) -> int:
    """How many batches of runs have ended."""
    states = [status.state for status in editor.statuses]
    return sum(one == "tracing" != other for one, other in itertools.pairwise(states))


async def test_without_trust_no_node_is_run_anew(harness: Harness) -> None:
    async with editing(harness) as editor:
        editor.open(harness.launch_file)
        await editor.having(harness.launch_file, "TRC004")
        answer = await ask(editor, "trace", {"uri": harness.launch_file.as_uri()})
        assert "not trusted" in answer.message
        await editor.having(harness.launch_file, "TRC004")
    assert harness.sandbox_starts() == 0


async def test_what_runs_told_is_forgotten(harness: Harness) -> None:
    traces = harness.home / ".cache/ros-preflight/traces"
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
        await editor.until(lambda: len(list(traces.rglob("*.json"))) == 2)
        starts = harness.sandbox_starts()
        answer = await ask(editor, "clearCache", {})
        assert answer.entries == 2
        assert answer.bytes > 0
        await editor.until(lambda: harness.sandbox_starts() == starts + 2)
        await editor.misspelling(harness.launch_file)


async def test_the_doctor_answers(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        answer = await ask(editor, "doctor", {})
        assert str(harness.workspace) in answer.text
        assert "sandbox" in answer.text
