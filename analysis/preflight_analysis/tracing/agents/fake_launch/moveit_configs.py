"""`moveit_configs_utils` and `launch_param_builder`, where MoveIt is neither installed nor in the workspace.

What they do is what moveit/moveit2 has in moveit_configs_utils/moveit_configs_utils/: moveit_configs_builder.py,
launches.py, launch_utils.py, substitutions/xacro.py. A file that is not there or cannot be read is unknown; so are the
planning pipelines that come with MoveIt itself.
"""

from __future__ import annotations

import importlib
import os
import pathlib
import re
from typing import Any, Optional

from ..anything import Anything, is_unknown
from .ament import get_package_share_directory
from .base import (
    RECORDER,
    LaunchContext,
    LaunchDescription,
    Substitution,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from .conditions import IfCondition, UnlessCondition
from .includes import IncludeLaunchDescription, PythonLaunchDescriptionSource
from .ros_nodes import Node
from .ros_parameters import ParameterValue
from .settings import DeclareLaunchArgument
from .substitutions import LaunchConfiguration

_CONFIG = "config"


def load_yaml(file_path: Any) -> Any:
    try:
        with open(file_path) as file:
            return importlib.import_module("yaml").safe_load(file)
    except Exception:
        RECORDER.unknown = True
        return Anything(f"load_yaml({os.path.basename(os.fspath(file_path))!r})")


def load_xacro(file_path: Any, mappings: Any = None) -> Any:
    try:
        return importlib.import_module("xacro").process_file(os.fspath(file_path), mappings=mappings).toxml()
    except Exception:
        RECORDER.unknown = True
        return Anything(f"load_xacro({os.path.basename(os.fspath(file_path))!r})")


class Xacro(Substitution):
    def __init__(self, file_path: Any, *, mappings: Any = None) -> None:
        self._path = normalize_to_list_of_substitutions(file_path)
        self._mappings = mappings or {}

    def perform(self, context: LaunchContext) -> str:
        def text(value: Any) -> str:
            return perform_substitutions(context, normalize_to_list_of_substitutions(value))

        given = {text(name): text(value) for name, value in self._mappings.items()}
        return str(load_xacro(text(self._path), given))


class ParameterBuilder:
    """Of `launch_param_builder`: parameters of the files of a package."""

    def __init__(self, package_name: str) -> None:
        self._package_path = pathlib.Path(get_package_share_directory(package_name))
        self._parameters: dict[str, Any] = {}

    def yaml(self, file_path: Any, parameter_namespace: Optional[str] = None) -> Any:
        return self._added(load_yaml(self._package_path / file_path), parameter_namespace)

    def file_parameter(self, parameter_name: str, file_path: Any) -> Any:
        return self.parameter(parameter_name, Anything("file_parameter"))

    def xacro_parameter(self, parameter_name: str, file_path: Any, mappings: Any = None) -> Any:
        return self.parameter(parameter_name, load_xacro(self._package_path / file_path, mappings))

    def parameter(self, parameter_name: str, parameter_value: Any) -> Any:
        return self._added({parameter_name: parameter_value}, None)

    def _added(self, values: Any, namespace: Optional[str]) -> Any:
        if namespace is None:
            self._parameters.update({**values})
        else:
            self._parameters.setdefault(namespace, {}).update({**values})
        return self

    def to_dict(self) -> dict[str, Any]:
        return self._parameters


class MoveItConfigs:
    def __init__(self, package_path: Any = None) -> None:
        self.package_path = package_path
        self.robot_description: Any = {}
        self.robot_description_semantic: Any = {}
        self.robot_description_kinematics: Any = {}
        self.planning_pipelines: Any = {}
        self.trajectory_execution: Any = {}
        self.planning_scene_monitor: Any = {}
        self.sensors_3d: Any = {}
        self.move_group_capabilities: Any = {"capabilities": "", "disable_capabilities": ""}
        self.joint_limits: Any = {}
        self.moveit_cpp: Any = {}
        self.pilz_cartesian_limits: Any = {}

    def to_dict(self) -> dict[str, Any]:
        found: dict[str, Any] = {}
        for part in (
            *(self.robot_description, self.robot_description_semantic, self.robot_description_kinematics),
            *(self.planning_pipelines, self.trajectory_execution, self.planning_scene_monitor, self.sensors_3d),
            *(self.joint_limits, self.moveit_cpp),
        ):
            found.update({**part})
        for name, limits in self.pilz_cartesian_limits.items():
            found[name] = {**found.get(name, {}), **limits}
        return found


class MoveItConfigsBuilder(ParameterBuilder):
    def __init__(
        self, robot_name: str, robot_description: str = "robot_description", package_name: Optional[str] = None
    ) -> None:
        super().__init__(package_name or f"{robot_name}_moveit_config")
        self._configs = MoveItConfigs(self._package_path)
        self._robot, self._description = robot_name, robot_description
        self._urdf, self._srdf, self._mappings = self._described()

    def _described(self) -> Any:
        """The files of URDF and SRDF, and the arguments of the former, as the package says."""
        urdf, own = None, self._package_path / _CONFIG / f"{self._robot}.urdf.xacro"
        srdf, mappings = self._package_path / _CONFIG / f"{self._robot}.srdf", None
        if own.exists():
            urdf = own
        if os.path.isfile(self._package_path / ".setup_assistant"):
            said = load_yaml(self._package_path / ".setup_assistant")
            config = said.get("moveit_setup_assistant_config", {}) if isinstance(said, dict) else {}
            of_urdf, of_srdf = (config.get(name, config.get(name.upper())) for name in ("urdf", "srdf"))
            if of_urdf:
                if urdf is None:
                    share = get_package_share_directory(of_urdf["package"])
                    urdf = pathlib.Path(share) / of_urdf["relative_path"]
                given = of_urdf.get("xacro_args")
                mappings = dict(each.split(":=") for each in given.split()) if given else None
            if of_srdf:
                srdf = self._package_path / of_srdf["relative_path"]
        return urdf or self._package_path / _CONFIG / f"{self._robot}.urdf", srdf, mappings

    def _robot_text(self, path: Any, mappings: Any) -> Any:
        if mappings is None or all(isinstance(each, str) for pair in mappings.items() for each in pair):
            return load_xacro(path, mappings)
        return ParameterValue(Xacro(os.fspath(path), mappings=mappings), value_type=str)

    def _config(self, file_path: Any, name: str) -> Any:
        return load_yaml(self._package_path / (file_path or f"{_CONFIG}/{name}.yaml"))

    def robot_description(self, file_path: Any = None, mappings: Any = None) -> Any:
        path = self._urdf if file_path is None else self._package_path / file_path
        text = self._robot_text(path, mappings or self._mappings)
        self._configs.robot_description = {self._description: text}
        return self

    def robot_description_semantic(self, file_path: Any = None, mappings: Any = None) -> Any:
        text = self._robot_text(self._package_path / (file_path or self._srdf), mappings)
        self._configs.robot_description_semantic = {f"{self._description}_semantic": text}
        return self

    def robot_description_kinematics(self, file_path: Any = None) -> Any:
        found = self._config(file_path, "kinematics")
        self._configs.robot_description_kinematics = {f"{self._description}_kinematics": found}
        return self

    def joint_limits(self, file_path: Any = None) -> Any:
        self._configs.joint_limits = {f"{self._description}_planning": self._config(file_path, "joint_limits")}
        return self

    def pilz_cartesian_limits(self, file_path: Any = None) -> Any:
        found = self._config(file_path, "pilz_cartesian_limits")
        self._configs.pilz_cartesian_limits = {f"{self._description}_planning": found}
        return self

    def moveit_cpp(self, file_path: Any = None) -> Any:
        self._configs.moveit_cpp = self._config(file_path, "moveit_cpp")
        return self

    def trajectory_execution(self, file_path: Any = None, moveit_manage_controllers: bool = True) -> Any:
        found: Any = {"moveit_manage_controllers": moveit_manage_controllers}
        names = self._named("_controllers.yaml")
        likely = [name for name in ("moveit", "moveit2", self._robot) if name in names] or names
        if file_path is None and likely:
            file_path = f"{_CONFIG}/{likely[0]}_controllers.yaml"
        if file_path is not None:
            found.update({**load_yaml(self._package_path / file_path)})
        self._configs.trajectory_execution = found
        return self

    def planning_scene_monitor(
        self,
        publish_planning_scene: bool = True,
        publish_geometry_updates: bool = True,
        publish_state_updates: bool = True,
        publish_transforms_updates: bool = True,
        publish_robot_description: bool = False,
        publish_robot_description_semantic: bool = False,
    ) -> Any:
        self._configs.planning_scene_monitor = {
            "publish_planning_scene": publish_planning_scene,
            "publish_geometry_updates": publish_geometry_updates,
            "publish_state_updates": publish_state_updates,
            "publish_transforms_updates": publish_transforms_updates,
            "publish_robot_description": publish_robot_description,
            "publish_robot_description_semantic": publish_robot_description_semantic,
        }
        return self

    def sensors_3d(self, file_path: Any = None) -> Any:
        path = self._package_path / (file_path or f"{_CONFIG}/sensors_3d.yaml")
        if path.exists():
            found = load_yaml(path)
            if isinstance(found, Anything) or any((found.get("sensors") or [None])[:1]):
                self._configs.sensors_3d = found
        return self

    def planning_pipelines(
        self, default_planning_pipeline: Optional[str] = None, pipelines: Any = None, load_all: bool = True
    ) -> Any:
        own = self._named("_planning.yaml")
        if pipelines is None and (load_all or not own):
            RECORDER.unknown = True  # MoveIt's own ones come besides
            self._configs.planning_pipelines = Anything("planning_pipelines")
            return self
        named = list(own if pipelines is None else pipelines)
        default = default_planning_pipeline or ("ompl" if "ompl" in named else named[0])
        self._configs.planning_pipelines = {"planning_pipelines": named, "default_planning_pipeline": default}
        for name in named:
            self._configs.planning_pipelines[name] = self._config(None, f"{name}_planning")
        return self

    def _named(self, end: str) -> list[str]:
        """What comes before the end of a file's name in the folder of the configuration."""
        try:
            names = os.listdir(self._package_path / _CONFIG)
        except OSError:
            return []
        return sorted(name[: -len(end)] for name in names if name.endswith(end))

    def to_moveit_configs(self) -> MoveItConfigs:
        for name in (
            *("robot_description", "robot_description_semantic", "robot_description_kinematics"),
            *("planning_pipelines", "trajectory_execution", "planning_scene_monitor", "sensors_3d", "joint_limits"),
        ):
            if not getattr(self._configs, name):
                getattr(self, name)()
        return self._configs

    def to_dict(self, include_moveit_configs: bool = True) -> dict[str, Any]:
        if include_moveit_configs:
            self._parameters.update(self.to_moveit_configs().to_dict())
        return self._parameters


# moveit_configs_utils.launch_utils


class DeclareBooleanLaunchArg(DeclareLaunchArgument):
    def __init__(self, name: str, *, default_value: Any = False, description: Any = None, **kwargs: Any) -> None:
        choices = ["true", "false", "True", "False"]
        super().__init__(name, default_value=str(default_value), description=description, choices=choices, **kwargs)


def add_debuggable_node(
    ld: LaunchDescription,
    package: Any,
    executable: Any,
    condition_name: str = "debug",
    commands_file: Any = None,
    extra_debug_args: Any = None,
    **kwargs: Any,
) -> None:
    debug = LaunchConfiguration(condition_name)
    ld.add_action(Node(package=package, executable=executable, condition=UnlessCondition(debug), **kwargs))
    words = [*(kwargs.pop("arguments", None) or ()), *(extra_debug_args or ())] or None
    prefix = [f"gdb {f'-x {commands_file} ' if commands_file else ''}--ex run --args"]
    condition = IfCondition(debug)
    ld.add_action(
        Node(package=package, executable=executable, condition=condition, prefix=prefix, arguments=words, **kwargs)
    )


# moveit_configs_utils.launches


def generate_rsp_launch(moveit_config: Any) -> LaunchDescription:
    rate = {"publish_frequency": LaunchConfiguration("publish_frequency")}
    node = Node(
        package="robot_state_publisher",
        executable="robot_state_publisher",
        respawn=True,
        output="screen",
        parameters=[moveit_config.robot_description, rate],
    )
    return LaunchDescription([DeclareLaunchArgument("publish_frequency", default_value="15.0"), node])


def generate_moveit_rviz_launch(moveit_config: Any) -> LaunchDescription:
    config = str(moveit_config.package_path / "config/moveit.rviz")
    ld = LaunchDescription(
        [DeclareBooleanLaunchArg("debug"), DeclareLaunchArgument("rviz_config", default_value=config)]
    )
    add_debuggable_node(
        ld,
        package="rviz2",
        executable="rviz2",
        output="log",
        respawn=False,
        arguments=["-d", LaunchConfiguration("rviz_config")],
        parameters=[
            moveit_config.planning_pipelines,
            moveit_config.robot_description_kinematics,
            moveit_config.joint_limits,
        ],
    )
    return ld


def generate_setup_assistant_launch(moveit_config: Any) -> LaunchDescription:
    ld = LaunchDescription([DeclareBooleanLaunchArg("debug")])
    words = [["--config_pkg=", str(moveit_config.package_path)]]
    add_debuggable_node(ld, package="moveit_setup_assistant", executable="moveit_setup_assistant", arguments=words)
    return ld


_JOINT = re.compile(r"<virtual_joint\b([^<>]{,2000})>")
_ATTRIBUTE = re.compile(r"""(\w+)\s*=\s*["']([^"']*)["']""")


def generate_static_virtual_joint_tfs_launch(moveit_config: Any) -> LaunchDescription:
    texts = [*moveit_config.robot_description_semantic.values()]
    ld = LaunchDescription(
        [Anything("a virtual joint") for each in texts if not isinstance(each, str) or is_unknown(each)]
    )
    texts = [each for each in texts if isinstance(each, str)]
    joints = [dict(_ATTRIBUTE.findall(each)) for text in texts for each in _JOINT.findall(text)]
    for number, joint in enumerate(joints):
        frames = ["--frame-id", joint.get("parent_frame", ""), "--child-frame-id", joint.get("child_link", "")]
        ld.add_action(
            Node(
                package="tf2_ros",
                executable="static_transform_publisher",
                name=f"static_transform_publisher{number}",
                output="log",
                arguments=frames,
            )
        )
    return ld


def generate_spawn_controllers_launch(moveit_config: Any) -> LaunchDescription:
    manager = moveit_config.trajectory_execution.get("moveit_simple_controller_manager", {})
    names = [*manager.get("controller_names", []), "joint_state_broadcaster"]
    return LaunchDescription(
        [Node(package="controller_manager", executable="spawner", arguments=[name], output="screen") for name in names]
    )


def generate_warehouse_db_launch(moveit_config: Any) -> LaunchDescription:
    given = {
        "moveit_warehouse_database_path": str(moveit_config.package_path / "default_warehouse_mongo_db"),
        "moveit_warehouse_port": "33829",
        "moveit_warehouse_host": "localhost",
    }
    path, port, host = (LaunchConfiguration(name) for name in given)
    database = {
        "overwrite": False,
        "database_path": path,
        "warehouse_port": port,
        "warehouse_host": host,
        "warehouse_exec": "mongod",
        "warehouse_plugin": "warehouse_ros_mongo::MongoDatabaseConnection",
    }
    return LaunchDescription(
        [
            *(DeclareLaunchArgument(name, default_value=value) for name, value in given.items()),
            DeclareBooleanLaunchArg("reset"),
            Node(package="warehouse_ros_mongo", executable="mongo_wrapper_ros.py", parameters=[database]),
            Node(
                package="moveit_ros_warehouse",
                executable="moveit_init_demo_warehouse",
                output="screen",
                condition=IfCondition(LaunchConfiguration("reset")),
            ),
        ]
    )


def generate_move_group_launch(moveit_config: Any) -> LaunchDescription:
    capabilities = moveit_config.move_group_capabilities
    ld = LaunchDescription(
        [
            DeclareBooleanLaunchArg("debug"),
            DeclareBooleanLaunchArg("allow_trajectory_execution", default_value=True),
            DeclareBooleanLaunchArg("publish_monitored_planning_scene", default_value=True),
            *(
                DeclareLaunchArgument(n, default_value=capabilities[n])
                for n in ("capabilities", "disable_capabilities")
            ),
            DeclareBooleanLaunchArg("monitor_dynamics"),
        ]
    )
    published = LaunchConfiguration("publish_monitored_planning_scene")
    given = {
        "publish_robot_description_semantic": True,
        "allow_trajectory_execution": LaunchConfiguration("allow_trajectory_execution"),
        "capabilities": ParameterValue(LaunchConfiguration("capabilities"), value_type=str),
        "disable_capabilities": ParameterValue(LaunchConfiguration("disable_capabilities"), value_type=str),
        "publish_planning_scene": published,
        "publish_geometry_updates": published,
        "publish_state_updates": published,
        "publish_transforms_updates": published,
        "monitor_dynamics": False,
    }
    add_debuggable_node(
        ld,
        package="moveit_ros_move_group",
        executable="move_group",
        commands_file=str(moveit_config.package_path / "launch/gdb_settings.gdb"),
        output="screen",
        parameters=[moveit_config.to_dict(), given],
        extra_debug_args=["--debug"],
        additional_env={"DISPLAY": os.environ.get("DISPLAY", "")},
    )
    return ld


def generate_demo_launch(moveit_config: Any, launch_package_path: Any = None) -> LaunchDescription:
    folder = pathlib.Path(launch_package_path or moveit_config.package_path) / "launch"

    def included(name: str, **kwargs: Any) -> Any:
        return IncludeLaunchDescription(PythonLaunchDescriptionSource(str(folder / f"{name}.launch.py")), **kwargs)

    static = (folder / "static_virtual_joint_tfs.launch.py").exists()
    return LaunchDescription(
        [
            DeclareBooleanLaunchArg("db"),
            DeclareBooleanLaunchArg("debug"),
            DeclareBooleanLaunchArg("use_rviz", default_value=True),
            *([included("static_virtual_joint_tfs")] if static else []),
            included("rsp"),
            included("move_group"),
            included("moveit_rviz", condition=IfCondition(LaunchConfiguration("use_rviz"))),
            included("warehouse_db", condition=IfCondition(LaunchConfiguration("db"))),
            Node(
                package="controller_manager",
                executable="ros2_control_node",
                parameters=[str(moveit_config.package_path / "config/ros2_controllers.yaml")],
                remappings=[("/controller_manager/robot_description", "/robot_description")],
            ),
            included("spawn_controllers"),
        ]
    )


LAUNCHES = {name: each for name, each in vars().copy().items() if name.startswith("generate_")}
