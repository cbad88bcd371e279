"""Python launch files in the editor: run in the background with trust only, round after round."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.editor_harness import Harness
from support.lsp_client import Editor, editing

pytestmark = pytest.mark.ros

XML = """<launch>
  <include file="$(dirname)/inner.launch.py">
    <arg name="model" value="s1"/>
  </include>
</launch>
"""
PYTHON = """from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction

def made(context):
    return [DeclareLaunchArgument('model', choices=['a1', 's2'])]

def generate_launch_description():
    return LaunchDescription([OpaqueFunction(function=made)])
"""


@pytest.fixture
def outer(harness: Harness) -> Path:
    """An XML file that includes a Python file whose function declares the argument."""
    folder = harness.home / "robots" / "launch"
    folder.mkdir(parents=True)
    (folder / "inner.launch.py").write_text(PYTHON)
    path = folder / "outer.launch.xml"
    path.write_text(XML)
    return path


async def test_what_a_function_declares_is_known_in_the_file_that_includes_it(harness: Harness, outer: Path) -> None:
    async with editing(harness, trusted=True, folder=harness.home / "robots") as editor:
        editor.open(outer)
        found = await editor.having(outer, "ARG009", seconds=60)
        assert editor.covered(outer, found.range) == "s1"
        (outer.parent / "inner.launch.py").write_text(PYTHON.replace("'a1'", "'s1'"))
        editor.watched(outer.parent / "inner.launch.py")
        await editor.without(outer, "ARG009", seconds=60)


async def test_without_trust_nothing_is_run(harness: Harness, outer: Path) -> None:
    ran = harness.home / "robots" / "ran"
    inner = outer.parent / "inner.launch.py"
    made = PYTHON.replace("['a1', 's2']", "random.sample(['a1', 's2'], 2)")  # which only a run tells
    inner.write_text(f"try: open({str(ran)!r}, 'w')\nexcept OSError: pass\nimport random\n" + made)
    async with editing(harness, folder=harness.home / "robots") as editor:
        editor.open(outer)
        await editor.until(lambda: editor.rules(outer) is not None, seconds=60)
        assert "ARG009" not in (editor.rules(outer) or ())
        assert harness.sandbox_starts() == 0
        editor.trust()
        await editor.having(outer, "ARG009", seconds=60)
        assert not ran.exists()


async def test_the_function_makes_it_a_launch_file_whatever_its_name_is(harness: Harness, outer: Path) -> None:
    path, helper = outer.with_name("bringup_all.py"), outer.with_name("helper.py")
    path.write_text("def generate_launch_description():\n    raise RuntimeError('no')\n")
    helper.write_text("def generate():\n    raise RuntimeError('no')\n")
    async with editing(harness, trusted=True, folder=harness.home / "robots") as editor:
        editor.open(helper)
        editor.open(path)
        await editor.having(path, "LCH032", seconds=60)
        assert not editor.rules(helper)


async def test_beside_the_python_language_server(harness: Harness, outer: Path) -> None:
    """A Python file shows its findings and what a node comes to, and nothing of what Python's own server does."""
    path = outer.parent / "own.launch.py"
    text = (
        "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n"
        "def generate_launch_description():\n    return LaunchDescription([\n"
        "        Node(package='nowhere', executable='x', name='camera'),\n"
        "        Node(package='nowhere', node_executable='x'),\n    ])\n"
    )
    async with editing(harness, trusted=True, folder=harness.home / "robots") as editor:
        editor.open(path, text, language="python")
        found = await editor.having(path, "LCH032", seconds=60)
        assert "node_executable" in editor.covered(path, found.range)
        assert [symbol.name for symbol in await editor.symbols(path)] == ["camera", "node"]
        assert await editor.tokens(path) == []
        assert not await editor.folds(path)
        editor.change(path, text.replace("node_executable", "executable"))
        await editor.without(path, "LCH032", seconds=60)
        editor.change(path, text.replace("node_executable='x'),", "node_exec"))
        await editor.having(path, "LCH001", seconds=60)
        await editor.hover(path, editor.at(path, "Node(package"))


RUN = """import os
from launch import LaunchDescription
from launch.actions import OpaqueFunction
from launch_ros.actions import Node


def made(context):
    return [Node(package='made', executable='made', name='made')]


def generate_launch_description():
    return LaunchDescription([
        Node(package='nowhere', executable='first', name='first'),
        *[Node(package='nowhere_too', executable=name, name=name) for name in ('second', 'third')],
        OpaqueFunction(function=made),
        Node(package='elsewhere', executable='last', name='last'),
    ])
"""


def said(editor: Editor, path: Path) -> list[tuple[str, str]] | None:
    """Rule of each finding, and what it is about: known of the newest text only."""
    found = editor.diagnostics(path)
    return None if found is None else sorted((str(d.code), editor.covered(path, d.range)) for d in found)


async def test_what_the_last_good_run_said_stays_while_a_file_is_typed(harness: Harness, outer: Path) -> None:
    """What only a run tells (the nodes that a loop or a function makes) does not go when the text is edited, half typed
    or wrong: all but what it said of the part that was edited."""
    path = outer.parent / "own.launch.py"
    async with editing(harness, trusted=True, folder=harness.home / "robots") as editor:
        editor.open(path, RUN, language="python")
        packages = [("PKG001", name) for name in ("elsewhere", "made", "nowhere", "nowhere_too")]
        whole = await editor.until(lambda: (found := said(editor, path)) and found == packages and found)
        seen = len(editor.history)

        # A bracket and a quote are missing, lines above moved all the rest.
        half = RUN.replace("import os\n", "import os\nimport re\nx = ['\n")
        editor.change(path, half)
        broken = await editor.until(lambda: said(editor, path))
        assert [each for each in broken if each[0] != "LCH001"] == whole
        assert any(each[0] == "LCH001" for each in broken)

        # It parses again, and raises when it is run.
        editor.change(path, half.replace("x = ['\n", "x = undefined\n"))
        raising = await editor.having(path, "LCH032")
        assert editor.covered(path, raising.range) == "undefined"
        assert [each for each in said(editor, path) or () if each[0] != "LCH032"] == whole

        # A package is named anew: what was said of it goes at once, and nothing else.
        mended = RUN.replace("'elsewhere'", "'robots_not'")
        editor.change(path, mended)
        now = await editor.until(
            lambda: (found := said(editor, path)) is not None and ("PKG001", "robots_not") in found and found
        )
        assert [each for each in now if each[1] != "robots_not"] == [each for each in whole if each[1] != "elsewhere"]
        for told in editor.history[seen:]:
            kept = [d for d in told.diagnostics if d.code == "PKG001" and "'made'" in d.message]
            assert kept or told.uri != path.as_uri(), "it flickered"


async def test_an_edit_ends_the_run_of_the_text_before(harness: Harness, outer: Path) -> None:
    path = outer.parent / "own.launch.py"
    title = "Running parameter commands in the sandbox"
    async with editing(harness, trusted=True, folder=harness.home / "robots") as editor:
        slow = "import time\ntime.sleep(600)\n"
        editor.open(path, slow + RUN, language="python")
        (token,) = await editor.until(lambda: list(editor.progress_of(title)))
        editor.change(path, slow + RUN.replace("made", "mod"))
        await editor.until(lambda: editor.progress[token][-1]["kind"] == "end")
        assert editor.progress[token][-1]["message"] == "cancelled"
        editor.change(path, RUN)
        await editor.until(lambda: ("PKG001", "made") in (said(editor, path) or ()))
