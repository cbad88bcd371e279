"""SARIF, JUnit and GitHub's annotations, made of plain findings."""

from __future__ import annotations

import json
import os
import xml.etree.ElementTree as ET
from typing import Any

import jsonschema
from preflight_analysis.documents.span import Location
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.edits.edit import Edit
from preflight_analysis.findings.finding import Finding, Fix, Related
from preflight_analysis.findings.fingerprint import fingerprints
from preflight_analysis.findings.github import to_github
from preflight_analysis.findings.junit import to_junit
from preflight_analysis.findings.report import Report
from preflight_analysis.findings.sarif import FINGERPRINT, to_sarif
from preflight_analysis.rules.registry import all_rules
from support.locations import location
from support.sarif_schema import SARIF_SCHEMA

MAIN = '<launch>\n  <remap from="chatter" to="chater"/>\n  <remap from="chatter" to="chater"/>\n</launch>\n'
OTHER = "<!-- 日本 --><launch/>\n"


def at(file: str, text: str, what: str, nth: int = 0) -> Location:
    start = -1
    for _ in range(nth + 1):
        start = text.index(what, start + 1)
    return location(file, start, start + len(what))


def report(base: str = "/ws", main: str = MAIN) -> Report:
    file, other = f"{base}/a b.launch", "/opt/other, 100%.launch"
    documents = {file: parse_xml(file, main), other: parse_xml(other, OTHER)}
    place = at(file, main, "chater")
    findings = [
        Finding(
            *("TOP001", "subscribed-not-published", "warning", "likely"),
            "nobody publishes\x07 '/chater', 100%",
            place,
            (Related("/talker publishes,\n/chatter", at(other, OTHER, "<launch/>")),),
            (Fix("Replace it", (Edit(place, "chatter"), Edit(at(other, OTHER, "日本"), ""))), Fix("In words", ())),
            (file,),
        ),
        Finding("TOP001", "subscribed-not-published", "info", "certain", "again", at(file, main, "chater", 1)),
        Finding("LCH013", "include-not-found", "error", "certain", "gone", at(other, OTHER, "<launch/>")),
        Finding("LCH021", "hard-coded-path", "hint", "possible", "of several lines", location(file, 0, 12)),
        Finding("PRM003", "parameter-file-unreadable", "error", "certain", "no text", location("/x.yaml", 3, 9)),
    ]
    return Report(findings, documents)


def sarif(of: Report, base: str = "/ws") -> Any:
    data = json.loads(json.dumps(to_sarif(of, all_rules(), base), sort_keys=True))
    jsonschema.validate(data, SARIF_SCHEMA)
    return data


def test_sarif_has_the_place_the_other_places_and_the_fixes() -> None:
    (run,) = sarif(report())["runs"]
    first, _, third, several_lines, no_text = run["results"]
    assert run["columnKind"] == "unicodeCodePoints"
    assert run["originalUriBaseIds"] == {"SRCROOT": {"uri": "file:///ws/"}}
    assert [result["level"] for result in run["results"]] == ["warning", "note", "error", "note", "error"]
    assert first["locations"] == [
        {
            "physicalLocation": {
                "artifactLocation": {"uri": "a%20b.launch", "uriBaseId": "SRCROOT"},
                "region": {"startLine": 2, "startColumn": 29, "endLine": 2, "endColumn": 35},
            }
        }
    ]
    (related,) = first["relatedLocations"]
    assert related["physicalLocation"]["artifactLocation"] == {"uri": "file:///opt/other%2C%20100%25.launch"}
    assert related["physicalLocation"]["region"]["startColumn"] == 12
    (fix,) = first["fixes"]
    assert fix["description"] == {"text": "Replace it"}
    assert [c["artifactLocation"]["uri"] for c in fix["artifactChanges"]] == [
        "a%20b.launch",
        "file:///opt/other%2C%20100%25.launch",
    ]
    assert fix["artifactChanges"][0]["replacements"][0]["insertedContent"] == {"text": "chatter"}
    assert first["properties"] == {
        **{"severity": "warning", "confidence": "likely", "roots": ["a b.launch"]},
        **{"effect": "misbehaves", "kind": "invalid", "decidedBy": "misbehaves", "doubts": []},
    }
    assert several_lines["locations"][0]["physicalLocation"]["region"]["endLine"] == 2
    assert no_text["locations"][0]["physicalLocation"]["region"]["startLine"] == 1
    rules = run["tool"]["driver"]["rules"]
    assert [rules[result["ruleIndex"]]["id"] for result in run["results"]] == [r["ruleId"] for r in run["results"]]
    assert rules[third["ruleIndex"]]["help"]["text"]


