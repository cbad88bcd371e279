"""A workspace of 300 Python launch files: its cold index by reading them, against one where each is run.

  python bench/python_index.py [-n FILES | --quick]

Half of the files start nodes of their own, the others include one of these and have an `OpaqueFunction`. Read: the
index of a workspace without anything kept. Run: all runs that its launches ask for, in sandboxes and without a cache,
as many at a time as the product does, and then the same index. Prints the seconds and the ratio. It fails where that is
below `TARGET`, and where both indexes do not have the same nodes.
"""

from __future__ import annotations

import tempfile
import time
from pathlib import Path

from options import Options
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.tracing.commands import CommandRunner
from preflight_analysis.workspace.commands import CommandResults
from preflight_analysis.workspace.index import Root, WorkspaceIndex
from preflight_analysis.workspace.indexing import build_index
from preflight_analysis.workspace.resolve_commands import Resolving, resolve_together
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from results import record

TARGET = 3.0
MANIFEST = """<package format="3"><name>fleet</name><version>0.1.0</version><description>d</description>
<maintainer email="a@example.org">a</maintainer><license>MIT</license>
<export><build_type>ament_python</build_type></export></package>
"""
HEAD = """import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, OpaqueFunction
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

SHARE = get_package_share_directory("fleet")

"""
NODES = """
def generate_launch_description():
    description = LaunchDescription([DeclareLaunchArgument("rate", default_value="5")])
    for number in range(4):
        description.add_action(Node(
            package="fleet", executable="talker", name=f"talker_{n}_{{number}}", namespace="robot_{n}",
            parameters=[{{"rate": LaunchConfiguration("rate"), "frame": f"base_{{number}}"}}],
            remappings=[("chatter", "/robot_{n}/words")]))
    return description
"""
INCLUDES = """
def more(context):
    rate = LaunchConfiguration("rate").perform(context)
    return [Node(package="fleet", executable="listener", name="listener_{n}", arguments=[rate])]


def generate_launch_description():
    file = os.path.join(SHARE, "launch", "part_{of}.launch.py")
    return LaunchDescription([
        DeclareLaunchArgument("rate", default_value="{n}"),
        IncludeLaunchDescription(PythonLaunchDescriptionSource(file),
                                 launch_arguments={{"rate": LaunchConfiguration("rate")}}.items()),
        OpaqueFunction(function=more),
    ])
"""


def generate(folder: Path, count: int) -> list[Root]:
    """The launch files of one package, as roots."""
    launch = folder / "fleet" / "launch"
    launch.mkdir(parents=True)
    (folder / "fleet" / "package.xml").write_text(MANIFEST)
    for n in range(count):
        body = NODES.format(n=n) if n % 2 == 0 else INCLUDES.format(n=n, of=n - 1)
        (launch / f"part_{n}.launch.py").write_text(HEAD + body)
    return [Root.of(str(path), {}) for path in sorted(launch.iterdir())]


def indexed(folder: Path, roots: list[Root], *, runs: bool) -> tuple[float, WorkspaceIndex]:
    """The seconds of a cold index, and it."""
    environment = detect_environment(str(folder), {"PATH": "/usr/bin:/bin", "ROS_DISTRO": "jazzy", "ROS_VERSION": "2"})
    results = CommandResults(lambda: None)
    workspace = Workspace(environment, Sources(), str(folder), results, reads=not runs)
    began = time.perf_counter()
    if runs:
        runner = CommandRunner(environment, str(folder), None)
        resolve_together(workspace, roots, Resolving(results, runner, only_launch_files=True))
    index = build_index(workspace, str(folder))
    assert index is not None
    return time.perf_counter() - began, index


def names(index: WorkspaceIndex) -> list[str]:
    """What the index says of the nodes of each launch."""
    return sorted(f"{root.path} {entry.name} {entry.package}/{entry.executable}" for root, entry in index.nodes())


def main() -> None:
    args = Options(__doc__, n=300, quick=4, metavar="FILES", help="launch files of the workspace").read()
    with tempfile.TemporaryDirectory() as folder:
        roots = generate(Path(folder), args.n)
        read, by_reading = indexed(Path(folder), roots, runs=False)
        run, by_runs = indexed(Path(folder), roots, runs=True)
    if names(by_reading) != names(by_runs):
        raise SystemExit("the nodes are not the same")
    ratio = run / read
    print(f"{args.n} Python launch files, {len(names(by_reading))} nodes: read {read:.2f} s, run {run:.2f} s")
    print(f"run : read = {ratio:.1f} (target: {TARGET:.0f})")
    record(args.quick, python_index_300_files_s=read, python_index_runs_over_reading_ratio=ratio)
    if ratio < TARGET and not args.quick:
        raise SystemExit(f"reading is only {ratio:.1f} times as fast as runs")


if __name__ == "__main__":
    main()
