"""Walks end, wherever links lead."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from preflight_analysis.environment import walk as walks
from preflight_analysis.environment.walk import walk


def names(top: Path) -> list[str]:
    return [os.path.relpath(folder, top) for folder, _, _ in walk(str(top))]


def test_a_link_to_a_folder_around_the_walk_is_not_followed(tmp_path: Path) -> None:
    top = tmp_path / "ws"
    (top / "src").mkdir(parents=True)
    (tmp_path / "other").mkdir()
    (top / "src" / "root").symlink_to("/")
    (top / "src" / "up").symlink_to(tmp_path)
    (top / "src" / "self").symlink_to(top)
    (top / "src" / "processes").symlink_to("/proc")
    assert names(top) == [".", "src"]


def test_a_repository_that_is_linked_is_walked(tmp_path: Path) -> None:
    (tmp_path / "repository" / "package").mkdir(parents=True)
    (tmp_path / "ws").mkdir()
    (tmp_path / "ws" / "linked").symlink_to(tmp_path / "repository")
    assert names(tmp_path / "ws") == [".", "linked", "linked/package"]


def test_links_out_of_a_walk_lead_to_some_folders_only(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr(walks, "MAX_LINKED_FOLDERS", 5)
    for number in range(20):
        (tmp_path / "large" / str(number)).mkdir(parents=True)
        (tmp_path / "ws" / "own" / str(number)).mkdir(parents=True)
    (tmp_path / "ws" / "linked").symlink_to(tmp_path / "large")
    found = names(tmp_path / "ws")
    assert sum(name.startswith("linked") for name in found) == 5
    assert sum(name.startswith("own/") for name in found) == 20
    (said,) = [record.getMessage() for record in caplog.records]
    assert "more than 5 folders outside" in said


def test_the_whole_machine_is_not_walked(caplog: pytest.LogCaptureFixture) -> None:
    found = [folder for folder, _, _ in walk("/")]
    assert len(found) <= walks.MAX_LINKED_FOLDERS
    assert not [folder for folder in found if folder.startswith(("/proc", "/sys"))]
