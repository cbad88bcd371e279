"""Editing Python launch files through the real server: what is ours in them, half typed or whole."""

from __future__ import annotations

from pathlib import Path
from typing import TypeVar

import pytest
from lsprotocol import types
from support.editor_harness import Harness
from support.lsp_client import Editor, capabilities, editing, position

pytestmark = pytest.mark.ros
T = TypeVar("T")

MANIFEST = """<package format="3"><name>robot</name><version>0.0.0</version><description>d</description>
<maintainer email="a@b.c">m</maintainer><license>MIT</license>
<exec_depend>rclpy</exec_depend><export><build_type>ament_python</build_type></export></package>
"""
SETUP = """from setuptools import setup
setup(
    name="robot",
    packages=["robot"],
    data_files=[("share/robot", ["package.xml", "params.yaml"]),
                ("share/robot/launch", ["launch/main.launch.py", "launch/inner.launch.py", "launch/outer.launch.xml"])],
    entry_points={"console_scripts": ["talker = robot.talker:main", "listener = robot.listener:main"]},
)
"""
TALKER = """import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        self.declare_parameter("rate", 10.0)
        self.declare_parameter("frame", "map")
        self.declare_parameter("limits.low", 1)
        self.publisher = self.create_publisher(String, "chatter", 10)


def main():
    rclpy.init()
    rclpy.spin(Talker())
"""
LISTENER = TALKER.replace("Talker", "Listener").replace('"talker"', '"listener"')
LISTENER = LISTENER.replace('publisher(String, "chatter", ', 'subscription(String, "words", print, ')
HEAD = """import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import ComposableNodeContainer, Node
from launch_ros.descriptions import ComposableNode
from launch_ros.substitutions import FindPackageShare


"""
INNER = (
    HEAD
    + """def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('speed', default_value='1.0', description='In m/s'),
        DeclareLaunchArgument('model'),
        Node(package='robot', executable='listener', name='listener',
             parameters=[{'frame': LaunchConfiguration('speed', default='2')}],
             condition=IfCondition(LaunchConfiguration(variable_name='model'))),
    ])
"""
)
MAIN = (
    HEAD
    + """def generate_launch_description():
    share = get_package_share_directory('robot')
    return LaunchDescription([
        DeclareLaunchArgument('speed', default_value='5.0'),
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(
                PathJoinSubstitution([FindPackageShare('robot'), 'launch', 'inner.launch.py'])),
            launch_arguments={'speed': LaunchConfiguration('speed'), 'model': 'true'}.items(),
        ),
        Node(package='robot', executable='talker', name='talker',
             parameters=[os.path.join(share, 'params.yaml')], remappings=[('chatter', 'words')]),
    ])
"""
)
OUTER = """<launch>
  <include file="$(find-pkg-share robot)/launch/inner.launch.py">
    <arg name="speed" value="3.0"/>
    <arg name="model" value="true"/>
  </include>
</launch>
"""
PARAMS = """talker:
  ros__parameters:
    rate: 5.0
"""


@pytest.fixture
def package(harness: Harness) -> Path:
    folder = harness.home / "ros2_ws/src/robot"
    (folder / "robot").mkdir(parents=True)
    (folder / "launch").mkdir()
    for name, text in {
        "package.xml": MANIFEST,
        "setup.py": SETUP,
        "robot/__init__.py": "",
        "robot/talker.py": TALKER,
        "robot/listener.py": LISTENER,
        "launch/main.launch.py": MAIN,
        "launch/inner.launch.py": INNER,
        "launch/outer.launch.xml": OUTER,
        "params.yaml": PARAMS,
    }.items():
        (folder / name).write_text(text)
    return folder


async def completed(editor: Editor, path: Path, body: str, trigger: str | None = None) -> list[str]:
    """What is offered at the `|` of a function's body: label and detail."""
    text = HEAD + "def generate_launch_description():\n" + body
    at = text.index("|")
    text = text[:at] + text[at + 1 :]
    if path in editor.texts:
        editor.change(path, text)
    else:
        editor.open(path, text, language="python")
    await editor.hover(path, types.Position(0, 0))  # what is typed was analysed when it is answered
    found = await editor.completion(path, position(text, at, editor.encoding), trigger)
    return [f"{item.label} {item.detail or ''}".strip() for item in found]


