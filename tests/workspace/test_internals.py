"""What is shown of a launch says nothing of how we know it: of runs in the sandbox, of values that are not known.

`tests/conftest.py` has the findings of every other test looked at.
"""

from __future__ import annotations

import dataclasses
import re
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.report import Report, to_json, to_text
from preflight_analysis.graph.graph_json import graph_json
from preflight_analysis.queries.hints import hints
from preflight_analysis.queries.hover import hover
from preflight_analysis.queries.lenses import lenses
from preflight_analysis.queries.node_tree import node_tree
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.tracing.commands import CommandCache, CommandRunner
from preflight_analysis.workspace.commands import CommandResults
from preflight_analysis.workspace.indexing import build_index
from preflight_analysis.workspace.not_run import not_run
from preflight_analysis.workspace.resolve_commands import Resolving, resolve_commands
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.tree_json import tree_json
from preflight_analysis.workspace.workspace import Workspace
from support.command import run_command
from support.internals import shown_internals, strings_in, texts_of

pytestmark = pytest.mark.ros

_FIXTURES = Path(__file__).parents[2] / "fixtures"
_MANIFEST = """<package format="3"><name>p</name><version>0.0.0</version><description>d</description>
<maintainer email="a@b.c">a</maintainer><license>MIT</license><export><build_type>ament_cmake</build_type></export>
</package>"""
_HEAD = """
import os
from absent_library import camera, load
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import *
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import *
from launch_ros.actions import Node, PushRosNamespace
from launch_ros.descriptions import ParameterFile
from launch_ros.substitutions import FindPackageShare

robot, name, share = os.getenv('ROBOT_THAT_IS_NOT_SET'), camera.name(), get_package_share_directory('p')
"""
_UNKNOWN = {
    "names": """
        Node(package='p', executable='n.py', name=name, namespace=camera.space, remappings=[('in', camera.topic)]),
        Node(package='p', executable='n.py', name=name, namespace=camera.space, remappings=[('in', camera.topic)]),
        Node(package=camera.package, executable=camera.program, name='fixed', output=camera.output),
        Node(package='p', executable=f'{camera.model}.py', name=f'{robot}_base', arguments=[camera, f'{name}/x']),
        GroupAction([PushRosNamespace(camera.space), Node(package='p', executable='n.py', name='in_group')]),
    """,
    "parameters": """
        Node(package='p', executable='n.py', name='n', parameters=[{'rate': camera.rate, camera.key: 1, 'a': None}]),
        Node(package='p', executable='n.py', name='m', parameters=[load(name), {'list': [camera.x, 2]}]),
        Node(package='p', executable='n.py', name='file', parameters=[os.path.join(share, 'config', f'{robot}.yaml')]),
        Node(package='p', executable='n.py', name='other', parameters=[ParameterFile(str(camera.file))]),
        Node(package='p', executable='n.py', name='path', parameters=[share + '/config/' + str(robot) + '.yaml']),
        Node(package='p', executable='n.py', name='xacro', parameters=[{
            'robot_description': Command(['xacro ', str(share), '/urdf/', str(robot), '.urdf.xacro ', camera.flags])}]),
    """,
    "arguments": """
        DeclareLaunchArgument('rate', default_value=str(camera.rate), description=camera.text, choices=[name, 'b']),
        DeclareLaunchArgument('world', default_value=[camera.world, '.sdf']),
        SetEnvironmentVariable(camera.variable, camera.value),
        LogInfo(msg=['at ', LaunchConfiguration('rate'), LaunchConfiguration(camera.argument)]),
        Node(package='p', executable='n.py', name='n', condition=IfCondition(camera.enabled)),
        Node(package='p', executable='n.py', name=LaunchConfiguration('rate'), arguments=LaunchConfiguration('world')),
    """,
    "includes": """
        IncludeLaunchDescription(PythonLaunchDescriptionSource(os.path.join(share, 'launch', f'{robot}.launch.py'))),
        IncludeLaunchDescription(PythonLaunchDescriptionSource(camera.launch_file),
                                 launch_arguments={'a': name}.items()),
        IncludeLaunchDescription(PythonLaunchDescriptionSource([share, '/launch/arguments.launch.py']),
                                 launch_arguments={camera.argument: '1', 'rate': camera.rate}.items()),
        IncludeLaunchDescription(os.path.join(FindPackageShare(name), 'launch', 'x.launch.py')),
    """,
    "functions": """
        OpaqueFunction(function=lambda context: [Node(package='p', executable='n.py', name=camera.of(context))]),
        OpaqueFunction(function=lambda context: [
            Node(package='p', name='x', executable=context.launch_configurations[name])]),
        RegisterEventHandler(camera.handler), TimerAction(period=camera.period, actions=[camera.action]),
        ExecuteProcess(cmd=[camera.program, '--rate', camera.rate, f'{robot}'], name=camera.name), camera.action(),
    """,
    "fails": "Node(package='p', executable='a'.replace('a', next(iter([camera.x])))), *[].index(camera.x),",
    "fails_in_a_library": "__import__('shlex').split(camera), __import__('json').loads(robot),",
    "fails_for_want": "__import__('pathlib').Path(robot) / 'config', open(f'/config/{robot}.yaml'),",
    "fails_for_a_name": "__import__('launch.actions', fromlist=['x']).OfTomorrow(), Node(pakage='p', executable='n'),",
    "is_no_python": "Node(package='p' executable='n'),",
}
"""Launch descriptions with what nobody knows in every place, and what they fail for."""


