"""What comes in between: servers that are killed while they write, several at once, and branches that change under the
editor. What is said in the end is what a fresh server says with an empty cache."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import pytest
from support.waiting import until
from tools.endurance.lsp_process import COMMAND, LspProcess

MANIFEST = """<package format="2"><name>p</name><version>1.0.0</version><description/>
<maintainer email="a@example.org">a</maintainer><license>MIT</license>
<buildtool_depend>catkin</buildtool_depend></package>
"""
pytestmark = pytest.mark.slow
FILES = 40
STILL = 1.0
"""Seconds of silence after which a server that is idle has nothing more to say."""
PATIENCE = 120.0
CREATED, CHANGED, DELETED = 1, 2, 3


class Desk:
    """A workspace with a home folder, and the servers that were started there."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.workspace = folder / "workspace"
        self.launch = self.workspace / "src/p/launch"
        self.launch.mkdir(parents=True)
        (self.launch.parent / "package.xml").write_text(MANIFEST)
        self.servers: list[LspProcess] = []

    def environment(self, home: str) -> dict[str, str]:
        (self.folder / home).mkdir(exist_ok=True)
        usual = {"PATH": "/usr/bin:/bin", "LANG": "C.UTF-8", "ROS_VERSION": "1", "ROS_DISTRO": "noetic"}
        return {**usual, "HOME": str(self.folder / home)}

    def server(self, home: str = "home") -> LspProcess:
        log = self.folder / f"{len(self.servers)}.log"
        self.servers.append(LspProcess([self.workspace], log, self.environment(home)))
        return self.servers[-1]

    def open(self, server: LspProcess, texts: Mapping[str, str]) -> None:
        for name, text in texts.items():
            item = {"uri": (self.launch / name).as_uri(), "languageId": "roslaunch", "version": 1, "text": text}
            server.notify("textDocument/didOpen", {"textDocument": item})

    def change(self, server: LspProcess, name: str, version: int, text: str) -> None:
        document = {"uri": (self.launch / name).as_uri(), "version": version}
        server.notify("textDocument/didChange", {"textDocument": document, "contentChanges": [{"text": text}]})

    def report(self, server: LspProcess, changes: Mapping[Path, int]) -> None:
        found = [{"uri": path.as_uri(), "type": kind} for path, kind in changes.items()]
        server.notify("workspace/didChangeWatchedFiles", {"changes": found})

    def said(self, server: LspProcess) -> dict[str, list[str]]:
        """What it publishes when it has nothing more to do."""
        server.rest(1, STILL, PATIENCE)
        assert server.faults() == []
        return server.state()

    def fresh(self, texts: Mapping[str, str]) -> dict[str, list[str]]:
        """What a server says that has nothing from before."""
        server = self.server(f"home-{len(self.servers)}")
        self.open(server, texts)
        return self.said(server)


@pytest.fixture
def desk(tmp_path: Path) -> Iterator[Desk]:
    made = Desk(tmp_path)
    yield made
    for server in made.servers:
        server.kill()


