"""`check` of several files and whole workspaces: roots and profiles, known findings, what changed."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from support.editor_harness import Harness
from support.packaging import PYTHON, lay_out
from support.unbuilt_packages import manifest

pytestmark = pytest.mark.ros
Run = Callable[..., Any]

INNER = '<launch>\n  <arg name="id"/>\n  <param name="$(arg id)" value="1"/>\n  <nod/>\n</launch>\n'
OUTER = '<launch>\n  <include file="$(dirname)/inner.launch"><arg name="id" value="x"/></include>\n</launch>\n'
PROFILES = '<launch>\n  <arg name="sim"/>\n  <include file="$(dirname)/$(arg sim).launch"/>\n</launch>\n'


def create_workspace(folder: Path, **files: str) -> Path:
    for name, text in files.items():
        path = folder / f"{name}.launch"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder


@pytest.fixture
def workspace(harness: Harness) -> Path:
    """Beside the demo: a file that only holds as it is included, and two that include nothing."""
    folder = harness.workspace.parent / "robots"
    (folder / ".git").mkdir(parents=True)
    return create_workspace(folder, inner=INNER, outer=OUTER, alone="<launch/>")


def rules(data: Any) -> list[tuple[str, str]]:
    return [(finding["rule"], Path(finding["file"]).name) for finding in data["findings"]]


def test_a_workspace_is_checked_as_it_is_launched(workspace: Path, preflight: Run) -> None:
    done = preflight("check", "--no-run", "--format", "json", cwd=workspace)
    assert rules(done.json) == [("LCH004", "inner.launch")], "inner.launch lacks no argument where it is included"
    assert (done.json["files"], done.json["findings"][0]["roots"]) == (3, [str(workspace / "outer.launch")])
    assert preflight("check", "--no-run", "--format", "json", workspace).json == done.json
    assert done.err == "", "no progress where nobody looks"


def test_every_profile_of_the_settings_is_launched(workspace: Path, preflight: Run) -> None:
    create_workspace(workspace, profiles=PROFILES, real="<launch/>")
    settings = (
        "roots:\n  - {file: profiles.launch, args: {sim: real}}\n  - {file: profiles.launch, args: {sim: gone}}\n"
    )
    (workspace / ".ros-preflight.yaml").write_text(settings)
    data = preflight("check", "--no-run", "--format", "json", cwd=workspace).json
    (gone,) = [f for f in data["findings"] if f["rule"] == "LCH013"]
    assert gone["roots"] == [f"{workspace}/profiles.launch sim:=gone"]
    assert ("ARG002", "profiles.launch") not in rules(data), "it is never launched without its argument"


def test_several_files(workspace: Path, preflight: Run) -> None:
    done = preflight("check", "outer.launch", "--no-run", "inner.launch", "--format", "json", "id:=a", cwd=workspace)
    lch004 = [finding for finding in done.json["findings"] if finding["rule"] == "LCH004"]
    assert [f["roots"] for f in lch004] == [
        [f"{workspace}/outer.launch id:=a", f"{workspace}/inner.launch id:=a"],
    ]
    assert done.json["files"] == 2


OUTER_PY = """from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import AnyLaunchDescriptionSource
import os
INNER = os.path.join(os.path.dirname(__file__), "in" + "ner.launch.xml")
def generate_launch_description():
    inner = AnyLaunchDescriptionSource(INNER)
    return LaunchDescription([IncludeLaunchDescription(inner, launch_arguments={"x": "1"}.items())])
