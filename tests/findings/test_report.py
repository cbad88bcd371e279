"""The text and JSON forms of findings."""

import json

from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.findings.finding import Edit, Finding, Fix, Related
from preflight_analysis.findings.report import Report, to_json, to_text
from preflight_analysis.rules.registry import run_rules
from support.check import analyse, read_fixture
from support.locations import location

TALKERS = """
    <launch>
      <node pkg="p" type="t" name="talker"/>
      <node pkg="p" type="t" name="listener">
        <remap from="chatter" to="chater"/>
      </node>
    </launch>
    //- interfaces
    {"/talker": {"publishers": {"chatter": "std_msgs/String"}},
     "/listener": {"subscribers": {"chatter": "std_msgs/String"}}}
"""


def report_of(text: str) -> Report:
    context = analyse(read_fixture(text))
    return Report(run_rules(context), context.documents, len(context.tree.files), len(context.tree.nodes), 2)


def test_text() -> None:
    assert to_text(report_of(TALKERS)) == (
        "/main.launch:4:31: warning (likely) TOP001 subscribed-not-published: none of the 2 nodes of this launch "
        "publishes '/chater', to which /listener subscribes; did you mean '/chatter', published by /talker (same type "
        "std_msgs/String)?\n"
        '  4 |     <remap from="chatter" to="chater"/>\n'
        "    |                               ^^^^^^\n"
        "  /main.launch:2:3: /talker publishes /chatter\n"
        "  fix: Replace 'chater' by 'chatter'\n"
        "\n"
        "1 warning in 1 file, 2 nodes, 2 of them traced\n"
    )


def test_json() -> None:
    data = to_json(report_of(TALKERS))
    json.dumps(data, sort_keys=True)
    (finding,) = data.pop("findings")
    assert data == {"schema": "ros-preflight/check/1", "files": 1, "nodes": 2, "traced": 2}
    message = finding.pop("message")
    assert "'/chater'" in message
    assert finding == {
        "rule": "TOP001",
        "name": "subscribed-not-published",
        "severity": "warning",
        "confidence": "likely",
        "file": "/main.launch",
        "range": {"start": {"line": 4, "column": 31}, "end": {"line": 4, "column": 37}},
        "related": [
            {
                "message": "/talker publishes /chatter",
                "file": "/main.launch",
                "range": {"start": {"line": 2, "column": 3}, "end": {"line": 2, "column": 41}},
            }
        ],
        "roots": ["/main.launch"],
        "fixes": ["Replace 'chater' by 'chatter'"],
    }


def one(text: str, start: int, end: int, message: str = "m") -> Report:
    document = parse_xml("/a.launch", text)
    finding = Finding("LCH001", "n", "error", "certain", message, location("/a.launch", start, end))
    return Report([finding], {"/a.launch": document}, 1, 0, 0)


def test_columns_count_code_points_and_carets_stand_below_wide_characters() -> None:
    report = one("<!-- \U0001f916日本 --> x", 13, 14)
    assert to_json(report)["findings"][0]["range"]["start"] == {"line": 1, "column": 14}
    lines = to_text(report).split("\n")
    assert lines[1] == "  1 | <!-- \U0001f916日本 --> x"
    assert lines[2] == "    | " + " " * 16 + "^"


def test_tabs_several_lines_and_the_end_of_the_file() -> None:
    lines = to_text(one("\t<a\n>", 1, 5)).split("\n")
    assert lines[1:3] == ["  1 |     <a", "    |     ^^"]
    assert "^" not in to_text(one("", 0, 0))


def test_control_characters_do_not_reach_the_terminal() -> None:
    text = to_text(one("<a>\x1b[31m</a>", 3, 4, "bad \x1b]0;title\x07 text"))
    assert "\x1b" not in text
    assert "\x07" not in text


def test_a_place_in_a_file_without_text_still_has_a_place() -> None:
    there = location("/gone.yaml", 5, 9)
    finding = Finding(
        "PRM001", "n", "hint", "possible", "m", there, (Related("r", there),), (Fix("f", (Edit(there, ""),)),)
    )
    report = Report([finding], {}, 0, 0, 0)
    assert to_text(report).startswith("/gone.yaml:1:1: hint (possible) PRM001 n: m\n  /gone.yaml:1:1: r\n  fix: f\n")
    assert to_json(report)["findings"][0]["range"]["end"] == {"line": 1, "column": 1}


def test_colour_and_hints_are_a_choice() -> None:
    report = one("<a/>", 0, 4)
    assert "\x1b[31merror" in to_text(report, colour=True)
    hint = Finding("TOP002", "n", "hint", "likely", "m", location("/a.launch", 0, 1))
    quiet = Report([hint], report.documents, 1, 0, 0)
    assert to_text(quiet, show_hints=False) == "1 hint in 1 file, 0 nodes, 0 of them traced\n"