def launch_files(desk: Desk, number: int = FILES) -> dict[str, str]:
    """Files each of which includes the next one and passes it an argument; two of them have something wrong."""
    for n in range(number):
        below = f'<include file="$(find p)/launch/f{n + 1}.launch"><arg name="a" value="$(arg a)"/></include>'
        last = n == number - 1
        wrong = "<nod/>" if n == number // 2 else '<param name="x" value="$(arg b)"/>' if last else ""
        text = f'<launch>\n  <arg name="a" default="{n}"/>\n  {"" if last else below}\n  {wrong}\n</launch>\n'
        (desk.launch / f"f{n}.launch").write_text(text)
    return {f"f{n}.launch": (desk.launch / f"f{n}.launch").read_text() for n in (0, number // 2, number - 1)}


def test_a_server_that_is_killed_while_it_writes_what_it_keeps(desk: Desk) -> None:
    texts = launch_files(desk)
    usual = desk.fresh(texts)
    assert "ARG001" in str(usual) and "LCH004" in str(usual)
    cache = desk.folder / "home/.cache"

    def kept() -> frozenset[tuple[str, int]]:
        with contextlib.suppress(FileNotFoundError):
            return frozenset((str(path), path.stat().st_mtime_ns) for path in cache.rglob("*") if path.is_file())
        return frozenset()

    # As soon as something is written, when all of that has been, and before.
    moments: list[Callable[[LspProcess, object], object]] = [
        lambda server, before: kept() != before,
        lambda server, before: kept() != before and server.idle,
        lambda server, before: server.published,
        lambda server, before: server.begun,
    ]
    for number, moment in enumerate(moments):
        (desk.launch / "f0.launch").write_text(texts["f0.launch"] + "\n" * number)  # the index is kept anew
        before = kept()
        server = desk.server()
        desk.open(server, texts)
        until(lambda: moment(server, before))  # noqa: B023 - it has ended when the loop goes on
        server.kill()
        assert server.faults() == []
    (desk.launch / "f0.launch").write_text(texts["f0.launch"])
    server = desk.server()
    desk.open(server, texts)
    assert desk.said(server) == usual
    assert server.close() == 0


def test_two_servers_on_one_workspace(desk: Desk) -> None:
    texts = launch_files(desk)
    servers = [desk.server(), desk.server()]
    for server in servers:
        desk.open(server, texts)
    usual = desk.fresh(texts)
    assert [desk.said(server) for server in servers] == [usual, usual]
    # What is typed in one editor is nothing to the other one, until it is saved.
    middle = f"f{FILES // 2}.launch"
    mended = texts[middle].replace("<nod/>", "")
    desk.change(servers[0], middle, 2, mended)
    saved = desk.fresh({**texts, middle: mended})
    assert [desk.said(server) for server in servers] == [saved, usual]
    (desk.launch / middle).write_text(mended)
    for server in servers:
        desk.report(server, {desk.launch / middle: CHANGED})
    desk.change(servers[1], middle, 2, mended)
    assert [desk.said(server) for server in servers] == [saved, saved]
    assert [server.close() for server in servers] == [0, 0]
    third = desk.server()
    desk.open(third, {**texts, middle: mended})
    assert desk.said(third) == saved


def test_twenty_commands_at_once_with_one_cache(desk: Desk) -> None:
    launch_files(desk)
    command = [COMMAND[0], "check", "--no-run", "--format", "json", "--fail-on", "never", str(desk.workspace)]

    def started(home: str) -> subprocess.Popen[bytes]:
        environment = desk.environment(home)
        return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment)

    def findings(process: subprocess.Popen[bytes]) -> list[str]:
        output, errors = process.communicate(timeout=PATIENCE)
        assert process.returncode == 0, errors
        assert b"Traceback" not in errors
        return sorted(json.dumps(each, sort_keys=True) for each in json.loads(output)["findings"])

    usual = findings(started("alone"))
    assert "ARG001" in str(usual) and "LCH004" in str(usual)
    processes = [started("home") for _ in range(20)]
    assert [findings(process) for process in processes] == [usual] * 20
    assert findings(started("home")) == usual


def git(folder: Path, *arguments: str) -> str:
    identity = {"GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull}
    names = ("-c", "user.name=a", "-c", "user.email=a@example.org", "-c", "init.defaultBranch=main", "-c", "gc.auto=0")
    command = ["git", *names, "-C", str(folder), *arguments]
    return subprocess.run(command, check=True, capture_output=True, text=True, env={**os.environ, **identity}).stdout


@pytest.mark.parametrize("reports", ["all", "late"])
def test_branches_that_are_checked_out_while_somebody_types(desk: Desk, reports: str) -> None:
    texts = launch_files(desk)
    git(desk.workspace, "init", "--quiet")
    git(desk.workspace, "add", "--all")
    git(desk.workspace, "commit", "--quiet", "--message", "main")
    git(desk.workspace, "checkout", "--quiet", "-b", "other")
    last, middle = desk.launch / f"f{FILES - 1}.launch", desk.launch / f"f{FILES // 2}.launch"
    (desk.launch / f"f{FILES - 2}.launch").unlink()
    last.write_text(last.read_text().replace("$(arg b)", "$(arg a)"))
    middle.write_text(middle.read_text().replace("<nod/>", "<arg/>"))
    (desk.launch / "new.launch").write_text('<launch>\n  <include file="$(find p)/launch/f0.launch"/>\n</launch>\n')
    git(desk.workspace, "add", "--all")
    git(desk.workspace, "commit", "--quiet", "--message", "other")
    changed = [
        desk.workspace / line for line in git(desk.workspace, "diff", "--name-only", "main", "other").splitlines()
    ]
    assert len(changed) == 4
    typed = {"f0.launch": texts["f0.launch"]}
    server = desk.server()
    desk.open(server, typed)
    for number in range(12):
        there = {path: path.exists() for path in changed}
        git(desk.workspace, "checkout", "--quiet", "main" if number % 2 == 0 else "other")
        kinds = {
            path: CHANGED if path.exists() and before else CREATED if path.exists() else DELETED
            for path, before in there.items()
        }
        if reports == "all" or number == 11:
            desk.report(server, kinds)
        typed["f0.launch"] = texts["f0.launch"] + f"<!-- {'x' * number} -->\n"
        desk.change(server, "f0.launch", number + 2, typed["f0.launch"])
        position = {"line": 1, "character": 14}
        document = {"uri": (desk.launch / "f0.launch").as_uri()}
        server.request("textDocument/rename", {"textDocument": document, "position": position, "newName": "other_a"})
        server.request("textDocument/hover", {"textDocument": document, "position": position})
    assert desk.said(server) == desk.fresh(typed)
    assert server.close() == 0
