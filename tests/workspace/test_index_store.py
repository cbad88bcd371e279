"""The index from one start to the next: it is what a start without one would make, whatever changed in between."""

from __future__ import annotations

import hashlib
import json
import os
import random
import threading
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.documents.reading import digest
from preflight_analysis.environment.detect import detect
from preflight_analysis.evaluation.commands import CommandResult
from preflight_analysis.tracing import store as store_module
from preflight_analysis.workspace.index import WorkspaceIndex
from preflight_analysis.workspace.index_store import IndexStore, build_from_kept
from preflight_analysis.workspace.indexing import Earlier, build_index
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.kept_index import (
    AMENT,
    CATKIN,
    INSTALLED,
    LEAF,
    MANIFEST,
    PYTHON,
    ROOT,
    ROS2_LEAF,
    Counting,
    Starts,
    change,
)


@pytest.fixture
def starts(tmp_path: Path) -> Starts:
    return Starts(tmp_path)


def test_what_did_not_change_is_not_made_again(starts: Starts) -> None:
    starts.write("p/launch/leaf.launch", LEAF)
    starts.write("p/launch/root.launch", ROOT)
    starts.start()
    assert starts.made == ["p/launch/root.launch"]
    index = starts.start()
    assert starts.made == []
    assert [node.name for _, node in index.nodes()] == ["/a"]


def test_an_unchanged_index_is_not_written_again(starts: Starts) -> None:
    starts.write("p/launch/leaf.launch", LEAF)
    starts.start()
    [kept] = starts.kept
    written = kept.stat().st_ino
    starts.start()
    assert kept.stat().st_ino == written


def test_a_file_with_another_content_but_the_same_time_and_size_is_read(starts: Starts) -> None:
    path = starts.write("p/launch/leaf.launch", LEAF)
    before = path.stat()
    starts.start()
    path.write_text(LEAF.replace("arg x", "arg y"))
    os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))
    starts.start()
    assert starts.made == ["p/launch/leaf.launch"]


def test_a_file_that_was_only_touched_is_not(starts: Starts) -> None:
    path = starts.write("p/launch/leaf.launch", LEAF)
    starts.start()
    os.utime(path)
    starts.start()
    assert starts.made == []


def test_a_changed_file_costs_the_roots_that_reach_it(starts: Starts) -> None:
    starts.write("p/launch/leaf.launch", LEAF)
    starts.write("p/launch/root.launch", ROOT)
    starts.write("p/launch/other.launch", "<launch/>")
    starts.start()
    starts.write("p/launch/leaf.launch", "\n" + LEAF)
    starts.start()
    assert starts.made == ["p/launch/root.launch"]


def test_an_included_file_that_comes_is_noticed(starts: Starts) -> None:
    starts.write("p/launch/root.launch", ROOT)
    starts.start()
    starts.write("p/launch/leaf.launch", LEAF)
    assert [node.name for _, node in starts.start().nodes()] == ["/a"]
    (starts.folder / "p/launch/leaf.launch").unlink()
    assert [*starts.start().nodes()] == []


def test_what_is_there_counts_not_only_what_is_read(starts: Starts) -> None:
    starts.write("p/package.xml", MANIFEST.format("p", AMENT))
    starts.write("p/CMakeLists.txt", INSTALLED)
    starts.write("p/launch/a.launch.xml", '<launch><include file="$(find-pkg-share p)/made/b.launch.xml"/></launch>')
    named = '<launch><node pkg="p" exec="t" name="{}"/></launch>'

    def names() -> list[str]:
        return [node.name for root, node in starts.start().nodes() if root.path.endswith("a.launch.xml")]

    assert names() == []
    starts.write("p/from/b.launch.xml", named.format("built"))
    assert names() == ["/built"]
    installed = starts.write("p/made/b.launch.xml", named.format("there"))
    assert names() == ["/there"]
    starts.start()
    assert starts.made == []
    installed.unlink()
    assert names() == ["/built"]
    starts.write("p/CMakeLists.txt", "")
    assert names() == []


def test_a_program_that_a_substitution_finds_counts(starts: Starts) -> None:
    starts.write("p/package.xml", MANIFEST.format("p", AMENT))
    starts.write("p/CMakeLists.txt", "install(PROGRAMS scripts/t DESTINATION lib/${PROJECT_NAME})")
    starts.write("p/launch/a.launch.xml", '<launch><include file="$(exec-in-pkg t p)"/></launch>')
    starts.start()
    program = starts.write("p/scripts/t", LEAF)
    assert [inclusion.target for inclusion in starts.start().includers(str(program))] == [str(program)]
    program.unlink()
    assert starts.start().includers(str(program)) == ()


