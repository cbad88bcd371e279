"""What the catalogue says of nodes whose package is not here."""

from __future__ import annotations

import json
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.catalogue import packages, renamed
from preflight_analysis.graph.model import Graph
from preflight_analysis.interfaces import catalogued
from preflight_analysis.tracing.interface import Endpoint, Evidence, Interface, Outcome, ParamUse, Range
from support import package_elsewhere

COMMIT = "0123456789abcdef0123456789abcdef01234567"
SCANNER = {
    "publishers": [{"name": "scan", "type": "sensor_msgs/LaserScan", "qos": {"queue_size": 5}}],
    "service_servers": [{"name": "~reset", "type": "std_srvs/Empty"}],
    "parameters": {
        "~rate": {"type": "double", "default_value": 10.0, "range": [0, 50, 0]},
        "~port": {"mandatory": True},
        "frame": {"access": "has"},
    },
}
DATA = {
    "source": ["makers/scanner", COMMIT, "2024-01-01"],
    "executables": {"scan_node": SCANNER},
    "nodelets": {"scanner/Scan": SCANNER},
    "components": {"scanner::Scan": {"nodes": [["scanner", "", True]], **SCANNER}},
}


@pytest.fixture(autouse=True)
def catalogue(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "catalogue"
    for distro in ("noetic", "jazzy"):
        (folder / distro).mkdir(parents=True)
        (folder / distro / "scanner.json").write_text(json.dumps(DATA))
    monkeypatch.setattr(packages, "INTERFACES", folder)
    packages.interfaces_of.cache_clear()
    catalogued.catalogued.cache_clear()


analysed = partial(package_elsewhere.analysed, distro="noetic")


def graph_of(tmp_path: Path, text: str, name: str = "a.launch", **files: str) -> Graph:
    graph = analysed(tmp_path, text, name, **files).graph
    assert graph is not None
    return graph


def after(run: Interface, tmp_path: Path) -> Interface:
    """What is known of a node of which a run told this."""
    text = '<launch><node pkg="scanner" type="scan_node" name="s"/></launch>'
    graph = package_elsewhere.analysed_after(run, tmp_path, text, "noetic").graph
    assert graph is not None
    return graph.interfaces[0]


def known(graph: Graph) -> list[tuple[Any, ...]]:
    return [(interface.source, len(interface.endpoints), len(interface.params)) for interface in graph.interfaces]


def test_a_node_of_a_package_that_is_not_here(tmp_path: Path) -> None:
    graph = graph_of(tmp_path, '<launch><node pkg="scanner" type="scan_node" name="s"/></launch>')
    (interface,) = graph.interfaces
    evidence = "the catalogue of noetic (makers/scanner at 0123456)"
    assert (interface.source, interface.outcome.status) == ("catalogue", "not-run")
    assert interface.outcome.reason == f"its package is not installed here; known by {evidence}"
    assert {(e.role, e.name, e.evidence.inferred, e.evidence.said_by) for e in interface.endpoints} == {
        ("publisher", "scan", True, evidence),
        ("service", "~reset", True, evidence),
    }
    assert not interface.complete
    assert interface.params[0] == ParamUse(
        "~rate", "get", 10.0, True, type="double", range=Range(0, 50), evidence=Evidence("catalogue", evidence)
    )
    assert [(use.name, use.access, use.mandatory) for use in interface.params[1:]] == [
        ("~port", "get", True),
        ("frame", "has", False),
    ]


_SEEN = (Endpoint("publisher", "/scan", "sensor_msgs/LaserScan"), Endpoint("publisher", "early", "std_msgs/Empty"))


@pytest.mark.parametrize(
    "outcome",
    [
        Outcome("crashed", 1, reason="it ended with exit code 1"),
        Outcome("crashed", signal="SIGSEGV"),
        Outcome("exited", 1),
        Outcome("timed-out"),
        Outcome("crashed", 1, lacks="the device /dev/ttyUSB0"),
    ],
)
def test_a_run_that_ended_early_is_completed(tmp_path: Path, outcome: Outcome) -> None:
    run = Interface("trace", outcome, _SEEN, (ParamUse("~rate", "get"),))
    interface = after(run, tmp_path)
    assert (interface.source, interface.outcome) == ("catalogue", outcome)
    assert [(e.name, e.evidence.inferred, e.evidence.said_by[:13]) for e in interface.endpoints] == [
        ("/scan", False, ""),
        ("early", False, ""),
        ("~reset", True, "the catalogue"),
    ]
    assert [(use.name, use.evidence.inferred) for use in interface.params] == [
        ("~rate", False),
        ("~port", True),
        ("frame", True),
    ]
    assert not interface.likely_complete


@pytest.mark.parametrize("outcome", [Outcome("spinning"), Outcome("exited", 0), Outcome("spinning", answers=("it",))])
def test_a_run_to_the_event_loop_stands(tmp_path: Path, outcome: Outcome) -> None:
    run = Interface("trace", outcome, _SEEN)
    assert after(run, tmp_path).endpoints == _SEEN


def test_controllers_of_spawners_whose_type_is_not_known(tmp_path: Path) -> None:
    (packages.INTERFACES / "jazzy" / "controller_manager.json").write_text(json.dumps(_CONTROLLER_MANAGER))
    graph = graph_of(
        tmp_path,
        """
        <launch>
          <node pkg="controller_manager" exec="ros2_control_node" name="controller_manager"/>
          <node pkg="controller_manager" exec="spawner" name="spawner" args="arm hand"/>
        </launch>
        """,
        "a.launch.xml",
    )
    assert [(node.name, interface.known) for node, interface in zip(graph.tree.nodes, graph.interfaces, strict=True)][
        :3
    ] == [
        ("/controller_manager", True),
        ("/arm", False),
        ("/hand", False),
    ]


_CONTROLLER_MANAGER = {
    "source": ["makers/control", COMMIT, "2024-01-01"],
    "executables": {"ros2_control_node": {"nodes": [["controller_manager", "", True]]}},
}


def test_nodelets_and_components(tmp_path: Path) -> None:
    nodelets = graph_of(
        tmp_path / "1",
        '<launch><node pkg="nodelet" type="nodelet" name="m" args="manager"/>'
        '<node pkg="nodelet" type="nodelet" name="s" args="load scanner/Scan m"/></launch>',
    )
    assert known(nodelets)[1] == ("catalogue", 2, 3)
    components = graph_of(
        tmp_path / "2",
        '<launch><node_container pkg="rclcpp_components" exec="component_container" name="c">'
        '<composable_node pkg="scanner" plugin="scanner::Scan" name="s"/></node_container></launch>',
        "a.launch.xml",
    )
    found = [interface for interface in components.interfaces if interface.source == "catalogue"]
    assert [[made.name for made in interface.nodes] for interface in found] == [["scanner"]]


_LOAD = {"name": "~/load_controller", "type": "controller_manager_msgs/srv/LoadController", "conditional": True}
MANAGER = {
    "source": ["makers/control", COMMIT, "2024-01-01"],
    "executables": {"manager_node": {"nodes": [["manager", "", True]], "service_servers": [_LOAD]}},
    "controllers": {
        "control/Drive": {
            "subscriptions": [{"name": "~/cmd_vel", "type": "geometry_msgs/msg/Twist"}],
            "publishers": [{"name": "odom", "type": "nav_msgs/msg/Odometry"}],
            "parameters": {"~wheel": {"type": "string"}},
        }
    },
}


@pytest.mark.parametrize("name", ["", 'name="manager"'])
def test_controllers_have_nodes_beside_their_manager(tmp_path: Path, name: str) -> None:
    (packages.INTERFACES / "jazzy" / "control.json").write_text(json.dumps(MANAGER))
    graph = graph_of(
        tmp_path,
        f"""
        <launch><node pkg="control" exec="manager_node" namespace="left" {name}>
          <param from="$(dirname)/c.yaml"/><remap from="/left/base/cmd_vel" to="/cmd_vel"/>
        </node></launch>
        """,
        "a.launch.xml",
        **{
            "c.yaml": """
            /**/manager: {ros__parameters: {base: {type: control/Drive}, own: {type: robot/Own}, other: {type: 3}}}
            /**/base: {ros__parameters: {wheel: front}}
            """
        },
    )
    assert [node.name for node in graph.tree.nodes] == ["/left/manager", "/left/base", "/left/own"]
    assert [interface.known for interface in graph.interfaces] == [True, True, False]
    assert {"/cmd_vel", "/left/odom"} <= graph.topics.keys()
    (heard,) = graph.topics["/cmd_vel"].consumers
    assert (heard.node.name, heard.endpoint.uncertain, heard.endpoint.evidence.said_by[:22]) == (
        "/left/base",
        True,
        "the catalogue of jazzy",
    )
    assert {use.name for use in graph.interfaces[1].params} == {"~wheel", "~type", "~fallback_controllers"}
    assert [param.name for param in graph.tree.nodes[1].params] == ["wheel"]


@pytest.mark.parametrize(("nodes", "name"), [([["manager", "", True]], "/manager"), ([], "/manager_node")])
def test_a_manager_without_a_name_has_its_own_beside_controllers(tmp_path: Path, nodes: list[Any], name: str) -> None:
    executable = {"nodes": nodes, "publishers": [{"name": "~/state"}], "service_servers": [_LOAD]}
    data = {**MANAGER, "executables": {"manager_node": executable}}
    (packages.INTERFACES / "jazzy" / "control.json").write_text(json.dumps(data))
    param = '<param name="base.type" value="control/Drive"/>'
    text = f'<launch><node pkg="control" exec="manager_node">{param}</node></launch>'
    graph = graph_of(tmp_path, text, "a.launch.xml")
    assert [node.name for node in graph.tree.nodes] == [name, "/base"]
    assert graph.tree.nodes[0].name_from_code == bool(nodes)
    assert f"{name}/state" in graph.topics


def test_types_among_the_parameters_of_other_nodes_are_of_no_controllers(tmp_path: Path) -> None:
    data = {**MANAGER, "executables": {name: {"publishers": [{"name": "~/state"}]} for name in ("plan", "see")}}
    (packages.INTERFACES / "jazzy" / "control.json").write_text(json.dumps(data))
    params = (
        '<param name="planners.RRT.type" value="geometric::RRT"/><param name="arm.type" value="FollowJointTrajectory"/>'
    )
    text = "".join(f'<node pkg="control" exec="{name}" name="{name}">{params}</node>' for name in ("plan", "see"))
    analysis = analysed(tmp_path, f"<launch>{text}</launch>", "a.launch.xml")
    assert analysis.graph is not None
    assert [node.name for node in analysis.graph.tree.nodes] == ["/plan", "/see"]
    assert "LCH016" not in {finding.rule for finding in analysis.findings}


@pytest.mark.parametrize(("listener", "said"), [("scanner", []), ("hearer", ["TOP003"])])
def test_types_that_differ_within_one_node_are_its_own_affair(tmp_path: Path, listener: str, said: list[str]) -> None:
    other = {"subscriptions": [{"name": "scan", "type": "sensor_msgs/Image"}]}
    scanner = {**SCANNER, **other} if listener == "scanner" else SCANNER
    hearer = {} if listener == "scanner" else other
    nodes = {"scan_node": scanner, "hear_node": hearer}
    (packages.INTERFACES / "noetic" / "scanner.json").write_text(json.dumps({**DATA, "executables": nodes}))
    text = "".join(f'<node pkg="scanner" type="{name}" name="{name}"/>' for name in nodes)
    analysis = analysed(tmp_path, f"<launch>{text}</launch>")
    assert [finding.rule for finding in analysis.findings if finding.rule == "TOP003"] == said


@pytest.mark.parametrize(
    ("distro", "sure"),
    [("noetic", ("error", "likely")), ("melodic", ("info", "possible")), (None, ("info", "possible"))],
)
def test_it_is_likely_of_the_same_distribution(tmp_path: Path, distro: str | None, sure: tuple[str, str]) -> None:
    nodes = {"scan_node": SCANNER, "hear_node": {"subscriptions": [{"name": "scan", "type": "sensor_msgs/Image"}]}}
    (packages.INTERFACES / "noetic" / "scanner.json").write_text(json.dumps({**DATA, "executables": nodes}))
    text = "".join(f'<node pkg="scanner" type="{name}" name="{name}"/>' for name in nodes)
    analysis = analysed(tmp_path, f"<launch>{text}</launch>", distro=distro)
    assert [(f.severity, f.confidence) for f in analysis.findings if f.rule == "TOP003"] == [sure]


def test_what_a_condition_decides_is_possible(tmp_path: Path) -> None:
    other = {"subscriptions": [{"name": "scan", "type": "sensor_msgs/Image", "conditional": True}]}
    nodes = {"scan_node": SCANNER, "hear_node": {**other, "parameters": {"~debug": {"conditional": True}}}}
    (packages.INTERFACES / "noetic" / "scanner.json").write_text(json.dumps({**DATA, "executables": nodes}))
    text = "".join(f'<node pkg="scanner" type="{name}" name="{name}"/>' for name in nodes)
    analysis = analysed(tmp_path, f"<launch>{text}</launch>")
    assert [(f.severity, f.confidence) for f in analysis.findings if f.rule == "TOP003"] == [("info", "possible")]
    assert analysis.graph is not None
    assert [use.evidence.assumed for use in analysis.graph.interfaces[1].params] == [True]


@pytest.mark.parametrize(("offered", "said"), [("set_rate", []), ("~reset", ["SRV001"])])
def test_a_service_that_nobody_offers_to_a_common_node_is_no_news(
    tmp_path: Path, offered: str, said: list[str]
) -> None:
    caller = {"service_clients": [{"name": "scan_node/resett", "type": "std_srvs/Empty"}]}
    server = {"service_servers": [{"name": offered, "type": "std_srvs/Empty"}]}
    nodes = {"scan_node": server, "call_node": caller}
    (packages.INTERFACES / "noetic" / "scanner.json").write_text(json.dumps({**DATA, "executables": nodes}))
    text = "".join(f'<node pkg="scanner" type="{name}" name="{name}"/>' for name in nodes)
    analysis = analysed(tmp_path, f"<launch>{text}</launch>")
    assert [finding.rule for finding in analysis.findings if finding.rule == "SRV001"] == said


def test_what_it_does_not_know_stays_unknown(tmp_path: Path) -> None:
    graph = graph_of(
        tmp_path,
        '<launch><node pkg="scanner" type="other" name="a"/><node pkg="../scanner" type="scan_node" name="b"/>'
        '<node pkg="somebody" type="scan_node" name="c"/></launch>',
    )
    assert known(graph) == [("none", 0, 0)] * 3


@pytest.mark.parametrize(
    ("package", "executable"),
    [("scanner", "scan_node.py"), ("nav2_recoveries", "recoveries_server"), ("rtabmap_ros", "rgbd_odometry")],
)
def test_a_node_that_another_distribution_calls_differently(tmp_path: Path, package: str, executable: str) -> None:
    for name, node in (("nav2_behaviors", "behavior_server"), ("rtabmap_odom", "rgbd_odometry")):
        data = {**DATA, "executables": {node: SCANNER}}
        (packages.INTERFACES / "jazzy" / f"{name}.json").write_text(json.dumps(data))
    text = f'<launch><node pkg="{package}" exec="{executable}" name="s"/></launch>'
    graph = package_elsewhere.analysed(tmp_path, text, "a.launch.xml", distro="jazzy").graph
    assert graph is not None
    assert known(graph) == [("catalogue", 2, 3)]
    assert all("other distribution" in end.evidence.doubts for end in graph.interfaces[0].endpoints)


def test_the_data_has_what_others_are_called_now(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.undo()
    packages.interfaces_of.cache_clear()
    for kind, table in (("executables", renamed._RENAMED), ("components", renamed._COMPONENTS)):
        for package, name in table.values():
            assert name in packages.interfaces_of(package, "jazzy")[kind], (package, name)
    for package, name in renamed._OF_ROS1.values():
        assert name in packages.interfaces_of(package, "noetic")["executables"], (package, name)
    for word, package in renamed._OF_NODELETS.items():
        assert any(name.startswith(f"{word}/") for name in packages.interfaces_of(package, "noetic")["nodelets"])


def test_a_package_of_the_workspace_is_what_it_is_there(tmp_path: Path) -> None:
    graph = graph_of(
        tmp_path,
        '<launch><node pkg="scanner" type="scan_node" name="s"/></launch>',
        **{"../scanner/package.xml": "<package><name>scanner</name></package>"},
    )
    assert known(graph) == [("none", 0, 0)]


def test_an_annotation_is_the_user_s_word_for_all_of_it(tmp_path: Path) -> None:
    graph = graph_of(
        tmp_path,
        '<launch><node pkg="scanner" type="scan_node" name="s"><!-- <topics><topic name="x" type="std_msgs/String" '
        'class="pub"/></topics> --></node></launch>',
    )
    assert [(i.source, [e.name for e in i.endpoints]) for i in graph.interfaces] == [("annotation", ["x"])]


@pytest.mark.parametrize(
    "data",
    [
        "", "[" * 100_000, "[]", "NaN", '"\\ud800"', "\xff", '{"executables": []}', '{"executables": {"scan_node": 1}}',
        '{"source": 1, "executables": {"scan_node": {}}}',
        '{"source": ["a", "b", "c"], "executables": {"scan_node": {"publishers": [{}]}}}',
        '{"source": ["a", "b", "c"], "executables": {"scan_node": {"parameters": {"~a": 1}}}}',
        '{"source": ["a", "b", "c"], "executables": {"scan_node": {"nodes": [["a"]]}}}',
        '{"source": ["a", "b", "c"], "executables": {"scan_node": {"publishers": [{"named_by": 1}]}}}',
    ],
)  # fmt: skip
def test_broken_data_says_nothing(tmp_path: Path, data: str) -> None:
    (packages.INTERFACES / "noetic" / "scanner.json").write_bytes(data.encode("latin-1"))
    graph = graph_of(tmp_path, '<launch><node pkg="scanner" type="scan_node" name="s"/></launch>')
    assert known(graph) == [("none", 0, 0)]


FILTER = {
    "source": ["makers/filter", COMMIT, "2024-01-01"],
    "executables": {
        "filter_node": {
            "subscriptions": [
                {"named_by": "~odom0", "type": "nav_msgs/msg/Odometry"},
                {"named_by": "~input", "type": "sensor_msgs/msg/Imu"},
                {"named_by": "~scan_topic", "name": "scan", "type": "sensor_msgs/msg/LaserScan"},
            ]
        }
    },
}


def test_ends_that_parameters_name(tmp_path: Path) -> None:
    (packages.INTERFACES / "jazzy" / "filter.json").write_text(json.dumps(FILTER))
    given = {"odom0": "/odom", "odom1": "wheels/odom", "odom0_config": "x", "odom": "y", "input0": "z", "odom2": "1 2"}
    params = "".join(f'<param name="{name}" value="{value}"/>' for name, value in given.items())
    graph = graph_of(
        tmp_path,
        f'<launch><node pkg="filter" exec="filter_node" namespace="a">{params}</node></launch>',
        "a.launch.xml",
    )
    ends = {name: [end.endpoint.type for end in channel.consumers] for name, channel in graph.topics.items()}
    assert ends == {
        "/odom": ["nav_msgs/msg/Odometry"],
        "/a/wheels/odom": ["nav_msgs/msg/Odometry"],
        "/a/scan": ["sensor_msgs/msg/LaserScan"],
    }


@pytest.mark.parametrize(
    ("value", "topics"), [("/front/scan", {"/front/scan"}), ("front", {"/a/front"}), ("1 2", set()), ("", set())]
)
def test_a_parameter_that_names_an_end_with_a_default(tmp_path: Path, value: str, topics: set[str]) -> None:
    (packages.INTERFACES / "jazzy" / "filter.json").write_text(json.dumps(FILTER))
    param = f'<param name="scan_topic" value="{value}"/>'
    graph = graph_of(
        tmp_path,
        f'<launch><node pkg="filter" exec="filter_node" namespace="a">{param}</node></launch>',
        "a.launch.xml",
    )
    assert {name for name, channel in graph.topics.items() if channel.consumers} == topics


MUX = {
    "source": ["makers/mux", COMMIT, "2024-01-01"],
    "executables": {
        "mux_node": {
            "publishers": [
                {"name": "out", "typed_by": {"~stamped": {"true": "g/msg/Stamped", "false": "g/msg/Plain"}}}
            ],
            "subscriptions": [
                {"named_by": "~topics.*.topic", "typed_by": {"~stamped": {"true": "g/msg/Stamped"}}},
                {"named_by": "~locks.*.topic", "type": "g/msg/Bool"},
            ],
        }
    },
}
TOPICS = "topics: {joystick: {topic: joy_vel, priority: 3}, tablet: {topic: /tab_vel}}"


@pytest.mark.parametrize(
    ("stamped", "out", "heard"),
    [("", None, None), ("stamped: true", "g/msg/Stamped", "g/msg/Stamped"), ("stamped: false", "g/msg/Plain", None)],
)
def test_ends_of_which_parameters_have_a_list(tmp_path: Path, stamped: str, out: str | None, heard: str | None) -> None:
    (packages.INTERFACES / "jazzy" / "mux.json").write_text(json.dumps(MUX))
    params = f"n: {{ros__parameters: {{{TOPICS}, locks: {{stop: {{topic: stop}}}}, {stamped}}}}}"
    graph = graph_of(
        tmp_path,
        '<launch><node pkg="mux" exec="mux_node" name="n"><param from="$(dirname)/n.yaml"/></node></launch>',
        "a.launch.xml",
        **{"n.yaml": params},
    )
    heard_by = {name: [each.endpoint.type for each in channel.consumers] for name, channel in graph.topics.items()}
    assert heard_by == {"/out": [], "/joy_vel": [heard], "/tab_vel": [heard], "/stop": ["g/msg/Bool"]}
    assert [each.endpoint.type for each in graph.topics["/out"].providers] == [out]


def test_a_name_that_begins_with_what_a_remap_makes_of_another(tmp_path: Path) -> None:
    ends = [{"name": f"image{more}", "type": "x/Y", "remapped": "image"} for more in ("/marked", "_marked")]
    rows = [{"name": "image", "type": "x/Y"}, *ends]
    data = {**DATA, "executables": {"scan_node": {"publishers": rows}}}
    (tmp_path / "catalogue" / "noetic" / "scanner.json").write_text(json.dumps(data))
    node = '<node pkg="scanner" type="scan_node" name="s" ns="a">{}</node>'
    for remap, begin in (('<remap from="image" to="/head/rgb"/>', "/head/rgb"), ("", "/a/image")):
        graph = graph_of(tmp_path, f"<launch>{node.format(remap)}</launch>")
        assert {"/marked", "_marked", ""} == {name.removeprefix(begin) for name in graph.topics}


def test_ends_that_private_parameters_of_ros1_name(tmp_path: Path) -> None:
    (packages.INTERFACES / "noetic" / "filter.json").write_text(json.dumps(FILTER))
    (packages.INTERFACES / "noetic" / "mux.json").write_text(json.dumps(MUX))
    lists = "topics: [{name: joystick, topic: joy_vel}, {name: tablet, topic: /tab_vel}, 3]"
    graph = graph_of(
        tmp_path,
        f"""
        <launch><group ns="a">
          <node pkg="filter" type="filter_node" name="f">
            <param name="odom0" value="wheels"/> <param name="odom1" value="/visual"/>
            <param name="scan_topic" value="s"/>
          </node>
          <node pkg="filter" type="filter_node" name="g"/>
          <node pkg="mux" type="mux_node" name="m"><rosparam>{lists}</rosparam></node>
        </group></launch>
        """,
    )
    ends = {name: [end.node.name for end in channel.consumers] for name, channel in graph.topics.items()}
    assert ends == {
        "/a/wheels": ["/a/f"],
        "/visual": ["/a/f"],
        "/a/s": ["/a/f"],
        "/a/scan": ["/a/g"],
        "/a/joy_vel": ["/a/m"],
        "/tab_vel": ["/a/m"],
        "/a/out": [],
    }


@pytest.mark.parametrize("topics", ["3", "[]", "{}", "[[1]]", "{a: {topic: 1}}", "{a: 2}", "[{}]"])
def test_a_list_of_another_shape_names_nothing(tmp_path: Path, topics: str) -> None:
    (packages.INTERFACES / "noetic" / "mux.json").write_text(json.dumps(MUX))
    node = f'<node pkg="mux" type="mux_node" name="m"><rosparam>topics: {topics}</rosparam></node>'
    assert {*graph_of(tmp_path, f"<launch>{node}</launch>").topics} == {"/out"}


def test_the_real_data_can_be_read(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(packages, "INTERFACES", packages.DATA / "interfaces")
    files = sorted(packages.INTERFACES.rglob("*.json"), key=lambda path: path.stat().st_size)
    assert len(files) > 100
    for path in files:
        for kind in ("executables", "components", "nodelets", "controllers"):
            for name in packages.interfaces_of(path.stem, path.parent.name).get(kind, {}):
                assert catalogued.catalogued(path.stem, kind, name, path.parent.name) is not None


@pytest.mark.parametrize(
    ("package", "executable", "ends"),
    [("amcl", "amcl", {"initialpose", "scan", "static_map"}), ("map_server", "map_server", {"map"})],
)
def test_the_real_data_knows_the_common_nodes(
    monkeypatch: pytest.MonkeyPatch, package: str, executable: str, ends: set[str]
) -> None:
    monkeypatch.setattr(packages, "INTERFACES", packages.DATA / "interfaces")
    found = catalogued.catalogued(package, "executables", executable, "noetic")
    assert found is not None
    assert ends <= {end.name for end in found.endpoints}
