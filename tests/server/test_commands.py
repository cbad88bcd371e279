"""Commands of parameters in the editor: run in the background, with trust only, and shown."""

from __future__ import annotations

from pathlib import Path

import pytest
from lsprotocol import types
from support.editor_harness import Harness
from support.lsp_client import Editor, editing
from support.xacro_package import create_robot

pytestmark = pytest.mark.ros

SLEEP = "bash -c 'sleep 60' "
READER = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import String
rospy.init_node("reader")
made = rospy.get_param("/robot_description").count("<link")
rospy.Subscriber("links_%d" % made, String, print)
rospy.spin()
"""


@pytest.fixture
def robot(harness: Harness) -> Path:
    """The launch file of a robot with a node that reads its description, in a workspace of its own."""
    launch = create_robot(harness.home / "robots")
    script = launch.parents[1] / "reader.py"
    script.write_text(READER)
    script.chmod(0o755)
    node = '  <node pkg="arm" type="reader.py" name="reader"/>\n</launch>'
    launch.write_text(launch.read_text().replace("</launch>", node))
    return launch


def slow(robot: Path) -> str:
    """The launch file with a command that takes longer than it may."""
    return robot.read_text().replace('command="', f'command="{SLEEP}')


async def hovered(editor: Editor, path: Path, needle: str) -> str:
    hover = await editor.hover(path, editor.at(path, needle))
    assert hover is not None
    assert isinstance(hover.contents, types.MarkupContent)
    return hover.contents.value


async def shown(editor: Editor, path: Path, needle: str, text: str) -> str:
    """The hover over `needle`, once it has `text`."""
    return await editor.once(lambda: hovered(editor, path, needle), lambda found: text in found)


async def test_nodes_run_with_what_the_command_printed(harness: Harness, robot: Path) -> None:
    async with editing(harness, trusted=True, folder=harness.home / "robots") as editor:
        editor.open(robot)
        text = await shown(editor, robot, "<param", "printed")
        assert '<link length="0.25" name="right_thumb"/>' in text
        assert "links_1" in await shown(editor, robot, "<node", "Subscribers")
        assert editor.rules(robot) is not None
        assert not {"LCH018", "PRM008", "TRC001"} & set(editor.rules(robot) or ())
        assert all("links_1" in d.message for d in editor.diagnostics(robot) or () if d.code == "TOP001")


async def test_a_changed_xacro_file_runs_again_and_an_unrelated_one_does_not(harness: Harness, robot: Path) -> None:
    async with editing(harness, trusted=True, folder=harness.home / "robots") as editor:
        editor.open(robot)
        await shown(editor, robot, "<node", "links_1")
        starts = harness.sandbox_starts()
        urdf = robot.parents[1] / "urdf"
        (urdf / "unrelated.xacro").write_text("<robot/>")
        editor.watched(urdf / "unrelated.xacro")
        await shown(editor, robot, "<node", "links_1")
        macros = urdf / "macros.xacro"
        macros.write_text(macros.read_text().replace("<link ", '<link name="more"/><link '))
        editor.watched(macros)
        await shown(editor, robot, "<node", "links_2")
        assert harness.sandbox_starts() == starts + 2, "xacro and the node"


async def test_a_failing_command_is_a_diagnostic_until_it_is_repaired(harness: Harness, robot: Path) -> None:
    macros = robot.parents[1] / "urdf/macros.xacro"
    good = macros.read_text()
    macros.write_text("<robot><link></robot>")
    async with editing(harness, trusted=True, folder=harness.home / "robots") as editor:
        editor.open(robot)
        found = await editor.having(robot, "PRM008")
        assert found.severity == types.DiagnosticSeverity.Error
        assert "macros.xacro" in found.message
        assert editor.covered(robot, found.range).startswith("$(find xacro)/xacro ")
        assert "failed: it ended with exit code 2" in await hovered(editor, robot, "<param")
        macros.write_text(good)
        editor.watched(macros)
        await editor.without(robot, "PRM008")


async def test_without_trust_nothing_is_run_and_the_reason_is_shown(harness: Harness, robot: Path) -> None:
    async with editing(harness, folder=harness.home / "robots") as editor:
        editor.open(robot)
        found = await editor.having(robot, "LCH018")
        assert found.severity == types.DiagnosticSeverity.Hint
        assert "not trusted" in found.message
        assert "was not run: the workspace is not trusted" in await hovered(editor, robot, "<param")
        assert harness.sandbox_starts() == 0
        editor.trust()
        await editor.without(robot, "LCH018")
        await shown(editor, robot, "<param", "right_thumb")
        editor.trust(False)
        await editor.having(robot, "LCH018")
        assert "right_thumb" not in await hovered(editor, robot, "<param")


async def test_a_switch_in_the_settings(harness: Harness, robot: Path) -> None:
    folder = harness.home / "robots"
    async with editing(harness, trusted=True, settings={"runNodes": False}, folder=folder) as editor:
        editor.open(robot)
        assert "rosPreflight.runNodes" in (await editor.having(robot, "LCH018")).message
        assert harness.sandbox_starts() == 0


async def test_while_it_runs_nothing_is_said_and_it_can_be_cancelled(harness: Harness, robot: Path) -> None:
    title = "Running parameter commands in the sandbox"
    async with editing(harness, trusted=True, folder=harness.home / "robots") as editor:
        editor.open(robot, slow(robot))
        token = await editor.until(lambda: next(iter(editor.progress_of(title)), None))
        assert "is not run yet" in await hovered(editor, robot, "<param")
        assert not {"LCH018", "TRC004"} & set(editor.rules(robot) or ())
        editor.client.window_work_done_progress_cancel(types.WorkDoneProgressCancelParams(token))
        assert "cancelled" in (await editor.having(robot, "LCH018")).message
        starts = harness.sandbox_starts()
        editor.trust()  # the user tries again
        await editor.without(robot, "LCH018")
        await editor.until(lambda: harness.sandbox_starts() > starts or None)


async def test_an_edit_stops_a_command_that_nobody_asks_for_any_more(harness: Harness, robot: Path) -> None:
    title = "Running parameter commands in the sandbox"
    async with editing(harness, trusted=True, folder=harness.home / "robots") as editor:
        editor.open(robot, slow(robot))
        token = await editor.until(lambda: next(iter(editor.progress_of(title)), None))
        editor.change(robot, slow(robot).replace(SLEEP, ""))
        await editor.until(lambda: editor.progress[token][-1]["kind"] == "end")
        assert editor.progress[token][-1]["message"] == "cancelled"
        await shown(editor, robot, "<node", "links_1")


async def test_in_a_file_that_does_not_parse_the_last_result_is_kept(harness: Harness, robot: Path) -> None:
    async with editing(harness, trusted=True, folder=harness.home / "robots") as editor:
        text = editor.open(robot)
        await shown(editor, robot, "<param", "right_thumb")
        editor.change(robot, text.replace("</launch>", "<node "))
        assert "right_thumb" in await hovered(editor, robot, "<param")
