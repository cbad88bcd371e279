"""Find references and rename across files, through the real server."""

from __future__ import annotations

from pathlib import Path

import pytest
from lsprotocol import types
from pygls.exceptions import JsonRpcException
from support.editor_harness import Harness
from support.lsp_client import ENCODINGS, Editor, capabilities, editing, from_uri, offset

pytestmark = pytest.mark.ros

OUTER = """<launch>
  <!-- 🤖 Größe --><arg name="rate" doc="😀" default="1"/><include file="$(find preflight_demo)/launch/inner.launch">
    <!-- 𝕂 --><arg name="rate" value="$(arg rate)"/>
  </include>
</launch>
"""
INNER = """<launch>
  <!-- 🤖 --><arg name="rate"/>
  <node pkg="preflight_demo" type="talker.py" name="talker"/><param name="größe 🤖" value="$(arg rate)"/>
</launch>
"""


@pytest.fixture
def files(harness: Harness) -> tuple[Path, Path]:
    return harness.write("outer.launch", OUTER), harness.write("inner.launch", INNER)


async def indexed(editor: Editor, root: Path) -> None:
    """Wait until the root of the open file is known: why its nodes are not run is said there."""
    await editor.until(lambda: root.as_uri() in editor.published)


def covered(editor: Editor, place: types.Location) -> str:
    """`inner.launch:2 rate`, of an open file or the disk."""
    path = from_uri(place.uri)
    text = editor.texts.get(path) or path.read_text()
    start, end = (offset(text, end, editor.encoding) for end in (place.range.start, place.range.end))
    return f"{path.name}:{place.range.start.line + 1} {text[start:end]}"


@pytest.mark.parametrize("encoding", ENCODINGS)
async def test_references_in_two_files(harness: Harness, files: tuple[Path, Path], encoding: str) -> None:
    outer, inner = files
    async with editing(harness, client=capabilities(encoding=encoding)) as editor:
        editor.open(inner)
        await indexed(editor, outer)
        found = await editor.references(inner, editor.at(inner, "(arg rate)", 6))
        assert [covered(editor, place) for place in found] == [
            "inner.launch:2 rate",
            "inner.launch:3 rate",
            "outer.launch:3 rate",
        ]
        uses = await editor.references(inner, editor.at(inner, "(arg rate)", 6), declaration=False)
        assert uses == found[1:]


@pytest.mark.parametrize("encoding", ENCODINGS)
async def test_rename_in_two_files(harness: Harness, files: tuple[Path, Path], encoding: str) -> None:
    outer, inner = files
    async with editing(harness, client=capabilities(encoding=encoding)) as editor:
        editor.open(inner)
        await indexed(editor, outer)
        where = editor.at(inner, "(arg rate)", 6)
        prepared = await editor.prepare_rename(inner, where)
        assert prepared is not None
        assert (prepared.placeholder, editor.covered(inner, prepared.range)) == ("rate", "rate")
        editor.apply(await editor.rename(inner, where, "speed"))
        assert editor.texts[inner] == INNER.replace('"rate"', '"speed"').replace("(arg rate)", "(arg speed)")
        assert editor.texts[outer] == OUTER.replace('"rate" value', '"speed" value')
        await editor.until(lambda: editor.rules(inner) == ["TOP002"] and editor.rules(outer) == ["TRC004"])


async def test_rename_for_a_client_that_checks_no_versions(harness: Harness, files: tuple[Path, Path]) -> None:
    outer, inner = files
    plain = capabilities()
    assert plain.workspace is not None
    plain.workspace.workspace_edit = None
    async with editing(harness, client=plain) as editor:
        editor.open(outer)
        await indexed(editor, outer)
        edit = await editor.rename(outer, editor.at(outer, '"rate" value', 1), "speed")
        assert edit is not None
        assert edit.document_changes is None
        assert sorted(edit.changes or {}) == sorted([inner.as_uri(), outer.as_uri()])


async def test_a_file_that_changed_on_the_disk_a_moment_ago(harness: Harness, files: tuple[Path, Path]) -> None:
    outer, inner = files
    async with editing(harness) as editor:
        editor.open(inner)
        await indexed(editor, outer)
        # Nobody has reported it yet.
        changed = OUTER.replace("<launch>", "<launch>\n  <!-- one line more -->\n  <!-- and one more -->")
        outer.write_text(changed)
        editor.apply(await editor.rename(inner, editor.at(inner, "(arg rate)", 6), "speed"))
        assert editor.texts[outer] == changed.replace('"rate" value', '"speed" value')
        assert editor.texts[inner].count("speed") == 2


async def test_a_file_that_includes_another_since_a_moment_ago(harness: Harness, files: tuple[Path, Path]) -> None:
    outer, inner = files
    async with editing(harness) as editor:
        editor.open(inner)
        await indexed(editor, outer)
        outer.write_text(OUTER.replace("inner.launch", "other.launch"))
        edit = await editor.rename(inner, editor.at(inner, "(arg rate)", 6), "speed")
        editor.apply(edit)
        assert outer not in editor.texts


