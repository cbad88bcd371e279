"""Nodes and packages that have another name, or another package, in the distribution that the catalogue knows.

By what the projects say themselves: scripts of ROS 2 have been installed without `.py` since Galactic (`spawner.py`,
`view_frames.py`); nav2's migration guide (`configuration/migration/Galactic.rst`: recoveries server to behavior
server); the change from `ros_ign` to `ros_gz` (`ros_gz`, README.md); rtabmap_ros 0.21, which was taken apart to
packages (`CHANGELOG.rst`); MoveIt's MIGRATION.md (servo); cartographer_ros and velodyne_pointcloud, which gave their
executables other names than on ROS 1 (`CMakeLists.txt`). On ROS 1 robot_state_publisher's `state_publisher`, which is
gone since 1.15.0 (`CHANGELOG.rst`), and the nodes of the package `gazebo`, which are gazebo_ros's since Hydro
(https://classic.gazebosim.org/tutorials?tut=ros_overview).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

_NEW, _OLD = "jazzy", "noetic"
_SCRIPT = ".py"
_RTABMAP: Mapping[str, tuple[str, ...]] = {
    "rtabmap_slam": ("rtabmap",),
    "rtabmap_odom": ("icp_odometry", "rgbd_odometry", "stereo_odometry"),
    "rtabmap_sync": ("rgb_sync", "rgbd_sync", "rgbdx_sync", "stereo_sync"),
    "rtabmap_util": (
        *("disparity_to_depth", "imu_to_tf", "lidar_deskewing", "map_assembler", "obstacles_detection"),
        *("point_cloud_aggregator", "point_cloud_assembler", "point_cloud_xyz", "point_cloud_xyzrgb"),
        *("pointcloud_to_depthimage", "rgbd_relay", "rgbd_split"),
    ),
    "rtabmap_viz": ("rtabmap_viz",),
}
_RENAMED: Mapping[tuple[str, str], tuple[str, str]] = {
    ("nav2_recoveries", "recoveries_server"): ("nav2_behaviors", "behavior_server"),
    ("nav2_recoveries", "recoveries_node"): ("nav2_behaviors", "behavior_server"),
    ("moveit_servo", "servo_node_main"): ("moveit_servo", "servo_node"),
    ("moveit_servo", "servo_server"): ("moveit_servo", "servo_node"),
    ("cartographer_ros", "cartographer_occupancy_grid_node"): ("cartographer_ros", "occupancy_grid_node"),
    ("velodyne_pointcloud", "velodyne_convert_node"): ("velodyne_pointcloud", "velodyne_transform_node"),
    ("ros_ign_bridge", "parameter_bridge"): ("ros_gz_bridge", "parameter_bridge"),
    ("ros_ign_gazebo", "create"): ("ros_gz_sim", "create"),
    ("ros_ign_image", "image_bridge"): ("ros_gz_image", "image_bridge"),
    ("rtabmap_ros", "rtabmapviz"): ("rtabmap_viz", "rtabmap_viz"),
    **{("rtabmap_ros", name): (package, name) for package, names in _RTABMAP.items() for name in names},
}
_COMPONENTS: Mapping[tuple[str, str], tuple[str, str]] = {
    ("moveit_servo", "moveit_servo::ServoServer"): ("moveit_servo", "moveit_servo::ServoNode"),
    ("nav2_recoveries", "recovery_server::RecoveryServer"): ("nav2_behaviors", "behavior_server::BehaviorServer"),
}


_OF_ROS1: Mapping[tuple[str, str], tuple[str, str]] = {
    ("robot_state_publisher", "state_publisher"): ("robot_state_publisher", "robot_state_publisher"),
    ("gazebo", "spawn_model"): ("gazebo_ros", "spawn_model"),
    ("gazebo", "gazebo"): ("gazebo_ros", "gazebo"),
}
_OF_NODELETS: Mapping[str, str] = {"pcl": "pcl_ros"}
"""Packages of nodelets whose names begin with another word than theirs."""
_SUCCESSORS: Mapping[str, str] = {
    "actionlib": "rclcpp_action",
    "amcl": "nav2_amcl",
    "catkin": "ament_cmake",
    "costmap_2d": "nav2_costmap_2d",
    "eigen_conversions": "tf2_eigen",
    "gazebo_ros_control": "gazebo_ros2_control",
    "map_server": "nav2_map_server",
    "message_generation": "rosidl_default_generators",
    "message_runtime": "rosidl_default_runtime",
    "move_base": "nav2_bringup",
    "nav_core": "nav2_core",
    "nodelet": "rclcpp_components",
    "rosbag": "rosbag2",
    "roscpp": "rclcpp",
    "roslaunch": "ros2launch",
    "rospy": "rclpy",
    "rostest": "launch_testing_ros",
    "rviz": "rviz2",
    "tf": "tf2_ros",
}
"""Packages of ROS 1, and those of ROS 2 that have their place (https://docs.ros.org/en/rolling/How-To-Guides/
Migrating-from-ROS1.html, and the migration guides of Nav2 and gazebo_ros2_control)."""
_IN_THEIR_PLACE: Mapping[int, Mapping[str, str]] = {1: {new: old for old, new in _SUCCESSORS.items()}, 2: _SUCCESSORS}


def in_generation(package: str, generation: int) -> str | None:
    """The package of a generation of ROS that has the place of one of the other; None where none is known."""
    return _IN_THEIR_PLACE[generation].get(package)


def other_names(package: str, kind: str, name: str, distro: str) -> Iterator[tuple[str, str]]:
    """The packages and names under which a distribution may have a node: `kind` is `executables`, `components` or
    `nodelets`."""
    if distro == _OLD:
        if kind == "executables" and (package, name) in _OF_ROS1:
            yield _OF_ROS1[package, name]
        elif kind == "nodelets" and package in _OF_NODELETS:
            yield _OF_NODELETS[package], name
        return
    if distro != _NEW:
        return
    table = _RENAMED if kind == "executables" else _COMPONENTS if kind == "components" else {}
    if (package, name) in table:
        yield table[package, name]
    if kind == "executables" and name.endswith(_SCRIPT):
        yield package, name.removesuffix(_SCRIPT)
