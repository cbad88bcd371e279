"""`tree`: the contract's JSON, one file or many."""

from __future__ import annotations

import itertools
import json
import os
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from support.editor_harness import Harness

Run = Callable[..., Any]

LAUNCH = """<launch>
  <arg name="need"/>
  <arg name="rate" default="5"/>
  <env name="LEVEL" value="3"/>
  <remap from="a" to="/b"/>
  <rosparam command="load" file="$(dirname)/p.yaml" ns="cfg"/>
  <group ns="lab">
    <node pkg="preflight_demo" type="talker.py" name="t" args="-v $(arg need)" output="screen" respawn="true"
          respawn_delay="2.5">
      <param name="rate" value="$(arg rate)"/>
      <rosparam command="load" file="$(dirname)/p.yaml"/>
    </node>
  </group>
  <param name="text" command="date +%s"/>
  <param name="bytes" binfile="$(dirname)/b"/>
</launch>
"""
KEYS = {
    *("schema", "file", "generation", "args", "nodes", "params"),
    *("clear_params", "includes", "machines", "unknown", "errors"),
}
NODE_KEYS = {
    *("name", "namespace", "package", "executable", "kind", "container", "plugin", "args", "remaps", "env", "params"),
    *("param_files", "machine", "respawn", "respawn_delay", "required", "output", "cwd", "launch_prefix"),
    *("clear_params", "origin"),
}


@pytest.fixture
def launch(harness: Harness) -> Path:
    path = harness.launch_file.with_name("all.launch")
    path.write_text(LAUNCH)
    path.with_name("p.yaml").write_text("gain: 1.5\nlimits: {low: .inf, names: [a, größe]}\n")
    path.with_name("b").write_bytes(b"\0\1")
    return path


def test_the_contract(launch: Path, preflight: Run) -> None:
    data = preflight("tree", launch, "need:=x y", "--format", "json", "--no-run").json
    assert set(data) == KEYS
    assert data["schema"] == "ros-preflight/tree/1"
    assert (data["file"], data["generation"], data["errors"], data["includes"]) == (str(launch), 1, [], [])
    assert data["args"] == {
        "need": {"value": "x y", "default": None, "required": True},
        "rate": {"value": "5", "default": "5", "required": False},
    }
    (node,) = data["nodes"]
    assert set(node) == NODE_KEYS
    assert (node["name"], node["namespace"], node["kind"]) == ("/lab/t", "/lab/", "node")
    assert (node["args"], node["respawn"], node["respawn_delay"]) == ("-v x y", True, 2.5)
    assert (node["output"], node["container"], node["plugin"]) == ("screen", None, None)
    assert node["remaps"] == [["a", "/b"]]
    assert node["env"] == [["LEVEL", "3"]]
    assert node["param_files"] == [str(launch.with_name("p.yaml"))]
    assert node["origin"] == [{"file": str(launch), "line": 8, "column": 5}]
    assert node["params"]["rate"] == 5
    assert data["params"]["/lab/t/rate"] == 5
    assert data["params"]["/cfg/gain"] == 1.5
    assert data["params"]["/text"] == {"command": "date +%s"}
    assert data["params"]["/bytes"] == {"binary_sha1": "3f29546453678b855931c174a97d6c0894b8f546"}
    assert "größe" in json.dumps(data["params"], ensure_ascii=False)
    assert '"inf"' in json.dumps(data["params"]), "JSON has no infinity"


def test_an_error_is_what_would_stop_the_launcher(launch: Path, preflight: Run) -> None:
    launch.write_text('<launch><nod/><node pkg="p" type="t" name="$(arg x)"/></launch>')
    done = preflight("tree", launch, "--format", "json")
    assert done.code == 1
    (error,) = done.json["errors"]
    assert set(error) == {"rule", "message", "file", "line", "column"}
    assert (error["rule"], error["line"], error["file"]) == ("ARG001", 1, str(launch))
    assert preflight("tree", launch, "--format", "json", "--fail-on", "never").code == 0


