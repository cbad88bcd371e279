"""What is held against a running system, and what is not."""

from __future__ import annotations

from dataclasses import replace

from preflight_analysis.live.compare import compare
from preflight_analysis.live.model import (
    Expected,
    ExpectedEndpoint,
    ExpectedNode,
    LiveEndpoint,
    LiveNode,
    Observation,
)
from preflight_analysis.live.report import line, message, summary
from preflight_analysis.tracing.interface import Role

STRING = "std_msgs/String"


def node(name: str, *ends: ExpectedEndpoint, complete: bool = True) -> ExpectedNode:
    return ExpectedNode(name, ends, complete, None)


def endpoint(role: Role, name: str, type_: str | None = STRING, *, certain: bool = True) -> ExpectedEndpoint:
    return ExpectedEndpoint(role, name, type_, certain=certain)


def live(nodes: dict[str, list[tuple[Role, str, str | None]]], generation: int = 1) -> Observation:
    ends = tuple(LiveEndpoint(role, owner, name, kind) for owner, found in nodes.items() for role, name, kind in found)
    return Observation(generation, {name: LiveNode(name) for name in nodes}, ends)


def told(nodes: list[ExpectedNode], observation: Observation, *, complete: bool = True) -> list[str]:
    """What counts as it is, what does not in brackets."""
    found = compare(Expected(observation.generation, tuple(nodes), complete), observation)
    assert found.same is not any(issue.counts for issue in found.issues)
    return [message(issue) if issue.counts else f"({message(issue)})" for issue in found.issues]


def test_of_a_node_of_which_nothing_is_known_only_the_presence_is_judged() -> None:
    unknown = node("/a", complete=False)
    assert told([unknown], live({"/a": [("publisher", "/x", STRING)]})) == []
    assert told([unknown], live({})) == ["/a is not running"]


def test_what_may_be_missing_is_for_information() -> None:
    source_only = node("/a", endpoint("publisher", "/x", certain=False), complete=False)
    assert told([source_only], live({"/a": []})) == [
        "(/a does not publish /x (std_msgs/String); it may not do so in every run)"
    ]
    on_demand = node("/a", replace(endpoint("publisher", "/x", certain=False), on_demand=True))
    assert told([on_demand], live({"/a": []})) == []
    assert told([on_demand], live({"/a": [("publisher", "/x", STRING)]})) == []
    assert told([replace(node("/a"), certain=False)], live({})) == ["(/a is not running, which may be intended)"]
    assert told([replace(node("/a"), exits=True)], live({})) == ["(/a is not running, which may be intended)"]


def test_why_a_node_that_is_missing_ended_in_the_sandbox_is_told() -> None:
    crashed = replace(node("/a", complete=False), reason="it ended with exit code 1")
    assert told([crashed], live({})) == ["/a is not running; in the sandbox it ended with exit code 1"]


def test_a_node_that_died_is_no_node_with_missing_ends() -> None:
    dead = Observation(1, {"/a": LiveNode("/a", dead="connection refused")}, ())
    expected = node("/a", endpoint("publisher", "/x"))
    found = compare(Expected(1, (expected,)), dead)
    assert [message(i) for i in found.issues] == ["/a is registered and does not answer: connection refused"]
    assert (found.nodes, found.topics) == ({"/a": "dead"}, {"/x": "dead"})


def test_a_node_that_lacks_something_is_not_as_expected() -> None:
    """What counts is seen at the node, what is for information is not."""
    lacking = node("/a", endpoint("subscriber", "/x"))
    doubtful = node("/b", endpoint("subscriber", "/x", certain=False), complete=False)
    whole = node("/c", endpoint("publisher", "/x"))
    there = live({"/a": [], "/b": [], "/c": [("publisher", "/x", STRING)]})
    found = compare(Expected(1, (lacking, doubtful, whole)), there)
    assert found.nodes == {"/a": "differs", "/b": "present", "/c": "present"}
    assert summary(found) == "1 difference, 2 nodes as expected"


