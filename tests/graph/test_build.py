"""Names after namespaces and remaps, as rospy and roscpp resolve them."""

import pytest
from preflight_analysis.graph.build import build_graph
from preflight_analysis.graph.model import Graph
from preflight_analysis.tracing.interface import NOT_RUN
from support.check import analyse, read_fixture


def graph_of(text: str) -> Graph:
    graph = analyse(read_fixture(text)).graph
    assert graph is not None
    return graph


def ends(graph: Graph) -> dict[str, tuple[list[str], list[str]]]:
    return {
        name: ([c.node.name for c in channel.providers], [c.node.name for c in channel.consumers])
        for name, channel in graph.topics.items()
    }


def test_relative_private_and_global_names() -> None:
    graph = graph_of("""
        <launch><node pkg="p" type="t" name="n" ns="/a/b"/></launch>
        //- interfaces
        {"/a/b/n": {"publishers": {"rel": "x/Y", "~priv": "x/Y", "/glob": "x/Y", "sub//dir/": "x/Y"},
                    "params": {"~rate": 1, "frame": null}}}
    """)
    assert sorted(graph.topics) == ["/a/b/n/priv", "/a/b/rel", "/a/b/sub/dir", "/glob"]
    assert [read.name for read in graph.param_reads] == ["/a/b/n/rate", "/a/b/frame"]


def test_a_remap_is_looked_up_with_the_resolved_name() -> None:
    graph = graph_of("""
        <launch>
          <group ns="robot">
            <node pkg="p" type="t" name="n">
              <remap from="scan" to="scan_filtered"/>
              <remap from="~plan" to="/plan"/>
              <remap from="/robot/odom" to="wheel/odom"/>
            </node>
          </group>
        </launch>
        //- interfaces
        {"/robot/n": {"subscribers": {"scan": "x/Y", "/robot/scan": "x/Z", "odom": "x/O"},
                      "publishers": {"~plan": "x/P"}}}
    """)
    assert sorted(graph.topics) == ["/plan", "/robot/scan_filtered", "/robot/wheel/odom"]
    (plan,) = graph.topics["/plan"].providers
    assert plan.remap is not None
    assert plan.remap.target == "/plan"
    assert graph.topics["/robot/scan_filtered"].types == ("x/Y", "x/Z")


def test_arguments_are_remaps_which_tags_override() -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="n" args="5 a:=/front b:=/back _c:=c __name:=d">
            <remap from="b" to="/rear"/>
          </node>
        </launch>
        //- interfaces
        {"/n": {"subscribers": {"a": "x/Y", "b": "x/Y", "c": "x/Y"}}}
    """
    graph = graph_of(text)
    assert sorted(graph.topics) == ["/c", "/front", "/rear"]
    assert graph.topics["/front"].consumers[0].remap is None


def test_a_remapped_name_is_not_remapped_again() -> None:
    graph = graph_of("""
        <launch>
          <node pkg="p" type="t" name="n">
            <remap from="a" to="b"/>
            <remap from="b" to="c"/>
          </node>
        </launch>
        //- interfaces
        {"/n": {"publishers": {"a": "x/Y"}}}
    """)
    assert ends(graph) == {"/b": (["/n"], [])}


NODELETS = """
    <launch>
      <node pkg="nodelet" type="nodelet" name="{manager}" ns="mgr" args="manager">
        <remap from="/camera/picture" to="/chained"/>
        <remap from="/camera/camera_info" to="/moved"/>
        <remap from="relative" to="relative_moved"/>
      </node>
      <group ns="camera">
        <node pkg="nodelet" type="nodelet" name="two" args="load vision/Of /mgr/manager">
          <remap from="~image" to="picture"/>
          <remap from="queued" to="camera_info"/>
        </node>
        <node pkg="nodelet" type="nodelet" name="three" args="load vision/Of /mgr/manager">
          <remap from="camera_info" to="info_three"/>
        </node>
      </group>
    </launch>
    //- interfaces
    {{"/camera/two": {{"publishers": {{"~image": "x/Y", "queued": "x/Y", "camera_info": "x/Y"}}}},
      "/camera/three": {{"publishers": {{"~image": "x/Y", "camera_info": "x/Y", "/mgr/relative": "x/Y"}}}}}}
