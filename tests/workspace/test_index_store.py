"""The index from one start to the next: it is what a start without one would make, whatever changed in between."""

from __future__ import annotations

import hashlib
import json
import os
import random
import threading
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.documents.reading import digest
from preflight_analysis.environment.detect import detect
from preflight_analysis.evaluation.commands import CommandResult, NoResults
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.tracing import store as store_module
from preflight_analysis.workspace.index import WorkspaceIndex
from preflight_analysis.workspace.index_store import IndexStore, build_from_kept
from preflight_analysis.workspace.indexing import build_index
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

LEAF = '<launch><arg name="x"/><node pkg="p" type="t" name="$(arg x)"/></launch>'
ROOT = '<launch><include file="$(find p)/launch/leaf.launch"><arg name="x" value="a"/></include></launch>'
ROS2_LEAF = '<launch><let name="n" value="$(env ROBOT nobody)"/><node pkg="p" exec="t" name="$(var n)"/></launch>'
ROS2_ROOT = '<launch><include file="$(find-pkg-share p)/launch/leaf.launch.xml"/></launch>'
PYTHON = """\
import os
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch_ros.actions import Node
from launch.launch_description_sources import AnyLaunchDescriptionSource

def generate_launch_description():
    return LaunchDescription([
        Node(package='p', executable='t', name=os.environ['ROBOT']),
        IncludeLaunchDescription(AnyLaunchDescriptionSource('{}')),
    ])
"""
MANIFEST = "<package format='3'><name>{}</name>{}</package>"
CATKIN, AMENT = "<buildtool_depend>catkin</buildtool_depend>", "<export><build_type>ament_cmake</build_type></export>"


