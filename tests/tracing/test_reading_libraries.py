"""Python launch files are read where ROS is installed, whose modules do more than the reading follows."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.tracing.reading.answers import answer
from preflight_analysis.workspace.sources import Sources

NOT_FOLLOWED = """
class Lexer:
    def __init__(self):
        self.__setattr__("text", "")


LEXER = Lexer()


def process_file(path):
    return LEXER
"""
HEAD = "from launch import LaunchDescription, Substitution\nfrom launch_ros.actions import Node\n"


def _read(tmp_path: Path, text: str, **modules: str) -> dict[str, Any]:
    prefix, workspace = tmp_path / "prefix", tmp_path / "workspace"
    for folder in ("share/tools", "share/ament_index/resource_index/packages", "lib/python3.11/site-packages"):
        (prefix / folder).mkdir(parents=True)
    (prefix / "share/tools/package.xml").write_text("<package format='3'><name>tools</name></package>")
    (prefix / "share/ament_index/resource_index/packages/tools").touch()
    for name, body in modules.items():
        module = prefix / "lib/python3.11/site-packages" / name / "__init__.py"
        module.parent.mkdir()
        module.write_text(body)
    file = workspace / "launch" / "a.launch.py"
    file.parent.mkdir(parents=True)
    file.write_text(HEAD + text)
    variables = {
        "PATH": "/usr/bin:/bin",
        "AMENT_PREFIX_PATH": str(prefix),
        "HOME": os.path.realpath(os.environ["HOME"]),
    }
    environment = detect_environment(str(workspace), variables)
    assert "tools" in environment.packages
    request = {"file": str(file), "text": file.read_text(), "calls": [], "env": {}}
    found = answer(environment, Sources(), request)
    assert found is not None
    return found


@pytest.mark.parametrize("name", ["xacro", "tools"])
def test_a_module_that_is_not_followed_leaves_the_rest_known(tmp_path: Path, name: str) -> None:
    text = f"""import {name}


def generate_launch_description():
    made = {name}.process_file("robot.xacro")
    return LaunchDescription([Node(package="tools", executable="talker", parameters=[{{"d": made, "rate": 5}}])])
"""
    found = _read(tmp_path, text, **{name: NOT_FOLLOWED})
    assert "error" not in found
    assert "talker" in repr(found["actions"])
    assert found["unread"]


def test_a_class_of_the_program_calls_what_its_base_does_not_define(tmp_path: Path) -> None:
    text = """

class Upper(Substitution):
    def __init__(self, text):
        super().__init__()
        self.text = text

    def perform(self, context):
        return self.text.upper()


def generate_launch_description():
    return LaunchDescription([Node(package="tools", executable=Upper("a"))])
"""
    assert not _read(tmp_path, text)["unread"]


@pytest.mark.parametrize(
    "written", ["os.path.expanduser('~/maps')", "os.environ['HOME'] + '/maps'", "f'{Path.home()}/maps'",
                "str(Path('~/maps').expanduser())", "os.getenv('HOME', '') + '/maps'"]
)  # fmt: skip
def test_the_home_folder_is_that_of_a_run(tmp_path: Path, written: str) -> None:
    text = f"""import os
from pathlib import Path


def generate_launch_description():
    return LaunchDescription([Node(package="tools", executable="talker", arguments=[{written}])])
"""
    found = _read(tmp_path, text)
    assert not found["unread"]
    assert os.path.realpath(os.environ["HOME"]) + "/maps" in repr(found["actions"])


def test_private_names_of_a_class_are_found(tmp_path: Path) -> None:
    text = """

class Fleet:
    __prefix = "robot"

    def __init__(self, number):
        self.__number = number

    def __name(self):
        return f"{self.__prefix}_{self.__number}"

    def node(self):
        return Node(package="tools", executable="talker", name=self.__name())


def generate_launch_description():
    return LaunchDescription([Fleet(3).node()])
"""
    found = _read(tmp_path, text)
    assert "error" not in found
    assert "robot_3" in repr(found["actions"])
