"""How to install the server is said in one way, the one that works."""

from __future__ import annotations

from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
CLIENTS = ("vscode-client/src/serverSession.ts", "server/neovim/lua/ros_preflight/client.lua")


def advice() -> str:
    """The commands at the start of "Use it" of the README, on one line."""
    _, _, use = (ROOT / "README.md").read_text().partition("## Use it\n")
    lines = [line.strip() for line in use.splitlines() if line.startswith("    ")]
    return " && ".join(lines[:2])


@pytest.mark.parametrize("client", CLIENTS)
def test_editors_advise_what_the_readme_says(client: str) -> None:
    assert advice().startswith("python3 -m venv")
    text = (ROOT / client).read_text()
    assert text.count(advice()) == 1
    assert "pipx" not in text, "there is no such package on PyPI"
