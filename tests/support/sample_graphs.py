"""Graphs to draw: a small robot with things wrong with it, one with hostile names, and a large one."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from preflight_analysis.rules.registry import run_rules
from preflight_analysis.view.model import GraphView, ViewChannel, ViewEdge, ViewFinding, ViewNode, graph_view

from support.check import analyse, read_fixture

ROBOT = """
//- /robot.launch
<launch>
  <include file="/base.launch"/>
  <include file="/navigation.launch"/>
  <group ns="camera">
    <node pkg="p" type="camera.py" name="driver"/>
    <node pkg="p" type="detector.py" name="detector">
      <remap from="image" to="image_colour"/>
    </node>
  </group>
  <node pkg="p" type="teleop.py" name="teleop"/>
  <node pkg="p" type="recorder.py" name="recorder"/>
</launch>
//- /base.launch
<launch>
  <node pkg="p" type="base.py" name="base"/>
  <node pkg="p" type="laser.py" name="laser"/>
  <node pkg="p" type="state_publisher.py" name="robot_state_publisher"/>
</launch>
//- /navigation.launch
<launch>
  <node pkg="p" type="slam.py" name="slam"/>
  <node pkg="p" type="planner.py" name="planner">
    <remap from="scan" to="scann"/>
  </node>
</launch>
//- interfaces
{
  "/base": {"publishers": {"/odom": "nav_msgs/Odometry", "/joint_states": "sensor_msgs/JointState",
                           "/battery": "sensor_msgs/BatteryState", "/rosout": "rosgraph_msgs/Log"},
            "subscribers": {"/cmd_vel": "geometry_msgs/Twist"}, "services": {"~reset": "std_srvs/Trigger"},
            "builtin": ["/rosout"], "made": {"/odom": ["/src/base.py", 12], "/cmd_vel": ["/src/base.py", 14]},
            "qos": {"/odom": {"queue_size": 10, "latch": true}}},
  "/laser": {"publishers": {"scan": "sensor_msgs/LaserScan"}},
  "/robot_state_publisher": {"subscribers": {"/joint_states": "sensor_msgs/JointState"},
                             "publishers": {"/tf": "tf2_msgs/TFMessage"}},
  "/slam": {"subscribers": {"/scan": "sensor_msgs/LaserScan", "/odom": "nav_msgs/Odometry",
                            "/tf": "tf2_msgs/TFMessage"},
            "publishers": {"/map": "nav_msgs/OccupancyGrid", "/tf": "tf2_msgs/TFMessage"}},
  "/planner": {"subscribers": {"/map": "nav_msgs/OccupancyGrid", "/odom": "nav_msgs/OccupancyGrid",
                               "scan": "sensor_msgs/LaserScan"},
               "publishers": {"/cmd_vel": "geometry_msgs/Twist", "/plan": "nav_msgs/Path"},
               "action_servers": {"move_base": "move_base_msgs/MoveBaseAction"}},
  "/camera/driver": {"publishers": {"image_raw": "sensor_msgs/Image",
                                    "image_raw/compressed": "sensor_msgs/CompressedImage",
                                    "image_raw/theora": "theora_image_transport/Packet",
                                    "camera_info": "sensor_msgs/CameraInfo",
                                    "parameter_updates": "dynamic_reconfigure/Config"},
                     "services": {"set_camera_info": "sensor_msgs/SetCameraInfo"}},
  "/camera/detector": {"subscribers": {"image": "sensor_msgs/Image"}, "publishers": {"/people": "p/People"}},
  "/teleop": {"publishers": {"/cmd_vel": "geometry_msgs/Twist"}, "clients": {"/base/reset": "std_srvs/Trigger"},
              "action_clients": {"/move_base": "move_base_msgs/MoveBaseAction"}},
  "/recorder": {"status": "not-run", "reason": "the workspace is not trusted"}
}
"""

HOSTILE = (
    "</script><script>alert(1)</script>",
    "\"' onload=alert(1) x='",
    "<img src=x onerror=alert(1)>",
    "]]><!--",
    "--> <svg onload=alert(1)>",
    "line\nbreak\r\ttab\x00\x1b[31m\u2028\u2029",
    '-->|x| %%{init}%% `code` #quot; \\N \\" ; } end',
    "日本語/ノード/名前" * 9,
    "\ud800lone\ufffe\U0001f916",
    "x" * 5000,
    "",
)
"""Names that no ROS tool would take and that a file can hold all the same."""


def view_of(text: str, **options: Any) -> GraphView:
    """The view of a fixture, as `support.check` describes it."""
    context = analyse(read_fixture(text), **options)
    assert context.graph is not None
    return graph_view(context.graph, run_rules(context), context)


def robot() -> GraphView:
    return view_of(ROBOT)


def hostile() -> GraphView:
    """The robot with a hostile text wherever a text can stand."""
    view = robot()
    texts = iter(HOSTILE * 24)
    nodes = tuple(
        replace(n, name=next(texts), package=next(texts), executable=next(texts), file=next(texts), reason=next(texts))
        for n in view.nodes
    )
    return replace(
        view,
        root=HOSTILE[0],
        nodes=nodes,
        files=tuple(dict.fromkeys(node.file for node in nodes)),
        channels=tuple(replace(c, name=next(texts), types=(next(texts),), notes=(next(texts),)) for c in view.channels),
        edges=tuple(
            replace(e, type=next(texts), remapped_from=next(texts), qos={next(texts): next(texts)}) for e in view.edges
        ),
        findings=tuple(replace(f, message=next(texts)) for f in view.findings),
    )


def large(nodes: int, topics: int) -> GraphView:
    """Subsystems of ten nodes each, mostly pipelines, with hubs between them and many topics that nobody takes."""
    ends: list[tuple[int, int, bool]] = []
    for topic in range(topics):
        node = topic * 7919 % nodes
        group, step = node // 10 * 10, topic * 31 % 100
        takers: list[int] = []
        if step >= 45:
            takers = [(group + (node + 1 + topic % 3) % 10) % nodes]
        if step >= 80:
            takers += [(group + (node + 4) % 10) % nodes, (group + (node + 5) % 10) % nodes]
        if step >= 93:
            takers.append(topic * 104729 % nodes)
        if step == 99:
            takers += range(0, nodes, 12)
        ends.append((node, topic, True))
        ends += [(taker, topic, False) for taker in dict.fromkeys(takers)]
    place = robot().nodes[0].places
    return GraphView(
        "/large.launch",
        1,
        tuple(
            ViewNode(
                f"/subsystem_{i // 10}/node_{i}", "p", f"node_{i}.py", "node", f"/launch/part_{i // 30}.launch", place,
                "trace", "spinning", None, (),
            )
            for i in range(nodes)
        ),
        tuple(
            ViewChannel("topic", f"/subsystem_{i * 7919 % nodes // 10}/topic_{i}", ("p/T",), False, False, ())
            for i in range(topics)
        ),
        tuple(
            ViewEdge(
                node, topic, "publisher" if out else "subscriber", "p/T", {}, None, place, False, False,
                (0,) if not out and topic % 97 == 0 else (),
            )
            for node, topic, out in ends
        ),
        (ViewFinding("TOP003", "error", "types differ", place[0]),),
        tuple(f"/launch/part_{i}.launch" for i in range(nodes // 30 + 1)),
    )  # fmt: skip
