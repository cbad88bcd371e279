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


ALONE = """<launch>
  <arg name="ns" default="a"/>
  <node pkg="robot" exec="talker" name="talker" namespace="$(var ns)">
    <param from="$(dirname)/params.yaml"/>
  </node>
</launch>
"""
PARAMS = "/**/talker:\n  ros__parameters:\n    rate: 5.0\n"


def create_ros2_package(harness: Harness) -> tuple[Path, Path, Path, Path]:
    """A launch file that needs nobody, its parameter file, and two launch files that include it under other names."""
    folder = harness.home / "ros2_ws/src/robot"
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(
        "<package format='3'><name>robot</name><export><build_type>ament_cmake</build_type></export></package>\n"
    )
    alone, params = folder / "alone.launch.xml", folder / "params.yaml"
    alone.write_text(ALONE)
    params.write_text(PARAMS)
    others = []
    for name in ("b", "c"):
        other = folder / f"{name}.launch.xml"
        passed = f'<arg name="ns" value="{name}"/>'
        other.write_text(
            f'<launch><include file="$(find-pkg-share robot)/alone.launch.xml">{passed}</include></launch>\n'
        )
        others.append(other)
    return alone, params, others[0], others[1]


async def titles(editor: Editor, path: Path) -> list[str]:
    return [lens.command.title for lens in await editor.lenses(path) if lens.command is not None]


async def hovered(editor: Editor, path: Path, needle: str) -> str:
    found = await editor.hover(path, editor.at(path, needle, 1))
    return str(getattr(found.contents, "value", "")) if found else ""


async def roots_of(editor: Editor, path: Path) -> tuple[str, int]:
    """The name of the root that a file is shown in, and how many there are."""
    answer = await ask(editor, "rosPreflight/roots", {"uri": path.as_uri()})
    return answer.shown.uri.rpartition("/")[2] if answer.shown else "", len(answer.roots)


async def indexed(editor: Editor, path: Path, roots: int) -> None:
    await editor.once(lambda: roots_of(editor, path), lambda found: found[1] == roots)


async def test_a_file_that_needs_nobody_is_launched_alone(harness: Harness) -> None:
    alone, _, _, _ = create_ros2_package(harness)
    async with editing(harness, folder=harness.home / "ros2_ws") as editor:
        editor.open(alone)
        await indexed(editor, alone, 3)
        assert (await titles(editor, alone))[-1] == "launched by this file"
        text = await hovered(editor, alone, "$(var ns)")
        assert "argument `ns` = `a`" in text
        assert "Launched by `src/robot/alone.launch.xml`, one of 3 launches" in text
        editor.change(alone, ALONE.replace(' default="a"', ""))
        await editor.once(lambda: titles(editor, alone), lambda found: found[-1] == "launched by b.launch.xml")
        assert editor.rules(alone) == [] or "ARG003" not in (editor.rules(alone) or [])
        assert editor.messages[-1] == "ros-preflight: alone.launch.xml is now analysed as launched by b.launch.xml."


async def test_of_several_launches_the_one_counts_of_which_most_is_known(harness: Harness) -> None:
    fragment, fast, _ = create_workspace(harness)
    fast.write_text(fast.read_text().replace("<launch>", '<launch><arg name="unset"/>'))
    async with editing(harness) as editor:
        editor.open(fragment)
        await indexed(editor, fragment, 2)
        assert await roots_of(editor, fragment) == ("slow.launch", 2)


