"""`check`: findings, their JSON, the exit codes, and what runs."""

from __future__ import annotations

import contextlib
import json
import os
import pty
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any
from urllib.parse import quote
from xml.etree import ElementTree

import jsonschema
import pytest
from support.editor_harness import Harness
from support.sarif_schema import SARIF_SCHEMA

pytestmark = pytest.mark.ros
Run = Callable[..., Any]

TWO_WARNINGS = '<launch>\n  <nod/>\n  <node pkg="preflight_demo" type="talker.py" name="a" colour="red"/>\n</launch>\n'


def test_the_demo_in_text(harness: Harness, preflight: Run) -> None:
    done = preflight("check", harness.launch_file)
    assert done.code == 0, "a warning is below the default --fail-on"
    assert "launch/talker_listener.launch:7:31: warning (likely) TOP001 subscribed-not-published: " in done.out
    assert '  7 |     <remap from="chatter" to="chater"/>\n    |                               ^^^^^^\n' in done.out
    assert "fix: Replace 'chater' with 'chatter'" in done.out
    assert "2 nodes: 2 run" in done.out
    assert "\x1b" not in done.out, "no colours in a pipe"
    assert done.err == ""


def test_the_demo_in_json(harness: Harness, preflight: Run) -> None:
    data = preflight("check", "launch/talker_listener.launch", "--format", "json").json
    assert set(data) == {
        *("schema", "findings", "failures", "rules", "environment", "coverage", "files", "nodes", "traced"),
    }
    assert data["coverage"] == {
        **{"files": 1, "evaluated": 1, "not_evaluated": [], "untried": 0},
        **{"nodes": 2, "sources": {"trace": 2}, "unknown_nodes": [], "other_files": 0},
    }
    assert (data["schema"], data["files"], data["nodes"], data["traced"]) == ("ros-preflight/check/1", 1, 2, 2)
    (finding,) = data["findings"]
    assert set(finding) == {
        *("rule", "name", "severity", "confidence", "message"),
        *("file", "range", "related", "roots", "fixes"),
        *("effect", "kind", "subject", "node", "candidates", "doubts"),
    }
    assert (finding["rule"], finding["name"]) == ("TOP001", "subscribed-not-published")
    assert finding["file"] == str(harness.launch_file)
    assert finding["range"] == {"start": {"line": 7, "column": 31}, "end": {"line": 7, "column": 37}}
    assert finding["roots"] == [str(harness.launch_file)]
    assert finding["related"][0]["file"] == str(harness.launch_file)
    assert finding["fixes"] == ["Replace 'chater' with 'chatter'"]


def test_the_mended_demo_is_clean(harness: Harness, preflight: Run) -> None:
    done = preflight("check", harness.launch_file.with_name("fixed.launch"), "--fail-on", "hint")
    assert (done.code, done.out) == (0, "no findings; 1 of 1 launch file evaluated, 2 nodes: 2 run\n")


def test_no_run_executes_nothing(harness: Harness, preflight: Run) -> None:
    done = preflight("check", harness.launch_file, "--no-run", "--format", "json")
    from_source, not_run = done.json["findings"]
    assert not_run["rule"] == "TRC004"
    assert "--no-run" in not_run["message"]
    assert [from_source[key] for key in ("rule", "severity", "confidence")] == ["TOP001", "warning", "possible"]
    assert "from its source" in from_source["related"][0]["message"]
    assert done.json["traced"] == 0
    assert harness.sandbox_starts() == 0


def test_no_run_takes_what_an_earlier_run_told_that_still_holds(harness: Harness, preflight: Run) -> None:
    before = preflight("check", harness.launch_file, "--format", "json").json
    starts = harness.sandbox_starts()
    assert preflight("check", harness.launch_file, "--no-run", "--format", "json").json == before
    harness.launch_file.write_text(harness.launch_file.read_text().replace('value="5"', 'value="6"'))
    changed = preflight("check", harness.launch_file, "--no-run", "--format", "json").json
    assert changed["traced"] == 1, "the talker reads the rate"
    (not_run,) = [f for f in changed["findings"] if f["rule"] == "TRC004"]
    assert "not run: /talker; --no-run was given" in not_run["message"]
    assert harness.sandbox_starts() == starts


