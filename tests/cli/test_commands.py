"""Commands of parameters at the command line: run in the sandbox with consent, as roslaunch runs them."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml
from support.editor_harness import Harness
from support.xacro_package import create_robot

pytestmark = pytest.mark.ros
Run = Callable[..., Any]


@pytest.fixture
def robot(harness: Harness) -> Path:
    """The launch file of a robot that xacro describes."""
    return create_robot(harness.home / "robots")


def test_the_tree_has_what_roslaunch_would_set(harness: Harness, robot: Path, preflight: Run) -> None:
    robot.write_text(
        robot.read_text().replace(
            "</launch>",
            """
              <param name="auto" command="echo 7"/>
              <param name="text" type="str" command="echo 7"/>
              <param name="number" type="double" command="bash -c 'expr 1 + 2'"/>
              <param name="yes" command="printf true"/>
              <param name="settings" type="yaml" command="cat $(find arm)/urdf/sizes.yaml"/>
              <param name="script" command="python3 -c 'import os; print(os.getcwd(), os.environ[&quot;LANG&quot;])'"/>
              <node pkg="p" type="t" name="n" ns="ns"><param name="greeting" command="echo hello"/></node>
            </launch>""",
        )
    )
    environment = {**harness.environment, "PATH": "/usr/bin:/bin", "ROS_PACKAGE_PATH": str(harness.home / "robots")}
    real = subprocess.run(
        ["/usr/bin/roslaunch", "--dump-params", str(robot), "side:=left"],
        env=environment,
        cwd=harness.home / "robots",
        capture_output=True,
        text=True,
        check=True,
    )
    data = preflight("tree", robot, "side:=left", "--format", "json").json
    expected = yaml.safe_load(real.stdout)
    assert '<link length="0.25" name="left_thumb"/>' in expected["/robot_description"]
    assert data["errors"] == []
    params = data["params"]
    assert params == expected
    assert {name: type(value) for name, value in params.items()} == {n: type(v) for n, v in expected.items()}


def test_a_second_time_nothing_is_started(harness: Harness, robot: Path, preflight: Run) -> None:
    first = preflight("tree", robot, "--format", "json").json
    assert harness.sandbox_starts() == 3, "the probe, our own code to be compiled and one command"
    assert preflight("tree", robot, "--format", "json").json == first
    assert harness.sandbox_starts() == 3
    macros = robot.parents[1] / "urdf/macros.xacro"
    macros.write_text(macros.read_text().replace("link", "joint"))
    again = preflight("tree", robot, "--format", "json").json
    assert again["params"]["/robot_description"] == first["params"]["/robot_description"].replace("link", "joint")
    assert harness.sandbox_starts() == 5


def test_nothing_is_run_with_no_run_or_in_a_batch(harness: Harness, robot: Path, preflight: Run) -> None:
    line = f"{robot.parents[2]}/xacro/xacro {robot.parents[1]}/urdf/arm.xacro side:=right"
    data = preflight("tree", robot, "--no-run", "--format", "json").json
    assert data["params"] == {"/robot_description": {"command": line}}
    assert data["errors"] == []
    jobs = harness.home / "jobs.jsonl"
    jobs.write_text('{"file": "%s", "package_path": ["%s"]}\n' % (robot, robot.parents[2]))
    assert f'{{"command": "{line}"}}' in preflight("tree", "--batch", jobs).out
    done = preflight("check", robot, "--no-run", "--format", "json")
    (finding,) = done.json["findings"]
    assert (finding["rule"], finding["severity"]) == ("LCH018", "hint")
    assert "--no-run was given" in finding["message"]
    assert harness.sandbox_starts() == 0


def test_a_failing_command_is_an_error(harness: Harness, robot: Path, preflight: Run) -> None:
    (robot.parents[1] / "urdf/macros.xacro").write_text("<robot><link></robot>")
    done = preflight("check", robot, "--format", "json")
    finding, itself = (each for each in done.json["findings"] if each["severity"] != "info")
    assert (done.code, finding["rule"], finding["range"]["start"]["line"]) == (1, "PRM008", 3)
    assert (itself["rule"], Path(itself["file"]).name) == ("URD001", "macros.xacro")
    assert "the command failed: it ended with exit code 2; " in finding["message"]
    assert "macros.xacro" in finding["message"]
    data = preflight("tree", robot, "--format", "json").json
    assert [error["rule"] for error in data["errors"]] == ["PRM008"]
    assert data["params"] == {}


def test_nodes_get_the_value(harness: Harness, robot: Path, preflight: Run) -> None:
    script = robot.parents[1] / "reader.py"
    script.write_text(
        "#!/usr/bin/env python3\nimport rospy\nfrom std_msgs.msg import String\nrospy.init_node('n')\n"
        "rospy.Publisher('is_robot_%s' % rospy.get_param('/robot_description').count('<robot'), String, queue_size=1)\n"
        "rospy.spin()\n"
    )
    script.chmod(0o755)
    node = '<node pkg="arm" type="reader.py" name="n"/></launch>'
    robot.write_text(robot.read_text().replace("</launch>", node))
    topics = preflight("graph", robot, "--format", "json").json["topics"]
    assert topics["/is_robot_1"]["publishers"] == ["/n"]


def test_a_missing_program(harness: Harness, robot: Path, preflight: Run) -> None:
    robot.write_text(robot.read_text().replace("/xacro ", "/xacro.py "))
    for more in ((), ("--no-run",)):
        findings = preflight("check", robot, "--format", "json", *more).json["findings"]
        (finding,) = [f for f in findings if f["rule"] == "PRM008"]
        assert finding["message"].endswith("did you mean 'xacro'?")
        assert finding["fixes"] == ["Replace 'xacro.py' with 'xacro'"]


def test_a_long_value_is_cut_in_text(robot: Path, preflight: Run) -> None:
    (line,) = [s for s in preflight("tree", robot).out.splitlines() if "/robot_description" in s]
    assert line.startswith("  param /robot_description = '<?xml")
    assert line.endswith(" characters)")
    assert len(line) < 600
