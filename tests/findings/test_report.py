"""The text and JSON forms of findings."""

import json
from collections import Counter
from dataclasses import replace

from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.edits.edit import Edit
from preflight_analysis.findings.claim import Subject, Text, as_text, say
from preflight_analysis.findings.coverage import Coverage
from preflight_analysis.findings.finding import Alike, Finding, Fix, Related, Severity
from preflight_analysis.findings.lack import Lack
from preflight_analysis.findings.report import Report, by_cause, to_json, to_text
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
    nodes = {"trace": len(context.tree.nodes)}
    return Report.of(run_rules(context), context.documents, Coverage(len(context.tree.files), 1, nodes))


def test_text() -> None:
    assert to_text(report_of(TALKERS)) == (
        "/main.launch:4:31: warning (likely) TOP001 subscribed-not-published: '/chater' "
        "has no publisher (subscriber: /listener); did you mean '/chatter', published by /talker (same type "
        "std_msgs/String)?\n"
        '  4 |     <remap from="chatter" to="chater"/>\n'
        "    |                               ^^^^^^\n"
        "  /main.launch:2:3: /talker publishes /chatter\n"
        "  fix: Replace 'chater' with 'chatter'\n"
        "\n"
        "1 warning; 1 of 1 launch file evaluated, 2 nodes: 2 run\n"
    )


def test_json() -> None:
    data = to_json(report_of(TALKERS))
    json.dumps(data, sort_keys=True)
    (finding,) = data.pop("findings")
    assert data == {
        "schema": "ros-preflight/check/1",
        "failures": [],
        "rules": {"TOP001": {"warning": 1}},
        "environment": {"complete": True, "missing": [], "commands": [], "problems": []},
        "coverage": {
            **{"files": 1, "evaluated": 1, "not_evaluated": [], "untried": 0},
            **{"nodes": 2, "sources": {"trace": 2}, "unknown_nodes": [], "other_files": 0},
        },
        **{"files": 1, "nodes": 2, "traced": 2},
    }
    message = finding.pop("message")
    assert "'/chater'" in message
    assert [each["name"] for each in finding.pop("doubts")] == ["UNSEEN"]
    assert finding == {
        "rule": "TOP001",
        "name": "subscribed-not-published",
        "severity": "warning",
        "confidence": "likely",
        **{"effect": "breaks", "kind": "near", "node": "/listener", "candidates": ["/chatter"]},
        "subject": {"kind": "topic", "name": "/chater"},
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
        "fixes": ["Replace 'chater' with 'chatter'"],
    }


def one(text: str, start: int, end: int, message: str = "m") -> Report:
    document = parse_xml("/a.launch", text)
    finding = Finding("LCH001", "n", "error", "certain", message, location("/a.launch", start, end))
    return Report([finding], {"/a.launch": document}, Coverage(1, 1))


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
    report = Report([finding], {})
    assert to_text(report).startswith("/gone.yaml:1:1: hint (possible) PRM001 n: m\n  /gone.yaml:1:1: r\n  fix: f\n")
    assert to_json(report)["findings"][0]["range"]["end"] == {"line": 1, "column": 1}


def test_colour_and_severities_are_a_choice() -> None:
    report = one("<a/>", 0, 4)
    assert "\x1b[31merror" in to_text(report, colour=True)
    hint = Finding("TOP002", "n", "hint", "likely", "m", location("/a.launch", 0, 1))
    quiet = Report([hint], report.documents, Coverage(1, 1)).at_least("info")
    assert to_text(quiet) == "no findings (1 hint not shown: --severity hint); 1 of 1 launch file evaluated, 0 nodes\n"
    assert Report([hint], {}).at_least("hint").findings == [hint]


def finding(
    severity: Severity, file: str, start: int, said: str | Text = "m", rule: str = "ABC001", lack: Lack | None = None
) -> Finding:
    """One that speaks of what its message has in quotes."""
    text, name = as_text(said), str(said).partition("'")[2].partition("'")[0]
    place, subject = location(file, start, start + 1), Subject("name", name)
    return Finding(rule, "n", severity, "certain", str(text), place, lack=lack, text=text, subject=subject)


def test_the_most_severe_come_first_then_files_and_places() -> None:
    given = [
        finding("hint", "/a", 1),
        finding("error", "/b", 5),
        finding("warning", "/a", 3),
        finding("error", "/b", 2),
    ]
    report = Report.of(given, {}, Coverage())
    assert [(f.severity, f.location.file, f.location.span.start) for f in report.findings] == [
        *(("error", "/b", 2), ("error", "/b", 5), ("warning", "/a", 3), ("hint", "/a", 1))
    ]


