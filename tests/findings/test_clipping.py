"""How much is said of one name and of one line."""

from __future__ import annotations

from preflight_analysis.environment.model import Environment
from preflight_analysis.findings.clipping import MAX_MESSAGE, clipped
from preflight_analysis.findings.report import Report, to_text
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace


def analysed(text: str) -> Analysis:
    sources = Sources()
    sources.open("/w/a.launch", text)
    environment = Environment(1, "noetic", {}, (), {}, {}, (), (), None)
    return Workspace(environment, sources, "/w").static("/w/a.launch")


def test_long_words_of_a_message_are_shortened() -> None:
    assert clipped("a" * 300) == "a" * 300
    assert clipped("no 'x' of " + "b" * 5_000_000 + "; did you mean 'y'?").endswith("b; did you mean 'y'?")
    assert len(clipped("no 'x' of " + "b" * 5_000_000 + "; did you mean 'y'?")) < 300
    assert len(clipped("many words " * 100_000)) <= MAX_MESSAGE + 1
    (finding,) = analysed("<launch><" + "t" * 100_000 + "/></launch>").findings
    assert len(finding.message) < 400


def test_only_the_part_of_a_long_line_around_the_place_is_shown() -> None:
    analysis = analysed("<launch>" + "<!-- " + "é" * 5000 + " --><foo/>" + " " * 5000 + "</launch>")
    text = to_text(Report(analysis.findings, analysis.documents))
    _, source, carets, *_ = text.splitlines()
    assert len(source) < 700
    assert source.startswith("  1 | …é") and source.endswith("…")
    assert source[carets.index("^") : carets.rindex("^") + 1] == "foo"