def shown(folder: Path, launch: Path) -> Iterator[str]:
    """All that is shown of a launch file, in an editor and by the commands; programs that it needs are run."""
    environment = detect_environment(str(folder), {"PATH": "/usr/bin:/bin", "HOME": str(folder)})
    results = CommandResults(lambda: None)
    workspace = Workspace(environment, Sources(), str(folder), results)
    runner = CommandRunner(environment, str(folder), CommandCache(folder / ".cache"))
    found = resolve_commands(workspace, str(launch), {}, Resolving(results, runner))
    found = workspace.with_interfaces(found, [not_run(node, "a test") for node in found.tree.nodes], "a test")
    assert found.graph is not None
    yield from texts_of(found.findings)
    report = Report(found.findings, found.documents)
    yield to_text(report, base=str(folder))
    for data in (to_json(report), tree_json(found.tree, found.documents, found.findings), graph_json(found.graph)):
        yield from strings_in(data)
    yield from _texts_in(node_tree(found, {}))
    index = build_index(workspace, str(folder), ())
    assert index is not None
    for path in found.launch_files:
        text = found.documents[path].text
        yield from _texts_in(hints([found], path, Span(0, len(text))))
        yield from _texts_in(lenses(QueryContext(path, (found,), index, workspace)))
        for word in re.finditer(r"\w+", text):
            yield from _texts_in(hover([found], path, word.start(), 0))


def _texts_in(value: Any) -> Iterator[str]:
    """The texts in what queries answer; of what is written in files only places are told."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, (list, tuple)):
        for each in value:
            yield from _texts_in(each)
    elif dataclasses.is_dataclass(value) and not isinstance(value, Document):
        for each in dataclasses.fields(value):
            yield from _texts_in(getattr(value, each.name))


@pytest.fixture
def launches(tmp_path: Path) -> Path:
    """The folder of the launch files of `_UNKNOWN`."""
    package = tmp_path / "src" / "p"
    (package / "launch").mkdir(parents=True)
    for name, actions in _UNKNOWN.items():
        body = f"{_HEAD}\n\ndef generate_launch_description():\n    return LaunchDescription([{actions}\n    ])\n"
        (package / "launch" / f"{name}.launch.py").write_text(body)
    (package / "package.xml").write_text(_MANIFEST)
    (package / "CMakeLists.txt").write_text(
        "project(p)\ninstall(DIRECTORY launch DESTINATION share/p)\ninstall(PROGRAMS n.py DESTINATION lib/p)\n"
    )
    (package / "n.py").write_text("#!/usr/bin/env python3\n")
    return package / "launch"


@pytest.mark.parametrize("name", _UNKNOWN)
def test_launch_files_with_what_nobody_knows(tmp_path: Path, launches: Path, name: str) -> None:
    assert shown_internals(shown(tmp_path, launches / f"{name}.launch.py")) == []


def test_what_the_commands_print(tmp_path: Path, launches: Path) -> None:
    program, home = Path(sys.executable).with_name("ros-preflight"), str(tmp_path / "home")
    for command in (("check", "."), *((verb, launches / "names.launch.py") for verb in ("tree", "graph", "frames"))):
        done = run_command(program, *command, environment={"PATH": "/usr/bin:/bin", "HOME": home}, cwd=tmp_path)
        assert done.out
        assert shown_internals((done.out, done.err)) == []


@pytest.mark.parametrize("name", ["ros1/demo", "ros1/robot", "ros1/services", "ros1/tutorials", "ros2/chapter"])
def test_launch_files_of_the_fixtures(tmp_path: Path, name: str) -> None:
    folder = shutil.copytree(_FIXTURES / name, tmp_path / "src", symlinks=True)
    launches = sorted(path for path in folder.rglob("*.launch*") if path.is_file())
    assert launches
    for launch in launches:
        assert shown_internals(shown(tmp_path, launch)) == []
