"""What the analysis of a source becomes in the catalogue."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.detect import detect_environment
from tools.catalogue import interfaces
from tools.catalogue.interfaces import facts_of_package

MANIFEST = "<package><name>p</name><export><build_type>ament_cmake</build_type></export></package>"
SOURCE = """#include <rclcpp/rclcpp.hpp>
int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  auto node = std::make_shared<rclcpp::Node>("n");
  std::string name = node->get_name();
  auto active = node->create_service<std_srvs::srv::Trigger>(name + "/is_active", serve);
  auto full = node->create_service<std_srvs::srv::Trigger>("/" + name + "/reset", serve);
  auto within = node->create_publisher<std_msgs::msg::String>("/of/" + name, 1);
  auto chatter = node->create_publisher<std_msgs::msg::String>("chatter", 1);
  node->declare_parameter("rate", 1.0);
  rclcpp::spin(node);
}
"""


def test_a_name_made_of_that_of_the_node_is_private(tmp_path: Path) -> None:
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "CMakeLists.txt").write_text("project(p)\nadd_executable(t t.cpp)\n")
    (tmp_path / "t.cpp").write_text(SOURCE)
    environment = detect_environment(str(tmp_path), {}, root=str(tmp_path / "nothing"))
    facts = facts_of_package(environment, Disk(), environment.packages["p"])["executables"]["t"]
    assert [end["name"] for end in facts["service_servers"]] == ["~/is_active", "~/reset"]
    assert [end["name"] for end in facts["publishers"]] == ["chatter"]
    assert list(facts["parameters"]) == ["~rate"]


ROSCPP = """#include <ros/ros.h>
int main(int argc, char ** argv)
{
  ros::init(argc, argv, "n");
  ros::NodeHandle nh;
  ros::Publisher out = nh.advertise<std_msgs::String>(nh.resolveName("out"), 1);
  ros::Publisher left = nh.advertise<std_msgs::String>(ros::names::resolve("left") + "/image", 1);
  ros::Publisher map = nh.advertise<std_msgs::String>("/map", 1);
  ros::Publisher own = nh.advertise<std_msgs::String>(ros::this_node::getName() + "/state", 1);
  ros::Publisher beside = nh.advertise<std_msgs::String>(ros::this_node::getName() + "_debayer/state", 1);
  ros::spin();
}
"""


def test_a_name_that_the_node_resolves_is_relative(tmp_path: Path) -> None:
    (tmp_path / "package.xml").write_text(MANIFEST.replace("ament_cmake", "catkin"))
    (tmp_path / "CMakeLists.txt").write_text("project(p)\nadd_executable(t t.cpp)\n")
    (tmp_path / "t.cpp").write_text(ROSCPP)
    environment = detect_environment(str(tmp_path), {}, root=str(tmp_path / "nothing"))
    facts = facts_of_package(environment, Disk(), environment.packages["p"])["executables"]["t"]
    assert [end["name"] for end in facts["publishers"]] == ["out", "left/image", "/map", "~/state"]
    assert [end.get("remapped") for end in facts["publishers"]] == [None, "left", None, None]


PLUGINS = {
    "package.xml": MANIFEST,
    "CMakeLists.txt": """project(p)
add_library(l SHARED l.cpp)
pluginlib_export_plugin_description_file(nav2_core plugins.xml)
""",
    "plugins.xml": '<library path="l"><class type="p::Turn" base_class_type="nav2_core::Behavior"/></library>',
    "l.cpp": """#include <rclcpp/rclcpp.hpp>
namespace p {
class Turn : public nav2_core::Behavior {
  void configure(const rclcpp_lifecycle::LifecycleNode::WeakPtr & parent, const std::string & name) override {
    auto node = parent.lock();
    std::string topic, sources, source, type;
    node->declare_parameter(name + ".topic", "turned");
    node->get_parameter(name + ".topic", topic);
    done_ = node->create_publisher<std_msgs::msg::Empty>(topic, 1);
    turn_ = node->create_service<std_srvs::srv::Empty>(name + "/turn", serve);
    own_ = node->create_service<std_srvs::srv::Empty>(std::string(node->get_name()) + "/" + name, serve);
    node->declare_parameter(name + ".sources", "");
    node->get_parameter(name + ".sources", sources);
    std::stringstream all(sources);
    while (all >> source) {
      node->declare_parameter(name + "." + source + ".topic", source);
      node->get_parameter(name + "." + source + ".topic", topic);
      node->declare_parameter(name + "." + source + ".data_type", "LaserScan");
      node->get_parameter(name + "." + source + ".data_type", type);
      if (type == "LaserScan") {
        scan_ = node->create_subscription<sensor_msgs::msg::LaserScan>(topic, 1, take);
      } else {
        cloud_ = node->create_subscription<sensor_msgs::msg::PointCloud2>(topic, 1, take);
      }
    }
  }
};
}
""",
}


def test_what_a_plugin_makes_by_its_name_and_its_parameters(tmp_path: Path) -> None:
    for name, text in PLUGINS.items():
        (tmp_path / name).write_text(text)
    environment = detect_environment(str(tmp_path), {}, root=str(tmp_path / "nothing"))
    facts = facts_of_package(environment, Disk(), environment.packages["p"])["plugins"]["p::Turn"]
    qos = facts["publishers"][0]["qos"]
    assert facts["publishers"] == [
        {"name": "turned", "type": "std_msgs/msg/Empty", "qos": qos, "named_by": "topic"},
    ]
    assert [end["name"] for end in facts["service_servers"]] == ["{}/turn", "~/{}"]
    (source,) = facts["subscriptions"]
    assert (source["name"], source["named_by"]) == ("{sources}", "{sources}.topic")
    assert source["typed_by"] == {
        "{sources}.data_type": {"laserscan": "sensor_msgs/msg/LaserScan", "pointcloud2": "sensor_msgs/msg/PointCloud2"}
    }


def test_what_is_known_of_a_repository_that_is_not_there_stays(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    data, repository = tmp_path / "data", tmp_path / "sources" / "own+scanner" / "repo"
    (data / "jazzy").mkdir(parents=True)
    for name, owner in (("gone", "own/scanner"), ("kept", "other/camera")):
        (data / "jazzy" / f"{name}.json").write_text(f'{{"source": ["{owner}", "0", "2024-01-01"]}}')
    repository.mkdir(parents=True)
    for name, text in (("package.xml", MANIFEST), ("CMakeLists.txt", "add_executable(t t.cpp)"), ("t.cpp", SOURCE)):
        (repository / name).write_text(text)
    git = ("git", "-C", str(repository), "-c", "user.name=n", "-c", "user.email=e@x")
    for words in (("init", "-q", "-b", "main"), ("add", "."), ("commit", "-q", "-m", "all")):
        subprocess.run([*git, *words], check=True)
    monkeypatch.setattr(interfaces, "INTERFACES", data)
    monkeypatch.setattr(interfaces, "GENERATIONS", {"jazzy": 2})
    monkeypatch.setattr(interfaces, "SOURCES", {"own/scanner": {"jazzy": "main"}, "other/camera": {"jazzy": "main"}})
    interfaces.write_interfaces(tmp_path / "sources", ())
    assert sorted(path.name for path in (data / "jazzy").iterdir()) == ["kept.json", "p.json"]
