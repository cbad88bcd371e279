"""PRM022: a parameter below the name of a plugin that the plugin does not declare."""

from __future__ import annotations

import pytest
from support.check import check, findings_of

_START = """
    //- /robot.launch.xml
    <launch>
      <node pkg="p" exec="e" name="controller_server">
        <param from="/p/nav.yaml"/>
      </node>
    </launch>
    //- /p/nav.yaml
    controller_server:
      ros__parameters:
        FollowPath:
"""
_SOURCE = """
    //- /src/mine/package.xml
    <package><name>mine</name><export><build_type>ament_cmake</build_type></export></package>
    //- /src/mine/CMakeLists.txt
    project(mine)
    add_library(mine SHARED mine.cpp)
    pluginlib_export_plugin_description_file(nav2_core mine.xml)
    //- /src/mine/mine.xml
    <library path="mine"><class type="mine::Controller" base_class_type="nav2_core::Controller"/></library>
    //- /src/mine/mine.cpp
    namespace mine {
    class Controller : public nav2_core::Controller {
    public:
      void configure(const rclcpp_lifecycle::LifecycleNode::WeakPtr & parent, std::string name,
        std::shared_ptr<tf2_ros::Buffer> tf, std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap) override
      {
        auto node = parent.lock();
        node->declare_parameter(name + ".lookahead", 1.0);
      }
    };
    }
"""


def _below(*lines: str) -> str:
    return "".join(f"          {line}\n" for line in lines)


def test_a_slip_of_what_the_catalogue_knows() -> None:
    (found,) = check(
        _START
        + _below(
            'plugin: "nav2_mppi_controller::MPPIController"',
            "vx_maxx: 0.3",
            "^^^^^^^ warning[PRM022] parameter 'vx_maxx' is not declared by plugin",
            "vx_min: -0.3",
        )
    )
    assert found.confidence == "likely"
    assert "the catalogue of jazzy" in found.message
    assert [edit.text for fix in found.fixes for edit in fix.edits] == ["vx_max"]


def test_a_plugin_of_a_plugin() -> None:
    check(
        _START
        + _below(
            'plugin: "dwb_core::DWBLocalPlanner"',
            'critics: ["RotateToGoal", "PathDist"]',
            "max_vel_xx: 0.3",
            "^^^^^^^^^^ warning[PRM022] did you mean 'max_vel_x'?",
            "PathDist.scal: 32.0",
            "^^^^^^^^^^^^^ warning[PRM022] did you mean 'PathDist.scale'?",
            "RotateToGoal.scale: 32.0",
            "xy_goal_tolerance: 0.1",
        )
    )


def test_a_source_of_a_costmap() -> None:
    start = _START.replace("FollowPath:", "obstacle_layer:")
    check(
        start
        + _below(
            'plugin: "nav2_costmap_2d::ObstacleLayer"',
            "observation_sources: front rear",
            "front: {topic: /front, clearing: true}",
            "rear:",
            "  topik: /rear",
            "  ^^^^^ warning[PRM022] did you mean 'rear.topic'?",
        )
    )


def test_a_plugin_of_the_workspace() -> None:
    (found,) = check(
        _START
        + _below(
            'plugin: "mine::Controller"',
            "lookahed: 0.3",
            "^^^^^^^^ warning[PRM022] did you mean 'lookahead'? Source: its source in package 'mine'",
            "speed: 2.0",
        )
        + _SOURCE
    )
    assert found.confidence == "likely"


@pytest.mark.silent
@pytest.mark.parametrize(
    "lines",
    [
        ('plugin: "nav2_mppi_controller::MPPIController"', "something_else: 1", "vx_max: 1.0", "vx_maxx: 1.0"),
        ('plugin: "nav2_nobody::Controller"', "vx_maxx: 1.0"),
        ('plugin: "mppi"', "vx_maxx: 1.0"),
        ('plugin: "::"', "vx_maxx: 1.0"),
        ("plugin: []", "vx_maxx: 1.0"),
        ("plugin: .nan", "vx_maxx: 1.0"),
        ('plugin: "nav2_rotation_shim_controller::RotationShimController"', "primary_controller: 1", "simulate: 1"),
        (
            'plugin: "nav2_rotation_shim_controller::RotationShimController"',
            'primary_controller: "nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController"',
            "desired_linear_vel: 0.5",
        ),
        (
            'plugin: "dwb_core::DWBLocalPlanner"',
            "critics: 5",
            "default_critic_namespaces: 7",
            "PathDist.scal: 1",
        ),
        ('plugin: "nav2_mppi_controller/MPPIController"', "critics: [CostCritic]", "CostCritic: {cost_weight: 3.81}"),
    ],
)
def test_what_is_declared_or_like_nothing_that_is(lines: tuple[str, ...]) -> None:
    check(_START + _below(*lines))


@pytest.mark.silent
def test_the_workspace_is_believed_before_the_catalogue() -> None:
    mine = _SOURCE.replace("mine::Controller", "nav2_mppi_controller::MPPIController").replace(
        "mine", "nav2_mppi_controller"
    )
    assert findings_of(_START + _below('plugin: "nav2_mppi_controller::MPPIController"', "vx_maxx: 0.3") + mine) == []
