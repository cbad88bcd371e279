"""What conditions leave out, in an editor: looked at while nobody types."""

from __future__ import annotations

import pytest
from support.editor_harness import Harness
from support.lsp_client import editing

pytestmark = pytest.mark.ros

TEXT = """<launch>
  <arg name="sim" default="false"/>
  <include if="$(arg sim)" file="/none.launch"/>
  <param name="a" value="1"/>
</launch>
"""


async def test_it_is_said_stays_through_edits_and_goes_with_its_cause(harness: Harness) -> None:
    path = harness.workspace / "sim.launch"
    path.write_text(TEXT)
    async with editing(harness) as editor:
        editor.open(path)
        found = await editor.having(path, "LCH013")
        assert found.message == "included file '/none.launch' does not exist (if sim:=true)"
        editor.change(path, TEXT.replace("<launch>\n", "<launch>\n\n\n"))
        found = await editor.having(path, "LCH013")
        assert editor.covered(path, found.range) == "/none.launch"
        editor.change(path, TEXT.replace("/none.launch", str(harness.launch_file)))
        await editor.without(path, "LCH013")


async def test_what_is_not_saved_counts_in_what_only_a_condition_includes(harness: Harness) -> None:
    path, inner = harness.workspace / "sim.launch", harness.workspace / "inner.launch"
    path.write_text(TEXT.replace("/none.launch", str(inner)))
    inner.write_text("<launch/>\n")
    async with editing(harness) as editor:
        editor.open(path)
        editor.open(inner)
        editor.change(inner, '<launch>\n  <arg name="b"/>\n  <param name="b" value="$(arg b)"/>\n</launch>\n')
        assert "(if sim:=true)" in (await editor.having(path, "ARG002")).message
        editor.change(inner, "<launch/>\n")
        await editor.without(path, "ARG002")


PYTHON = """import os
import sys
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
sys.path.insert(0, os.path.dirname(__file__))
from models import MODELS


def generate_launch_description():
    return LaunchDescription([DeclareLaunchArgument('model', choices=MODELS)])
"""
INCLUDES = """<launch>
  <arg name="sim" default="false"/>
  <include if="$(var sim)" file="$(dirname)/inner.launch.py">
    <arg name="model" value="s1"/>
  </include>
</launch>
"""


@pytest.mark.parametrize(
    ("condition", "shown"), [("$(var sim)", "sim:=true"), ("$(eval &quot;len('$(var sim)') &gt; 9&quot;)", "$(eval ")]
)
async def test_python_launch_files_that_only_a_branch_includes_are_run(
    harness: Harness, condition: str, shown: str
) -> None:
    folder = harness.home / "robots" / "launch"
    folder.mkdir(parents=True)
    ran, models, path = folder / "ran", folder / "models.py", folder / "outer.launch.xml"
    tries = f"try: open({str(ran)!r}, 'w')\nexcept OSError: pass\n"
    (folder / "inner.launch.py").write_text(tries + PYTHON)
    models.write_text("MODELS = ['a1', 's2']\n")
    includes = INCLUDES.replace("$(var sim)", condition)
    path.write_text(includes)
    async with editing(harness, folder=harness.home / "robots") as editor:
        editor.open(path)
        editor.change(
            path, includes.replace("<launch>\n", '<launch>\n  <include if="$(var sim)" file="/none.launch"/>\n')
        )
        await editor.having(path, "LCH013")
        assert harness.sandbox_starts() == 0, "nothing is run without trust"
        editor.trust()
        found = await editor.having(path, "ARG009", seconds=60)
        assert f"(if {shown}" in found.message
        assert editor.covered(path, found.range) == "s1"
        models.write_text("MODELS = ['s1', 's2']\n")
        editor.watched(models)
        await editor.without(path, "ARG009", seconds=60)
        assert not ran.exists()
