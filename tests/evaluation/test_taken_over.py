"""What comes out equal is the object of before, and nothing else is."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.model import Environment
from preflight_analysis.launch.model import Action, LaunchFile
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

TEXT = """<launch>
  <node pkg="p" type="t" name="one"/>
  <node pkg="p" type="t" name="two"/>
  <param name="/number" value="1"/>
  <param name="/text" value="a"/>
</launch>
"""


def test_equal_nodes_and_parameters_are_the_same_objects(tmp_path: Path) -> None:
    environment = Environment(1, "noetic", {}, (), {}, {}, (), (), None, str(tmp_path))
    sources, path = Sources(), str(tmp_path / "a.launch")
    workspace = Workspace(environment, sources, str(tmp_path))
    sources.open(path, TEXT)
    before = workspace.static(path).tree
    sources.open(path, TEXT.replace('value="1"', 'value="1.0"').replace('name="two"', 'name="too"'))
    after = workspace.static(path).tree
    assert [node.name for node in after.nodes] == ["/one", "/too"]
    assert after.nodes[0] is before.nodes[0]
    assert after.params["/text"] is before.params["/text"]
    assert list(after.params) == list(before.params)
    assert repr(after.params["/number"].value) == "1.0"
    sources.open(path, TEXT)
    again = workspace.static(path).tree
    assert repr(again.params["/number"].value) == "1" and again.nodes[1] == before.nodes[1]


NODES = {
    "a.launch": '<node pkg="p" type="t" name="{0}"><remap from="a" to="$(arg {0})"/><!-- é --></node>',
    "a.launch.xml": '<node pkg="p" exec="t" name="{0}"><remap from="a" to="$(var {0})"/><!-- é --></node>',
    "a.launch.yaml": """  - node:
      pkg: p
      exec: t
      name: {0}
      remap: [{{from: a, to: "$(var {0})"}}]""",
}


@pytest.mark.parametrize("name", NODES)
def test_a_node_that_moved_is_the_same_and_has_its_new_places(tmp_path: Path, name: str) -> None:
    environment = Environment(1 + name.endswith(("xml", "yaml")), "noetic", {}, (), {}, {}, (), (), None, str(tmp_path))
    sources, path = Sources(), str(tmp_path / name)
    workspace = Workspace(environment, sources, str(tmp_path))
    start, comment, end = (
        ("launch:\n", "# above\n", "\n") if "yaml" in name else ("<launch>\n", "<!-- a -->\n", "</launch>")
    )
    nodes = "\n".join(NODES[name].format(each) for each in ("one", "two"))
    trees = []
    for above in ("", "\n", comment, f"\n\n{comment}", NODES[name].format("zero") + "\n", "\n"):
        text = f"{start}{above}{nodes}{end}"
        sources.open(path, text)
        trees.append(workspace.static(path).tree)
        found = launch_file(trees[-1].file, sources)
        assert [node.action for node in trees[-1].nodes] == [each for each in found if each.kind == "node"]
    for tree in trees:
        same = zip(tree.nodes[-2:], trees[0].nodes, strict=True)
        assert all(one is other for one, other in same)


def launch_file(path: str, sources: Sources) -> tuple[Action, ...]:
    found = sources.launch_file(path)
    assert isinstance(found, LaunchFile) and found.root is not None
    return found.root.children
