"""Python launch files in the editor: run in the background with trust only, round after round."""

from __future__ import annotations

from pathlib import Path

import pytest
from editor_desk import Desk
from lsp_desk import editing

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
def outer(desk: Desk) -> Path:
    """An XML file that includes a Python file whose function declares the argument."""
    folder = desk.home / "robots" / "launch"
    folder.mkdir(parents=True)
    (folder / "inner.launch.py").write_text(PYTHON)
    path = folder / "outer.launch.xml"
    path.write_text(XML)
    return path


async def test_what_a_function_declares_is_known_in_the_file_that_includes_it(desk: Desk, outer: Path) -> None:
    async with editing(desk, trusted=True, folder=desk.home / "robots") as editor:
        editor.open(outer)
        found = await editor.having(outer, "ARG009", seconds=60)
        assert editor.covered(outer, found.range) == "s1"
        (outer.parent / "inner.launch.py").write_text(PYTHON.replace("'a1'", "'s1'"))
        editor.watched(outer.parent / "inner.launch.py")
        await editor.without(outer, "ARG009", seconds=60)


async def test_without_trust_nothing_is_run(desk: Desk, outer: Path) -> None:
    ran = desk.home / "robots" / "ran"
    inner = outer.parent / "inner.launch.py"
    inner.write_text(f"try: open({str(ran)!r}, 'w')\nexcept OSError: pass\n" + PYTHON)
    async with editing(desk, folder=desk.home / "robots") as editor:
        editor.open(outer)
        await editor.until(lambda: editor.rules(outer) is not None, seconds=60)
        assert "ARG009" not in (editor.rules(outer) or ())
        assert desk.sandbox_starts() == 0
        editor.trust()
        await editor.having(outer, "ARG009", seconds=60)
        assert not ran.exists()


async def test_beside_the_python_language_server(desk: Desk, outer: Path) -> None:
    """A Python file shows its findings and what a node comes to, and nothing of what Python's own server does."""
    path = outer.parent / "own.launch.py"
    text = (
        "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n"
        "def generate_launch_description():\n    return LaunchDescription([\n"
        "        Node(package='nowhere', executable='x', name='camera'),\n"
        "        Node(package='nowhere', node_executable='x'),\n    ])\n"
    )
    async with editing(desk, trusted=True, folder=desk.home / "robots") as editor:
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
