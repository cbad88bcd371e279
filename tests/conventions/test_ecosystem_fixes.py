"""`make ecosystem FIXES=1`: what is taken for the mistake that a commit fixes, and what counts as lost."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from tools import ecosystem_fixes
from tools.ecosystem import Entry, Options
from tools.ecosystem_fixes import NOTHING, Fix, goes_away, gone, is_lost, read_fixes, worst, write_fixes

FOUND = Entry("PRM001", "1:1", "src/p/a.launch", 7, "'/a/x' is not read; 2 others are", "warning", "likely")
FIX = Fix(
    "o/p", "1", "c0", "fe", "a.launch", "parameter", "x for y", "yes", "f00d", "2026-11-28", "warning PRM001", "yes"
)


def test_what_moved_or_counts_otherwise_is_not_gone() -> None:
    places = {"src/p/a.launch"}
    assert list(gone([FOUND], [], places)) == [FOUND]
    assert list(gone([FOUND], [replace(FOUND, line=9)], places)) == []
    assert (
        list(gone([FOUND], [replace(FOUND, fingerprint="2:1", message="'/a/x' is not read; 3 others are")], places))
        == []
    )
    other = replace(FOUND, fingerprint="2:1", message="'/a/y' is not read; 2 others are")
    assert list(gone([FOUND], [other], places)) == [FOUND]


def test_another_mistake_at_the_same_place_is_another_finding() -> None:
    assert list(gone([FOUND], [replace(FOUND, message="'/b' does not exist")], {"."})) == [FOUND]


def test_one_of_two_alike_is_gone() -> None:
    second = replace(FOUND, fingerprint="2:1", line=9)
    assert list(gone([FOUND, second], [replace(FOUND, fingerprint="3:1")], {"."})) == [second]


@pytest.mark.parametrize(
    ("places", "there"),
    [({"src"}, True), ({"src/p"}, True), ({"."}, True), ({"src/p/a"}, False), ({""}, False), ({"b.launch"}, False)],
)
def test_only_what_is_in_the_files_counts(places: set[str], there: bool) -> None:
    assert bool(list(gone([FOUND], [], places))) == there


def test_the_worst_is_recorded_with_its_rules() -> None:
    assert worst([]) == NOTHING
    assert worst([replace(FOUND, severity="hint")]) == "hint PRM001"
    assert worst([FOUND, replace(FOUND, rule="LCH001"), replace(FOUND, severity="info")]) == "warning LCH001 PRM001"


@pytest.mark.parametrize(
    ("before", "after", "lost"),
    [
        ("warning PRM001", NOTHING, True),
        ("info PRM001", "hint PRM001", True),
        ("error PRM001", "info PRM002", False),
        ("hint PRM001", NOTHING, False),
        (NOTHING, "error PRM001", False),
        ("", NOTHING, False),
    ],
)
def test_what_was_found_must_be_found(before: str, after: str, lost: bool) -> None:
    assert is_lost(FIX._replace(found=before), FIX._replace(found=after)) == lost


def test_what_was_read_is_of_what_was_found_then() -> None:
    assert FIX.with_found("warning PRM001", "beef", "2026-11-29").mistake == "yes"
    assert FIX.with_found("info PRM001", "beef", "2026-11-29").mistake == ""


def test_a_finding_of_another_cause_is_not_the_mistake() -> None:
    other = FIX._replace(mistake="no")
    assert other.severity == NOTHING
    assert not is_lost(other, other.with_found(NOTHING, "beef", "2026-11-29"))


def test_the_list_is_written_as_it_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    listed = read_fixes()
    assert len({(each.repository, each.fixed) for each in listed}) == len(listed)
    assert {each.visible for each in listed} <= {"yes", "no"}
    assert {each.mistake for each in listed} <= {"yes", "no", ""}
    known = ("error", "warning", "info", "hint", NOTHING, "")
    assert {each.severity for each in listed} <= set(known)
    kept = (ecosystem_fixes.DATA / "fixes.tsv").read_bytes()
    monkeypatch.setattr(ecosystem_fixes, "DATA", tmp_path)
    write_fixes(listed)
    assert (tmp_path / "fixes.tsv").read_bytes() == kept


def test_what_goes_away_with_a_fix_is_found(tmp_path: Path) -> None:
    source = tmp_path / "sources" / "o+p" / "repo"
    source.mkdir(parents=True)
    (source / "package.xml").write_text("<package><name>p</name></package>")
    git = ("git", "-c", "user.name=n", "-c", "user.email=e")
    subprocess.run([*git, "init", "--quiet"], cwd=source, check=True)
    commits = []
    for text in ("<launch><arg name='a'></launch>", "<launch><arg name='a'/></launch>"):
        (source / "a.launch").write_text(text)
        subprocess.run([*git, "add", "--all"], cwd=source, check=True)
        subprocess.run([*git, "commit", "--quiet", "--message", "all"], cwd=source, check=True)
        commits.append(subprocess.check_output([*git, "rev-parse", "HEAD"], cwd=source, text=True).strip())
    fix = FIX._replace(buggy=commits[0], fixed=commits[1])
    command = [sys.executable, "-m", "preflight_server.cli.main"]
    options = Options([], tmp_path / "sources", 1, 1, command, tmp_path / "out", False)
    found = goes_away(fix, options)
    assert isinstance(found, list)
    assert worst(found) == "error LCH001"
    assert goes_away(fix._replace(repository="o/elsewhere"), options) is None
