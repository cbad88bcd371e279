"""Severities that a project wants."""

from __future__ import annotations

from preflight_analysis.documents.span import Location
from preflight_analysis.findings.finding import Finding
from preflight_analysis.findings.lack import Lack
from preflight_analysis.findings.severities import Severities, adjusted

FAULT = Finding("PKG001", "package-not-found", "error", "certain", "m", Location.of_file("/a.launch"))
LACK = Finding("PKG001", "package-not-found", "hint", "possible", "m", FAULT.location, lack=Lack("package", "nav_msgs"))


def test_a_lack_of_the_machine_is_never_made_a_fault() -> None:
    assert [each.severity for each in adjusted([FAULT, LACK], [Severities({"PKG001": "warning"})])] == [
        "warning",
        "hint",
    ]


def test_a_rule_that_is_off_does_not_speak_of_lacks_either() -> None:
    assert adjusted([LACK], [Severities({"PKG001": "off"})]) == ()