def test_sarif_of_nothing() -> None:
    (run,) = sarif(Report([], {}), "/")["runs"]
    assert (run["results"], run["originalUriBaseIds"]["SRCROOT"]["uri"]) == ([], "file:///")


def test_a_file_whose_name_is_no_utf_8() -> None:
    file = os.fsdecode(b"/ws/\xff.launch")
    finding = Finding("LCH013", "include-not-found", "error", "certain", "gone", location(file, 0, 1))
    of = Report([finding], {})
    place = sarif(of)["runs"][0]["results"][0]["locations"][0]["physicalLocation"]
    assert place["artifactLocation"]["uri"] == "%FF.launch"
    assert ET.fromstring(to_junit(of, [finding], [file], "/ws")) is not None
    assert "\N{REPLACEMENT CHARACTER}.launch" in to_github(of, "/ws")


def test_every_rule_can_be_described() -> None:
    findings = [Finding(r.id, r.name, r.severity, "certain", "m", location("/a", 0, 0)) for r in all_rules()]
    assert len(sarif(Report(findings, {}))["runs"][0]["tool"]["driver"]["rules"]) == len(all_rules())


def test_fingerprints_hold_when_lines_move_and_the_folder_does() -> None:
    before = fingerprints(report().findings, report().documents, "/ws")
    moved = report("/elsewhere/ws", "<!-- new -->\n\n" + MAIN.replace("\n  ", "\n\t\t"))
    after = fingerprints(moved.findings, moved.documents, "/elsewhere/ws")
    assert after[:3] == before[:3]
    assert len(set(before)) == len(before), "two alike in one file are told apart"
    assert [each.split(":")[1] for each in before[:2]] == ["1", "2"]
    assert set(_of_another_line(MAIN)) == set(before[:1])
    assert set(_of_another_line(MAIN.replace("from=", "to_=", 1))).isdisjoint(before)
    assert FINGERPRINT in sarif(report())["runs"][0]["results"][0]["partialFingerprints"]


def _of_another_line(text: str) -> list[str]:
    file = "/ws/a b.launch"
    finding = Finding("TOP001", "n", "hint", "certain", "in other words", at(file, text, "chater"))
    return fingerprints([finding], {file: parse_xml(file, text)}, "/ws")


def test_junit_has_a_case_for_each_rule_and_file() -> None:
    of = report()
    failing = [finding for finding in of.findings if finding.severity in ("error", "warning")]
    text = to_junit(of, failing, ["/ws/a b.launch", "/ws/clean.launch"], "/ws")
    suites = ET.fromstring(text)
    (suite,) = suites
    cases = suite.findall("testcase")
    assert [(case.get("classname"), case.get("name"), [child.tag for child in case]) for case in cases] == [
        ("clean.launch", "no findings", []),
        ("a b.launch", "TOP001 subscribed-not-published", ["failure"]),
        ("/opt/other, 100%.launch", "LCH013 include-not-found", ["failure"]),
        ("a b.launch", "LCH021 hard-coded-path", ["system-out"]),
        ("/x.yaml", "PRM003 parameter-file-unreadable", ["failure"]),
    ]
    for element in (suites, suite):
        assert (element.get("tests"), element.get("failures")) == ("5", "3")
    failure = cases[1].find("failure")
    assert failure is not None
    assert failure.get("type") == "warning"
    assert "a b.launch:2:29: warning (likely) TOP001" in str(failure.text)
    assert "\x07" not in text


def test_github_has_an_annotation_for_each_finding_the_worst_first() -> None:
    *lines, summary = to_github(report(), "/ws").splitlines()
    assert [line.split(" ")[0] for line in lines] == ["::error", "::error", "::warning", "::notice", "::notice"]
    assert lines[2] == (
        "::warning file=a b.launch,line=2,endLine=2,col=29,endColumn=35,title=TOP001 subscribed-not-published (likely)"
        "::nobody publishes␇ '/chater', 100%25"
        "%0A/opt/other, 100%25.launch:1:12: /talker publishes,␊/chatter"
        "%0Afix: Replace it%0Afix: In words"
    )
    assert "file=/opt/other%2C 100%25.launch," in lines[0]
    assert "line=1,endLine=2,title=" in lines[4], "columns only where the finding ends on its line"
    assert summary.startswith("2 errors, 1 warning, 1 info, 1 hint")
