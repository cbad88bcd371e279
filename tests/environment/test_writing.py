"""Files are written whole or not at all, and not through a link of a project that leads out of it."""

from __future__ import annotations

import os
import stat
from pathlib import Path

import pytest
from preflight_analysis.environment.writing import write_file


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A git repository, and a file of the user's beside it."""
    (tmp_path / "home").mkdir()
    (tmp_path / "home/.bashrc").write_text("export A=1\n")
    (tmp_path / "project/.git").mkdir(parents=True)
    (tmp_path / "project/src").mkdir()
    return tmp_path / "project"


def names(folder: Path) -> list[str]:
    return sorted(each.name for each in folder.iterdir())


def test_a_file_is_replaced_and_keeps_its_mode(project: Path) -> None:
    file = project / "out.yaml"
    file.write_text("old")
    file.chmod(0o640)
    other = project / "hard"
    other.hardlink_to(file)
    write_file(file, b"new")
    assert (file.read_text(), stat.S_IMODE(file.stat().st_mode)) == ("new", 0o640)
    assert other.read_text() == "old", "another name of the file is not written through"
    assert names(project) == [".git", "hard", "out.yaml", "src"]


def test_a_new_file_has_the_usual_mode_and_its_folders(project: Path) -> None:
    plain = project / "plain"
    plain.touch()
    write_file(project / "a/b/out.yaml", b"new")
    assert (project / "a/b/out.yaml").stat().st_mode == plain.stat().st_mode


@pytest.mark.parametrize(
    ("link", "target", "written"),
    [
        ("out.yaml", "../home/.bashrc", "out.yaml"),
        ("out.yaml", "../home/new", "out.yaml"),
        ("out", "../home", "out/.bashrc"),
        ("out", "../home", "out/deep/er.yaml"),
        ("out", "src/../../home", "out/.bashrc"),
        ("out", "/", "out/etc/ros-preflight-test"),
        ("out", "..", "out/project-2/file"),
    ],
)
def test_a_link_of_the_project_does_not_lead_out_of_it(project: Path, link: str, target: str, written: str) -> None:
    (project / link).symlink_to(target)
    before = {path: path.read_bytes() for path in project.parent.rglob("*") if path.is_file()}
    with pytest.raises(OSError, match="is a link that leads out of the project, to /"):
        write_file(project / written, b"new")
    assert {path: path.read_bytes() for path in project.parent.rglob("*") if path.is_file()} == before


def test_another_project_behind_a_link_is_another_project(project: Path) -> None:
    (project.parent / "home/.git").mkdir()
    (project / "out").symlink_to("../home")
    with pytest.raises(OSError, match="leads out of the project"):
        write_file(project / "out/.bashrc", b"new")


def test_a_link_within_the_project_stays(project: Path) -> None:
    (project / "src/real.launch").write_text("old")
    (project / "install").symlink_to("src")
    (project / "src/again.launch").symlink_to("real.launch")
    write_file(project / "install/again.launch", b"new")
    assert (project / "src/real.launch").read_text() == "new"
    assert (project / "src/again.launch").is_symlink()


def test_a_link_of_the_user_s_own_is_followed(project: Path) -> None:
    (project.parent / "home/work").symlink_to(project)
    write_file(project.parent / "home/work/out.yaml", b"new")
    assert (project / "out.yaml").read_text() == "new"


def test_a_pipe_is_written_to(project: Path) -> None:
    read, write = os.pipe()
    write_file(f"/dev/fd/{write}", b"new")
    assert os.read(read, 10) == b"new"
    os.close(read)
    os.close(write)


def test_nothing_is_left_where_it_fails(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = project / "out.yaml"
    file.write_text("old")

    def fails(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", fails)
    with pytest.raises(OSError, match="No space left"):
        write_file(file, b"new")
    assert file.read_text() == "old"
    assert names(project) == [".git", "out.yaml", "src"]


def test_a_folder_is_not_a_file(project: Path) -> None:
    with pytest.raises(IsADirectoryError):
        write_file(project / "src", b"new")
