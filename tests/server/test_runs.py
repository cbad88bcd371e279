"""Runs of nodes: cancelled by the user, superseded by an edit, ended with the server, and never in the way."""

from __future__ import annotations

import asyncio
import uuid
from pathlib import Path

import pytest
from lsprotocol import types
from support.editor_harness import Harness
from support.lsp_client import Editor, editing
from support.tracing_harness import processes_with
from support.waiting import until

pytestmark = pytest.mark.ros

SLOW = """#!/usr/bin/env python3
import time
import rospy
time.sleep(60)
rospy.init_node("slow")
rospy.spin()
"""


@pytest.fixture
def slow(harness: Harness) -> Path:
    """A launch file with a node that is run for as long as any: until its time is up."""
    script = harness.launch_file.parents[1] / "scripts/slow.py"
    script.write_text(SLOW)
    script.chmod(0o755)
    path = harness.launch_file.with_name("slow.launch")
    path.write_text('<launch>\n  <node pkg="preflight_demo" type="slow.py" name="slow"/>\n</launch>\n')
    return path


def sandboxes(harness: Harness) -> list[str]:
    """Processes of the harness besides the server itself."""
    return [line for line in harness.processes() if " lsp" not in line]


async def running(editor: Editor, harness: Harness) -> types.ProgressToken:
    """Wait until a node runs and its progress is shown. Before it come the probe, and our own code to be compiled."""
    token = await editor.until(lambda: next(iter(editor.runs), None))
    await editor.until(lambda: harness.sandbox_starts() >= 3)
    return token


async def test_the_user_can_cancel(harness: Harness, slow: Path) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(slow)
        token = await running(editor, harness)
        editor.client.window_work_done_progress_cancel(types.WorkDoneProgressCancelParams(token))
        found = await editor.having(slow, "TRC004")
        assert "cancelled" in found.message
        await editor.until(lambda: editor.progress[token][-1]["kind"] == "end")
        starts = harness.sandbox_starts()
        editor.replace(slow, 8, 8, "\n")
        await editor.having(slow, "TRC004")  # of the text after the edit
        await asyncio.sleep(1.5)  # nothing tells that a run will not come
        assert harness.sandbox_starts() == starts, "an edit does not undo the user's decision"
        editor.save(slow)
        await editor.until(lambda: harness.sandbox_starts() > starts)


async def test_an_edit_supersedes_a_run_that_is_no_longer_wanted(harness: Harness, slow: Path) -> None:
    async with editing(harness, trusted=True) as editor:
        text = editor.open(slow)
        await running(editor, harness)
        at = text.index("slow.py")
        editor.replace(slow, at, at + len("slow.py"), "talker.py")
        hint = await editor.having(slow, "TOP002")
        assert "chatter" in hint.message


async def test_an_edit_leaves_a_run_alone_that_it_does_not_concern(harness: Harness) -> None:
    script = harness.launch_file.parents[1] / "scripts/late.py"
    script.write_text(SLOW.replace("sleep(60)", "sleep(1)"))
    script.chmod(0o755)
    path = harness.launch_file.with_name("late.launch")
    path.write_text(
        '<launch>\n  <param name="unread" value="1"/>\n  <node pkg="preflight_demo" type="late.py" name="late"/>\n'
        '  <node pkg="preflight_demo" type="listener.py" name="listener"/>\n</launch>\n'
    )
    async with editing(harness, trusted=True) as editor:
        text = editor.open(path)
        await editor.until(lambda: harness.sandbox_starts() >= 4, 60)
        at = text.index('value="1"')
        editor.replace(path, at, at + len('value="1"'), 'value="2"')
        await editor.having(path, "TOP001", seconds=60)
        await editor.until(lambda: all(values[-1]["kind"] == "end" for values in editor.runs.values()), 60)
        assert harness.sandbox_starts() == 4, "the probe, our own code to be compiled and each node once"


