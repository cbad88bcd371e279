"""Nodes that the launch file does not name, under the names that their source gives them."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.tracing.interface import NOT_RUN, Interface, MadeNode, Outcome
from preflight_analysis.workspace.run_results import RunResults, node_keys
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace

PYTHON = """
import sys
import rclpy
from rclpy.node import Node


class Pump(Node):
    def __init__(self, name='pump'):
        super().__init__(name)
        self.declare_parameter('rate', 1.0)


def main():
    rclpy.init()
{body}
"""
CPP = """#include "rclcpp/rclcpp.hpp"
class Pump : public rclcpp::Node {{
public:
  explicit Pump(const std::string & name = "pump") : Node(name) {{ declare_parameter("rate", 1.0); }}
}};
int main(int argc, char ** argv) {{
  rclcpp::init(argc, argv);
{body}
}}
"""
UNNAMED = '<node pkg="p" exec="t"><param from="$(dirname)/p.yaml"/></node>'
NAMED = '<node pkg="p" exec="t" name="other"/>'


def workspace_of(folder: Path, source: str, launch: str = UNNAMED, params: str = "pump") -> tuple[Workspace, str]:
    """The workspace, and its launch file."""
    is_python = source.startswith("\nimport")
    files = {
        "p.yaml": f"{params}:\n  ros__parameters:\n    rate: 2.0\n",
        "main.launch.xml": f"<launch>{launch}</launch>",
    }
    if is_python:
        files["package.xml"] = "<package><name>p</name><export><build_type>ament_python</build_type></export></package>"
        files["setup.py"] = "from setuptools import setup\nsetup(entry_points={'console_scripts': ['t = p.t:main']})\n"
        files |= {"p/__init__.py": "", "p/t.py": source}
    else:
        files["package.xml"] = "<package><name>p</name><export><build_type>ament_cmake</build_type></export></package>"
        files |= {"CMakeLists.txt": "project(p)\nadd_executable(t src/t.cpp)\n", "src/t.cpp": source}
    for name, text in files.items():
        path = folder / "src/p" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    workspace = Workspace(detect_environment(str(folder), {}, root=str(folder / "nothing")), Sources())
    return workspace, str(folder / "src/p/main.launch.xml")


def analysis(folder: Path, source: str, launch: str = UNNAMED, params: str = "pump") -> Analysis:
    workspace, root = workspace_of(folder, source, launch, params)
    static = workspace.static(root)
    return workspace.with_interfaces(static, [NOT_RUN] * len(static.tree.nodes), "not run here")


def told(found: Analysis) -> list[tuple[str, str, str]]:
    rules = ("PRM011", "LCH016", "LCH037")
    return [(f.rule, f.severity, f.confidence) for f in found.findings if f.rule in rules]


def py(*lines: str) -> str:
    return PYTHON.format(body="\n".join(f"    {line}" for line in lines))


def cpp(*lines: str) -> str:
    return CPP.format(body="\n".join(f"  {line}" for line in lines))


ONE = {
    "its class names it": py("rclpy.spin(Pump())"),
    "its main names it": py("node = rclpy.create_node('pump')", "node.declare_parameter('rate', 1.0)"),
    "a class in C++": cpp("rclcpp::spin(std::make_shared<Pump>());"),
    "a node in C++": cpp('auto n = rclcpp::Node::make_shared("pump");', 'n->declare_parameter("rate", 1.0);'),
    "another node in C++": cpp(
        'auto n = std::make_shared<rclcpp::Node>("pump");', 'n->declare_parameter("rate", 1.0);'
    ),
    "on one way": py("if len(sys.argv) > 2 or input():", "    Pump()"),
}
SEVERAL = {
    "two ways": py("rclpy.spin(Pump('a') if input() else Pump('b'))"),
    "two branches": py("if input():", "    Pump('a')", "else:", "    Pump('b')"),
    "a name from outside": py("rclpy.spin(Pump(input()))"),
    "one known and one from outside": py("Pump()", "Pump(input())"),
    "two nodes": py("Pump('a')", "Pump('b')"),
    "one of a library": py(
        "from nav2_simple_commander.robot_navigator import BasicNavigator", "BasicNavigator()", "Pump()"
    ),
    "arguments of its own": py("Pump()", "Node('x', cli_args=sys.argv)"),
    "two branches in C++": cpp(
        'if (std::getenv("A")) { rclcpp::spin(std::make_shared<Pump>("a")); }',
        'else { rclcpp::spin(std::make_shared<Pump>("b")); }',
    ),
    "a name from outside in C++": cpp('rclcpp::spin(std::make_shared<Pump>(std::getenv("A")));'),
}


@pytest.mark.parametrize("case", ONE)
def test_one_name(tmp_path: Path, case: str) -> None:
    found = analysis(tmp_path, ONE[case])
    (node,) = found.tree.nodes
    assert (node.name, node.name_from_code, node.name_inferred) == ("/pump", True, True)
    assert [(p.name, p.value) for p in node.params] == [("rate", 2.0)]
    assert not told(found)
    assert told(analysis(tmp_path, ONE[case], params="pumpe")) == [("PRM011", "info", "possible")] * 2


def test_what_is_run_goes_by_the_name_of_the_launch_file(tmp_path: Path) -> None:
    """Else a run that tells another name asks for a run under that name, which takes its place, and so on for ever."""
    workspace, root = workspace_of(tmp_path, ONE["its class names it"])
    before = workspace.static(root)
    (key,) = node_keys(before.evaluated)
    ran = Interface("trace", Outcome("spinning"), nodes=(MadeNode("/pump", "pump"),))
    workspace.set_results(before.launch, RunResults({key: ran}, pending=True))
    after = workspace.analysed(root)
    assert [node.name for node in after.tree.nodes] == ["/pump"]
    assert node_keys(after.evaluated) == [key] == [("/t", 0)]
    assert workspace.requests(after) == workspace.requests(before)


@pytest.mark.parametrize("case", SEVERAL)
def test_a_name_that_nobody_knows(tmp_path: Path, case: str) -> None:
    found = analysis(tmp_path, SEVERAL[case])
    assert not any(node.name_from_code for node in found.tree.nodes)
    assert not told(found)


def test_two_of_one_name(tmp_path: Path) -> None:
    twice = analysis(tmp_path, ONE["a class in C++"], UNNAMED + '<node pkg="p" exec="t" name="pump"/>')
    assert told(twice) == [("LCH016", "info", "possible")]
    assert not told(analysis(tmp_path, ONE["a class in C++"], UNNAMED + NAMED))


def test_a_name_for_several_nodes(tmp_path: Path) -> None:
    assert told(analysis(tmp_path, SEVERAL["two nodes"], NAMED)) == [("LCH037", "info", "possible")]
    two = cpp('auto a = std::make_shared<Pump>("a");', 'auto b = rclcpp::Node::make_shared("b");')
    assert told(analysis(tmp_path, two, NAMED)) == [("LCH037", "info", "possible")]
    own = py("Pump('a')", "Node('b', use_global_arguments=False)")
    own_cpp = cpp(
        'auto a = std::make_shared<Pump>("a");',
        'auto b = std::make_shared<rclcpp::Node>("b", rclcpp::NodeOptions().use_global_arguments(false));',
    )
    unknown_options = cpp(
        'auto a = std::make_shared<Pump>("a");', 'auto b = std::make_shared<rclcpp::Node>("b", other::options());'
    )
    no_such_constructor = cpp(
        'auto a = std::make_shared<Pump>("a");', 'auto b = std::make_shared<rclcpp::Node>("b", "", "c");'
    )
    sources = (SEVERAL["two branches"], SEVERAL["two branches in C++"], ONE["a node in C++"], own, own_cpp)
    for source in (*sources, unknown_options, no_such_constructor):
        assert not told(analysis(tmp_path, source, NAMED))


@pytest.mark.parametrize(("section", "values"), [("controller_server", [2.0]), ("pump", [])])
def test_the_knowledge_of_a_package_names_one_that_is_not_here(
    tmp_path: Path, section: str, values: list[float]
) -> None:
    launch = '<node pkg="nav2_controller" exec="controller_server"><param from="$(dirname)/p.yaml"/></node>'
    (node,) = analysis(tmp_path, PYTHON.format(body="    pass"), launch, section).tree.nodes
    assert (node.name, node.name_from_code, node.name_inferred) == ("/controller_server", True, True)
    assert [param.value for param in node.params] == values
