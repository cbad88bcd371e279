"""The frames that nodes broadcast and ask for, read from their source."""

from __future__ import annotations

import textwrap
from dataclasses import replace
from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.tracing.interface import NOT_RUN, Endpoint, Frame, Interface, Outcome
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

_MANIFEST = "<package{}><name>p</name><export><build_type>{}</build_type></export></package>"
_NODE = '<node pkg="p" {}="t" name="n">{}</node>'
_ROS1 = {
    "package.xml": "<package><name>p</name></package>",
    "CMakeLists.txt": "project(p)\nadd_executable(t src/t.cpp)\n",
}
_ROS2 = {"package.xml": _MANIFEST.format("", "ament_cmake"), "CMakeLists.txt": _ROS1["CMakeLists.txt"]}
_RCLPY = {
    "package.xml": _MANIFEST.format("", "ament_python"),
    "setup.py": "setup(name='p', entry_points={'console_scripts': ['t = p.t:main']})\n",
    "setup.cfg": "",
    "p/__init__.py": "",
}
Frames = tuple[list[tuple[str, str, bool]], list[tuple[str, str]]]


def _read(folder: Path, files: dict[str, str], launch: str, inner: str, run: Interface = NOT_RUN) -> Interface:
    for name, text in files.items():
        path = folder / "src/p" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(textwrap.dedent(text))
        path.chmod(0o755)
    attribute = "type" if launch == "main.launch" else "exec"
    (folder / "src/p" / launch).write_text(f"<launch>{_NODE.format(attribute, inner)}</launch>")
    variables = {"ROS_VERSION": "1"} if attribute == "type" else {}
    workspace = Workspace(detect_environment(str(folder), variables, root=str(folder / "nothing")), Sources())
    analysis = workspace.static(str(folder / "src/p" / launch))
    done = workspace.with_interfaces(analysis, [run] * len(analysis.tree.nodes), "not run here")
    assert done.graph is not None
    return done.graph.interfaces[-1]


def _frames(found: Interface) -> Frames:
    return (
        [(frame.parent, frame.child, frame.static) for frame in found.frames],
        [(use.frame, use.call) for use in found.frame_uses],
    )


def _rclcpp(folder: Path, text: str, inner: str = "") -> Interface:
    return _read(folder, {**_ROS2, "src/t.cpp": text}, "main.launch.xml", inner)


def _roscpp(folder: Path, body: str, inner: str = "") -> Interface:
    start = '#include <ros/ros.h>\nint main(int c, char** v) {\nros::init(c, v, "t");\nros::NodeHandle nh("~");\n'
    text = f"{start}{body}\n}}\n"
    return _read(folder, {**_ROS1, "src/t.cpp": text}, "main.launch", inner)


_ODOMETRY = """
#include "rclcpp/rclcpp.hpp"
#include "tf2_ros/transform_broadcaster.h"
using geometry_msgs::msg::TransformStamped;

class Base : public rclcpp::Node {
public:
  Base() : Node("base") {
    declare_parameter("base_frame", "base_link");
    base_ = get_parameter("base_frame").as_string();
    declare_parameter<std::string>("odom_frame", "odom");
    get_parameter("odom_frame", odom_);
    publish_tf_ = declare_parameter<bool>("publish_tf", true);
    broadcaster_ = std::make_unique<tf2_ros::TransformBroadcaster>(*this);
    static_ = std::make_shared<tf2_ros::StaticTransformBroadcaster>(this);
    scan_ = create_publisher<sensor_msgs::msg::LaserScan>("scan", 10);
    timer_ = create_wall_timer(10ms, std::bind(&Base::update, this));
    sub_ = create_subscription<nav_msgs::msg::Odometry>("in", 10, std::bind(&Base::heard, this, std::placeholders::_1));

    std::vector<TransformStamped> all;
    TransformStamped one;
    one.header.frame_id = base_;
    one.child_frame_id = "laser";
    all.push_back(one);
    one.child_frame_id = "imu";
    all.push_back(one);
    static_->sendTransform(all);
  }

private:
  void update() {
    geometry_msgs::msg::TransformStamped t;
    t.header.stamp = now();
    t.header.frame_id = odom_;
    t.child_frame_id = base_;
    if (publish_tf_) {
      broadcaster_->sendTransform(t);
    }
    auto scan = std::make_unique<sensor_msgs::msg::LaserScan>();
    scan->header.frame_id = "laser";
    scan_->publish(std::move(scan));
    try {
      auto found = buffer_->lookupTransform("map", base_, tf2::TimePointZero);
    } catch (const tf2::TransformException & e) {
    }
  }
  void heard(const nav_msgs::msg::Odometry::SharedPtr msg) {
    TransformStamped t;
    t.header = msg->header;
    t.child_frame_id = "footprint";
    broadcaster_->sendTransform(t);
  }
  std::string odom_, base_;
  bool publish_tf_;
  std::unique_ptr<tf2_ros::TransformBroadcaster> broadcaster_;
  std::shared_ptr<tf2_ros::StaticTransformBroadcaster> static_;
  std::unique_ptr<tf2_ros::Buffer> buffer_;
  rclcpp::Publisher<sensor_msgs::msg::LaserScan>::SharedPtr scan_;
};

int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Base>());
}
"""


