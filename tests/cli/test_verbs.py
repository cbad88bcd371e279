"""`graph`, `trace`, `rules`, `doctor`, `lsp`, and what all of the command has in common."""

from __future__ import annotations

import json
import os
import signal
import subprocess
from collections.abc import Callable
from typing import Any

import pytest
from preflight_analysis.rules.registry import all_rules
from support.editor_harness import Harness
from support.waiting import until

pytestmark = pytest.mark.ros
Run = Callable[..., Any]


def test_graph_in_json(harness: Harness, preflight: Run) -> None:
    data = preflight("graph", harness.launch_file, "--format", "json").json
    assert set(data) == {"schema", "nodes", "topics", "services", "actions"}
    assert data["schema"] == "ros-preflight/graph/1"
    talker, listener = data["nodes"]
    assert set(talker) == {
        *("name", "package", "executable", "interface_source", "outcome", "publishers", "subscribers"),
        *("services", "clients", "action_servers", "action_clients", "params_read"),
    }
    assert (talker["name"], talker["interface_source"], talker["outcome"]) == ("/talker", "trace", "spinning")
    own = [end for end in talker["publishers"] if not end.get("builtin")]
    assert [(end["name"], end["type"], end["qos"]["queue_size"]) for end in own] == [
        ("/chatter", "std_msgs/String", 10)
    ]
    assert {"name": "/talker/rate", "default": 10, "mandatory": False} in talker["params_read"]
    assert [end["name"] for end in listener["subscribers"] if not end.get("builtin")] == ["/chater"], "a final name"
    assert data["topics"]["/chatter"] == {"types": ["std_msgs/String"], "publishers": ["/talker"], "subscribers": []}
    assert data["topics"]["/rosout"]["builtin"] is True
    assert {end["name"] for end in talker["services"]} == {"/talker/get_loggers", "/talker/set_logger_level"}
    assert all(end["builtin"] for end in talker["services"])


def test_graph_in_text(harness: Harness, preflight: Run) -> None:
    done = preflight("graph", harness.launch_file)
    assert (done.code, done.err) == (0, "")
    assert "topic /chatter  std_msgs/String  /talker -> none" in done.out
    assert "/rosout" not in done.out


def test_graph_without_runs_has_what_annotations_and_sources_tell(harness: Harness, preflight: Run) -> None:
    harness.launch_file.write_text(
        '<launch><node pkg="preflight_demo" type="talker.py" name="a">'
        '<topics><topic name="t" type="std_msgs/String" class="pub"/></topics></node>'
        '<node pkg="preflight_demo" type="listener.py" name="b"/></launch>'
    )
    data = preflight("graph", harness.launch_file, "--no-run", "--format", "json").json
    assert [(n["interface_source"], n["outcome"]) for n in data["nodes"]] == [
        ("annotation", "not-run"),
        ("source", "not-run"),
    ]
    assert data["topics"] == {
        "/chatter": {"types": ["std_msgs/String"], "publishers": [], "subscribers": ["/b"]},
        "/t": {"types": ["std_msgs/String"], "publishers": ["/a"], "subscribers": []},
    }
    assert harness.sandbox_starts() == 0


def test_graph_in_pictures(harness: Harness, preflight: Run) -> None:
    begins = {
        "dot": "digraph ros {\n",
        "mermaid": "flowchart LR\n",
        "svg": '<svg xmlns="http://www.w3.org/2000/svg"',
        "html": "<!doctype html>\n",
    }
    for format_, begin in begins.items():
        done = preflight("graph", harness.launch_file, "--format", format_)
        assert (done.code, done.err) == (0, "")
        assert done.out.startswith(begin)
        assert "/chatter" in done.out
        assert ("/rosout" in done.out) is (format_ == "html"), "the page has a switch"
    assert "/rosout" in preflight("graph", harness.launch_file, "--format", "svg", "--builtin").out


def test_trace_in_json(harness: Harness, preflight: Run) -> None:
    data = preflight("trace", harness.launch_file, "--format", "json").json
    assert data["schema"] == "ros-preflight/trace/1"
    talker, listener = data["nodes"]
    (endpoint,) = [e for e in listener["endpoints"] if not e["builtin"]]
    assert (endpoint["role"], endpoint["name"], endpoint["type"]) == ("subscriber", "chatter", "std_msgs/String")
    assert endpoint["source"]["file"].endswith("scripts/listener.py")
    assert (talker["outcome"]["status"], talker["cached"]) == ("spinning", False)
    assert preflight("trace", harness.launch_file, "--format", "json").json["nodes"][0]["cached"] is True


