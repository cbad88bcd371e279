"""The map of the code names what holds each invariant, and what it names is there."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
INVARIANTS = re.findall(r"\*\*Invariant: (.*?)(?=\n\n)", (ROOT / "docs/architecture.md").read_text(), re.DOTALL)
_HOLDER = re.compile(r"`(tests/[\w/.]+|pyproject\.toml|analysis/ruff\.toml)(?:::(\w+))?`")


@pytest.mark.parametrize("invariant", INVARIANTS, ids=lambda text: text.split("**")[0][:60])
def test_an_invariant_names_what_holds_it(invariant: str) -> None:
    named = _HOLDER.findall(invariant)
    assert named
    for path, name in named:
        assert (ROOT / path).exists(), path
        assert not name or re.search(rf"def {name}\(", (ROOT / path).read_text()), name


def test_there_are_invariants() -> None:
    assert len(INVARIANTS) > 10
