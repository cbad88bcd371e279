"""Work that reads several files sees them as they are at one time."""

from __future__ import annotations

import os
import threading
from pathlib import Path

from preflight_analysis.documents.document import Document
from preflight_analysis.workspace.sources import Sources

PATIENCE = 20.0


def read(sources: Sources, path: Path) -> str:
    found = sources.text(str(path))
    assert isinstance(found, Document)
    return found.text


def replaced(path: Path, text: str) -> None:
    new = path.with_suffix(".new")
    new.write_text(text)
    os.replace(new, path)


def test_a_file_that_changes_on_the_disk_meanwhile_is_read_again(tmp_path: Path) -> None:
    path, seen = tmp_path / "a.yaml", []
    path.write_text("old")
    sources = Sources()

    def work() -> str:
        seen.append(read(sources, path))
        if len(seen) == 1:
            replaced(path, "new")
            seen.append(read(sources, path))
        return seen[-1]

    assert sources.in_one_revision(work, lambda _: [str(path)], likely=()) == "new"
    assert seen == ["old", "old", "new"]


def test_a_file_that_changed_before_is_read_as_it_is(tmp_path: Path) -> None:
    path, runs = tmp_path / "a.yaml", []
    path.write_text("old")
    sources = Sources()
    assert read(sources, path) == "old"
    replaced(path, "new")

    def work() -> str:
        runs.append(1)
        return read(sources, path)

    assert sources.in_one_revision(work, lambda _: [str(path)], likely=[str(path)]) == "new"
    assert len(runs) == 1


def test_a_file_that_is_written_all_the_time_has_an_end(tmp_path: Path) -> None:
    path, runs = tmp_path / "a.yaml", []
    path.write_text("0")
    sources = Sources()

    def work() -> str:
        runs.append(1)
        found = read(sources, path)
        replaced(path, f"{len(runs)}")
        return found

    assert sources.in_one_revision(work, lambda _: [str(path)], likely=()) in "0123"
    assert len(runs) < 10


def test_an_edit_meanwhile_begins_it_again(tmp_path: Path) -> None:
    first, second = str(tmp_path / "a.yaml"), str(tmp_path / "b.yaml")
    sources = Sources()
    sources.open(first, "one")
    sources.open(second, "one")
    begun: list[threading.Thread] = []

    def edit() -> None:
        sources.open(first, "two")
        sources.open(second, "two")

    def work() -> tuple[str, str]:
        found = read(sources, Path(first))
        if not begun:
            begun.append(threading.Thread(target=edit))
            begun[0].start()
            while not sources.db._writers:
                pass
        return found, read(sources, Path(second))

    pauses: list[bool] = []
    found = sources.in_one_revision(
        work, lambda _: [first, second], likely=(), pause=lambda: pauses.append(sources.db.is_reading)
    )
    begun[0].join(PATIENCE)
    assert pauses and not any(pauses), "who edits does not wait for it"
    assert found in (("two", "one"), ("two", "two"))
