"""Sockets of the host that would be seen inside, whatever the kernel calls them."""

from __future__ import annotations

import os
import socket
from collections.abc import Iterator
from pathlib import Path

import pytest
from preflight_analysis.tracing import sockets


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """An empty one, which is the working directory."""
    monkeypatch.chdir(tmp_path)
    sockets._lying_around.cache_clear()
    yield tmp_path
    sockets._lying_around.cache_clear()


def bound(name: str) -> socket.socket:
    listening = socket.socket(socket.AF_UNIX)
    listening.bind(name)
    listening.listen()
    return listening


def test_whatever_became_of_its_name_a_socket_is_found(folder: Path) -> None:
    (folder / "sub").mkdir()
    kept = [bound(f"{folder}/{name}") for name in ("renamed", "linked", "moved", "line\nbreak", "as it was")]
    kept.append(bound("relative"))
    os.rename("renamed", "other")
    os.link("linked", "sub/twin")
    os.rename("moved", "sub/moved")
    names = ["as it was", "line\nbreak", "linked", "other", "relative", "sub/moved", "sub/twin"]
    assert sockets.reachable([str(folder)], [str(folder.parent)]) == [f"{folder}/{name}" for name in names]
    for each in kept:
        each.close()


def test_it_is_found_again_when_it_is_renamed_after_the_look(folder: Path) -> None:
    with bound(f"{folder}/a"):
        assert sockets.reachable([str(folder)], [str(folder.parent)]) == [f"{folder}/a"]
        os.rename("a", "b")
        assert sockets.reachable([str(folder)], [str(folder.parent)]) == [f"{folder}/b"]
        os.link("b", "c")
        with bound(f"{folder}/a"):
            names = sockets.reachable([str(folder)], [str(folder.parent)])
    assert names == [f"{folder}/{name}" for name in "abc"]


def test_outside_of_the_masks_it_is_looked_for_where_it_was_bound(folder: Path) -> None:
    with bound(f"{folder}/a"):
        os.rename("a", "b")
        assert f"{folder}/b" in sockets.reachable([], [])
        assert f"{folder}/b" not in sockets.reachable([], [str(folder)])


def test_other_files_and_links_are_left_alone(folder: Path) -> None:
    os.mkfifo("pipe")
    (folder / "file").touch()
    (folder / "loop").symlink_to(folder)
    (folder / "nowhere").symlink_to("missing")
    with bound(f"{folder}/a"):
        (folder / "link").symlink_to("a")
        assert sockets.reachable([str(folder)], [str(folder.parent)]) == [f"{folder}/a"]


def test_the_look_has_an_end(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The outermost first."""
    monkeypatch.setattr(sockets, "MOST_FOLDERS", 3)
    deep = folder
    for _ in range(5):
        deep = deep / "d"
        deep.mkdir()
        os.mknod(deep / "s", 0o140600)
    found = sockets.reachable([str(folder)], [str(folder.parent)])
    assert found == [f"{folder}/{'d/' * depth}s" for depth in (3, 2, 1)]
