"""Why two nodes are connected or not, and why one is started, through the protocol."""

from __future__ import annotations

from typing import Any

import pytest
from support.editor_harness import Harness
from support.lsp_client import Editor, editing

pytestmark = pytest.mark.ros


async def ask(editor: Editor, uri: object, **more: Any) -> Any:
    return await editor.client.protocol.send_request_async("rosPreflight/why", {"uri": uri, **more})


async def test_the_first_link_that_breaks(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
        answer = await ask(editor, harness.launch_file.as_uri(), nodes=["/talker", "/listener"])
        assert answer.message is None
        (chain,) = answer.chains
        assert chain.title == (
            "/talker -> /listener: not connected: '/chatter' and '/chater' are different topic names"
        )
        broken = next(link for link in chain.links if link.state == "broken")
        assert (broken.location.uri, broken.location.range.start.line) == (harness.launch_file.as_uri(), 6)
        assert list(broken.fixes) == ["Replace 'chater' with 'chatter'"]


async def test_the_nodes_that_may_be_asked_for(harness: Harness) -> None:
    async with editing(harness) as editor:
        editor.open(harness.launch_file)
        at = {"line": 5, "character": 4}
        answer = await ask(editor, harness.launch_file.as_uri(), position=at, nodes=[])
        assert (list(answer.all), answer.at, list(answer.chains)) == (["/talker", "/listener"], "/listener", [])


async def test_why_a_node_is_started(harness: Harness) -> None:
    async with editing(harness) as editor:
        editor.open(harness.launch_file)
        answer = await ask(editor, harness.launch_file.as_uri(), nodes=["/talker"])
        (chain,) = answer.chains
        assert (chain.title, [link.state for link in chain.links]) == ("/talker is started", ["ok"])


@pytest.mark.parametrize("nodes", [["/talker", "/nobody"], ["/nobody"]])
async def test_a_node_that_is_not_there(harness: Harness, nodes: list[str]) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
        answer = await ask(editor, harness.launch_file.as_uri(), nodes=nodes)
        assert (answer.message, list(answer.chains)) == ("no node '/nobody' in this launch", [])


async def test_what_is_no_question(harness: Harness) -> None:
    async with editing(harness) as editor:
        editor.open(harness.launch_file)
        assert await ask(editor, 5) is None
        assert await ask(editor, "file:///nowhere.launch", nodes=["/a", "/b"]) is None
        answer = await ask(editor, harness.launch_file.as_uri(), nodes="/talker", position=3)
        assert (list(answer.chains), answer.at, answer.message) == ([], None, None)
