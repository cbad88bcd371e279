"""Headers of C++ that are not there and of which it is known that nothing in them makes topics by itself."""

from __future__ import annotations

from preflight_analysis.source import rclcpp_api, roscpp_api
from preflight_analysis.source.cpp_program import CppProgram

_INTERFACES = ("_msgs", "_srvs", "_interfaces", "_actions", "_msg", "_srv")
_WITHOUT_ENDS = rclcpp_api.HARMLESS | roscpp_api.HARMLESS | {
    # of ROS: what only computes, or belongs to the client library
    "ament_index_cpp", "angles", "costmap_2d", "cv_bridge", "eigen_conversions", "geometric_shapes", "grid_map_core",
    "image_geometry", "kdl", "kdl_conversions", "kdl_parser", "laser_geometry", "octomap", "pcl", "pcl_conversions",
    "rcl", "rclcpp_action", "rcpputils", "rcutils", "resource_retriever", "rmw", "roscpp", "rosconsole",
    "rosidl_runtime_cpp", "tf2_eigen", "tf2_eigen_kdl", "tf2_geometry_msgs", "tf2_kdl", "tf2_sensor_msgs",
    "tf_conversions", "tracetools", "xmlrpcpp",
    # of the rest of the world
    "Eigen", "GL", "GeographicLib", "SDL2", "X11", "arpa", "asm", "bits", "ceres", "eigen3", "fcl", "fmt", "g2o",
    "geographiclib", "gtest", "gtsam", "jsoncpp", "libusb-1.0", "librealsense2", "linux", "modbus", "net", "netinet",
    "nlohmann", "opencv", "opencv2", "orocos_kdl", "qpOASES", "sophus", "spdlog", "sys", "urdf_model", "urdf_parser",
    "xtensor", "yaml-cpp",
}  # fmt: skip


def may_hide_ends(program: CppProgram) -> bool:
    """Whether a header is included that is not there, of a library of which nothing is known: its objects may make
    topics, services and parameters of their own."""
    there = [file.path for file in program.files]
    for include in program.includes:
        library = include.partition("/")[0]
        known = library in _WITHOUT_ENDS or library.endswith(_INTERFACES) or library.startswith(("tf2", "rclcpp"))
        if "/" in include and not known and not any(path.endswith(f"/{include}") for path in there):
            return True
    return False
