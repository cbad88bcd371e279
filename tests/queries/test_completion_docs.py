"""What is said of a proposal: packages, executables, components and types."""

from __future__ import annotations

from pathlib import Path

from preflight_analysis.queries.completion_docs import documentation
from support.workspace_harness import create_workspace

WORKSPACE = """
    //- main.launch.xml
    <launch>$0</launch>
    //- p/package.xml
    <package format="3">
      <name>p</name><version>1.2.0</version><description>Looks   around.</description>
      <export><build_type>ament_python</build_type></export>
    </package>
    //- p/setup.py
    from setuptools import setup
    setup(name="p", packages=["p"], entry_points={"console_scripts": ["look = p.look:main"]})
    //- p/p/__init__.py
    //- p/p/look.py
    '''Looks at a camera.

    More of it.
    '''
    import rclpy
    from rclpy.node import Node
    from std_msgs.msg import String


    def main():
        rclpy.init()
        node = Node("look")
        node.declare_parameter("rate", 5)
        node.create_publisher(String, "seen", 1)
        rclpy.spin(node)
    //- p/msg/Seen.msg
    uint8 number  # of things
    """


def said(tmp_path: Path, *about: str) -> list[str]:
    context = create_workspace(tmp_path, WORKSPACE, build_type="ament_python").context
    return [line for line in documentation(context.workspace, context.path, about).split("\n") if line]


def test_a_package_with_its_description(tmp_path: Path) -> None:
    first, path, description = said(tmp_path, "package", "p")
    assert first.startswith("package `p` `1.2.0` — [package.xml](")
    assert path == f"`{tmp_path}/p`"
    assert description == "Looks around."


def test_an_executable_with_what_its_source_does(tmp_path: Path) -> None:
    first, *rest = said(tmp_path, "executable", "p", "look")
    assert first.startswith("`p/look` — [look.py](")
    assert rest == [
        "Looks at a camera.",
        "- publishes `seen` `std_msgs/msg/String`",
        "- parameter `rate`: integer, default `5`",
    ]


def test_one_that_the_catalogue_knows(tmp_path: Path) -> None:
    first, *rest, last = said(tmp_path, "executable", "tf2_ros", "static_transform_publisher")
    assert first == "`tf2_ros/static_transform_publisher`"
    assert "- parameter `child_frame_id`: string, default `/child`, read-only" in rest
    assert last.startswith("From the catalogue of ")


def test_types_of_the_workspace_and_of_common_packages(tmp_path: Path) -> None:
    assert said(tmp_path, "msg", "p", "Seen") == ["```text", "uint8 number  # of things", "```"]
    assert said(tmp_path, "srv", "std_srvs", "Trigger") == ["```text", "---", "bool success", "string message", "```"]


def test_what_nobody_knows(tmp_path: Path) -> None:
    for about in (("package", "none"), ("msg", "none", "None"), ("nonsense",), ()):
        assert said(tmp_path, *about) == []
    assert said(tmp_path, "executable", "none", "none") == ["`none/none`"]
