"""Python launch files of a package with one node, read without a run."""

from __future__ import annotations

from pathlib import Path

from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.tracing.interface import NOT_RUN
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace

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
IMPORTS = """import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import *
from launch.conditions import IfCondition
from launch.launch_description_sources import *
from launch.substitutions import *
from launch_ros.actions import Node
"""


class ReadingHarness:
    """A folder with the package."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        files = {"package.xml": PACKAGE, "setup.py": SETUP, "setup.cfg": "", "bot/__init__.py": ""}
        params = {"config/params.yaml": "talker: {ros__parameters: {rate: 5.0}}\n"}
        for name, text in {**files, **params, "bot/talker.py": TALKER}.items():
            self.write(name, text)

    def write(self, name: str, text: str) -> Path:
        """A file of the package."""
        path = self.folder / "src" / "bot" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def read(self, text: str, name: str = "a.launch.py") -> Analysis:
        """The analysis of a launch file, with what is found in its other branches."""
        path = self.write(f"launch/{name}", text)
        environment = detect_environment(str(self.folder), {}, (str(self.folder),), (), root=str(self.folder / "none"))
        workspace = Workspace(environment, Sources(), str(self.folder))
        analysis = workspace.static(str(path))
        analysis = workspace.with_interfaces(analysis, [NOT_RUN] * len(analysis.tree.nodes), None)
        return analysis.with_branches(workspace.branches(analysis))
