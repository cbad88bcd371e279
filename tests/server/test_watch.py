"""The running system in the editor: only when asked for, only with trust, and along with the edits."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from support.editor_harness import Harness
from support.live_harness import Ros1System
from support.lsp_client import Editor, editing

pytestmark = pytest.mark.ros


@pytest.fixture
def system(harness: Harness, tmp_path: Path) -> Iterator[Ros1System]:
    system = Ros1System(tmp_path / "robot", elsewhere=harness.workspace)
    harness.environment["ROS_MASTER_URI"] = system.environment["ROS_MASTER_URI"]
    yield system
    system.close()


async def watch(editor: Editor, path: Path, on: bool = True) -> Any:
    params = {"uri": path.as_uri(), "watch": on}
    return await editor.client.protocol.send_request_async("rosPreflight/watch", params)


def told(editor: Editor) -> Any:
    """What was told last, if it is a state its messages."""
    last = editor.live[-1] if editor.live else None
    return [issue.message for issue in last.issues] if last is not None and last.event == "state" else last


async def test_the_running_system_is_compared_with_the_file_as_it_is_edited(
    harness: Harness, system: Ros1System
) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
        answer = await watch(editor, harness.launch_file)
        assert (answer.watching, answer.message) == (True, None)
        await editor.until(lambda: told(editor) is not None)
        assert (editor.live[-1].event, editor.live[-1].root.uri) == ("waiting", harness.launch_file.as_uri())
        assert "connection refused" in editor.live[-1].reason

        system.launch(harness.launch_file)
        await editor.until(lambda: told(editor) == [] and set(editor.live[-1].nodes) == {"present"})
        assert editor.live[-1].same
        os.kill(system.pid("/listener"), signal.SIGKILL)
        await editor.until(lambda: told(editor) == ["/listener is registered and does not answer: connection refused"])
        (issue,) = editor.live[-1].issues
        assert (issue.kind, issue.location.uri, issue.location.range.start.line) == (
            "dead",
            harness.launch_file.as_uri(),
            5,
        )

        text = editor.texts[harness.launch_file]
        editor.change(harness.launch_file, text.replace("</launch>", '<node pkg="p" type="t" name="new"/></launch>'))
        await editor.until(lambda: isinstance(told(editor), list) and "/new is not running" in told(editor))
        # A file in the middle of being typed is compared, too.
        editor.change(harness.launch_file, text.replace("</launch>", '<node pkg="p" type="t" name="newer'))
        await editor.until(lambda: isinstance(told(editor), list) and "/newer is not running" in told(editor))

        answer = await watch(editor, harness.launch_file, on=False)
        assert (answer.watching, answer.message) == (False, None)
        await editor.until(lambda: editor.live[-1].event == "stopped")
        assert editor.live[-1].reason is None


async def test_without_trust_nothing_is_watched(harness: Harness, system: Ros1System) -> None:
    async with editing(harness) as editor:
        editor.open(harness.launch_file)
        answer = await watch(editor, harness.launch_file)
        assert (answer.watching, "not trusted" in answer.message) == (False, True)
        assert editor.live == []
        editor.trust()
        assert (await watch(editor, harness.launch_file)).watching
        await editor.until(lambda: editor.live and editor.live[-1].event == "waiting")
        editor.trust(False)
        await editor.until(lambda: editor.live[-1].event == "stopped")
        assert "no longer trusted" in editor.live[-1].reason


async def test_what_is_no_launch_file_is_not_watched(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        answer = await watch(editor, harness.workspace / "nothing.launch")
        assert (answer.watching, answer.message) == (False, "not a launch file, or unreadable")
        assert (await watch(editor, harness.workspace / "nothing.launch", on=False)).watching is False


async def test_a_master_that_cannot_be_asked_ends_it(harness: Harness) -> None:
    harness.environment["ROS_MASTER_URI"] = "robot:11311"
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        assert (await watch(editor, harness.launch_file)).watching
        await editor.until(lambda: editor.live and editor.live[-1].event == "stopped")
        assert "robot:11311" in editor.live[-1].reason
