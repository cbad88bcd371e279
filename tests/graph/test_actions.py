"""Actions among the topics of nodes."""

import subprocess
from dataclasses import replace

import pytest
from preflight_analysis.graph.actions import TOPICS, actions_of
from preflight_analysis.graph.annotations import annotation_text
from preflight_analysis.graph.build import build_graph
from preflight_analysis.graph.graph_json import graph_json
from preflight_analysis.graph.model import Graph
from preflight_analysis.tracing.interface import Endpoint, Interface, Outcome, Role
from support.check import analyse, environment_of, read_fixture
from support.tracing_harness import SYSTEM_PYTHON

TYPES = {
    "goal": "m/GoActionGoal",
    "cancel": "actionlib_msgs/GoalID",
    "status": "actionlib_msgs/GoalStatusArray",
    "feedback": "m/GoActionFeedback",
    "result": "m/GoActionResult",
}


def client(name: str, file: str | None = None, md5: str | None = None) -> list[Endpoint]:
    roles: dict[str, Role] = dict.fromkeys(TOPICS, "subscriber") | {"goal": "publisher", "cancel": "publisher"}
    return [Endpoint(roles[t], f"{name}/{t}", TYPES[t], md5, source_file=file, source_line=7) for t in TOPICS]


def graph_of(launch: str, endpoints: list[Endpoint]) -> Graph:
    tree = analyse(read_fixture(launch)).tree
    return build_graph(tree, [Interface("trace", Outcome("spinning"), tuple(endpoints))])


def test_five_topics_of_fitting_types_and_directions_are_an_action() -> None:
    (found,) = actions_of(client("~go", "/n.py"))
    assert found.endpoint == Endpoint("action_client", "~go", "m/GoAction", source_file="/n.py", source_line=7)
    assert [topic.name for topic in found.parts] == [f"~go/{topic}" for topic in TOPICS]


@pytest.mark.parametrize("index", range(5))
def test_four_of_five_are_topics(index: int) -> None:
    endpoints = client("go")
    assert actions_of(endpoints[:index] + endpoints[index + 1 :]) == ()


def test_another_type_or_direction_is_no_action() -> None:
    goal, *rest = client("go")
    assert actions_of([Endpoint("publisher", "go/goal", "m/ComeActionGoal"), *rest]) == ()
    assert actions_of([Endpoint("publisher", "go/goal", "m/Goal"), *rest]) == ()
    assert actions_of([Endpoint("subscriber", "go/goal", "m/GoActionGoal"), *rest]) == ()
    assert len(actions_of([goal, *rest])) == 1


def test_a_node_can_be_client_and_server_of_one_action() -> None:
    mirrored = [Endpoint("subscriber" if e.role == "publisher" else "publisher", e.name, e.type) for e in client("go")]
    assert [end.endpoint.role for end in actions_of([*client("go"), *mirrored])] == ["action_client", "action_server"]


@pytest.mark.ros
def test_the_md5_sum_is_that_of_the_actions_message() -> None:
    program = (
        "from actionlib.msg import *; from actionlib_msgs.msg import GoalID, GoalStatusArray\n"
        "print(*(m._md5sum for m in (TestActionGoal, GoalID, GoalStatusArray, TestActionFeedback, TestActionResult,"
        " TestAction)))"
    )
    done = subprocess.run([SYSTEM_PYTHON, "-c", program], capture_output=True, text=True, check=True)
    *parts, whole = done.stdout.split()
    ends = client("go")
    (found,) = actions_of(Endpoint(e.role, e.name, e.type, md5) for e, md5 in zip(ends, parts, strict=True))
    assert found.endpoint.md5 == whole


def test_a_remap_of_the_name_moves_all_topics() -> None:
    launch = '<launch><node pkg="p" type="t" name="n" ns="a"><remap from="go" to="/b/come"/></node></launch>'
    graph = graph_of(launch, client("go"))
    assert list(graph.topics) == [f"/b/come/{topic}" for topic in sorted(TOPICS)]
    (end,) = graph.actions["/b/come"].consumers
    assert end.remap is not None
    assert {c.action for channel in graph.topics.values() for c in (*channel.providers, *channel.consumers)} == {
        "/b/come"
    }


def test_what_a_client_library_remapped_already_is_not_remapped_again() -> None:
    launch = """
        <launch><node pkg="p" type="t" name="n">
          <remap from="go" to="come"/><remap from="come" to="stay"/>
        </node></launch>
    """
    graph = graph_of(launch, client("/come", md5="0" * 32))
    (end,) = graph.actions["/come"].consumers
    assert end.remap is not None
    assert end.remap.source == "go"
    assert list(graph_of(launch, client("come")).actions) == ["/stay"]


