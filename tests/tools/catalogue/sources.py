"""Where the catalogue's packages come from: repositories, and their branch for each distribution."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

SOURCES: Mapping[str, Mapping[str, str]] = {
    # Messages
    "ros/std_msgs": {"noetic": "kinetic-devel"},
    "ros/common_msgs": {"noetic": "noetic-devel"},
    "ros/ros_comm_msgs": {"noetic": "kinetic-devel"},
    "ros/actionlib": {"noetic": "noetic-devel"},
    "ros/geometry2": {"noetic": "noetic-devel"},
    "ros-planning/navigation_msgs": {"noetic": "ros1", "jazzy": "ros2"},
    "ros2/common_interfaces": {"jazzy": "jazzy"},
    "ros2/rcl_interfaces": {"jazzy": "jazzy"},
    "ros2/unique_identifier_msgs": {"jazzy": "jazzy"},
    "ros-controls/control_msgs": {"noetic": "kinetic-devel", "jazzy": "jazzy"},
    "ros-planning/moveit_msgs": {"noetic": "master", "jazzy": "ros2"},
    "ros-perception/vision_msgs": {"noetic": "noetic-devel", "jazzy": "ros2"},
    "ros-drivers/ackermann_msgs": {"noetic": "master", "jazzy": "ros2"},
    "ros-geographic-info/geographic_info": {"noetic": "master", "jazzy": "ros2"},
    "mavlink/mavros": {"noetic": "master", "jazzy": "ros2"},
    # Nodes
    "ros2/geometry2": {"jazzy": "jazzy"},
    "ros2/rclcpp": {"jazzy": "jazzy"},
    "ros/ros_comm": {"noetic": "noetic-devel"},
    "ros/ros_tutorials": {"noetic": "noetic-devel", "jazzy": "rolling"},
    "ros/nodelet_core": {"noetic": "noetic-devel"},
    "ros/robot_state_publisher": {"noetic": "noetic-devel", "jazzy": "rolling"},
    "ros/joint_state_publisher": {"noetic": "noetic-devel", "jazzy": "ros2"},
    "ros/diagnostics": {"noetic": "noetic-devel", "jazzy": "ros2-jazzy"},
    "ros2/rosbag2": {"jazzy": "jazzy"},
    "ros2/demos": {"jazzy": "jazzy"},
    "ros2/rviz": {"jazzy": "jazzy"},
    "ros-navigation/navigation2": {"jazzy": "jazzy"},
    "ros-planning/navigation": {"noetic": "noetic-devel"},
    "SteveMacenski/slam_toolbox": {"noetic": "noetic-devel", "jazzy": "ros2"},
    "cra-ros-pkg/robot_localization": {"noetic": "noetic-devel", "jazzy": "ros2"},
    "ros-perception/slam_gmapping": {"noetic": "melodic-devel"},
    "cartographer-project/cartographer_ros": {"noetic": "master"},
    "tu-darmstadt-ros-pkg/hector_slam": {"noetic": "noetic-devel"},
    "introlab/rtabmap_ros": {"noetic": "noetic-devel", "jazzy": "jazzy-devel"},
    "ros-drivers/joystick_drivers": {"noetic": "ros1", "jazzy": "ros2"},
    "ros-teleop/teleop_twist_joy": {"noetic": "indigo-devel"},
    "ros-teleop/teleop_twist_keyboard": {"noetic": "master"},
    "ros2/teleop_twist_joy": {"jazzy": "HEAD"},
    "ros2/teleop_twist_keyboard": {"jazzy": "dashing"},
    "ros-teleop/teleop_tools": {"noetic": "noetic-devel", "jazzy": "master"},
    "ros-teleop/twist_mux": {"noetic": "melodic-devel", "jazzy": "rolling"},
    "ros-tooling/topic_tools": {"jazzy": "jazzy"},
    "RobotWebTools/rosbridge_suite": {"noetic": "ros1", "jazzy": "ros2"},
    "foxglove/ros-foxglove-bridge": {"noetic": "main", "jazzy": "main"},
    "ros-perception/image_pipeline": {"noetic": "noetic", "jazzy": "rolling"},
    "ros-perception/vision_opencv": {"noetic": "noetic", "jazzy": "rolling"},
    "ros-perception/perception_pcl": {"noetic": "melodic-devel", "jazzy": "ros2"},
    "ros-perception/laser_filters": {"noetic": "noetic-devel", "jazzy": "ros2"},
    "ros-perception/pointcloud_to_laserscan": {"noetic": "lunar-devel", "jazzy": "rolling"},
    "ros-perception/depthimage_to_laserscan": {"noetic": "melodic-devel", "jazzy": "ros2"},
    "ros-perception/imu_pipeline": {"noetic": "noetic-devel", "jazzy": "ros2"},
    "CCNYRoboticsLab/imu_tools": {"noetic": "noetic", "jazzy": "rolling"},
    "AprilRobotics/apriltag_ros": {"noetic": "master"},
    "ros-drivers/velodyne": {"noetic": "master", "jazzy": "ros2"},
    "ros-drivers/urg_node": {"noetic": "melodic-devel", "jazzy": "ros2-devel"},
    "ros-drivers/usb_cam": {"noetic": "develop", "jazzy": "main"},
    "ros-drivers/rosserial": {"noetic": "noetic-devel"},
    "Slamtec/rplidar_ros": {"noetic": "master", "jazzy": "ros2"},
    "Slamtec/sllidar_ros2": {"jazzy": "main"},
    "SICKAG/sick_scan": {"noetic": "master"},
    "IntelRealSense/realsense-ros": {"noetic": "ros1-legacy", "jazzy": "ros2-master"},
    "ros-controls/ros_control": {"noetic": "noetic-devel"},
    "ros-controls/ros_controllers": {"noetic": "noetic-devel"},
    "ros-controls/ros2_control": {"jazzy": "jazzy"},
    "ros-controls/ros2_controllers": {"jazzy": "jazzy"},
    "ros-controls/gz_ros2_control": {"jazzy": "jazzy"},
    "ros-simulation/gazebo_ros2_control": {"jazzy": "master"},
    "ros-simulation/gazebo_ros_pkgs": {"noetic": "noetic-devel", "jazzy": "ros2"},
    "gazebosim/ros_gz": {"jazzy": "jazzy"},
    "ros-planning/moveit": {"noetic": "master"},
    "ros-perception/image_common": {"noetic": "noetic-devel", "jazzy": "jazzy"},
    "ros2/cartographer_ros": {"jazzy": "ros2"},
    "christianrauch/apriltag_ros": {"jazzy": "master"},
    "ros-visualization/rviz": {"noetic": "noetic-devel"},
    "ros-simulation/stage_ros": {"noetic": "lunar-devel"},
    "micro-ROS/micro-ROS-Agent": {"jazzy": "jazzy"},
    "ROBOTIS-GIT/hls_lfcd_lds_driver": {"noetic": "noetic", "jazzy": "jazzy"},
    "ros-drivers/nmea_navsat_driver": {"noetic": "melodic-devel", "jazzy": "ros2"},
    "ouster-lidar/ouster-ros": {"noetic": "master", "jazzy": "ros2"},
    "RobotWebTools/web_video_server": {"noetic": "ros1", "jazzy": "ros2"},
    "RobotWebTools/tf2_web_republisher": {"noetic": "master"},
    "joshnewans/twist_stamper": {"jazzy": "main"},
    "KumarRobotics/ublox": {"noetic": "master", "jazzy": "ros2"},
    "luxonis/depthai-ros": {"noetic": "noetic", "jazzy": "jazzy"},
    "YDLIDAR/ydlidar_ros2_driver": {"jazzy": "humble"},
    "orbbec/OrbbecSDK_ROS2": {"jazzy": "v2-main"},
    "ros-drivers/openni2_camera": {"noetic": "ros1", "jazzy": "ros2"},
    "SICKAG/sick_scan_xd": {"noetic": "master", "jazzy": "master"},
    "ros-planning/robot_pose_ekf": {"noetic": "master"},
    "ros-drivers/flir_camera_driver": {"noetic": "noetic-devel", "jazzy": "humble-release"},
    "ros-drivers/axis_camera": {"noetic": "noetic-devel", "jazzy": "jazzy-devel"},
    "ros-drivers/phidgets_drivers": {"noetic": "noetic", "jazzy": "rolling"},
    "UniversalRobots/Universal_Robots_ROS2_Driver": {"jazzy": "jazzy"},
    "stereolabs/zed-ros2-wrapper": {"jazzy": "master"},
    "AutonomyLab/create_robot": {"noetic": "noetic", "jazzy": "humble"},
    "frankarobotics/franka_ros2": {"jazzy": "jazzy"},
    "cyberbotics/webots_ros2": {"jazzy": "master"},
    "moveit/moveit2": {"jazzy": "jazzy"},
    "hrnr/m-explore": {"noetic": "noetic-devel"},
    "ROBOTIS-GIT/turtlebot3": {"noetic": "noetic", "jazzy": "jazzy"},
    "ROBOTIS-GIT/turtlebot3_simulations": {"noetic": "noetic", "jazzy": "jazzy"},
    "turtlebot/turtlebot4": {"jazzy": "humble"},
    "f1tenth/vesc": {"noetic": "main", "jazzy": "ros2"},
    "f1tenth/ackermann_mux": {"noetic": "melodic-devel", "jazzy": "foxy-devel"},
    "tier4/ros2_v4l2_camera": {"jazzy": "galactic"},
    "rt-net/raspimouse2": {"jazzy": "jazzy"},
    "rt-net/rt_usb_9axisimu_driver": {"noetic": "noetic-devel", "jazzy": "ros2-devel"},
    "ros-drivers/um7": {"noetic": "indigo-devel", "jazzy": "ros2"},
    "clearpathrobotics/LMS1xx": {"noetic": "noetic-devel", "jazzy": "humble-devel"},
    "ldrobotSensorTeam/ldlidar_stl_ros2": {"jazzy": "master"},
    "Livox-SDK/livox_ros_driver2": {"noetic": "master", "jazzy": "master"},
    "ros-visualization/interactive_marker_twist_server": {"noetic": "kinetic-devel", "jazzy": "humble-devel"},
    "christianrauch/camera_ros": {"jazzy": "main"},
    "flynneva/bno055": {"jazzy": "main"},
    "MAPIRlab/rf2o_laser_odometry": {"noetic": "ros1", "jazzy": "ros2"},
    "robo-friends/m-explore-ros2": {"jazzy": "main"},
    "PickNikRobotics/picknik_controllers": {"jazzy": "main"},
    "open-rmf/rmf_ros2": {"jazzy": "jazzy"},
    "open-rmf/rmf_traffic_editor": {"jazzy": "jazzy"},
    "ros/geometry": {"noetic": "noetic-devel"},
    "ros-perception/image_transport_plugins": {"noetic": "noetic-devel", "jazzy": "rolling"},
    "ros-perception/slam_karto": {"noetic": "melodic-devel"},
    "CCNYRoboticsLab/scan_tools": {"noetic": "ros1"},
    "OctoMap/octomap_mapping": {"noetic": "kinetic-devel", "jazzy": "ros2"},
    "ros-drivers/audio_common": {"noetic": "master", "jazzy": "ros2"},
    "ros-drivers/pointgrey_camera_driver": {"noetic": "noetic-devel"},
    "arebgun/dynamixel_motor": {"noetic": "master"},
    "yujinrobot/yujin_ocs": {"noetic": "devel"},
    "jsk-ros-pkg/jsk_common": {"noetic": "master"},
    "jsk-ros-pkg/jsk_recognition": {"noetic": "master"},
    "autowarefoundation/autoware_core": {"jazzy": "1.7.2"},
    "autowarefoundation/autoware.universe": {"jazzy": "main"},
    "MapIV/eagleye": {"jazzy": "main-ros2"},
    "tier4/nebula": {"jazzy": "main"},
}
"""A branch of another distribution's name is the one that the packages of this are released from, or the nearest."""
DESCRIPTION_SOURCES: Mapping[str, Mapping[str, str]] = {
    "UniversalRobots/Universal_Robots_ROS2_Description": {"jazzy": "rolling"},
    "UniversalRobots/Universal_Robots_ROS2_Driver": {"jazzy": "jazzy"},
    "ros-industrial/universal_robot": {"noetic": "noetic-devel"},
    "IntelRealSense/realsense-ros": {"noetic": "ros1-legacy", "jazzy": "ros2-master"},
    "ToyotaResearchInstitute/velodyne_simulator": {"noetic": "master", "jazzy": "dashing-devel"},
    "frankarobotics/franka_description": {"jazzy": "main"},
    "frankaemika/franka_ros": {"noetic": "develop"},
    "ROBOTIS-GIT/turtlebot3": {"noetic": "noetic", "jazzy": "jazzy"},
    "ROBOTIS-GIT/open_manipulator": {"noetic": "noetic", "jazzy": "jazzy"},
    "yujinrobot/kobuki": {"noetic": "melodic"},
    "kobuki-base/kobuki_ros": {"jazzy": "devel"},
    "turtlebot/turtlebot": {"noetic": "melodic"},
    "turtlebot/turtlebot4": {"jazzy": "humble"},
    "iRobotEducation/create3_sim": {"jazzy": "jazzy"},
    "AutonomyLab/create_robot": {"noetic": "noetic", "jazzy": "humble"},
    "xArm-Developer/xarm_ros2": {"jazzy": "jazzy"},
    "clearpathrobotics/LMS1xx": {"noetic": "noetic-devel", "jazzy": "humble-devel"},
    "husky/husky": {"noetic": "noetic-devel", "jazzy": "humble-devel"},
    "jackal/jackal": {"noetic": "noetic-devel"},
    "PR2/pr2_common": {"noetic": "melodic-devel"},
    "RethinkRobotics/baxter_common": {"noetic": "master"},
    "PickNikRobotics/ros2_robotiq_gripper": {"jazzy": "main"},
    "ros-industrial/robotiq": {"noetic": "kinetic-devel"},
    "Kinovarobotics/ros2_kortex": {"jazzy": "jazzy"},
    "LeoRover/leo_common": {"noetic": "master"},
    "moveit/moveit_resources": {"noetic": "master", "jazzy": "ros2"},
    "stereolabs/zed-ros-wrapper": {"noetic": "master"},
    "stereolabs/zed-ros2-wrapper": {"jazzy": "master"},
    "stereolabs/zed-ros2-description": {"jazzy": "main"},
    "husarion/ros_components_description": {"noetic": "ros1", "jazzy": "ros2"},
    "RobotnikAutomation/robotnik_sensors": {"noetic": "noetic-devel"},
    "fetchrobotics/fetch_ros": {"noetic": "ros1"},
    "luxonis/depthai-ros": {"noetic": "noetic", "jazzy": "jazzy"},
    "ethz-asl/rotors_simulator": {"noetic": "master"},
    "tu-darmstadt-ros-pkg/hector_models": {"noetic": "melodic-devel"},
}
"""Where robot descriptions come from that other packages include: the branch that a distribution's packages are
released from, or the nearest."""
RUN: Mapping[str, Mapping[str, Mapping[str, str]]] = {
    "jazzy": {
        "gazebo_ros": {"spawn_entity.py": "-entity preflight_first -database preflight_second"},
        "controller_manager": {
            "spawner": "preflight_first",
            "unspawner": "preflight_first",
            "hardware_spawner": "preflight_first --activate",
        },
    },
    "noetic": {"gazebo_ros": {"spawn_model": "-urdf -param robot_description -model preflight_first"}},
}
"""Nodes in Python that do what their arguments say, and the source alone tells nothing of: by distribution, package and
executable the arguments with which they are run."""
NAMED: Mapping[str, Mapping[str, Mapping[str, str]]] = {
    "jazzy": {"controller_manager": {"ros2_control_node": "controller_manager"}},
}
"""Executables whose library names their node: by distribution, package and executable the name."""
_TRAJECTORY = {
    "publishers": [{"name": "~state", "type": "control_msgs/JointTrajectoryControllerState"}],
    "subscriptions": [{"name": "~command", "type": "trajectory_msgs/JointTrajectory"}],
    "service_servers": [{"name": "~query_state", "type": "control_msgs/QueryTrajectoryState"}],
    "action_servers": [{"name": "~follow_joint_trajectory", "type": "control_msgs/FollowJointTrajectoryAction"}],
}
_NUMBER = {"subscriptions": [{"name": "~command", "type": "std_msgs/Float64"}]}
_NUMBERS = {"subscriptions": [{"name": "~command", "type": "std_msgs/Float64MultiArray"}]}
_LOOP = {**_NUMBER, "publishers": [{"name": "~state", "type": "control_msgs/JointControllerState"}]}
_DRIVE = {
    "publishers": [{"name": "~odom", "type": "nav_msgs/Odometry"}, {"name": "/tf", "type": "tf/tfMessage"}],
    "subscriptions": [{"name": "~cmd_vel", "type": "geometry_msgs/Twist"}],
}
_GRIPPER = {"action_servers": [{"name": "~gripper_cmd", "type": "control_msgs/GripperCommandAction"}]}
CONTROLLERS: Mapping[str, Mapping[str, Mapping[str, Sequence[Mapping[str, Any]]]]] = {
    "joint_state_controller": {
        "joint_state_controller/JointStateController": {
            "publishers": [{"name": "joint_states", "type": "sensor_msgs/JointState"}]
        }
    },
    "joint_trajectory_controller": {
        f"{kind}_controllers/JointTrajectoryController": _TRAJECTORY
        for kind in ("effort", "pos_vel", "pos_vel_acc", "position", "velocity")
    },
    "effort_controllers": {
        "effort_controllers/JointEffortController": _NUMBER,
        "effort_controllers/JointGroupEffortController": _NUMBERS,
        "effort_controllers/JointGroupPositionController": _NUMBERS,
        "effort_controllers/JointPositionController": _LOOP,
        "effort_controllers/JointVelocityController": _LOOP,
    },
    "position_controllers": {
        "position_controllers/JointGroupPositionController": _NUMBERS,
        "position_controllers/JointPositionController": _NUMBER,
    },
    "velocity_controllers": {
        "velocity_controllers/JointGroupVelocityController": _NUMBERS,
        "velocity_controllers/JointPositionController": _LOOP,
        "velocity_controllers/JointVelocityController": _NUMBER,
    },
    "gripper_action_controller": {
        f"{kind}_controllers/GripperActionController": _GRIPPER for kind in ("effort", "position")
    },
    "diff_drive_controller": {"diff_drive_controller/DiffDriveController": _DRIVE},
    "ackermann_steering_controller": {"ackermann_steering_controller/AckermannSteeringController": _DRIVE},
}
"""Controllers of ros_control (ROS 1), by package: what they make below their own name (`~`), and in the namespace of
their manager. They refuse to start without parameters of a real robot, and many are templates, so that the analysis
does not read them (http://wiki.ros.org/ros_controllers, ros_controllers at noetic-devel: `init` of each)."""
MANIFESTS: Mapping[str, Mapping[str, str]] = {
    "Livox-SDK/livox_ros_driver2": {"noetic": "package_ROS1.xml", "jazzy": "package_ROS2.xml"},
}
"""Repositories whose script makes `package.xml`: of what, by distribution."""
_OF_GAZEBO = {
    **{
        name: f"gazebo_msgs/{''.join(map(str.title, name.split('_')))}"
        for name in (
            *("delete_model", "delete_light", "get_model_properties", "get_model_state", "get_world_properties"),
            *("get_joint_properties", "get_link_properties", "get_link_state", "get_light_properties"),
            *("set_light_properties", "get_physics_properties", "set_link_properties", "set_physics_properties"),
            *("set_model_state", "set_model_configuration", "set_joint_properties", "set_link_state"),
            *("apply_body_wrench", "apply_joint_effort"),
        )
    },
    **dict.fromkeys(("spawn_sdf_model", "spawn_urdf_model"), "gazebo_msgs/SpawnModel"),
    **dict.fromkeys(("reset_simulation", "reset_world", "pause_physics", "unpause_physics"), "std_srvs/Empty"),
    "clear_joint_forces": "gazebo_msgs/JointRequest",
    "clear_body_wrenches": "gazebo_msgs/BodyRequest",
}
_GAZEBO = {
    # https://classic.gazebosim.org/tutorials?tut=ros_comm: what its system plugin offers, which the scripts load
    "publishers": [
        {"name": "/clock", "type": "rosgraph_msgs/Clock"},
        {"name": "~link_states", "type": "gazebo_msgs/LinkStates"},
        {"name": "~model_states", "type": "gazebo_msgs/ModelStates"},
    ],
    "subscriptions": [
        {"name": "~set_link_state", "type": "gazebo_msgs/LinkState"},
        {"name": "~set_model_state", "type": "gazebo_msgs/ModelState"},
    ],
    "service_servers": [{"name": f"~{name}", "type": type_} for name, type_ in _OF_GAZEBO.items()],
}
_CLOUDS = {
    # http://wiki.ros.org/pcl_ros: filters take the clouds in once somebody takes them out
    "publishers": [{"name": "~output", "type": "sensor_msgs/PointCloud2"}],
    "subscriptions": [
        {"name": "~input", "type": "sensor_msgs/PointCloud2"},
        {"name": "~indices", "type": "pcl_msgs/PointIndices", "conditional": True},
    ],
}
_SOURCES = {
    # https://docs.nav2.org/configuration/packages/configuring-collision-monitor.html: each source has a `type`
    "subscriptions": [
        {"named_by": "~*.topic"},
        {"named_by": "~*.polygon_sub_topic", "type": "geometry_msgs/msg/PolygonStamped"},
        {"named_by": "~*.footprint_topic", "type": "geometry_msgs/msg/PolygonStamped"},
    ],
    "publishers": [{"named_by": "~*.polygon_pub_topic", "type": "geometry_msgs/msg/PolygonStamped"}],
}
_STAMPED = {"true": "geometry_msgs/msg/TwistStamped", "false": "geometry_msgs/msg/Twist"}
_TELEOP_JOY = {
    "publishers": [{"name": "cmd_vel", "type": _STAMPED["false"], "typed_by": {"~publish_stamped_twist": _STAMPED}}],
}
DECLARED: Mapping[str, Mapping[str, Mapping[str, Mapping[str, Sequence[Mapping[str, Any]]]]]] = {
    "jazzy": {
        "nav2_collision_monitor": dict.fromkeys(
            (
                *("collision_detector", "collision_monitor"),
                *("nav2_collision_monitor::CollisionDetector", "nav2_collision_monitor::CollisionMonitor"),
            ),
            _SOURCES,
        ),
        "twist_mux": {
            "twist_mux": {
                # https://docs.ros.org/en/ros2_packages/jazzy/api/twist_mux/__CHANGELOG.html: `use_stamped` since 4.4.0
                "publishers": [{"name": "cmd_vel_out", "typed_by": {"~use_stamped": _STAMPED}}],
                "subscriptions": [
                    {"named_by": "~topics.*.topic", "typed_by": {"~use_stamped": _STAMPED}},
                    {"named_by": "~locks.*.topic", "type": "std_msgs/msg/Bool"},
                ],
            },
        },
        # github:ros2/teleop_twist_keyboard/pull/26 and github:ros2/teleop_twist_joy/pull/42
        "teleop_twist_keyboard": {
            "teleop_twist_keyboard": {
                "publishers": [
                    {"name": "cmd_vel", "type": _STAMPED["false"], "typed_by": {"~stamped": _STAMPED}},
                ],
            },
        },
        "teleop_twist_joy": dict.fromkeys(("teleop_node", "teleop_twist_joy::TeleopTwistJoy"), _TELEOP_JOY),
        "ackermann_mux": {
            "ackermann_mux": {
                "subscriptions": [
                    {"named_by": "~topics.*.topic", "type": "ackermann_msgs/msg/AckermannDriveStamped"},
                    {"named_by": "~locks.*.topic", "type": "std_msgs/msg/Bool"},
                ],
            },
        },
    },
    "noetic": {
        "twist_mux": {
            "twist_mux": {
                "subscriptions": [
                    {"named_by": "~topics.*.topic", "type": "geometry_msgs/Twist"},
                    {"named_by": "~locks.*.topic", "type": "std_msgs/Bool"},
                ],
            },
        },
        "gazebo_ros": dict.fromkeys(("gazebo", "gzserver", "debug"), _GAZEBO),
        "pcl_ros": dict.fromkeys(
            (
                *("pcl/PassThrough", "pcl/VoxelGrid", "pcl/ProjectInliers", "pcl/ExtractIndices", "pcl/CropBox"),
                *("pcl/RadiusOutlierRemoval", "pcl/StatisticalOutlierRemoval"),
            ),
            _CLOUDS,
        ),
        # http://wiki.ros.org/tf#static_transform_publisher: its arguments are the transform
        "tf": {"static_transform_publisher": {"publishers": [{"name": "/tf", "type": "tf2_msgs/TFMessage"}]}},
    },
}
"""Ends that parameters name of which the source has a list, of scripts that start other programs, and of nodes that
their arguments make, or that a library of another repository does: by distribution, package and executable, component
or nodelet, in the groups of NoDL. `*` is for any name, and in ROS 1 for each item of a list; `typed_by` is the
parameter that decides the type, and the type by its value."""
STAMPED = ("enable_stamped_cmd_vel", _STAMPED)
"""A parameter of nodes of Nav2 and TurtleBot3, and what it makes of the types of velocities that they send and get:
`TwistPublisher` and `TwistSubscriber` of nav2_util."""
ADDED_PARAMETERS: Mapping[str, Mapping[str, Mapping[str, Any]]] = {
    "teleop_twist_keyboard": {
        "~stamped": {"type": "bool", "default_value": False},
        "~frame_id": {"type": "string", "default_value": ""},
        # github:ros2/teleop_twist_keyboard/pull/34
        "~speed": {"type": "double", "default_value": 0.5},
        "~turn": {"type": "double", "default_value": 1.0},
    },
    "teleop_twist_joy": {
        "~publish_stamped_twist": {"type": "bool", "default_value": False},
        "~frame": {"type": "string", "default_value": "teleop_twist_joy"},
    },
}
"""Parameters of all nodes of a package of ROS 2 that are newer than its snapshot."""
VALUES: Mapping[str, Sequence[str]] = {"data_type": ("LaserScan", "PointCloud2")}
"""What parameters of plugins have of which types depend, by the last part of their names: sources of costmaps."""
OTHER_VERSIONS = {"jazzy": {"ros-navigation/navigation2": ("humble", "kilted", "main")}}
"""By distribution further branches of a repository that are in use: a parameter that a plugin has there is no misspelt
one here."""
GENERATIONS = {"noetic": 1, "jazzy": 2}
OF_TESTS = re.compile(r"(?<!\Aros2_controllers)(?:\b|_)(?:test|tests|benchmarking|moveit_resources)(?:\b|_)")
"""Names of packages that nobody launches. The nodes of `ros2_controllers_test_nodes` are launched as they are."""