def test_the_arguments_of_ros_2_are_read_as_ros2_launch_reads_them(tmp_path: Path, preflight: Run) -> None:
    """Names as they are, and values with `:=` in them, as remaps have; roslaunch leaves out both."""
    launch = tmp_path / "a.launch.xml"
    launch.write_text('<launch><arg name="_rules"/><log message="$(var _rules)"/></launch>')
    done = preflight("tree", launch, "_rules:=a:=b", "--format", "json")
    assert done.json["args"]["_rules"]["value"] == "a:=b"


def test_text(launch: Path, preflight: Run) -> None:
    done = preflight("tree", launch, "need:=1")
    assert "node /lab/t  preflight_demo/talker.py" in done.out
    assert "param rate = 5" in done.out
    assert "remap a -> /b" in done.out
    assert "from launch/all.launch:8:5\n" in done.out
    assert done.err == ""
    done = preflight("tree", launch)
    assert done.code == 1
    assert "need" in done.err


def test_a_batch_answers_each_job_in_order_from_its_own_environment(harness: Harness, preflight: Run) -> None:
    jobs = harness.workspace / "jobs.jsonl"
    launch = harness.workspace / "launch/env.launch"
    launch.write_text(
        '<launch><param name="a" value="$(optenv A none)"/><param name="home" value="$(env HOME)"/>'
        '<param name="x" value="$(arg x)"/><param name="at" value="$(find preflight_demo)"/></launch>'
    )
    given = [
        {"file": "launch/env.launch", "args": ["x:=$ROOT/x"], "env": {"A": "$ROOT"}, "package_path": ["."]},
        {"file": "launch/env.launch", "args": ["x:=1"], "package_path": ["launch", "$ROOT"]},
        {"file": "launch/env.launch", "args": ["x:=1"], "package_path": ["launch"]},
        {"file": "launch/missing.launch", "args": [], "env": {}, "package_path": ["."]},
    ]
    jobs.write_text("\n".join(json.dumps(job) for job in given) + "\n\n")
    done = preflight("tree", "--batch", jobs, "--no-run", cwd=harness.home, environment={"A": "of the process"})
    assert done.code == 0
    first, second, third, fourth = (json.loads(line) for line in done.out.splitlines())
    root = str(harness.workspace)
    assert {**first["params"]} == {"/a": root, "/home": "/home/robot", "/x": f"{root}/x", "/at": root}
    assert (second["params"]["/a"], second["params"]["/at"]) == ("none", root)
    assert [e["rule"] for e in third["errors"]] == ["PKG001"]
    assert [e["rule"] for e in fourth["errors"]] == ["LCH002"]
    assert all(list(each) == sorted(each) for each in (first, second, third, fourth))


COMMAND_XML = """<launch>
  <arg name="x" default="b"/>
  <node pkg="arm" exec="a">
    <param name="d" value="$(command 'cat $(find-pkg-share {package})/a.urdf')"/>
    <param name="e" value="$(command 'cat $(var {argument}).urdf')"/>
  </node>
</launch>
"""
COMMAND_PYTHON = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import Command, LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare
def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("x", default_value="b"),
        Node(package="arm", executable="a", parameters=[
            {{"d": Command(["cat ", FindPackageShare("{package}"), "/a.urdf"])}},
            {{"e": Command(["cat ", LaunchConfiguration("{argument}"), ".urdf"])}},
        ]),
    ])
"""


@pytest.mark.ros
@pytest.mark.parametrize(("name", "text"), [("a.launch.xml", COMMAND_XML), ("a.launch.py", COMMAND_PYTHON)])
@pytest.mark.parametrize(
    ("package", "argument", "rules"), [("arm", "x", []), ("amr", "x", ["PKG001"]), ("arm", "y", ["ARG001"])]
)
def test_a_batch_reports_what_a_command_cannot_be_made_of(
    tmp_path: Path, preflight: Run, name: str, text: str, package: str, argument: str, rules: list[str]
) -> None:
    prefix = tmp_path / "prefix"
    for folder in ("share/ament_index/resource_index/packages", "share/arm"):
        (prefix / folder).mkdir(parents=True)
    (prefix / "share/ament_index/resource_index/packages/arm").touch()
    (tmp_path / name).write_text(text.format(package=package, argument=argument))
    jobs = tmp_path / "jobs.jsonl"
    jobs.write_text(json.dumps({"file": name, "env": {"AMENT_PREFIX_PATH": "$ROOT/prefix"}}))
    done = preflight("tree", "--batch", jobs)
    (answer,) = map(json.loads, done.out.splitlines())
    assert [error["rule"] for error in answer["errors"]] == rules


SLOW = """
import time
from launch import LaunchDescription
from launch_ros.actions import Node
began = time.time()
time.sleep(2)  # in its sandbox it sees nothing of the others: all it can do is to take long
def generate_launch_description():
    times = f'{began} {time.time()}'
    return LaunchDescription([Node(package='arm', executable='a', name=NAME, parameters=[{'times': times}])])