async def test_the_server_answers_while_nodes_run(harness: Harness, slow: Path) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(slow)
        await running(editor, harness)

        async def answers() -> bool:
            """Whether it does before the end of a run, which is given up after some seconds."""
            await editor.client.protocol.send_request_async("rosPreflight/trace", {"uri": slow.as_uri()})
            token = await editor.until(
                lambda: next((t for t, v in editor.runs.items() if v[-1]["kind"] != "end"), None)
            )
            hover = await editor.hover(slow, editor.at(slow, 'name="slow"'))
            assert hover is not None
            assert isinstance(hover.contents, types.MarkupContent)
            assert "**/slow**" in hover.contents.value
            assert [s.name for s in await editor.symbols(slow)] == ["slow"]
            return bool(editor.progress[token][-1]["kind"] != "end")

        await editor.once(answers, bool)


async def test_shutdown_ends_the_runs(harness: Harness, slow: Path) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(slow)
        await running(editor, harness)
    until(lambda: harness.processes() == [])


async def test_a_client_that_vanishes_leaves_nothing_running(harness: Harness, slow: Path) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(slow)
        await running(editor, harness)
        server = editor.client._server
        assert server is not None
        assert server.stdin is not None
        server.stdin.close()
        await asyncio.wait_for(server.wait(), 60)
        assert server.returncode == 1, "exit without shutdown"
        await editor.until(lambda: not harness.processes())
        editor.client.error = ConnectionError("the server is gone, as the test wants it")


async def test_a_killed_server_leaves_nothing_running(harness: Harness, slow: Path) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(slow)
        await running(editor, harness)
        server = editor.client._server
        assert server is not None
        server.kill()
        await server.wait()
        await editor.until(lambda: not harness.processes())
        editor.client.error = ConnectionError("the server is gone, as the test wants it")


