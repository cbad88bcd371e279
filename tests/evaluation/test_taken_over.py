"""What comes out equal is the object of before, and nothing else is."""

from __future__ import annotations

from pathlib import Path

from preflight_analysis.environment.model import Environment
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
