"""Hover, definition, symbols and code actions on the demo and on a file with an include."""

from __future__ import annotations

from pathlib import Path

import pytest
from lsprotocol import types
from support.editor_harness import Harness
from support.lsp_client import Editor, editing

pytestmark = pytest.mark.ros

OUTER = """<launch>
  <arg name="robot" default="husky"/>
  <include file="$(find preflight_demo)/launch/inner.launch">
    <arg name="rate" value="7"/>
    <arg name="ns" value="$(arg robot)"/>
  </include>
  <group ns="lab" if="true">
    <param name="note" value="two words"/>
  </group>
</launch>
"""
INNER = """<launch>
  <arg name="rate" default="1"/>
  <arg name="ns"/>
  <node ns="$(arg ns)" pkg="preflight_demo" type="talker.py" name="talker">
    <param name="rate" value="$(arg rate)"/>
  </node>
</launch>
"""


@pytest.fixture
def outer(harness: Harness) -> Path:
    harness.write("inner.launch", INNER)
    return harness.write("outer.launch", OUTER)


async def hovered(editor: Editor, path: Path, needle: str, after: int = 0) -> str:
    hover = await editor.hover(path, editor.at(path, needle, after))
    assert hover is not None, needle
    assert isinstance(hover.contents, types.MarkupContent)
    assert hover.contents.kind == types.MarkupKind.Markdown
    assert hover.range is not None
    return hover.contents.value


async def gone_to(editor: Editor, path: Path, needle: str, after: int = 0) -> list[tuple[str, int]]:
    """File names and lines, the latter from 1."""
    links = await editor.definition(path, editor.at(path, needle, after))
    return [(link.target_uri.rpartition("/")[2], link.target_range.start.line + 1) for link in links]


