"""Completion through the real server, mostly in files that do not parse: that is where people type."""

from __future__ import annotations

from pathlib import Path

import pytest
from lsprotocol import types
from support.editor_harness import Harness
from support.lsp_client import ENCODINGS, Editor, capabilities, editing, position

pytestmark = pytest.mark.ros

CURSOR = "$0"


@pytest.fixture
def path(harness: Harness) -> Path:
    inner = '<launch>\n  <arg name="rate" default="1" doc="In Hz"/>\n  <arg name="robot"/>\n</launch>\n'
    harness.launch_file.with_name("inner.launch").write_text(inner)
    return harness.launch_file.with_name("typed.launch")


async def at_cursor(editor: Editor, path: Path, text: str, trigger: str | None = None) -> list[types.CompletionItem]:
    """What is offered in a text at its cursor."""
    offset = text.index(CURSOR)
    text = text.replace(CURSOR, "")
    if path in editor.texts:
        editor.change(path, text)
    else:
        editor.open(path, text)
    return await editor.completion(path, position(text, offset, editor.encoding), trigger)


def labels(items: list[types.CompletionItem]) -> list[str]:
    """In the order in which an editor shows them."""
    return [item.label for item in sorted(items, key=lambda item: item.sort_text or item.label)]


async def test_the_server_says_what_triggers(harness: Harness) -> None:
    async with editing(harness) as editor:
        assert editor.result is not None
        provider = editor.result.capabilities.completion_provider
        assert provider is not None
        assert set(provider.trigger_characters or ()) == set("< \"'/$(:>")


async def test_what_is_looked_at_is_explained(harness: Harness, path: Path) -> None:
    async with editing(harness) as editor:
        packages = await at_cursor(editor, path, '<launch>\n  <node pkg="$0"/>\n</launch>\n')
        found = {item.label: item for item in packages}
        assert found["preflight_demo"].documentation is None
        resolved = await editor.client.completion_item_resolve_async(found["preflight_demo"])
        assert isinstance(resolved.documentation, types.MarkupContent)
        assert resolved.documentation.value.startswith("package `preflight_demo`")
        (script, *_) = await at_cursor(editor, path, '<launch>\n  <node pkg="preflight_demo" type="$0"/>\n</launch>\n')
        resolved = await editor.client.completion_item_resolve_async(script)
        assert isinstance(resolved.documentation, types.MarkupContent)
        assert "`chatter` `std_msgs/String`" in resolved.documentation.value
        script.data = {"not": "ours"}
        again = await editor.client.completion_item_resolve_async(script)
        assert again.label == script.label


async def test_from_an_empty_file_on(harness: Harness, path: Path) -> None:
    async with editing(harness) as editor:
        assert labels(await at_cursor(editor, path, CURSOR)) == ["launch"]
        (launch,) = await at_cursor(editor, path, "<lau$0", "<")
        assert launch.insert_text_format == types.InsertTextFormat.Snippet
        editor.accept(path, launch)
        assert editor.texts[path] == "<launch>\n\t$0\n</launch>"

        elements = await at_cursor(editor, path, "<launch>\n  <$0\n</launch>\n", "<")
        assert labels(elements)[:3] == ["node", "include", "arg"]
        assert editor.accept(path, elements[0]) == '  <node pkg="$1" type="$2" name="$3"/>'
        assert isinstance(elements[0].documentation, types.MarkupContent)
        assert elements[0].documentation.value == "Starts a node."


async def test_packages_executables_files_and_arguments_while_typing(harness: Harness, path: Path) -> None:
    async with editing(harness) as editor:
        typed = '<launch>\n  <arg name="name" default="x"/>\n  <node pkg="$0'
        packages = await at_cursor(editor, path, typed, '"')
        assert labels(packages)[0] == "preflight_demo", "the workspace's own package comes first"

        typed = typed.replace(CURSOR, 'preflight_demo" type="ta$0\n</launch>')
        talker = next(i for i in await at_cursor(editor, path, typed) if i.label == "talker.py")
        assert editor.accept(path, talker) == '  <node pkg="preflight_demo" type="talker.py'

        typed = '<launch>\n  <include file="$(find preflight_demo)/launch/in$0\n</launch>'
        (inner,) = [i for i in await at_cursor(editor, path, typed, "/") if i.label == "inner.launch"]
        assert editor.accept(path, inner) == '  <include file="$(find preflight_demo)/launch/inner.launch'

        typed = '<launch>\n  <include file="$(find preflight_demo)/launch/inner.launch">\n    <arg name="$0\n'
        found = await at_cursor(editor, path, typed, '"')
        assert [(i.label, i.detail) for i in found] == [("robot", "required"), ("rate", "default: 1")]

        typed = '<launch>\n  <arg name="name" default="x"/>\n  <param name="p" value="$(arg $0'
        await at_cursor(editor, path, typed)
        await editor.hover(path, types.Position(0, 0))  # by then the text is analysed, and the value known
        (name,) = await at_cursor(editor, path, typed, " ")
        assert (name.label, name.detail) == ("name", "= x")
        assert editor.accept(path, name) == '  <param name="p" value="$(arg name)'


