"""Parameters among the arguments of ROS of a node (ROS 2)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from support.check import analyse, read_fixture
from support.python_launch_harness import PythonHarness

NODE = '<launch><node pkg="p" exec="e" name="n" {}><param name="b" value="2"/></node></launch>'


def params(attribute: str) -> dict[str, Any]:
    tree = analyse(read_fixture(f"//- /main.launch.xml\n{NODE.format(attribute)}\n")).tree
    return {param.name: param.value for param in tree.nodes[0].params}


@pytest.mark.parametrize(
    ("attribute", "expected"),
    [
        ('ros_args="-p drone:=1 --param rate:=2.5"', {"drone": 1, "rate": 2.5, "b": 2}),
        ('args="go --ros-args -p drone:=1 -- -p other:=2"', {"drone": 1, "b": 2}),
        ('args="-p drone:=1"', {"b": 2}),
        ('ros_args="-p e:drone:=1 -p nothing -r x:=y"', {"b": 2}),
        ('ros_args="-p b:=1"', {"b": 2}),
        ('ros_args="-p names:=[a,c]"', {"names": ["a", "c"], "b": 2}),
    ],
)
def test_of_a_tag(attribute: str, expected: dict[str, Any]) -> None:
    assert params(attribute) == expected


@pytest.mark.ros
def test_of_a_python_launch_file(tmp_path: Path) -> None:
    harness = PythonHarness(tmp_path)
    launch = harness.write(
        "launch/a.launch.py",
        """
        from launch import LaunchDescription
        from launch_ros.actions import Node


        def generate_launch_description():
            return LaunchDescription([
                Node(package="p", executable="e", name=f"n{drone}", ros_arguments=["-p", f"drone:={drone}"])
                for drone in (1, 2)
            ])
        """,
    )
    nodes = harness.launch(launch).tree.nodes
    assert [[(param.name, param.value) for param in node.params] for node in nodes] == [[("drone", 1)], [("drone", 2)]]
