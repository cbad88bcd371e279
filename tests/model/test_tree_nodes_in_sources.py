"""The behaviour tree nodes that sources of a workspace register."""

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.model import tree_nodes_in_sources
from preflight_analysis.model.tree_nodes_in_sources import OwnNodes, OwnPort, own_nodes
from preflight_analysis.workspace.sources import Sources

_SOURCE = """#include <behaviortree_cpp/bt_factory.h>
class {name} : public BT::SyncActionNode {{
  static BT::PortsList providedPorts() {{
    return {{BT::InputPort<double>("width"), BT::OutputPort<unsigned   int>("count"), BT::BidirectionalPort("any")}};
  }}
}};
BT_REGISTER_NODES(factory) {{ factory.registerNodeType<{name}>("{name}"); }}
"""


def _nodes(folder: Path, **packages: str) -> OwnNodes:
    """Those of packages that each register a node of their name, and have a dependency."""
    for name, dependency in packages.items():
        package = folder / "src" / name
        package.mkdir(parents=True)
        (package / "package.xml").write_text(f"<package><name>{name}</name><depend>{dependency}</depend></package>")
        (package / "nodes.cpp").write_text(_SOURCE.format(name=name))
    environment = detect_environment(str(folder), {"ROS_VERSION": "2"}, root=str(folder / "nowhere"))
    return own_nodes(Sources().db, environment)


def test_names_and_ports(tmp_path: Path) -> None:
    nodes = _nodes(tmp_path, OpenDoor="rclcpp").nodes
    assert nodes["OpenDoor"].ports == {
        "width": OwnPort("double", is_output=False),
        "count": OwnPort("unsigned int", is_output=True),
        "any": OwnPort("", is_output=False),
    }


def test_of_many_packages_those_that_depend_on_behavior_trees(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tree_nodes_in_sources, "_MOST_PACKAGES", 2)
    found = _nodes(tmp_path, OpenDoor="behaviortree_cpp", Knock="nav2_behavior_tree", Wave="rclcpp")
    assert sorted(found.nodes) == ["Knock", "OpenDoor"]
    assert not found.has("Wave")
