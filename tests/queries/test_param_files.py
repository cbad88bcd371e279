"""Editing of ROS 2's parameter files: names of nodes, what they declare, and where."""

from __future__ import annotations

import textwrap
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.queries.completion import complete
from preflight_analysis.queries.completion_items import Completion
from preflight_analysis.queries.completion_values import Lookup
from preflight_analysis.queries.definition import definition
from preflight_analysis.queries.hover import hover
from preflight_analysis.queries.rename import RenameRefusedError, rename
from support.query_harness import Executables, at_cursor
from support.workspace_harness import create_workspace

MAIN = """//- {folder}/main.launch.xml
<launch>
  <node pkg="p" exec="pump" name="pump" namespace="left"><param from="{folder}/p.yaml"/></node>
  <node pkg="p" exec="pump" name="pump" namespace="right">
    <param from="{folder}/p.yaml"/>
    <param name="rate" value="2.5"/>
  </node>
  <node pkg="p" exec="other" name="other"/>
</launch>
"""
INTERFACES = """
//- interfaces
{"/left/pump": {"params": {"rate": 10.0, "on": false, "limits.low": 1, "frame": "map"},
  "made": {"rate": ["/pump.py", 7]}},
 "/right/pump": {"params": {"rate": 10.0, "on": false}}}
"""


def completed(params: str, trigger: str | None = None) -> Completion | None:
    text = MAIN.replace("{folder}", "") + "//- /p.yaml\n" + textwrap.dedent(params).strip("\n")
    there = at_cursor(text + INTERFACES)
    launch_file = there.sources.launch_file("/p.yaml")
    assert not isinstance(launch_file, Unreadable)
    return complete(
        there.analysis, launch_file, there.offset, Lookup(there.sources, Executables(), there.ahead_of_runs), trigger
    )


def offered(params: str, trigger: str | None = None) -> list[tuple[str, str]]:
    found = completed(params, trigger)
    return [(item.label, item.detail) for item in found.items] if found else []


def labels(params: str) -> list[str]:
    return [label for label, _ in offered(params)]


def hovered(params: str) -> str:
    text = MAIN.replace("{folder}", "") + "//- /p.yaml\n" + textwrap.dedent(params).strip("\n")
    there = at_cursor(text + INTERFACES)
    found = hover([there.analysis], "/p.yaml", there.offset)
    return found.markdown if found else ""


def test_names_of_the_nodes_that_get_the_file() -> None:
    assert offered("$0") == [("/left/pump", "p/pump"), ("/right/pump", "p/pump"), ("/**", "all nodes")]
    assert labels("/left/pump:\n  ros__parameters:\n    rate: 1.0\n/ri$0") == ["/right/pump", "/**"]
    assert labels("left:\n  $0") == ["ros__parameters", "pump"]
    assert labels("left:\n  pump:\n    $0") == ["ros__parameters"]


def test_parameters_that_the_node_declares() -> None:
    found = [("rate", "double, default 10.0"), ("on", "bool, default False"), ("limits", "")]
    assert offered("/left/pump:\n  ros__parameters:\n    frame: x\n    $0") == found
    assert labels("/right/*:\n  ros__parameters:\n    $0") == ["rate", "on"]
    assert labels("/**:\n  ros__parameters:\n    o$0: true\n    rate: 1.0") == ["on", "limits", "frame"]
    assert offered("/left/pump:\n  ros__parameters:\n    limits:\n      $0") == [("low", "integer, default 1")]
    completion = completed("/left/pump:\n  ros__parameters:\n    ra$0")
    assert completion is not None
    assert completion.items[0].snippet == "rate: ${1:10.0}"
    assert labels("/nobody:\n  ros__parameters:\n    $0") == []


def test_values() -> None:
    assert labels("/left/pump:\n  ros__parameters:\n    on: $0") == ["false", "true"]
    assert offered("/left/pump:\n  ros__parameters:\n    rate: $0", " ") == [("10.0", "default")]
    assert offered("/left/pump:\n  ros__parameters:\n    $0", " ") == []


def test_hover_tells_who_gets_it_and_how_it_is_declared() -> None:
    assert "- `/left/pump` `p/pump`, started at [main.launch.xml:2]" in hovered(
        "/lef$0t/*:\n  ros__parameters:\n    a: 1"
    )
    assert hovered("/nob$0ody:\n  ros__parameters:\n    a: 1") == "`/nobody` fits no node that gets this file"
    text = hovered("/**:\n  ros__parameters:\n    rat$0e: 5")
    assert text.startswith("`rate` = `5` (integer)")
    assert "- `/left/pump` declares it: double, default `10.0` — [pump.py:7]" in text
    assert "- `/right/pump` declares it: double, default `10.0`; it gets `2.5` from [main.launch.xml:5]" in text
    assert "does not declare it" in hovered("/right/pump:\n  ros__parameters:\n    ra$0te_: 5")


def test_hover_of_the_node_says_what_it_gets_and_from_where() -> None:
    text = MAIN.replace("{folder}", "").replace('pump" namespace="right', 'pu$0mp" namespace="right')
    there = at_cursor(text + "//- /p.yaml\n/**:\n  ros__parameters:\n    rate: 5.0\n    on: true" + INTERFACES)
    found = hover([there.analysis], "/main.launch.xml", there.offset)
    assert found is not None
    assert "- `rate` = `2.5` from [main.launch.xml:5]" in found.markdown
    assert ", overrides `5.0` (double, default `10.0`)" in found.markdown
    assert "- `on` = `True` from [p.yaml:4]" in found.markdown


PLUGIN = """
    /left/pump:
      ros__parameters:
        planner:
          plugin: "nav2_navfn_planner::NavfnPlanner"
          {}
"""