async def test_what_nodes_do_is_offered_from_their_traces(harness: Harness, path: Path) -> None:
    async with editing(harness, trusted=True) as editor:
        text = editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)  # both have been run
        remap, rate = '<remap from="chatter" to="chater"/>', '<param name="rate" value="5"/>'
        found = await at_cursor(editor, harness.launch_file, text.replace(remap, '<remap from="$0'), '"')
        assert [(i.label, i.detail) for i in found] == [("chatter", "std_msgs/String, subscribes")]
        found = await at_cursor(editor, harness.launch_file, text.replace(remap, '<remap from="chatter" to="/cha$0'))
        assert [(i.label, i.detail) for i in found] == [("/chatter", "std_msgs/String")]
        found = await at_cursor(editor, harness.launch_file, text.replace(rate, '<param name="$0'), '"')
        assert ("rate", "default: 10") in [(i.label, i.detail) for i in found]


@pytest.mark.parametrize("encoding", ENCODINGS)
async def test_the_word_at_the_cursor_is_replaced_in_every_encoding(
    harness: Harness, path: Path, encoding: str
) -> None:
    async with editing(harness, client=capabilities(encoding=encoding)) as editor:
        typed = (
            '<launch>\n  <arg name="größe" default="🤖"/><param name="🤖é" value="a🤖 $(arg grö$0ss) 🤖"/>\n</launch>'
        )
        (size,) = await at_cursor(editor, path, typed)
        assert editor.accept(path, size).endswith('<param name="🤖é" value="a🤖 $(arg größe) 🤖"/>')
        typed = '<launch>\n  <!-- 🤖 --><node name="🤖" out$0puutt="log"/>\n</launch>'
        output = next(i for i in await at_cursor(editor, path, typed) if i.label == "output")
        assert editor.accept(path, output) == '  <!-- 🤖 --><node name="🤖" output="log"/>'


async def test_without_snippets_no_tab_stops(harness: Harness, path: Path) -> None:
    async with editing(harness, client=capabilities(snippets=False)) as editor:
        elements = await at_cursor(editor, path, "<launch>\n  <$0\n</launch>\n")
        assert not any(i.insert_text_format for i in elements)
        assert editor.accept(path, elements[0]) == "  <node"


async def test_nothing_where_nothing_was_asked_for(harness: Harness, path: Path) -> None:
    async with editing(harness) as editor:
        assert await at_cursor(editor, path, "<launch>\n  $0", " ") == []
        assert await at_cursor(editor, path, "<launch>\n <!-- <$0 -->", "<") == []
        unknown = path.with_suffix(".txt")
        editor.open(unknown, "<launch><", language="plaintext")
        assert await editor.completion(unknown, types.Position(0, 9), "<") == []


async def test_a_node_that_is_being_written_is_known_by_its_source(harness: Harness, path: Path) -> None:
    """In a trusted workspace too: it has not run yet, and while its tag is not complete it cannot be."""
    async with editing(harness, trusted=True) as editor:
        node = '<launch>\n  <node pkg="preflight_demo" type="talker.py" name="new">\n    '
        found = await at_cursor(editor, path, f'{node}<param name="$0', '"')
        assert ("rate", "default: 10") in [(i.label, i.detail) for i in found]
        found = await at_cursor(editor, path, f'{node}<remap from="$0', '"')
        assert [(i.label, i.detail) for i in found] == [("chatter", "std_msgs/String, publishes")]
        assert not editor.runs


async def test_a_new_node_beside_known_ones_is_known_by_its_source(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        text = editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)  # both have been run
        (harness.launch_file.parents[1] / "scripts/fresh.py").write_text(
            "#!/usr/bin/env python3\nimport rospy\nfrom std_msgs.msg import Bool\nrospy.init_node('fresh')\n"
            "rospy.get_param('~gain', 2)\nrospy.Subscriber('door', Bool, print)\nrospy.spin()\n"
        )
        (harness.launch_file.parents[1] / "scripts/fresh.py").chmod(0o755)
        editor.watched(harness.launch_file.parents[1] / "scripts/fresh.py", kind=types.FileChangeType.Created)
        node = '  <node pkg="preflight_demo" type="fresh.py" name="fresh">\n    '
        for typed, expected in (
            ('<param name="$0', "gain"),
            ('<remap from="$0', "door"),
            ('<remap from="door" to="/cha$0', "/chatter"),
        ):
            typed = text.replace("</launch>", f"{node}{typed}")

            async def proposals(typed: str = typed) -> list[str]:
                return labels(await at_cursor(editor, harness.launch_file, typed, None))

            await editor.once(proposals, lambda found, expected=expected: expected in found)


