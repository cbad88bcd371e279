"""`launch_pal`, for where it is not installed. What each does is what pal-robotics/launch_pal has in `launch_pal/`:
arg_utils.py, include_utils.py, param_utils.py, composition_utils.py, robot_arguments/ and actions/.
"""

from __future__ import annotations

import importlib
import re
import tempfile
from dataclasses import dataclass, fields
from typing import Any, Iterator, Optional

from ..anything import Anything
from .actions import GroupAction, LogInfo
from .ament import PackageNotFoundError, get_package_share_directory
from .base import LaunchContext, LaunchDescription, TextSubstitution
from .includes import IncludeLaunchDescription, PythonLaunchDescriptionSource
from .ros_nodes import ComposableNode
from .ros_settings import PushROSNamespace
from .ros_substitutions import FindPackageShare
from .settings import DeclareLaunchArgument
from .substitutions import LaunchConfiguration, PathJoinSubstitution

_PACKAGE = re.compile(r"\$\{find ([^}]+)\}")
_VARIABLE = re.compile(r"\$\{([^}|]+)(?:\|([^}]*))?\}")
_BOOLEAN = ("True", "False")


def _load(path: Any) -> Any:
    with open(path) as file:
        return importlib.import_module("yaml").safe_load(file)


def _written(data: Any) -> str:
    """The path of a new file with these data."""
    if isinstance(data, Anything):
        return str(data)
    with tempfile.NamedTemporaryFile("w", delete=False) as file:
        importlib.import_module("yaml").dump(data, file)
    return file.name


# arg_utils


class LaunchArgCreator:
    def __init__(self) -> None:
        self.launch_arguments: dict[str, Any] = {}

    def from_yaml(self, yaml_file: str) -> None:
        self.launch_arguments = {name: DeclareLaunchArgument(name, **about) for name, about in _load(yaml_file).items()}

    def get_argument(self, arg_name: str) -> Any:
        if arg_name not in self.launch_arguments:
            raise KeyError(f"Launch argument {arg_name} does not exist")
        return self.launch_arguments[arg_name]


def parse_launch_args_from_yaml(yaml_file: str) -> LaunchArgCreator:
    made = LaunchArgCreator()
    made.from_yaml(yaml_file)
    return made


@dataclass(frozen=True)
class LaunchArgumentsBase:
    def add_to_launch_description(self, launch_description: LaunchDescription) -> None:
        for each in fields(self):
            launch_description.add_action(getattr(self, each.name))


def read_launch_argument(arg_name: str, context: LaunchContext) -> str:
    return LaunchConfiguration(arg_name).perform(context)


# include_utils


def include_launch_py_description(pkg_name: Any, paths: Any, **kwargs: Any) -> Any:
    path = PathJoinSubstitution([FindPackageShare(pkg_name), *paths])
    return IncludeLaunchDescription(PythonLaunchDescriptionSource(path), **kwargs)


def include_scoped_launch_py_description(
    pkg_name: Any,
    paths: Any,
    launch_arguments: Optional[dict[str, Any]] = None,
    env_vars: Any = (),
    condition: Any = None,
    namespace: Any = None,
    **kwargs: Any,
) -> Any:
    declared: list[Any] = []
    passed: dict[str, Any] = {}
    for name, value in (launch_arguments or {}).items():
        is_declared = isinstance(value, DeclareLaunchArgument)
        passed[name] = LaunchConfiguration(value.name) if is_declared else value
        if is_declared and value.name != name:
            declared.append(value)
    passed = get_nested_launch_configurations(passed)
    include = include_launch_py_description(pkg_name, paths, launch_arguments=passed.items(), **kwargs)
    pushed = [PushROSNamespace(namespace)] if namespace else []
    return GroupAction(
        [*pushed, *env_vars, *declared, include], forwarding=False, condition=condition, launch_configurations=passed
    )


def get_nested_launch_configurations(configuration_list: dict[str, Any]) -> dict[str, Any]:
    found = dict(configuration_list)
    for value in configuration_list.values():
        for each in _parts(getattr(value, "substitutions", ())):
            if isinstance(each, LaunchConfiguration):
                name = "".join(part.text for part in each.variable_name if isinstance(part, TextSubstitution))
                found.setdefault(name, each)
    return found


def _parts(parts: Any) -> Iterator[Any]:
    for each in parts if isinstance(parts, (list, tuple)) else ():
        if isinstance(each, (list, tuple)):
            yield from _parts(each)
        else:
            yield each
            yield from _parts(getattr(each, "expression", ()))


# param_utils


