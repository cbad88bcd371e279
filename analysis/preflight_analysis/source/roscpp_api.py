"""Tables of what roscpp and the libraries beside it make: the topics, services and parameters of each class."""

from __future__ import annotations

from collections.abc import Mapping

from preflight_analysis.tracing.interface import Role

LIBRARIES = frozenset(
    {
        "actionlib",
        "camera_info_manager",
        "diagnostic_updater",
        "dynamic_reconfigure",
        "image_transport",
        "interactive_markers",
        "message_filters",
        "nodelet",
        "pluginlib",
        "realtime_tools",
        "ros",
        "tf",
        "tf2",
        "tf2_ros",
        "topic_tools",
        "urdf",
    }
)
"""The packages whose calls are known here."""
HARMLESS = frozenset({"boost", "std", *LIBRARIES})
"""Namespaces of libraries that may get a handle and make nothing with it that is not known here."""

_TF = "tf2_msgs/TFMessage"
IMAGE, INFO = "sensor_msgs/Image", "sensor_msgs/CameraInfo"
_LISTENS: tuple[tuple[Role, str, str], ...] = (("subscriber", "/tf", _TF), ("subscriber", "/tf_static", _TF))
HANDLE = "ros::NodeHandle"

FIXED: Mapping[str, tuple[tuple[Role, str, str], ...]] = {
    "tf::TransformListener": _LISTENS,
    "tf2_ros::TransformListener": _LISTENS,
    "tf::TransformBroadcaster": (("publisher", "/tf", _TF),),
    "tf2_ros::TransformBroadcaster": (("publisher", "/tf", _TF),),
    "tf2_ros::StaticTransformBroadcaster": (("publisher", "/tf_static", _TF),),
    "diagnostic_updater::Updater": (("publisher", "/diagnostics", "diagnostic_msgs/DiagnosticArray"),),
}
AT_HANDLE: Mapping[str, tuple[str, tuple[tuple[Role, str, str], ...]]] = {
    "dynamic_reconfigure::Server": (
        "~",
        (
            ("service", "set_parameters", "dynamic_reconfigure/Reconfigure"),
            ("publisher", "parameter_descriptions", "dynamic_reconfigure/ConfigDescription"),
            ("publisher", "parameter_updates", "dynamic_reconfigure/Config"),
        ),
    ),
    "camera_info_manager::CameraInfoManager": (
        "",
        (("service", "set_camera_info", "sensor_msgs/SetCameraInfo"),),
    ),
}
"""The namespace where no handle is given, and what is made in that of the handle."""

ACTIONS: Mapping[str, Role] = {
    "actionlib::SimpleActionServer": "action_server",
    "actionlib::ActionServer": "action_server",
    "actionlib::SimpleActionClient": "action_client",
    "actionlib::ActionClient": "action_client",
}
MARKERS: tuple[tuple[Role, str, str], ...] = (
    ("publisher", "update", "visualization_msgs/InteractiveMarkerUpdate"),
    ("publisher", "update_full", "visualization_msgs/InteractiveMarkerInit"),
    ("subscriber", "feedback", "visualization_msgs/InteractiveMarkerFeedback"),
)
LOADER = (
    ("load_nodelet", "nodelet/NodeletLoad"),
    ("unload_nodelet", "nodelet/NodeletUnload"),
    ("list", "nodelet/NodeletList"),
)
NODELET_HANDLES = {
    "getNodeHandle": "",
    "getMTNodeHandle": "",
    "getPrivateNodeHandle": "~",
    "getMTPrivateNodeHandle": "~",
}
PARAMS = {
    "param": "get",
    "getParam": "get",
    "getParamCached": "get",
    "hasParam": "has",
    "searchParam": "search",
    "setParam": "set",
    "deleteParam": "delete",
    "get": "get",
    "getCached": "get",
    "has": "has",
    "search": "search",
    "set": "set",
    "del": "delete",
}
FREE_PARAMS = frozenset({"param", "get", "getCached", "has", "search", "set", "del"})
ANY_MESSAGE = frozenset({"topic_tools::ShapeShifter", "ShapeShifter"})