def test_a_lifecycle_node_that_is_not_active_need_not_have_its_ends() -> None:
    camera = node("/camera", endpoint("publisher", "/image"))
    seen = replace(live({"/camera": []}, 2), nodes={"/camera": LiveNode("/camera", lifecycle="unconfigured")})
    assert told([camera], seen) == [
        "(/camera does not publish /image (std_msgs/String); the lifecycle node is unconfigured)"
    ]
    found = compare(Expected(2, (camera,)), seen)
    assert (found.nodes, found.topics) == ({"/camera": "inactive"}, {"/image": "unsure"})
    active = replace(seen, nodes={"/camera": LiveNode("/camera", lifecycle="active")})
    assert told([camera], active) == ["/camera does not publish /image (std_msgs/String)"]
    assert compare(Expected(2, (camera,)), active).nodes == {"/camera": "differs"}


def test_tools_and_infrastructure_do_not_count() -> None:
    tools = ["/rviz_1700000000000", "/rqt_gui_py_node_123", "/rostopic_4_17000", "/ns/rqt_graph", "/record_1700000"]
    assert told([], live({name: [] for name in tools})) == [
        f"({name} is running but is not in the launch file)" for name in sorted(tools)
    ]
    assert told([], live({"/rosout": []})) == []
    ros2 = ["/_ros2cli_daemon_0_ab", "/launch_ros_123", "/transform_listener_impl_5f3a"]
    assert told([], live({name: [] for name in ros2}, 2)) == []
    assert told([], live({"/other": []})) == ["/other is running but is not in the launch file"]
    assert told([], live({"/other": []}), complete=False) == ["(/other is running but is not in the launch file)"]
    stale = Observation(1, {"/other": LiveNode("/other", dead="connection refused")}, ())
    assert told([], stale) == ["(/other is registered and does not answer: connection refused)"]


def test_what_each_node_has_is_not_extra() -> None:
    own: list[tuple[Role, str, str | None]] = [
        ("publisher", "/rosout", "rosgraph_msgs/Log"),
        ("service", "/a/get_loggers", None),
        ("subscriber", "/clock", "rosgraph_msgs/Clock"),
        ("publisher", "/a/bond", "bond/Status"),
    ]
    assert told([node("/a")], live({"/a": own})) == []
    own = [
        ("publisher", "/parameter_events", "rcl_interfaces/msg/ParameterEvent"),
        ("subscriber", "/parameter_events", "rcl_interfaces/msg/ParameterEvent"),
        ("service", "/a/get_type_description", None),
        ("service", "/a/change_state", None),
        ("publisher", "/a/transition_event", None),
    ]
    assert told([node("/a")], live({"/a": own}, 2)) == []


def test_anonymous_names_are_found_again_in_topics() -> None:
    expected = [
        node("/x_ANON1", endpoint("publisher", "/x_ANON1/out"), endpoint("subscriber", "/in")),
        node("/x_ANON2", endpoint("publisher", "/x_ANON2/out")),
        node("/ns/y_ANON1"),
    ]
    running = {
        "/x_my_host_7_5": [("publisher", "/x_my_host_7_5/out", STRING), ("subscriber", "/in", STRING)],
        "/x_my_host_7_6": [("publisher", "/x_my_host_7_6/out", STRING)],
        "/ns/y_my_host_7_9": [],
    }
    assert told(expected, live(running)) == []  # type: ignore[arg-type]
    found = compare(Expected(1, tuple(expected)), live(running))  # type: ignore[arg-type]
    assert list(found.nodes) == ["/x_ANON1", "/x_ANON2", "/ns/y_ANON1"]
    assert list(found.topics) == ["/x_ANON1/out", "/in", "/x_ANON2/out"]
    del running["/ns/y_my_host_7_9"]
    assert told(expected, live(running)) == ["/ns/y_ANON1 is not running"]  # type: ignore[arg-type]


def test_ends_of_nodelets_are_those_of_their_manager() -> None:
    manager = node("/manager", endpoint("service", "/manager/load_nodelet", "nodelet/NodeletLoad"))
    nodelet = replace(
        node("/filter", endpoint("publisher", "/out"), endpoint("publisher", "/manager/bond", "bond/Status")),
        by="/manager",
    )
    load: tuple[Role, str, str | None] = ("service", "/manager/load_nodelet", "nodelet/NodeletLoad")
    bond: tuple[Role, str, str | None] = ("publisher", "/manager/bond", "bond/Status")
    right = live({"/manager": [load, ("publisher", "/out", STRING)], "/filter": [bond]})
    assert told([manager, nodelet], right) == []
    assert told([manager, nodelet], live({"/manager": [load], "/filter": [bond]})) == [
        "/filter does not publish /out (std_msgs/String)"
    ]
    assert told([manager, nodelet], live({"/filter": [bond]})) == ["/manager is not running"]


