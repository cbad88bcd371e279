"""Small helpers that launch files import from packages which need not be here.

What each does is what these files have: ros-controls/ros2_control, controller_manager/controller_manager/
launch_utils.py; pal-robotics/launch_pal, launch_pal/include_utils.py, arg_utils.py and param_utils.py.
"""

from __future__ import annotations

import importlib
import tempfile
from typing import Any

from ..anything import Anything
from .base import LaunchContext, LaunchDescription
from .includes import IncludeLaunchDescription, PythonLaunchDescriptionSource
from .ros_nodes import Node
from .ros_substitutions import FindPackageShare
from .settings import DeclareLaunchArgument
from .substitutions import LaunchConfiguration, PathJoinSubstitution, PythonExpression

# controller_manager.launch_utils


def generate_controllers_spawner_launch_description(
    controller_names: Any, controller_params_files: Any = None, extra_spawner_args: Any = ()
) -> LaunchDescription:
    words = [*controller_names, "--controller-manager", LaunchConfiguration("controller_manager_name")]
    for file in controller_params_files or ():
        words += ["--param-file", file] if file else []
    unload = LaunchConfiguration("unload_on_kill")
    words.append(PythonExpression(['"--unload-on-kill" if "true" == "', unload, '" else ""']))
    spawner = Node(package="controller_manager", executable="spawner", arguments=[*words, *extra_spawner_args])
    return LaunchDescription(
        [
            DeclareLaunchArgument("controller_manager_name", default_value="controller_manager"),
            DeclareLaunchArgument("unload_on_kill", default_value="false"),
            spawner,
        ]
    )


def generate_load_controller_launch_description(
    controller_name: Any,
    controller_params_file: Any = None,
    extra_spawner_args: Any = (),
    *,
    controller_type: Any = None,
) -> LaunchDescription:
    """`controller_type` is one in Humble."""
    extra_spawner_args = [*(["--controller-type", controller_type] if controller_type else ()), *extra_spawner_args]
    files = [controller_params_file] if controller_params_file else None
    return generate_controllers_spawner_launch_description([controller_name], files, extra_spawner_args)


def generate_controllers_spawner_launch_description_from_dict(
    controller_info_dict: Any, extra_spawner_args: Any = ()
) -> LaunchDescription:
    files: list[Any] = []
    for each in controller_info_dict.values():
        files += each if isinstance(each, list) else [each] if each else []
    return generate_controllers_spawner_launch_description(list(controller_info_dict), files, extra_spawner_args)


CONTROLLERS = {
    each.__name__: each
    for each in (
        generate_controllers_spawner_launch_description,
        generate_controllers_spawner_launch_description_from_dict,
        generate_load_controller_launch_description,
    )
}

# launch_pal


def include_launch_py_description(pkg_name: Any, paths: Any, **kwargs: Any) -> Any:
    path = PathJoinSubstitution([FindPackageShare(pkg_name), *paths])
    return IncludeLaunchDescription(PythonLaunchDescriptionSource(path), **kwargs)


def read_launch_argument(arg_name: str, context: LaunchContext) -> str:
    return LaunchConfiguration(arg_name).perform(context)


def merge_param_files(yaml_files: Any) -> str:
    """The path of one file with what all have: of the same key the last one's."""
    yaml = importlib.import_module("yaml")
    merged: dict[str, Any] = {}
    for each in yaml_files:
        path, prefix = (each, None) if isinstance(each, str) else each
        with open(path) as file:
            data = yaml.safe_load(file)
        if isinstance(data, Anything):
            return str(data)
        _merge(merged, _prefixed(data, prefix) if prefix else data)
    with tempfile.NamedTemporaryFile("w", delete=False) as written:
        yaml.dump(merged, written)
    return written.name


def _merge(into: dict[str, Any], data: dict[str, Any]) -> None:
    for key, value in data.items():
        if isinstance(value, dict) and isinstance(into.get(key), dict):
            _merge(into[key], value)
        else:
            into[key] = value


def _prefixed(data: Any, prefix: str) -> Any:
    if not isinstance(data, dict):
        return data
    return {k: {prefix: v} if k == "ros__parameters" else _prefixed(v, prefix) for k, v in data.items()}