def test_what_is_missing_here_is_said_once_and_is_no_finding() -> None:
    nav, amcl = Lack("package", "nav", "apt install nav"), Lack("package", "amcl", "apt install amcl")
    given = [
        finding("hint", "/a", 1, lack=amcl),
        finding("hint", "/a", 2, lack=nav),
        finding("hint", "/b", 3, lack=nav),
        finding("hint", "/b", 3, lack=Lack("variable", "ROBOT")),
        finding("error", "/b", 4, "wrong"),
    ]
    report = Report.of(given, {}, Coverage(2, 1, {"none": 2, "trace": 1}), ["There is no rospy."])
    assert to_text(report) == (
        "only 1 of 2 launch files evaluated as a whole: findings of the others are missing\n\n"
        "what 2 of 3 nodes do is unknown: findings of their topics and parameters are missing\n\n"
        "/b:1:1: error ABC001 n: wrong\n\n"
        "missing on this machine:\n"
        "  2 packages: nav (2), amcl\n"
        "  1 environment variable: ROBOT\n"
        "  There is no rospy.\n"
        "    apt install amcl nav\n\n"
        "1 error; 1 of 2 launch files evaluated, 3 nodes: 1 run, 2 unknown\n"
    )
    data = to_json(report)
    assert [f["message"] for f in data["findings"]] == ["wrong"]
    environment = data["environment"]
    assert (environment["complete"], environment["commands"]) == (False, ["apt install amcl nav"])
    assert environment["problems"] == ["There is no rospy."]
    assert [(each["kind"], each["name"], each["count"]) for each in environment["missing"]] == [
        *(("package", "nav", 2), ("package", "amcl", 1), ("variable", "ROBOT", 1))
    ]
    assert environment["missing"][0]["first"]["file"] == "/a"


def test_one_cause_in_several_places_is_shown_once() -> None:
    same = [finding("error", f"/{n}.launch", 1, "package 'p' is not known") for n in range(8)]
    text = to_text(Report.of(same, {}, Coverage()))
    assert text.count("error ABC001") == 1
    assert text.count("the same here") == 5
    assert "  and in 2 more places\n" in text
    assert text.endswith("1 error; 0 of 0 launch files evaluated, 0 nodes\n"), "counted as shown"


def test_programs_get_one_finding_for_each_cause() -> None:
    gone = "there is no '/map'"
    same = [replace(finding("error", f"/{n}.launch", 1, gone), roots=(f"/{n}.launch",)) for n in range(8)]
    report = Report.of([*same, finding("error", "/0.launch", 1, "other")], {}, Coverage())
    first, other = to_json(report)["findings"]
    assert [related["file"] for related in first["related"]] == [f"/{n}.launch" for n in range(1, 8)]
    assert first["roots"] == [f"/{n}.launch" for n in range(8)]
    assert (other["message"], other["related"]) == ("other", [])
    assert to_json(report)["rules"] == {"ABC001": {"error": 2}}


def test_text_and_json_count_alike() -> None:
    """Causes: a place more is no finding more. What is alike is named one by one, and counted so."""
    two = [finding("warning", file, 1, "'/map' is not there") for file in ("/a", "/b")]
    there = (Related("there", location("/d", 1, 2)),)
    pair = [
        replace(finding("info", "/c", 1, "'/x' here"), related=there),
        replace(finding("info", "/d", 1, "'/x' there"), related=(Related("there", location("/c", 1, 2)),)),
    ]
    many = [replace(finding("error", "/e", n, f"'{n}' is odd"), alike=Alike(say("are odd"), str(n))) for n in range(12)]
    report = Report.of([*two, *pair, *many, finding("hint", "/f", 1)], {}, Coverage())
    for severity, said in (
        ("hint", "12 errors, 1 warning, 1 info, 1 hint; "),
        ("info", "12 errors, 1 warning, 1 info (1 hint not shown: --severity hint); "),
        ("error", "12 errors (1 warning, 1 info, 1 hint not shown: --severity hint); "),
    ):
        shown = report.at_least(severity)
        counted = said.partition(" (")[0].rstrip("; ")
        assert f"\n\nABC001 n: {counted}\n\n{said}" in to_text(shown)
        data = to_json(shown)
        of_each = Counter(found["severity"] for found in data["findings"])
        assert data["rules"] == {"ABC001": of_each}
        assert ", ".join(f"{n} {s}{'s' if n > 1 else ''}" for s, n in of_each.items()) == counted


def test_how_much_of_a_launch_is_known_is_no_part_of_the_cause() -> None:
    said = "'/scan' has no publisher{aside}; did you mean '/scans'?"
    same = [finding("warning", f"/{n}.launch", 1, say(said, aside=f"; {n} of 9 nodes")) for n in range(3)]
    assert len(to_json(Report.of(same, {}, Coverage()))["findings"]) == 1


def test_what_names_nothing_is_of_one_cause_in_one_file() -> None:
    given = [finding("warning", file, at, "no effect in <include>") for file in ("/a", "/b") for at in (1, 5)]
    assert [f["file"] for f in to_json(Report.of(given, {}, Coverage()))["findings"]] == ["/a", "/b"]


