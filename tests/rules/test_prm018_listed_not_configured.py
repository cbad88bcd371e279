"""PRM018: a plugin that is listed and not configured."""

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import check

_START = """//- /robot.launch.xml
        <launch>
          <node pkg="p" exec="e" name="costmap">
            <param from="/p/costmap.yaml"/>{more}
          </node>
        </launch>
        //- /p/costmap.yaml
        costmap:
          ros__parameters:
            rate: 1.0"""


def test_another_name_than_that_of_the_section() -> None:
    (found,) = check(f"""
        {_START.format(more="")}
            plugins: ["static_layer", "voxel_layer"]
                                       ^^^^^^^^^^^ warning[PRM018] 'voxel_layer' in 'plugins' has no parameter
            static_layer:
              plugin: "a::Static"
            obstacle_layer:
              plugin: "a::Obstacle"
    """)
    assert "'obstacle_layer' is configured but not listed" in found.message
    assert [each.message for each in found.related][:1] == ["'obstacle_layer' is configured here"]


def test_below_another_name() -> None:
    check(f"""
        {_START.format(more="")}
            follow.critics: [near, far]
                             ^^^^ warning[PRM018] no parameter 'follow.near.type'
            follow.far.type: "a::Far"
    """)


_NAV = """//- /robot.launch.xml
        <launch>
          <node pkg="p" exec="e" name="local_costmap" namespace="local_costmap"><param from="/p/nav2.yaml"/></node>
          <node pkg="p" exec="e" name="global_costmap" namespace="global_costmap"><param from="/p/nav2.yaml"/></node>
          <node pkg="p" exec="e" name="controller_server"><param from="/p/nav2.yaml"/></node>
        </launch>
        //- /p/nav2.yaml
        /**:
          ros__parameters:
            rate: 1.0"""


def test_a_layer_of_one_costmap_that_only_the_other_one_has_a_type_of() -> None:
    """ros-navigation/navigation2, issue 2325."""
    check(f"""
        {_NAV}
        local_costmap:
          local_costmap:
            ros__parameters:
              plugins: ["static_layer", "voxel_layer", "inflation_layer"]
                         ^^^^^^^^^^^^ warning[PRM018] 'static_layer' in 'plugins' has no parameter 'static_layer.plugin'
              static_layer:
                map_subscribe_transient_local: True
              voxel_layer:
                plugin: "nav2_costmap_2d::VoxelLayer"
              inflation_layer:
                plugin: "nav2_costmap_2d::InflationLayer"
        global_costmap:
          global_costmap:
            ros__parameters:
              plugins: ["static_layer", "inflation_layer"]
              static_layer:
                plugin: "nav2_costmap_2d::StaticLayer"
              inflation_layer:
                plugin: "nav2_costmap_2d::InflationLayer"
    """)


def test_a_layer_without_a_list() -> None:
    """ros-navigation/navigation2, issue 757."""
    (found,) = check(f"""
        {_NAV}
        global_costmap:
          global_costmap:
            ros__parameters:
              voxel_layer:
                plugin: "nav2_costmap_2d::VoxelLayer"
                ^^^^^^ warning[PRM018] 'voxel_layer' is configured, but 'plugins' is not set
              inflation_layer:
                plugin: "nav2_costmap_2d::InflationLayer"
    """)
    assert found.message.endswith("nav2 loads 'static_layer', 'obstacle_layer' and 'inflation_layer'")


def test_a_list_of_which_no_item_has_a_type() -> None:
    check(f"""
        {_NAV}
        local_costmap:
          local_costmap:
            ros__parameters:
              plugins: ["obstacle_layer", "inflation_layer"]
                         ^^^^^^^^^^^^^^ warning[PRM018] 'obstacle_layer' in 'plugins' has no parameter
                                           ^^^^^^^^^^^^^^^ warning[PRM018] 'inflation_layer' in 'plugins' has no
              obstacle_layer:
                observation_sources: scan
        controller_server:
          ros__parameters:
            controller_plugins: ["Follow"]
                                  ^^^^^^ warning[PRM018] 'Follow' in 'controller_plugins' has no parameter
            FollowPath:
              plugin: "dwb_core::DWBLocalPlanner"
    """)


