"""How much is said of one file, and of one name (LCH038)."""

from __future__ import annotations

from preflight_analysis.environment.model import Environment
from preflight_analysis.findings.clipping import MAX_FINDINGS, MAX_MESSAGE, clipped
from preflight_analysis.findings.report import Report, to_text
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace


def analysed(text: str) -> Analysis:
    sources = Sources()
    sources.open("/w/a.launch", text)
    environment = Environment(1, "noetic", {}, (), {}, {}, (), (), None)
    return Workspace(environment, sources, "/w").static("/w/a.launch")


def test_findings_beyond_the_limit_are_counted() -> None:
    count = MAX_FINDINGS + 700
    findings = analysed("<launch>" + "<foo/>\n" * count + '<param name="a"/></launch>').findings
    shown = [f for f in findings if f.rule != "LCH038"]
    (note,) = [f for f in findings if f.rule == "LCH038"]
    assert len(shown) == MAX_FINDINGS
    assert note.message == "701 more findings in this file are not shown: 701 of LCH004"
    assert note.severity == "warning"
    assert "LCH006" in {f.rule for f in shown}, "the most severe are shown, wherever they are"


def test_a_file_with_as_many_as_the_limit_has_no_note() -> None:
    findings = analysed("<launch>" + "<foo/>\n" * MAX_FINDINGS + "</launch>").findings
    assert {f.rule for f in findings} == {"LCH004"}
    assert len(findings) == MAX_FINDINGS


def test_long_words_of_a_message_are_shortened() -> None:
    assert clipped("a" * 300) == "a" * 300
    assert clipped("no 'x' of " + "b" * 5_000_000 + "; did you mean 'y'?").endswith("b; did you mean 'y'?")
    assert len(clipped("no 'x' of " + "b" * 5_000_000 + "; did you mean 'y'?")) < 300
    assert len(clipped("many words " * 100_000)) <= MAX_MESSAGE + 1
    (finding,) = analysed("<launch><" + "t" * 100_000 + "/></launch>").findings
    assert len(finding.message) < 400


def test_only_the_part_of_a_long_line_around_the_place_is_shown() -> None:
    analysis = analysed("<launch>" + "<!-- " + "é" * 5000 + " --><foo/>" + " " * 5000 + "</launch>")
    text = to_text(Report(analysis.findings, analysis.documents, 1, 0, 0))
    _, source, carets, *_ = text.splitlines()
    assert len(source) < 700
    assert source.startswith("  1 | …é") and source.endswith("…")
    assert source[carets.index("^") : carets.rindex("^") + 1] == "foo"
