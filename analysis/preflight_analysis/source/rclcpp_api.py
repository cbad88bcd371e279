"""The classes, functions and methods of rclcpp and of the libraries beside it that make something."""

from __future__ import annotations

from collections.abc import Mapping

from preflight_analysis.tracing.interface import Role

LIBRARIES = frozenset(
    {
        "camera_info_manager",
        "class_loader",
        "controller_interface",
        "diagnostic_updater",
        "image_transport",
        "message_filters",
        "pluginlib",
        "rclcpp",
        "rclcpp_action",
        "rclcpp_components",
        "rclcpp_lifecycle",
        "tf2",
        "tf2_ros",
    }
)
"""The packages whose calls are known here."""

CONTROLLERS = frozenset(
    f"controller_interface::{name}" for name in ("ControllerInterface", "ChainableControllerInterface")
)
"""Of ros2_control: each has a node of its own with a lifecycle, and stands for it here."""
PLUGINS: Mapping[str, str] = {
    **dict.fromkeys(
        (
            *(f"nav2_core::{name}" for name in ("Behavior", "Controller", "GlobalPlanner", "Smoother")),
            *(f"opennav_docking_core::{name}" for name in ("ChargingDock", "NonChargingDock")),
            *(f"nav2_route::{name}" for name in ("EdgeCostFunction", "RouteOperation")),
        ),
        "configure",
    ),
    **dict.fromkeys(
        (
            *(f"nav2_core::{name}" for name in ("GoalChecker", "ProgressChecker", "WaypointTaskExecutor")),
            "nav2_costmap_2d::Layer",
            "dwb_core::TrajectoryCritic",
            "dwb_core::TrajectoryGenerator",
        ),
        "initialize",
    ),
    **dict.fromkeys(("mppi::critics::CriticFunction", "nav2_core::NavigatorBase"), "on_configure"),
}
"""The base classes of plugins that get a node and the name below which they declare its parameters, and by which of
their methods."""
CONTAINER = "rclcpp_components::ComponentManager"
NODES: Mapping[str, bool] = {
    "rclcpp::Node": False,
    CONTAINER: False,
    "rclcpp_lifecycle::LifecycleNode": True,
    "nav2_util::LifecycleNode": True,
    "nav2::LifecycleNode": True,
    **dict.fromkeys(CONTROLLERS, True),
}
"""The classes of nodes, and whether they have a lifecycle."""
TRANSITIONS = ("on_init", "on_configure", "on_activate")
"""What a node with a lifecycle does until it works; `on_init` is that of controllers."""
HARMLESS = frozenset({"autoware_utils", "bond", "std", *LIBRARIES})
"""Namespaces of libraries that may get a node and declare none of its parameters in a way not known here."""
LOADERS = frozenset({"pluginlib::ClassLoader"})

