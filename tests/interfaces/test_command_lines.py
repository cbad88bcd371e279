"""Topics that the nodes of topic_tools and bridges to Gazebo are given."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.tracing.interface import NOT_RUN
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support import package_elsewhere


def topics_of(folder: Path, node: str, name: str = "a.launch") -> tuple[set[str], set[str]]:
    """What the node publishes and subscribes to."""
    launch = folder / "src" / name
    launch.parent.mkdir()
    launch.write_text(f"<launch>{node}</launch>")
    environment = detect_environment(str(folder), {}, root=str(folder / "nowhere"))
    workspace = Workspace(environment, Sources(), str(folder))
    static = workspace.static(str(launch))
    graph = workspace.with_interfaces(static, [NOT_RUN] * len(static.tree.nodes), None).graph
    assert graph is not None
    any_type = {name: channel for name, channel in graph.topics.items() if channel.types == ("*",)}
    return (
        {name for name, channel in any_type.items() if channel.providers},
        {name for name, channel in any_type.items() if channel.consumers},
    )


@pytest.mark.parametrize(
    ("tool", "args", "published", "subscribed"),
    [
        ("relay", "scan /base_scan", {"/base_scan"}, {"/r/scan"}),
        ("relay", "/scan _lazy:=true", {"/scan_relay"}, {"/scan"}),
        ("throttle", "messages scan 5.0", {"/r/scan_throttle"}, {"/r/scan"}),
        ("throttle", "messages scan 5.0 slow", {"/r/slow"}, {"/r/scan"}),
        ("throttle", "bytes scan 1024 1.0 slow", {"/r/slow"}, {"/r/scan"}),
        ("drop", "scan 1 2", {"/r/scan_drop"}, {"/r/scan"}),
        ("mux", "cmd_vel nav teleop", {"/r/cmd_vel"}, {"/r/nav", "/r/teleop"}),
        ("demux", "in a b", {"/r/a", "/r/b"}, {"/r/in"}),
        ("throttle", "", set(), set()),
        ("relay", "", set(), set()),
        ("transform", "/imu/orientation /norm std_msgs/Float64 m", set(), set()),
    ],
)
def test_ros1(tmp_path: Path, tool: str, args: str, published: set[str], subscribed: set[str]) -> None:
    node = f'<node pkg="topic_tools" type="{tool}" name="tool" ns="r" args="{args}"/>'
    assert topics_of(tmp_path, node) == (published, subscribed)


def test_ros2_has_parameters_for_it(tmp_path: Path) -> None:
    params = '<param name="input_topic" value="scan"/><param name="output_topic" value="/out"/>'
    node = f'<node pkg="topic_tools" exec="relay" name="tool">{params}</node>'
    assert topics_of(tmp_path, node, "a.launch.xml") == ({"/out"}, {"/scan"})


def test_a_remap_and_the_users_word_count(tmp_path: Path) -> None:
    node = '<node pkg="topic_tools" type="relay" name="tool" args="scan out"><remap from="scan" to="/laser"/></node>'
    assert topics_of(tmp_path, node) == ({"/out"}, {"/laser"})


@pytest.mark.parametrize(
    ("args", "published", "subscribed"),
    [
        ("raw compressed", "/image/compressed", "/image"),
        ("compressed raw", "/image", "/image/compressed"),
        ("compressed", "/image", "/image/compressed"),
    ],
)
def test_images_that_are_published_in_another_transport(
    tmp_path: Path, args: str, published: str, subscribed: str
) -> None:
    remaps = '<remap from="in" to="/image"/><remap from="out" to="/image"/>'
    node = f'<node pkg="image_transport" type="republish" name="n" ns="r" args="{args}">{remaps}</node>'
    analysis = package_elsewhere.analysed(tmp_path, f"<launch>{node}</launch>", "a.launch", "noetic")
    assert analysis.graph is not None
    assert "TOP004" not in {finding.rule for finding in analysis.findings}
    topics = {name: each for name, each in analysis.graph.topics.items() if name.startswith(("/image", "/r/"))}
    assert {name for name, each in topics.items() if each.providers} == {published}
    assert {name for name, each in topics.items() if each.consumers} == {subscribed}


def test_remaps_that_stand_among_the_arguments(tmp_path: Path) -> None:
    node = '<node pkg="topic_tools" type="relay" name="tool" args="scan out out:=/laser _lazy:=true"/>'
    assert topics_of(tmp_path, node) == ({"/laser"}, {"/scan"})
    node = '<node pkg="image_transport" type="republish" name="n" args="compressed in:=/front raw out:=image"/>'
    graph = package_elsewhere.analysed(tmp_path, f"<launch>{node}</launch>", "b.launch", "noetic").graph
    assert graph is not None
    assert {"/image", "/front/compressed"} <= graph.topics.keys()
    assert graph.topics.keys().isdisjoint({"/in", "/in/compressed", "/out"})


BRIDGES = """
- {ros_topic_name: odom, gz_topic_name: /model/odom, ros_type_name: nav_msgs/msg/Odometry, direction: GZ_TO_ROS}
- {topic_name: /cmd_vel, ros_type_name: geometry_msgs/msg/Twist, direction: ROS_TO_GZ}
- {gz_topic_name: both, ros_type_name: std_msgs/msg/String}
- {ros_topic_name: none, ros_type_name: std_msgs/msg/String, direction: NOWHERE}
- {ros_topic_name: 1, ros_type_name: std_msgs/msg/String}
- {ros_topic_name: untyped}
- 3
"""


def bridged(folder: Path, node: str, config: str = BRIDGES) -> dict[str, str]:
    """The topics of a bridge in the namespace `r`: the type, and `<`, `>` or `<>` for what the bridge is."""
    analysis = package_elsewhere.analysed(
        folder, f"<launch>{node}</launch>", "a.launch.xml", "jazzy", **{"bridge.yaml": config}
    )
    assert analysis.graph is not None
    return {
        name: f"{'<' * len(channel.consumers)}{'>' * len(channel.providers)} {channel.types[0]}"
        for name, channel in analysis.graph.topics.items()
    }


def test_bridges_of_a_command_line(tmp_path: Path) -> None:
    words = "/clock@rosgraph_msgs/msg/Clock[gz.msgs.Clock cmd@geometry_msgs/Twist]ignition.msgs.Twist both@a/msg/B@gz.C"
    words += " /service@ros_gz_interfaces/srv/ControlWorld --ros-args -r both:=two"
    node = f'<node pkg="ros_gz_bridge" exec="parameter_bridge" namespace="r" args="{words}"/>'
    assert bridged(tmp_path, node) == {
        "/clock": "> rosgraph_msgs/msg/Clock",
        "/r/cmd": "< geometry_msgs/msg/Twist",
        "/r/both": "<> a/msg/B",
    }


def test_a_bridge_of_ros1_has_the_types_of_ros1(tmp_path: Path) -> None:
    node = '<node pkg="ros_ign_bridge" type="parameter_bridge" name="b" args="/clock@rosgraph_msgs/Clock[ignition.C"/>'
    analysis = package_elsewhere.analysed(tmp_path, f"<launch>{node}</launch>", distro="noetic")
    assert analysis.graph is not None
    assert analysis.graph.topics["/clock"].types == ("rosgraph_msgs/Clock",)


@pytest.mark.parametrize(
    "given",
    [
        'args="--ros-args -p config_file:=$(dirname)/bridge.yaml"/>',
        '><param name="config_file" value="$(dirname)/bridge.yaml"/></node>',
    ],
)
def test_bridges_of_a_file(tmp_path: Path, given: str) -> None:
    assert bridged(tmp_path, f'<node pkg="ros_gz_bridge" exec="parameter_bridge" namespace="r" {given}') == {
        "/r/odom": "> nav_msgs/msg/Odometry",
        "/cmd_vel": "< geometry_msgs/msg/Twist",
        "/r/both": "<> std_msgs/msg/String",
    }


@pytest.mark.parametrize("config", ["", "3", "{a: 1}", "[", "- [ros_topic_name]", "&a [*a]"])
def test_a_file_that_is_no_list_of_bridges(tmp_path: Path, config: str) -> None:
    node = (
        '<node pkg="ros_gz_bridge" exec="parameter_bridge"><param name="config_file" value="$(dirname)/bridge.yaml"/>'
    )
    assert bridged(tmp_path, f"{node}</node>", config) == {}


def ends_of(folder: Path, node: str, name: str) -> set[tuple[str, str, str | None]]:
    graph = package_elsewhere.analysed(folder, f"<launch>{node}</launch>", name).graph
    assert graph is not None
    return {(end.role, end.name, end.type) for end in graph.interfaces[0].endpoints}


def test_rostopic_publishes_what_it_is_told(tmp_path: Path) -> None:
    node = '<node pkg="rostopic" type="rostopic" name="n" args="{}"/>'
    pub = "pub -r 10 /start std_msgs/Bool true"
    assert ends_of(tmp_path / "1", node.format(pub), "a.launch") == {("publisher", "/start", "std_msgs/Bool")}
    for at, args in enumerate(("echo /start", "pub", "pub /start", "pub /start '{data: 1}'", "")):
        assert not ends_of(tmp_path / f"{at}", node.format(args), "a.launch"), args


def test_bridges_on_ros1(tmp_path: Path) -> None:
    node = '<node pkg="ros_ign_bridge" type="parameter_bridge" name="n" args="/scan@sensor_msgs/LaserScan[ignition.X"/>'
    assert ends_of(tmp_path, node, "a.launch") == {("publisher", "/scan", "sensor_msgs/LaserScan")}


def test_images_of_gazebo(tmp_path: Path) -> None:
    ros1 = '<node pkg="ros_ign_image" type="image_bridge" name="n" args="/front /rear"/>'
    image = "sensor_msgs/Image"
    assert ends_of(tmp_path / "1", ros1, "a.launch") == {("publisher", "/front", image), ("publisher", "/rear", image)}
    ros2 = '<node pkg="ros_gz_image" exec="image_bridge" name="n" args="/front"/>'
    assert ("publisher", "/front", "sensor_msgs/msg/Image") in ends_of(tmp_path / "2", ros2, "a.launch.xml")


MISSPELT = """
<launch>
  <node pkg="ros_gz_bridge" exec="parameter_bridge" name="bridge">
    <param name="config_file" value="$(dirname)/bridge.yaml"/>
  </node>
  <node pkg="arm" exec="driver" name="driver">
    <!-- <topics><topic name="/odom" type="nav_msgs/msg/Odometry" class="sub"/></topics> -->
  </node>
</launch>
"""


def test_a_finding_about_a_bridged_topic_is_at_its_entry(tmp_path: Path) -> None:
    config = "- {topic_name: /odmo, ros_type_name: nav_msgs/msg/Odometry, direction: GZ_TO_ROS}"
    analysis = package_elsewhere.analysed(tmp_path, MISSPELT, "a.launch.xml", "jazzy", **{"bridge.yaml": config})
    found = next(each for each in analysis.findings if each.rule.startswith("TOP") and "/odmo" in each.message)
    text = analysis.documents[found.location.file].text
    assert (found.location.file.rpartition("/")[2], text[slice(*found.location.span)]) == ("bridge.yaml", "topic_name")
    (edit,) = found.fixes[0].edits
    assert (text[slice(*edit.location.span)], edit.text) == ("/odmo", "/odom")
