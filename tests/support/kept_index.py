"""A workspace whose index is kept from one start to the next, and random changes to it."""

from __future__ import annotations

import os
import random
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from preflight_analysis.environment.detect import detect
from preflight_analysis.evaluation.commands import CommandResult, NoResults
from preflight_analysis.evaluation.tree import LaunchTree
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

    def outline(self, path: str, args: Mapping[str, str]) -> LaunchTree:
        self.made.append(path)
        return super().outline(path, args)


class Results(NoResults):
    def __init__(self) -> None:
        self.known: dict[str, CommandResult] = {}

    def result(self, line: str) -> CommandResult | None:
        return next((found for part, found in self.known.items() if part in line), None)


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


def change(starts: Starts, chosen: random.Random) -> None:
    """Change something that an index may depend on."""
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
