"""xacro by the folder of its package, which is not installed."""

import json

import pytest
from preflight_analysis.environment.own_programs import (
    OLD_XACRO,
    own_arguments,
    own_prefix,
    own_program,
    without_own_prefix,
)
from support.check import analyse, read_fixture


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("$(find xacro)/xacro a.xacro", "xacro a.xacro"),
        ("$(find xacro)/xacro.py 'a.xacro' b:=c", f"{OLD_XACRO} 'a.xacro' b:=c"),
        ("\n  $(find xacro)/xacro\n a.xacro", "xacro\n a.xacro"),
        ("$(find arm)/scripts/env_run e.sh $(find xacro)/xacro a.xacro", None),
        ("$(find xacro)/xacro2 a.xacro", None),
        ("$(find xacro)", None),
    ],
)
def test_a_command_line(text: str, found: str | None) -> None:
    assert own_program(text, "$(find xacro)", "xacro") == found


def test_another_package() -> None:
    assert own_program("$(find arm)/arm a", "$(find arm)", "arm") is None


@pytest.mark.parametrize(
    ("line", "found"),
    [
        ("{}/bin/xacro a.xacro", "xacro a.xacro"),
        (" {}/lib/xacro/xacro 'a.xacro' b:=c", "xacro 'a.xacro' b:=c"),
        ("{}/lib/xacro/xacro.py a.xacro", None),
        ("{}/bin/xacro_wrapper a.xacro", None),
        ("cat {}/share/xacro/a.xml", None),
        ("xacro a.xacro", "xacro a.xacro"),
    ],
)
def test_below_the_prefix_of_its_package(line: str, found: str | None) -> None:
    assert without_own_prefix(line.format(own_prefix("xacro"))) == found


@pytest.mark.parametrize(
    "program",
    [
        "$(find-pkg-prefix xacro)/bin/xacro",
        "$(exec-in-pkg xacro xacro)",
        "$(path-join $(find-pkg-prefix xacro) bin xacro)",
        "$(find-exec xacro)",
    ],
)
def test_a_launch_file_of_ros_2_that_calls_it(program: str) -> None:
    commands = json.dumps({"xacro arm.xacro": {"output": "<robot/>"}})
    node = f"""<node pkg="p" exec="n"><param name="d" value="$(command '{program} arm.xacro')"/></node>"""
    text = f"//- /main.launch.xml\n<launch>{node}</launch>\n//- commands\n{commands}"
    assert [param.value for param in analyse(read_fixture(text)).tree.nodes[0].params] == ["<robot/>"]


@pytest.mark.parametrize(
    ("line", "found"),
    [
        ("xacro a", ["a"]),
        ("ros2 run xacro xacro a b:=c", ["a", "b:=c"]),
        ("/opt/ros/jazzy/bin/xacro a", ["a"]),
        ("/opt/ros/jazzy/lib/xacro/xacro a", ["a"]),
        ("/opt/ros/jazzy/lib/other/xacro a", None),
        ("/home/me/xacro a", None),
        ("ros2 run p xacro a", None),
        (f"{OLD_XACRO} a", ["a"]),
        ("xacro.py a", None),
        ("cat a", None),
    ],
)
def test_command_lines_that_call_it(line: str, found: list[str] | None) -> None:
    assert own_arguments(line.split()) == found
