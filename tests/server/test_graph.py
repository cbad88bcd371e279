"""The picture of the graph, through the protocol."""

from __future__ import annotations

from typing import Any

import pytest
from support.editor_harness import Harness
from support.lsp_client import Editor, editing

pytestmark = pytest.mark.ros


async def ask(editor: Editor, harness: Harness, **more: Any) -> Any:
    return await editor.client.protocol.send_request_async(
        "rosPreflight/graph", {"uri": harness.launch_file.as_uri(), **more}
    )


def topics(graph: Any) -> list[str]:
    return [channel.name for channel in graph.channels]


async def test_the_graph_has_findings_on_its_edges_and_lines_to_go_to(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
        graph = (await ask(editor, harness)).graph
        assert topics(graph) == ["/chater", "/chatter"]
        assert [(node.name, node.places[0].line) for node in graph.nodes] == [("/talker", 3), ("/listener", 6)]
        (wanting,) = (edge for edge in graph.edges if edge.role == "subscriber")
        assert [graph.findings[i].rule for i in wanting.findings] == ["TOP001"]
        source, launch = wanting.places
        assert source.shown.endswith("scripts/listener.py")
        assert (launch.file, launch.line) == (str(harness.launch_file), 7)
        assert graph.svg.startswith("<svg ")
        assert graph.title == str(harness.launch_file.relative_to(harness.workspace))


async def test_what_every_node_has_is_there_on_demand(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
        assert "/rosout" in topics((await ask(editor, harness, builtin=True)).graph)


async def test_the_graph_follows_the_text_and_is_sent_when_it_is_news(harness: Harness) -> None:
    async with editing(harness, trusted=True, settings={"status": True}) as editor:
        editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
        first = await ask(editor, harness)
        while (again := await ask(editor, harness, known=first.digest)).graph is not None:
            first = again  # runs may still tell something
        assert again.digest == first.digest
        editor.change(harness.launch_file, editor.texts[harness.launch_file].replace("chater", "chatter"))
        await editor.once(
            lambda: ask(editor, harness, known=first.digest),
            lambda then: then.graph is not None and topics(then.graph) == ["/chatter"],
        )


async def test_before_anything_is_run_the_graph_is_what_the_sources_tell(harness: Harness) -> None:
    async with editing(harness) as editor:
        editor.open(harness.launch_file)
        await editor.having(harness.launch_file, "TRC004")
        graph = (await ask(editor, harness)).graph
        assert [node.name for node in graph.nodes] == ["/talker", "/listener"]
    assert harness.sandbox_starts() == 0


async def test_the_graph_of_a_file_that_does_not_parse(harness: Harness) -> None:
    async with editing(harness) as editor:
        text = harness.launch_file.read_text().replace("</launch>", '<node name="half')
        editor.open(harness.launch_file, text)
        graph = (await ask(editor, harness)).graph
        assert [node.name for node in graph.nodes][:2] == ["/talker", "/listener"]


async def test_there_is_no_graph_of_what_is_no_launch_file(harness: Harness) -> None:
    async with editing(harness) as editor:
        for uri in ("file:///nowhere.launch", 5, None):
            assert await ask(editor, harness, uri=uri) is None
