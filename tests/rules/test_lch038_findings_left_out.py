"""LCH038: a file has more findings than are shown."""

import pytest
from preflight_analysis.findings.clipping import MAX_FINDINGS
from support.check import findings_of


def test_findings_beyond_the_limit_are_counted() -> None:
    count = MAX_FINDINGS + 700
    findings = findings_of("<launch>" + "<foo/>\n" * count + '<param name="a"/></launch>')
    shown = [f for f in findings if f.rule != "LCH038"]
    (note,) = [f for f in findings if f.rule == "LCH038"]
    assert len(shown) == MAX_FINDINGS
    assert note.message == "701 more findings of this file are left out: 701 of 'LCH004'"
    assert note.severity == "warning"
    assert "LCH006" in {f.rule for f in shown}, "the most severe are shown, wherever they are"


@pytest.mark.silent
def test_a_file_with_as_many_as_the_limit_has_no_note() -> None:
    findings = findings_of("<launch>" + "<foo/>\n" * MAX_FINDINGS + "</launch>")
    assert {f.rule for f in findings} == {"LCH004"}
    assert len(findings) == MAX_FINDINGS
