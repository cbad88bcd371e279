"""docs/truth.md: what it says is what `bench/ecosystem` has."""

from __future__ import annotations

import csv
from dataclasses import replace

import pytest
from preflight_analysis.findings import policy_page
from preflight_analysis.findings.finding import Severity
from preflight_analysis.findings.policy import LIMITS, USUAL
from tools.ecosystem import DATA, Entry, Project, Snapshot, read_findings, read_projects
from tools.ecosystem_fixes import NOTHING, Fix, read_fixes
from tools.truth import PAGE, SEVERITY, FixList, Round, judged, page, read_fix_lists, read_rounds

PROJECT = Project("o/p", "c0ffee", "2")
FOUND = Entry("TOP001", "1:1", "a.launch", 7, "'/chater' has no publisher", "warning", "likely")
FIX = Fix(
    "o/p", "1", "c0ffee", "beef", "a.launch", "syntax", "not closed", "yes", "f00d", "2026-11-28", "error LCH001", "yes"
)
ROUND = Round("2", "1", "1", "unseen", "8", "", "10", "7", "3", "3")


def of(*entries: Entry) -> dict[Project, Snapshot]:
    return {PROJECT: Snapshot({each.fingerprint: each for each in entries}, {}, "f00d", "2026-11-28")}


def test_the_page_is_the_one_that_is_written() -> None:
    found = {each: read_findings(each) for each in read_projects()}
    written = page(found, read_fixes(), read_rounds(), read_fix_lists())
    assert PAGE.read_text() == written, "run: make truth"
    assert len(written.splitlines()) <= 60


def test_the_page_of_the_policy_is_the_one_that_is_written() -> None:
    assert SEVERITY.read_text() == policy_page.page(_judged()), "run: make truth"


@pytest.mark.parametrize(("severity", "least"), [("warning", 85), ("error", 95)])
def test_the_policy_is_calibrated(severity: Severity, least: int) -> None:
    """A row of which too few of ten or more are true is less severe, but for those that are named here as open."""
    loud: dict[str, str] = {**USUAL} | {r.name: limit.severity for r, limit in LIMITS.items()}
    wrong = [
        row
        for row, of in sorted(_judged().items())
        if loud.get(row) == severity and of.all >= 10 and 100 * of.true < least * of.all
    ]
    assert wrong == _OPEN.get(severity, [])


_OPEN = {"warning": ["LIBRARY", "UNSEEN"]}
"""Rows that are louder than they should be: what is false there has causes that are known and not mended yet."""


def _judged() -> dict[str, policy_page.Judged]:
    return judged([read_findings(each) for each in read_projects()])


def test_precision_is_of_what_is_judged_and_still_found() -> None:
    verdicts = ("true", "trivial", "false", "machine", "")
    entries = [replace(FOUND, fingerprint=f"{n}:1", verdict=verdict) for n, verdict in enumerate(verdicts)]
    entries.append(replace(FOUND, fingerprint="9:1", severity=None, confidence=None, verdict="false"))
    entries.append(replace(FOUND, fingerprint="8:1", rule="LCH001", severity="error", verdict="true"))
    text = page(of(*entries), [], [])
    assert "in 1 public projects. Of these, 1 are ROS 2 projects." in text
    assert "That was on 2026-11-28 with the code at f00d. Of 6 findings 5 were judged" in text
    assert "2 are true, 1 trivial (true, and nobody fixes it), 1 false, 1 of the machine" in text
    assert "| all | 1 of 1 (100 %) | 2 of 4 (50 %) | – | 1 |" in text
    assert "| LCH | 1 of 1 (100 %) | – | – | 0 |" in text
    assert "| TOP | – | 2 of 4 (50 %) | – | 1 |" in text


def test_a_project_that_was_never_checked_is_not_counted() -> None:
    assert "in 0 public projects" in page({PROJECT: Snapshot()}, [], [])


def test_rounds_are_summed_over_their_samples() -> None:
    samples = [ROUND, ROUND._replace(sample="2", errors="90"), ROUND._replace(state="fixed", errors="7")]
    row = "| 2 | 1 | 16 | 14 of 100 (14 %) | 6 of 6 (100 %) | 7 of 7 (100 %) | 3 of 3 (100 %) |"
    assert row in page({}, [], samples)


def test_recall_is_of_what_the_repository_shows() -> None:
    fixes = [FIX, FIX._replace(found=NOTHING), FIX._replace(kind="argument", found="hint ARG008")]
    fixes += [FIX._replace(visible="no", found=NOTHING), FIX._replace(visible="no"), FIX._replace(found="")]
    fixes += [FIX._replace(kind="argument", found="error LCH002", mistake="no")]
    text = page({}, fixes, [])
    assert (
        "| all | 4 | 1 | 0 | 0 | 1 | 2 |\n| argument | 2 | 0 | 0 | 0 | 1 | 1 |\n| syntax | 2 | 1 | 0 | 0 | 0 | 1 |"
        in text
    )
    assert "In 2 further fixes nothing in the repository shows the mistake; found above a hint: 1." in text


def test_what_a_list_found_when_it_was_new_is_kept() -> None:
    known = FixList("first", "wiring", "40", "10", "38", "30", "", "")
    text = page({}, [], [], [known, known._replace(list="second", repositories="9", code="f00d")])
    assert (
        "The second list has 40 fixes of 9 repositories. When it was new (code f00d), 10 of 38 (26 %) of the visible "
        "ones were found above information." in text
    )
    assert "the first list" not in text


def test_all_families_and_kinds_fit_the_page() -> None:
    families = {each.stem[:3] for each in (PAGE.parent / "rules").glob("*[0-9].md")}
    entries = [replace(FOUND, fingerprint=f"{each}:1", rule=f"{each}001", verdict="true") for each in families]
    fixes = [each._replace(found="info X", date="d") for each in read_fixes()]
    assert len(page(of(*entries), fixes, read_rounds(), read_fix_lists()).splitlines()) <= 60


def test_the_projects_of_a_sample_add_up_to_it() -> None:
    with (DATA / "rounds" / "projects.tsv").open(newline="") as table:
        projects = list(csv.DictReader(table, delimiter="\t"))
    for sample in read_rounds():
        if sample.state != "unseen" or not sample.sample:
            continue
        of = [p for p in projects if all(p[key] == getattr(sample, key) for key in ("round", "generation", "sample"))]
        assert len(of) == int(sample.projects), sample
        for key in ("errors", "errors_true", "warnings", "warnings_true"):
            counts = [each[key] for each in of]
            assert not all(counts) or sum(map(int, counts)) == int(getattr(sample, key)), (sample, key)