def test_like_nodes_in_other_namespaces_are_run_once(harness: Harness, preflight: Run) -> None:
    path = harness.launch_file.with_name("fleet.launch")
    node = '<node pkg="preflight_demo" type="talker.py" name="talker_{0}" ns="robot_{0}"/>'
    path.write_text(f"<launch>{''.join(map(node.format, range(6)))}</launch>")
    done = preflight("trace", path, "--jobs", "3", "--format", "json")
    assert [node["name"] for node in done.json["nodes"]] == [f"/robot_{n}/talker_{n}" for n in range(6)]
    assert {node["outcome"]["status"] for node in done.json["nodes"]} == {"spinning"}
    assert harness.sandbox_starts() == 3, "the probe, our own code to be compiled and one node"


def test_trace_of_one_node(harness: Harness, preflight: Run) -> None:
    done = preflight("trace", harness.launch_file, "--node", "listener")
    assert "subscriber chatter  std_msgs/String" in done.out
    assert "/talker" not in done.out
    assert harness.sandbox_starts() == 3, "the probe, our own code to be compiled and one node"
    done = preflight("trace", harness.launch_file, "--node", "speaker")
    assert done.code == 2
    assert "/talker, /listener" in done.err


def test_trace_says_how_a_node_crashed(harness: Harness, preflight: Run) -> None:
    script = harness.launch_file.parents[1] / "scripts/talker.py"
    script.write_text('#!/usr/bin/env python3\nraise RuntimeError("no laser here")\n')
    done = preflight("trace", harness.launch_file, "--node", "/talker")
    assert "crashed" in done.out
    assert "no laser here" in done.out


def test_rules_lists_all_and_explains_one(preflight: Run) -> None:
    listed = preflight("rules")
    assert [line.split()[0] for line in listed.out.splitlines()] == [rule.id for rule in all_rules()]
    data = preflight("rules", "--format", "json").json
    assert data["schema"] == "ros-preflight/rules/1"
    assert len(data["rules"]) == len(all_rules())
    page = preflight("rules", "top001")
    assert page.out.startswith("# TOP001 subscribed-not-published\n\n")
    assert "| warning | a connection, controller, plugin or description never comes about; " in page.out
    assert "## Why it matters" in page.out
    assert preflight("rules", "subscribed-not-published").out == page.out
    done = preflight("rules", "XXX001")
    assert (done.code, done.out) == (2, "")


def test_doctor(harness: Harness, preflight: Run) -> None:
    done = preflight("doctor")
    assert "sandbox" in done.out
    assert "works" in done.out
    data = preflight("doctor", harness.workspace, "--format", "json").json
    assert data["schema"] == "ros-preflight/doctor/1"
    assert data["packages"]["preflight_demo"] == str(harness.workspace)
    assert (data["sandbox"]["works"], data["sandbox"]["reason"]) == (True, None)
    assert "files read-only, no network, own processes" in data["sandbox"]["guarantees"]
    assert [row for row in data["sandbox"]["guarantees"] if row not in done.out] == []
    assert preflight("doctor", "nowhere").code == 2


def test_doctor_lists_what_check_misses(harness: Harness, preflight: Run) -> None:
    launch = harness.workspace / "launch" / "lacking.launch"
    launch.write_text('<launch><node pkg="turtlebot3_bringup" type="n" name="n"/></launch>')
    checked = preflight("check", "--format", "json", "--no-run", harness.workspace).json["environment"]
    names = {each["name"] for each in checked["missing"]}
    assert "turtlebot3_bringup" in names
    for place in (harness.workspace, launch):
        data = preflight("doctor", place, "--format", "json", "--no-run").json
        assert ({each["name"] for each in data["missing"]}, data["commands"]) == (names, checked["commands"])
    assert "turtlebot3_bringup" in preflight("doctor", harness.workspace).out


def test_doctor_says_why_there_is_no_sandbox(harness: Harness, preflight: Run) -> None:
    empty = harness.home / "empty"
    empty.mkdir()
    environment = {"PATH": str(empty), "ROS_PREFLIGHT_SANDBOX": "bubblewrap"}
    done = preflight("doctor", environment=environment)
    assert done.code == 1
    assert "bubblewrap is not installed" in done.out
    assert preflight("doctor", "--fail-on", "never", environment=environment).code == 0


