"""Modules of Python that are not followed and of which it is known that they make no topics by themselves."""

from __future__ import annotations

import re
import sys

_INTERFACES = re.compile(r"\.(?:msg|srv|action|cfg)(?:\.|\Z)")
_WITHOUT_ENDS = sys.stdlib_module_names | {
    # those of ROS that its readers know, or that only compute
    "actionlib", "ament_index_python", "angles", "catkin", "cv_bridge", "dynamic_reconfigure", "genpy",
    "image_geometry", "laser_geometry", "message_filters", "rcl_interfaces", "rclpy", "ros_numpy", "rosgraph",
    "roslib", "rospkg", "rospy", "sensor_msgs", "sensor_msgs_py", "tf", "tf2_geometry_msgs", "tf2_msgs", "tf2_py",
    "tf2_ros", "tf_transformations", "transformations", "urdf_parser_py", "xacro",
    # what nodes use of the rest of the world
    "PIL", "RPi", "Xlib", "astropy", "attr", "can", "casadi", "cvxpy", "cv2", "dateutil", "face_recognition",
    "filterpy", "future", "geographiclib", "geopy", "imutils", "keras", "lxml", "matplotlib", "mediapipe",
    "mpl_toolkits", "networkx", "numba", "numpy", "onnxruntime", "open3d", "pandas", "psutil", "pyaudio",
    "pydantic", "pygame", "pylab", "pynput", "pyproj", "pyquaternion", "pyrealsense2", "requests", "rtree", "scipy",
    "serial", "setproctitle", "shapely", "simple_pid", "six", "skimage", "sklearn", "smbus", "smbus2",
    "speech_recognition", "spidev", "sympy", "tensorflow", "termcolor", "tkinter", "torch", "torchvision", "tqdm",
    "transforms3d", "trimesh", "ultralytics", "usb", "utm", "websocket", "yaml", "zmq",
}  # fmt: skip


def makes_no_ends(path: str) -> bool:
    """Whether nothing of a dotted name makes topics, services or parameters in a way that is not known here."""
    return path.partition(".")[0] in _WITHOUT_ENDS or _INTERFACES.search(path) is not None