@pytest.mark.parametrize(
    ("fail_on", "code"), [("error", 0), ("warning", 1), ("info", 1), ("hint", 1), ("never", 0), (None, 0)]
)
def test_fail_on(harness: Harness, preflight: Run, fail_on: str | None, code: int) -> None:
    harness.launch_file.write_text(TWO_WARNINGS)
    options = ["--fail-on", fail_on] if fail_on else []
    assert preflight("check", harness.launch_file, "--no-run", *options).code == code


def test_an_error_is_exit_code_1(harness: Harness, preflight: Run) -> None:
    harness.launch_file.write_text("<launch><param name='x' value='$(arg y)'/></launch>")
    assert preflight("check", harness.launch_file, "--no-run").code == 1
    assert preflight("check", harness.launch_file, "--no-run", "--fail-on", "never").code == 0


def test_what_is_missing_here_counts_where_that_is_asked_for(harness: Harness, preflight: Run) -> None:
    harness.launch_file.write_text("<launch><node pkg='slam_toolbox' type='t' name='n'/></launch>")
    check = ("check", harness.launch_file, "--no-run", "--fail-on", "warning")
    done = preflight(*check)
    assert done.code == 0
    assert "missing on this machine:\n  1 package: slam_toolbox\n" in done.out
    assert "PKG001" not in done.out
    assert preflight(*check, "--require-complete").code == 1
    harness.launch_file.write_text("<launch/>")
    assert preflight(*check, "--require-complete").code == 0


def test_what_is_less_severe_can_be_hidden(harness: Harness, preflight: Run) -> None:
    harness.launch_file.write_text(TWO_WARNINGS)
    check = ("check", harness.launch_file, "--no-run", "--fail-on", "info")
    done = preflight(*check, "--severity", "warning")
    assert " info " not in done.out
    assert "2 warnings (1 info, 1 hint not shown: --severity hint); " in done.out
    done = preflight(*check, "--severity", "error", "--format", "json")
    assert (done.code, done.json["findings"]) == (1, []), "what is hidden still counts"


def test_launch_arguments_may_stand_anywhere(harness: Harness, preflight: Run) -> None:
    harness.launch_file.write_text("<launch><arg name='x'/><param name='p' value='$(arg x)'/><arg name='y'/></launch>")
    assert preflight("check", harness.launch_file, "--no-run", "--fail-on", "info").code == 1
    assert preflight("check", harness.launch_file, "x:=1", "--no-run", "y:=a:=b", "--fail-on", "info").code == 0


def test_package_path_means_there_and_nowhere_else(harness: Harness, preflight: Run, tmp_path: Path) -> None:
    options = ("--no-run", "--format", "json")
    done = preflight("check", harness.launch_file, "--package-path", tmp_path / "nothing", *options)
    assert done.json["environment"]["missing"] == []
    assert {f["rule"] for f in done.json["findings"]} == {"TRC004", "PKG001"}
    done = preflight(
        "check", harness.launch_file, "--package-path", f"{tmp_path / 'nothing'}:{harness.workspace}", *options
    )
    assert [f["rule"] for f in done.json["findings"]] == ["TOP001", "TRC004"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["missing.launch"], "missing.launch does not exist"),
        (["launch/talker_listener.launch", "speed"], "speed does not exist"),
        (["launch/talker_listener.launch", ":=3"], "':=3' is not of the form name:=value"),
        (["launch/talker_listener.launch", "--nonsense"], "--nonsense"),
        (["launch/talker_listener.launch", "--fail-on", "perhaps"], "perhaps"),
    ],
)
def test_what_cannot_be_done_is_exit_code_2(preflight: Run, arguments: list[str], message: str) -> None:
    done = preflight("check", *arguments)
    assert done.code == 2
    assert message in done.err
    assert done.out == ""