async def test_a_folder_keeps_its_slash_and_what_is_in_it_comes_next(harness: Harness, path: Path) -> None:
    settings = {"clientCommands": ["editor.action.triggerSuggest"]}
    typed = '<launch>\n  <include file="$(find preflight_demo)/lau$0"/>\n</launch>'
    async with editing(harness, settings=settings) as editor:
        (folder,) = [i for i in await at_cursor(editor, path, typed) if i.label == "launch/"]
        assert folder.command == types.Command("", "editor.action.triggerSuggest")
        assert editor.accept(path, folder) == '  <include file="$(find preflight_demo)/launch/"/>'
        inside = await at_cursor(editor, path, typed.replace("lau$0", "launch/in$0"), "/")
        (inner,) = [i for i in inside if i.label == "inner.launch"]
        assert inner.command is None
        (folder,) = [i for i in await at_cursor(editor, path, typed.replace("$0", "$0/x")) if i.label == "launch/"]
        assert editor.accept(path, folder) == '  <include file="$(find preflight_demo)/launch/x"/>', "not twice"
    async with editing(harness) as editor:
        (folder,) = [i for i in await at_cursor(editor, path, typed) if i.label == "launch/"]
        assert folder.command is None, "a client that does not know the command"


SNIPPETS = {
    "typed.launch": (
        "<launch>\n  <$0\n</launch>\n",
        {
            "node with parameter file": "<rosparam",
            "include with argument": "<arg",
            "node container (nodelet manager)": "",
        },
    ),
    "typed.launch.xml": (
        '<launch>\n  <let name="a" value="b"/>\n  <$0\n</launch>\n',
        {
            "node with parameter file": '<param from="',
            "include with argument": "<arg",
            "node_container with component": "<composable_node",
        },
    ),
    "typed.launch.yaml": (
        "launch:\n  - $0\n",
        {
            "node with parameter file": "- from: ",
            "include with argument": "arg:",
            "node_container with component": "composable_node:",
        },
    ),
}


@pytest.mark.parametrize("name", SNIPPETS)
async def test_snippets_of_what_belongs_together(harness: Harness, name: str) -> None:
    text, expected = SNIPPETS[name]
    path = harness.launch_file.with_name(name)
    async with editing(harness) as editor:
        found = await at_cursor(editor, path, text)
        snippets = {i.label: i for i in found if i.kind == types.CompletionItemKind.Snippet}
        assert set(snippets) == set(expected)
        for label, inside in expected.items():
            assert snippets[label].insert_text_format == types.InsertTextFormat.Snippet
            edit = snippets[label].text_edit
            assert isinstance(edit, types.TextEdit)
            assert inside in edit.new_text
    async with editing(harness, client=capabilities(snippets=False)) as editor:
        found = await at_cursor(editor, path, text)
        assert found
        assert not [i for i in found if i.kind == types.CompletionItemKind.Snippet]


@pytest.mark.silent
async def test_no_snippets_where_their_tag_cannot_stand(harness: Harness, path: Path) -> None:
    async with editing(harness) as editor:
        inside = await at_cursor(
            editor, path, '<launch>\n  <node pkg="p" type="t" name="n">\n    <$0\n  </node>\n</launch>'
        )
        assert inside
        assert not [i for i in inside if i.kind == types.CompletionItemKind.Snippet]


async def test_a_tag_is_closed_behind_the_cursor(harness: Harness, path: Path) -> None:
    async with editing(harness) as editor:
        (end,) = await at_cursor(editor, path, "<launch>\n  <group>$0\n</launch>", ">")
        assert editor.accept(path, end) == "  <group>$0</group>"
        assert end.insert_text_format == types.InsertTextFormat.Snippet


@pytest.mark.silent
@pytest.mark.parametrize(
    "text",
    [
        "<launch>\n  <group>$0</group>\n</launch>",
        "<launch>\n  <group/>$0\n</launch>",
        "<launch>\n  <group></group>$0\n</launch>",
        "<launch>\n  <!-- a -->$0\n</launch>",
        '<launch>\n  <param name="a" value="1 >$0"/>\n</launch>',
    ],
)
async def test_nothing_is_closed_twice(harness: Harness, path: Path, text: str) -> None:
    async with editing(harness) as editor:
        assert await at_cursor(editor, path, text, ">") == []
