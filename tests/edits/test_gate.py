"""The gate: no edit is offered that does not leave files that parse."""

import logging

import pytest
from preflight_analysis.documents.span import LineIndex, Span
from preflight_analysis.edits.edit import Edit, applied
from preflight_analysis.edits.gate import RAISES, EditRefusedError, mistakes, passes, refusal
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.findings.offered import with_offered_fixes
from support.locations import location

_PYTHON = (
    "from launch import LaunchDescription\n\n\ndef generate_launch_description():\n    return LaunchDescription([])\n"
)


def _refusal(path: str, before: str, after: str) -> str | None:
    """Why an edit that makes one text of the other is refused."""
    edit = Edit(LineIndex(before).location(path, Span(0, len(before))), after)
    return refusal([edit], {path: before}.get)


@pytest.mark.parametrize(
    ("path", "before", "after"),
    [
        ("/a.launch", "<launch/>", "<launch>"),
        ("/a.launch.xml", '<launch><arg name="a"/></launch>', '<launch><arg name="a" name="a"/></launch>'),
        ("/package.xml", "<package/>", "<package>&</package>"),
        ("/a.launch.py", _PYTHON, '<arg name="a"/>' + _PYTHON),
        ("/a.launch.py", "Node(a=1)\n", "Node(a=1, a=2)\n"),
        ("/a.launch", _PYTHON, _PYTHON + ")"),
        ("/a.launch.yaml", "launch:\n- node: {pkg: p}\n", "launch:\n- node: {pkg: p\n"),
        ("/a.yaml", "a: 1\nb: 2\n", "a: 1\na: 2\n"),
        ("/CMakeLists.txt", "project(a)\n", "project(a\n"),
        ("/CMakeLists.txt", 'set(a "b")\n', 'set(a "b)\n'),
        ("/notes.txt", "a", "b"),
    ],
)
def test_what_leaves_a_file_malformed_is_refused(path: str, before: str, after: str) -> None:
    assert _refusal(path, before, after) is not None


@pytest.mark.parametrize(
    ("path", "before", "after"),
    [
        ("/a.launch", "<launch/>", "<launch></launch>"),
        ("/a.launch", "<launch><arg></launch>", "<launch><arg/></launch>"),
        ("/a.launch.py", _PYTHON, "import os\n" + _PYTHON),
        ("/a.yaml", "a: 1\n", "a: 1\nb: 2\n"),
        ("/CMakeLists.txt", "project(a) # (\n", 'project(b) # (\nset(c "(" [[(]])\n'),
    ],
)
def test_what_leaves_it_well_formed_passes(path: str, before: str, after: str) -> None:
    assert _refusal(path, before, after) is None


def test_a_malformed_file_may_not_get_worse() -> None:
    before = 'launch:\n- arg: {name: a}\n- node: {pkg: "p\n'
    start = before.index("a}")

    def refused(text: str) -> str | None:
        lines = LineIndex(before)
        return refusal([Edit(lines.location("/a.yaml", Span(start, start + 1)), text)], {"/a.yaml": before}.get)

    assert mistakes("/a.yaml", before)
    assert refused("longer") is None
    assert refused("a: b: c") is not None


def test_edits_that_overlap_and_files_that_nobody_knows() -> None:
    lines = LineIndex("<launch/>")
    one, other = (Edit(lines.location("/a.launch", Span(1, end)), "x") for end in (3, 7))
    assert "overlap" in (refusal([one, other], {"/a.launch": "<launch/>"}.get) or "")
    assert "not known" in (refusal([one], {}.get) or "")


def test_insertions_at_one_place_keep_their_order() -> None:
    lines = LineIndex("ab")
    edits = [Edit(lines.location("/a", Span(1, 1)), text) for text in ("1", "2")]
    assert applied("ab", edits) == "a12b"


def _finding() -> Finding:
    bad = Edit(LineIndex("<launch/>").location("/a.launch", Span(0, 9)), "<launch>")
    good = Edit(LineIndex("<launch/>").location("/a.launch", Span(0, 9)), "<launch></launch>")
    fixes = (Fix("Break it", (bad,)), Fix("Mend it", (good,)))
    return Finding("LCH000", "a", "error", "certain", "a", location("/a.launch", 0, 0), fixes=fixes)


@pytest.mark.breaks
def test_what_is_refused_is_not_offered_and_logged(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.delenv(RAISES)
    with caplog.at_level(logging.ERROR):
        (finding,) = with_offered_fixes([_finding()], {"/a.launch": "<launch/>"}.get)
    assert [fix.title for fix in finding.fixes] == ["Mend it"]
    assert "not offered: LCH000 Break it: it leaves /a.launch with" in caplog.text


def test_what_is_refused_fails_a_test() -> None:
    (bad, _) = _finding().fixes
    with pytest.raises(EditRefusedError, match="Break it"):
        passes(bad.title, bad.edits, {"/a.launch": "<launch/>"}.get)