WHOLE = [
    ("    return Node(|)\n", "executable required"),
    ("    return Node(executable='a', |)\n", "package = None"),
    ("    return Node(package='|')\n", "robot"),
    ("    return get_package_share_directory('|')\n", "robot"),
    ("    return FindPackageShare('ro|')\n", "robot"),
    ("    return Node(package='robot', executable='|')\n", "talker robot"),
    ("    return Node(executable='|', package='robot')\n", "talker robot"),
    ("    name = 'robot'\n    return Node(package=name, executable='|')\n", "talker robot"),
    (
        "    a = DeclareLaunchArgument('wanted', default_value='5', description='For you')\n"
        "    return Node(namespace=LaunchConfiguration('|'))\n",
        "wanted default: 5",
    ),
    (
        "    return Node(package='robot', executable='talker', parameters=[{'rate': 1, '|': 1}])\n",
        "frame string, default map",
    ),
    (
        "    return Node(package='robot', executable='talker', parameters=[{'limits': {'|': 1}}])\n",
        "low integer, default 1",
    ),
    (
        "    return Node(package='robot', executable='talker', remappings=[('|', 'words')])\n",
        "chatter std_msgs/msg/String, publishes",
    ),
    (
        "    return IncludeLaunchDescription(PythonLaunchDescriptionSource(os.path.join(\n"
        "        get_package_share_directory('robot'), 'launch', 'inner.launch.py')),\n"
        "        launch_arguments={'model': 'a', '|': 'b'}.items())\n",
        "speed default: 1.0",
    ),
    (
        "    return IncludeLaunchDescription(PythonLaunchDescriptionSource(\n"
        "        [FindPackageShare('robot'), '/launch/|']))\n",
        "inner.launch.py",
    ),
    ("    return os.path.join(get_package_share_directory('robot'), '|')\n", "launch/"),
    ("    return PathJoinSubstitution([FindPackageShare('robot'), 'launch', '|'])\n", "outer.launch.xml"),
    ("    return Node(executable='a', output='|')\n", "screen"),
    ("    return LogInfo(level='|', msg='')\n", "WARNING"),
    ("    return SetEnvironmentVariable('HOM|', 'a')\n", "HOME"),
]
HALF = [
    ("    return LaunchDescription([\n        Node(package='robot', exe|\n", "executable required"),
    ("    return LaunchDescription([\n        Node(package='|\n", "robot"),
    ("    return LaunchDescription([\n        Node(package='|'\n", "robot"),
    (
        "    return LaunchDescription([\n        Node(package='robot', executable='|\n"
        "        Node(package='x', executable='y'),\n    ])\n",
        "talker robot",
    ),
    ("    return LaunchDescription([Node(package='robot', executable=\"ta|, name='x')])\n", "talker robot"),
    (
        "    return LaunchDescription([\n        Node(package='robot', executable='talker',\n"
        "             parameters=[{'|\n        Node(package='x', executable='y'),\n    ])\n",
        "frame string, default map",
    ),
    (
        "    return LaunchDescription([\n        Node(package='robot', executable='talker',\n"
        "             parameters=[{'rate': 1.0, '|'}])])\n",
        "frame string, default map",
    ),
    (
        "    return LaunchDescription([Node(package='robot', executable='talker', remappings=[('|')])])\n",
        "chatter std_msgs/msg/String, publishes",
    ),
    (
        "    return LaunchDescription([\n        DeclareLaunchArgument('wanted'),\n"
        "        Node(package='robot', executable=LaunchConfiguration('|\n    ])\n",
        "wanted required",
    ),
    (
        "    return LaunchDescription([IncludeLaunchDescription(PythonLaunchDescriptionSource(\n"
        "        PathJoinSubstitution([FindPackageShare('robot'), 'launch', 'inner.launch.py'])),\n"
        "        launch_arguments={'|\n    ])\n",
        "speed default: 1.0",
    ),
    ("    return os.path.join(get_package_share_directory('robot'), 'la|\n", "launch/"),
]
NOT_OURS = [
    "    print('|')\n",
    "    return int(|)\n",
    "    return Node(package='robot', name='|')\n",
    "    # Node(package='|')\n",
    '    """Node(package=\'|\')"""\n',
    "    return Node(package=f'|')\n",
    "    x = {'a': '|'}\n",
    "    'package'|\n",
]