def test_what_a_plugin_declares_is_its_node_s() -> None:
    names = labels(PLUGIN.format("$0"))
    assert {"tolerance", "use_astar", "allow_unknown"} <= {*names}
    assert "tolerance" not in labels(PLUGIN.format("tolerance: 1.0\n          $0"))
    assert offered(PLUGIN.format("tolerance: $0"))[:1] == [("0.5", "default")]
    assert "`/left/pump` declares it: double, default `0.5`" in hovered(PLUGIN.format("toler$0ance: 1.0"))
    assert "declares it" not in hovered(PLUGIN.format("nothing$0: 1.0"))


def test_to_the_declaration_in_the_source(tmp_path: Path) -> None:
    made = '{"/pump": {"params": {"rate": 10.0}, "made": {"rate": ["%s/pump.py", 2]}}}' % tmp_path
    text = (
        '//- main.launch.xml\n<launch>\n<node pkg="p" exec="t" name="pump"><param from="{folder}/p.yaml"/></node>\n'
        "<let name='a' value='b'/></launch>\n//- pump.py\nimport rclpy\ndeclare('rate')\n"
        f"//- p.yaml\npump:\n  ros__parameters:\n    ra$0te: 5.0\n//- interfaces\n{made}\n"
    )
    workspace = create_workspace(tmp_path, text)
    assert [workspace.shown(t.location) for t in definition(workspace.context, workspace.offset, ())] == [
        "pump.py:2 declare('rate')"
    ]


@given(
    st.lists(
        st.sampled_from(["/left/pump:", "\n", "  ", "- ", "ros__parameters:", "rate: 1", ": ", "'", "#", "{", "*"])
    ),
    st.integers(0, 60),
)
def test_nothing_that_is_typed_raises(pieces: list[str], cursor: int) -> None:
    text = "".join(pieces)
    fixture = text[:cursor] + "$0" + text[cursor:]
    found = labels(fixture)
    assert len(found) == len(set(found))
    assert isinstance(hovered(fixture), str)


def test_from_a_param_tag_to_the_declaration(tmp_path: Path) -> None:
    made = f'{{"/pump": {{"params": {{"rate": 10.0}}, "made": {{"rate": ["{tmp_path}/pump.py", 2]}}}}}}'
    text = (
        '//- main.launch.xml\n<launch>\n<node pkg="p" exec="t" name="pump"><param name="ra$0te" value="1.0"/></node>\n'
        f"</launch>\n//- pump.py\nimport rclpy\ndeclare('rate')\n//- interfaces\n{made}\n"
    )
    workspace = create_workspace(tmp_path, text)
    assert [workspace.shown(t.location) for t in definition(workspace.context, workspace.offset, ())] == [
        "pump.py:2 declare('rate')"
    ]


RENAMED = """
//- main.launch.yaml
launch:
- node:
    pkg: p
    exec: t
    name: pu$0mp
    namespace: left
    param:
    - from: {folder}/p.yaml
- node:
    pkg: p
    exec: t
    name: %s
    namespace: right
    param:
    - from: {folder}/p.yaml
//- p.yaml
/left/pump:
  ros__parameters: {a: 1}
left:
  pump:
    ros__parameters: {b: 1}
/*/pump:
  ros__parameters: {c: 1}
/**:
  ros__parameters: {d: 1}
"""


def test_a_renamed_node_keeps_its_parameters(tmp_path: Path) -> None:
    workspace = create_workspace(tmp_path, RENAMED % "fan")
    edited = workspace.edited(rename(workspace.context, workspace.offset, "motor"))
    assert "name: motor\n" in edited["main.launch.yaml"]
    keys = [line for line in edited["p.yaml"].split("\n") if "motor" in line or "pump" in line]
    assert keys == ["/left/motor:", "  motor:", "/*/motor:"]


def test_nodes_that_share_a_section_are_renamed_together(tmp_path: Path) -> None:
    workspace = create_workspace(tmp_path, RENAMED % "pump")
    edits = rename(workspace.context, workspace.offset, "motor")
    edited = workspace.edited(edits)
    assert edited["main.launch.yaml"].count("name: motor\n") == 2
    assert "pump" not in edited["p.yaml"]
    assert [(workspace.shown(e.location), e.reason) for e in edits if e.indirect] == [
        ("main.launch.yaml:12 pump", "It reads the same section at p.yaml:6")
    ]


def test_nodes_of_several_launches_that_share_a_section_are_renamed_together(tmp_path: Path) -> None:
    text = """
        <launch>
          <node pkg="p" exec="t" name="$0pump"><param from="{folder}/p.yaml"/></node>
        </launch>
        //- other.launch.xml
        <launch>
          <node pkg="p" exec="t" name="%s"><param from="{folder}/p.yaml"/></node>
          <node pkg="p" exec="t" name="fan"><remap from="a" to="pump/a"/></node>
        </launch>
        //- third.launch.xml
        <launch><node pkg="p" exec="t" name="pump" namespace="x"><param from="{folder}/p.yaml"/></node></launch>
        //- p.yaml
        pump:
          ros__parameters: {a: 1}
        """
    workspace = create_workspace(tmp_path / "a", text % "pump", build_type="ament_python")
    edited = workspace.edited(rename(workspace.context, workspace.offset, "motor"))
    assert sorted(edited) == ["main.launch", "other.launch.xml", "p.yaml"]
    assert edited["other.launch.xml"].count('"motor') == 2
    workspace = create_workspace(tmp_path / "b", text % "$(env NAME pump)", build_type="ament_python")
    with pytest.raises(RenameRefusedError, match=r"started at other\.launch\.xml:2: rename it by hand"):
        rename(workspace.context, workspace.offset, "motor")