"""


def test_a_workspace_of_ros2(tmp_path: Path, preflight: Run) -> None:
    folder = tmp_path / "ros2"
    (folder / ".git").mkdir(parents=True)
    (folder / "outer.launch.py").write_text(OUTER_PY)
    (folder / "inner.launch.xml").write_text(
        '<launch>\n  <arg name="x"/>\n  <let name="y" value="$(var x)$(var gone)"/>\n</launch>\n'
    )
    (folder / "other.launch.yaml").write_text("launch:\n- nod: {pkg: a}\n")
    done = preflight("check", "--format", "json", cwd=folder)
    assert rules(done.json) == [("ARG001", "inner.launch.xml"), ("LCH004", "other.launch.yaml")]
    assert done.json["findings"][0]["roots"] == [f"{folder}/outer.launch.py"], (
        "what a run tells to be included is no root"
    )
    assert preflight("check", "--format", "sarif", "inner.launch.xml", cwd=folder).out.count('"ARG003"') == 2


def test_processes_are_no_nodes(tmp_path: Path, preflight: Run) -> None:
    launch = tmp_path / "a.launch.xml"
    launch.write_text('<launch><executable cmd="sleep 1"/><node pkg="nothing_here" exec="x"/></launch>')
    assert "1 node: 1 unknown" in preflight("check", launch, "--no-run").out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["."], "there are no launch files in ."),
        ([], "there are no launch files in ."),
        (["a:=1"], "none is named"),
        ([".", "a:=1"], ". is a folder"),
        (["missing"], "missing does not exist"),
        ([".", "--baseline", "missing.json"], "--write-baseline missing.json creates it"),
        (["x.launch", "--changed-since", "HEAD"], "is not in a git repository"),
        (["x.launch", "--changed-since=--output=x"], "is no revision"),
    ],
)
def test_what_cannot_be_done(tmp_path: Path, preflight: Run, arguments: list[str], message: str) -> None:
    folder = tmp_path / "empty"
    folder.mkdir()
    if "x.launch" in arguments:
        create_workspace(folder, x="<launch/>")
    done = preflight("check", "--no-run", *arguments, cwd=folder)
    assert (done.code, done.out) == (2, "")
    assert message in done.err


def test_known_findings_do_not_count(workspace: Path, preflight: Run) -> None:
    check = ("check", "--no-run", "--fail-on", "warning")
    assert preflight(*check, cwd=workspace).code == 1
    done = preflight(*check, "--write-baseline", "known.json", cwd=workspace)
    assert (done.code, done.out, done.err) == (0, "", "ros-preflight: known.json has 1 finding\n")
    text = (workspace / "known.json").read_text()
    (entry,) = json.loads(text)["findings"]
    assert (entry["file"], entry["rule"]) == ("inner.launch", "LCH004")
    inner = workspace / "inner.launch"
    inner.write_text("<!-- moved -->\n\n" + INNER)
    done = preflight(*check, "--baseline", "known.json", cwd=workspace)
    assert (done.code, done.out) == (0, "no findings; 3 of 3 launch files evaluated, 0 nodes\n")
    assert done.err == "ros-preflight: 1 of 1 findings are in known.json\n"
    inner.write_text(INNER.replace("<nod/>", "<nod/>\n  <nod/>"))
    done = preflight(*check, "--baseline", "known.json", "--format", "json", cwd=workspace)
    (new,) = done.json["findings"]
    assert (done.code, new["rule"], new["range"]["start"]["line"]) == (1, "LCH004", 5)


def test_known_findings_are_not_written_through_a_link_that_leads_elsewhere(
    workspace: Path, tmp_path: Path, preflight: Run
) -> None:
    profile = tmp_path / "profile"
    profile.write_text("export A=1\n")
    (workspace / "known.json").symlink_to(profile)
    done = preflight("check", "--no-run", "--write-baseline", "known.json", cwd=workspace)
    assert (done.code, done.out) == (2, "")
    assert "known.json is a link that leads out of the project" in done.err
    assert profile.read_text() == "export A=1\n"


@pytest.mark.parametrize("content", ["", "[]", "{}", '{"schema": "ros-preflight/baseline/1", "findings": [1]}'])
def test_a_list_that_is_none_is_exit_code_2(workspace: Path, preflight: Run, content: str) -> None:
    (workspace / "known.json").write_text(content)
    done = preflight("check", "--no-run", "--baseline", "known.json", cwd=workspace)
    assert (done.code, done.out) == (2, "")
    assert "known.json is not a list of findings" in done.err


@pytest.fixture
def repository(workspace: Path, harness: Harness) -> Callable[..., None]:
    (workspace / ".git").rmdir()
    identity = {
        "GIT_AUTHOR_NAME": "a",
        "GIT_AUTHOR_EMAIL": "a@b",
        "GIT_COMMITTER_NAME": "a",
        "GIT_COMMITTER_EMAIL": "a@b",
    }

    def git(*arguments: str) -> None:
        environment = {**harness.environment, **identity, "GIT_CONFIG_GLOBAL": os.devnull}
        subprocess.run(["git", "-C", str(workspace), *arguments], check=True, env=environment, capture_output=True)

    git("init", "-b", "main")
    git("add", ".")
    git("commit", "-m", "first")
    return git


def test_only_launches_that_changed(workspace: Path, repository: Callable[..., None], preflight: Run) -> None:
    missing = preflight("check", "--no-run", "--changed-since", "v9", cwd=workspace)
    assert missing.code == 2
    assert "'v9' is no revision of " in missing.err

    def checked(revision: str = "HEAD", folder: Path = workspace) -> int:
        options = ("--no-run", "--format", "json", "--fail-on", "never", "--changed-since", revision)
        files: int = preflight("check", *options, cwd=folder).json["files"]
        return files

    assert checked() == 0
    (workspace / "inner.launch").write_text(INNER + "\n")
    assert checked() == 2, "inner.launch, in the launch that includes it"
    repository("commit", "-am", "second")
    assert (checked(), checked("HEAD~1"), checked("main~1")) == (0, 2, 2)
    create_workspace(workspace, new="<launch/>")
    assert checked() == 1, "one that git does not know yet"
    (workspace / ".ros-preflight.yaml").write_text("external: {}\n")
    assert checked() == 4, "the settings speak of every launch"


def test_a_change_in_a_package_is_one_of_the_launches_of_its_nodes(
    workspace: Path, repository: Callable[..., None], preflight: Run
) -> None:
    package = workspace / "src" / "drivers"
    (package / "scripts").mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>drivers</name></package>")
    create_workspace(workspace, alone='<launch><node pkg="drivers" type="lidar" name="lidar"/></launch>')
    repository("add", ".")
    repository("commit", "-m", "second")
    (package / "scripts" / "lidar.py").write_text("")
    options = ("--no-run", "--format", "json", "--fail-on", "never", "--changed-since", "HEAD")
    data = preflight("check", *options, cwd=workspace).json
    assert (data["files"], data["nodes"]) == (1, 1)


def test_the_repository_cannot_make_git_run_something(
    workspace: Path, repository: Callable[..., None], preflight: Run
) -> None:
    program, trace = workspace / ".git" / "monitor", workspace / ".git" / "ran"
    program.write_text(f"#!/bin/sh\ntouch {trace}\n")
    program.chmod(0o755)
    repository("config", "core.fsmonitor", str(program))
    repository("config", "diff.external", str(program))
    (workspace / "inner.launch").write_text(INNER + "\n")
    assert preflight("check", "--no-run", "--changed-since", "HEAD", cwd=workspace).code == 0
    assert not trace.exists()


@pytest.mark.parametrize("way", ["option", "variable"])
def test_the_cache_folder_can_be_one_that_a_ci_keeps(harness: Harness, preflight: Run, way: str) -> None:
    option = ("--cache-dir", "ci cache") if way == "option" else ()
    variable = {"ROS_PREFLIGHT_CACHE_DIR": "ci cache"} if way == "variable" else {}
    done = preflight("check", harness.launch_file, *option, environment=variable)
    assert "2 nodes: 2 run" in done.out
    kept = harness.workspace / "ci cache"
    assert list(kept.iterdir())
    assert not list((harness.home / ".cache").iterdir())
    starts = harness.sandbox_starts()
    moved = kept.rename(harness.home / "restored")
    again = preflight("check", harness.launch_file, "--cache-dir", moved)
    assert (again.out, harness.sandbox_starts()) == (done.out, starts), "not even the probe"


def test_packages_that_no_launch_has_to_do_with(tmp_path: Path, preflight: Run) -> None:
    lay_out(tmp_path, {**PYTHON, "setup.cfg": None, "launch/arm.launch.xml": None})
    done = preflight("check", "--no-run", "--format", "json", cwd=tmp_path)
    assert (done.code, rules(done.json), done.json["files"]) == (1, [("PKG011", "setup.py")], 0)
    leg = lay_out(
        tmp_path / "src/more", {"package.xml": manifest("leg", "ament_python"), "leg.launch.xml": "<launch/>"}
    )
    done = preflight("check", "--no-run", "--format", "json", cwd=tmp_path)
    assert (rules(done.json), done.json["files"]) == ([("PKG011", "setup.py")], 1)
    assert rules(preflight("check", "--no-run", "--format", "json", leg).json) == []
