"""What the analysis of a source becomes in the catalogue."""

from __future__ import annotations

from pathlib import Path

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.detect import detect_environment
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
