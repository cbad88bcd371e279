"""Where the project is and how to install it is written in one place, and the same in every file that says so."""

from __future__ import annotations

import re
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest
from support.packaging_scripts import script
from trove_classifiers import classifiers

ROOT = Path(__file__).resolve().parents[2]
FROM_AN_INDEX = re.compile(
    r"(?:pipx install|pip install(?: -\S+)*|uv tool install|uvx|npx|code --install-extension) ros-preflight\b"
)

apply = script("apply")
KNOWN = apply.project()
NOW = {path.relative_to(ROOT).as_posix(): (was, now) for path, was, now in apply.written(KNOWN)}


@pytest.mark.parametrize("name", NOW)
def test_a_file_is_as_the_project_is(name: str) -> None:
    was, now = NOW[name]
    assert was == now, "make docs"


def test_texts_for_a_release_name_the_package() -> None:
    released = replace(KNOWN, version="7.8.9", repository="https://github.com/someone/ros-preflight", published=True)
    texts = {path.relative_to(ROOT).as_posix(): text for path, _, text in apply.written(released)}
    for name in ("README.md", "docs/start/install.md", "vscode-client/src/serverSession.ts"):
        assert "pipx install ros-preflight" in texts[name]
        assert "clone" not in re.split("how to install: (?:begin|end)", texts[name])[1]
    assert "pipx install ros-preflight" in texts["server/neovim/lua/ros_preflight/client.lua"]
    assert "uses: someone/ros-preflight@v7.8.9" in texts["docs/ci.md"]
    assert "rev: v7.8.9" in texts["docs/ci.md"]
    assert '"version": "7.8.9"' in texts["vscode-client/package.json"]
    assert all("OWNER/" not in text for text in texts.values())


def tracked() -> list[str]:
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True)
    return [name for name in listed.stdout.split("\0") if name and (ROOT / name).is_file()]


def test_the_placeholder_of_the_address_stands_where_it_is_replaced() -> None:
    pattern = re.compile(r"OWNER/ros-preflight")
    own = ("packaging/project.toml", "tests/docs/test_advice.py")
    found = {
        name
        for name in tracked()
        if not name.startswith("fixtures/") and pattern.search((ROOT / name).read_text(errors="ignore"))
    }
    assert found - {*own} <= NOW.keys()


def test_nothing_names_a_package_that_is_not_there() -> None:
    advising = [
        name
        for name in tracked()
        if name.endswith((".md", ".ts", ".lua", ".yml", ".yaml", ".json", ".py"))
        and not name.startswith(("fixtures/", "tests/", "packaging/"))
    ]
    assert "README.md" in advising
    assert KNOWN.published or [name for name in advising if FROM_AN_INDEX.search((ROOT / name).read_text())] == []


def test_the_classifiers_are_those_of_the_index() -> None:
    lines = (ROOT / "pyproject.toml").read_text().partition("classifiers = [")[2].partition("]")[0]
    named = re.findall(r'"([^"]+)"', lines)
    assert len(named) > 5
    assert set(named) <= classifiers
