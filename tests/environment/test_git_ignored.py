"""What `.gitignore` leaves out."""

from pathlib import Path

import pytest
from preflight_analysis.environment.git_ignored import is_ignored
from support.open_buffers import disk_with


@pytest.mark.parametrize(
    ("patterns", "path"),
    [
        ("robot.urdf", "/w/p/urdf/robot.urdf"),
        ("*.urdf", "/w/p/urdf/robot.urdf"),
        ("urdf/", "/w/p/urdf/robot.urdf"),
        ("p/urdf/*", "/w/p/urdf/robot.urdf"),
        ("/p", "/w/p/urdf/robot.urdf"),
        ("**/robot.*", "/w/p/urdf/robot.urdf"),
        ("# made\n\n!robot.urdf\n  robot.urdf  ", "/w/p/urdf/robot.urdf"),
    ],
)
def test_a_file_that_is_left_out(patterns: str, path: str) -> None:
    assert is_ignored(disk_with({"/w/.gitignore": patterns}), path)


@pytest.mark.parametrize(
    ("patterns", "path"),
    [
        ("", "/w/p/urdf/robot.urdf"),
        ("# robot.urdf", "/w/p/urdf/robot.urdf"),
        ("robot.urdf/", "/w/p/urdf/robot.urdf"),
        ("/urdf", "/w/p/urdf/robot.urdf"),
        ("urdf/*", "/w/p/urdf/robot.urdf"),
        ("*.urdf\n!robot.urdf", "/w/p/urdf/robot.urdf"),
        ("p/urdf/robot.urdf/more", "/w/p/urdf/robot.urdf"),
    ],
)
def test_a_file_that_is_kept(patterns: str, path: str) -> None:
    assert not is_ignored(disk_with({"/w/.gitignore": patterns}), path)


@pytest.mark.parametrize(
    ("patterns", "is_left_out"),
    [("/p/maps/*", True), ("p/maps/**", True), ("maps/", True), ("maps", True), ("maps/*.pgm", False)],
)
def test_a_folder_of_which_all_is_left_out(patterns: str, is_left_out: bool) -> None:
    assert is_ignored(disk_with({"/w/.gitignore": patterns}), "/w/p/maps", as_folder=True) == is_left_out


def test_the_nearest_file_that_speaks_of_it_counts_and_nothing_above_the_repository(tmp_path: Path) -> None:
    kept = {"/w/.gitignore": "*.urdf", "/w/p/.gitignore": "!robot.urdf"}
    assert not is_ignored(disk_with(kept), "/w/p/robot.urdf")
    assert is_ignored(disk_with(kept), "/w/p/arm.urdf")
    (tmp_path / "p" / ".git").mkdir(parents=True)
    disk = disk_with({tmp_path / ".gitignore": "*.urdf"})
    assert not is_ignored(disk, str(tmp_path / "p" / "arm.urdf"))
    assert is_ignored(disk, str(tmp_path / "arm.urdf"))
