"""A line more above changes nothing of what other files make of a launch."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.documents.span import Location
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

ROS1 = {
    "main.launch": """\
<launch>
  <arg name="rate" default="5"/>
  <remap from="a" to="b"/>
  <param name="above" value="1"/>
  <include file="$(dirname)/one.launch">
    <arg name="rate" value="$(arg rate)"/>
    <arg name="unknown" value="1"/>
  </include>
</launch>
""",
    "one.launch": """\
<launch>
  <arg name="rate"/>
  <arg name="missing"/>
  <node pkg="p" type="t" name="one" args="$(arg missing)"><param name="rate" value="$(arg rate)"/></node>
  <include file="$(dirname)/two.launch"><arg name="rate" value="$(arg rate)"/></include>
</launch>
""",
    "two.launch": """\
<launch>
  <arg name="rate"/>
  <rosparam file="$(dirname)/params.yaml"/>
  <rosparam subst_value="true">{rate: $(arg rate)}</rosparam>
  <node pkg="p" type="t" name="two"/>
  <group if="$(eval rate == 6)"><node pkg="p" type="t" name="three"/></group>
</launch>
""",
    "params.yaml": "above: 2\nx: {y: 1}\n",
}
ROS2 = {
    "main.launch.xml": """\
<launch>
  <arg name="rate" default="5"/>
  <include file="$(dirname)/one.launch.yaml"><arg name="rate" value="$(var rate)"/></include>
</launch>
""",
    "one.launch.yaml": """\
launch:
- arg: {name: rate}
- node:
    pkg: p
    exec: t
    name: one
    param:
    - {name: rate, value: $(var rate)}
    - from: FOLDER/params.yaml
- include: {file: FOLDER/two.launch.xml}
""",
    "two.launch.xml": '<launch>\n  <node pkg="p" exec="t" name="two" if="$(var rate)"/>\n</launch>\n',
    "params.yaml": "/**:\n  ros__parameters:\n    rate: 7\n    x: {y: 1}\n",
}


def parts(tree: LaunchTree, edited: str) -> list[tuple[Location, object]]:
    """What is written in files other than the edited one."""
    found: list[tuple[Location, object]] = [(node.location, node) for node in tree.nodes]
    found += [(param.origin[-1], param) for param in tree.params.values()]
    for some in (tree.includes, tree.not_taken):
        found += [(each.origin[-1], each) for each in some]
    for others in (tree.uses, tree.problems, tree.unknowns):
        found += [(each.location, each) for each in others]
    return [(place, each) for place, each in found if place.file != edited]


@pytest.mark.parametrize("files", [ROS1, ROS2], ids=["ROS 1", "ROS 2"])
@pytest.mark.parametrize("remembering", [True, False])
def test_a_line_break_above(tmp_path: Path, files: dict[str, str], remembering: bool) -> None:
    for name, text in files.items():
        (tmp_path / name).write_text(text.replace("FOLDER", str(tmp_path)))
    generation = 1 if files is ROS1 else 2
    environment = Environment(generation, "noetic" if generation == 1 else "jazzy", {}, (), {}, {}, (), (), None)
    sources = Sources()
    workspace = Workspace(environment, sources, str(tmp_path))
    root = str(tmp_path / next(iter(files)))

    def tree() -> LaunchTree:
        return workspace.static(root).tree if remembering else workspace.tree(root, {})

    for name in files:
        path = str(tmp_path / name)
        text = Path(path).read_text()
        before = tree()
        expected, spans = parts(before, path), [place.span for place, _ in parts(before, path)]
        assert len(expected) >= 4
        assert name == "params.yaml" or len({place.file for place, _ in expected}) > 1
        for edited in ("\n" + text, text, text + "\n", text, f"\n\n{text}"):
            sources.open(path, edited)
            after = parts(tree(), path)
            assert after == expected
            assert [place.span for place, _ in after] == spans
        sources.close(path)
        assert parts(tree(), path) == expected
