"""Which files are launched, and what is shown in a file that several of them reach."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import pytest
from preflight_analysis.findings.contexts import RootFindings, by_file, causes_first, lacks_once, roots
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.findings.lack import Lack
from support.locations import location


def finding(rule: str, file: str, at: int = 0, message: str = "m") -> Finding:
    return Finding(rule, "name", "warning", "certain", message, location(file, at, at + 1))


def shown(
    *reports: RootFindings, every_root: Sequence[str] = ("TOP001",)
) -> dict[str, list[tuple[str, str, tuple[str, ...]]]]:
    found = by_file(reports, every_root)
    return {file: [(f.rule, f.message, f.roots) for f in findings] for file, findings in found.items()}


@pytest.mark.parametrize(
    ("reached", "expected"),
    [
        ({}, ()),
        ({"a": ["a"]}, ("a",)),
        ({"a": ["a", "b", "c"], "b": ["b", "c"], "c": ["c"]}, ("a",)),
        ({"c": ["c"], "b": ["b", "c"], "a": ["a", "c"]}, ("b", "a")),
        ({"a": ["a", "b"], "b": ["b", "a"]}, ("a",)),
        ({"a": ["a", "b"], "b": ["b", "a"], "c": ["c", "a", "b"]}, ("c",)),
        ({"a": ["a", "b"], "b": ["b", "a"], "c": ["c", "d"], "d": ["d", "c"]}, ("a", "c")),
    ],
)
def test_roots_are_what_nothing_includes(reached: Mapping[str, list[str]], expected: tuple[str, ...]) -> None:
    assert roots(reached) == expected


def test_every_open_file_is_reached_by_a_root() -> None:
    reached = {"a": ["b"], "b": ["c"], "c": ["a"], "d": ["a", "b", "c", "d"], "e": ["e"]}
    found = roots(reached)
    assert set(reached) == {*found, *(file for root in found for file in reached[root])}


def test_what_two_roots_say_of_one_place_is_shown_once_with_both() -> None:
    one = RootFindings("/a", frozenset({"/a", "/c"}), (finding("ARG001", "/c"), finding("LCH001", "/a")))
    two = RootFindings("/b", frozenset({"/b", "/c"}), (finding("ARG001", "/c", message="other words"),))
    assert shown(one, two) == {"/c": [("ARG001", "m", ("/a", "/b"))], "/a": [("LCH001", "m", ("/a",))]}


def test_a_value_is_wrong_in_any_context() -> None:
    one = RootFindings("/a", frozenset({"/a", "/c"}), (finding("ARG001", "/c"),))
    two = RootFindings("/b", frozenset({"/b", "/c"}), ())
    assert shown(one, two) == {"/c": [("ARG001", "m", ("/a",))]}


def test_a_connection_must_be_wrong_in_every_root_that_reaches_the_file() -> None:
    wrong = finding("TOP001", "/c")
    one = RootFindings("/a", frozenset({"/a", "/c"}), (wrong, finding("TOP001", "/a")))
    right = RootFindings("/b", frozenset({"/b", "/c"}), ())
    unrelated = RootFindings("/d", frozenset({"/d"}), ())
    assert shown(one, right) == {"/a": [("TOP001", "m", ("/a",))]}
    assert shown(one, unrelated)["/c"] == [("TOP001", "m", ("/a",))]
    also_wrong = RootFindings("/b", frozenset({"/b", "/c"}), (wrong,))
    assert shown(one, also_wrong)["/c"] == [("TOP001", "m", ("/a", "/b"))]


def test_a_finding_may_be_marked_to_hold_in_every_root() -> None:
    marked = replace(finding("ARG001", "/c"), every_root=True)
    one = RootFindings("/a", frozenset({"/a", "/c"}), (marked, finding("ARG001", "/c", at=5)))
    right = RootFindings("/b", frozenset({"/b", "/c"}), ())
    assert [f.location.span.start for f in by_file((one, right), ())["/c"]] == [5]
    assert [f.location.span.start for f in by_file((one,), ())["/c"]] == [0, 5]


def test_one_root_may_say_several_things_of_one_place() -> None:
    both = (finding("ARG001", "/a", message="first"), finding("ARG001", "/a", message="second"))
    report = RootFindings("/a", frozenset({"/a"}), (*both, both[0]))
    assert [message for _, message, _ in shown(report)["/a"]] == ["first", "second"]


def test_findings_are_in_the_order_of_the_text() -> None:
    report = RootFindings(
        "/a", frozenset({"/a"}), (finding("B", "/a", 9), finding("C", "/a", 1), finding("A", "/a", 9))
    )
    assert [rule for rule, _, _ in shown(report)["/a"]] == ["C", "A", "B"]


def test_a_lack_shows_once_in_a_file() -> None:
    nav, robot = Lack("package", "nav"), Lack("variable", "ROBOT")

    def found(start: int, lack: Lack | None) -> Finding:
        return Finding("ABC001", "n", "hint", "possible", "m", location("/a", start, start + 1), lack=lack)

    given = tuple(found(at, lack) for at, lack in enumerate((nav, None, nav, robot, None, nav)))
    assert lacks_once(given) == (given[0], given[1], given[3], given[4])
    assert lacks_once(given[:2]) == given[:2]


def test_a_crash_stands_behind_its_cause() -> None:
    """And one without a cause, or of another node, stands by itself."""
    cause = replace(finding("PRM010", "/a.launch"), crash_of="/n")
    crash = replace(finding("TRC001", "/b.launch", 1), crash_of="/n")
    other = replace(finding("TRC001", "/b.launch", 3), crash_of="/m")
    found = causes_first({"/a.launch": (cause,), "/b.launch": (crash, other)}, "TRC001")
    assert found["/b.launch"] == (other,)
    assert [each.related for each in found["/a.launch"]] == [(Related(crash.message, crash.location),)]
    elsewhere = {
        "/a.launch": (replace(cause, roots=("/a.launch",)),),
        "/b.launch": (replace(crash, roots=("/b.launch",)),),
    }
    assert causes_first(elsewhere, "TRC001") is elsewhere, "the node of another launch"
    alone = {"/b.launch": (crash, other)}
    assert causes_first(alone, "TRC001") is alone