async def test_hover_on_a_node_shows_its_interface_and_where_it_comes_from(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
        talker = await hovered(editor, harness.launch_file, 'name="talker"')
        assert "**/talker** `preflight_demo/talker.py`" in talker
        assert "from a run in the sandbox" in talker
        assert "Reached its event loop" in talker
        assert "- `/chatter` `std_msgs/String`" in talker
        assert "[talker.py:10](file://" in talker
        assert "`/talker/rate` = `5`, default `10`" in talker
        listener = await hovered(editor, harness.launch_file, 'name="listener"')
        assert "- `/chater` `std_msgs/String`, remapped from `chatter`" in listener
        remap = await hovered(editor, harness.launch_file, "<remap", 2)
        assert "`/chatter` → `/chater` for `/listener`" in remap
        assert "topic `/chater`: no publisher" in remap


async def test_hover_on_an_annotated_node_says_so(harness: Harness) -> None:
    async with editing(harness) as editor:
        text = harness.launch_file.read_text().replace(
            '<param name="rate" value="5"/>',
            '<topics><topic name="chatter" type="std_msgs/String" class="pub"/></topics>',
        )
        editor.open(harness.launch_file, text)
        talker = await hovered(editor, harness.launch_file, 'name="talker"')
        assert "Interface from the annotation in the launch file" in talker
        assert "`/chatter` `std_msgs/String`" in talker
        listener = await hovered(editor, harness.launch_file, 'name="listener"')
        assert "not trusted" in listener


async def test_hover_on_arguments_values_includes_and_parameters(harness: Harness, outer: Path) -> None:
    async with editing(harness) as editor:
        editor.open(outer)
        robot = await hovered(editor, outer, "$(arg robot)", 7)
        assert "argument `robot` = `husky`" in robot
        assert "[outer.launch:2]" in robot
        assert "`preflight_demo`" in await hovered(editor, outer, "$(find preflight_demo)", 8)
        include = await hovered(editor, outer, "<include", 2)
        assert "inner.launch" in include
        assert "`rate` = `7`" in include
        assert "`/lab/note` = `two words` (str)" in await hovered(editor, outer, "<param", 2)
        assert "`<launch>` The root of every launch file." in await hovered(editor, outer, "<launch", 2)
        ns = await hovered(editor, outer, "ns=", 1)
        assert ns.startswith("`ns`: Put everything in the group into this namespace.")
        assert await editor.hover(outer, editor.at(outer, "  <group", 1)) is None

        inner = outer.with_name("inner.launch")
        editor.open(inner)
        # The value that it has where it is included, once that is known.
        rate = await editor.once(
            lambda: hovered(editor, inner, "$(arg rate)", 7), lambda text: "argument `rate` = `7`" in text
        )
        assert "[outer.launch:4]" in rate
        node = await hovered(editor, inner, "<node", 2)
        assert "**/husky/talker**" in node
        assert "included at [outer.launch:3]" in node


async def test_definitions(harness: Harness, outer: Path) -> None:
    async with editing(harness) as editor:
        editor.open(outer)
        assert await gone_to(editor, outer, "/launch/inner.launch", 9) == [("inner.launch", 1)]
        assert await gone_to(editor, outer, "$(find preflight_demo)", 8) == [("package.xml", 1)]
        assert await gone_to(editor, outer, "$(arg robot)", 7) == [("outer.launch", 2)]
        assert await gone_to(editor, outer, "<group") == []

        inner = outer.with_name("inner.launch")
        editor.open(inner)
        assert await gone_to(editor, inner, "$(arg rate)", 7) == [("inner.launch", 2)]
        await editor.once(
            lambda: gone_to(editor, inner, 'arg name="rate"', 11), lambda places: places == [("outer.launch", 4)]
        )
        assert await gone_to(editor, inner, "talker.py", 2) == [("talker.py", 1)]


async def test_definition_leads_to_the_other_end(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        text = editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
        assert await gone_to(editor, harness.launch_file, '"chater"', 3) == [("talker_listener.launch", 3)]
        at = text.index("chater")
        editor.replace(harness.launch_file, at, at + 6, "chatter")
        await editor.without(harness.launch_file, "TOP001")
        await editor.once(
            lambda: gone_to(editor, harness.launch_file, 'to="chatter"', 6),
            lambda places: places == [("talker.py", 10)],
        )


async def test_symbols_are_the_tags_as_they_nest(harness: Harness, outer: Path) -> None:
    async with editing(harness) as editor:
        editor.open(outer)
        found = await editor.symbols(outer)
        assert [(s.name, s.detail, s.kind) for s in found] == [
            ("robot", "husky", types.SymbolKind.Variable),
            ("$(find preflight_demo)/launch/inner.launch", None, types.SymbolKind.File),
            ("lab", "if true", types.SymbolKind.Namespace),
        ]
        assert [s.name for s in found[1].children or ()] == ["rate", "ns"]
        assert editor.covered(outer, found[2].selection_range) == "lab"
        assert editor.covered(outer, found[2].range).startswith("<group")
        assert editor.covered(outer, found[2].range).endswith("</group>")


async def test_the_traced_interface_can_be_written_as_an_annotation(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
        where = editor.at(harness.launch_file, 'name="talker"')
        actions = await editor.actions(harness.launch_file, types.Range(where, where), ["refactor"])
        assert [a.title for a in actions] == ["Annotate '/talker' with its traced interface"]
        editor.apply(actions[0].edit)
        assert '<topic name="chatter" type="std_msgs/String" class="pub"/>' in editor.texts[harness.launch_file]
        found = await editor.misspelling(harness.launch_file)
        assert editor.covered(harness.launch_file, found.range) == "chater"
        where = editor.at(harness.launch_file, 'name="talker"')
        assert await editor.actions(harness.launch_file, types.Range(where, where), ["refactor"]) == []


async def test_only_the_asked_kinds_of_actions(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        found = await editor.misspelling(harness.launch_file)
        assert await editor.actions(harness.launch_file, found.range, ["source.organizeImports"]) == []
        actions = await editor.actions(harness.launch_file, found.range, ["quickfix"])
        assert {a.kind for a in actions} == {"quickfix"}


async def test_a_fix_may_change_another_file(harness: Harness) -> None:
    manifest = harness.launch_file.parent.parent / "package.xml"
    launch = harness.launch_file.with_name("shown.launch")
    manifest.write_text("<package>\n  <name>preflight_demo</name>\n</package>\n")
    async with editing(harness) as editor:
        editor.open(launch, '<launch>\n  <param name="a" value="$(find rospy)"/>\n</launch>\n')
        found = await editor.having(launch, "PKG004")
        (action,) = await editor.fixes(launch, found.range)
        assert action.title == "Add <run_depend>rospy</run_depend> to package.xml of 'preflight_demo'"
        assert action.edit is not None
        (changed,) = action.edit.document_changes or ()
        assert isinstance(changed, types.TextDocumentEdit)
        assert changed.text_document == types.OptionalVersionedTextDocumentIdentifier(manifest.as_uri(), None)
        (edit,) = changed.edits
        assert isinstance(edit, types.TextEdit)
        assert (edit.range.start.line, edit.new_text) == (2, "  <run_depend>rospy</run_depend>\n")
        # On the disk alone, and not yet reported.
        manifest.write_text("<package>\n\n\n  <name>preflight_demo</name>\n</package>\n")
        (action,) = await editor.fixes(launch, found.range)
        editor.apply(action.edit)
        assert editor.texts[manifest] == (
            "<package>\n\n\n  <name>preflight_demo</name>\n  <run_depend>rospy</run_depend>\n</package>\n"
        )


PATROL = """<launch>
  <node pkg="preflight_demo" type="talker.py" name="patrol">
    <actions><action name="move_base" type="m/MoveBaseAction" class="client"/></actions>
  </node>
  <node pkg="tf2_ros" type="static_transform_publisher" name="mount" args="0 0 1 0 0 0 base laser"/>
  <node pkg="preflight_demo" type="none.py" name="home">
    <actions><action name="go" type="m/GoAction" class="client"/></actions>
  </node>
</launch>
"""


async def test_hover_on_a_node_shows_an_action_as_one_thing_and_frames(harness: Harness) -> None:
    path = harness.launch_file.with_name("patrol.launch")
    path.write_text(PATROL)
    async with editing(harness, trusted=True) as editor:
        editor.open(path)
        await editor.having(path, "ACT001")
        home = await hovered(editor, path, 'name="home"')
        assert "Action clients\n- `/go` `m/GoAction`" in home
        assert "Publishers" not in home
        assert "Broadcasts\n- frame `laser` in `base`, static" in await hovered(editor, path, 'name="mount"')