LIFECYCLE = (
    ("~/change_state", "lifecycle_msgs/srv/ChangeState"),
    ("~/get_state", "lifecycle_msgs/srv/GetState"),
    ("~/get_available_states", "lifecycle_msgs/srv/GetAvailableStates"),
    ("~/get_available_transitions", "lifecycle_msgs/srv/GetAvailableTransitions"),
    ("~/get_transition_graph", "lifecycle_msgs/srv/GetAvailableTransitions"),
)
"""The services that every node with a lifecycle offers."""
LOADING = tuple(
    (f"~/_container/{name}", f"composition_interfaces/srv/{type_}")
    for name, type_ in (("load_node", "LoadNode"), ("unload_node", "UnloadNode"), ("list_nodes", "ListNodes"))
)
"""The services that every container of components offers."""
TF = "tf2_msgs/msg/TFMessage"
LISTENS: tuple[tuple[Role, str, str], ...] = (("subscriber", "/tf", TF), ("subscriber", "/tf_static", TF))
MOVE_GROUP = "moveit::planning_interface::MoveGroupInterface"
FIXED: Mapping[str, tuple[tuple[Role, str, str], ...]] = {
    "tf2_ros::TransformListener": LISTENS,
    "tf2_ros::TransformBroadcaster": (("publisher", "/tf", TF),),
    "tf2_ros::StaticTransformBroadcaster": (("publisher", "/tf_static", TF),),
    "diagnostic_updater::Updater": (("publisher", "/diagnostics", "diagnostic_msgs/msg/DiagnosticArray"),),
    MOVE_GROUP: (
        ("publisher", "trajectory_execution_event", "std_msgs/msg/String"),
        ("publisher", "attached_collision_object", "moveit_msgs/msg/AttachedCollisionObject"),
        ("action_client", "move_action", "moveit_msgs/action/MoveGroup"),
        ("action_client", "execute_trajectory", "moveit_msgs/action/ExecuteTrajectory"),
        ("client", "query_planner_interface", "moveit_msgs/srv/QueryPlannerInterfaces"),
        ("client", "get_planner_params", "moveit_msgs/srv/GetPlannerParams"),
        ("client", "set_planner_params", "moveit_msgs/srv/SetPlannerParams"),
        ("client", "compute_cartesian_path", "moveit_msgs/srv/GetCartesianPath"),
    ),
    "camera_info_manager::CameraInfoManager": (("service", "~/set_camera_info", "sensor_msgs/srv/SetCameraInfo"),),
}
IMAGE, INFO = "sensor_msgs/msg/Image", "sensor_msgs/msg/CameraInfo"

METHODS: Mapping[str, tuple[Role, str]] = {
    "create_publisher": ("publisher", "msg"),
    "create_subscription": ("subscriber", "msg"),
    "create_service": ("service", "srv"),
    "create_client": ("client", "srv"),
}
"""Of a node: the role and the kind of its type. The name comes first; topics have their QoS next."""
GENERIC: Mapping[str, Role] = {"create_generic_publisher": "publisher", "create_generic_subscription": "subscriber"}
WITH_NODE: Mapping[str, tuple[Role, str]] = {
    "rclcpp::create_publisher": ("publisher", "msg"),
    "rclcpp::create_subscription": ("subscriber", "msg"),
    "rclcpp::create_service": ("service", "srv"),
    "rclcpp::create_client": ("client", "srv"),
    "rclcpp_action::create_server": ("action_server", "action"),
    "rclcpp_action::create_client": ("action_client", "action"),
    "message_filters::Subscriber": ("subscriber", "msg"),
    "autoware_utils::InterProcessPollingSubscriber": ("subscriber", "msg"),
    "nav2_util::SimpleActionServer": ("action_server", "action"),
    "nav2_util::ServiceClient": ("client", "srv"),
}
"""Functions and classes that get a node among their arguments; the name is the first text."""
IMAGES: Mapping[str, tuple[Role, bool]] = {
    "create_publisher": ("publisher", False),
    "create_subscription": ("subscriber", False),
    "create_camera_publisher": ("publisher", True),
    "create_camera_subscription": ("subscriber", True),
    "advertise": ("publisher", False),
    "subscribe": ("subscriber", False),
    "advertiseCamera": ("publisher", True),
    "subscribeCamera": ("subscriber", True),
}
"""Of image_transport: the role, and whether a camera's info goes with the image."""

DECLARE_FUNCTIONS = frozenset(
    {
        "declare_parameter_if_not_declared",
        "declare_or_get_parameter",
        "get_or_declare_parameter",
        "getOrDeclareParameter",
    }
)
"""Of nav2_util, nav2_ros_common, rclcpp and Autoware: they get the node, then what `declare_parameter` gets."""
DECLARE = DECLARE_FUNCTIONS | {"declare_parameter"}
CONSTANTS = {"bond::msg::Constants::DISABLE_HEARTBEAT_TIMEOUT_PARAM": "bond_disable_heartbeat_timeout"}
ADD_ARGUMENT = "replaceOrAddArgument"
"""Of nav2_util and nav2_ros_common: the arguments of a node in the node's process."""
ITSELF = frozenset({"shared_from_this", "weak_from_this", "get_node"})