"""


def test_a_batch_runs_python_launch_files_side_by_side(tmp_path: Path, preflight: Run) -> None:
    """Each in a sandbox of its own, and the answers come in the order of the jobs."""
    names = ("first", "second", "third")
    for name in names:
        (tmp_path / f"{name}.launch.py").write_text(SLOW.replace("NAME", repr(name)))
    (tmp_path / "jobs.jsonl").write_text("".join(json.dumps({"file": f"{n}.launch.py"}) + "\n" for n in names))
    done = preflight("tree", "--batch", tmp_path / "jobs.jsonl")
    nodes = [json.loads(line)["nodes"][0] for line in done.out.splitlines()]
    assert [node["name"] for node in nodes] == ["/first", "/second", "/third"]
    spans = sorted(tuple(map(float, node["params"]["times"].split())) for node in nodes)
    overlap = any(later[0] < earlier[1] for earlier, later in itertools.pairwise(spans))
    assert overlap == (len(os.sched_getaffinity(0)) > 1)


@pytest.mark.parametrize(
    ("line", "message"),
    [("{", "jobs.jsonl:2"), ("[]", "jobs.jsonl:2"), ('{"args": []}', "jobs.jsonl:2"), ('{"file": 3}', "jobs.jsonl:2")],
)
def test_a_line_that_is_no_job(harness: Harness, preflight: Run, line: str, message: str) -> None:
    jobs = harness.workspace / "jobs.jsonl"
    jobs.write_text(f"\n{line}\n")
    done = preflight("tree", "--batch", jobs)
    assert done.code == 2
    assert message in done.err


def test_batch_and_file_exclude_each_other(harness: Harness, preflight: Run) -> None:
    assert preflight("tree", harness.launch_file, "--batch", "jobs.jsonl").code == 2
    assert preflight("tree").code == 2
    assert preflight("tree", "--batch", "missing.jsonl").code == 2


def test_the_page(launch: Path, preflight: Run) -> None:
    done = preflight("tree", launch, "need:=x", "--format", "html", "--no-run")
    assert (done.code, done.err) == (0, "")
    assert done.out.startswith("<!doctype html>\n")
    assert "preflight_demo/talker.py" in done.out


def test_text_is_coloured_by_file_on_a_terminal_that_wants_it(harness: Harness) -> None:
    robot = harness.launch_file.with_name("robot.launch")
    robot.write_text(
        '<launch><include file="$(dirname)/talker_listener.launch"/>'
        '<node pkg="preflight_demo" type="talker.py" name="other"/></launch>'
    )

    def shown(**environment: str) -> str:
        # A terminal of its own, from util-linux.
        done = subprocess.run(
            ["script", "-qec", f"{harness.server} tree {robot} --no-run", "/dev/null"],
            env={**harness.environment, "TERM": "xterm", **environment},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=60,
            check=True,
        )
        return done.stdout

    coloured = shown()
    assert "\x1b[33m  node /talker  preflight_demo/talker.py\x1b[0m" in coloured
    assert "\x1b[34m  node /other  preflight_demo/talker.py\x1b[0m" in coloured
    assert "\x1b[" not in shown(NO_COLOR="1")
    assert "\x1b[" not in shown(TERM="dumb")


def test_text_holds_no_control_characters(harness: Harness, preflight: Run) -> None:
    harness.launch_file.write_text('<launch><node pkg="p" type="t" name="n" args="&#x9b;31m\x7f"/></launch>')
    assert "\x9b" not in preflight("tree", harness.launch_file, "--no-run").out