@pytest.mark.silent
def test_lists_of_nav2_that_need_no_types() -> None:
    check(f"""
        {_NAV}
        local_costmap:
          local_costmap:
            ros__parameters:
              plugins: ["static_layer", "obstacle_layer", "inflation_layer"]
              obstacle_layer:
                observation_sources: scan
        global_costmap:
          global_costmap:
            ros__parameters:
              filters: ["keepout_filter"]
              obstacle_layer:
                plugin: "nav2_costmap_2d::ObstacleLayer"
              keepout_filter:
                plugin: "nav2_costmap_2d::KeepoutFilter"
        controller_server:
          ros__parameters:
            controller_plugins: ["FollowPath"]
            FollowPath:
              max_vel_x: 0.5
            goal_checker_plugins: ["somewhere_else"]
    """)


@pytest.mark.silent
def test_what_is_configured_elsewhere_or_needs_nothing() -> None:
    check(f"""
        {_START.format(more='<param name="voxel_layer.plugin" value="a::Voxel"/>')}
            plugins: ["static_layer", "voxel_layer"]
            behaviors: ["spin", "backup", "drive_on_heading", "wait"]
            critics: ["near", "far"]
            frames: ["map", "static_layer odom"]
            static_layer:
              plugin: "a::Static"
            spin:
              plugin: "a::Spin"
    """)


LOOSE = """
costmap:
  ros__parameters:
    plugins: ["static_layer", "voxel_layer"]
    static_layer: {plugin: "a::Static"}
"""


def _with_files(folder: Path, *files: str) -> list[Finding]:
    """What is said of parameter files that no node gets, of a repository with one package."""
    texts = {
        "package.xml": "<package><name>p</name></package>",
        "a.launch.xml": '<launch><node pkg="p" exec="x" name="costmap"/></launch>',
    }
    own = {f"src/robot/p/{name}": text for name, text in texts.items()}
    for place, text in {**own, **dict.fromkeys(files, LOOSE)}.items():
        path = folder / place
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    environment = detect_environment(str(folder), {"ROS_VERSION": "2"}, root=str(folder / "nowhere"))
    workspace = Workspace(environment, Sources())
    static = workspace.static(str(folder / "src/robot/p/a.launch.xml"))
    return [each for each, _ in workspace.branches(static).findings if each.rule == "PRM018"]


@pytest.mark.parametrize("place", ["src/robot/p/config/nav.yaml", "src/robot/config/nav.yaml", "params/nav.yaml"])
def test_a_file_of_the_package_or_beside_it_that_no_node_gets(tmp_path: Path, place: str) -> None:
    (finding,) = _with_files(tmp_path, place)
    assert (finding.severity, finding.confidence) == ("warning", "likely")
    assert finding.location.file == str(tmp_path / place)


@pytest.mark.silent
def test_a_file_that_changes_some_of_another_one(tmp_path: Path) -> None:
    base = LOOSE + '    voxel_layer: {plugin: "a::Voxel", enabled: true}\n'
    for name, text in {"base.yaml": base, "nav.yaml": LOOSE}.items():
        path = tmp_path / "src/robot/p/config" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    assert not _with_files(tmp_path)


@pytest.mark.silent
def test_a_file_that_is_of_something_else(tmp_path: Path) -> None:
    assert not _with_files(
        tmp_path, "src/robot/docs/nav.yaml", "docs/config/nav.yaml", "src/robot/p/test/config/nav.yaml"
    )


def test_a_controller_of_moveit_without_a_section() -> None:
    check("""
        //- /robot.launch.xml
        <launch><node pkg="p" exec="e" name="move_group"><param from="/p/controllers.yaml"/></node></launch>
        //- /p/controllers.yaml
        move_group:
          ros__parameters:
            moveit_simple_controller_manager:
              controller_names: ["arm_trajectory_controller"]
              ^^^^^^^^^^^^^^^^ warning[PRM018] 'arm_trajectory_controller' in
              arm:
                type: FollowJointTrajectory
              other:
                type: GripperCommand
            other_manager:
              controller_names: ["leg"]
    """)
