"""The process that asks rclpy: what it is started with, and how it ends. It is outside of the sandbox, so nothing of a
workspace may get into it."""

from __future__ import annotations

import venv
from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect
from preflight_analysis.live.model import CannotObserveError
from preflight_analysis.live.observe_ros2 import Ros2Observer

pytestmark = pytest.mark.ros

OF_THE_USER = 'raise ImportError("the user\'s own")'


def rclpy(prefix: Path, body: str) -> Path:
    """A prefix that looks like one with rclpy for the interpreter of these tests."""
    for version in ("python3.10", "python3.11", "python3.12", "python3.13", "python3.14"):
        folder = prefix / "lib" / version / "site-packages"
        (folder / "rclpy").mkdir(parents=True, exist_ok=True)
        (folder / "rclpy/__init__.py").write_text(body)
    return prefix


def users_own(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A virtual environment with an rclpy that says whose it is, on the user's PATH."""
    venv.create(folder, with_pip=False, symlinks=True)
    rclpy(folder, OF_THE_USER)
    monkeypatch.setenv("PATH", f"{folder}/bin:/usr/bin:/bin")
    return folder


@pytest.fixture
def clean(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("PYTHONPATH", "AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH", "ROS_PACKAGE_PATH", "LD_LIBRARY_PATH"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("PATH", "/usr/bin:/bin")


@pytest.fixture
def hostile(tmp_path: Path) -> tuple[Path, Path]:
    """A workspace whose build folders hold programs and modules that leave the second path; nobody sourced them."""
    workspace, marker = tmp_path / "workspace", tmp_path / "ran"
    leave = f"open({str(marker)!r}, 'w').close()\n"
    package = workspace / "src/pkg"
    (package / "launch").mkdir(parents=True)
    (package / "package.xml").write_text('<package format="3"><name>pkg</name></package>')
    (workspace / "install/share/ament_index/resource_index/packages").mkdir(parents=True)
    (workspace / "install/share/ament_index/resource_index/packages/rclpy").touch()
    (workspace / "devel").mkdir()
    (workspace / "devel/.catkin").touch()
    for space in ("install", "devel"):
        rclpy(workspace / space, leave)
        for folder in (workspace / space / "lib").iterdir():
            (folder / "site-packages/sitecustomize.py").write_text(leave)
        (workspace / space / "bin").mkdir()
        python = workspace / space / "bin/python3"
        python.write_text(f"#!/bin/sh\ntouch '{marker}'\n")
        python.chmod(0o755)
    return workspace, marker


@pytest.mark.usefixtures("clean")
def test_an_interpreter_of_the_workspace_is_refused(hostile: tuple[Path, Path]) -> None:
    workspace, marker = hostile
    environment = detect(str(workspace))
    assert environment.ros2_python is not None, "nothing of the workspace was found that could be refused"
    observer = Ros2Observer(environment)
    with pytest.raises(CannotObserveError, match=r"found only in the workspace .*source") as refused:
        observer.observe()
    assert refused.value.final
    assert not marker.exists()


@pytest.mark.usefixtures("clean")
def test_nothing_of_the_workspace_gets_into_the_users_own(
    hostile: tuple[Path, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    workspace, marker = hostile
    users_own(tmp_path / "venv", monkeypatch)
    observer = Ros2Observer(detect(str(workspace)))
    with pytest.raises(CannotObserveError, match="the user's own"):
        observer.observe()
    observer.close()
    assert not marker.exists()


@pytest.mark.usefixtures("clean")
def test_what_the_user_sourced_counts(
    hostile: tuple[Path, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A path that the user's own variables name is imported from, in the workspace too; a `sitecustomize` that lies
    there is not run."""
    workspace, marker = hostile
    venv.create(tmp_path / "venv", with_pip=False, symlinks=True)
    sourced = rclpy(tmp_path / "workspace/sourced", OF_THE_USER)
    folders = sorted((sourced / "lib").iterdir())
    for folder in folders:
        (folder / "site-packages/sitecustomize.py").write_text(f"open({str(marker)!r}, 'w').close()\n")
    rclpy(tmp_path / "venv", 'raise ImportError("shadowed")')
    monkeypatch.setenv("PATH", f"{tmp_path}/venv/bin:/usr/bin:/bin")
    monkeypatch.setenv("PYTHONPATH", ":".join([".", *(str(folder / "site-packages") for folder in folders)]))
    observer = Ros2Observer(detect(str(workspace)))
    with pytest.raises(CannotObserveError, match="the user's own"):
        observer.observe()
    observer.close()
    assert not marker.exists()


@pytest.mark.usefixtures("clean")
def test_what_was_closed_starts_nothing_more(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Who stops a watch that has hardly begun leaves no process behind."""
    started = tmp_path / "started"
    prefix = rclpy(tmp_path / "prefix", "")
    (prefix / "bin").mkdir()
    python = prefix / "bin/python3"
    python.write_text(f"#!/bin/sh\ntouch {started}\n")
    python.chmod(0o755)
    monkeypatch.setenv("PATH", f"{prefix}/bin:/usr/bin:/bin")
    environment = detect(str(tmp_path))
    with pytest.raises(CannotObserveError, match="exited with"):
        Ros2Observer(environment).observe()
    assert started.exists()
    started.unlink()
    observer = Ros2Observer(environment)
    observer.close()
    with pytest.raises(CannotObserveError) as refused:
        observer.observe()
    assert refused.value.final
    assert not started.exists()
