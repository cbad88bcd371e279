"""What can be done about a finding, through the real server, in all formats of launch files and in parameter files."""

from __future__ import annotations

from pathlib import Path

import pytest
from lsprotocol import types
from support.editor_harness import Harness
from support.lsp_client import Editor, capabilities, editing, from_uri

pytestmark = pytest.mark.ros

SETTINGS = ".ros-preflight.yaml"
XML = """<launch>
  <node pkg="preflight_demo"
        type="talker.py"
        name="talker" nmae="x"/>
</launch>
"""


async def offered(editor: Editor, path: Path, rule: str, only: str = "quickfix") -> dict[str, types.CodeAction]:
    """The actions at the finding of a rule, by their titles."""
    found = await editor.having(path, rule)
    actions = await editor.actions(path, found.range, [only])
    assert len({action.title for action in actions}) == len(actions), "each is called differently"
    return {action.title: action for action in actions}


FORMATS = {
    "robot.launch": ("LCH005", XML, '  <!-- preflight: ignore[LCH005] -->\n  <node pkg="preflight_demo"'),
    "robot.launch.xml": (
        "ARG001",
        '<launch>\n\t<let name="a" value="$(var b)"/>\n</launch>\n',
        "\t<!-- preflight: ignore[ARG001] -->\n\t<let",
    ),
    "robot.launch.yaml": (
        "ARG001",
        "launch:\n  - let:\n      name: a\n      value: $(var b)\n",
        "      # preflight: ignore[ARG001]\n      value",
    ),
    "robot.launch.py": (
        "LCH032",
        "from launch import LaunchDescription\n\n\ndef generate_launch_description():\n"
        "    return LaunchDescription([\n        Node(),\n    ])\n",
        "        # preflight: ignore[LCH032]\n        Node()",
    ),
}


@pytest.mark.parametrize("name", FORMATS)
async def test_suppress_on_the_line(harness: Harness, name: str) -> None:
    rule, text, written = FORMATS[name]
    path = harness.launch_file.with_name(name)
    async with editing(harness) as editor:
        editor.open(path, text, {".py": "python", ".yaml": "yaml"}.get(path.suffix, "roslaunch"))
        action = (await offered(editor, path, rule))[f"Suppress {rule} on this line"]
        assert [each.code for each in action.diagnostics or ()] == [rule]
        editor.apply(action.edit)
        assert written in editor.texts[path]
        await editor.without(path, rule)
        assert "LCH019" not in (editor.rules(path) or ()), "the comment is used"


async def test_a_second_rule_joins_the_comment(harness: Harness) -> None:
    path = harness.launch_file.with_name("robot.launch")
    text = XML.replace('nmae="x"', 'nmae="x" args="$(arg b)"')
    async with editing(harness) as editor:
        editor.open(path, text)
        editor.apply((await offered(editor, path, "LCH005"))["Suppress LCH005 on this line"].edit)
        await editor.without(path, "LCH005")
        editor.apply((await offered(editor, path, "ARG001"))["Suppress ARG001 on this line"].edit)
        assert "<!-- preflight: ignore[LCH005, ARG001] -->" in editor.texts[path]
        await editor.without(path, "ARG001")


@pytest.mark.parametrize("before", [None, "# ours\nroots: []  # none\n"])
@pytest.mark.parametrize("where", ["this file", "the workspace"])
async def test_suppress_in_the_settings(harness: Harness, where: str, before: str | None) -> None:
    path, settings = harness.write("robot.launch", XML), harness.workspace / SETTINGS
    other = harness.write("other.launch", XML)
    if before is not None:
        settings.write_text(before)
    async with editing(harness) as editor:
        editor.open(path)
        editor.open(other)
        await editor.having(other, "LCH005")
        action = (await offered(editor, path, "LCH005"))[f"Suppress LCH005 in {where} ({SETTINGS})"]
        editor.apply(action.edit)
        written = editor.texts[settings]
        assert written.startswith(before or "")
        expected = "severities:\n  LCH005: off\n"
        if where == "this file":
            expected = "paths:\n  - path: launch/robot.launch\n    severities: {LCH005: off}\n"
        assert written == (before or "") + expected
        editor.save(settings)
        await editor.without(path, "LCH005")
        if where == "this file":
            assert "LCH005" in (editor.rules(other) or ())
        else:
            await editor.without(other, "LCH005")


@pytest.mark.silent
async def test_what_cannot_be_suppressed_there_is_not_offered(harness: Harness) -> None:
    """An editor that creates no files, settings that are no settings."""
    path = harness.write("robot.launch", XML)
    async with editing(harness, client=capabilities(creates=False)) as editor:
        editor.open(path)
        assert not [title for title in await offered(editor, path, "LCH005") if SETTINGS in title]
    (harness.workspace / SETTINGS).write_text("- a list\n")
    async with editing(harness) as editor:
        editor.open(path)
        assert not [title for title in await offered(editor, path, "LCH005") if SETTINGS in title]


