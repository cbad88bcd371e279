"""The map of the code names what holds each invariant, and what it names is there."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs/architecture.md").read_text()
INVARIANTS = re.findall(r"\*\*Invariant: (.*?)(?=\n\n)", PAGE, re.DOTALL)
_FOLDERS = ("analysis", "server", "tests", "docs", "bench", "packaging", "vscode-client/src")
_NAMED = re.compile(r"`([\w./-]+\.(?:py|cpp|hpp|lua|ts|md))")
_HOLDER = re.compile(r"`(tests/[\w/.]+|pyproject\.toml|analysis/ruff\.toml)(?:::(\w+))?`")


@pytest.mark.parametrize("invariant", INVARIANTS, ids=lambda text: text.split("**")[0][:60])
def test_an_invariant_names_what_holds_it(invariant: str) -> None:
    named = _HOLDER.findall(invariant)
    assert named
    for path, name in named:
        assert (ROOT / path).exists(), path
        assert not name or re.search(rf"def {name}\(", (ROOT / path).read_text()), name


def test_what_the_page_names_is_there() -> None:
    named = {name for name in _NAMED.findall(PAGE) if not name.startswith("bench/out/")}
    assert len(named) > 100
    there = [f"/{path.relative_to(ROOT).as_posix()}" for folder in _FOLDERS for path in (ROOT / folder).rglob("*.*")]
    assert sorted(name for name in named if not any(path.endswith(f"/{name}") for path in there)) == []


def test_there_are_invariants() -> None:
    assert len(INVARIANTS) > 10
