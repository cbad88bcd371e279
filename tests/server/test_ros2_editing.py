"""The launch files of ROS 2 and their parameter files through the real server."""

from __future__ import annotations

from pathlib import Path

import pytest
from lsprotocol import types
from support.editor_harness import Harness
from support.lsp_client import Editor, editing, position

pytestmark = pytest.mark.ros

MANIFEST = """<package format="3"><name>robot</name><version>0.0.0</version><description>d</description>
<maintainer email="a@b.c">m</maintainer><license>MIT</license>
<exec_depend>rclpy</exec_depend><export><build_type>ament_python</build_type></export></package>
"""
SETUP = """from setuptools import setup
setup(
    name="robot",
    packages=["robot"],
    data_files=[("share/robot", ["package.xml", "inner.launch.yaml", "main.launch.xml", "params.yaml"])],
    entry_points={"console_scripts": ["talker = robot.talker:main"]},
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
        self.publisher = self.create_publisher(String, "chatter", 10)


def main():
    rclpy.init()
    rclpy.spin(Talker())
"""
MAIN = """<launch>
  <arg name="speed" default="5.0" description="In m/s"/>
  <let name="twice" value="$(var speed)"/>
  <include file="$(find-pkg-share robot)/inner.launch.yaml">
    <arg name="name" value="talker"/>
  </include>
</launch>
"""
INNER = """launch:
  - arg:
      name: name
      description: Of the node
  - node:
      pkg: robot
      exec: talker
      name: $(var name)
      namespace: ns
      param:
        - from: $(find-pkg-share robot)/params.yaml
        - name: frame
          value: $(var name)
      remap:
        - from: chatter
          to: words
"""
PARAMS = """/ns/talker:
  ros__parameters:
    rate: 5.0
    fram: odom
/**:
  ros__parameters:
    use_sim_time: false
"""


@pytest.fixture
def package(harness: Harness) -> Path:
    folder = harness.home / "ros2_ws/src/robot"
    (folder / "robot").mkdir(parents=True)
    for name, text in {
        "package.xml": MANIFEST,
        "setup.py": SETUP,
        "robot/__init__.py": "",
        "robot/talker.py": TALKER,
        "main.launch.xml": MAIN,
        "inner.launch.yaml": INNER,
        "params.yaml": PARAMS,
    }.items():
        (folder / name).write_text(text)
    return folder


def text_of(hover: types.Hover | None) -> str:
    assert hover is not None
    assert isinstance(hover.contents, types.MarkupContent)
    return hover.contents.value


async def targets(editor: Editor, path: Path, needle: str, after: int = 0) -> list[str]:
    """Where go-to-definition leads: `file:line`, counted from 1."""
    found = await editor.definition(path, editor.at(path, needle, after))
    return [f"{Path(t.target_uri).name}:{t.target_selection_range.start.line + 1}" for t in found]


async def test_an_xml_file(harness: Harness, package: Path) -> None:
    main = package / "main.launch.xml"
    async with editing(harness, folder=package.parents[1]) as editor:
        editor.open(main)
        assert "`speed` = `5.0`" in text_of(await editor.hover(main, editor.at(main, "speed")))
        assert "argument `speed` = `5.0`" in text_of(await editor.hover(main, editor.at(main, "(var speed", 5)))
        assert "Sets a launch configuration." in text_of(await editor.hover(main, editor.at(main, "let")))
        assert "The share folder" in text_of(await editor.hover(main, editor.at(main, "find-pkg-share")))
        assert await targets(editor, main, "(var speed", 5) == ["main.launch.xml:2"]
        assert await targets(editor, main, "robot)") == ["package.xml:1"]
        assert await targets(editor, main, "/inner", 2) == ["inner.launch.yaml:1"]
        assert ("speed", "parameter") in await editor.tokens(main)
        assert ("robot", "namespace") in await editor.tokens(main)
        assert [s.name for s in await editor.symbols(main)][:2] == ["speed", "twice"]
        assert "= 5.0" in [h.label for h in await editor.hints(main)]
        assert [Path(link.target or "").name for link in await editor.links(main)] == ["inner.launch.yaml"]
        signature = await editor.signature(main, editor.at(main, '"talker"', 3))
        assert signature is not None
        assert signature.signatures[0].label == "inner.launch.yaml(name)"