def test_rclcpp(tmp_path: Path) -> None:
    found = _rclcpp(tmp_path, _ODOMETRY, '<param name="base_frame" value="base"/>')
    assert _frames(found) == (
        [("base", "laser", True), ("base", "imu", True), ("odom", "base", False), ("", "footprint", False)],
        [("laser", "sensor_msgs/LaserScan"), ("map", "Buffer::lookupTransform"), ("base", "Buffer::lookupTransform")],
    )
    assert not any(frame.evidence.conditional for frame in found.frames)
    assert {(Path(frame.source_file).name, frame.evidence.inferred) for frame in found.frames} == {("t.cpp", True)}


def test_a_parameter_that_turns_it_off(tmp_path: Path) -> None:
    found = _rclcpp(tmp_path, _ODOMETRY, '<param name="publish_tf" value="false"/>')
    assert ("odom", "base_link", False) not in _frames(found)[0]
    assert ("", "", False) in _frames(found)[0]


def test_a_condition_that_is_not_known(tmp_path: Path) -> None:
    found = _rclcpp(tmp_path, _ODOMETRY.replace("if (publish_tf_)", "if (moving())"))
    assert [(frame.child, frame.evidence.conditional) for frame in found.frames][2:3] == [("base_link", True)]


_FLAG = """
#include <ros/ros.h>
#include <tf/transform_broadcaster.h>
bool ready = false;
std::deque<nav_msgs::Odometry> buffer;
void heard(const nav_msgs::Odometry& odom) {{ ready = true; buffer.push_back(odom); }}
bool waiting() {{ return buffer.empty(); }}
int main(int argc, char** argv) {{
  ros::init(argc, argv, "n");
  ros::NodeHandle nh("~");
  ros::Subscriber sub = nh.subscribe("odom", 1, heard);
  bool publish_tf = true;
  nh.getParam("publish_tf", publish_tf);
  tf::TransformBroadcaster br;
  while (ros::ok()) {{
    {}
    br.sendTransform(tf::StampedTransform(t, ros::Time::now(), "odom", "base_link"));
  }}
}}
"""


@pytest.mark.parametrize(
    "condition",
    [
        "if (ready)",
        "if (publish_tf && ready)",
        "if (!ready) { ros::spinOnce(); continue; }",
        "if (waiting()) continue;",
    ],
)
def test_a_flag_that_a_callback_sets(tmp_path: Path, condition: str) -> None:
    files = {**_ROS1, "src/t.cpp": _FLAG.format(condition)}
    found = _read(tmp_path, files, "main.launch", "")
    assert [(frame.parent, frame.child, frame.evidence.conditional) for frame in found.frames] == [
        ("odom", "base_link", True)
    ]
    off = _read(tmp_path, files, "main.launch", '<param name="publish_tf" value="false"/>')
    assert bool(off.frames) is ("publish_tf" not in condition)


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        (
            'tf::TransformBroadcaster br;\n'
            'br.sendTransform(tf::StampedTransform(t, ros::Time::now(), "world", "turtle"));',
            ([("world", "turtle", False)], []),
        ),
        (
            'tf::TransformBroadcaster br;\nstd::string base;\nnh.param<std::string>("base", base, "base_link");\n'
            'geometry_msgs::TransformStamped odom;\nodom.header.frame_id = "/odom";\nodom.child_frame_id = base;\n'
            "br.sendTransform(odom);",
            ([("/odom", "base_footprint", False)], []),
        ),
        (
            'tf::TransformListener listener;\nlistener.waitForTransform("a", "b", ros::Time(0), ros::Duration(3));\n'
            'listener.lookupTransform("a", "b", ros::Time(0), t);',
            ([], [(frame, f"{call}Transform") for call in ("waitFor", "lookup") for frame in "ab"]),
        ),
        (
            'tf2_ros::Buffer buffer;\ntf2_ros::TransformListener listener(buffer);\n'
            'buffer.canTransform("a", frame(), t);',
            ([], [("a", "Buffer::canTransform")]),
        ),
        (
            'tf::TransformListener listener;\nmessage_filters::Subscriber<sensor_msgs::LaserScan> sub(nh, "scan", 5);\n'
            'tf::MessageFilter<sensor_msgs::LaserScan> filter(sub, listener, "odom", 5);\n'
            'filter.setTargetFrame("map");',
            ([], [("odom", "MessageFilter"), ("map", "setTargetFrame")]),
        ),
        # What another object does by the same name.
        ('Camera camera;\ncamera.transform("a");\nstd::transform(x, y, "b");', ([], [])),
    ],
)  # fmt: skip
def test_roscpp(tmp_path: Path, body: str, expected: Frames) -> None:
    assert _frames(_roscpp(tmp_path, body, '<param name="base" value="base_footprint"/>')) == expected