async def test_completion(harness: Harness, package: Path) -> None:
    path = package / "launch/typed.launch.py"
    async with editing(harness, folder=package.parents[1]) as editor:
        editor.open(path, MAIN, language="python")
        for body, wanted in (*WHOLE, *HALF):
            found = await completed(editor, path, body)
            assert any(each.startswith(wanted) for each in found), (body, found)
        for body in NOT_OURS:
            assert await completed(editor, path, body) == [], body
        assert await completed(editor, path, "    return Node(package='robot', executable='ta(|')\n", "(") == []
        assert "launch/" in await completed(
            editor, path, "    return get_package_share_directory('robot') + '/|'\n", "/"
        )
        # What is passed or set already is not offered once more.
        found = await completed(
            editor, path, "    return Node(package='robot', executable='talker', parameters=[{'rate': 1, '|': 1}])\n"
        )
        assert not [each for each in found if each.startswith("rate")]
        editor.change(path, HEAD + "x = Node(package='robot', executable='')\n")
        (item,) = [
            i for i in await editor.completion(path, editor.at(path, "executable='')", 12)) if i.label == "talker"
        ]
        assert editor.accept(path, item) == "x = Node(package='robot', executable='talker')"


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "utf-32"])
async def test_completion_behind_other_letters(harness: Harness, package: Path, encoding: str) -> None:
    path = package / "launch/typed.launch.py"
    async with editing(harness, folder=package.parents[1], client=capabilities(encoding=encoding)) as editor:
        body = "    # Größe 🤖 — so\n    return ['🤖', Node(package='robot', executable='t|')]\n"
        assert "talker robot" in await completed(editor, path, body)
        text = editor.texts[path]
        (item,) = [
            i for i in await editor.completion(path, editor.at(path, "executable='t'", 13)) if i.label == "talker"
        ]
        assert editor.accept(path, item) == text.splitlines()[-1].replace("'t'", "'talker'")


async def test_everything_that_can_be_asked_while_a_file_is_typed(harness: Harness, package: Path) -> None:
    """At each place of a text that ends anywhere: an answer or none, and no error."""
    path = package / "launch/typed.launch.py"
    async with editing(harness, folder=package.parents[1]) as editor:
        editor.open(path, MAIN, language="python")
        for end in range(len(HEAD), len(MAIN) + 1, 29):
            editor.change(path, MAIN[:end])
            await editor.everything(path, position(MAIN[:end], end, editor.encoding))
        editor.change(path, MAIN)
        for at in range(len(HEAD), len(MAIN), 23):
            await editor.everything(path, position(MAIN, at, editor.encoding))


def line(text: str, needle: str) -> int:
    """The line of the first place of a text, counted from 1."""
    return text[: text.index(needle)].count("\n") + 1


async def indexed(editor: Editor, path: Path) -> None:
    """Wait until both includers of the file are known."""
    await editor.once(
        lambda: editor.lenses(path),
        lambda found: "included by 2 files" in [lens.command.title for lens in found if lens.command],
    )


async def test_arguments_across_formats(harness: Harness, package: Path) -> None:
    """From the declaration to each use, and to what the includers of two formats pass."""
    main, inner, outer = (
        package / "launch" / f"{n}" for n in ("main.launch.py", "inner.launch.py", "outer.launch.xml")
    )
    async with editing(harness, folder=package.parents[1]) as editor:
        editor.open(inner, language="python")
        declared = editor.at(inner, "'speed', default", 2)
        await indexed(editor, inner)
        found = await editor.references(inner, declared)
        assert sorted((Path(r.uri).name, r.range.start.line + 1) for r in found) == [
            ("inner.launch.py", line(INNER, "DeclareLaunchArgument('speed'")),
            ("inner.launch.py", line(INNER, "LaunchConfiguration('speed'")),
            ("main.launch.py", line(MAIN, "{'speed':")),
            ("outer.launch.xml", line(OUTER, '"speed"')),
        ]
        placeholder = await editor.prepare_rename(inner, editor.at(inner, "variable_name='model'", 16))
        assert placeholder is not None
        assert editor.covered(inner, placeholder.range) == "model"
        editor.apply(await editor.rename(inner, declared, "velocity"))
        assert editor.texts[inner] == INNER.replace("'speed'", "'velocity'")
        assert editor.texts[main] == MAIN.replace("{'speed':", "{'velocity':")
        assert editor.texts[outer] == OUTER.replace('"speed"', '"velocity"')


async def test_an_argument_renamed_where_xml_passes_it(harness: Harness, package: Path) -> None:
    main, inner, outer = (
        package / "launch" / f"{n}" for n in ("main.launch.py", "inner.launch.py", "outer.launch.xml")
    )
    async with editing(harness, folder=package.parents[1]) as editor:
        editor.open(inner, language="python")
        await indexed(editor, inner)
        editor.open(outer)
        editor.apply(await editor.rename(outer, editor.at(outer, "model", 1), "kind"))
        assert "DeclareLaunchArgument('kind')" in editor.texts[inner]
        assert "LaunchConfiguration(variable_name='kind')" in editor.texts[inner]
        assert "'kind': 'true'" in editor.texts[main]


