"""Whatever is edited, what is remembered equals a fresh look at the same texts."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.packages import find_packages
from tools import random_edits

FIXTURES = Path(__file__).parents[2] / "fixtures"
ROBOT, CHAPTER = FIXTURES / "ros1" / "robot", FIXTURES / "ros2" / "chapter"


@pytest.mark.slow
@pytest.mark.parametrize("seed", [3, 4, 15, 16, 20, 21])
def test_random_edits_leave_nothing_behind(seed: int) -> None:
    packages = find_packages([str(ROBOT)]).packages
    assert random_edits.run(ROBOT, packages, seed, 400) == 400


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
def test_random_edits_of_ros2(seed: int) -> None:
    packages = find_packages([str(CHAPTER)]).packages
    assert random_edits.run(CHAPTER, packages, seed, 300, generation=2) == 300


def test_a_workspace_that_does_not_look_again_is_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Disk, "look", lambda *_: False)
    with pytest.raises(random_edits.Broken, match="seed 3"):
        random_edits.run(ROBOT, find_packages([str(ROBOT)]).packages, 3, 100)
