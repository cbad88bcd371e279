"""What git keeps of a workspace, tokens among it, is hidden in the sandbox, wherever the workspace lies."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.tracing import repositories
from preflight_analysis.tracing.commands import CommandRunner
from preflight_analysis.tracing.repositories import hidden_paths
from preflight_analysis.tracing.trace import Tracer
from support.tracing_harness import request, write_node

VARIABLES = {"PATH": "/usr/bin:/bin"}
LOOK = """
import os, sys
for top in sys.argv[1:-2]:
    for folder, folders, files in os.walk(top):
        for name in files:
            try:
                with open(os.path.join(folder, name), errors="replace") as file:
                    if "hunter" "2" in file.read():
                        print("leaked", folder, name, file=sys.stderr)
            except OSError:
                pass
print("listed", sorted(os.listdir(sys.argv[1])), file=sys.stderr)
"""


def git(*arguments: str | Path) -> None:
    name = ["-c", "user.name=n", "-c", "user.email=e", "-c", "protocol.file.allow=always"]
    subprocess.run(["git", *name, *arguments], check=True, capture_output=True)


def checkout(folder: Path) -> Path:
    """A repository with a token in its configuration, as a checkout of CI leaves it, that is a package."""
    folder.mkdir(parents=True)
    git("init", folder)
    (folder / "package.xml").write_text("<package><name>pkg</name></package>")
    write_node(folder, LOOK)
    git("-C", folder, "add", ".")
    git("-C", folder, "commit", "-m", "hunter2 in a message")
    with (folder / ".git/config").open("a") as file:
        file.write('[http "https://host"]\n\textraheader = AUTHORIZATION: basic hunter2\n')
    return folder


def tail(package: Path, *tops: Path, workspace: Path | None = None) -> list[str]:
    """What a node of a package says of these folders."""
    environment = detect_environment(str(workspace or package), VARIABLES)
    asked = request(package / "node.py", args=(*map(str, tops), "", ""))
    found = Tracer(environment, None).trace(asked, threading.Event())
    assert found.outcome.status == "exited", found.outcome
    return list(found.outcome.stderr_tail)


@pytest.fixture(params=["hidden", "open"])
def place(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Path]:
    """A folder below those that the sandbox hides, and one that everybody may read."""
    folder = tmp_path if request.param == "hidden" else Path(tempfile.mkdtemp(prefix="preflight-", dir="/opt"))
    yield folder
    if folder != tmp_path:
        shutil.rmtree(folder)


@pytest.mark.ros
@pytest.mark.usefixtures("each_backend")
def test_the_repository_of_a_package_is_hidden(place: Path) -> None:
    package = checkout(place / "pkg")
    said = tail(package, package)
    assert said == ["listed ['.git', 'node.py', 'package.xml']"], "and its folder can be listed"


@pytest.mark.ros
@pytest.mark.usefixtures("each_backend")
def test_repositories_of_a_workspace_are_hidden(place: Path) -> None:
    """The one around it, one of a package, a submodule's, that of another working tree, one without a package."""
    top = checkout(place / "top")
    package = checkout(top / "ws/src/pkg")
    git("-C", package, "submodule", "add", checkout(place / "lib"), "lib")
    with (package / ".git/modules/lib/config").open("a") as file:
        file.write("# hunter2\n")
    tree = top / "ws/src/tree"
    git("-C", checkout(place / "main"), "worktree", "add", tree)
    checkout(top / "ws/src/plain")
    (top / "ws/src/plain/package.xml").unlink()
    assert [
        line for line in tail(package, package, top, place / "main", workspace=top / "ws") if "leaked" in line
    ] == []


@pytest.mark.ros
def test_a_command_that_asks_git_has_not_failed(tmp_path: Path) -> None:
    package = checkout(tmp_path / "pkg")
    runner = CommandRunner(detect_environment(str(package), VARIABLES), str(package), None)
    found = runner.run("git -c safe.directory=* log", threading.Event())
    assert "hunter2" not in repr(found)
    assert found.status == "not-run"
    assert found.reason.endswith("it needs the git repository, which the sandbox hides")


def hidden(workspace: Path) -> set[Path]:
    return {Path(path) for path in hidden_paths(detect_environment(str(workspace), VARIABLES))}


def test_what_is_looked_at(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    top = checkout(tmp_path / "top")
    inner = checkout(top / "a/b/inner")
    (top / "link").symlink_to(checkout(tmp_path / "elsewhere"))
    assert hidden(top) == {top / ".git", inner / ".git"}
    monkeypatch.setattr(repositories, "MOST_FOLDERS", 2)
    assert hidden(top) == {top / ".git"}, "and not for ever"


def test_a_git_file_that_names_anything_hides_nothing_else(tmp_path: Path) -> None:
    """It may come with an archive: what it names is hidden only if it is a repository."""
    package = tmp_path / "pkg"
    package.mkdir()
    (package / "package.xml").write_text("<package><name>pkg</name></package>")
    for text in ("gitdir: /usr\n", "gitdir: ..\n", "gitdir: /nowhere\n", "", "\0", "gitdir: \0\n"):
        (package / ".git").write_text(text)
        assert hidden(package) == {package / ".git"}


def test_a_workspace_in_a_bare_repository_is_not_hidden(tmp_path: Path) -> None:
    top = checkout(tmp_path / "top")
    package = checkout(top / ".git/pkg")
    assert hidden(package) == {top / ".git/config", package / ".git"}