def test_without_a_sandbox_check_runs_nothing_and_says_why(harness: Harness, preflight: Run) -> None:
    empty = harness.home / "empty"
    empty.mkdir()
    environment = {"PATH": str(empty), "ROS_PREFLIGHT_SANDBOX": "bubblewrap"}
    done = preflight("check", harness.launch_file, "--format", "json", environment=environment)
    from_source, finding = done.json["findings"]
    assert (finding["rule"], from_source["severity"]) == ("TRC004", "warning")
    assert "bubblewrap is not installed" in finding["message"]


def test_a_reader_that_has_enough_is_no_error(harness: Harness) -> None:
    with subprocess.Popen(
        [str(harness.server), "doctor", "--format", "json", "--no-run"],
        env=harness.environment,
        cwd=harness.workspace,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as process:
        assert process.stdout is not None
        process.stdout.close()
        assert process.stderr is not None
        assert process.stderr.read() == b""


def test_an_interrupt_ends_the_runs(harness: Harness) -> None:
    script = harness.launch_file.parents[1] / "scripts/talker.py"
    script.write_text("#!/usr/bin/env python3\nimport time\ntime.sleep(60)\n")
    with subprocess.Popen(
        [str(harness.server), "check", str(harness.launch_file)],
        env=harness.environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        # Tests that a shell started in the background inherit that the signal is ignored, and so would the command.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    ) as process:
        until(lambda: harness.sandbox_starts() >= 3)
        os.kill(process.pid, signal.SIGINT)
        out, err = process.communicate(timeout=50)  # the node sleeps for a minute
    assert (process.returncode, out, err) == (2, "", "ros-preflight: interrupted\n")
    until(lambda: harness.processes() == [])


def test_lsp_takes_what_editors_add(harness: Harness) -> None:
    body = json.dumps({"jsonrpc": "2.0", "method": "exit"}).encode()
    done = subprocess.run(
        [str(harness.server), "lsp", "--stdio", "--clientProcessId=1"],
        env=harness.environment,
        input=b"Content-Length: %d\r\n\r\n%s" % (len(body), body),
        capture_output=True,
        timeout=60,
        check=False,
    )
    assert (done.returncode, done.stdout) == (1, b""), "exit without shutdown"
    assert b"Traceback" not in done.stderr


@pytest.mark.parametrize(
    "verb", ["check", "tree", "graph", "trace", "snapshot", "diff", "watch", "capture", "rules", "doctor", "lsp"]
)
def test_every_verb_has_help(preflight: Run, verb: str) -> None:
    done = preflight(verb, "--help")
    assert done.code == 0
    assert verb in done.out
    assert ("--no-run" in done.out) == (verb != "lsp")


def test_help_says_that_running_is_consent(preflight: Run) -> None:
    assert "consent" in preflight("check", "--help").out


@pytest.mark.parametrize("arguments", [[], ["nonsense"], ["rules", "a:=b", "c:=d"]])
def test_bad_usage_is_exit_code_2(preflight: Run, arguments: list[str]) -> None:
    assert preflight(*arguments).code == 2


def test_a_launch_prefix_does_not_stand_in_the_way(harness: Harness, preflight: Run) -> None:
    harness.launch_file.write_text(
        '<launch><node pkg="preflight_demo" type="talker.py" name="a" launch-prefix="xterm -e gdb -ex run --args"/>'
        "</launch>"
    )
    (node,) = preflight("graph", harness.launch_file, "--format", "json").json["nodes"]
    assert (node["interface_source"], node["outcome"]) == ("trace", "spinning")
    without = "note: it was run without its launch-prefix 'xterm -e gdb -ex run --args'"
    assert without in preflight("trace", harness.launch_file).out
    harness.launch_file.write_text('<launch><node pkg="preflight_demo" type="talker.py" name="a"/></launch>')
    assert "note:" not in preflight("trace", harness.launch_file).out


def test_the_help_of_a_verb_has_its_own_exit_codes(preflight: Run) -> None:
    assert "findings at or above --fail-on" in preflight("check", "--help").out
    for verb in ("diff", "watch", "capture"):
        told = " ".join(preflight(verb, "--help").out.split())
        assert "--fail-on" not in told
        assert "Exit codes: 0 " in told


def test_only_the_file_is_required(preflight: Run) -> None:
    done = preflight("graph")
    assert done.code == 2
    assert done.err.endswith("the following arguments are required: FILE\n")
