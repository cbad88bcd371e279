"""Processes that make parts of a cold index: together they come to what one process makes, and none is left."""

from __future__ import annotations

import random
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.environment.detect import detect
from preflight_analysis.evaluation.commands import CommandResult, KnownResults
from preflight_analysis.workspace import index_processes, index_store
from preflight_analysis.workspace.commands import CommandResults
from preflight_analysis.workspace.index import Root, WorkspaceIndex
from preflight_analysis.workspace.index_processes import parts_by_processes
from preflight_analysis.workspace.index_store import build_from_kept
from preflight_analysis.workspace.indexing import build_index, launch_files
from preflight_analysis.workspace.sources import Sources
from support.kept_index import AMENT, LEAF, MANIFEST, PYTHON, ROOT, Counting, Starts, change


@pytest.fixture
def starts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Starts:
    monkeypatch.setattr(index_store, "MANY", 1)
    monkeypatch.setattr(index_processes, "_FEWEST", 2)
    return Starts(tmp_path)


@pytest.fixture
def processes(monkeypatch: pytest.MonkeyPatch) -> list[subprocess.Popen[bytes]]:
    """Those that were started."""
    started: list[subprocess.Popen[bytes]] = []

    class Noted(subprocess.Popen[bytes]):
        def __init__(self, *args: Any, **kwargs: Any) -> None:
            super().__init__(*args, **kwargs)
            if args[0][0] == sys.executable:
                started.append(self)

    monkeypatch.setattr(subprocess, "Popen", Noted)
    return started


def counting(starts: Starts) -> Counting:
    environment = detect(str(starts.folder), variables=starts.variables, package_path=[str(starts.folder)])
    return Counting(environment, Sources(), commands=starts.commands)


def test_what_processes_make_is_not_made_again(starts: Starts, processes: list[subprocess.Popen[bytes]]) -> None:
    starts.write("p/launch/leaf.launch", LEAF)
    starts.write("p/launch/root.launch", ROOT)
    for number in range(6):
        starts.write(f"p/launch/z{number}.launch", "<launch><rosparam file='$(find p)/a.yaml'/></launch>")
    index = starts.start()
    assert starts.made == []
    assert [node.name for _, node in index.nodes()] == ["/a"]
    assert 1 <= len(processes) <= 4
    assert all(process.poll() is not None for process in processes)


@pytest.mark.parametrize("seed", range(2))
def test_whatever_there_is_the_index_is_that_of_one_process(starts: Starts, seed: int) -> None:
    chosen = random.Random(seed)
    for _ in range(5):
        for _ in range(12):
            change(starts, chosen)
        starts.start()


def test_roots_of_the_settings_are_evaluated_with_their_arguments(starts: Starts) -> None:
    leaf = starts.write("p/launch/leaf.launch", LEAF)
    for number in range(6):
        starts.write(f"p/launch/z{number}.launch", "<launch/>")
    named = [Root(str(leaf), (("x", "one"),)), Root(str(leaf), (("x", "two"),))]
    workspace = counting(starts)
    index = build_from_kept(starts.store, workspace, str(starts.folder), named)
    assert workspace.made == []
    assert index is not None
    assert sorted(node.name for _, node in index.nodes()) == ["/one", "/two"]


def test_results_of_commands_are_handed_over(starts: Starts) -> None:
    starts.write("p/package.xml", MANIFEST.format("p", AMENT))
    for number in range(4):
        starts.write(f"p/launch/{number}_launch.py", PYTHON.format("/nothing"))
    workspace = counting(starts)
    workspace.commands = CommandResults(lambda: "it is not trusted")
    build_from_kept(starts.store, workspace, str(starts.folder))
    assert workspace.made == []