def test_only_the_variables_that_count_do(starts: Starts) -> None:
    starts.write("p/launch/one.launch", LEAF.replace("$(arg x)", "$(env ROBOT)"))
    starts.write("p/launch/two.launch", LEAF.replace("$(arg x)", "$(optenv OTHER none)"))
    starts.start()
    starts.variables["SHLVL"] = "2"
    starts.start()
    assert starts.made == []
    starts.variables["ROBOT"] = "wally"
    starts.start()
    assert starts.made == ["p/launch/one.launch"]
    starts.variables["OTHER"] = "there"
    starts.start()
    assert starts.made == ["p/launch/two.launch"]


def test_variables_of_ros2_count_where_they_are_read_set_or_handed_on(starts: Starts) -> None:
    starts.write("p/package.xml", MANIFEST.format("p", AMENT))
    starts.write("p/launch/read.launch.xml", ROS2_LEAF)
    starts.write("p/launch/appended.launch.xml", '<launch><append_env name="LIST" value="x"/></launch>')
    starts.write("p/launch/handed_on_launch.py", PYTHON.format("/nothing"))
    starts.write("p/launch/none.launch.xml", '<launch><node pkg="p" exec="t"/></launch>')
    starts.start()
    starts.variables["SHLVL"] = "2"
    starts.start()
    assert starts.made == []
    starts.variables["ROBOT"] = "wally"
    starts.start()
    assert sorted(starts.made) == ["p/launch/handed_on_launch.py", "p/launch/read.launch.xml"]
    starts.variables["LIST"] = "first"
    starts.start()
    assert starts.made == ["p/launch/appended.launch.xml"]


def test_what_was_made_of_a_secret_is_not_kept(starts: Starts) -> None:
    starts.variables["API_TOKEN"] = "hunter2"
    starts.write("p/launch/one.launch", LEAF.replace("$(arg x)", "$(env API_TOKEN)"))
    starts.start()
    starts.start()
    assert starts.made == ["p/launch/one.launch"]
    for secret in ("hunter2", digest("hunter2")):
        assert secret not in starts.kept[0].read_text()


def test_results_of_commands_and_runs_count(starts: Starts) -> None:
    starts.write("p/package.xml", MANIFEST.format("p", AMENT))
    starts.write("p/launch/a.launch.xml", "<launch><let name='n' value=\"$(command 'make name')\"/></launch>")
    starts.write("p/launch/b_launch.py", PYTHON.format("/nothing"))
    starts.start()
    starts.start()
    assert starts.made == []
    starts.commands.known["make name"] = CommandResult("done", "n")
    starts.start()
    assert starts.made == ["p/launch/a.launch.xml"]
    starts.commands.known["b_launch.py"] = CommandResult("failed", reason="broken")
    starts.start()
    assert starts.made == ["p/launch/b_launch.py"]


def test_another_environment_has_an_index_of_its_own(starts: Starts) -> None:
    starts.write("p/launch/leaf.launch", LEAF)
    starts.start()
    starts.write("q/package.xml", MANIFEST.format("q", CATKIN))
    starts.start()
    assert starts.made == ["p/launch/leaf.launch"]
    (starts.folder / "q/package.xml").unlink()
    starts.start()
    assert starts.made == []


def test_what_is_open_in_an_editor_counts(starts: Starts) -> None:
    path = starts.write("p/launch/leaf.launch", LEAF)
    starts.start()
    environment = detect(str(starts.folder), variables=starts.variables, package_path=[str(starts.folder)])
    for text, made in ((LEAF, []), (LEAF.replace("arg x", "arg y"), [str(path)])):
        workspace = Counting(environment, Sources())
        workspace.sources.open(str(path), text)
        build_from_kept(IndexStore(starts.store.folder), workspace, str(starts.folder))
        assert [*dict.fromkeys(workspace.made)] == made
    starts.start()
    assert starts.made == ["p/launch/leaf.launch"], "that text was never saved"


