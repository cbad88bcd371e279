"""In whose context a file is shown: the roots that the index of the workspace finds, the user's choice, settings."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from lsprotocol import types
from support.editor_harness import Harness
from support.lsp_client import Editor, editing

pytestmark = pytest.mark.ros

FRAGMENT = '<launch>\n  <arg name="rate"/>\n  <param name="rate" value="$(arg rate)"/>\n</launch>\n'


def create_workspace(harness: Harness) -> tuple[Path, Path, Path]:
    """A fragment that two launch files include, with different arguments."""
    fragment = harness.workspace / "fragment.launch"
    fragment.write_text(FRAGMENT)
    roots = []
    for name, rate in (("fast", "50"), ("slow", "2")):
        root = harness.workspace / f"{name}.launch"
        root.write_text(f'<launch><include file="{fragment}"><arg name="rate" value="{rate}"/></include></launch>\n')
        roots.append(root)
    return fragment, roots[0], roots[1]


async def shown_value(editor: Editor, path: Path) -> str:
    found = await editor.hover(path, editor.at(path, "$(arg rate)", 3))
    return str(getattr(found.contents, "value", "")) if found else ""


async def ask(editor: Editor, method: str, params: Any) -> Any:
    return await editor.client.protocol.send_request_async(method, params)


async def test_a_file_is_shown_as_its_roots_include_it(harness: Harness) -> None:
    fragment, fast, slow = create_workspace(harness)
    async with editing(harness) as editor:
        editor.open(fragment)
        await editor.until(lambda: editor.rules(fragment) == [])
        answer = await ask(editor, "rosPreflight/roots", {"uri": fragment.as_uri()})
        assert sorted(root.uri for root in answer.roots) == [fast.as_uri(), slow.as_uri()]
        assert answer.shown == answer.roots[0]
        assert "50" in await shown_value(editor, fragment)


async def test_hover_says_what_it_is_in_each_root(harness: Harness) -> None:
    fragment, _, _ = create_workspace(harness)
    async with editing(harness) as editor:
        editor.open(fragment, FRAGMENT + "<unfinished")

        wanted = "By launch:\n- `50` in `fast.launch`\n- `2` in `slow.launch`"
        await editor.once(lambda: shown_value(editor, fragment), lambda text: wanted in text)


async def test_the_user_selects_root_and_arguments(harness: Harness) -> None:
    fragment, _, slow = create_workspace(harness)
    async with editing(harness) as editor:
        editor.open(fragment)
        await editor.until(lambda: editor.rules(fragment) == [])
        select = {"uri": fragment.as_uri(), "root": {"uri": slow.as_uri(), "args": {}}}
        answer = await ask(editor, "rosPreflight/selectRoot", select)
        assert (answer.shown.uri, answer.message) == (slow.as_uri(), None)
        assert "2" in await shown_value(editor, fragment)
        select["root"] = {"uri": fragment.as_uri(), "args": {"rate": "77"}}
        await ask(editor, "rosPreflight/selectRoot", select)
        assert "77" in await shown_value(editor, fragment)
        select["root"] = None
        await ask(editor, "rosPreflight/selectRoot", select)
        assert "50" in await shown_value(editor, fragment)


async def test_a_root_that_does_not_reach_the_file_is_refused(harness: Harness) -> None:
    fragment, _, _ = create_workspace(harness)
    other = harness.workspace / "other.launch"
    other.write_text("<launch/>\n")
    async with editing(harness) as editor:
        editor.open(fragment)
        await editor.until(lambda: editor.rules(fragment) == [])
        select = {"uri": fragment.as_uri(), "root": {"uri": other.as_uri(), "args": {}}}
        answer = await ask(editor, "rosPreflight/selectRoot", select)
        assert "does not include" in answer.message
        assert "50" in await shown_value(editor, fragment)


async def test_the_settings_name_roots_with_arguments(harness: Harness) -> None:
    fragment, _, _ = create_workspace(harness)
    named = harness.workspace / ".ros-preflight.yaml"
    named.write_text("roots:\n  - file: fragment.launch\n    args: {rate: 33}\n")
    async with editing(harness) as editor:
        editor.open(fragment)
        await editor.until(lambda: editor.rules(fragment) == [])
        answer = await ask(editor, "rosPreflight/roots", {"uri": fragment.as_uri()})
        assert (answer.shown.uri, answer.shown.args.rate) == (fragment.as_uri(), "33")
        assert "33" in await shown_value(editor, fragment)


async def test_a_file_that_comes_and_goes_is_taken_into_the_index(harness: Harness) -> None:
    fragment = harness.workspace / "fragment.launch"
    fragment.write_text(FRAGMENT)
    async with editing(harness) as editor:
        editor.open(fragment)
        await editor.until(lambda: editor.rules(fragment) == ["ARG003"])
        _, fast, _ = create_workspace(harness)
        editor.watched(fast)
        await editor.until(lambda: editor.rules(fragment) == [])


async def test_what_is_wrong_with_the_settings_is_told_at_its_place(harness: Harness) -> None:
    settings = harness.workspace / ".ros-preflight.yaml"
    settings.write_text("roots:\n  - fiel: x.launch\n")
    async with editing(harness) as editor:
        editor.open(harness.launch_file)
        found = await editor.having(settings, "LCH031")
        assert "key 'file' is missing" in found.message
        assert editor.client.messages == [], "said once, at its place"


async def test_the_place_in_the_settings_is_shown_until_it_is_mended(harness: Harness) -> None:
    settings = harness.workspace / ".ros-preflight.yaml"
    settings.write_text("external:\n  topic: [/a]\n")
    async with editing(harness) as editor:
        editor.open(harness.launch_file, harness.launch_file.read_text() + "<")
        found = await editor.having(settings, "LCH031")
        assert "unknown key 'topic' of 'external'" in found.message
        assert (found.range.start.line, found.range.start.character, found.range.end.character) == (1, 2, 13)
        settings.write_text("external:\n  topics: [/a]\n")
        editor.watched(settings)
        await editor.without(settings, "LCH031")


async def test_indexing_shows_its_progress(harness: Harness) -> None:
    for number in range(300):
        (harness.workspace / f"f{number}.launch").write_text(FRAGMENT)
    async with editing(harness) as editor:
        values = await editor.until(lambda: next(iter(editor.progress_of("Indexing launch files").values()), None))
        await editor.until(lambda: values[-1]["kind"] == "end")
        assert "launch files" in values[-1]["message"]


async def test_findings_are_those_of_the_root_that_was_selected(harness: Harness) -> None:
    fragment, fast, slow = create_workspace(harness)
    (harness.workspace / "50.launch").write_text("<launch/>\n")
    fragment.write_text(FRAGMENT.replace("</launch>", '  <include file="$(dirname)/$(arg rate).launch"/>\n</launch>'))
    async with editing(harness) as editor:
        editor.open(fragment)
        await editor.having(fragment, "LCH013")  # 2.launch, as slow.launch includes it
        select: dict[str, Any] = {"uri": fragment.as_uri(), "root": {"uri": fast.as_uri(), "args": {}}}
        await ask(editor, "rosPreflight/selectRoot", select)
        await editor.without(fragment, "LCH013")
        select["root"] = {"uri": slow.as_uri(), "args": {}}
        await ask(editor, "rosPreflight/selectRoot", select)
        await editor.having(fragment, "LCH013")
        select["root"] = {"uri": fragment.as_uri(), "args": {"rate": "50"}}
        await ask(editor, "rosPreflight/selectRoot", select)
        await editor.without(fragment, "LCH013")
        select["root"] = None
        await ask(editor, "rosPreflight/selectRoot", select)
        await editor.having(fragment, "LCH013")


async def test_nothing_is_left_of_a_root_that_is_gone(harness: Harness) -> None:
    fragment, fast, slow = create_workspace(harness)
    async with editing(harness) as editor:
        editor.open(fragment)
        await editor.until(lambda: editor.rules(fragment) == [])
        for root in (fast, slow):
            root.unlink()
            editor.watched(root, kind=types.FileChangeType.Deleted)

            async def known() -> list[str]:
                return [
                    each.uri for each in (await ask(editor, "rosPreflight/roots", {"uri": fragment.as_uri()})).roots
                ]

            await editor.once(known, lambda uris, root=root: root.as_uri() not in uris)
        await editor.until(lambda: editor.rules(fragment) == ["ARG003"])
        await editor.until(
            lambda: {uri for uri, params in editor.published.items() if params.diagnostics} == {fragment.as_uri()}
        )