@pytest.mark.parametrize("content", [b"", b"\x89PNG\r\n\x1a\n\0", b"<launch>" * 3, b" " * (5 << 20)])
def test_bad_files_are_findings(harness: Harness, preflight: Run, content: bytes) -> None:
    harness.launch_file.write_bytes(content)
    done = preflight("check", harness.launch_file, "--format", "json")
    assert done.code == 1
    assert done.json["findings"]
    assert harness.sandbox_starts() <= 1, "at most the probe"


def test_a_file_that_is_included_twice_is_told_of_once(harness: Harness, preflight: Run) -> None:
    inner = harness.workspace / "inner.launch"
    inner.write_text('<launch>\n  <arg name="id"/>\n  <include file="$(dirname)/$(arg id).launch"/>\n</launch>\n')
    include = '  <include file="$(dirname)/inner.launch"><arg name="id" value="{}"/></include>\n'
    outer = harness.workspace / "outer.launch"
    outer.write_text("<launch>\n" + "".join(include.format(name) for name in ("north", "south")) + "</launch>\n")
    (finding,) = preflight("check", outer, "--no-run", "--format", "json").json["findings"]
    assert (finding["rule"], finding["file"], finding["roots"]) == ("LCH013", str(inner), [str(outer)])
    related = [(r["message"].split(":")[0], r["file"], r["range"]["start"]["line"]) for r in finding["related"]]
    assert related == [("included here", str(outer), 2), ("in another context", str(outer), 3)]


def test_what_is_wrong_with_the_settings_is_a_finding(harness: Harness, preflight: Run) -> None:
    settings = harness.workspace / ".ros-preflight.yaml"
    settings.write_text("external:\n  topic: [/a]\n")
    fixed = harness.launch_file.with_name("fixed.launch")
    done = preflight("check", fixed, "--no-run", "--fail-on", "warning")
    assert done.code == 1
    assert ".ros-preflight.yaml:2:3: warning LCH031 settings-file: unknown key 'topic'" in done.out
    assert "  2 |   topic: [/a]\n    |   ^^^^^^^^^^^\n" in done.out
    assert preflight("check", fixed, "--no-run").code == 0, "a warning is below the default --fail-on"
    (finding,) = [
        f for f in preflight("check", fixed, "--no-run", "--format", "json").json["findings"] if f["rule"] == "LCH031"
    ]
    assert (finding["file"], finding["range"]["start"]) == (str(settings), {"line": 2, "column": 3})


def test_sarif_junit_and_github(harness: Harness, preflight: Run) -> None:
    run = json.loads(preflight("check", harness.launch_file, "--format", "sarif").out)
    jsonschema.validate(run, SARIF_SCHEMA)
    (result,) = run["runs"][0]["results"]
    assert result["ruleId"] == "TOP001"
    assert result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == "launch/talker_listener.launch"
    done = preflight("check", harness.launch_file, "--format", "junit", "--fail-on", "warning")
    assert done.code == 1
    (failure,) = ElementTree.fromstring(done.out).iter("failure")
    assert str(failure.get("message")).startswith("'/chater' has no publisher")
    out = preflight("check", harness.launch_file, "--format", "github").out
    assert out.startswith(
        "::warning file=launch/talker_listener.launch,line=7,endLine=7,col=31,endColumn=37,title=TOP001"
    )


@pytest.mark.parametrize(
    ("environment", "coloured"),
    [({"TERM": "xterm"}, True), ({"TERM": "xterm", "NO_COLOR": "1"}, False), ({"TERM": "dumb"}, False)],
)
def test_colours_on_a_terminal_only(harness: Harness, environment: dict[str, str], coloured: bool) -> None:
    plain = {"FORCE_HYPERLINK": "0", **environment}
    out = on_terminal([str(harness.server), "check", str(harness.launch_file), "--no-run"], harness, plain)
    assert ("\x1b[33mwarning (possible) TOP001" in out) == coloured
    assert ("\x1b[33m^^^^^^\x1b[0m" in out) == coloured
    assert "talker_listener.launch:7:31" in out
    assert ("\r\x1b[K[....................] 0/1 launch/talker_listener.launch" in out) == (
        environment["TERM"] == "xterm"
    )
    assert ("\r\x1b[Klaunch/talker_listener.launch:7:31: " in out) == (environment["TERM"] == "xterm")


