"""A graph as plain data for a picture."""

from __future__ import annotations

import json

from preflight_analysis.documents.span import Place
from preflight_analysis.view.layout import lay_out
from preflight_analysis.view.model import GraphView, ViewEdge
from preflight_analysis.view.view_json import view_json
from support import sample_graphs


def edges(view: GraphView, channel: str) -> dict[tuple[str, str], ViewEdge]:
    return {
        (view.nodes[edge.node].name, edge.role): edge
        for edge in view.edges
        if view.channels[edge.channel].name == channel
    }


def test_nodes_and_channels_have_final_names_and_actions_stand_for_their_topics() -> None:
    view = sample_graphs.robot()
    assert [node.name for node in view.nodes][:2] == ["/base", "/laser"]
    kinds = {(channel.kind, channel.name) for channel in view.channels}
    assert {("topic", "/camera/image_colour"), ("service", "/base/reset"), ("action", "/move_base")} <= kinds
    assert not any(name.startswith("/move_base/") for _, name in kinds)


def test_findings_are_at_the_edges_that_they_speak_of() -> None:
    view = sample_graphs.robot()
    odom = edges(view, "/odom")
    assert {end: view.severity(edge.findings) for end, edge in odom.items()} == {
        ("/base", "publisher"): "error",
        ("/planner", "subscriber"): "error",
        ("/slam", "subscriber"): None,
    }
    scan, scann = edges(view, "/scan"), edges(view, "/scann")
    assert scan["/laser", "publisher"].findings == scann["/planner", "subscriber"].findings
    assert view.severity(scann["/planner", "subscriber"].findings) == "warning"
    assert view.severity(edges(view, "/cmd_vel")["/base", "subscriber"].findings) is None


def test_a_finding_about_a_node_is_at_the_node() -> None:
    view = sample_graphs.robot()
    told = {node.name: [view.findings[i].rule for i in node.findings] for node in view.nodes if node.findings}
    assert told == {"/recorder": ["TRC004"]}


def test_an_end_leads_to_its_source_and_to_the_launch_file() -> None:
    view = sample_graphs.robot()
    assert edges(view, "/odom")["/base", "publisher"].places == (Place("/src/base.py", 12), Place("/base.launch", 2, 3))
    remapped = edges(view, "/scann")["/planner", "subscriber"]
    assert (remapped.remapped_from, remapped.places) == ("scan", (Place("/navigation.launch", 4, 28),))
    (planner,) = (node for node in view.nodes if node.name == "/planner")
    assert planner.places == (Place("/navigation.launch", 3, 3), Place("/robot.launch", 3, 3))


def test_what_every_node_has_is_left_out_on_demand() -> None:
    view = sample_graphs.robot()
    assert [channel.name for channel in view.channels if channel.builtin] == ["/rosout"]
    plain = view.without_builtin()
    assert len(plain.edges) == len(view.edges) - 1
    assert "/rosout" not in {channel.name for channel in plain.channels}
    assert {(e.role, plain.channels[e.channel].name) for e in plain.edges} == {
        (e.role, view.channels[e.channel].name) for e in view.edges if not e.builtin
    }


def test_a_tag_in_a_file_that_is_included_twice_has_a_finding_at_both_nodes() -> None:
    view = sample_graphs.view_of("""
        <launch>
          <group ns="a"><include file="/inc.launch"/></group>
          <group ns="b"><include file="/inc.launch"/></group>
        </launch>
        //- /inc.launch
        <launch><node pkg="p" type="t" name="n" respwan="true"/></launch>
        //- interfaces
        {"/a/n": {"publishers": {"x": "p/T"}}, "/b/n": {"subscribers": {"/a/x": "p/T"}}}
    """)
    assert [bool(node.findings) for node in view.nodes] == [True, True]
    assert [view.findings[i].rule for i in view.nodes[0].findings] == ["LCH005"]


def test_json_refers_by_position_and_shows_files_from_the_folder() -> None:
    view = sample_graphs.robot().without_builtin()
    data = json.loads(json.dumps(view_json(view, lay_out(view), "/")))
    assert data["schema"] == "ros-preflight/view/1"
    assert [file["shown"] for file in data["files"]] == ["robot.launch", "base.launch", "navigation.launch"]
    assert {box.get("node") for box in data["boxes"]} - {None} == set(range(len(data["nodes"])))
    assert sorted(i for box in data["boxes"] for i in box.get("channels", ())) == list(range(len(data["channels"])))
    assert sorted(i for route in data["routes"] for i in route["edges"]) == list(range(len(data["edges"])))
    assert {node["state"] for node in data["nodes"]} == {"normal"}


def test_a_composable_node_is_told_by_its_plugin() -> None:
    view = sample_graphs.view_of("""
        //- /c.launch.xml
        <launch>
          <node_container pkg="p" exec="component_container" name="c" namespace="">
            <composable_node pkg="p" plugin="p::Filter" name="filter" namespace=""/>
          </node_container>
        </launch>
        //- interfaces
        {"/filter": {"publishers": {"x": "p/T"}}}
    """)
    assert [(node.name, node.executable) for node in view.nodes] == [
        ("/c", "component_container"),
        ("/filter", "p::Filter"),
    ]


def test_a_file_has_the_colour_that_it_has_in_the_tree() -> None:
    """The order of all launch files counts, also of those that start no node themselves."""
    text = """
    //- /root.launch
    <launch><include file="/a.launch"/><include file="/b.launch"/></launch>
    //- /a.launch
    <launch><include file="/b.launch" ns="first"/></launch>
    //- /b.launch
    <launch><node pkg="p" type="n.py" name="n"/></launch>
    //- interfaces
    {"/n": {}, "/first/n": {}}
    """
    view = sample_graphs.view_of(text)
    assert view.files == ("/root.launch", "/a.launch", "/b.launch")
    picture = view_json(view, lay_out(view), "/")
    assert [node["file"] for node in picture["nodes"]] == [2, 2]
    assert 'class="accent f2"' in picture["svg"]
    assert 'class="accent f0"' not in picture["svg"]