def test_places_are_right_after_edits_that_were_undone(starts: Starts) -> None:
    starts.write("p/launch/leaf.launch", LEAF)
    root = starts.write("p/launch/root.launch", ROOT.replace("><", ">\n<"))
    environment = detect(str(starts.folder), variables=starts.variables, package_path=[str(starts.folder)])
    workspace = Workspace(environment, Sources())
    text = root.read_text()
    workspace.sources.open(str(root), text)
    index = build_index(workspace, str(starts.folder))
    assert index is not None
    for new in ("", "\n" + text, text):
        workspace.sources.open(str(root), new)
    assert starts.store.save(workspace, str(starts.folder), index)
    starts.start()


def test_an_index_that_is_damaged_is_none(starts: Starts) -> None:
    starts.write("p/launch/leaf.launch", LEAF)
    starts.write("p/launch/root.launch", ROOT)
    starts.start()
    [path] = starts.kept
    data = path.read_bytes()
    for damaged in (b"", b"\n", data[:-1], data[: len(data) // 2], data.replace(b"leaf", b"loaf"), os.urandom(100)):
        path.write_bytes(damaged)
        starts.start()
        assert starts.made == ["p/launch/root.launch"]


def test_an_index_of_a_foreign_form_raises_nothing(starts: Starts) -> None:
    starts.write("p/launch/leaf.launch", LEAF)
    starts.write("p/launch/root.launch", ROOT)
    starts.start()
    [path] = starts.kept
    entry = json.loads(path.read_bytes().partition(b"\n")[2])
    chosen = random.Random(1)
    for _ in range(300):
        changed = json.loads(json.dumps(entry))
        for rows in ("files", "roots"):
            changed[rows] = [json.loads(text) for text in changed[rows]]
        replace_one(changed, chosen)
        for rows in ("files", "roots"):
            if isinstance(changed.get(rows), list):
                changed[rows] = [json.dumps(some) if chosen.random() < 0.9 else some for some in changed[rows]]
        data = json.dumps(changed, sort_keys=True).encode()
        path.write_bytes(hashlib.sha256(data).hexdigest().encode() + b"\n" + data)
        environment = detect(str(starts.folder), variables=starts.variables, package_path=[str(starts.folder)])
        workspace = Workspace(environment, Sources())
        earlier = Earlier(starts.store.load(workspace, str(starts.folder)))
        index = build_index(workspace, str(starts.folder), earlier=earlier)
        assert index is not None
        assert all(isinstance(node.name, str) for _, node in index.nodes())


def replace_one(value: Any, chosen: random.Random) -> None:
    """Replace something in plain data by something else."""
    while True:
        keys = list(value) if isinstance(value, dict) else list(range(len(value)))
        key = chosen.choice(keys)
        if isinstance(value[key], dict | list) and value[key] and chosen.random() < 0.8:
            value = value[key]
            continue
        value[key] = chosen.choice([None, -1, 10**9, 1.5, "", "x", [], {}, [1], True, {"a": 1}])
        return


@pytest.mark.parametrize("refused", ["replace", "mkstemp"])
def test_a_full_or_read_only_disk_costs_nothing_but_the_next_start(
    starts: Starts, refused: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    starts.write("p/launch/leaf.launch", LEAF)
    module = {"replace": store_module.os, "mkstemp": store_module.tempfile}[refused]
    monkeypatch.setattr(module, refused, full)
    starts.start()
    starts.start()
    assert starts.made == ["p/launch/leaf.launch"]
    assert starts.kept == []


def test_two_servers_share_a_store(starts: Starts) -> None:
    for number in range(20):
        starts.write(f"p/launch/{number}.launch", LEAF)
    environment = detect(str(starts.folder), variables=starts.variables, package_path=[str(starts.folder)])
    found: list[WorkspaceIndex | None] = []

    def serve() -> None:
        for number in range(10):
            starts.write(f"p/launch/{number}.launch", LEAF.replace("arg x", f"arg y{random.random()}"))
            found.append(build_from_kept(starts.store, Workspace(environment, Sources()), str(starts.folder)))

    threads = [threading.Thread(target=serve) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len([index for index in found if index is not None and index.complete]) == 20
    starts.start()
    assert len(starts.kept) == 1


@pytest.mark.parametrize("seed", range(6))
def test_whatever_changes_between_two_starts_the_index_is_that_of_a_cold_one(starts: Starts, seed: int) -> None:
    chosen = random.Random(seed)
    for _ in range(40):
        for _ in range(chosen.choice([0, 1, 1, 2])):
            change(starts, chosen)
        starts.start()