def test_remaps_that_leave_topics_behind_leave_no_action() -> None:
    launch = '<launch><node pkg="p" type="t" name="n"><remap from="go/goal" to="/b/goal"/></node></launch>'
    graph = graph_of(launch, client("go"))
    assert graph.actions == {}
    assert sorted(graph.topics) == ["/b/goal", *(f"/go/{topic}" for topic in sorted(TOPICS) if topic != "goal")]
    assert {c.action for channel in graph.topics.values() for c in (*channel.providers, *channel.consumers)} == {None}


def test_json_has_the_action_and_marks_its_topics() -> None:
    data = graph_json(graph_of('<launch><node pkg="p" type="t" name="n"/></launch>', client("go")))
    (node,) = data["nodes"]
    assert node["action_clients"] == [{"name": "/go", "type": "m/GoAction", "qos": {}}]
    assert [(end["name"], end["action"]) for end in node["publishers"]] == [("/go/cancel", "/go"), ("/go/goal", "/go")]
    assert data["actions"] == {"/go": {"types": ["m/GoAction"], "servers": [], "clients": ["/n"]}}


def test_an_annotation_is_written_with_the_action() -> None:
    text = annotation_text(Interface("trace", Outcome("spinning"), tuple(client("go"))))
    assert text == '<!--\n  <actions>\n    <action name="go" type="m/GoAction" class="client"/>\n  </actions>\n-->'


ROS2 = """
    //- /nav.launch.xml
    <launch><node pkg="p" exec="t" name="n" namespace="a"><remap from="go" to="/b/come"/></node></launch>
"""
SERVICES = ("/b/come/_action/cancel_goal", "/b/come/_action/get_result", "/b/come/_action/send_goal")
HIDDEN = ("/b/come/_action/feedback", "/b/come/_action/status")


@pytest.mark.parametrize("role", ["action_server", "action_client"])
def test_an_action_of_ros_2_is_three_services_and_two_topics(role: Role) -> None:
    graph = graph_of(ROS2, [Endpoint(role, "go", "m/action/Go")])
    assert tuple(graph.services) == SERVICES
    assert tuple(graph.topics) == HIDDEN
    assert [c.types for c in (*graph.services.values(), *graph.topics.values())] == [
        ("action_msgs/srv/CancelGoal",),
        ("m/action/Go_GetResult",),
        ("m/action/Go_SendGoal",),
        ("m/action/Go_FeedbackMessage",),
        ("action_msgs/msg/GoalStatusArray",),
    ]
    offered = role == "action_server"
    for channel in (*graph.services.values(), *graph.topics.values(), *graph.actions.values()):
        assert (len(channel.providers), len(channel.consumers)) == ((1, 0) if offered else (0, 1))
    (action,) = graph.actions.values()
    (end,) = (*action.providers, *action.consumers)
    assert (action.name, end.endpoint.type) == ("/b/come", "m/action/Go")


def test_the_client_libraries_before_kilted_do_not_remap_an_action_as_a_whole() -> None:
    tree = analyse(read_fixture(ROS2)).tree
    interface = Interface("trace", Outcome("spinning"), (Endpoint("action_server", "go", "m/action/Go"),))
    found = {}
    for distro in ("jazzy", "kilted"):
        environment = replace(environment_of(read_fixture(ROS2)), distro=distro)
        found[distro] = list(build_graph(tree, [interface], environment=environment).actions)
    assert found == {"jazzy": ["/a/go"], "kilted": ["/b/come"]}


def test_a_remap_of_one_part_in_ros_2_leaves_no_action() -> None:
    launch = ROS2.replace('from="go" to="/b/come"', 'from="go/_action/feedback" to="seen"')
    graph = graph_of(launch, [Endpoint("action_server", "go", "m/Go")])
    assert graph.actions == {}
    assert list(graph.topics) == ["/a/go/_action/status", "/a/seen"]


def test_json_of_an_action_in_ros_2() -> None:
    (node,) = graph_json(graph_of(ROS2, [Endpoint("action_server", "go", "m/action/Go")]))["nodes"]
    assert [(end["name"], end["action"]) for end in node["services"]] == [(name, "/b/come") for name in SERVICES]
    assert [end["name"] for end in node["publishers"]] == list(HIDDEN)
    assert [(end["name"], end["type"]) for end in node["action_servers"]] == [("/b/come", "m/action/Go")]
