"""PKG006: a component that its package does not register (ROS 2)."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.package_elsewhere import analysed
from support.packaging import CMAKE, LISTS, said
from support.unbuilt_packages import manifest

MANIFEST = "<package><name>p</name><export><build_type>ament_cmake</build_type></export></package>"
LAUNCH = """<launch>
  <node_container pkg="rclcpp_components" exec="component_container" name="c" namespace="">
    <composable_node pkg="{package}" plugin="{plugin}" name="driver"/>
  </node_container>
</launch>
"""
REGISTERED = """project(p)
add_library(nodes SHARED src/t.cpp)
rclcpp_components_register_nodes(nodes "p::Driver" "p::Camera")
"""


def found(folder: Path, plugin: str, cmake: str, package: str = "p") -> list[Finding]:
    launch = folder / "src/p/main.launch.xml"
    launch.parent.mkdir(parents=True, exist_ok=True)
    (launch.parent / "package.xml").write_text(MANIFEST)
    (launch.parent / "CMakeLists.txt").write_text(cmake)
    launch.write_text(LAUNCH.format(package=package, plugin=plugin))
    environment = detect_environment(str(folder), {}, root=str(folder / "nothing"))
    analysis = Workspace(environment, Sources()).static(str(launch))
    return [finding for finding in analysis.findings if finding.rule == "PKG006"]


def test_a_component_that_is_not_registered(tmp_path: Path) -> None:
    assert found(tmp_path, "p::Driver", REGISTERED) == []
    (finding,) = found(tmp_path, "p::Drivr", REGISTERED)
    assert finding.severity == "error"
    assert finding.message == "component 'p::Drivr' is not registered by package 'p'; did you mean 'p::Driver'?"
    assert [edit.text for fix in finding.fixes for edit in fix.edits] == ["p::Driver"]
    (without_namespace,) = found(tmp_path, "Camera", REGISTERED)
    assert without_namespace.message.endswith("did you mean 'p::Camera'?")


@pytest.mark.silent
def test_nothing_is_said_where_components_are_not_known(tmp_path: Path) -> None:
    assert found(tmp_path, "p::Drivr", "project(p)\n") == []
    assert found(tmp_path, "p::Lidar", REGISTERED + 'our_macro(nodes "p::Lidar")\n') == []


FORMS = """project(p)
add_library(nodes SHARED src/t.cpp)
function(register_one name)
  rclcpp_components_register_node(${ARGV1} PLUGIN "p::${name}" EXECUTABLE ${name}_node EXECUTOR MultiThreadedExecutor)
endfunction()
register_one(Driver nodes)
foreach(name Camera Lidar)
  list(APPEND registered "p::${name}")
endforeach()
rclcpp_components_register_nodes(nodes ${registered} RESOURCE_INDEX rclcpp_components)
"""


def test_components_that_are_registered_by_functions_and_lists(tmp_path: Path) -> None:
    for plugin in ("p::Driver", "p::Camera", "p::Lidar"):
        assert found(tmp_path, plugin, FORMS) == []
    (finding,) = found(tmp_path, "p::Segmentation", FORMS)
    assert finding.message.endswith("; it registers 'p::Camera', 'p::Driver', 'p::Lidar'")
    (finding,) = found(tmp_path, "p::Segmentation", FORMS + 'rclcpp_components_register_nodes(nodes "p::Radar")')
    assert finding.message.endswith("; it registers 'p::Camera', 'p::Driver', 'p::Lidar' and 1 more")


def test_components_of_an_installed_package(tmp_path: Path) -> None:
    for name, text in {"packages/q": "", "rclcpp_components/q": "q::Talker;lib/libtalker.so\n"}.items():
        path = tmp_path / "install/share/ament_index/resource_index" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    (finding,) = found(tmp_path, "q::Taker", REGISTERED, "q")
    assert "did you mean 'q::Talker'?" in finding.message
    assert found(tmp_path, "q::Talker", REGISTERED, "q") == []


COMPONENTS = """cmake_minimum_required(VERSION 3.8)
project(vision)
add_library(detector SHARED src/detector.cpp)
rclcpp_components_register_nodes(detector "vision::Detector" "vision::Tracker")
ament_package()
"""
LOADS = """<launch>
  <node_container pkg="vision" exec="component_container" name="box" namespace="">
    <composable_node pkg="vision" plugin="vision::Detector" name="a"/>
    <composable_node pkg="vision" plugin="Tracker" name="b"/>
    <composable_node pkg="vision" plugin="vision::Segmentation" name="c"/>
  </node_container>