async def test_a_yaml_file(harness: Harness, package: Path) -> None:
    inner, main = package / "inner.launch.yaml", package / "main.launch.xml"
    async with editing(harness, folder=package.parents[1]) as editor:
        editor.open(inner, language="yaml")
        await editor.having(package / "params.yaml", "PRM013", 60)  # seen in the root that includes the file
        assert "included by 1 file" in [lens.command.title for lens in await editor.lenses(inner) if lens.command]
        node = text_of(await editor.hover(inner, editor.at(inner, "node:")))
        assert "**/ns/talker** `robot/talker`" in node
        assert "Starts a node." in node
        assert "`pkg`: The package of the node." in text_of(await editor.hover(inner, editor.at(inner, "pkg")))
        assert "argument `name` = `talker`" in text_of(await editor.hover(inner, editor.at(inner, "(var name", 6)))
        assert await targets(editor, inner, "(var name", 6) == ["inner.launch.yaml:3"]
        assert await targets(editor, inner, "exec: talker", 7) == ["talker.py:14"]
        assert await targets(editor, inner, "pkg: robot", 6) == ["package.xml:1"]
        assert await targets(editor, inner, "/params", 3) == ["params.yaml:1"]
        assert [s.name for s in await editor.symbols(inner)] == ["name", "$(var name)"]
        assert (1, 3) in [(f.start_line, f.end_line) for f in await editor.folds(inner)]
        assert ("name", "parameter") in await editor.tokens(inner)
        references = await editor.references(inner, editor.at(inner, "name: name", 6))
        assert sorted(Path(r.uri).name for r in references) == ["inner.launch.yaml"] * 3 + ["main.launch.xml"]
        editor.apply(await editor.rename(inner, editor.at(inner, "name: name", 6), "called"))
        assert "name: $(var called)" in editor.texts[inner]
        assert '<arg name="called"' in editor.texts[main]


async def test_a_parameter_file(harness: Harness, package: Path) -> None:
    params = package / "params.yaml"
    async with editing(harness, folder=package.parents[1]) as editor:
        editor.open(params, language="yaml")  # no launch file is open
        unknown = await editor.having(params, "PRM013", 60)
        assert editor.covered(params, unknown.range) == "fram"
        (fix,) = [a for a in await editor.actions(params, unknown.range) if a.title == "Rename 'fram' to 'frame'"]
        rate = text_of(await editor.hover(params, editor.at(params, "rate")))
        assert "`/ns/talker` declares it: double, default `10.0` — [talker.py:9]" in rate
        assert await targets(editor, params, "rate", 1) == ["talker.py:9"]
        assert await targets(editor, params, "/ns/talker", 3) == ["inner.launch.yaml:5"]
        editor.apply(fix.edit)
        await editor.without(params, "PRM013", 60)
        text = editor.texts[params]
        typed = text.replace("    rate: 5.0\n", "    ra\n")
        editor.change(params, typed)
        found = await editor.completion(params, editor.at(params, "    ra", 6))
        assert [(i.label, i.detail) for i in found] == [("rate", "double, default 10.0")]
        editor.change(params, "/n\n" + text)
        found = await editor.completion(params, types.Position(0, 2))
        assert [i.label for i in found] == []  # all of them are there already
        editor.change(params, "/n\n")
        assert [i.label for i in await editor.completion(params, types.Position(0, 2))] == ["/ns/talker", "/**"]
        other = package / "other.yaml"
        editor.open(other, "a: 1\n", language="yaml")
        assert await editor.hover(other, types.Position(0, 0)) is None
        assert await editor.completion(other, types.Position(0, 0)) == []


async def test_everything_that_can_be_asked_while_a_file_is_typed(harness: Harness, package: Path) -> None:
    """At each place of texts that end anywhere: an answer or none, and no error."""
    async with editing(harness, folder=package.parents[1]) as editor:
        for name, text in (
            ("typed.launch.yaml", INNER),
            ("typed.launch.xml", MAIN),
            ("other_launch.yaml", PARAMS),
            ("params.yaml", PARAMS),
        ):
            path = package / name
            for end in range(0, len(text) + 1, 41):
                if path in editor.texts:
                    editor.change(path, text[:end])
                else:
                    editor.open(path, text[:end], language="yaml" if name.endswith("yaml") else "roslaunch")
                await editor.everything(path, position(text[:end], end, editor.encoding))
            editor.change(path, text)
            for at in range(0, len(text), 37):
                await editor.everything(path, position(text, at, editor.encoding))
            editor.close(path)


async def test_a_node_and_what_names_it(harness: Harness, package: Path) -> None:
    """A container is named by those who load into it, a node by the keys of its parameter file."""
    path = package / "load.launch.xml"
    inner, params = package / "inner.launch.yaml", package / "params.yaml"
    path.write_text(
        """<launch>
  <node_container pkg="rclcpp_components" exec="component_container" name="box" namespace=""/>
  <load_composable_node target="box">
    <composable_node pkg="robot" plugin="robot::One" name="one"/>
  </load_composable_node>
  <load_composable_node target="/box">
    <composable_node pkg="robot" plugin="robot::Two" name="two"/>
  </load_composable_node>
</launch>
"""
    )
    inner.write_text(INNER.replace("name: $(var name)\n      namespace", "name: talker\n      namespace"))
    async with editing(harness, folder=package.parents[1]) as editor:
        text = editor.open(path)
        editor.apply(await editor.rename(path, editor.at(path, '"box"', 2), "crate"))
        assert editor.texts[path] == text.replace("box", "crate")
        yaml = editor.open(inner, language="yaml")
        editor.apply(await editor.rename(inner, editor.at(inner, "name: talker", 7), "speaker"))
        assert editor.texts[inner] == yaml.replace("name: talker", "name: speaker")
        assert editor.texts[params] == PARAMS.replace("/ns/talker", "/ns/speaker")
