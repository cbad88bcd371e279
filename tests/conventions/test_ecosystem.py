"""`make ecosystem`: what counts as a change of the findings of public projects, and what is kept of them."""

from __future__ import annotations

import subprocess
from dataclasses import replace
from pathlib import Path

import pytest
from tools import ecosystem
from tools.ecosystem import DATA, Change, Entry, Project, Snapshot, compare, merged, read_findings, read_projects
from tools.ros2_python_corpus import MAX_SIZE

FOUND = Entry("TOP001", "1:1", "a.launch", 7, "'/chater' has no publisher", "warning", "likely")
GONE = replace(FOUND, severity=None, confidence=None)


def changes(before: Entry | None, after: Entry | None) -> list[Change]:
    def snapshot(entry: Entry | None) -> Snapshot:
        return Snapshot({entry.fingerprint: entry} if entry else {})

    return list(compare(snapshot(before), snapshot(after)))


def test_what_is_new_gone_or_of_another_severity_is_a_change() -> None:
    louder = replace(FOUND, severity="error")
    assert changes(FOUND, FOUND) == []
    assert changes(FOUND, replace(FOUND, message="in other words", line=9)) == []
    assert [str(each).split(" TOP001")[0] for each in changes(None, FOUND)] == ["+ warning (likely)"]
    assert [str(each).split(" TOP001")[0] for each in changes(FOUND, None)] == ["- warning (likely)"]
    assert [str(each).split(" TOP001")[0] for each in changes(FOUND, louder)] == [
        "~ warning (likely) -> error (likely)"
    ]


@pytest.mark.parametrize(
    ("before", "after", "fails"),
    [
        (replace(FOUND, verdict="true"), None, True),
        (replace(FOUND, verdict="trivial"), None, True),
        (replace(FOUND, verdict="true"), replace(FOUND, severity="info"), False),
        (replace(GONE, verdict="false"), FOUND, True),
        (replace(FOUND, verdict="false"), None, False),
        (replace(FOUND, verdict="machine"), None, False),
        (None, FOUND, False),
        (FOUND, None, False),
    ],
)
def test_a_true_one_must_not_go_and_a_false_one_not_come_back(
    before: Entry | None, after: Entry | None, fails: bool
) -> None:
    assert [each.fails for each in changes(before, after)] == [fails]


def test_what_was_judged_is_kept_with_what_is_found_and_after_it_is_gone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ecosystem, "DATA", tmp_path)
    project = Project("o/p", "c0ffee", "2")
    judged = replace(FOUND, verdict="false", reason="the bag has it")
    moved = replace(FOUND, line=9)
    ecosystem.write_findings(project, merged(Snapshot({"1:1": judged}), Snapshot({"1:1": moved}, {"TOP002": 3})))
    assert read_findings(project) == Snapshot({"1:1": replace(judged, line=9)}, {"TOP002": 3})
    ecosystem.write_findings(project, merged(read_findings(project), Snapshot()))
    assert read_findings(project).entries == {"1:1": replace(judged, line=9, severity=None, confidence=None)}
    ecosystem.write_findings(project, merged(Snapshot({"1:1": FOUND}), Snapshot()))
    assert read_findings(project) == Snapshot()


def test_a_commit_is_laid_out_with_what_is_too_large_as_an_empty_file(tmp_path: Path) -> None:
    source = tmp_path / "source"
    (source / "meshes").mkdir(parents=True)
    (source / "a.launch").write_text("<launch/>")
    (source / "run").write_text("#!/bin/sh")
    (source / "run").chmod(0o755)
    (source / "b.launch").symlink_to("a.launch")
    (source / "meshes" / "arm.dae").write_bytes(b"x" * (MAX_SIZE + 1))
    (source / ".gitignore").write_text("*.launch")
    git = ("git", "-c", "user.name=n", "-c", "user.email=e")
    for words in (["init", "--quiet"], ["add", "--all", "--force"], ["commit", "--quiet", "--message", "all"]):
        subprocess.run([*git, *words], cwd=source, check=True)
    folder = ecosystem.lay_out(source / ".git", "HEAD", tmp_path / "out" / "p")
    assert (folder / "meshes" / "arm.dae").read_bytes() == b""
    assert (folder / "b.launch").read_text() == "<launch/>"
    assert (folder / "run").stat().st_mode & 0o111
    listed = subprocess.run(["git", "ls-files"], cwd=folder, capture_output=True, check=True).stdout.decode().split()
    assert sorted(listed) == [".gitignore", "a.launch", "b.launch", "meshes/arm.dae", "run"]


def test_each_file_of_findings_is_of_a_listed_project_and_all_are_small() -> None:
    projects = read_projects()
    assert len({each.repository for each in projects}) == len(projects) >= 80
    assert sum(each.generation == "2" for each in projects) > len(projects) / 2
    files = sorted((DATA / "findings").iterdir())
    assert {path.stem for path in files} <= {each.name for each in projects}
    assert sum(path.stat().st_size for path in files) < 2_000_000
    for project in projects:
        read_findings(project)
