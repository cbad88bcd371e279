"""The pre-commit hook and the GitHub action do what they say, with the command as installed."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml
from support.editor_harness import Harness

pytestmark = pytest.mark.ros
ROOT = Path(__file__).resolve().parents[2]
Run = Callable[..., Any]


def load(path: str) -> Any:
    return yaml.safe_load((ROOT / path).read_text())


def test_the_hook_checks_what_the_commit_matters_to(harness: Harness, preflight: Run) -> None:
    (hook,) = load(".pre-commit-hooks.yaml")
    assert (hook["id"], hook["language"], hook["pass_filenames"]) == ("ros-preflight", "python", False)
    for name in ("a.launch", "a.launch.py", "x/a_launch.yaml", ".ros-preflight.yaml", "package.xml", "CMakeLists.txt"):
        assert re.search(hook["files"], name), name
    assert not re.search(hook["files"], "README.md")
    command = [*shlex.split(hook["entry"])[1:], *hook["args"]]
    identity = ["-c", "user.name=a", "-c", "user.email=a@b"]
    for arguments in (["init"], ["add", "."], [*identity, "commit", "-m", "first"]):
        subprocess.run(
            ["git", *arguments], cwd=harness.workspace, env=harness.environment, check=True, capture_output=True
        )
    assert "0 of 0 launch files" in preflight(*command).out
    harness.launch_file.write_text("<launch><param name='x' value='$(arg y)'/></launch>")
    done = preflight(*command)
    assert (done.code, "1 of 1 launch file evaluated" in done.out) == (1, True)
    assert harness.sandbox_starts() == 0


def action_step(harness: Harness, folder: Path, **inputs: str) -> subprocess.CompletedProcess[str]:
    """The last step of the action, as a runner calls it."""
    *_, step = load("action.yml")["runs"]["steps"]
    program = folder / "ros-preflight" / "bin" / "ros-preflight"
    program.parent.mkdir(parents=True, exist_ok=True)
    program.unlink(missing_ok=True)
    program.symlink_to(harness.server)
    given = dict.fromkeys(step["env"], "") | inputs
    return subprocess.run(
        ["bash", "--noprofile", "--norc", "-e", "-o", "pipefail", "-c", step["run"]],
        cwd=harness.workspace,
        env={**harness.environment, "RUNNER_TEMP": str(folder), **given},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )


def test_the_action_writes_annotations_and_sarif(harness: Harness, tmp_path: Path) -> None:
    (harness.workspace / "setup.bash").write_text("export SAID_BY_SETUP=$UNSET_BEFORE\n")
    arguments = "launch/talker_listener.launch\n--fail-on warning"
    done = action_step(harness, tmp_path / "runner", ARGUMENTS=arguments, SETUP="./setup.bash", SARIF_FILE="out.sarif")
    assert (done.returncode, done.stderr) == (1, "")
    assert done.stdout.startswith("::warning file=launch/talker_listener.launch,line=7,")
    assert '"version": "2.1.0"' in (harness.workspace / "out.sarif").read_text()
    assert os.listdir(tmp_path / "runner" / "ros-preflight-cache")


def test_the_action_without_inputs_checks_the_workspace(harness: Harness, tmp_path: Path) -> None:
    done = action_step(harness, tmp_path / "runner")
    assert (done.returncode, done.stderr) == (0, "")
    assert "2 of 2 launch files" in done.stdout


def test_nothing_that_is_given_is_run_as_a_script() -> None:
    action = load("action.yml")
    assert all("${{" not in step.get("run", "") for step in action["runs"]["steps"])
    assert {name.upper().replace("-", "_") for name in action["inputs"]} >= set(action["runs"]["steps"][-1]["env"])