def test_findings_that_point_at_each_other_have_one_cause() -> None:
    def pointing(file: str, to: str, message: str, rule: str = "ABC001") -> Finding:
        related = (Related("there", location(to, 1, 2)),)
        return replace(finding("warning", file, 1, message, rule=rule), related=related)

    key, use = pointing("/a.yaml", "/b.launch", "key"), pointing("/b.launch", "/a.yaml", "use")
    report = Report.of([key, use, pointing("/b.launch", "/a.yaml", "of another rule", "ABC002")], {}, Coverage())
    assert [f["message"] for f in to_json(report)["findings"]] == ["key", "of another rule"]
    assert "the same here" not in to_text(report)
    one_way = Report.of([finding("warning", "/a.yaml", 1, "key"), use], {}, Coverage())
    assert [f["message"] for f in to_json(one_way)["findings"]] == ["key", "use"]


def test_many_findings_are_counted_by_rule() -> None:
    given = [finding("error", "/a", n, f"m{n}") for n in range(10)]
    given.append(finding("warning", "/a", 20, rule="ABC002"))
    text = to_text(Report.of(given, {}, Coverage()))
    assert "\n\nABC001 n: 10 errors\nABC002 n: 1 warning\n\n" in text
    assert "ABC001 n: 1" not in to_text(Report.of(given[:10], {}, Coverage()))


def test_what_was_not_looked_at_is_named() -> None:
    nodes = tuple(f"/n{number}" for number in range(12))
    coverage = Coverage(2, 1, {"none": 12}, not_evaluated=("/ws/launch/a.launch",), unknown_nodes=nodes)
    report = Report.of([], {}, coverage)
    text = to_text(report, base="/ws")
    assert "not looked at:\n  launch files that were not evaluated as a whole: launch/a.launch\n" in text
    assert "  what these nodes do: /n0, /n1, " in text
    assert "/n9 and 2 more\n" in text
    assert text.endswith("1 of 2 launch files evaluated, 12 nodes: 12 unknown\n")
    looked_at = to_json(report)["coverage"]
    assert looked_at["not_evaluated"] == ["/ws/launch/a.launch"]
    assert looked_at["unknown_nodes"] == [*nodes]
    assert "not looked at" not in to_text(Report.of([], {}, Coverage(1, 1, {"trace": 1})))


MANY = """
    //- /pump.launch.xml
    <launch>
      <node pkg="p" exec="pump" name="pump"><param from="/pump.yaml"/></node>
    </launch>
    //- /pump.yaml
    pump:
      ros__parameters:
        max_presure: 4.5
        valve: left
        colour: red
        owner: nobody
        flow: 2.0
        spare: 1
        last: true
    //- interfaces
    {"/pump": {"params": {"~max_pressure": 6.0}}}
"""


def test_many_findings_that_are_alike_are_one() -> None:
    report = report_of(MANY)
    assert len(report.findings) == 7
    slip, many = by_cause(report.findings)
    assert slip.message.startswith("parameter 'max_presure' is not declared by /pump")
    assert many.message == (
        "6 parameters are not declared by /pump; their values are ignored: 'valve', 'colour', 'owner', 'flow', 'spare' "
        "and 1 more"
    )
    also = [each.message for each in many.related if each.location.file == "/pump.yaml"]
    assert also == [f"'{name}': the same here" for name in ("colour", "owner", "flow", "spare", "last")]
    text = to_text(report)
    assert text.count(" PRM013 ") == 2
    assert "6 parameters are not declared" in text and "/pump.yaml:9:5: 'last': the same here" in text


def test_names_that_one_file_lacks_are_one_finding_wherever_they_are() -> None:
    def lacking(name: str, file: str, mended_in: str = "/p/package.xml") -> Finding:
        return replace(finding("info", file, 1, f"'{name}' lacks"), alike=Alike(say("names lack"), name, mended_in))

    found = [lacking("a", "/p/1"), lacking("b", "/p/2"), lacking("a", "/p/3"), lacking("a", "/q/1", "/q/package.xml")]
    several, single = by_cause(found)
    assert several.message == "2 names lack: 'a', 'b'"
    assert [each.location.file for each in several.related] == ["/p/2", "/p/3"]
    assert single.message == "'a' lacks"


def test_programs_get_each_of_them() -> None:
    assert len(to_json(report_of(MANY))["findings"]) == 7


_LEFT_OUT = ("owner", "flow:", "spare", "last:")


def test_a_few_of_them_stay_apart() -> None:
    text = "".join(line for line in MANY.splitlines(keepends=True) if line.strip()[:5] not in _LEFT_OUT)
    messages = [each.message for each in by_cause(report_of(text).findings)]
    assert [message.split("'")[1] for message in messages] == ["max_presure", "valve", "colour"]
