"""What nodes do that cannot be run: from runs of their executable elsewhere, from annotations."""

from __future__ import annotations

from pathlib import Path

import pytest
from lsprotocol import types
from support.editor_harness import Harness
from support.lsp_client import Editor, editing

pytestmark = pytest.mark.ros

OTHER = """<launch>
  <node pkg="preflight_demo" type="talker.py" name="lone"/>
</launch>
"""


async def test_what_an_executable_did_elsewhere_is_shown_where_it_cannot_be_run(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
    starts = harness.sandbox_starts()
    other = harness.launch_file.with_name("other.launch")
    other.write_text(OTHER)
    async with editing(harness) as editor:
        for text in (OTHER, OTHER.replace("</launch>", "  <node pkg=")):
            if other in editor.texts:
                editor.change(other, text)
            else:
                editor.open(other, text)
                await editor.having(other, "TRC004")
            hover = await editor.hover(other, editor.at(other, 'name="lone"'))
            assert hover is not None
            assert isinstance(hover.contents, types.MarkupContent)
            shown = hover.contents.value
            assert "from a run of the same executable elsewhere, that of `/talker` in `" in shown
            assert f"{harness.launch_file.name}`; not run: the workspace is not trusted" in shown
            assert "- `/chatter` `std_msgs/String`, seen in another run" in shown
        assert harness.sandbox_starts() == starts, "nothing was run to know it"


ANNOTATED = """\ufeff<launch>\r
\t<node pkg="preflight_demo" type="talker.py" name="talker">\r
\t\t<!-- <topics>\r
\t\t\t<topic name="chatter" type="std_msgs/Int32" class="pub"/>\r
\t\t</topics>\r
\t\t<params/> -->\r
\t</node>\r
</launch>\r
"""


async def titles(editor: Editor, path: Path, needle: str) -> dict[str, types.CodeAction]:
    where = editor.at(path, needle)
    return {action.title: action for action in await editor.actions(path, types.Range(where, where))}


def annotating(actions: dict[str, types.CodeAction]) -> set[str]:
    return {title for title in actions if title.startswith("Annotate")}


async def test_an_outdated_annotation_is_told_and_brought_up_to_date(harness: Harness) -> None:
    path = harness.launch_file.with_name("annotated.launch")
    path.write_bytes(ANNOTATED.encode())
    async with editing(harness, trusted=True) as editor:
        editor.open(path, ANNOTATED)
        await editor.having(path, "TRC006")
        told = {editor.covered(path, d.range): d for d in editor.diagnostics(path) or () if d.code == "TRC006"}
        assert set(told) == {"std_msgs/Int32", "<topics>"}
        found = told["std_msgs/Int32"]
        assert "std_msgs/String" in found.message
        assert found.severity == types.DiagnosticSeverity.Warning
        assert "reads parameter '~rate'" in told["<topics>"].message
        actions = await editor.actions(path, found.range)
        (action,) = [a for a in actions if a.title == "Update the annotation of '/talker' from its run"]
        assert action.kind == types.CodeActionKind.QuickFix
        same = (await titles(editor, path, "<node"))["Update the annotation of '/talker' from its run"]
        assert same.edit == action.edit
        editor.apply(action.edit)
        await editor.without(path, "TRC006")
        assert editor.texts[path] == ANNOTATED.replace("Int32", "String").replace(
            "<params/>", '<params>\r\n\t\t\t<param name="~rate"/>\r\n\t\t</params>'
        )


async def test_annotations_can_be_made_of_whatever_is_known(harness: Harness) -> None:
    other = harness.launch_file.with_name("other.launch")
    other.write_text(OTHER)
    template = "Annotate '/lone' with an empty template"
    from_source = "Annotate '/lone' with the interface in its source"
    from_elsewhere = "Annotate '/lone' with the interface of another run"
    async with editing(harness) as editor:
        editor.open(other)
        await editor.having(other, "TRC004")
        assert annotating(await titles(editor, other, "<node")) == {from_source, template}
        # in a file that does not parse, too
        editor.change(other, OTHER.replace("</launch>", "  <group>\n</launch>"))
        await editor.having(other, "LCH001")
        actions = await titles(editor, other, "<node")
        assert annotating(actions) == {from_source, template}
        editor.apply(actions[template].edit)
        assert '<topic name="" type="" class="pub"/>' in editor.texts[other]
        assert "  </node>" in editor.texts[other]
        editor.trust()
        editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
        editor.trust(False)
        editor.change(other, OTHER)
        await editor.having(other, "TRC004")
        actions = await titles(editor, other, "<node")
        assert annotating(actions) == {from_elsewhere, template}
        editor.apply(actions[from_elsewhere].edit)
        assert '<topic name="chatter" type="std_msgs/String" class="pub"/>' in editor.texts[other]
        assert '<param name="~rate"/>' in editor.texts[other]


async def test_the_sources_of_many_nodes_that_were_not_run_are_read(harness: Harness) -> None:
    """And what one of them says is brought up to date when its parameters or its source change."""
    path = harness.launch_file.with_name("many.launch")
    node = '  <node pkg="preflight_demo" type="{0}.py" name="{0}_{1}"><remap from="chatter" to="words_{1}"/></node>\n'
    nodes = (node.format(script, number) for number in range(100) for script in ("talker", "listener"))
    async with editing(harness) as editor:
        text = editor.open(path, "<launch>\n" + "".join(nodes) + "</launch>\n")
        await editor.having(path, "TRC004")
        await editor.until(lambda: editor.rules(path) == ["TRC004"])  # each of the topics has both ends
        at = text.index("words_70")
        editor.replace(path, at, at + len("words_70"), "world_70")
        hint = await editor.having(path, "TOP001")
        assert "/words_70" in hint.message
        script = harness.launch_file.parents[1] / "scripts/talker.py"
        script.write_text(script.read_text().replace('"chatter"', '"chatters"'))
        editor.watched(script)
        await editor.until(lambda: (editor.rules(path) or []).count("TOP004") == 100)
