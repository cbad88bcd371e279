"""What is known of common packages, with the parameters that they are given: topics, frames and transforms."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.model.frames import frames_of
from support.package_elsewhere import analysed


def param(name: str, value: object) -> str:
    return f'<param name="{name}" value="{value}"/>'


def known(folder: Path, distro: str, package: str, executable: str, *params: str, args: str = "") -> set[str]:
    """Topics (`< scan`, `> odom`), transforms (`map -> odom`) and frames that are looked up (`? base_link`) or only
    named (`! laser`) of a node."""
    kind, name = ("type", "a.launch") if distro == "noetic" else ("exec", "a.launch.xml")
    node = f'<node pkg="{package}" {kind}="{executable}" name="n" args="{args}">{"".join(params)}</node>'
    analysis = analysed(folder, f"<launch>{node}</launch>", name, distro)
    assert analysis.graph is not None
    frames = frames_of(analysis.context)
    return {
        *(
            f"{'<' if end.role == 'subscriber' else '>'} {end.name}"
            for end in analysis.graph.interfaces[0].endpoints
            if end.role in ("publisher", "subscriber") and not end.builtin
        ),
        *(f"{edge.parent} -> {edge.child}" for edge in frames.edges),
        *(f"{'?' if use.looked_up else '!'} {use.written}" for use in frames.uses),
        *(("...",) if any("broadcasts" in gap for gap in frames.gaps) else ()),
    }


@pytest.mark.parametrize(
    ("distro", "node", "given", "expected"),
    [
        ("humble", "rf2o_laser_odometry/rf2o_laser_odometry_node", {"odom_topic": "/o"}, {"> /o", "odom -> base_link"}),
        ("noetic", "rf2o_laser_odometry/rf2o_laser_odometry_node", {"publish_tf": "false"}, {"< /laser_scan"}),
        ("noetic", "hector_mapping/hector_mapping", {"scan_topic": "s"}, {"< s", "map -> odom", "? base_link"}),
        ("noetic", "slam_karto/slam_karto", {"base_frame": "b"}, {"map -> odom", "? b"}),
        ("noetic", "robot_pose_ekf/robot_pose_ekf", {}, {"odom_combined -> base_footprint"}),
        ("noetic", "fake_localization/fake_localization", {"odom_frame_id": "o"}, {"map -> o", "? o"}),
        ("humble", "rtabmap_slam/rtabmap", {"odom_frame_id": "odom"}, {"map -> odom", "? odom", "? base_link"}),
        ("humble", "rtabmap_slam/rtabmap", {}, {"? base_link", "..."}),
        ("humble", "rtabmap_odom/icp_odometry", {}, {"odom -> base_link"}),
        ("humble", "rtabmap_odom/icp_odometry", {"guess_frame_id": "g"}, {"odom -> g", "? g"}),
        ("humble", "turtlebot3_node/turtlebot3_ros", {"odometry.publish_tf": "true"}, {"odom -> base_footprint"}),
        ("noetic", "scout_base/scout_base_node", {"odom_topic_name": "o"}, {"> o", "odom -> base_link"}),
        ("humble", "kobuki_node/kobuki_ros_node", {"base_frame": "b"}, {"odom -> b"}),
        ("jazzy", "ouster_ros/os_driver", {"lidar_frame": "l"}, {"os_sensor -> l", "os_sensor -> os_imu"}),
        ("noetic", "mavros/mavros_node", {"local_position/tf/send": "true"}, {"map -> base_link", "..."}),
        ("humble", "mavros/mavros_node", {}, {"..."}),
        ("humble", "realsense2_camera/realsense2_camera_node", {}, {"..."}),
        ("humble", "imu_complementary_filter/complementary_filter_node", {"publish_tf": "true"}, {"..."}),
        ("humble", "aruco_ros/single", {"camera_frame": "c", "marker_frame": "m"}, {"c -> m", "? c"}),
        ("humble", "apriltag_ros/apriltag_node", {}, {"..."}),
        (
            "humble",
            "octomap_server/octomap_server_node",
            {"filter_ground_plane": "true"},
            {"? map", "? base_footprint"},
        ),
        ("noetic", "octomap_server/octomap_server_node", {"frame_id": "m"}, {"? m"}),
        ("humble", "pointcloud_to_laserscan/pointcloud_to_laserscan_node", {"target_frame": "l"}, {"? l"}),
        ("humble", "depthimage_to_laserscan/depthimage_to_laserscan_node", {}, {"! camera_depth_frame"}),
        ("humble", "laser_filters/scan_to_scan_filter_chain", {"filter1.params.box_frame": "b"}, {"? b"}),
        ("noetic", "laser_filters/scan_to_cloud_filter_chain", {"scan_topic": "s"}, {"< s", "? base_link"}),
        ("humble", "sllidar_ros2/sllidar_node", {"frame_id": "l"}, {"! l"}),
        ("jazzy", "rplidar_ros/rplidar_node", {"topic_name": "s"}, {"> s", "! laser_frame"}),
        ("noetic", "urg_node/urg_node", {}, {"! laser"}),
        ("humble", "velodyne_pointcloud/velodyne_transform_node", {"fixed_frame": "f"}, {"? f"}),
        ("humble", "usb_cam/usb_cam_node_exe", {"frame_id": "c"}, {"! c"}),
        ("humble", "gpsd_client/gpsd_client", {}, {"! gps"}),
        ("kilted", "nav2_route/route_server", {"costmap_topic": "/c"}, {"< /c", "? base_link"}),
        (
            "kilted",
            "nav2_loopback_sim/loopback_simulator",
            {},
            {"map -> odom", "odom -> base_footprint", "? base_scan"},
        ),
        ("humble", "cmd_vel_mux/cmd_vel_mux_node", {"subscribers.joy.topic": "j"}, {"< j"}),
        ("humble", "nav2_collision_monitor/collision_monitor", {"cmd_vel_in_topic": "raw"}, {"< raw", "? odom"}),
        ("noetic", "move_base/move_base", {"global_costmap/static_layer/map_topic": "/m"}, {"< /m"}),
    ],
)
def test_parameters(tmp_path: Path, distro: str, node: str, given: dict[str, str], expected: set[str]) -> None:
    found = known(tmp_path, distro, *node.split("/"), *(param(name, value) for name, value in given.items()))
    assert expected <= found
    assert ("..." in expected) == ("..." in found)


def test_arguments(tmp_path: Path) -> None:
    spawn = "-topic robot_description -entity r"
    assert "< robot_description" in known(tmp_path, "humble", "gazebo_ros", "spawn_entity.py", args=spawn)


def test_a_mistake_is_found_at_its_parameter(tmp_path: Path) -> None:
    nodes = """
    <launch>
      <node pkg="tf2_ros" exec="static_transform_publisher" name="s" args="0 0 0 0 0 0 base_link base_laser"/>
      <node pkg="pointcloud_to_laserscan" exec="pointcloud_to_laserscan_node" name="flat">
        <param name="target_frame" value="base_lase"/>
      </node>
      <node pkg="rf2o_laser_odometry" exec="rf2o_laser_odometry_node" name="odometry">
        <param name="laser_scan_topic" value="/sacn"/>
      </node>
      <node pkg="rplidar_ros" exec="rplidar_node" name="lidar"><param name="topic_name" value="/scan"/></node>
    </launch>
    """
    analysis = analysed(tmp_path, nodes, "a.launch.xml", "humble")
    fixes = {
        found.rule: found.fixes[0].title
        for found in analysis.findings
        if found.rule in ("FRM001", "TOP001") and found.fixes
    }
    assert fixes == {"FRM001": "Replace 'base_lase' with 'base_laser'", "TOP001": "Replace '/sacn' with '/scan'"}
