"""What is found in the files that say how a package is built, open without any launch file."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.editor_harness import Harness
from support.lsp_client import Editor, capabilities, editing
from support.packaging import CFG, CMAKE, LISTS, PYTHON, SETUP, lay_out

pytestmark = pytest.mark.ros
MISSING = LISTS.replace("DIRECTORY launch", "DIRECTORY lanch")
MISSPELT = SETUP.replace("arm.driver:main", "arm.drivr:main")


@pytest.mark.parametrize(
    ("files", "name", "text", "rule"),
    [
        (PYTHON, "setup.py", MISSPELT, "PKG010"),
        (PYTHON, "setup.cfg", CFG.replace("scripts=$base/lib/arm", "scripts=$base/lib/leg"), "PKG011"),
        (
            {**CMAKE, "launch/notes.txt": ""},
            "CMakeLists.txt",
            MISSING,
            "PKG012",
        ),
    ],
)
async def test_of_a_file_that_is_opened_alone(
    harness: Harness, files: dict[str, str], name: str, text: str, rule: str
) -> None:
    folder = harness.home / "arms"
    path = lay_out(folder, {**files, "launch/arm.launch.xml": None, name: text}) / name
    async with editing(harness, folder=folder) as editor:
        editor.open(path, language="plaintext")
        await editor.having(path, rule)
        await _edited(editor, path, files[name], text, rule)
        editor.close(path)
        await editor.without(path, rule)


async def _edited(editor: Editor, path: Path, right: str, wrong: str, rule: str) -> None:
    editor.change(path, right)
    await editor.without(path, rule)
    editor.change(path, wrong)
    await editor.having(path, rule)
    editor.change(path, f"# preflight: ignore[{rule}]\n{right}")
    await editor.having(path, "LCH019")
    editor.change(path, wrong)
    await editor.having(path, rule)


async def test_of_no_folder(harness: Harness) -> None:
    path = lay_out(harness.home / "arms", {**PYTHON, "setup.py": MISSPELT}) / "setup.py"
    async with editing(harness, without_folder=True) as editor:
        editor.open(path, language="python")
        await editor.having(path, "PKG010")


async def test_once_with_an_open_launch_file(harness: Harness) -> None:
    folder = harness.home / "arms"
    package = lay_out(folder, {**PYTHON, "setup.py": MISSPELT})
    path, launch = package / "setup.py", package / "launch/arm.launch.xml"
    async with editing(harness, folder=folder) as editor:
        editor.open(launch)
        await editor.having(path, "PKG010")
        editor.open(path, language="python")
        assert await editor.until(lambda: editor.rules(path)) == ["PKG010"]


async def test_a_client_that_pulls(harness: Harness) -> None:
    folder = harness.home / "arms"
    path = lay_out(folder, {**PYTHON, "setup.py": MISSPELT, "launch/arm.launch.xml": None}) / "setup.py"
    async with editing(harness, folder=folder, client=capabilities(pull=True)) as editor:
        editor.open(path, language="python")
        await editor.once(lambda: editor.pull(path), lambda found: [each.code for each in found] == ["PKG010"])
        editor.change(path, SETUP)
        await editor.once(lambda: editor.pull(path), lambda found: found == [])
