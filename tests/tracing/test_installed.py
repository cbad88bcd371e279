"""The installed wheel, from where users install it: folders that the sandbox hides but for what it needs of them."""

from __future__ import annotations

import json
import os
import pwd
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.tracing import sandbox
from support.installed_wheel import copy_interpreter, install
from support.ordinary_user import become, ordinary_user
from support.tracing_harness import known_backends

pytestmark = pytest.mark.ros

DEMO = Path(__file__).parents[2] / "fixtures/ros1/demo"
FILES = {
    "arm/package.xml": '<package format="2"><name>arm</name><version>1.0.0</version></package>',
    "arm/sizes.yaml": "thumb: 3",
    "arm/arm.xacro": """
        <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
          <xacro:property name="sizes" value="${xacro.load_yaml('sizes.yaml')}"/>
          <link name="thumb_${sizes['thumb']}"/>
        </robot>""",
    "arm/launch/ros1.launch": """
        <launch>
          <param name="robot_description" command="xacro $(find arm)/arm.xacro"/>
          <include file="$(find preflight_demo)/launch/talker_listener.launch"/>
          <node name="compiled" pkg="compiled" type="node"/>
        </launch>""",
    "ros2/package.xml": """
        <package format="3"><name>ros2</name><version>1.0.0</version>
          <export><build_type>ament_python</build_type></export></package>""",
    "ros2/setup.py": """
from setuptools import setup
setup(name="ros2", packages=["ros2"], entry_points={"console_scripts": ["talker = ros2.talker:main"]})
""",
    "ros2/ros2/__init__.py": "",
    "ros2/ros2/talker.py": """
import rclpy
from std_msgs.msg import String

def main():
    rclpy.init()
    node = rclpy.create_node("talker")
    node.create_publisher(String, "chatter", 1)
    rclpy.spin(node)
""",
    "ros2/launch/in.launch.xml": """
        <launch>
          <node pkg="ros2" exec="talker" name="in_xml">
            <param name="robot_description" value="$(command 'xacro FOLDER/arm/arm.xacro')"/>
          </node>
        </launch>""",
    "ros2/launch/ros2.launch.py": """
import ctypes
import os
import xacro
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.substitutions import Command
from launch_ros.actions import Node

FILE = "FOLDER/arm/arm.xacro"

def attempt(action):
    try:
        return str(action())
    except OSError:
        return "refused"

LIBC = ctypes.CDLL(None)  # of Python's functions the run has some of its own
ATTEMPTS = {
    "secret_read": LIBC.open(b"SECRET", os.O_RDONLY),
    "ours_written": LIBC.open(os.fsencode(xacro.__file__), os.O_WRONLY),
    "made_beside_ours": LIBC.mkdir(os.fsencode(xacro.__file__) + b"-made", 0o700),
}
BESIDE = attempt(lambda: os.listdir(os.path.dirname("SECRET")))

def described(name, value):
    given = {"robot_description": value, "beside": BESIDE, **ATTEMPTS}
    return Node(package="ros2", executable="talker", name=name, parameters=[given])

def generate_launch_description():
    return LaunchDescription([
        described("imported", xacro.process_file(FILE).toxml()),
        described("commanded", Command(["xacro ", FILE])),
        IncludeLaunchDescription("FOLDER/ros2/launch/in.launch.xml"),
    ])
""",
}


@dataclass(frozen=True)
class Installed:
    """A user with a home folder, the command as that user starts it, and a workspace."""

    home: Path
    command: tuple[str, ...]
    workspace: Path

    def run(self, backend: str, *arguments: str) -> Any:
        """What the command prints as JSON."""
        variables = {"PATH": "/usr/bin:/bin", "HOME": str(self.home), "LANG": "C.UTF-8", sandbox.CHOICE: backend}
        variables |= {"XDG_CACHE_HOME": str(self.workspace.parent / f"cache-{backend}")}
        done = subprocess.run(
            [*self.command, *arguments, "--format", "json"],
            cwd=self.workspace,
            env=variables,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)


