"""`controller_manager.launch_utils`, as ros-controls/ros2_control has it, for where it is not installed."""

from __future__ import annotations

from typing import Any

from .base import LaunchDescription
from .ros_nodes import Node
from .settings import DeclareLaunchArgument
from .substitutions import LaunchConfiguration, PythonExpression


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