async def test_what_else_is_shown(harness: Harness, package: Path) -> None:
    main = package / "launch/main.launch.py"
    async with editing(harness, folder=package.parents[1]) as editor:
        editor.open(main, language="python")
        links = [(editor.covered(main, each.range), Path(each.target or "").name) for each in await editor.links(main)]
        assert links == [(name, name) for name in ("inner.launch.py", "params.yaml")]
        symbols = await editor.symbols(main)
        assert [(s.name, s.detail) for s in symbols if s.name == "talker"] == [("talker", "robot/talker")]
        assert len(symbols) == 2, "the include, and the node"
        assert await editor.symbols(main) == symbols
        lenses = await editor.lenses(main)
        assert {editor.covered(main, lens.range) for lens in lenses} == {"generate_launch_description"}
        assert await editor.folds(main) == []
        assert await editor.tokens(main) == []
        found = await editor.signature(main, editor.at(main, "'speed'", 2))
        assert found is not None
        (signature,) = found.signatures
        assert signature.label.startswith("DeclareLaunchArgument(name, *, default_value=None, description=None")
        assert found.active_parameter == 0
        assert await editor.signature(main, editor.at(main, "share = ")) is None
        half = MAIN.replace("name='talker',", "name='tal")
        editor.change(main, half)
        assert [s.detail for s in await editor.symbols(main) if s.detail] == ["robot/talker"]


async def _hovered(editor: Editor, path: Path, needle: str) -> str:
    found = await editor.hover(path, editor.at(path, needle, len(needle) - 2))
    assert found is None or isinstance(found.contents, types.MarkupContent)
    return found.contents.value if found is not None else ""


async def test_a_node_that_its_condition_leaves_out(harness: Harness, package: Path) -> None:
    """It is read as if it were started, without a run as well."""
    path = package / "launch/inner.launch.py"
    for includer in ("main.launch.py", "outer.launch.xml"):
        path.with_name(includer).unlink()
    text = INNER.replace("'model')", "'model', default_value='false')", 1).replace("'frame'", "''")
    async with editing(harness, folder=package.parents[1]) as editor:
        editor.open(path, text, language="python")
        for _ in range(2):
            await editor.once(
                lambda: _hovered(editor, path, "executable='listener'"),
                lambda said: said.startswith("**/listener** `robot/listener`") and said.endswith("is false"),
            )
            (target,) = await editor.definition(path, editor.at(path, "executable='listener'", 14))
            assert Path(target.target_uri).name == "listener.py"
            offered = await editor.completion(path, editor.at(path, "{'':", 2))
            assert "frame" in [item.label for item in offered]
            editor.trust()


async def test_values_of_a_file_that_was_run(harness: Harness, package: Path) -> None:
    inner = package / "launch/inner.launch.py"
    async with editing(harness, trusted=True, folder=package.parents[1]) as editor:
        text = INNER.replace("name='listener'", "name=LaunchConfiguration('model')")
        editor.open(inner, text, language="python")
        found = await editor.once(lambda: editor.hints(inner), lambda found: "= true" in [hint.label for hint in found])
        lines = [hint.position.line + 1 for hint in found if hint.label == "= true"]
        assert lines == [line(text, "name=LaunchConfiguration"), line(text, "condition=")]


async def test_a_container_of_a_python_file_is_renamed_where_it_is_named(harness: Harness, package: Path) -> None:
    path = package / "launch/load.launch.py"
    text = (
        HEAD.replace("import ComposableNodeContainer, Node", "import ComposableNodeContainer, LoadComposableNodes")
        + """def generate_launch_description():
    two = ComposableNode(package='robot', plugin='robot::Two', name='two')
    return LaunchDescription([
        ComposableNodeContainer(
            package='rclcpp_components', executable='component_container', name='box', namespace='',
            composable_node_descriptions=[ComposableNode(package='robot', plugin='robot::One', name='one')],
        ),
        LoadComposableNodes(target_container='box', composable_node_descriptions=[two]),
    ])
"""
    )
    async with editing(harness, folder=package.parents[1]) as editor:
        editor.open(path, text, language="python")
        editor.apply(await editor.rename(path, editor.at(path, "name='box'", 7), "crate"))
        assert editor.texts[path] == text.replace("'box'", "'crate'")
