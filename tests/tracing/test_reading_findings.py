"""A Python launch file that is read tells of a mistake what the same launch in XML does, without a run."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.tracing.interface import NOT_RUN
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

PACKAGE = """<package format="3"><name>bot</name><version>0.1.0</version><description>d</description>
<maintainer email="a@example.org">a</maintainer><license>MIT</license>
<export><build_type>ament_python</build_type></export></package>"""
SETUP = """from setuptools import setup
setup(name="bot", packages=["bot"], entry_points={"console_scripts": ["talker = bot.talker:main"]},
      data_files=[("share/bot/config", ["config/params.yaml"]), ("share/bot", ["package.xml"]),
                  ("share/bot/launch", ["launch/a.launch.xml", "launch/a.launch.py"])])
"""
TALKER = """import rclpy
from rclpy.node import Node
from std_msgs.msg import String

class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        self.declare_parameter("rate", 5.0)
        self.pub = self.create_publisher(String, "chatter", 10)

def main():
    rclpy.init()
    rclpy.spin(Talker())
"""
HEAD = """import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import *
from launch.conditions import IfCondition
from launch.launch_description_sources import *
from launch.substitutions import *
from launch_ros.actions import Node

SHARE = get_package_share_directory("bot")


def node(name, **more):
    return Node(package="bot", executable="talker", name=name, **more)


def generate_launch_description():
    sim = DeclareLaunchArgument("sim", default_value="false")
    return LaunchDescription([sim, LogInfo(msg=LaunchConfiguration("sim")), ITEM])
"""
ARGUMENT = '<arg name="sim" default="false"/><log message="$(var sim)"/>'
SAME = [
    ('<node pkg="bto" exec="talker" name="a"/>', 'Node(package="bto", executable="talker", name="a")', "PKG001"),
    ('<node pkg="bot" exec="talkr" name="a"/>', 'Node(package="bot", executable="talkr", name="a")', "PKG002"),
    (
        '<node pkg="bot" exec="talker" name="a"><param from="$(find-pkg-share bot)/config/parms.yaml"/></node>',
        'node("a", parameters=[os.path.join(SHARE, "config", "parms.yaml")])',
        "PRM002",
    ),
    (
        '<node pkg="bot" exec="talker" name="a" if="$(var smi)"/>',
        'node("a", condition=IfCondition(LaunchConfiguration("smi")))',
        "ARG001",
    ),
    (
        '<include file="$(find-pkg-share bot)/launch/none.launch.xml"/>',
        'IncludeLaunchDescription(AnyLaunchDescriptionSource(f"{SHARE}/launch/none.launch.xml"))',
        "LCH013",
    ),
    (
        '<node pkg="bot" exec="talker" name="a"><param name="rat" value="5.0"/></node>',
        'node("a", parameters=[{"rat": 5.0}])',
        "PRM013",
    ),
    (
        '<node pkg="bot" exec="talker" name="a"><remap from="chater" to="x"/></node>',
        'node("a", remappings=[("chater", "x")])',
        "TOP004",
    ),
    (
        '<node pkg="bot" exec="talker" name="a"/><node pkg="bot" exec="talker" name="a"/>',
        'Node(package="bot", executable="talker", name="a"), Node(package="bot", executable="talker", name="a")',
        "LCH016",
    ),
]


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    files = {"package.xml": PACKAGE, "setup.py": SETUP, "setup.cfg": "", "bot/__init__.py": "", "bot/talker.py": TALKER}
    for name, text in {**files, "config/params.yaml": "talker: {ros__parameters: {rate: 5.0}}\n"}.items():
        path = tmp_path / "src" / "bot" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    (tmp_path / "src" / "bot" / "launch").mkdir()
    return tmp_path


def _found(folder: Path, name: str, text: str) -> list[tuple[str, str]]:
    path = folder / "src" / "bot" / "launch" / name
    path.write_text(text)
    environment = detect_environment(str(folder), {}, (str(folder),), (), root=str(folder / "none"))
    workspace = Workspace(environment, Sources(), str(folder))
    analysis = workspace.static(str(path))
    analysis = workspace.with_interfaces(analysis, [NOT_RUN] * len(analysis.tree.nodes), None)
    return sorted({(each.rule, each.message) for each in analysis.findings if each.location.file == str(path)})


@pytest.mark.parametrize(("xml", "python", "rule"), SAME, ids=[rule for *_, rule in SAME])
def test_a_mistake_is_told_as_in_xml(workspace: Path, xml: str, python: str, rule: str) -> None:
    in_xml = _found(workspace, "a.launch.xml", f"<launch>\n{ARGUMENT}\n{xml}\n</launch>\n")
    in_python = _found(workspace, "a.launch.py", HEAD.replace("ITEM", python))
    assert in_python == in_xml
    assert rule in [each for each, _ in in_python]


@pytest.mark.parametrize(("loader", "fails"), [("SafeLoader", True), ("UnsafeLoader", False), ("FullLoader", False)])
def test_what_only_a_loader_of_objects_reads_is_no_mistake(workspace: Path, loader: str, fails: bool) -> None:
    load = f'yaml.load("!!python/tuple [1, 2]", Loader=yaml.{loader}) and Node(package="bot", executable="talker")'
    found = _found(workspace, "a.launch.py", "import yaml\n" + HEAD.replace("ITEM", load))
    assert ("LCH032" in [rule for rule, _ in found]) == fails


def test_an_exception_is_at_the_line_of_the_name(workspace: Path) -> None:
    path = workspace / "src" / "bot" / "launch" / "a.launch.py"
    text = (
        "from launch import LaunchDescription\n\n\ndef generate_launch_description():\n    return LaunchDescription([\n"
    )
    path.write_text(f"{text}        talkr,\n    ])\n")
    environment = detect_environment(str(workspace), {}, (str(workspace),), (), root=str(workspace / "none"))
    analysis = Workspace(environment, Sources(), str(workspace)).static(str(path))
    (found,) = [each for each in analysis.findings if each.rule == "LCH032"]
    document = analysis.documents[str(path)]
    assert document.lines.position(found.location.span.start)[0] + 1 == 6