def write_workspace(place: Path, secret: Path, compiled: Path) -> Path:
    """Both generations' packages, and a secret elsewhere."""
    secret.write_text("hunter2")
    folder = place / "workspace/src"
    for name, text in FILES.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text.strip().replace("FOLDER", str(folder)).replace("SECRET", str(secret)))
    shutil.copytree(DEMO, folder / "demo")
    shutil.copytree(compiled, folder / "compiled")
    return folder.parent


@contextmanager
def in_home_folder(compiled: Path) -> Iterator[Installed]:
    """As README installs it."""
    with ExitStack() as at_end:
        hidden, robot = (
            Path(at_end.enter_context(tempfile.TemporaryDirectory(prefix=prefix, dir=Path.home())))
            for prefix in (".ros-preflight-", "robot-")
        )
        python = install(hidden / "installed")
        workspace = write_workspace(robot, hidden / "secret", compiled)
        yield Installed(Path.home(), (str(python.with_name("ros-preflight")),), workspace)


@contextmanager
def below_tmp(compiled: Path) -> Iterator[Installed]:
    """As in a clone there, with a home folder there."""
    with tempfile.TemporaryDirectory(dir="/tmp") as folder:
        home = Path(folder, "home")
        home.mkdir()
        python = install(Path(folder, "clone/.venv"))
        workspace = write_workspace(home, Path(folder, "clone/secret"), compiled)
        yield Installed(home, (str(python), "-m", "preflight_server"), workspace)


@contextmanager
def of_the_extension(compiled: Path) -> Iterator[Installed]:
    """As VS Code's extension installs it for a user, whose interpreter is in the home folder too."""
    with ExitStack() as at_end:
        if os.geteuid() == 0:
            user = at_end.enter_context(ordinary_user())
            home = Path(pwd.getpwnam(user).pw_dir)
        else:
            user = ""
            home = Path(at_end.enter_context(tempfile.TemporaryDirectory(dir=Path.home())))
        interpreter = copy_interpreter(home / ".local/share/uv/python/cpython")
        storage = home / ".config/Code/User/globalStorage/ros-preflight.ros-preflight"
        command = (str(install(storage / "server-1", interpreter)), "-I", "-m", "preflight_server")
        workspace = write_workspace(home / "robot", storage / "secret", compiled)
        if user:
            subprocess.run(["chown", "-R", f"{user}:", str(home)], check=True)
            command = (*become(user), *command)
        yield Installed(home, command, workspace)


@pytest.mark.parametrize("place", [in_home_folder, below_tmp, of_the_extension])
def test_what_it_brings_along_is_seen_in_the_sandbox_and_nothing_beside_it(place: Any, package: Path) -> None:
    with place(package) as installed:
        for backend in known_backends():
            tree = installed.run(backend, "tree", "src/arm/launch/ros1.launch")
            assert '<link name="thumb_3"/>' in tree["params"]["/robot_description"], backend
            graph = installed.run(backend, "graph", "src/arm/launch/ros1.launch")
            ended = {node["name"]: node["outcome"] for node in graph["nodes"]}
            assert ended == dict.fromkeys(("/talker", "/listener", "/compiled"), "spinning"), backend

            tree = installed.run(backend, "tree", "src/ros2/launch/ros2.launch.py")
            given = {node["name"]: node["params"] for node in tree["nodes"]}
            assert given.keys() == {"/imported", "/commanded", "/in_xml"}, backend
            for params in given.values():
                assert '<link name="thumb_3"/>' in params["robot_description"], backend
            attempts = given["/imported"]
            assert {attempts[name] for name in ("secret_read", "ours_written", "made_beside_ours")} == {-1}, backend
            assert "secret" not in attempts["beside"], backend
            graph = installed.run(backend, "graph", "src/ros2/launch/ros2.launch.py")
            ended = {node["name"]: node["outcome"] for node in graph["nodes"]}
            assert ended == dict.fromkeys(given, "spinning"), backend
