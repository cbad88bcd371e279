"""An error of ours costs no more than its own findings, and the user hears of it once."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import pytest
from support.editor_harness import Harness
from support.lsp_client import editing

SERVER = """#!{python}
import importlib, sys
from dataclasses import replace
from preflight_analysis.rules import registry
def broken(rule, context):
    raise RuntimeError("a bug")
rules = tuple(replace(r, check=broken) if r.id in ("LCH004", "TOP001") else r for r in registry.all_rules())
registry.all_rules = lambda: rules
from preflight_server.cli.main import main
sys.exit(main())
"""
TEXT = '<launch><nod/><param name="x" value="$(arg y)"/></launch>\n'


@pytest.fixture
def broken(harness: Harness, tmp_path: Path) -> Harness:
    """With a server of which two rules raise."""
    server = tmp_path / "broken" / harness.server.name
    server.parent.mkdir()
    server.write_text(SERVER.format(python=sys.executable))
    server.chmod(0o755)
    return replace(harness, server=server)


async def test_one_message_for_each_rule(broken: Harness) -> None:
    async with editing(broken) as editor:
        first, second = broken.workspace / "a.launch", broken.workspace / "b.launch"
        for path in (first, second):
            editor.open(path, TEXT)
            await editor.having(path, "ARG001")
        editor.change(first, TEXT + "<!-- -->\n")
        await editor.until(lambda: len(editor.messages) >= 2)
        await editor.having(first, "ARG001")
        await editor.hover(second, editor.diagnostics(second)[0].range.start)  # type: ignore[index]
        rules = [message.split()[2] for message in editor.messages]
        assert sorted(rules) == ["LCH004", "TOP001"]
        assert all("RuntimeError: a bug" in message and "please report" in message for message in editor.messages)