"""


def test_a_nodelet_has_the_remaps_of_its_manager_before_its_own() -> None:
    """As a real manager does it."""
    graph = graph_of(NODELETS.format(manager="manager"))
    two, three = "/camera/two", "/camera/three"
    assert {name: set(providers) for name, (providers, _) in ends(graph).items()} == {
        "/chained": {two},
        "/moved": {two, three},
        "/camera/three/image": {three},
        "/mgr/relative_moved": {three},
    }


def test_a_nodelet_whose_manager_is_elsewhere_has_its_own_remaps() -> None:
    graph = graph_of(NODELETS.format(manager="another"))
    assert sorted(graph.topics) == [
        "/camera/camera_info",
        "/camera/info_three",
        "/camera/picture",
        "/camera/three/image",
        "/mgr/relative",
    ]


def test_a_remap_of_a_namespace_does_not_move_what_is_below_it() -> None:
    graph = graph_of("""
        <launch><node pkg="p" type="t" name="n"><remap from="camera" to="front"/></node></launch>
        //- interfaces
        {"/n": {"publishers": {"camera/image": "x/Y"}}}
    """)
    assert sorted(graph.topics) == ["/camera/image"]


def test_remaps_apply_to_services_and_parameters_too() -> None:
    graph = graph_of("""
        <launch><node pkg="p" type="t" name="n"><remap from="reset" to="/reset_all"/></node></launch>
        //- interfaces
        {"/n": {"services": {"reset": "std_srvs/Empty"}, "params": {"reset": 1}}}
    """)
    assert sorted(graph.services) == ["/reset_all"]
    assert [read.name for read in graph.param_reads] == ["/reset_all"]


def test_declared_actions_move_with_a_remap_of_their_name() -> None:
    graph = graph_of("""
        <launch>
          <node pkg="p" type="t" name="n"/>
          <node pkg="p" type="t" name="m"><remap from="dock" to="/base/dock"/></node>
        </launch>
        //- interfaces
        {"/n": {"action_servers": {"dock": "x/Dock"}}, "/m": {"action_clients": {"dock": "x/Dock"}}}
    """)
    assert {name: (len(c.providers), len(c.consumers)) for name, c in graph.actions.items()} == {
        "/base/dock": (0, 1),
        "/dock": (1, 0),
    }
    assert {name: len(c.consumers) for name, c in graph.topics.items()} == dict.fromkeys(
        [*(f"/dock/{t}" for t in ("goal", "cancel")), *(f"/base/dock/{t}" for t in ("feedback", "result", "status"))], 1
    ) | dict.fromkeys(
        [*(f"/base/dock/{t}" for t in ("goal", "cancel")), *(f"/dock/{t}" for t in ("feedback", "result", "status"))], 0
    )


def test_an_end_made_twice_counts_once() -> None:
    fixture = read_fixture("""
        <launch><node pkg="p" type="t" name="n"/></launch>
        //- interfaces
        {"/n": {"publishers": {"a": "x/Y", "/a": "x/Y"}}}
    """)
    graph = analyse(fixture).graph
    assert graph is not None
    assert len(graph.topics["/a"].providers) == 1


def test_interfaces_and_nodes_must_match() -> None:
    context = analyse(read_fixture('<launch><node pkg="p" type="t" name="n"/></launch>'))
    with pytest.raises(ValueError, match="2 interfaces of 1 nodes"):
        build_graph(context.tree, [NOT_RUN, NOT_RUN])


def test_only_full_knowledge_makes_a_graph_complete() -> None:
    text = """
        <launch><node pkg="p" type="t" name="a"/><node pkg="p" type="t" name="b"/></launch>
        //- interfaces
        {"/a": {}, "/b": {"status": "STATUS", "exit_code": 1}}
    """
    assert graph_of(text.replace("STATUS", "spinning")).complete
    for status in ("crashed", "timed-out", "exited", "not-run"):
        assert not graph_of(text.replace("STATUS", status)).complete


def test_a_client_that_told_only_its_sum_has_the_type_of_its_server() -> None:
    graph = graph_of("""
        <launch>
          <node pkg="p" type="t" name="a"/><node pkg="p" type="t" name="b"/><node pkg="p" type="t" name="c"/>
        </launch>
        //- interfaces
        {"/a": {"services": {"reset": "std_srvs/Empty"}, "md5": {"reset": "11"}},
         "/b": {"services": {"wipe": "x/Nothing"}, "md5": {"wipe": "11"}},
         "/c": {"clients": {"reset": null}, "md5": {"reset": "11"}}}
    """)
    (client,) = graph.services["/reset"].consumers
    assert client.endpoint.type == "std_srvs/Empty"


def test_a_client_without_a_server_has_the_only_type_of_its_sum() -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="a"/><node pkg="p" type="t" name="b"/><node pkg="p" type="t" name="c"/>
        </launch>
        //- interfaces
        {"/a": {"services": {"reset": "x/A"}, "md5": {"reset": "11"}},
         "/b": {"services": {"wipe": "SECOND"}, "md5": {"wipe": "11"}},
         "/c": {"clients": {"rest": null}, "md5": {"rest": "11"}}}
    """
    for second, expected in (("x/A", "x/A"), ("x/B", None)):
        (client,) = graph_of(text.replace("SECOND", second)).services["/rest"].consumers
        assert client.endpoint.type == expected
