"""The tree of nodes, the status and the requests that look after the runs, through the protocol."""

from __future__ import annotations

import itertools
from typing import Any

import pytest
from editor_desk import Desk
from lsp_desk import Editor, editing

pytestmark = pytest.mark.ros


async def ask(editor: Editor, method: str, params: Any) -> Any:
    return await editor.client.protocol.send_request_async(f"rosPreflight/{method}", params)


async def tree_of(editor: Editor, desk: Desk) -> Any:
    return await ask(editor, "tree", {"uri": desk.launch_file.as_uri()})


async def test_the_tree_has_the_nodes_with_what_is_wrong(desk: Desk) -> None:
    async with editing(desk, trusted=True) as editor:
        editor.open(desk.launch_file)
        await editor.having(desk.launch_file, "TOP001")
        tree = await tree_of(editor, desk)
        assert tree.root.uri == desk.launch_file.as_uri()
        assert list(tree.files) == [desk.launch_file.as_uri()]
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


async def test_the_tree_of_a_file_that_does_not_parse(desk: Desk) -> None:
    async with editing(desk) as editor:
        text = desk.launch_file.read_text().replace("</launch>", '<node name="half')
        editor.open(desk.launch_file, text)
        tree = await tree_of(editor, desk)
        assert [item.name for item in tree.items][:2] == ["/talker", "/listener"]


async def test_there_is_no_tree_of_what_is_no_launch_file(desk: Desk) -> None:
    async with editing(desk) as editor:
        assert await ask(editor, "tree", {"uri": "file:///nowhere.launch"}) is None
        assert await ask(editor, "tree", {"uri": 5}) is None


async def test_the_status_is_told_to_those_who_ask(desk: Desk) -> None:
    async with editing(desk, settings={"status": True}) as editor:
        editor.open(desk.launch_file)
        await editor.having(desk.launch_file, "TRC004")
        await editor.until(lambda: any(s.notRun and s.notRun.kind == "untrusted" for s in editor.statuses))
        await editor.until(lambda: any(s.state == "indexing" for s in editor.statuses))
        editor.trust()
        await editor.until(lambda: any((s.state, s.done, s.total) == ("tracing", 1, 2) for s in editor.statuses))
        await editor.until(lambda: editor.statuses[-1].state == "idle" and editor.statuses[-1].notRun is None)
        assert editor.analysed > 0


async def test_the_status_is_not_told_to_others(desk: Desk) -> None:
    async with editing(desk, trusted=True) as editor:
        editor.open(desk.launch_file)
        await editor.having(desk.launch_file, "TOP001")
        assert (editor.statuses, editor.analysed) == ([], 0)


async def test_nodes_are_run_anew(desk: Desk) -> None:
    async with editing(desk, trusted=True, settings={"status": True}) as editor:
        uri = desk.launch_file.as_uri()
        editor.open(desk.launch_file)
        await editor.until(lambda: batches(editor) == 1)
        starts = desk.sandbox_starts()
        where = editor.at(desk.launch_file, '<param name="rate"')
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
            assert desk.sandbox_starts() == starts
        answer = await ask(editor, "trace", {"uri": uri, "position": {"line": 0, "character": 0}})
        assert (list(answer.nodes), answer.message) == ([], "no node is started here")


def batches(editor: Editor) -> int:
    """How many batches of runs have ended."""
    states = [status.state for status in editor.statuses]
    return sum(one == "tracing" != other for one, other in itertools.pairwise(states))


async def test_without_trust_no_node_is_run_anew(desk: Desk) -> None:
    async with editing(desk) as editor:
        editor.open(desk.launch_file)
        await editor.having(desk.launch_file, "TRC004")
        answer = await ask(editor, "trace", {"uri": desk.launch_file.as_uri()})
        assert "not trusted" in answer.message
        await editor.having(desk.launch_file, "TRC004")
    assert desk.sandbox_starts() == 0


async def test_what_runs_told_is_forgotten(desk: Desk) -> None:
    traces = desk.home / ".cache/ros-preflight/traces"
    async with editing(desk, trusted=True) as editor:
        editor.open(desk.launch_file)
        await editor.having(desk.launch_file, "TOP001")
        await editor.until(lambda: len(list(traces.rglob("*.json"))) == 2)
        starts = desk.sandbox_starts()
        answer = await ask(editor, "clearCache", {})
        assert answer.entries == 2
        assert answer.bytes > 0
        await editor.until(lambda: desk.sandbox_starts() == starts + 2)
        await editor.having(desk.launch_file, "TOP001")


async def test_the_doctor_answers(desk: Desk) -> None:
    async with editing(desk, trusted=True) as editor:
        answer = await ask(editor, "doctor", {})
        assert str(desk.workspace) in answer.text
        assert "sandbox" in answer.text