async def test_each_edit_says_what_it_changes(harness: Harness, files: tuple[Path, Path]) -> None:
    outer, inner = files
    async with editing(harness, client=capabilities(annotates=True)) as editor:
        editor.open(inner)
        await indexed(editor, outer)
        edit = await editor.rename(inner, editor.at(inner, "(arg rate)", 6), "speed")
        assert edit is not None
        said = {name: each.label for name, each in (edit.change_annotations or {}).items()}
        found: dict[str, list[str]] = {}
        for change in edit.document_changes or ():
            assert isinstance(change, types.TextDocumentEdit)
            path = from_uri(change.text_document.uri)
            assert change.text_document.version == editor.versions.get(path)
            edits = [each for each in change.edits if isinstance(each, types.AnnotatedTextEdit)]
            assert len(edits) == len(change.edits)
            found[path.name] = [said[each.annotation_id].replace(str(outer.parent), "") for each in edits]
        where = str(inner.relative_to(harness.workspace))
        assert found == {
            "inner.launch": [f"Argument 'rate' of {where}"] * 2,
            "outer.launch": [f"'rate' as passed to {where}"],
        }
        editor.apply(edit)
        assert editor.texts[inner].count("speed") == 2


async def test_what_was_typed_a_moment_ago_counts(harness: Harness, files: tuple[Path, Path]) -> None:
    outer, inner = files
    async with editing(harness) as editor:
        editor.open(outer)
        await indexed(editor, outer)
        editor.change(outer, "<!-- one line more 🤖 -->\n" + OUTER)
        editor.open(inner)
        found = await editor.references(inner, editor.at(inner, '"rate"', 1))
        assert "outer.launch:4 rate" in [covered(editor, place) for place in found]


async def test_a_refusal_says_why(
    harness: Harness, files: tuple[Path, Path], capfd: pytest.CaptureFixture[str]
) -> None:
    outer, _ = files
    async with editing(harness) as editor:
        editor.open(outer)
        await indexed(editor, outer)
        with pytest.raises(JsonRpcException, match="'a b' is not a valid argument name"):
            await editor.rename(outer, editor.at(outer, '"rate"', 1), "a b")
        with pytest.raises(JsonRpcException, match="This is a package"):
            await editor.prepare_rename(outer, editor.at(outer, "preflight_demo"))
        assert await editor.prepare_rename(outer, editor.at(outer, "<!--")) is None
    assert "no name for an argument" not in capfd.readouterr().err, "it is an answer, not a failure to be logged"


async def test_a_node_is_renamed_with_the_topics_below_it(harness: Harness, files: tuple[Path, Path]) -> None:
    outer, inner = files
    async with editing(harness) as editor:
        text = OUTER.replace("</launch>", '  <param name="talker/x" value="1"/>\n</launch>')
        editor.open(outer, text)
        editor.open(inner)
        await indexed(editor, outer)
        editor.apply(await editor.rename(inner, editor.at(inner, '"talker"', 1), "speaker"))
        assert editor.texts[inner] == INNER.replace('"talker"', '"speaker"')
        assert editor.texts[outer] == text.replace("talker/x", "speaker/x")


async def test_in_a_file_that_does_not_parse(harness: Harness, files: tuple[Path, Path]) -> None:
    outer, inner = files
    async with editing(harness) as editor:
        editor.open(inner, INNER.replace("</launch>", '<param name="🤖" value="$(arg rate)"'))
        await indexed(editor, outer)
        where = editor.at(inner, '"rate"', 1)
        found = await editor.references(inner, where)
        assert [covered(editor, place) for place in found] == [
            "inner.launch:2 rate",
            "inner.launch:3 rate",
            "inner.launch:4 rate",
            "outer.launch:3 rate",
        ]
        editor.apply(await editor.rename(inner, where, "speed"))
        assert editor.texts[inner].count("speed") == 3
        editor.change(inner, editor.texts[inner].replace("talker.py", "nothing"))
        links = await editor.definition(inner, editor.at(inner, "$(arg speed)", 7))
        assert [link.target_range.start.line for link in links] == [1]


async def test_topics_and_parameters_lead_to_the_source_of_the_node(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
        found = await editor.references(harness.launch_file, editor.at(harness.launch_file, '"chater"', 1))
        assert [covered(editor, place) for place in found] == [
            "talker_listener.launch:7 chatter",
            "talker_listener.launch:7 chater",
            'listener.py:14 rospy.Subscriber("chatter", String, heard)',
        ]
        links = await editor.definition(harness.launch_file, editor.at(harness.launch_file, '"chatter"', 1))
        assert [from_uri(link.target_uri).name for link in links] == ["listener.py"]
        links = await editor.definition(harness.launch_file, editor.at(harness.launch_file, '"rate"', 1))
        assert [(from_uri(link.target_uri).name, link.target_range.start.line) for link in links] == [("talker.py", 10)]
