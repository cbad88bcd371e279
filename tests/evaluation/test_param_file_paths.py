"""A parameter file that is named with `..` is the file itself in all that is said of it."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.package_folders import file

XML = '<launch><node pkg="p" exec="e" name="n"><param from="$(dirname)/../config/a.yaml"/></node></launch>'
YAML = 'launch:\n- node: {pkg: p, exec: e, name: n, param: [{from: "$(dirname)/../config/a.yaml"}]}\n'
PUSHED = """<launch>
  <set_parameters_from_file filename="$(dirname)/../config/a.yaml"/><node pkg="p" exec="e" name="n"/>
</launch>
"""


@pytest.mark.parametrize(("name", "text"), [("a.launch.xml", XML), ("a.launch.yaml", YAML), ("b.launch.xml", PUSHED)])
def test_findings_are_on_the_lines_of_the_file(tmp_path: Path, name: str, text: str) -> None:
    launch = file(tmp_path / "launch" / name, text=text)
    params = file(tmp_path / "config" / "a.yaml", text="n:\n  ros__parameters:\n    rate: 1\n    list: [1, a]\n")
    workspace = Workspace(detect_environment(None, {"ROS_VERSION": "2"}, []), Sources())
    analysis = workspace.static(str(launch))
    (node,) = analysis.tree.nodes
    assert [source.path for source in node.param_sources] == [str(params)]
    (finding,) = [f for f in analysis.findings if f.location.file != str(launch)]
    assert finding.location.file == str(params)
    line, _ = analysis.documents[str(params)].lines.position(finding.location.span.start)
    assert (finding.rule, line) == ("PRM016", 3)
