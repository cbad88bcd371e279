"""`snapshot` and `diff` as installed."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from support.editor_harness import Harness
from support.waiting import until

pytestmark = pytest.mark.ros
Run = Callable[..., Any]

DEMO = """\
# The expected nodes and connections of a launch configuration.
# Written by `ros-preflight snapshot`, compared by `ros-preflight diff`.
schema: ros-preflight/snapshot/1
launch: $(find preflight_demo)/launch/talker_listener.launch
generation: 1

nodes:
  /listener:
    package: preflight_demo
    executable: listener.py
    from: $(find preflight_demo)/launch/talker_listener.launch
    interface: trace
    outcome: spinning
    subscribers:
      /chater: {type: std_msgs/String}
    remaps:
      chatter: chater

  /talker:
    package: preflight_demo
    executable: talker.py
    from: $(find preflight_demo)/launch/talker_listener.launch
    interface: trace
    outcome: spinning
    publishers:
      /chatter: {type: std_msgs/String, latch: false, queue_size: 10}
    parameters:
      rate: 5
    reads:
      /talker/rate: {default: 10}
"""


def git(folder: Path, *arguments: str) -> None:
    identity = {"GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull}
    names = ("-c", "user.name=t", "-c", "user.email=t@example.org", "-c", "init.defaultBranch=main")
    subprocess.run(["git", *names, "-C", str(folder), *arguments], check=True, env={**os.environ, **identity})


@pytest.fixture
def repository(harness: Harness) -> Path:
    git(harness.workspace, "init", "--quiet")
    git(harness.workspace, "add", "--all")
    git(harness.workspace, "commit", "--quiet", "--message", "First")
    return harness.workspace


def revisions(harness: Harness) -> list[Path]:
    """The folders of revisions that are still there."""
    return list((harness.home / "tmp").glob("ros-preflight-revision-*"))


def runs(harness: Harness) -> bool:
    """Whether the talker is being run."""
    return any("talker.py" in command for command in harness.processes())


def test_a_snapshot_reads_well_and_is_the_same_as_what_it_was_made_of(harness: Harness, preflight: Run) -> None:
    kept = harness.workspace / "expected.yaml"
    done = preflight("snapshot", harness.launch_file, "--output", kept)
    assert (done.code, done.out, done.err) == (0, "", "")
    assert kept.read_text() == DEMO
    done = preflight("diff", kept, harness.launch_file)
    assert (done.code, done.err) == (0, "")
    assert done.out == f"before: {kept}\nafter:  {harness.launch_file}\n\nno differences\n"
    data = preflight("snapshot", harness.launch_file, "--format", "json").json
    assert data["schema"] == "ros-preflight/snapshot/1"
    assert data["nodes"]["/talker"]["publishers"] == {
        "/chatter": {"type": "std_msgs/String", "latch": False, "queue_size": 10}
    }


def test_a_link_of_the_project_does_not_lead_a_snapshot_out_of_it(
    repository: Path, harness: Harness, preflight: Run
) -> None:
    profile = harness.home / "profile"
    profile.write_text("export A=1\n")
    (repository / "expected.yaml").symlink_to(profile)
    (repository / "described").symlink_to(harness.home)
    for arguments in (("--output", "expected.yaml"), ("--output", "described", "--format", "nodl")):
        done = preflight("snapshot", harness.launch_file, *arguments, "--no-run", cwd=repository)
        assert done.code == 2
        assert "is a link that leads out of the project" in done.err
    assert profile.read_text() == "export A=1\n"
    assert not (harness.home / "preflight_demo").exists()


def test_a_snapshot_is_the_same_in_another_folder(harness: Harness, preflight: Run) -> None:
    elsewhere = harness.home / "other/place"
    shutil.copytree(harness.workspace, elsewhere)
    other = elsewhere / harness.launch_file.relative_to(harness.workspace)
    assert preflight("snapshot", other, cwd=elsewhere).out == DEMO


def test_snapshot_as_nodl_is_a_document_for_each_executable(harness: Harness, preflight: Run) -> None:
    folder = harness.workspace / "described"
    done = preflight("snapshot", harness.launch_file, "--format", "nodl", "--output", folder)
    assert (done.code, done.out) == (0, "")
    assert sorted(str(path.relative_to(folder)) for path in folder.rglob("*.yaml")) == [
        "preflight_demo/listener.nodl.yaml",
        "preflight_demo/talker.nodl.yaml",
    ]
    text = (folder / "preflight_demo/talker.nodl.yaml").read_text()
    assert "publishers:\n- name: chatter\n  type: std_msgs/String\n" in text
    done = preflight("snapshot", harness.launch_file, "--format", "nodl")
    assert (done.code, "--output" in done.err) == (2, True)


def test_diff_of_a_file_with_two_lists_of_arguments(harness: Harness, preflight: Run) -> None:
    path = harness.launch_file.with_name("arguments.launch")
    path.write_text(
        '<launch><arg name="n" default="1"/><arg name="second" default="false"/>'
        '<node pkg="preflight_demo" type="talker.py" name="a"><param name="rate" value="$(arg n)"/></node>'
        '<node pkg="preflight_demo" type="listener.py" name="b" if="$(arg second)"/></launch>'
    )
    done = preflight("diff", path, path, "n:=2", "second:=true", "--no-run")
    assert done.code == 1
    assert done.out.splitlines()[3:] == [
        "~ node /a",
        "  ~ parameter rate  1 -> 2",
        "+ node /b  preflight_demo/listener.py  (1 subscriber)",
        "",
        "connections",
        "  + topic /chatter  /a -> /b",
        "",
        "1 node added, 1 node changed, 1 connection added",
    ]
    assert preflight("diff", path, "n:=2", "--no-run", path, "n:=2").code == 0
    assert harness.sandbox_starts() == 0


def test_diff_of_revisions(harness: Harness, preflight: Run, repository: Path) -> None:
    talker = repository / "scripts/talker.py"
    talker.write_text(talker.read_text().replace("queue_size=10", "queue_size=1").replace('"chatter"', '"chat"'))
    harness.launch_file.write_text(harness.launch_file.read_text().replace('value="5"', 'value="6"'))
    file = harness.launch_file.relative_to(repository)
    done = preflight("diff", f"HEAD:{file}", file)
    assert done.code == 1, done.err
    assert done.out == (
        f"before: HEAD:{file}\nafter:  {file}\n\n"
        "~ node /talker\n"
        "  + publishes /chat  std_msgs/String (latch false, queue_size 1)\n"
        "  - publishes /chatter  std_msgs/String (latch false, queue_size 10)\n"
        "  ~ parameter rate  5 -> 6\n"
        "\n1 node changed\n"
    )
    assert preflight("diff", f"HEAD:./{file.name}", f"main:{file}", cwd=harness.launch_file.parent).code == 0
    assert revisions(harness) == []


def test_diff_of_a_revision_runs_nothing_of_the_repository(harness: Harness, preflight: Run, repository: Path) -> None:
    ran = harness.home / "ran"
    hook = repository / ".git/hooks/post-checkout"
    hook.write_text(f"#!/bin/sh\ntouch {ran}\n")
    hook.chmod(0o755)
    (repository / ".gitattributes").write_text("* filter=evil\n")
    git(repository, "add", ".gitattributes")
    git(repository, "commit", "--quiet", "--message", "Attributes")
    for setting in ("filter.evil.smudge", "core.fsmonitor"):
        git(repository, "config", setting, f"touch {ran}")
    file = harness.launch_file.relative_to(repository)
    assert preflight("diff", f"HEAD~1:{file}", f"HEAD:{file}", "--no-run").code == 0
    assert not ran.exists()
    assert harness.sandbox_starts() == 0


def test_a_revision_is_launched_with_the_packages_and_files_it_had(
    harness: Harness, preflight: Run, repository: Path
) -> None:
    file = harness.launch_file.relative_to(repository)
    harness.launch_file.with_name("old.launch").write_text(harness.launch_file.read_text())
    (repository / "rates.yaml").write_text("rate: 7\n")
    harness.launch_file.write_text(
        '<launch><include file="$(find preflight_demo)/launch/old.launch"/>'
        '<rosparam file="$(find preflight_demo)/rates.yaml"/></launch>'
    )
    git(repository, "add", "--all")
    git(repository, "commit", "--quiet", "--message", "Second")
    (repository / "package.xml").write_text((repository / "package.xml").read_text().replace("preflight_demo", "new"))
    for each in ("launch/old.launch", "rates.yaml", str(file)):
        (repository / each).unlink()
    done = preflight("diff", f"HEAD~1:{file}", f"HEAD:{file}", "--no-run")
    assert done.out.splitlines()[3:] == ["+ parameter /rate  7", "", "1 difference beside the nodes"], done.err
    assert done.code == 1


def test_diff_as_markdown_and_json(harness: Harness, preflight: Run) -> None:
    fixed = harness.launch_file.with_name("fixed.launch")
    done = preflight("diff", "--format", "markdown", harness.launch_file, fixed)
    assert done.code == 1
    assert done.out == (
        f"### Launch configuration\n\n`{harness.launch_file}` → `{fixed}`: **1 node changed, 1 connection added**\n\n"
        "| | node | what | before | after |\n"
        "| --- | --- | --- | --- | --- |\n"
        "| - | `/listener` | subscribes to `/chater` | `std_msgs/String` |  |\n"
        "| + | `/listener` | subscribes to `/chatter` |  | `std_msgs/String` |\n"
        "| - | `/listener` | remap `chatter` | `chater` |  |\n\n"
        "| | connection | from | to |\n"
        "| --- | --- | --- | --- |\n"
        "| + | topic `/chatter` | `/talker` | `/listener` |\n"
    )
    data = preflight("diff", "--format", "json", harness.launch_file, fixed).json
    assert set(data) == {"schema", "before", "after", "same", "changes", "connections", "not_compared"}
    assert (data["schema"], data["same"]) == ("ros-preflight/diff/1", False)
    assert data["before"]["launch"] == "$(find preflight_demo)/launch/talker_listener.launch"
    assert data["changes"][0] == {
        "kind": "removed",
        "what": "subscriber",
        "node": "/listener",
        "name": "/chater",
        "before": {"type": "std_msgs/String"},
        "after": None,
    }
    assert data["connections"] == [
        {"kind": "added", "what": "topic", "name": "/chatter", "offers": "/talker", "wants": "/listener"}
    ]


def test_a_node_that_crashes_is_a_difference_and_not_the_loss_of_all_it_does(harness: Harness, preflight: Run) -> None:
    kept = harness.workspace / "expected.yaml"
    kept.write_text(DEMO)
    script = harness.workspace / "scripts/talker.py"
    script.write_text('#!/usr/bin/env python3\nraise RuntimeError("no laser here")\n')
    done = preflight("diff", kept, harness.launch_file)
    assert done.code == 1
    assert "  ~ outcome  spinning -> crashed\n" in done.out
    assert "publishes" not in done.out
    assert "not compared to the end\n  /talker: " in done.out


@pytest.mark.parametrize(
    ("sides", "said"),
    [
        (["nowhere.launch", "launch/fixed.launch"], "nowhere.launch does not exist"),
        (["launch/fixed.launch"], "diff compares two operands, 1 given"),
        (["x:=1", "launch/fixed.launch"], "x:=1 stands before the launch file"),
        (["launch", "launch/fixed.launch"], "is a folder"),
        (["HEAD:launch/nowhere.launch", "launch/fixed.launch"], "launch/nowhere.launch is not in HEAD"),
        (["HEAD:../outside.launch", "launch/fixed.launch"], "../outside.launch is not in HEAD"),
        (["v9:launch/fixed.launch", "launch/fixed.launch"], "'v9' is no revision"),
        (["--output=x:launch/fixed.launch", "launch/fixed.launch"], "not understood"),
        (["expected.yaml", "x:=1", "launch/fixed.launch"], "is a snapshot, which takes no arguments"),
        (["broken.yaml", "launch/fixed.launch"], "has no names with values at nodes"),
        (["newer.yaml", "launch/fixed.launch"], "has the schema ros-preflight/snapshot/9"),
    ],
)
def test_what_cannot_be_compared(preflight: Run, repository: Path, sides: list[str], said: str) -> None:
    (repository / "expected.yaml").write_text(DEMO)
    (repository / "broken.yaml").write_text("schema: ros-preflight/snapshot/1\nnodes: 5\n")
    (repository / "newer.yaml").write_text("schema: ros-preflight/snapshot/9\n")
    done = preflight("diff", "--no-run", *sides)
    assert (done.code, done.out) == (2, "")
    assert said in done.err


def test_a_revision_needs_a_repository(preflight: Run) -> None:
    done = preflight("diff", "HEAD:launch/fixed.launch", "launch/fixed.launch", "--no-run")
    assert done.code == 2
    assert "is not in a git repository" in done.err


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGHUP])
def test_a_revision_is_cleaned_up_whatever_ends_the_command(harness: Harness, repository: Path, number: int) -> None:
    (repository / "scripts/talker.py").write_text("#!/usr/bin/env python3\nimport time\ntime.sleep(60)\n")
    git(repository, "commit", "--quiet", "--all", "--message", "Slow")
    file = harness.launch_file.relative_to(repository)
    with subprocess.Popen(
        [str(harness.server), "diff", f"HEAD:{file}", str(file)],
        cwd=repository,
        env=harness.environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as process:
        until(lambda: process.poll() is not None or runs(harness))
        assert len(revisions(harness)) == 1
        process.send_signal(number)
        process.wait(60)
    assert process.returncode == 2
    assert revisions(harness) == []
    until(lambda: not runs(harness))