_PYTHON = """
import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from sensor_msgs.msg import Imu
from std_msgs.msg import Header
from tf2_ros import TransformBroadcaster, StaticTransformBroadcaster
from tf2_ros.buffer import Buffer
from tf2_ros.transform_listener import TransformListener


class Base(Node):
    def __init__(self):
        super().__init__('base')
        self.odom = self.declare_parameter('odom_frame', 'odom').get_parameter_value().string_value
        self.declare_parameter('base_frame', 'base_link')
        self.br = TransformBroadcaster(self)
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.pub = self.create_publisher(Imu, 'imu', 10)
        self.create_timer(0.1, self.update)
        fixed = TransformStamped(header=Header(frame_id='map'), child_frame_id='dock')
        StaticTransformBroadcaster(self).sendTransform([fixed])

    def update(self):
        t = TransformStamped()
        t.header.stamp = self.get_clock().now().to_msg()
        t.header.frame_id = self.odom
        t.child_frame_id = self.get_parameter('base_frame').value
        self.br.sendTransform(t)
        try:
            self.buffer.lookup_transform('map', t.child_frame_id, rclpy.time.Time())
        except Exception as e:
            return
        imu = Imu()
        imu.header.frame_id = 'imu_link'
        self.pub.publish(imu)


def main():
    rclpy.init()
    rclpy.spin(Base())
"""


def test_rclpy(tmp_path: Path) -> None:
    found = _read(tmp_path, {**_RCLPY, "p/t.py": _PYTHON}, "main.launch.xml", '<param name="base_frame" value="base"/>')
    assert _frames(found) == (
        [("map", "dock", True), ("odom", "base", False)],
        [("map", "lookup_transform"), ("base", "lookup_transform"), ("imu_link", "sensor_msgs/Imu")],
    )
    assert found.whole


def test_what_is_not_come_to(tmp_path: Path) -> None:
    text = _PYTHON.replace("self.br.sendTransform(t)", "if self.ready: self.br.sendTransform(t)")
    text = text.replace("self.buffer = Buffer()", "self.buffer = Buffer()\n        self.ready = False")
    found = _read(tmp_path, {**_RCLPY, "p/t.py": text}, "main.launch.xml", "")
    assert _frames(found)[0] == [("map", "dock", True), ("", "", False)]


def test_a_run_that_does_not_tell_which_frames(tmp_path: Path) -> None:
    tf = Endpoint("publisher", "/tf", "tf2_msgs/msg/TFMessage", source_file="/p/t.cpp", source_line=1)
    run = Interface("trace", Outcome("spinning"), (tf,))
    files = {**_ROS2, "src/t.cpp": _ODOMETRY}
    found = _read(tmp_path, files, "main.launch.xml", "", run)
    assert (found.source, found.endpoints) == ("trace", (tf,))
    assert ("odom", "base_link", False) in _frames(found)[0]
    seen = replace(run, frames=(Frame("map", "odom"),))
    assert _frames(_read(tmp_path, files, "main.launch.xml", "", seen)) == ([("map", "odom", False)], [])


def test_rospy(tmp_path: Path) -> None:
    text = """\
        #!/usr/bin/env python3
        import rospy, tf, tf2_ros
        rospy.init_node('t')
        base = rospy.get_param('~base', 'base_link')
        br = tf.TransformBroadcaster()
        br.sendTransform((0, 0, 0), (0, 0, 0, 1), rospy.Time.now(), base, 'odom')
        br.sendTransform((0, 0, 0), (0, 0, 0, 1), rospy.Time.now(), child='laser', parent=base)
        listener = tf.TransformListener()
        listener.lookupTransform('/map', base, rospy.Time(0))
        """
    found = _read(tmp_path, {"package.xml": _ROS1["package.xml"], "t": text}, "main.launch", "")
    assert _frames(found) == (
        [("odom", "base_link", False), ("base_link", "laser", False)],
        [("/map", "lookupTransform"), ("base_link", "lookupTransform")],
    )