async def test_a_changed_script_is_run_again(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        await editor.misspelling(harness.launch_file)
        script = harness.launch_file.parents[1] / "scripts/talker.py"
        script.write_text(script.read_text().replace('"chatter"', '"chater"'))
        editor.watched(script)
        await editor.without(harness.launch_file, "TOP001")


async def test_a_node_that_crashes_is_a_finding(harness: Harness) -> None:
    script = harness.launch_file.parents[1] / "scripts/listener.py"
    script.write_text(script.read_text().replace("rospy.spin()", 'raise RuntimeError("no laser here")'))
    async with editing(harness, trusted=True) as editor:
        editor.open(harness.launch_file)
        found = await editor.having(harness.launch_file, "TRC001")
        assert "/listener" in found.message
        hover = await editor.hover(harness.launch_file, editor.at(harness.launch_file, 'name="listener"'))
        assert hover is not None
        assert isinstance(hover.contents, types.MarkupContent)
        assert "no laser here" in hover.contents.value


async def test_a_half_typed_tag_starts_no_run(harness: Harness) -> None:
    async with editing(harness, trusted=True) as editor:
        text = harness.launch_file.read_text().replace('name="listener"', 'name="listener')
        editor.open(harness.launch_file, text)
        await editor.having(harness.launch_file, "LCH001")
        ended = lambda: any(values[-1]["kind"] == "end" for values in editor.runs.values())  # noqa: E731
        await editor.until(ended)
        said = [value.get("message") for values in editor.runs.values() for value in values]
        assert said[-1] == "1 node", "only the talker"
        editor.change(harness.launch_file, harness.launch_file.read_text())
        await editor.misspelling(harness.launch_file)


READS_FIRST = """#!/usr/bin/env python3
import os, subprocess, time
read = lambda: open(os.path.join(os.path.dirname(__file__), "name.txt")).read()
name = read()
import rospy
from std_msgs.msg import String
rospy.init_node("late")
rospy.Publisher("a", String, queue_size=1)
if name == "before":
    shown = subprocess.Popen(["sleep", "MARKER"])
    while read() in ("", "before"): time.sleep(0.02)
    shown.kill()
rospy.Publisher(name, String, queue_size=1)
rospy.spin()
"""


async def test_a_file_that_changes_during_the_run_that_read_it(harness: Harness) -> None:
    script = harness.launch_file.parents[1] / "scripts/late.py"
    marker = f"{uuid.uuid4().int % 1_000_000 + 600}"  # seconds, which no other process sleeps
    script.write_text(READS_FIRST.replace("MARKER", marker))
    script.chmod(0o755)
    name = script.with_name("name.txt")
    name.write_text("before")
    path = harness.launch_file.with_name("late.launch")
    path.write_text(
        '<launch>\n  <node pkg="preflight_demo" type="late.py" name="late"/>\n'
        '  <node pkg="preflight_demo" type="listener.py" name="l"><remap from="chatter" to="befor"/></node>\n'
        "</launch>\n"
    )
    async with editing(harness, trusted=True) as editor:
        editor.open(path)
        await editor.until(lambda: processes_with(marker))  # it has read the name, and not used it yet
        name.write_text("after")
        editor.watched(name)
        await editor.having(path, "TOP001")

        async def seen() -> str:
            hover = await editor.hover(path, editor.at(path, "late.py"))
            assert hover is not None
            assert isinstance(hover.contents, types.MarkupContent)
            return hover.contents.value

        await editor.once(seen, lambda text: "/after" in text)
        assert "/before" not in await seen()


COUNTED = """#!/usr/bin/env python3
import rospy
rospy.init_node("counted")
rospy.get_param("~rate", 10)
rospy.Publisher("{topic}", rospy.AnyMsg, queue_size=1)
rospy.spin()
"""


async def test_a_syntax_error_stops_only_what_it_touches(harness: Harness) -> None:
    """Nodes of a launch with a broken file run; those in whose tag the error stands do not, and the status names the
    file."""
    folder = harness.launch_file.parent
    for topic in ("one", "two", "three"):
        script = folder.parent / f"scripts/{topic}.py"
        script.write_text(COUNTED.format(topic=topic))
        script.chmod(0o755)
    inner, outer = folder / "inner.launch", folder / "outer.launch"
    inner.write_text('<launch>\n  <node pkg="preflight_demo" type="two.py" name="two"/>\n</launch>\n')
    node = '  <node pkg="preflight_demo" type="{0}.py" name="{0}"/>\n'
    include = '  <include file="$(dirname)/inner.launch"/>\n'
    broken = node.format("three").replace("/>", "><param name='a' value=</node>")
    outer.write_text(f"<launch>\n{node.format('one')}{include}{broken}</launch>\n")
    async with editing(harness, trusted=True, settings={"status": True}) as editor:
        editor.open(outer)
        await editor.until(lambda: editor.statuses and list(editor.statuses[-1].broken) == [outer.as_uri()])

        async def nodes() -> dict[str, str]:
            answer = await editor.client.protocol.send_request_async("rosPreflight/graph", {"uri": outer.as_uri()})
            return {each.name: each.source for each in answer.graph.nodes}

        found = await editor.once(nodes, lambda found: list(found.values()).count("trace") == 2)
        assert found == {"/one": "trace", "/two": "trace", "/three": "none"}

        editor.change(outer, f"<launch>\n{node.format('one')}{include}{node.format('three')}</launch>\n")
        await editor.once(nodes, lambda found: set(found.values()) == {"trace"})
        await editor.until(lambda: list(editor.statuses[-1].broken) == [])

        editor.open(inner)
        editor.change(inner, inner.read_text().replace("</launch>", "  <node pkg="))
        await editor.until(lambda: list(editor.statuses[-1].broken) == [inner.as_uri()])
        assert set((await nodes()).values()) == {"trace"}, "what was known stays"


CRASHES = """<launch>
  <group ns="robot1"><node pkg="preflight_demo" type="base.py" name="base"/></group>
  <node pkg="preflight_demo" type="base.py" name="base"><param name="wheel" value="5cm"/></node>
</launch>
"""


async def test_a_crash_and_its_cause_are_one_entry(harness: Harness) -> None:
    """The cause first; a crash without a cause stands by itself."""
    script = harness.workspace / "scripts/base.py"
    script.write_text(
        "#!/usr/bin/env python3\nimport rospy\nrospy.init_node('base')\n"
        "float(rospy.get_param('~wheel'))\nrospy.spin()\n"
    )
    script.chmod(0o755)
    path = harness.write("crashes.launch", CRASHES)
    async with editing(harness, trusted=True) as editor:
        editor.open(path)
        crash = await editor.having(path, "TRC001", saying="ValueError")
        assert crash.range.start.line == 2
        cause = await editor.having(path, "PRM010", saying="/robot1/base/wheel")
        assert any("/robot1/base crashes on start" in each.message for each in cause.related_information or ())
        await editor.until(lambda: (editor.rules(path) or []).count("TRC001") == 1)
