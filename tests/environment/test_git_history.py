"""What git knows of the former names of files, and what rules make of it."""

from __future__ import annotations

from pathlib import Path

import pytest
from environment.test_git import git
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.environment.git_history import formerly
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.open_buffers import disk_with

_MANIFEST = """<package format='2'>
<name>{}</name>
<version>0.1.0</version>
<description>d</description>
<maintainer email="a@b.c">a</maintainer>
<license>BSD</license>
</package>
"""


def _commit(folder: Path) -> str:
    git(folder, "add", "-A")
    git(folder, "commit", "-qm", "m")
    return git(folder, "rev-parse", "--short", "HEAD")


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    files = {
        "p/package.xml": _MANIFEST.format("p"),
        "p/launch/arm driver.launch": "<launch><arg name='a' default='1'/></launch>\n",
        "p/launch/base.launch": "<launch><arg name='b' default='2'/></launch>\n",
        "p/config/arm.yaml": "speed: 1\nlimits: [1, 2, 3]\n",
        "p/scripts/winch.py": "#!/usr/bin/env python3\nprint('winch')\n",
        "p/scripts/gone.py": "#!/usr/bin/env python3\nprint('something else')\n",
        "winch_tools/package.xml": _MANIFEST.format("winch_tools"),
        "old_tools/package.xml": "<package><name>old_tools</name></package>",
    }
    git(tmp_path, "init", "-q", "-b", "main")
    for name, text in files.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(0o755 if name.endswith(".py") else 0o644)
    _commit(tmp_path)
    return tmp_path


def test_a_file_that_was_renamed_twice_and_one_that_was_removed(repository: Path) -> None:
    launch = repository / "p/launch"
    (launch / "arm driver.launch").rename(launch / "driver.launch")
    first = _commit(repository)
    (launch / "driver.launch").rename(launch / "arm_driver.launch")
    (launch / "base.launch").unlink()
    second = _commit(repository)
    disk = disk_with({})
    renamed, removed = formerly(disk, str(launch / "arm driver.launch")), formerly(disk, str(launch / "base.launch"))
    assert renamed is not None and (renamed.path, renamed.commit) == (str(launch / "arm_driver.launch"), first)
    assert removed is not None and (removed.path, removed.commit) == (None, second)
    assert removed.told(None) == f"; removed in {second} (today)"
    assert formerly(disk, str(launch / "never.launch")) is None


def test_a_repository_that_is_packed(repository: Path) -> None:
    (repository / "p/launch/base.launch").rename(repository / "p/launch/b.launch")
    _commit(repository)
    git(repository, "gc", "-q")
    found = formerly(disk_with({}), str(repository / "p/launch/base.launch"))
    assert found is not None and found.path == str(repository / "p/launch/b.launch")


@pytest.mark.silent
def test_no_repository_and_no_commit(tmp_path: Path) -> None:
    assert formerly(disk_with({}), str(tmp_path / "a.launch")) is None
    git(tmp_path, "init", "-q", "-b", "main")
    assert formerly(disk_with({}), str(tmp_path / "a.launch")) is None
    (tmp_path / ".git" / "HEAD").write_text("ref: ../../../etc/passwd\n")
    assert formerly(disk_with({}), str(tmp_path / "a.launch")) is None


def test_programs_that_the_repository_names_are_not_run(repository: Path) -> None:
    (repository / "p/launch/base.launch").rename(repository / "p/launch/b.launch")
    _commit(repository)
    ran = repository / "ran"
    for name in ("core.fsmonitor", "gpg.program", "core.pager", "diff.external", "core.sshCommand"):
        git(repository, "config", name, f"touch {ran}; true")
    git(repository, "config", "log.showSignature", "true")
    assert formerly(disk_with({}), str(repository / "p/launch/base.launch")) is not None
    assert not ran.exists()


def _findings(repository: Path, body: str) -> list[Finding]:
    main = repository / "p/launch/main.launch"
    main.write_text(f"<launch>{body}</launch>\n")
    environment = detect_environment(str(repository), {"ROS_DISTRO": "noetic", "ROS_VERSION": "1"}, root="/nowhere")
    return list(Workspace(environment, Sources(), str(repository)).static(str(main)).findings)


def _move(repository: Path, old: str, new: str | None) -> str:
    if new is None:
        (repository / old).unlink()
    else:
        (repository / new).parent.mkdir(parents=True, exist_ok=True)
        (repository / old).rename(repository / new)
    return _commit(repository)


@pytest.mark.parametrize(
    ("body", "rule", "old", "new", "said"),
    [
        (
            '<include file="$(find p)/launch/base.launch"/>',
            "LCH013",
            "p/launch/base.launch",
            "p/launch/chassis.launch",
            "renamed to 'p/launch/chassis.launch'",
        ),
        (
            '<rosparam file="$(find p)/config/arm.yaml"/>',
            "PRM002",
            "p/config/arm.yaml",
            "p/config/six_axes.yaml",
            "renamed to 'p/config/six_axes.yaml'",
        ),
        ('<rosparam file="$(find p)/config/arm.yaml"/>', "PRM002", "p/config/arm.yaml", None, "removed"),
        (
            '<node pkg="p" type="winch.py" name="w"/>',
            "PKG002",
            "p/scripts/winch.py",
            "p/scripts/reel_driver.py",
            "renamed to 'reel_driver.py'",
        ),
        ('<node pkg="p" type="gone.py" name="w"/>', "PKG002", "p/scripts/gone.py", None, "removed"),
        (
            '<node pkg="winch_tools" type="w" name="w"/>',
            "PKG001",
            "winch_tools/package.xml",
            "reel/package.xml",
            "renamed to 'reel_tools'",
        ),
        ('<node pkg="old_tools" type="w" name="w"/>', "PKG001", "old_tools/package.xml", None, "removed"),
    ],
)
def test_what_is_not_there_any_more_is_told(
    repository: Path, body: str, rule: str, old: str, new: str | None, said: str
) -> None:
    if new == "reel/package.xml":
        (repository / old).write_text(_MANIFEST.format("reel_tools"))
    commit = _move(repository, old, new)
    (found,) = [each for each in _findings(repository, body) if each.rule == rule]
    assert found.message.endswith(f"; {said} in {commit} (today)")
    assert bool(found.fixes) == (new is not None)


def test_without_git_nothing_else_changes(repository: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _move(repository, "p/launch/base.launch", "p/launch/chassis.launch")
    monkeypatch.setenv("PATH", "/nowhere")
    (found,) = _findings(repository, '<include file="$(find p)/launch/base.launch"/>')
    assert found.rule == "LCH013" and "renamed" not in found.message