def merge_param_files(yaml_files: Any) -> str:
    """The path of one file with what all have: of the same key the last one's."""
    merged: dict[str, Any] = {}
    for each in yaml_files:
        path, prefix = (each, None) if isinstance(each, str) else each
        data = _load(path)
        if isinstance(data, Anything):
            return str(data)
        _merge(merged, insert_ros_param_prefix(data, prefix) if prefix else data)
    return _written(merged)


def _merge(into: dict[str, Any], data: dict[str, Any]) -> None:
    for key, value in data.items():
        if isinstance(value, dict) and isinstance(into.get(key), dict):
            _merge(into[key], value)
        else:
            into[key] = value


def insert_ros_param_prefix(data: Any, prefix: str) -> Any:
    if not isinstance(data, dict):
        return data
    return {k: {prefix: v} if k == "ros__parameters" else insert_ros_param_prefix(v, prefix) for k, v in data.items()}


def substitute_variables(file_path: str, variables: dict[str, Any], ld: Any = None) -> tuple[Any, dict[str, Any]]:
    matched: dict[str, Any] = {}

    def package(found: Any) -> Any:
        try:
            matched[found[0]] = get_package_share_directory(found[1])
        except PackageNotFoundError:
            return ""
        return matched[found[0]]

    def variable(found: Any) -> str:
        value = variables.get(found[1].strip())
        value = found[2] if value is None else value
        if value is None:
            return ""
        matched[found[0]] = value
        return str(value)

    with open(file_path) as file:
        text = _VARIABLE.sub(variable, _PACKAGE.sub(package, file.read()))
    return importlib.import_module("yaml").safe_load(text), matched


def parse_parametric_yaml(source_files: Any, param_rewrites: dict[str, Any], ld: Any = None) -> str:
    found: dict[str, Any] = {}
    for each in source_files:
        data, _ = substitute_variables(each, param_rewrites)
        if isinstance(data, Anything):
            return str(data)
        found.update(data)
    return _written(found)


# composition_utils


def generate_component_list(yaml_file: str, namespace: Any = None) -> list[Any]:
    return [
        ComposableNode(
            package=about["package"],
            plugin=f"{about['package']}::{about['type']}",
            name=name,
            namespace=namespace,
            parameters=[about["ros__parameters"]],
        )
        for name, about in _load(yaml_file).get("components", {}).items()
    ]


# robot_arguments


_ROBOTS = ("pmb2", "tiago", "tiago_dual", "pmb3", "ari", "omni_base", "stockbot", "tiago_pro", "talos", "kangaroo")
_COMMON: dict[str, tuple[str, Optional[tuple[str, ...]]]] = {
    "use_sim_time": ("False", _BOOLEAN),
    "namespace": ("", None),
    "robot_name": ("pmb2", _ROBOTS),
    "navigation": ("False", _BOOLEAN),
    "advanced_navigation": ("False", _BOOLEAN),
    "side": ("", None),
    "docking": ("False", _BOOLEAN),
    "moveit": ("True", _BOOLEAN),
    "slam": ("False", None),
    "world_name": ("pal_office", None),
    "gazebo_version": ("classic", ("gazebo", "classic")),
    "gzclient": ("True", _BOOLEAN),
    "rviz": ("True", _BOOLEAN),
    "map_name": ("default_map", None),
    "is_public_sim": ("False", _BOOLEAN),
    "use_sensor_manager": ("False", _BOOLEAN),
    "tuck_arm": ("True", _BOOLEAN),
    **dict.fromkeys(("x", "y", "z", "roll", "pitch", "yaw"), ("0.0", None)),
    "sim_type": ("gazebo", ("mujoco-ros2-control", "mujoco", "gazebo", "no-simulation")),
    "mj_control": ("position", ("false", "position", "motor")),
    "mj_initial_pose": ("home", ("start", "home", "teleop")),
}
_OF_ARMS = ("arm_type", "end_effector", "ft_sensor", "wrist_model", "tool_changer")
_OF_ROBOT = (
    *(f"{name}{side}" for name in _OF_ARMS for side in ("", "_right", "_left")),
    *("base_type", "wheel_model", "laser_model", "camera_model", "has_screen", "robot_model"),
)


class CommonArgs:
    """Arguments by their names, with default and choices."""


class RobotArgs:
    """Arguments by their names."""


for _name, (_default, _choices) in _COMMON.items():
    setattr(CommonArgs, _name, DeclareLaunchArgument(_name, default_value=_default, choices=_choices))
for _name in _OF_ROBOT:
    setattr(RobotArgs, _name, DeclareLaunchArgument(_name))


# actions


class CheckPublicSim(LogInfo):
    """Says at last that an argument has to be another one, which starts nothing."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(msg="", **kwargs)


class ValidateLaunchArgs(CheckPublicSim):
    """Ends the launch where the command line has an argument that is not declared."""

    def __init__(self, *, launch_args: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