def test_actions_of_ros1_are_one_thing() -> None:
    parts = tuple(("publisher" if t in ("goal", "cancel") else "subscriber", t) for t in
                  ("goal", "cancel", "status", "feedback", "result"))  # fmt: skip
    expected = node(
        "/a",
        ExpectedEndpoint("action_client", "/go", "pkg/GoAction", parts=tuple((r, f"/go/{t}") for r, t in parts)),  # type: ignore[misc]
    )
    types = {"cancel": "actionlib_msgs/GoalID", "status": "actionlib_msgs/GoalStatusArray"}
    own = {t: f"pkg/GoAction{t.capitalize()}" for t in ("goal", "feedback", "result")}

    def running(name: str, found: dict[str, str]) -> Observation:
        return live({"/a": [(r, f"{name}/{t}", found[t]) for r, t in parts]})  # type: ignore[misc]

    assert told([expected], running("/go", types | own)) == []
    assert told([expected], running("/goo", types | own)) == [
        "/a does not use the action /go (pkg/GoAction); it uses the action /goo",
        "(/a uses the action /goo (pkg/GoAction), which is unexpected)",
    ]
    other = {t: kind.replace("Go", "Come", 1) for t, kind in own.items()}
    assert told([expected], running("/go", types | other)) == [
        "/a uses the action /go with the type pkg/ComeAction; expected pkg/GoAction"
    ]


def test_types_of_one_definition_are_one() -> None:
    """The master has the type of whom it heard of last: an old broadcaster of transforms, beside new ones."""
    expected = [node("/a", endpoint("publisher", "/tf", "tf2_msgs/TFMessage"))]
    assert told(expected, live({"/a": [("publisher", "/tf", "tf/tfMessage")]})) == []
    assert told(expected, live({"/a": [("publisher", "/tf", "tf/Other")]})) == [
        "/a publishes /tf with the type tf/Other; expected tf2_msgs/TFMessage"
    ]


def test_types_of_ros2_are_those_of_each_end() -> None:
    expected = [
        node("/a", endpoint("publisher", "/x", "std_msgs/msg/String")),
        node("/b", endpoint("subscriber", "/x", "std_msgs/String"), endpoint("client", "/s", None)),
    ]
    right = {
        "/a": [("publisher", "/x", "std_msgs/msg/String")],
        "/b": [("subscriber", "/x", "std_msgs/msg/String"), ("client", "/s", "std_srvs/srv/Empty")],
    }
    assert told(expected, live(right, 2)) == []  # type: ignore[arg-type]
    right["/b"][0] = ("subscriber", "/x", "std_msgs/msg/Int32")
    assert compare(Expected(2, tuple(expected)), live(right, 2)).nodes == {"/a": "present", "/b": "wrong-type"}  # type: ignore[arg-type]
    assert told(expected, live(right, 2)) == [  # type: ignore[arg-type]
        "/b subscribes to /x with the type std_msgs/msg/Int32; expected std_msgs/String"
    ]


def test_qos_and_nodes_of_one_name_are_compared() -> None:
    expected = node("/a", ExpectedEndpoint("publisher", "/x", None, {"reliability": "reliable", "depth": 10}))
    found = Observation(
        2,
        {"/a": LiveNode("/a", count=2)},
        (LiveEndpoint("publisher", "/a", "/x", "std_msgs/msg/String", {"reliability": "best_effort"}),),
    )
    assert told([expected], found) == [
        "/a runs 2 times",
        "/a publishes /x with reliability best_effort; expected reliability reliable",
    ]


def test_a_topic_that_two_ends_want_of_two_types_may_have_either() -> None:
    expected = [node("/a", endpoint("publisher", "/x")), node("/b", endpoint("subscriber", "/x", "std_msgs/Int32"))]
    running = live({"/a": [("publisher", "/x", STRING)], "/b": [("subscriber", "/x", STRING)]})
    assert told(expected, running) == []


def test_a_line_cannot_break_the_terminal() -> None:
    found = compare(Expected(1, ()), live({"/a\x1b[31m\n": []}))
    assert "\x1b" not in line(found.issues[0], None)
    assert "\n" not in line(found.issues[0], None)
