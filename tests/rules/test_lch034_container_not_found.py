"""LCH034: components for a container that the launch does not start (ROS 2)."""

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import apply, check


def test_a_container_that_is_not_there() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <group>
            <push_ros_namespace namespace="robot"/>
            <node_container pkg="rclcpp_components" exec="component_container" name="vision" namespace=""/>
            <load_composable_node target="vision">
                                          ^^^^^^ warning[LCH034] container '/vision' is not started by this launch; it
              <composable_node pkg="p" plugin="p::Detector" name="detector"/>
            </load_composable_node>
            <load_composable_node target="/robot/vision">
              <composable_node pkg="p" plugin="p::Tracker" name="tracker"/>
            </load_composable_node>
          </group>
          <load_composable_node target="/elsewhere">
                                        ^^^^^^^^^^ hint[LCH034] container '/elsewhere' is not started by this launch;
            <composable_node pkg="p" plugin="p::Mapper" name="mapper"/>
          </load_composable_node>
        </launch>
        //- /rclcpp_components/package.xml
        <package><name>rclcpp_components</name></package>
    """)


def test_the_only_container_is_meant_where_it_stays_empty() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node_container pkg="p" exec="component_container" name="camera_container" namespace=""/>
          <load_composable_node target="cam_container">
                                        ^^^^^^^^^^^^^ warning[LCH034] did you mean '/camera_container'?
            <composable_node pkg="p" plugin="p::Mapper" name="mapper"/>
          </load_composable_node>
        </launch>
    """)


