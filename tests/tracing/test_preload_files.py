"""The libraries for nodes in C++ are known by all that they are compiled of."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from preflight_analysis.tracing.preload_compile import WATCHED, Watched


def included(file: Path) -> set[Path]:
    """The file and what it includes of ours, near and far."""
    found = {file}
    for name in re.findall(r'^#include "(.+)"$', file.read_text(), flags=re.MULTILINE):
        found |= included((file.parent / name).resolve())
    return found


@pytest.mark.parametrize("watched", WATCHED, ids=lambda watched: watched.name)
def test_its_files_are_what_it_includes(watched: Watched) -> None:
    assert set(watched.files) == included(watched.source)
    assert len(watched.files) > 3