</launch>
"""


def test_components_of_a_package_that_is_not_built(tmp_path: Path) -> None:
    folder = tmp_path / "src" / "vision"
    (folder / "launch").mkdir(parents=True)
    (folder / "package.xml").write_text(manifest("vision", "ament_cmake"))
    (folder / "CMakeLists.txt").write_text(COMPONENTS)
    launch = folder / "launch" / "box.launch.xml"
    launch.write_text(LOADS)
    workspace = Workspace(detect_environment(str(tmp_path), {}), Sources(), str(tmp_path))
    findings = [f for f in workspace.static(str(launch), {}).findings if f.rule == "PKG006"]
    assert [(f.severity, f.message) for f in findings] == [
        (
            "error",
            "component 'Tracker' is not registered by package 'vision'; did you mean 'vision::Tracker'?",
        ),
        (
            "warning",
            "component 'vision::Segmentation' is not registered by package 'vision'; it registers 'vision::Detector', "
            "'vision::Tracker'",
        ),
    ]


def test_a_slip_of_a_component_of_the_catalogue(tmp_path: Path) -> None:
    text = LAUNCH.format(package="image_proc", plugin="image_proc::RectifyNod")
    (finding,) = (f for f in analysed(tmp_path, text, "a.launch.xml", "jazzy").findings if f.rule == "PKG006")
    assert (finding.severity, finding.confidence) == ("warning", "likely")
    assert finding.message.endswith(
        "has no component 'image_proc::RectifyNod'; did you mean 'image_proc::RectifyNode'?"
    )


@pytest.mark.silent
def test_a_component_that_another_version_may_have(tmp_path: Path) -> None:
    for plugin in ("image_proc::RectifyNode", "image_proc::UndistortNode"):
        text = LAUNCH.format(package="image_proc", plugin=plugin)
        assert not [f for f in analysed(tmp_path, text, "a.launch.xml", "jazzy").findings if f.rule == "PKG006"]


REGISTERS = LISTS.replace(
    "install(T",
    'add_library(vision SHARED src/vision.cpp)\nrclcpp_components_register_nodes(vision "arm::Detector")\ninstall(T',
)
CLASS = "namespace arm { class Detector : public rclcpp::Node {}; }\n"
MACRO = "RCLCPP_COMPONENTS_REGISTER_NODE({})\n"


@pytest.mark.parametrize(
    ("source", "hint"),
    [
        (CLASS, ""),
        (f"{CLASS}// {MACRO.format('arm::Detector')}", ""),
        (CLASS + MACRO.format("arm::Detektor"), "; did you mean 'arm::Detektor'?"),
    ],
)
def test_a_source_without_the_macro(tmp_path: Path, source: str, hint: str) -> None:
    assert said(tmp_path, {**CMAKE, "CMakeLists.txt": REGISTERS, "src/vision.cpp": source}, "PKG006") == [
        "CMakeLists.txt:6 error no RCLCPP_COMPONENTS_REGISTER_NODE(arm::Detector) in the sources of 'vision' "
        f"(src/vision.cpp): no container can load it{hint}"
    ]


@pytest.mark.silent
@pytest.mark.parametrize(
    "files",
    [
        {"src/vision.cpp": CLASS + MACRO.format("arm::Detector")},
        {"src/vision.cpp": f"{CLASS}namespace arm {{ {MACRO.format('Detector')} }}"},
        {"src/vision.cpp": CLASS, "include/arm/vision.hpp": MACRO.format("arm::Detector")},
        {"src/vision.cpp": f"{CLASS}CLASS_LOADER_REGISTER_CLASS(arm::Detector, rclcpp_components::NodeFactory)"},
        {"src/vision.cpp": "int unrelated;"},
        {},
    ],
)
def test_a_source_that_registers_or_is_not_known(tmp_path: Path, files: dict[str, str]) -> None:
    assert said(tmp_path, {**CMAKE, "CMakeLists.txt": REGISTERS, **files}, "PKG006") == []