TWICE = """<launch>
  <node pkg="preflight_demo" type="talker.py" name="a" outptu="log"/>
  <node pkg="preflight_demo" type="talker.py" name="b" outptu="log"/>
  <node pkg="preflight_demo" type="talkre.py" name="c"/>
</launch>
"""


async def test_fix_all_of_a_rule(harness: Harness) -> None:
    path = harness.write("twice.launch", TWICE)
    async with editing(harness) as editor:
        editor.open(path)
        found = await offered(editor, path, "LCH005")
        editor.apply(found["Fix all 2 LCH005 in this file"].edit)
        assert editor.texts[path] == TWICE.replace("outptu", "output")


async def test_fix_all_that_is_certain(harness: Harness) -> None:
    path = harness.write("twice.launch", TWICE)
    async with editing(harness) as editor:
        editor.open(path)
        await editor.having(path, "LCH005")
        top = types.Range(types.Position(3, 0), types.Position(3, 0))
        (action,) = await editor.actions(path, top, ["source.fixAll"])
        assert action.kind == "source.fixAll.rosPreflight"
        editor.apply(action.edit)
        assert "outptu" not in editor.texts[path]
        await editor.without(path, "LCH005")
        left = await editor.actions(path, top, ["source.fixAll"])
        assert left == []


async def test_the_page_of_a_rule(harness: Harness) -> None:
    path = harness.write("robot.launch", XML)
    async with editing(harness) as editor:
        editor.open(path)
        action = (await offered(editor, path, "LCH005"))["Explain LCH005 unknown-attribute"]
        await editor.execute(action.command)
        (uri,) = editor.shown
        page = from_uri(uri)
        assert page.is_relative_to(harness.home), "it needs no network"
        assert page.read_text().count("# LCH005 unknown-attribute") == 1
        found = await editor.having(path, "LCH005")
        assert found.code_description == types.CodeDescription(uri)
        assert await editor.execute(types.Command("", "rosPreflight.explainRule", arguments=["NOPE"])) is None
        assert len(editor.shown) == 1


@pytest.mark.silent
async def test_codes_are_no_links_for_a_client_that_does_not_follow_them(harness: Harness) -> None:
    path = harness.write("robot.launch", XML)
    client = capabilities()
    assert client.text_document is not None and client.text_document.publish_diagnostics is not None
    client.text_document.publish_diagnostics.code_description_support = False
    async with editing(harness, client=client) as editor:
        editor.open(path)
        assert (await editor.having(path, "LCH005")).code_description is None


async def test_trust_is_managed_where_the_client_can(harness: Harness) -> None:
    title = "Manage workspace trust"
    async with editing(harness, settings={"clientCommands": ["workbench.trust.manage"]}) as editor:
        editor.open(harness.launch_file)
        action = (await offered(editor, harness.launch_file, "TRC004"))[title]
        assert action.command is not None
        assert action.command.command == "workbench.trust.manage"
    async with editing(harness) as editor:
        editor.open(harness.launch_file)
        assert title not in await offered(editor, harness.launch_file, "TRC004")


async def test_the_command_that_installs_is_shown(harness: Harness) -> None:
    node = '<node pkg="image_rotate" type="image_rotate" name="rotate"/>'
    path = harness.write("robot.launch", f"<launch>\n  {node}\n</launch>\n")
    async with editing(harness) as editor:
        editor.open(path)
        found = await offered(editor, path, "PKG001")
        (title,) = [each for each in found if each.startswith("Show the command: ")]
        await editor.execute(found[title].command)
        await editor.until(lambda: editor.messages)
        assert title.removeprefix("Show the command: ") in editor.messages[0]
        assert harness.sandbox_starts() == 0


async def test_in_a_parameter_file(harness: Harness) -> None:
    launch = harness.write(
        "robot.launch",
        '<launch>\n  <node pkg="preflight_demo" type="talker.py" name="talker">\n'
        '    <rosparam file="$(find preflight_demo)/launch/p.yaml"/>\n  </node>\n</launch>\n',
    )
    params = harness.launch_file.with_name("p.yaml")
    params.write_text("rate: 5  # in Hz\nrtae: 6\n")
    async with editing(harness, trusted=True) as editor:
        editor.open(launch)
        editor.open(params, language="yaml")
        action = (await offered(editor, params, "PRM001"))["Suppress PRM001 on this line"]
        editor.apply(action.edit)
        assert editor.texts[params] == "rate: 5  # in Hz\n# preflight: ignore[PRM001]\nrtae: 6\n"
        await editor.without(params, "PRM001")