def test_a_snapshot_of_results_has_the_same() -> None:
    why: list[str | None] = ["it is not trusted"]
    results = CommandResults(lambda: why[0], "x")
    results.update({"a": CommandResult("done", "1")})
    known = results.snapshot()
    assert isinstance(known, KnownResults)
    for line in ("a", "b"):
        assert known.result(line) == results.result(line)
    why[0] = None
    assert known.result("b") == CommandResult("not-run", reason="it is not trusted")
    assert results.snapshot().result("b") is None
    assert results.snapshot().placeholder == "x"


def test_what_is_typed_in_an_editor_counts(starts: Starts) -> None:
    path = starts.write("p/launch/leaf.launch", LEAF)
    workspace = counting(starts)
    workspace.sources.open(str(path), LEAF.replace("arg x", "arg y"))
    index = build_from_kept(starts.store, workspace, str(starts.folder))
    assert workspace.made == [str(path)]
    assert index == build_index(workspace, str(starts.folder))


@pytest.mark.parametrize(
    "program",
    [
        "raise SystemExit(1)",
        "print('no JSON')",
        "print('{}'); print('[]'); print('null'); print(1)",
        "import os; os.write(1, b'x' * 100_000)",
        "import os; os.close(0); os.close(1)",
        'print(\'{"files": ["[[0, [0]]]"], "roots": ["[["], "paths": [""], "observations": []}\')',
    ],
)
def test_a_process_that_fails_costs_time_alone(
    starts: Starts, program: str, monkeypatch: pytest.MonkeyPatch, processes: list[subprocess.Popen[bytes]]
) -> None:
    monkeypatch.setattr(index_processes, "_PROGRAM", program)
    monkeypatch.setattr(index_processes, "_MOST_BYTES", 1000)
    starts.write("p/launch/leaf.launch", LEAF)
    starts.write("p/launch/root.launch", ROOT)
    starts.start()
    assert starts.made == ["p/launch/root.launch"]
    assert processes
    assert all(process.poll() is not None for process in processes)


def test_no_process_can_be_started(starts: Starts, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "executable", f"/does/not/exist/{Path(sys.executable).name}")
    starts.write("p/launch/root.launch", ROOT)
    starts.start()
    assert starts.made == ["p/launch/root.launch"]


def test_none_is_left_when_it_is_cancelled(starts: Starts, processes: list[subprocess.Popen[bytes]]) -> None:
    starts.write("p/launch/leaf.launch", LEAF)
    answers = iter([False])
    assert build_from_kept(
        starts.store, counting(starts), str(starts.folder), cancelled=lambda: next(answers, True)
    ) in (None, WorkspaceIndex())
    assert processes
    assert all(process.poll() is not None for process in processes)


def test_none_is_left_when_nobody_wants_more(starts: Starts, processes: list[subprocess.Popen[bytes]]) -> None:
    starts.write("p/launch/leaf.launch", LEAF)
    workspace = counting(starts)
    parts: Iterator[WorkspaceIndex] = parts_by_processes(
        workspace, launch_files(str(starts.folder), workspace), (), lambda: False
    )
    next(parts)
    parts.close()  # type: ignore[attr-defined]  # it is a generator
    assert [process.poll() is not None for process in processes] == [True]


def test_it_ends_with_who_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    wait = "import os, threading, time\nfrom preflight_analysis.workspace.index_processes import _end_with_asker\n"
    wait += "threading.Thread(target=_end_with_asker, daemon=True).start(); time.sleep(600)"
    with subprocess.Popen([sys.executable, "-c", wait], stdin=subprocess.PIPE) as process:
        assert process.stdin is not None
        process.stdin.close()
        assert process.wait(60) == 0


def test_nothing_is_imported_from_where_it_was_started(
    starts: Starts, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    trap = starts.write("preflight_analysis/__init__.py", f"open({str(tmp_path / 'sprung')!r}, 'w')")
    (trap.parent.parent / "json.py").write_text(trap.read_text())
    monkeypatch.chdir(starts.folder)
    monkeypatch.setenv("PYTHONPATH", str(starts.folder))
    starts.write("p/launch/leaf.launch", LEAF)
    starts.start()
    assert starts.made == []
    assert not (tmp_path / "sprung").exists()
