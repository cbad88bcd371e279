"""What the plugins of a node make in it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from preflight_analysis.catalogue import packages
from preflight_analysis.interfaces import catalogued
from support import package_elsewhere

TOPIC, KIND = "{sources}.topic", "{sources}.data_type"
DATA = {
    "source": ["makers/planner", "0123456789abcdef0123456789abcdef01234567", "2024-01-01"],
    "executables": {
        "plan": {
            "publishers": [{"name": "path", "type": "nav_msgs/msg/Path"}],
            "parameters": {
                "~drivers": {"default_value": ["fast"]},
                "~fast.plugin": {"default_value": "planner::Fast", "conditional": True},
                "map/map/layers": {"default_value": ["obstacles"]},
                "map/map/obstacles.plugin": {"default_value": "planner/Obstacles", "conditional": True},
            },
        }
    },
    "plugins": {
        "planner::Fast": {"action_servers": [{"name": "{}", "type": "a_msgs/action/Go"}]},
        "planner::Slow": {"publishers": [{"name": "{}/speed", "type": "std_msgs/msg/Float32"}]},
        "planner::Obstacles": {
            "subscriptions": [
                {
                    "name": "{sources}",
                    "type": "s_msgs/msg/Scan",
                    "named_by": TOPIC,
                    "typed_by": {KIND: {"scan": "s_msgs/msg/Scan", "cloud": "s_msgs/msg/Cloud"}},
                },
                {"type": "std_msgs/msg/Empty", "named_by": "reset"},
            ],
            "parameters": {"sources": {"default_value": ""}, TOPIC: {}, KIND: {"default_value": "Scan"}},
        },
    },
}


@pytest.fixture(autouse=True)
def catalogue(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "catalogue" / "jazzy"
    folder.mkdir(parents=True)
    (folder / "planner.json").write_text(json.dumps(DATA))
    monkeypatch.setattr(packages, "INTERFACES", folder.parent)
    packages.interfaces_of.cache_clear()
    catalogued.catalogued.cache_clear()


def ends(folder: Path, params: str, attributes: str = "") -> set[tuple[str, str, str | None]]:
    """Those of the planner with a parameter file, as the graph has them."""
    node = f'<node pkg="planner" exec="plan" name="plan" {attributes}><param from="$(dirname)/p.yaml"/></node>'
    files = {"p.yaml": params}
    graph = package_elsewhere.analysed(folder, f"<launch>{node}</launch>", "a.launch.xml", "jazzy", **files).graph
    assert graph is not None
    return {(end.role, end.name, end.type) for end in graph.interfaces[0].endpoints}


PATH = ("publisher", "path", "nav_msgs/msg/Path")


def test_those_that_are_loaded_by_default(tmp_path: Path) -> None:
    assert ends(tmp_path, "{}") == {PATH, ("action_server", "fast", "a_msgs/action/Go")}


def test_those_of_a_list_with_their_types(tmp_path: Path) -> None:
    params = "plan: {ros__parameters: {drivers: [crawl], crawl: {plugin: 'planner::Slow'}}}"
    assert ends(tmp_path, params) == {PATH, ("publisher", "crawl/speed", "std_msgs/msg/Float32")}


def test_one_that_no_list_names_is_not_loaded(tmp_path: Path) -> None:
    params = "plan: {ros__parameters: {drivers: [other], crawl: {plugin: 'planner::Slow'}}}"
    assert ends(tmp_path, params) == {PATH}


def test_topics_that_parameters_name_of_a_node_within_the_node(tmp_path: Path) -> None:
    params = """
/**/map/map:
  ros__parameters:
    layers: [things]
    things:
      plugin: planner::Obstacles
      sources: front rear
      front: {topic: /front/scan}
      rear: {data_type: Cloud}
      reset: clear
"""
    fast = ("action_server", "fast", "a_msgs/action/Go")
    for attributes, space in (("", ""), ('namespace="left"', "/left")):
        assert ends(tmp_path / f"of{space}", params, attributes) == {
            PATH,
            fast,
            ("subscriber", "/front/scan", "s_msgs/msg/Scan"),
            ("subscriber", f"{space}/map/rear", "s_msgs/msg/Cloud"),
            ("subscriber", f"{space}/map/clear", "std_msgs/msg/Empty"),
        }


SOURCE = {
    "CMakeLists.txt": """project(nav)
add_library(nav SHARED nav.cpp)
pluginlib_export_plugin_description_file(nav2_core plugins.xml)
""",
    "plugins.xml": """<library path="nav">
  <class type="nav::Turn" base_class_type="nav2_core::Behavior"/>
</library>""",
    "nav.cpp": """#include <rclcpp/rclcpp.hpp>
namespace nav {
class Turn : public nav2_core::Behavior {
  void configure(const rclcpp_lifecycle::LifecycleNode::WeakPtr & parent, const std::string & name) override {
    auto node = parent.lock();
    std::string topic;
    node->declare_parameter(name + ".topic", "turned");
    node->get_parameter(name + ".topic", topic);
    pub_ = node->create_publisher<std_msgs::msg::Empty>(topic, 1);
    server_ = node->create_service<std_srvs::srv::Empty>(name, serve);
  }
};
}
""",
    "package.xml": "<package><name>nav</name><export><build_type>ament_cmake</build_type></export></package>",
}


def test_those_of_the_workspace_are_read_from_their_source(tmp_path: Path) -> None:
    folder = tmp_path / "ws" / "src" / "nav"
    folder.mkdir(parents=True)
    for name, text in SOURCE.items():
        (folder / name).write_text(text)
    params = "plan: {ros__parameters: {drivers: [left], left: {plugin: 'nav::Turn', topic: done}}}"
    assert ends(tmp_path, params) == {
        PATH,
        ("publisher", "done", "std_msgs/msg/Empty"),
        ("service", "left", "std_srvs/srv/Empty"),
    }