class Starts:
    """A workspace that is indexed by one process after another."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder / "workspace"
        self.store = IndexStore(folder / "store")
        self.variables = {"PATH": os.environ["PATH"], "HOME": str(folder), "ROBOT": "rosie", "SHLVL": "1"}
        self.commands = Results()
        self.made: list[str] = []
        """The roots that the last start evaluated."""
        self.write("p/package.xml", MANIFEST.format("p", CATKIN))

    def write(self, name: str, text: str) -> Path:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def start(self) -> WorkspaceIndex:
        """The index of a new process, which is that of one that has none kept."""
        environment = detect(str(self.folder), variables=self.variables, package_path=[str(self.folder)])
        workspace = Counting(environment, Sources(), commands=self.commands)
        index = build_from_kept(self.store, workspace, str(self.folder))
        # A root of files that were written just now is evaluated again: the next change might not show.
        self.made = [os.path.relpath(path, self.folder) for path in dict.fromkeys(workspace.made)]
        assert index is not None
        cold = build_index(workspace, str(self.folder))
        assert cold is not None
        assert index.files == cold.files
        assert index.entries == cold.entries
        assert index.written == cold.written
        return index

    @property
    def kept(self) -> list[Path]:
        return sorted(self.store.folder.glob("*/*/*.json"))


class Counting(Workspace):
    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.made: list[str] = []

    def tree(self, path: str, args: Mapping[str, str], *rest: Any) -> LaunchTree:
        self.made.append(path)
        return super().tree(path, args, *rest)


class Results(NoResults):
    def __init__(self) -> None:
        self.known: dict[str, CommandResult] = {}

    def result(self, line: str) -> CommandResult | None:
        return next((found for part, found in self.known.items() if part in line), None)


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
        replace_one(changed, chosen)
        data = json.dumps(changed, sort_keys=True).encode()
        path.write_bytes(hashlib.sha256(data).hexdigest().encode() + b"\n" + data)
        environment = detect(str(starts.folder), variables=starts.variables, package_path=[str(starts.folder)])
        workspace = Workspace(environment, Sources())
        index = build_index(
            workspace, str(starts.folder), previous=starts.store.load(workspace, str(starts.folder)), changed=()
        )
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


TEXTS = (
    LEAF,
    ROOT,
    "\n\n" + ROOT,
    ROS2_LEAF,
    ROS2_ROOT,
    '<launch><include file="$(dirname)/{}"/></launch>',
    '<launch>\n<include file="$(find p)/launch/{}" pass_all_args="true"/><arg name="x" default="1"/></launch>',
    '<launch><include file="$(find q)/launch/{}"/></launch>',
    "<launch><include if=\"$(eval env('ROBOT') == 'rosie')\" file=\"$(dirname)/{}\"/></launch>",
    '<launch><include file="$(find-pkg-share p)/launch/../launch/{}"/></launch>',
    '<launch><include file="$(find-pkg-share q)/launch/{}"/><set_env name="ROBOT" value="$(env SHLVL)"/></launch>',
    '<launch><rosparam file="$(find p)/config/a.yaml"/><include file="$(find p)/launch/{}"/></launch>',
    "launch:\n- include:\n    file: $(dirname)/{}\n- node: {{pkg: p, exec: t, name: $(env ROBOT)}}\n",
    PYTHON,
    "<launch><unclosed",
    "",
    '<launch><include file="$(find-pkg-share p)/made/{}"/></launch>',
    '<launch><node pkg="p" exec="t" name="$(exec-in-pkg t p)"/></launch>',
    '<launch><node pkg="p" exec="t" name="$(find-exec t)"/><include file="$(find-exec t)"/></launch>',
)
INSTALLED = "install(DIRECTORY from/ DESTINATION share/${PROJECT_NAME}/made)\n"
INSTALLED_PROGRAM = "install(PROGRAMS scripts/t DESTINATION lib/${PROJECT_NAME})\n"
NAMES = ("a.launch", "b.launch", "leaf.launch", "a.launch.xml", "leaf.launch.xml", "c_launch.py", "d.launch.yaml")


@pytest.mark.parametrize("seed", range(6))
def test_whatever_changes_between_two_starts_the_index_is_that_of_a_cold_one(starts: Starts, seed: int) -> None:
    chosen = random.Random(seed)
    for _ in range(40):
        for _ in range(chosen.choice([0, 1, 1, 2])):
            change(starts, chosen)
        starts.start()


def change(starts: Starts, chosen: random.Random) -> None:
    package, name = chosen.choice("pq"), chosen.choice(NAMES)
    path = starts.folder / package / "launch" / name
    match chosen.randrange(14):
        case 0:
            path.unlink(missing_ok=True)
        case 1:
            build = chosen.choice([CATKIN, AMENT, ""])
            starts.write(f"{package}/package.xml", MANIFEST.format(package, build))
        case 2:
            (starts.folder / "q/package.xml").unlink(missing_ok=True)
        case 3:
            starts.write("p/config/a.yaml", chosen.choice(["a: 1", "a: [", ""]))
        case 4:
            starts.variables[chosen.choice(["ROBOT", "SHLVL", "OTHER"])] = chosen.choice(["rosie", "wally", "1"])
        case 5:
            starts.variables.pop("ROBOT", None)
        case 6:
            marker = starts.folder / package / "COLCON_IGNORE"
            marker.unlink() if marker.exists() else starts.write(f"{package}/COLCON_IGNORE", "")
        case 7:
            program = starts.write(f"{package}/scripts/t", "#!/bin/sh")
            program.chmod(chosen.choice([0o644, 0o755]))
        case 8:
            (starts.folder / package / "scripts/t").unlink(missing_ok=True)
        case 9:
            starts.write(f"{package}/CMakeLists.txt", chosen.choice(["", INSTALLED, INSTALLED + INSTALLED_PROGRAM]))
        case 10:
            starts.write(f"{package}/from/{name}", chosen.choice(TEXTS).replace("{}", chosen.choice(NAMES)))
        case _:
            starts.write(f"{package}/launch/{name}", chosen.choice(TEXTS).replace("{}", chosen.choice(NAMES)))
