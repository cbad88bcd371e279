"""What counts against a fix: a file that does not parse, a finding that is still there, an error that is new."""

from collections.abc import Generator, Iterable, Sequence

import pytest
from preflight_analysis.edits.edit import Edit
from preflight_analysis.findings.finding import Finding, Fix, Severity
from support.fix_property import Launch, tries
from support.locations import location

_TEXT = '<launch><node pkg="gazbo" type="t" name="a"/><node pkg="q" type="u" name="b"/></launch>'
_NAME = location("/a.launch", _TEXT.index("gazbo"), _TEXT.index("gazbo") + 5)

_NO_T = "executable 't' not found in package 'gazebo'"


def _said(
    rule: str, where: str, message: str = "", *, file: str = "/a.launch", severity: Severity = "error"
) -> Finding:
    at = _TEXT.replace("gazbo", "gazebo").index(where)
    return Finding(rule, "some", severity, "certain", message or rule, location(file, at, at + len(where)))


def _wrong(rule: str, new: str, after: Iterable[Finding]) -> str | None:
    fix = Fix("Write it", (Edit(_NAME, new),), True)
    finding = Finding(rule, "some", "error", "certain", "not found", _NAME, fixes=(fix,))
    launch = Launch("a.launch", [finding], {"/a.launch"})
    (tried,) = tries([finding], {"/a.launch": _TEXT}.get, lambda *_: (each for each in [after]), launch)
    return tried.wrong


def test_what_counts_against_a_fix() -> None:
    assert _wrong("PKG001", "gazebo", []) is None
    assert (_wrong("PKG001", '" pkg="b', []) or "").startswith("it leaves /a.launch with")
    still = Finding("PKG001", "some", "error", "certain", "not found", _NAME)
    assert _wrong("PKG001", "gazebo", [still]) == "the finding is still there"
    assert _wrong("PKG001", "gazebo", [_said("LCH016", '"a"', severity="warning")]) is None
    assert (_wrong("PKG001", "gazebo", [_said("LCH016", '"a"')]) or "").startswith("new errors")


@pytest.mark.parametrize(
    ("rule", "error", "counts"),
    [
        ("PKG001", _said("PKG002", '"t"', _NO_T), False),  # in a package that was not found nothing was looked up
        ("PKG001", _said("LCH013", '"gazebo"'), False),  # the path in which it is named
        ("LCH027", _said("PKG002", '"t"', _NO_T), False),
        ("PKG001", _said("PKG002", '"u"', "executable 'u' not found in package 'q'"), True),  # another package
        ("PKG001", _said("PRM002", '"t"'), True),  # another path, in the same tag
        ("ARG001", _said("PKG002", '"t"', _NO_T), True),  # the package was found before
        ("PKG001", _said("LCH016", '"gazebo"'), True),  # nothing that is looked up
        ("PKG001", _said("LCH016", '"gazebo"', file="/b.launch"), False),  # a file that was not read before
    ],
)
def test_an_error_of_what_was_not_evaluated_before_is_not_new(rule: str, error: Finding, counts: bool) -> None:
    assert (_wrong(rule, "gazebo", [error]) is not None) == counts


def test_a_fix_is_tried_in_all_launches_that_read_what_it_edits() -> None:
    fix = Fix("Write it", (Edit(_NAME, "gazebo"),), True)
    finding = Finding("PKG001", "some", "error", "certain", "not found", _NAME, fixes=(fix,))
    error = _said("ARG004", '"a"')
    after = {"a.launch": [], "b.launch": [error], "known.launch": [error]}
    launches = [
        Launch("a.launch", [finding], {"/a.launch"}),
        Launch("known.launch", [error], {"/a.launch"}),
        Launch("other.launch", [], {"/other.launch"}),
    ]

    def wrong(*others: Launch) -> str | None:
        (tried,) = tries([finding], {"/a.launch": _TEXT}.get, again, launches[0], others)
        return tried.wrong

    def again(_: object, asked: Sequence[Launch]) -> Generator[Iterable[Finding]]:
        yield from (after[each.name] for each in asked)

    assert wrong(*launches[1:]) is None
    found = wrong(*launches[1:], Launch("b.launch", [], {"/a.launch", "/b.launch"}))
    assert found is not None
    assert found.startswith("new errors in b.launch: [('ARG004'")