@pytest.mark.parametrize(
    ("environment", "linked"),
    [
        ({"TERM": "xterm"}, True),
        ({"TERM": "xterm", "FORCE_HYPERLINK": "0"}, False),
        ({"TERM": "xterm", "NO_COLOR": "1"}, False),
        ({"TERM": "linux"}, False),
    ],
)
def test_links_to_files_on_a_terminal_only(harness: Harness, environment: dict[str, str], linked: bool) -> None:
    odd = harness.launch_file.with_name("a b%.launch")
    harness.launch_file.rename(odd)
    out = on_terminal([str(harness.server), "check", str(odd), "--no-run"], harness, environment)
    place = "launch/a b%.launch:7:31"
    link = f"\x1b]8;;file://{os.uname().nodename}{quote(str(odd))}\x1b\\{place}\x1b]8;;\x1b\\: "
    assert (link in out, "\x1b]8;" in out) == (linked, linked)
    assert place in out


def test_a_terminal_shows_which_nodes_are_run(harness: Harness) -> None:
    command = [str(harness.server), "check", str(harness.launch_file), "--jobs", "1"]
    out = on_terminal(command, harness, {"TERM": "xterm", "COLUMNS": "200"})
    shown = [line for line in out.split("\r\x1b[K") if line.startswith("[")]
    assert any("running /talk" in line for line in shown)
    assert any("1 of 2 nodes, running" in line for line in shown)
    graph = on_terminal([str(harness.server), "graph", str(harness.launch_file), "--no-run"], harness, {"TERM": "dumb"})
    assert "[..." not in graph


def on_terminal(command: list[str], harness: Harness, environment: dict[str, str]) -> str:
    """What a command shows on a terminal, on either stream."""
    ours, its = pty.openpty()
    process = subprocess.Popen(
        command, stdout=its, stderr=its, cwd=harness.workspace, env={**harness.environment, **environment}
    )
    os.close(its)
    shown = b""
    with contextlib.suppress(OSError):  # the other end is closed
        while chunk := os.read(ours, 1 << 16):
            shown += chunk
    os.close(ours)
    assert process.wait(60) == 0
    return shown.decode()


def test_a_crash_stands_behind_its_cause(tmp_path: Path, preflight: Run) -> None:
    """The type of a parameter is told at its value, and the crash that it leads to with that."""
    share = tmp_path / "pump"
    share.mkdir()
    manifest = "<package><name>pump</name><export><build_type>ament_cmake</build_type></export></package>"
    (share / "package.xml").write_text(manifest)
    (share / "CMakeLists.txt").write_text("install(PROGRAMS pump.py DESTINATION lib/${PROJECT_NAME})\n")
    (share / "pump.py").write_text(
        "#!/usr/bin/env python3\nimport rclpy\nrclpy.init()\nnode = rclpy.create_node('pump')\n"
        "node.declare_parameter('rate', 10.0)\nrclpy.spin(node)\n"
    )
    (share / "pump.py").chmod(0o755)
    launch = share / "a.launch.xml"
    launch.write_text(
        '<launch><node pkg="pump" exec="pump.py" name="pump"><param name="rate" value="5"/></node></launch>'
    )
    findings = preflight("check", launch, "--format", "json", cwd=tmp_path).json["findings"]
    (finding,) = [each for each in findings if each["severity"] in ("error", "warning") or each["rule"] == "TRC001"]
    assert (finding["rule"], finding["severity"]) == ("PRM014", "error")
    assert any(each["message"].startswith("/pump crashes on start: Trying to set") for each in finding["related"])