@pytest.mark.silent
def test_a_container_in_its_namespace() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <group>
            <push_ros_namespace namespace="robot"/>
            <node_container pkg="p" exec="component_container" name="vision" namespace=""/>
          </group>
          <load_composable_node target="/robot/vision">
            <composable_node pkg="p" plugin="p::A" name="a"/>
          </load_composable_node>
        </launch>
    """)


def test_a_nodelet_manager_that_is_not_there() -> None:
    fixture = """
        <launch>
          <group ns="camera">
            <node pkg="nodelet" type="nodelet" name="camera_manager" args="manager"/>
            <node pkg="nodelet" type="nodelet" name="a" args="load p/A camera_manager"/>
            <node pkg="nodelet" type="nodelet" name="b" args="load p/B camera_manger --no-bond"/>
                                                                       ^^^^^^^^^^^^^ warning[LCH034] did you mean
          </group>
          <node pkg="nodelet" type="nodelet" name="c" args="load p/C camera_manager"/>
                                                                     ^^^^^^^^^^^^^^ warning[LCH034] container
          <node pkg="nodelet" type="nodelet" name="d" args="load p/D elsewhere"/>
                                                                     ^^^^^^^^^ hint[LCH034] '/elsewhere'
        </launch>
        //- /nodelet/package.xml
        <package/>
    """
    findings = check(fixture)
    mended = [apply(fixture, f.fixes[0].edits)["/main.launch"] for f in findings if f.fixes]
    assert "load p/B /camera/camera_manager --no-bond" in mended[0]
    assert "load p/C /camera/camera_manager" in mended[1]


@pytest.mark.silent
def test_nodelets_whose_manager_is_there_or_that_need_none() -> None:
    check("""
        <launch>
          <node pkg="nodelet" type="nodelet" name="manager" args="manager" ns="camera"/>
          <node pkg="nodelet" type="nodelet" name="a" args="load p/A manager" ns="camera"/>
          <node pkg="nodelet" type="nodelet" name="b" args="load p/B /camera/manager"/>
          <node pkg="nodelet" type="nodelet" name="c" args="load p/C manager">
            <remap from="manager/load_nodelet" to="/camera/manager/load_nodelet"/>
          </node>
          <node pkg="nodelet" type="nodelet" name="d" args="standalone p/D"/>
          <node pkg="p" type="own_manager" name="own"/>
          <node pkg="nodelet" type="nodelet" name="e" args="load p/E own"/>
        </launch>
        //- /nodelet/package.xml
        <package/>
    """)


def _beside(folder: Path, name: str, *others: str) -> list[Finding]:
    """What is said of a launch file that loads into a manager of this name, beside files that load into others."""
    (folder / "package.xml").write_text("<package><name>p</name></package>")
    load = '<launch><node pkg="nodelet" type="nodelet" name="n" args="load p/Crop {}"/></launch>'
    for number, other in enumerate(others):
        (folder / f"{number}.launch").write_text(load.format(other))
    path = folder / "main.launch"
    path.write_text(load.format(name))
    workspace = Workspace(detect_environment(None, {"ROS_VERSION": "1"}, (str(folder),)), Sources())
    return [each for each in workspace.static(str(path)).findings if each.rule == "LCH034"]


def test_a_manager_that_other_launch_files_call_differently(tmp_path: Path) -> None:
    (finding,) = _beside(tmp_path, "camera_mangaer", "camera_manager", "/camera_manager")
    assert (finding.severity, finding.confidence) == ("info", "possible")
    assert "other launch files of the package load into 'camera_manager'" in finding.message
    assert [edit.text for edit in finding.fixes[0].edits] == ["camera_manager"]


@pytest.mark.parametrize(
    ("name", "others"),
    [
        ("camera_mangaer", ["camera_manager"]),
        ("camera_mangaer", ["camera_manager", "camera_manager", "camera_mangaer"]),
        ("camera1", ["camera2", "camera2"]),
        ("laser", ["camera_manager", "camera_manager"]),
        ("camera_mangaer", ["$(arg camera_manager)", "$(arg camera_manager)"]),
    ],
)
def test_other_names_than_slips_are_no_news(tmp_path: Path, name: str, others: list[str]) -> None:
    (finding,) = _beside(tmp_path, name, *others)
    assert (finding.severity, finding.fixes) == ("hint", ())


def test_a_manager_with_a_word_more_or_less_beside_the_nodelet() -> None:
    check("""
        <launch>
          <group ns="camera">
            <node pkg="nodelet" type="nodelet" name="left_manager" args="manager"/>
            <node pkg="nodelet" type="nodelet" name="right_manager" args="manager"/>
            <node pkg="nodelet" type="nodelet" name="a" args="load p/A left_manager"/>
            <node pkg="nodelet" type="nodelet" name="b" args="load p/B left_nodelet_manager"/>
                                                                       ^^^^^^^^^^^^^^^^^^^^ warning[LCH034] is not
            <node pkg="nodelet" type="nodelet" name="c" args="load p/C right_manager"/>
          </group>
          <node pkg="nodelet" type="nodelet" name="d" args="load p/D left_nodelet_manager"/>
                                                                     ^^^^^^^^^^^^^^^^^^^^ hint[LCH034] is not started by
        </launch>
        //- /nodelet/package.xml
        <package/>
    """)


def test_a_nodelet_is_no_manager() -> None:
    text = """
        <launch>
          <node pkg="nodelet" type="nodelet" name="openni_manager" args="manager"/>
          <node pkg="nodelet" type="nodelet" name="openni_camera" args="load p/Camera openni_manager"/>
          <node pkg="nodelet" type="nodelet" name="a" args="load p/Laser openni_camera"/>
                                                                         ^^^^^^^^^^^^^ warning[LCH034] openni
        </launch>
        //- /nodelet/package.xml
        <package/>
    """
    (finding,) = check(text)
    assert "load p/Laser openni_manager" in apply(text, finding.fixes[0].edits)["/main.launch"]


@pytest.mark.silent
def test_what_loads_by_itself_may_load_others() -> None:
    check("""
        <launch>
          <node pkg="nodelet" type="nodelet" name="camera" args="standalone p/Camera"/>
          <node pkg="nodelet" type="nodelet" name="laser" args="load p/Laser camera"/>
        </launch>
        //- /nodelet/package.xml
        <package/>
    """)