async def test_a_choice_counts_at_once_for_all_that_the_root_reaches_and_is_remembered(harness: Harness) -> None:
    alone, params, b, _ = create_ros2_package(harness)
    folder = harness.home / "ros2_ws"
    async with editing(harness, folder=folder) as editor:
        editor.open(alone)
        await indexed(editor, alone, 3)
        editor.open(params, language="yaml")
        assert await titles(editor, params) == ["launched by alone.launch.xml"]
        text = await editor.once(lambda: hovered(editor, params, "/**/talker"), lambda found: "By launch" in found)
        assert "`/a/talker` in `src/robot/alone.launch.xml`" in text
        assert "`/b/talker` in `src/robot/b.launch.xml`" in text
        assert text.startswith("`/**/talker` is for\n\n- `/a/talker`")
        assert "- `/b/talker` `robot" not in text
        select: dict[str, Any] = {"uri": alone.as_uri(), "root": {"uri": b.as_uri(), "args": {}}}
        assert (await ask(editor, "rosPreflight/selectRoot", select)).message is None
        text = await hovered(editor, params, "/**/talker")
        assert text.startswith("`/**/talker` is for\n\n- `/b/talker`")
        assert await titles(editor, params) == ["launched by b.launch.xml"]
        assert (await titles(editor, alone))[-1] == "launched by b.launch.xml"
    async with editing(harness, folder=folder) as editor:
        editor.open(params, language="yaml")
        assert await titles(editor, params) == ["launched by b.launch.xml"]
        editor.open(alone)
        assert (await titles(editor, alone))[-1] == "launched by b.launch.xml"
        select = {"uri": alone.as_uri(), "root": None}
        await ask(editor, "rosPreflight/selectRoot", select)
        assert (await titles(editor, alone))[-1] == "launched by this file"


async def test_what_was_decided_stays_when_another_file_is_opened(harness: Harness) -> None:
    alone, params, _, _ = create_ros2_package(harness)
    async with editing(harness, folder=harness.home / "ros2_ws") as editor:
        editor.open(params, language="yaml")
        await editor.once(lambda: titles(editor, params), lambda found: found == ["launched by b.launch.xml"])
        editor.open(alone)
        await editor.once(lambda: titles(editor, alone), lambda found: found[-1:] == ["launched by this file"])
        assert await titles(editor, params) == ["launched by b.launch.xml"]


async def test_the_user_is_told_when_a_root_is_no_longer_one_of_the_file(harness: Harness) -> None:
    fragment, fast, _ = create_workspace(harness)
    async with editing(harness) as editor:
        editor.open(fragment)
        await editor.once(lambda: titles(editor, fragment), lambda found: found[-1:] == ["launched by fast.launch"])
        fast.write_text("<launch/>\n")
        editor.watched(fast)
        await editor.until(lambda: editor.messages)
        assert editor.messages == ["ros-preflight: fragment.launch is now analysed as launched by slow.launch."]
        assert (await titles(editor, fragment))[-1] == "launched by slow.launch"


async def test_any_editor_lets_the_user_choose(harness: Harness) -> None:
    fragment, _, _ = create_workspace(harness)
    async with editing(harness) as editor:
        asked: list[types.ShowMessageRequestParams] = []

        @editor.client.feature(types.WINDOW_SHOW_MESSAGE_REQUEST)
        def answer(params: types.ShowMessageRequestParams) -> types.MessageActionItem:
            asked.append(params)
            return types.MessageActionItem("slow.launch")

        editor.open(fragment)
        await editor.once(lambda: titles(editor, fragment), lambda found: found[-1:] == ["launched by fast.launch"])
        lens = (await editor.lenses(fragment))[-1]
        await editor.execute(lens.command)
        assert [each.title for each in asked[0].actions or ()] == [
            "fast.launch",
            "slow.launch",
            "fragment.launch",
            "Default",
        ]
        assert (await titles(editor, fragment))[-1] == "launched by slow.launch"


async def test_what_holds_in_one_launch_of_several_is_not_said_before_the_others_are_known(harness: Harness) -> None:
    """The listener alone has no publisher; the launch that includes it starts one."""
    node = '<node pkg="preflight_demo" type="{0}.py" name="{0}"/>'
    listener = harness.write("listener.launch", f"<launch>{node.format('listener')}</launch>\n")
    include = '<include file="$(dirname)/listener.launch"/><node pkg="nowhere" type="t" name="n"/>'
    both = harness.write("both.launch", f"<launch>{node.format('talker')}{include}</launch>\n")
    async with editing(harness) as editor:
        editor.open(listener)
        await editor.having(both, "PKG001")
        said = [[d.code for d in each.diagnostics] for each in editor.history if each.uri == listener.as_uri()]
        assert said, "something was published"
        assert not any("TOP" in str(code) for codes in said for code in codes)
