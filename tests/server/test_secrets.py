"""Secrets reach neither editors nor agents; what lies outside of a workspace needs trust."""

from __future__ import annotations

from pathlib import Path

import pytest
from mcp import Client, StdioServerParameters
from support.editor_harness import Harness
from support.hostile_secrets import CANARY, FORMATS, VARIABLES, write_launch_files, write_secrets
from support.lsp_client import editing

pytestmark = pytest.mark.ros
LANGUAGES = {".launch": "roslaunch", ".xml": "xml", ".yaml": "yaml", ".py": "python"}
OUTSIDE = '<launch><param name="license" textfile="{}"/></launch>'


@pytest.fixture
def hostile(harness: Harness) -> dict[str, Path]:
    """The launch files by their names."""
    package = harness.workspace / "hostile"
    paths = write_secrets(harness.home, package)
    harness.environment.update(VARIABLES)
    return {path.name: path for path in write_launch_files(package, paths, ("hostile", "spy"))}


@pytest.mark.parametrize("name", FORMATS)
async def test_an_editor_is_told_no_secret(harness: Harness, hostile: dict[str, Path], name: str) -> None:
    path = hostile[name]
    async with editing(harness, trusted=True) as editor:
        text = editor.open(path, language=LANGUAGES[path.suffix])
        found = await editor.having(path, "LCH045")
        assert "ROS_PREFLIGHT_ALLOW_SECRETS allows it" in found.message
        words = [*VARIABLES, "/.ssh/robot", "/.netrc", "/.env"]
        hovers = [await editor.hover(path, editor.at(path, word)) for word in words if word in text]
        hints = await editor.hints(path)
        said = f"{editor.published} {hovers} {hints} {editor.messages}"
        assert CANARY not in said
    caches = [each for each in (harness.home / ".cache").rglob("*") if each.is_file()]
    assert caches
    assert not [each for each in caches if CANARY.encode() in each.read_bytes()]


async def test_a_file_outside_of_the_workspace_needs_trust(harness: Harness) -> None:
    outside = harness.home / "license.txt"
    outside.write_text("ordinary text")
    path = harness.write("outside.launch", OUTSIDE.format(outside))
    async with editing(harness) as editor:
        editor.open(path)
        found = await editor.having(path, "LCH045")
        assert "outside of the workspace" in found.message
        editor.trust()
        await editor.without(path, "LCH045")
        editor.trust(False)
        await editor.having(path, "LCH045")


async def test_an_agent_is_told_no_secret(harness: Harness, hostile: dict[str, Path]) -> None:
    outside = harness.home / "license.txt"
    outside.write_text(f"ordinary {CANARY}")
    hostile["outside.launch"] = harness.write("outside.launch", OUTSIDE.format(outside))
    parameters = StdioServerParameters(
        command=str(harness.server), args=["mcp", str(harness.workspace)], env=dict(harness.environment)
    )
    async with Client(parameters, read_timeout_seconds=120) as client:
        for path in hostile.values():
            file = str(path.relative_to(harness.workspace))
            for tool, given in (("check", {"files": [file]}), ("tree", {"file": file}), ("graph", {"file": file})):
                result = await client.call_tool(tool, given)
                assert not result.is_error
                assert CANARY not in f"{result.content} {result.structured_content}"
                if tool == "check":
                    assert "LCH045" in f"{result.content} {result.structured_content}"
